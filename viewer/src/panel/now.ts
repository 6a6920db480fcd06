// What is in force now: the mode, the waypoint, and what else decided the tick.

import { element, mark, say } from "../element";
import { quantity } from "../quantity";
import type { Run } from "../run";
import { decided, waypointCount } from "../words";

export class Now {
  readonly element: HTMLElement;
  private readonly mode = element("strong", { class: "mode" });
  private readonly swatch = element("i", { class: "swatch", "aria-hidden": "true" });
  private readonly goal = element("span", { class: "goal" });
  private readonly reasons = element("p", { class: "reasons" });

  constructor(private readonly run: Run, title: string | null) {
    const heading = title ? [element("h2", {}, title)] : [];
    this.element = element(
      "section",
      { class: "now", "aria-label": "Now" },
      ...heading,
      element("div", { class: "line" }, this.swatch, this.mode),
      this.goal,
      this.reasons,
    );
  }

  update(row: number): void {
    const { run } = this;
    const mode = run.modeAt(row);
    const number = run.modeNumber(row);
    const name = number === null ? "A mode" : `Mode ${number}`;
    say(this.mode, `${name}: ${mode.label}`);
    mark(this.swatch, "style", mode.colour ? `background:${mode.colour}` : "");
    const goal = this.goalText(row);
    this.goal.hidden = goal === "";
    say(this.goal, goal);
    const text = decided(run, row).join(" ");
    say(this.reasons, text || "Nothing else limits this tick.");
  }

  private goalText(row: number): string {
    const { run } = this;
    const task = run.scene.tasks.find((task) => waypointCount(task) > 0);
    if (!task) return "";
    const nth = run.at("waypoint", row);
    const error = run.at(task.error, row);
    return `Waypoint ${nth + 1} of ${waypointCount(task)}, ${quantity(error, task.unit)} to go`;
  }
}
