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
