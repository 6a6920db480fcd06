// One number over time, of one run or two, with the limits of its set and where that was active.

import type { Clock } from "../clock";
import { button, element, icon, say, style } from "../element";
import type { Task } from "../protocol";
import { quantity } from "../quantity";
import type { Bounds, Run } from "../run";
import { isSet } from "../words";
import { Canvas } from "./canvas";
import { ticks } from "./timeline";

const INSET: [number, number] = [46, 10];
const TOP = 8;
const BOTTOM = 18;

export interface Quantity {
  column: string;
  title: string;
  unit: string;
  /** The set whose limits bound it. */
  task: Task | null;
}

export class Plot {
  readonly element: HTMLElement;
  private readonly value = element("span", { class: "value" });
  private readonly canvas: Canvas;

  constructor(
    private readonly runs: Run[],
    private readonly clock: Clock,
    readonly quantity: Quantity,
    remove: () => void,
  ) {
    const { title, unit } = quantity;
    this.canvas = new Canvas((pen, width, height) => this.draw(pen, width, height), INSET, `${title} over time`);
    this.canvas.onDrag((share) => clock.seek(clock.begin_s + share * (clock.horizon_s - clock.begin_s)));
    const shown = unit === "-" ? "" : unit.replace("rad", "°");
    const name = element("h3", {}, title, ...(shown ? [element("small", {}, ` [${shown}]`)] : []));
    const close = button(`Remove the plot of ${title}`, icon("M4 4l8 8M12 4l-8 8"), remove);
    this.element = element("figure", { class: "plot" }, element("figcaption", {}, name, this.value, close), this.canvas.element);
  }

  update(rows: number[]): void {
    const { begin_s, horizon_s, t_s } = this.clock;
    this.canvas.setCursor((t_s - begin_s) / (horizon_s - begin_s || 1));
    const values = this.runs.map((run, nth) => quantity(run.at(this.quantity.column, rows[nth]!), this.quantity.unit));
    say(this.value, values.join(" | "));
  }

  redraw(): void {
    this.canvas.redraw();
  }

  private draw(pen: CanvasRenderingContext2D, width: number, height: number): void {
    const { begin_s, horizon_s: end_s } = this.clock;
    const { column } = this.quantity;
    const { task } = this.quantity;
    const scale = this.quantity.unit.startsWith("rad") ? 180 / Math.PI : 1;
    // A bound may have been changed on the way.
    const bounds = task && isSet(task) ? this.runs[0]!.boundsOf(task.name) : [];
    const [low, high] = this.range(bounds);
    const [left, right] = INSET;
    const x = (t_s: number) => left + ((t_s - begin_s) / (end_s - begin_s || 1)) * (width - left - right);
    const y = (value: number) => height - BOTTOM - ((value - low) / (high - low)) * (height - BOTTOM - TOP);
    pen.clearRect(0, 0, width, height);
    this.drawForbidden(pen, bounds, x, y, height);
    pen.strokeStyle = style("--line");
    pen.fillStyle = style("--soft");
    pen.lineWidth = 1;
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    for (const tick of ticks(low * scale, high * scale, Math.max(3, height / 34))) {
      const at = Math.round(y(tick / scale)) + 0.5;
      line(pen, left, at, width - right, at);
      pen.fillText(String(tick).replace("-", "−"), left - 6, at);
    }
    pen.textBaseline = "top";
    for (const tick of ticks(begin_s, end_s, Math.max(2, width / 90))) {
      pen.textAlign = x(tick) > width - right - 8 ? "right" : "center";
      pen.fillText(String(tick), x(tick), height - BOTTOM + 5);
    }
    this.runs.forEach((run, nth) => {
      const values = run.column(column);
      if (!values) return;
      pen.setLineDash(nth === 0 ? [] : [4, 3]);
      pen.lineWidth = 1.75;
      pen.strokeStyle = nth === 0 ? style("--ink") : style("--accent");
      trace(pen, run.t_s, values, 0, run.rows - 1, x, y);
      if (nth > 0 || !task) return;
      // Where the set was active the curve has the colour of the mode.
      pen.lineWidth = 3;
      for (const span of run.activeSpans(task)) {
        pen.strokeStyle = span.mode.colour ?? style("--ink");
        trace(pen, run.t_s, values, run.rowAt(span.from_s), run.rowAt(span.to_s), x, y);
      }
    });
    pen.setLineDash([]);
  }

