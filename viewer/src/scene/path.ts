// The tool's path: faint where it will go, in the colours of the modes where it has been.

import { Color, Group } from "three";
import { Line2 } from "three/addons/lines/Line2.js";
import { LineGeometry } from "three/addons/lines/LineGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import type { Run } from "../run";
import type { Look } from "./look";

/** A line of more points than this looks no smoother. */
const MOST_POINTS = 3000;

export class Path {
  readonly object = new Group();
  private readonly rows: number[] = [];
  private readonly gone = new LineGeometry();
  private readonly ahead = new LineMaterial({ linewidth: 1.5, transparent: true, opacity: 0.55 });
  private readonly behind = new LineMaterial({ linewidth: 4, vertexColors: true });

  constructor(private readonly run: Run) {
    const step = Math.max(1, Math.ceil(run.rows / MOST_POINTS));
    for (let row = 0; row < run.rows; row += step) this.rows.push(row);
    const axes = ["tool_x_m", "tool_y_m", "tool_z_m"];
    const points = this.rows.flatMap((row) => axes.map((axis) => run.at(axis, row)));
    // A path of one point is none.
    if (this.rows.length < 2 || points.some(Number.isNaN)) return;
    const whole = new LineGeometry();
    for (const geometry of [whole, this.gone]) geometry.setPositions(points);
    const lines = [new Line2(whole, this.ahead), new Line2(this.gone, this.behind)];
    lines[1]!.renderOrder = 1;
    this.object.add(...lines);
  }

  paint(look: Look): void {
    this.ahead.color.set(look.soft);
    const idle = new Color(look.ink);
    const colours = this.rows.flatMap((row) => {
      const { colour } = this.run.modeAt(row);
      return (colour ? new Color(colour) : idle).toArray();
    });
    if (this.object.children.length) this.gone.setColors(colours);
  }

  update(row: number): void {
    // Rows are evenly spaced, so this is how many of them are over.
    const step = this.rows[1] ?? 1;
    this.gone.instanceCount = Math.min(Math.floor(row / step), this.rows.length - 1);
  }
}
