// One task of the list: what it is, its value, its interval, how it stands and why.

import { element, mark, say } from "../element";
import type { Glide, Task } from "../protocol";
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
  /** The line with its number, its name and how it stands. */
  readonly head: HTMLElement;
  readonly number: HTMLElement;
  readonly bar: Bar | null;
  /** Whether it is on the screen. */
  isSeen = true;
  private wasHeld = false;
  private readonly value = element("span", { class: "value" });
  private readonly state = element("span", { class: "state" });
  private readonly what = element("span", { class: "what" });
  private readonly why = element("p", { class: "why" });

  constructor(private readonly run: Run, public task: Task, number: number) {
    const hasBar = this.column !== null && run.column(this.column) !== undefined;
    this.bar = hasBar ? new Bar(0, 1, null, null) : null;
    this.number = element("span", { class: "number" }, String(number));
    this.head = element("div", { class: "line" }, this.number, element("span", { class: "name" }, task.name), this.state);
    this.element = element(
      "li",
      { class: "task", tabindex: "0" },
      this.head,
      element("div", { class: "line" }, this.what, this.value),
      ...(this.bar ? [this.bar.element] : []),
      this.why,
    );
    this.element.classList.add(isSet(task) ? "is-set" : "is-equality");
    this.take(task);
  }

  /** Takes what the task is now. */
  take(task: Task): void {
    this.task = task;
    say(this.what, `${asked(task)} · ${measured(task)}`);
    this.what.title = `${ROLES[task.role]}: ${this.what.textContent}`;
    this.scale(task);
  }

  /** In a hurry, only where it is on the screen, or became active or inactive. `glide`: its bounds are on their way. */
  update(row: number, isHurried: boolean, glide?: Glide): void {
    const { run } = this;
    const isHeld = run.modeAt(row).active.has(this.task.name);
    if (isHurried && !this.isSeen && isHeld === this.wasHeld) return;
    this.wasHeld = isHeld;
    const task = glide ? inForce(this.task, glide) : this.task;
    const how = standing(run, task, row);
    const shown = run.at(this.column, row);
    mark(this.element, "data-state", how.state);
    say(this.state, how.short);
    say(this.value, isSet(task) ? quantity(shown, task.unit) : `error ${quantity(shown, task.unit)}`);
    say(this.why, how.long);
    this.why.hidden = how.long === "";
    if (glide || this.bar?.has(shown) === false) this.scale(task);
    this.bar?.set(shown);
  }

  private get column(): string | null {
    const { task } = this;
    return task.value !== null && isSet(task) ? task.value : task.error;
  }

  /** Ends of the bar: what was seen and what is allowed. */
  private scale(task: Task): void {
    if (!this.bar) return;
    const seen = this.run.range(this.column!);
    if (!isSet(task)) {
      this.bar.scale(0, seen[1] || 1, null, null);
      return;
    }
    const { min = null, max = null } = task;
    const [low, high] = ends(seen, [min, max, this.task.min, this.task.max]);
    this.bar.scale(low, high, min, max);
  }
}

/** A task with the bounds that are in force while they are on their way. */
function inForce(task: Task, { away_min = 0, away_max = 0 }: Glide): Task {
  const moved = (bound: number | null | undefined, away: number) => (typeof bound === "number" ? bound + away : null);
  return { ...task, min: moved(task.min, away_min), max: moved(task.max, away_max) };
}
