// Where things are that move by themselves: along a straight line, or about an axis that stays.

import { Vector3 } from "three";
import type { Motion, Vector } from "../protocol";

/** For how long it has been moving at a time [s]. */
function moved_s({ moves_until_s }: Motion, t_s: number): number {
  return Math.min(t_s, moves_until_s ?? Number.POSITIVE_INFINITY);
}

/** How far a point has moved at a time [m]. */
export function shiftAt(motion: Motion, t_s: number, into: Vector3): Vector3 {
  const velocity = motion.velocity_m_per_s;
  return velocity ? into.set(...velocity).multiplyScalar(moved_s(motion, t_s)) : into.set(0, 0, 0);
}

/** A direction that turns, at a time. */
export function directionAt(start: Vector, motion: Motion, t_s: number): Vector3 {
  const direction = new Vector3(...start);
  const turning = motion.angular_velocity_rad_per_s;
  if (!turning) return direction;
  const axis = new Vector3(...turning);
  const angle = axis.length() * moved_s(motion, t_s);
  return angle === 0 ? direction : direction.applyAxisAngle(axis.normalize(), angle);
}

/** What is at a place, or points in a direction, at the start, at a time. */
export function nowOf(start: Vector, motion: Motion, isDirection: boolean, t_s: number): Vector {
  if (isDirection) return directionAt(start, motion, t_s).toArray();
  return shiftAt(motion, t_s, new Vector3()).add(new Vector3(...start)).toArray();
}

/** Where something is at the start that is at a place, or points in a direction, at a time. */
export function startOf(now: Vector, motion: Motion, isDirection: boolean, t_s: number): Vector {
  if (!isDirection) return new Vector3(...now).sub(shiftAt(motion, t_s, new Vector3())).toArray();
  const { angular_velocity_rad_per_s: turning, ...rest } = motion;
  if (!turning) return now;
  const back = { ...rest, angular_velocity_rad_per_s: [-turning[0], -turning[1], -turning[2]] as const };
  return directionAt(now, back, t_s).toArray();
}
