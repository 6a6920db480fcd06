// The tasks in priority order. Joint limits and pairs of shapes, of which there may be hundreds, stand
// together in one line each, below which those that are active show.

import { element, mark, say } from "../element";
import type { Task } from "../protocol";
import { quantity } from "../quantity";
import type { Gliding, Run } from "../run";
import { inside } from "../words";
import { TaskRow } from "./task_row";

/** How the names of the sets begin that keep joints within their position limits. */
const LIMIT = "limit/";

/** Fewer tasks of a kind than this are no group. */
const FEW = 3;

/** What is added to a row of a run that can be changed. */
export interface RowTools {
  /** Brings it to what the scene has now. */
  update: () => void;
}

export class Hierarchy {
  readonly element = element("ol", { class: "hierarchy", "aria-label": "Tasks, the most important first" });
  private parts: (TaskRow | Group)[] = [];
  private tools: RowTools[] = [];
  private tasks: Task[] = [];
  private readonly rows = new Map<Element, TaskRow>();
  private readonly observer = new IntersectionObserver((changes) => {
    for (const { target, isIntersecting } of changes) {
      const row = this.rows.get(target);
      if (row) row.isSeen = isIntersecting;
    }
  });

  /** `point` is told which task somebody points at; `equip` adds to rows what changes them. */
  constructor(
    private readonly run: Run,
    private readonly point_at: (task: string | null) => void,
    private readonly equip: ((row: TaskRow) => RowTools | null) | null = null,
  ) {
    this.take(run.scene.tasks);
  }

  /** Takes what the tasks are now; rows that stand in the same order stay. */
  take(tasks: Task[]): void {
    if (tasks === this.tasks) return;
    const isOrdered = tasks.length === this.tasks.length && tasks.every((task, nth) => isAlike(task, this.tasks[nth]!));
    this.tasks = tasks;
    if (!isOrdered) {
      this.build();
      return;
    }
    const named = new Map(tasks.map((task) => [task.name, task]));
    for (const row of this.rows.values()) {
      const task = named.get(row.task.name)!;
      if (task !== row.task) row.take(task);
    }
  }

  /** Brings what changes the rows to what the scene has now. */
  updateTools(): void {
    for (const tools of this.tools) tools.update();
  }

  /** Makes the row of a task stand out; `null`: none. */
  point(task: string | null): void {
    for (const row of this.rows.values()) row.element.toggleAttribute("data-pointed", row.task.name === task);
  }

  /** Brings the list to a row; in a hurry, only what is on the screen. */
  update(row: number, isHurried: boolean, gliding: Gliding): void {
    for (const part of this.parts) part.update(row, isHurried, part instanceof TaskRow ? gliding.get(part.task.name) : undefined);
  }

  private build(): void {
    const focused = this.rows.get(document.activeElement?.closest(".task") ?? document.body)?.task.name;
    this.observer.disconnect();
    this.rows.clear();
    [this.parts, this.tools] = [[], []];
    let number = 0;
    for (const run_of of grouped(this.tasks)) {
      const rows = run_of.tasks.map((task) => new TaskRow(this.run, task, ++number));
      for (const row of rows) this.add(row);
      this.parts.push(...(run_of.title ? [new Group(this.run, run_of.title, rows)] : rows));
    }
    this.element.replaceChildren(...this.parts.map((part) => part.element));
    for (const [element, row] of this.rows) {
      this.observer.observe(element);
      if (row.task.name === focused) row.element.focus();
    }
  }

  private add(row: TaskRow): void {
    this.rows.set(row.element, row);
    for (const kind of ["pointerenter", "focus"]) row.element.addEventListener(kind, () => this.point_at(row.task.name));
    for (const kind of ["pointerleave", "blur"]) row.element.addEventListener(kind, () => this.point_at(null));
    const tools = this.equip?.(row);
    if (tools) this.tools.push(tools);
  }
}

function isAlike(a: Task, b: Task): boolean {
  return a.name === b.name && a.role === b.role && a.type === b.type;
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
  const kind = (task: Task) => (task.name.startsWith(LIMIT) ? "joint limits" : isPair(task) ? "shapes kept apart" : null);
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

/** Whether a task is what a shape became that is kept away from something. */
function isPair(task: Task): boolean {
  return task.name === task.between?.join("/");
}

/** Whether a task is one of the scenario's list, and not what joints and shapes became. */
export function isListed(task: Task): boolean {
  return !task.name.startsWith(LIMIT) && !isPair(task);
}
