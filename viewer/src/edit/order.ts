// The order of the tasks: changed by a hand, by keys, or by buttons.

import type { Task } from "../protocol";
import { isListed } from "../panel/hierarchy";
import type { TaskRow } from "../panel/task_row";
import type { Workbench } from "./workbench";

/** Names of the tasks that can be ordered, the most important first. */
export function listed(tasks: readonly Task[]): string[] {
  return tasks.filter(isListed).map(({ name }) => name);
}

/** The order in which a name stands at another place, counted from 0. */
export function placed(names: readonly string[], name: string, at: number): string[] {
  const others = names.filter((other) => other !== name);
  others.splice(Math.min(Math.max(at, 0), others.length), 0, name);
  return others;
}

/** Sends a task to another place. */
export function order(bench: Workbench, name: string, at: number, complain: (error: string | null) => void): void {
  const names = listed(bench.run.scene.tasks);
  const next = placed(names, name, at);
  if (bench.refusal() !== null) complain(bench.refusal());
  else if (String(next) !== String(names)) bench.put("order", [{ order: next }], complain);
}

/** One place up or down. */
export function shift(bench: Workbench, name: string, by: -1 | 1, complain: (error: string | null) => void): void {
  order(bench, name, listed(bench.run.scene.tasks).indexOf(name) + by, complain);
}

/** Lets a row be dragged to another place by its number. */
export function dragOrder(bench: Workbench, row: TaskRow, complain: (error: string | null) => void): void {
  const { number } = row;
  number.classList.add("order-grip");
  let target: { element: Element; at: number } | null = null;
  const clear = () => document.querySelectorAll("[data-drop]").forEach((each) => each.removeAttribute("data-drop"));
  number.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    event.preventDefault();
    number.setPointerCapture(event.pointerId);
    row.element.toggleAttribute("data-dragged", true);
  });
  number.addEventListener("pointermove", (event) => {
    if (!number.hasPointerCapture(event.pointerId)) return;
    clear();
    target = dropAt(bench, row, event.clientY);
  });
  number.addEventListener("lostpointercapture", () => {
    row.element.removeAttribute("data-dragged");
    clear();
    if (target) order(bench, row.task.name, target.at, complain);
    target = null;
  });
}

/** Where a row would come to stand, marked in the list. */
function dropAt(bench: Workbench, row: TaskRow, y: number): { element: Element; at: number } | null {
  const names = listed(bench.run.scene.tasks);
  const own = names.indexOf(row.task.name);
  const rows = [...(row.element.parentElement?.children ?? [])].filter((each) => each.querySelector(".order-grip"));
  for (const [nth, element] of rows.entries()) {
    const { top, bottom } = element.getBoundingClientRect();
    const isBefore = y < (top + bottom) / 2;
    if (!isBefore && nth < rows.length - 1) continue;
    const at = isBefore ? nth : nth + 1;
    element.setAttribute("data-drop", isBefore ? "before" : "after");
    // Whoever drags to the edge of the list sees what comes beyond it.
    (isBefore ? (element.previousElementSibling ?? element) : element).scrollIntoView({ block: "nearest" });
    // Taken out of its place, those below it move up.
    return { element, at: at > own ? at - 1 : at };
  }
  return null;
}
