// The modes over time, one strip a run, which is also where the time is chosen.

import type { Clock } from "../clock";
import { button, element, mark, style } from "../element";
import { seconds } from "../quantity";
import type { Mode, Run } from "../run";
import { Canvas } from "./canvas";

const STRIP = 18;
const GAP = 4;
const FOOT = 18;
/** Modes named below the strip; more than these are not told apart by their colours. */
const MOST_NAMED = 8;
const INSET: [number, number] = [8, 8];

export class Timeline {
  readonly element: HTMLElement;
  private readonly canvas: Canvas;
  private readonly range: HTMLInputElement;
  private readonly legend = element("div", { class: "legend" });
  private named = -1;

  constructor(private readonly runs: Run[], private readonly clock: Clock) {
    this.canvas = new Canvas((pen, width, height) => this.draw(pen, width, height), INSET, "Modes over time");
    this.canvas.element.style.height = `${runs.length * (STRIP + GAP) + FOOT}px`;
    this.canvas.onDrag((share) => clock.seek(clock.begin_s + share * (clock.horizon_s - clock.begin_s)));
    this.range = element("input", {
      type: "range", min: "0", max: "1000", step: "1", class: "scrub", "aria-label": "Time",
    });
    this.range.addEventListener("input", () => {
      clock.seek(clock.begin_s + (Number(this.range.value) / 1000) * (clock.horizon_s - clock.begin_s));
    });
    this.canvas.element.append(this.range);
    this.element = element("div", { class: "timeline" }, this.canvas.element, this.legend);
    this.name();
  }

  update(row: number): void {
    const { begin_s, horizon_s, t_s } = this.clock;
    const share = (t_s - begin_s) / (horizon_s - begin_s || 1);
    this.canvas.setCursor(share);
    const value = String(Math.round(share * 1000));
    if (this.range.value !== value) this.range.value = value;
    const mode = this.runs[0]!.modeAt(row).label;
    mark(this.range, "aria-valuetext", `${seconds(t_s)}, ${mode}`);
  }

  redraw(): void {
    this.name();
    this.canvas.redraw();
  }

  /** Names of the modes, in their colours; each leads to when it is next in force. */
  private name(): void {
    // There is another mode only where there is another span.
    const seen = this.runs.reduce((sum, run) => sum + run.spans.length, 0);
    if (seen === this.named) return;
    this.named = seen;
    const modes = new Map<string, Mode>();
    for (const run of this.runs) {
      for (const { mode } of run.spans) if (mode.colour) modes.set(mode.label, mode);
    }
    const named = [...modes.values()].slice(0, MOST_NAMED).map((mode) => {
      const swatch = element("i", { class: "swatch" });
      swatch.style.background = mode.colour ?? "";
      const content = element("span", {}, swatch, mode.label);
      return button(`Go to the next time in mode ${mode.label}`, content, () => this.next(mode));
    });
    const more = modes.size - named.length;
    const rest = more > 0 ? [element("span", { class: "soft" }, `and ${more} more`)] : [];
    const none = modes.size === 0 ? [element("span", { class: "soft" }, "no set was ever active")] : [];
    const hasReached = this.runs.some((run) => run.scene.result?.waypoints_reached_s.some((t_s) => t_s !== null));
    const marks = hasReached ? [element("span", { class: "soft mark" }, "▾ waypoint reached")] : [];
    this.legend.replaceChildren(...named, ...rest, ...none, ...marks);
  }

  private next(mode: Mode): void {
    const starts = this.runs
      .flatMap((run) => run.spans)
      .filter((span) => span.mode.label === mode.label)
      .map((span) => span.from_s)
      .sort((a, b) => a - b);
    const next = starts.find((start) => start > this.clock.t_s + 1e-6) ?? starts[0];
    if (next !== undefined) this.clock.seek(next);
  }

  private draw(pen: CanvasRenderingContext2D, width: number, height: number): void {
    const { begin_s, horizon_s: end_s } = this.clock;
    const [left, right] = INSET;
    const x = (t_s: number) => left + ((t_s - begin_s) / (end_s - begin_s || 1)) * (width - left - right);
    const quiet = style("--track"), soft = style("--soft"), ink = style("--ink");
    pen.clearRect(0, 0, width, height);
    this.runs.forEach((run, nth) => {
      const top = nth * (STRIP + GAP);
      pen.fillStyle = quiet;
      pen.fillRect(x(run.begin_s), top, x(run.end_s) - x(run.begin_s), STRIP);
      for (const span of run.spans) {
        if (!span.mode.colour) continue;
        pen.fillStyle = span.mode.colour;
        pen.fillRect(x(span.from_s), top, Math.max(1, x(span.to_s) - x(span.from_s)), STRIP);
      }
      pen.fillStyle = ink;
      for (const reached of run.scene.result?.waypoints_reached_s ?? []) {
        if (reached === null) continue;
        pen.beginPath();
        pen.moveTo(x(reached) - 4, top);
        pen.lineTo(x(reached) + 4, top);
        pen.lineTo(x(reached), top + 6);
        pen.fill();
      }
    });
    const foot = this.runs.length * (STRIP + GAP);
    pen.fillStyle = soft;
    pen.textBaseline = "top";
    for (const tick of ticks(begin_s, end_s, Math.max(2, width / 110))) {
      pen.textAlign = tick === begin_s ? "left" : x(tick) > width - 24 ? "right" : "center";
      pen.fillRect(x(tick), foot - GAP, 1, 4);
      pen.fillText(tick === begin_s ? `${tick} s` : String(tick), x(tick), foot + 3);
    }
  }
}

/** Round numbers between two, about so many. */
export function ticks(low: number, high: number, about: number): number[] {
  const raw = (high - low) / Math.max(1, about);
  if (!(raw > 0) || !Number.isFinite(raw)) return [];
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= raw) ?? raw;
  const marks: number[] = [];
  for (let nth = Math.ceil(low / step - 1e-9); nth * step <= high + 1e-9 * step; nth++) {
    // 0.30000000000000004 is 0.3.
    marks.push(Number((nth * step).toPrecision(12)));
  }
  return marks;
}
