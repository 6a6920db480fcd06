// What a task is, how it stands, and why, in plain words.

import type { Task } from "./protocol";
import { exact, quantity, vector } from "./quantity";
import type { Run } from "./run";

/** How a task stands in one tick. */
export interface Standing {
  /** `held`: an active set; `outside`: not active, and not inside; `inside`; `equality`. */
  state: "held" | "outside" | "inside" | "equality";
  /** A word or two. */
  short: string;
  /** A sentence. */
  long: string;
}

/** Nearer than this to a border is on it [task's unit], as in the summary's properties. */
const TOLERANCE = 1e-6;

export function isSet(task: Task): boolean {
  return task.role !== "equality";
}

/** How many points, orientations or poses a task visits in turn. */
export function waypointCount(task: Task): number {
  return Math.max(task.waypoints_m?.length ?? 0, task.waypoints_quaternion_wxyz?.length ?? 0);
}

/** What is measured. */
export function measured(task: Task): string {
  const frame = task.frame ?? "tool";
  const seen = task.relative_to ? ` in ${task.relative_to}` : "";
  const of = `${frame}${seen}`;
  switch (task.type) {
    case "position":
      return `position of ${of}`;
    case "coordinate":
      return `${String(task.axis)} of ${of}`;
    case "height":
      return `height of ${of}`;
    case "distance":
      return `distance of ${of} to ${task.velocity_m_per_s ? "a moving point" : vector(task.point_m ?? [])}`;
    case "field_of_view":
      return `z axis of ${of} against ${vector(task.direction ?? [])}`;
    case "pointing_angle":
      return `angle of ${frame}'s axis to ${vector(task.direction ?? [])}${seen}`;
    case "look_at":
      return `angle of ${of}'s view to ${vector(task.point_m ?? [])}`;
    case "plane":
      return `distance of ${of} to a plane`;
    case "joint":
      return `position of joint ${task.joint}`;
    case "joint_speed":
      return `speed of joint ${task.joint}`;
    case "shapes":
      return task.between ? `gap between ${task.between[0]} and ${task.between[1]}` : "gap between two shapes";
    default:
      return `${task.type.replaceAll("_", " ")} of ${of}`;
  }
}

/** What is allowed, or asked for. */
export function asked(task: Task): string {
  const { min, max, unit } = task;
  const has = (bound: number | null | undefined): bound is number => typeof bound === "number";
  if (has(min) && has(max)) return `${exact(min, unit)} … ${exact(max, unit)}`;
  if (has(min)) return `at least ${exact(min, unit)}`;
  if (has(max)) {
    // The value of a field of view is 2 sin(angle / 2).
    const angle = task.type === "field_of_view" ? ` (${exact(2 * Math.asin(Math.min(1, max / 2)), "rad")})` : "";
    return `at most ${exact(max, unit)}${angle}`;
  }
  const count = waypointCount(task);
  if (count > 0) {
    const what = task.waypoints_m?.length ? (task.waypoints_quaternion_wxyz?.length ? "pose" : "point") : "orientation";
    return count === 1 ? `to one ${what}` : `through ${count} ${what}s`;
  }
  if (task.type === "position" && task.desired) return `to ${vector(task.desired)}`;
  if (task.value !== null && task.desired?.length === 1) return `to ${exact(task.desired[0]!, unit)}`;
  return "to a desired value";
}

/** How far inside its interval a value is; negative outside. */
export function inside(task: Task, value: number): number {
  const above = value - (task.min ?? Number.NEGATIVE_INFINITY);
  const below = (task.max ?? Number.POSITIVE_INFINITY) - value;
  return Math.min(above, below);
}

/** How a task stands at a row, and why. */
export function standing(run: Run, task: Task, row: number): Standing {
  return isSet(task) ? setStanding(run, task, row) : equalityStanding(run, task, row);
}

