// One task of the list: what it is, its value, its interval, how it stands and why.

import { element, mark, say } from "../element";
import type { Task } from "../protocol";
import { quantity } from "../quantity";
import type { Run } from "../run";
import { asked, isSet, measured, standing } from "../words";
import { Bar, ends } from "./bar";

const ROLES = {
  "high-priority set": "set · high priority",
  "low-priority set": "set · low priority",
  equality: "equality",
} as const;

export class TaskRow {
  readonly element: HTMLLIElement;
  /** Whether it is on the screen. */
  isSeen = true;
  private wasHeld = false;
  private readonly value = element("span", { class: "value" });
  private readonly state = element("span", { class: "state" });
  private readonly why = element("p", { class: "why" });
  private readonly bar: Bar | null;

  constructor(private readonly run: Run, readonly task: Task, number: number) {
    const column = task.value !== null && isSet(task) ? task.value : task.error;
    this.bar = bar(run, task, column);
    const name = element("span", { class: "name" }, task.name);
    const what = element("span", { class: "what" }, `${asked(task)} · ${measured(task)}`);
    this.element = element(
      "li",
      { class: "task", tabindex: "0" },
      element("div", { class: "line" }, element("span", { class: "number" }, String(number)), name, this.state),
      element("div", { class: "line" }, what, this.value),
      ...(this.bar ? [this.bar.element] : []),
      this.why,
    );
    what.title = `${ROLES[task.role]}: ${what.textContent}`;
    this.element.classList.add(isSet(task) ? "is-set" : "is-equality");
  }

  /** In a hurry, only where it is on the screen, or became active or inactive. */
  update(row: number, isHurried: boolean): void {
    const { task, run } = this;
    const isHeld = run.modeAt(row).active.has(task.name);
    if (isHurried && !this.isSeen && isHeld === this.wasHeld) return;
    this.wasHeld = isHeld;
    const how = standing(run, task, row);
    const shown = isSet(task) ? run.at(task.value, row) : run.at(task.error, row);
    mark(this.element, "data-state", how.state);
    say(this.state, how.short);
    say(this.value, isSet(task) ? quantity(shown, task.unit) : `error ${quantity(shown, task.unit)}`);
    say(this.why, how.long);
    this.why.hidden = how.long === "";
    this.bar?.set(shown);
  }
}

function bar(run: Run, task: Task, column: string | null): Bar | null {
  if (column === null || !run.column(column)) return null;
  const seen = run.range(column);
  if (!isSet(task)) return new Bar(0, seen[1] || 1, null, null);
  const { min = null, max = null } = task;
  const [low, high] = ends(seen, [min, max]);
  return new Bar(low, high, min, max);
}
