// A run as the page works with it: its columns, its modes, and when which was in force. A run that is
// going on grows, and what is in its scene changes.

import { Growing } from "./growing";
import { History } from "./history";
import { modeColour } from "./palette";
import type { Glide, RecordedRun, Scene, Task, Ticks } from "./protocol";
import { shared } from "./shared";

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

/** What a task is to stay within, from a time on. */
export interface Bounds {
  from_s: number;
  min: number | null;
  max: number | null;
}

/** What is on its way to where the scene has it, by name of the task or obstacle. */
export type Gliding = ReadonlyMap<string, Glide>;

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

const NO_MODE: Mode = { active: new Set(), label: "no set active", colour: null };
const NOTHING_GLIDES: Gliding = new Map();

export class Run {
  readonly name: string;
  readonly modes: Mode[] = [];
  readonly spans: Span[] = [];
  /** How often everything was forgotten and begun again. */
  generation = 0;
  /** How many ticks there were for one that is shown. */
  every = 1;
  private readonly time = new Growing();
  private readonly columns = new Map<string, Growing>();
  private readonly ranges = new Map<string, { range: [number, number]; rows: number }>();
  private readonly joints: (Growing | undefined)[] = [];
  private readonly scenes: History<Scene>;
  private readonly glides = new History<Gliding>(NOTHING_GLIDES);
  private readonly numbers = new Map<string, number>();
  private readonly codes = new Map<string, number>();
  private readonly reasonLists: string[][] = [];
  /** Of each row, numbers of its mode in `modes` and of its reasons, and what the log calls the mode. */
  private active: number[] = [];
  private why: number[] = [];
  private called: (number | null)[] = [];

  constructor({ name, scene, later = [], ticks }: RecordedRun, private readonly colours: ModeColours) {
    this.name = name;
    this.scenes = new History(scene);
    for (const { from_s = 0, ...changed } of later) this.change({ ...changed, robot: scene.robot }, from_s);
    this.add(ticks);
  }

  /** What there is now. */
  get scene(): Scene {
    return this.scenes.last;
  }

  /** What there was at a time. */
  sceneAt(t_s: number): Scene {
    return this.scenes.at(t_s);
  }

  /** What bounded a task, from when on; nothing before it was there. */
  boundsOf(name: string): Bounds[] {
    const all: Bounds[] = [];
    let place = 0, task: Task | undefined;
    for (const { from_s, thing } of this.scenes) {
      const { tasks } = thing;
      if (tasks[place]?.name !== name) place = tasks.findIndex((task) => task.name === name);
      if (tasks[place] === task) continue;
      task = tasks[place];
      const { min = null, max = null } = task ?? {};
      const last = all[all.length - 1];
      if (!last || last.min !== min || last.max !== max) all.push({ from_s, min, max });
    }
    return all;
  }

  /** What was on its way at a time. */
  glidingAt(t_s: number): Gliding {
    return this.glides.at(t_s);
  }

  /** Takes a scene that holds from a time on. What has not changed in it stays the same object. */
  change(scene: Scene, from_s: number): void {
    this.scenes.add(from_s, shared(this.scene, scene));
  }

  /** Adds rows, or begins again with them. */
  take(ticks: Ticks): void {
    if (ticks.reset) this.forget();
    this.add(ticks);
    const gliding = ticks.gliding ?? [];
    if (gliding.length === 0 && this.glides.last === NOTHING_GLIDES) return;
    const named = gliding.length ? new Map(gliding.map((glide) => [glide.name, glide])) : NOTHING_GLIDES;
    this.glides.add(ticks.t_s[0] ?? this.end_s, named);
  }

  get rows(): number {
    return this.time.length;
  }

  /** Time of each row [s]. */
  get t_s(): Float64Array {
    return this.time.values;
  }

  get begin_s(): number {
    return this.rows ? this.time.at(0) : 0;
  }

  get end_s(): number {
    return this.rows ? this.time.at(this.rows - 1) : 0;
  }

  get title(): string {
    return this.scene.title ?? this.name;
  }

  /** Names of all columns. */
  get names(): string[] {
    return [...this.columns.keys()];
  }

  column(name: string): Float64Array | undefined {
    return this.columns.get(name)?.values;
  }

