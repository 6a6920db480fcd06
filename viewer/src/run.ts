// A run as the page works with it: its columns, its modes, and when which was in force.

import { modeColour } from "./palette";
import type { RecordedRun, Scene, Task } from "./protocol";

/** Sets that were active together at some time. */
export interface Mode {
  active: ReadonlySet<string>;
  /** The active sets as people write them. */
  label: string;
  /** Its colour everywhere; `null` of the mode in which none is active. */
  colour: string | null;
}

/** A stretch of time in one mode. */
export interface Span {
  from_s: number;
  to_s: number;
  mode: Mode;
}

/** Colours of modes, the same in all runs of a recording. */
export class ModeColours {
  private readonly known = new Map<string, string>();

  of(active: readonly string[]): string | null {
    if (active.length === 0) return null;
    const key = [...active].sort().join("+");
    const colour = this.known.get(key) ?? modeColour(this.known.size);
    this.known.set(key, colour);
    return colour;
  }
}

export class Run {
  readonly name: string;
  readonly scene: Scene;
  /** Time of each row [s]. */
  readonly t_s: Float64Array;
  readonly modes: Mode[];
  readonly spans: Span[];
  private readonly columns = new Map<string, Float64Array>();
  private readonly ranges = new Map<string, [number, number]>();
  private readonly joints: (Float64Array | undefined)[];

  constructor(private readonly recorded: RecordedRun, colours: ModeColours) {
    const { name, scene, ticks } = recorded;
    this.name = name;
    this.scene = scene;
    this.t_s = Float64Array.from(ticks.t_s);
    for (const [column, values] of Object.entries(ticks.columns)) {
      this.columns.set(column, Float64Array.from(values, (value) => value ?? Number.NaN));
    }
    this.modes = ticks.active_sets.map((active) => ({
      active: new Set(active),
      label: active.length ? active.join(" + ") : "no set active",
      colour: colours.of(active),
    }));
    this.spans = spans(this.t_s, ticks.active, this.modes);
    this.joints = scene.robot.joints.map((_, joint) => this.columns.get(`q${joint + 1}_rad`));
  }

  get rows(): number {
    return this.t_s.length;
  }

  /** How many ticks there were for one that is shown. */
  get every(): number {
    return this.recorded.ticks.every;
  }

  get begin_s(): number {
    return this.t_s[0] ?? 0;
  }

  get end_s(): number {
    return this.t_s[this.rows - 1] ?? 0;
  }

  get title(): string {
    return this.scene.title ?? this.name;
  }

  /** Names of all columns. */
  get names(): string[] {
    return [...this.columns.keys()];
  }

  column(name: string): Float64Array | undefined {
    return this.columns.get(name);
  }

  /** The number in a column, NaN where there is none. */
  at(name: string | null, row: number): number {
    return (name === null ? undefined : this.columns.get(name)?.[row]) ?? Number.NaN;
  }

  /** Position of a joint, counted from 0 [rad or m]. */
  q(joint: number, row: number): number {
    return this.joints[joint]?.[row] ?? 0;
  }

  /** Least and greatest number of a column. */
  range(name: string): [number, number] {
    const known = this.ranges.get(name);
    if (known) return known;
    let least = Number.POSITIVE_INFINITY, greatest = Number.NEGATIVE_INFINITY;
    for (const value of this.columns.get(name) ?? []) {
      if (value < least) least = value;
      if (value > greatest) greatest = value;
    }
    const range: [number, number] = least <= greatest ? [least, greatest] : [0, 0];
    this.ranges.set(name, range);
    return range;
  }

  /** The last row at or before a time. */
  rowAt(t_s: number): number {
    let low = 0, high = this.rows;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      // A time that was written down and read again may be a little before its row.
      if (this.t_s[middle]! <= t_s + 1e-6) low = middle;
      else high = middle;
    }
    return low;
  }

  modeAt(row: number): Mode {
    return this.modes[this.recorded.ticks.active[row] ?? 0] ?? NO_MODE;
  }

  /** Number of the mode, where it has one. */
  modeNumber(row: number): number | null {
    return this.recorded.ticks.mode[row] ?? null;
  }

  /** Codes of what decided a tick. */
  reasons(row: number): readonly string[] {
    const { why, reasons } = this.recorded.ticks;
    return reasons[why[row] ?? -1] ?? [];
  }

  /** When a set was active, together with whatever else. */
  activeSpans(task: Task): Span[] {
    return this.spans.filter((span) => span.mode.active.has(task.name));
  }

  /** When the mode changed [s]. */
  get changes_s(): number[] {
    return this.spans.slice(1).map((span) => span.from_s);
  }
}

const NO_MODE: Mode = { active: new Set(), label: "no set active", colour: null };

function spans(t_s: Float64Array, active: number[], modes: Mode[]): Span[] {
  const spans: Span[] = [];
  let last = -1;
  for (let row = 0; row < t_s.length; row++) {
    const from_s = t_s[row]!;
    const span = spans[spans.length - 1];
    if (span) span.to_s = from_s;
    if (active[row] === last) continue;
    last = active[row]!;
    spans.push({ from_s, to_s: from_s, mode: modes[last] ?? NO_MODE });
  }
  return spans;
}