  private range(all_bounds: Bounds[]): [number, number] {
    const bounds = all_bounds.flatMap(({ min, max }) => [min, max]);
    const ranges = this.runs.filter((run) => run.column(this.quantity.column)).flatMap((run) => run.range(this.quantity.column));
    const seen = [Math.min(...ranges), Math.max(...ranges)];
    const size = seen[1]! - seen[0]!;
    // A limit that is far away would leave nothing to see of the curve.
    const near = bounds.filter((bound) => bound !== null && bound > seen[0]! - 3 * size && bound < seen[1]! + 3 * size);
    const all = [...seen, ...(near as number[])];
    const low = Math.min(...all), high = Math.max(...all);
    const margin = 0.08 * (high - low) || Math.max(1e-3, 0.1 * Math.abs(high));
    return [low - margin, high + margin];
  }

  private drawForbidden(
    pen: CanvasRenderingContext2D,
    bounds: Bounds[],
    x: (t_s: number) => number,
    y: (value: number) => number,
    height: number,
  ): void {
    const { begin_s, horizon_s: end_s } = this.clock;
    const inside = (at: number) => Math.min(height - BOTTOM, Math.max(TOP, at));
    bounds.forEach(({ from_s, min, max }, nth) => {
      const from = x(Math.max(begin_s, from_s)), to = x(Math.min(end_s, bounds[nth + 1]?.from_s ?? end_s));
      if (to <= from) return;
      for (const [bound, end] of [[min, height - BOTTOM], [max, TOP]] as const) {
        if (bound === null) continue;
        const edge = inside(y(bound));
        pen.fillStyle = style("--forbidden");
        pen.fillRect(from, Math.min(edge, end), to - from, Math.abs(end - edge));
        if (edge !== y(bound)) continue;
        pen.strokeStyle = style("--limit");
        pen.lineWidth = 1.25;
        pen.setLineDash([5, 3]);
        line(pen, from, edge, to, edge);
        pen.setLineDash([]);
      }
    });
  }
}

function line(pen: CanvasRenderingContext2D, x1: number, y1: number, x2: number, y2: number): void {
  pen.beginPath();
  pen.moveTo(x1, y1);
  pen.lineTo(x2, y2);
  pen.stroke();
}

/** Draws rows of a column: of those that fall on one pixel, where they begin, their ends, and where they leave. */
function trace(
  pen: CanvasRenderingContext2D,
  t_s: Float64Array,
  values: Float64Array,
  from: number,
  to: number,
  x: (t_s: number) => number,
  y: (value: number) => number,
): void {
  pen.beginPath();
  let isDown = false, pixel = Number.NaN, least = 0, greatest = 0, last = 0;
  const finish = () => {
    if (!isDown || least === greatest) return;
    pen.lineTo(pixel, y(least));
    pen.lineTo(pixel, y(greatest));
    pen.lineTo(pixel, y(last));
  };
  for (let row = from; row <= to; row++) {
    const value = values[row]!;
    if (Number.isNaN(value)) {
      finish();
      isDown = false;
      continue;
    }
    const at = Math.round(x(t_s[row]!) * 2) / 2;
    if (isDown && at === pixel) {
      least = Math.min(least, value);
      greatest = Math.max(greatest, value);
    } else {
      finish();
      if (isDown) pen.lineTo(at, y(value));
      else pen.moveTo(at, y(value));
      [isDown, pixel, least, greatest] = [true, at, value, value];
    }
    last = value;
  }
  finish();
  pen.stroke();
}