function setStanding(run: Run, task: Task, row: number): Standing {
  const value = run.at(task.value, row);
  const margin = inside(task, value);
  const amount = quantity(Math.abs(margin), task.unit);
  const why = run.reasons(row);
  const says = (word: string) => why.includes(`${word}:${task.name}`);
  const isLow = task.role === "low-priority set";
  const isOut = margin < -TOLERANCE;
  const leaving = says("outside")
    ? " It will be outside at the next tick: no velocity within the limits keeps every set."
    : "";
  if (run.modeAt(row).active.has(task.name)) {
    if (says("hold-inside")) {
      const long = `Frozen ${amount} inside its set: the rule found that this stops another set from being left.`;
      return { state: "held", short: "frozen inside", long: long + leaving };
    }
    if (isLow) {
      const long = `Driven back to its border, as well as the tasks above leave room.`;
      return { state: "held", short: isOut ? "driven back" : "active", long: long + leaving };
    }
    const side = value - (task.min ?? -Infinity) <= (task.max ?? Infinity) - value ? "least" : "greatest";
    const short = isOut ? (task.recovery_per_s ? "brought in" : "held outside") : `held at its ${side}`;
    const moving = task.recovery_per_s ? "brought back in" : "kept from getting worse";
    const long = isOut
      ? `Outside by ${amount}, and ${moving}.`
      : `Held at its ${side} allowed value. Let go, the tasks below would push it out.`;
    return { state: "held", short, long: long + leaving };
  }
  if (isOut) {
    const long = isLow
      ? `Outside by ${amount}. Low priority: the tasks above come first.`
      : `Outside by ${amount}, and coming in.`;
    return { state: "outside", short: "outside", long: long + leaving };
  }
  const long = says("free") ? "Just let go: it moves inward by itself." : "";
  return { state: "inside", short: `inside by ${amount}`, long: long + leaving };
}

function equalityStanding(run: Run, task: Task, row: number): Standing {
  const error = run.at(task.error, row);
  const damped = run.reasons(row).includes(`rank:${task.name}`)
    ? " Slowed where a singularity, or a task above, leaves it no direction."
    : "";
  if (task.type === "joint_speed") {
    return { state: "equality", short: "follows", long: `Follows a speed.${damped}` };
  }
  const arrived = error < arrivedBelow(task.unit);
  const yields = run.modeAt(row).active.size > 0 ? "It gets what freedom the active sets leave." : "";
  const long = arrived ? damped : `${yields}${damped}`;
  return { state: "equality", short: arrived ? "there" : "on its way", long: long.trim() };
}

function arrivedBelow(unit: string): number {
  return unit === "rad" ? 1e-3 : 5e-4;
}

/** What else decided a tick, beside what the tasks say themselves. */
export function decided(run: Run, row: number): string[] {
  return run.reasons(row).flatMap((code) => {
    const [word = "", about = ""] = code.split(/:(.*)/s);
    const joint = run.scene.robot.joints[Number(about.slice(1)) - 1]?.name ?? about;
    switch (word) {
      case "speed":
        return [`The whole velocity is shortened for the speed limit of ${joint}.`];
      case "acceleration":
        return [`The change of velocity is shortened for the acceleration limit of ${joint}.`];
      case "acceleration-exceeded":
        return [`${joint} accelerates beyond its limit: a set could not be kept otherwise.`];
      case "corrected":
        return ["Corrected, so that the next sample is inside every set."];
      case "halved":
        return ["The velocity was halved: corrections alone did not land inside every set."];
      case "cautious":
        return ["The velocity is shortened, because a tick before had to stand still."];
      case "still":
        return ["The arm stands still: no velocity was found that lands inside every set."];
      case "no-mode":
        return ["The arm stands still: the exclusions leave no mode that keeps every set."];
      case "pivots":
        return ["The search was cut off at its bound."];
      default:
        return [];
    }
  });
}

/** What another program said, as a sentence. */
export function sentence(text: string): string {
  const trimmed = text.trim();
  const begun = trimmed.charAt(0).toUpperCase() + trimmed.slice(1);
  return begun === "" || /[.!?]$/.test(begun) ? begun : `${begun}.`;
}
