// The tasks in priority order. Joint limits and pairs of shapes, of which there may be hundreds, stand
// together in one line each, below which those that are active show.

import { element, mark, say } from "../element";
import type { Task } from "../protocol";
import { quantity } from "../quantity";
import type { Run } from "../run";
import { inside } from "../words";
import { TaskRow } from "./task_row";

/** How the names of the sets begin that keep joints within their position limits. */
const LIMIT = "limit/";

/** Fewer tasks of a kind than this are no group. */
const FEW = 3;

export class Hierarchy {
  readonly element = element("ol", { class: "hierarchy", "aria-label": "Tasks, the most important first" });
  private readonly parts: (TaskRow | Group)[] = [];
  private readonly rows = new Map<Element, TaskRow>();

  /** `point` is told which task somebody points at. */
  constructor(run: Run, point: (task: string | null) => void) {
    const { tasks } = run.scene;
    let number = 0;
    for (const run_of of grouped(tasks)) {
      const rows = run_of.tasks.map((task) => new TaskRow(run, task, ++number));
      for (const row of rows) {
        this.rows.set(row.element, row);
        for (const kind of ["pointerenter", "focus"]) row.element.addEventListener(kind, () => point(row.task.name));
        for (const kind of ["pointerleave", "blur"]) row.element.addEventListener(kind, () => point(null));
      }
      const parts = run_of.title ? [new Group(run, run_of.title, rows)] : rows;
      this.parts.push(...parts);
    }
    this.element.append(...this.parts.map((part) => part.element));
    const observer = new IntersectionObserver((changes) => {
      for (const { target, isIntersecting } of changes) this.rows.get(target)!.isSeen = isIntersecting;
    });
    for (const element of this.rows.keys()) observer.observe(element);
  }

  /** Makes the row of a task stand out; `null`: none. */
  point(task: string | null): void {
    for (const row of this.rows.values()) row.element.toggleAttribute("data-pointed", row.task.name === task);
  }

  /** Brings the list to a row; in a hurry, only what is on the screen. */
  update(row: number, isHurried: boolean): void {
    for (const part of this.parts) part.update(row, isHurried);
  }
}

/** Tasks of one kind that follow each other. */
class Group {
  readonly element: HTMLLIElement;
  private readonly list = element("ol");
  private readonly nearest = element("span", { class: "what" });
  private readonly state = element("span", { class: "state" });
  private isOpen = false;

  constructor(private readonly run: Run, title: string, private readonly rows: TaskRow[]) {
    const first = rows[0]!.element.querySelector(".number")?.textContent ?? "";
    const last = rows[rows.length - 1]!.element.querySelector(".number")?.textContent ?? "";
    const head = element(
      "button",
      { type: "button", class: "group-head", "aria-expanded": "false" },
      element("span", { class: "line" },
        element("span", { class: "number" }, `${first}–${last}`), element("span", { class: "name" }, title), this.state),
      element("span", { class: "line" }, this.nearest),
    );
    head.addEventListener("click", () => {
      this.isOpen = !this.isOpen;
      mark(head, "aria-expanded", String(this.isOpen));
      this.update(this.row, false);
    });
    this.list.append(...rows.map((row) => row.element));
    this.element = element("li", { class: "group" }, head, this.list);
  }

  private row = 0;

  update(row: number, isHurried: boolean): void {
    this.row = row;
    const { active } = this.run.modeAt(row);
    let held = 0, shown = 0, least = Number.POSITIVE_INFINITY, nearest: Task | null = null;
    for (const task_row of this.rows) {
      const { task } = task_row;
      const isActive = active.has(task.name);
      if (isActive) held++;
      const margin = inside(task, this.run.at(task.value, row));
      if (margin < least) [least, nearest] = [margin, task];
      // What is outside needs to be seen as much as what is held.
      const isShown = this.isOpen || isActive || margin < -1e-6;
      const wasHidden = task_row.element.hidden;
      task_row.element.hidden = !isShown;
      if (!isShown) continue;
      shown++;
      task_row.update(row, isHurried && !wasHidden);
    }
    this.list.hidden = shown === 0;
    mark(this.element, "data-state", held ? "held" : "inside");
    say(this.state, held ? `${held} held` : "all inside");
    const name = nearest?.name.replace(LIMIT, "") ?? "";
    say(this.nearest, nearest ? `nearest to its border: ${name}, ${quantity(least, nearest.unit)}` : "");
  }
}

function grouped(tasks: Task[]): { title: string | null; tasks: Task[] }[] {
  const kind = (task: Task) =>
    task.name.startsWith(LIMIT) ? "joint limits" : task.name === task.between?.join("/") ? "shapes kept apart" : null;
  const groups: { title: string | null; tasks: Task[] }[] = [];
  for (const task of tasks) {
    const title = kind(task);
    const last = groups[groups.length - 1];
    if (title && last?.title === title) last.tasks.push(task);
    else groups.push({ title, tasks: [task] });
  }
  return groups.map((group) => ({
    title: group.title && group.tasks.length >= FEW ? `${group.tasks.length} ${group.title}` : null,
    tasks: group.tasks,
  }));
}