  /** The number in a column, NaN where there is none. */
  at(name: string | null, row: number): number {
    return (name === null ? undefined : this.columns.get(name)?.at(row)) ?? Number.NaN;
  }

  /** Position of a joint, counted from 0 [rad or m]. */
  q(joint: number, row: number): number {
    return this.joints[joint]?.at(row) || 0;
  }

  /** Least and greatest number of a column. */
  range(name: string): [number, number] {
    const column = this.columns.get(name);
    const known = this.ranges.get(name) ?? { range: [Infinity, -Infinity], rows: 0 };
    const { range } = known;
    for (; column && known.rows < column.length; known.rows++) {
      const value = column.at(known.rows);
      if (value < range[0]) range[0] = value;
      if (value > range[1]) range[1] = value;
    }
    this.ranges.set(name, known);
    return range[0] <= range[1] ? [...range] : [0, 0];
  }

  /** The last row at or before a time. */
  rowAt(t_s: number): number {
    const times = this.t_s;
    let low = 0, high = this.rows;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      // A time that was written down and read again may be a little before its row.
      if (times[middle]! <= t_s + 1e-6) low = middle;
      else high = middle;
    }
    return low;
  }

  modeAt(row: number): Mode {
    return this.modes[this.active[row] ?? -1] ?? NO_MODE;
  }

  /** Number of the mode, where it has one. */
  modeNumber(row: number): number | null {
    return this.called[row] ?? null;
  }

  /** Codes of what decided a tick. */
  reasons(row: number): readonly string[] {
    return this.reasonLists[this.why[row] ?? -1] ?? [];
  }

  /** When a set was active, together with whatever else. */
  activeSpans(task: Task): Span[] {
    return this.spans.filter((span) => span.mode.active.has(task.name));
  }

  /** When the mode changed [s]. */
  get changes_s(): number[] {
    return this.spans.slice(1).map((span) => span.from_s);
  }

  private add(ticks: Ticks): void {
    this.every = ticks.every;
    const modes = ticks.active_sets.map((active) => this.numberOf(active));
    const reasons = ticks.reasons.map((codes) => numbered(this.codes, this.reasonLists, codes));
    const before = this.rows;
    this.time.add(ticks.t_s);
    ticks.t_s.forEach((t_s, nth) => {
      this.active.push(modes[ticks.active[nth] ?? -1] ?? -1);
      this.why.push(reasons[ticks.why[nth] ?? -1] ?? -1);
      this.called.push(ticks.mode[nth] ?? null);
      this.extend(t_s, before + nth);
    });
    for (const [name, values] of Object.entries(ticks.columns)) {
      const column = this.columns.get(name) ?? this.newColumn(name);
      column.fill(before);
      column.add(values);
    }
    for (const column of this.columns.values()) column.fill(this.rows);
  }

  private newColumn(name: string): Growing {
    const column = new Growing();
    this.columns.set(name, column);
    const joint = /^q(\d+)_rad$/.exec(name);
    if (joint) this.joints[Number(joint[1]) - 1] = column;
    return column;
  }

  private extend(t_s: number, row: number): void {
    const span = this.spans[this.spans.length - 1];
    if (span) span.to_s = t_s;
    const mode = this.modeAt(row);
    if (span?.mode !== mode) this.spans.push({ from_s: t_s, to_s: t_s, mode });
  }

  private numberOf(active: string[]): number {
    const known = this.numbers.get(active.join("+"));
    if (known !== undefined) return known;
    const label = active.length ? active.join(" + ") : NO_MODE.label;
    this.modes.push({ active: new Set(active), label, colour: this.colours.of(active) });
    this.numbers.set(active.join("+"), this.modes.length - 1);
    return this.modes.length - 1;
  }

  private forget(): void {
    this.generation++;
    this.time.clear();
    for (const column of this.columns.values()) column.clear();
    this.ranges.clear();
    this.spans.length = 0;
    [this.active, this.why, this.called] = [[], [], []];
    this.scenes.restart(this.scene);
    this.glides.restart(NOTHING_GLIDES);
  }
}

/** The number of a list of codes among those that are known, which it joins. */
function numbered(numbers: Map<string, number>, lists: string[][], codes: string[]): number {
  const key = codes.join("+");
  const known = numbers.get(key);
  if (known !== undefined) return known;
  lists.push(codes);
  numbers.set(key, lists.length - 1);
  return lists.length - 1;
}
