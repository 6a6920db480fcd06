// The joints: where each is between its limits, and how fast.

import { element, mark, say } from "../element";
import type { Joint } from "../protocol";
import { quantity } from "../quantity";
import type { Run } from "../run";
import { Bar, ends } from "./bar";

export class Joints {
  readonly element = element("ul", { class: "joints", "aria-label": "Joints" });
  private readonly rows: JointRow[];

  constructor(run: Run) {
    this.rows = run.scene.robot.joints.map((joint, number) => new JointRow(run, joint, number));
    this.element.append(...this.rows.map((row) => row.element));
  }

  update(row: number): void {
    for (const joint of this.rows) joint.update(row);
  }
}

class JointRow {
  readonly element: HTMLLIElement;
  private readonly value = element("span", { class: "value" });
  private readonly bar: Bar;
  private readonly speed = element("i", { class: "speed" });
  private readonly unit: string;
  private readonly limits: [number | null, number | null];

  constructor(private readonly run: Run, private readonly joint: Joint, private readonly number: number) {
    this.unit = joint.kind === "revolute" ? "rad" : "m";
    this.limits = joint.position_limits ?? [null, null];
    const [min, max] = this.limits;
    // Without limits the bar is what the joint did, or a turn.
    const seen = run.range(`q${number + 1}_rad`);
    const around: [number, number] = joint.kind === "revolute" ? [Math.min(-Math.PI, seen[0]), Math.max(Math.PI, seen[1])] : seen;
    const [low, high] = joint.position_limits ? ends(seen, [min, max]) : ends(around, []);
    this.bar = new Bar(low, high, min, max);
    this.bar.element.append(this.speed);
    const limits = min === null && max === null
      ? "no position limits"
      : `from ${quantity(min ?? -Infinity, this.unit)} to ${quantity(max ?? Infinity, this.unit)}`;
    this.element = element(
      "li",
      { class: "joint", title: `${joint.name}: ${limits}` },
      element("span", { class: "name" }, joint.name),
      this.bar.element,
      this.value,
    );
  }

  update(row: number): void {
    const q = this.run.q(this.number, row);
    say(this.value, quantity(q, this.unit));
    // A joint of a run that is going on may come to where it never was.
    if (!this.bar.has(q)) this.bar.scale(...ends(this.run.range(`q${this.number + 1}_rad`), this.limits), ...this.limits);
    this.bar.set(q);
    const limit = `limit/${this.joint.name}`;
    mark(this.element, "data-state", this.run.modeAt(row).active.has(limit) ? "held" : "inside");
    const speed = Math.abs(this.run.at(`qd${this.number + 1}_rad_s`, row)) / (this.joint.speed_limit ?? Infinity);
    mark(this.speed, "style", `transform:scaleX(${(Number.isFinite(speed) ? Math.min(1, speed) : 0).toFixed(3)})`);
  }
}
