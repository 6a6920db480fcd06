// What a run that is going on and its page say to each other, version 1, as docs/page.md describes it.

import type { Outcome, Scene, StepTime, Ticks } from "../protocol";

export type Doing = "pause" | "step" | "restart" | "speed" | "change";

export interface State {
  kind: "state";
  running: "waiting" | "running" | "paused" | "ended";
  t_s: number;
  /** By how much the time of the run is faster than that on the wall, as asked for. */
  speed: number;
  allowed: Doing[];
  /** Why not all of that is allowed. */
  refusal: string | null;
  step_time_us: StepTime | null;
  deadline_misses: number;
  outcome: Outcome | null;
  viewers: number;
  revision: number;
  edited: boolean;
}

export interface Hello {
  kind: "hello";
  protocol: number;
  program: string;
}

export interface Answer {
  kind: "answer";
  id: number;
  revision?: number;
  /** A sentence, if it was not done. */
  error?: string;
}

/** The answer to `save`. */
export interface Text {
  kind: "text";
  id: number;
  name: string;
  toml: string;
}

/** Robots do not change: all scenes but the first are without. */
export type LiveScene = Omit<Scene, "robot"> & { robot: Scene["robot"] | null };

export type FromServer = Hello | LiveScene | Ticks | State | Answer | Text;

/** `null` takes away a key that need not be there. */
export type Value = number | string | readonly number[] | readonly (readonly number[])[] | null;

export type Change =
  | { task: string; key: string; value: Value; speed?: number }
  | { obstacle: string; key: string; value: Value; speed?: number }
  | { control: string; value: string }
  | { order: string[] };

export type Request =
  | { kind: "pause" | "resume" | "restart" | "reset" | "save" }
  | { kind: "step"; ticks: number }
  | { kind: "speed"; factor: number }
  | { kind: "change"; changes: Change[] };
