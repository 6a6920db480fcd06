// How large everything is: what a scene is sized and framed by.

import { Vector3 } from "three";
import { Kinematics } from "../kinematics";
import type { Run } from "../run";
import { railEnds } from "./arm";
import { origin } from "./pose";
import { goalsOf } from "./waypoints";

/** What a scene is sized and framed by. */
export interface Extent {
  /** How far the arm reaches, about [m]. */
  reach: number;
  /** Middle and radius of what the camera should see. */
  middle: Vector3;
  radius: number;
  /** Height of the floor [m]. */
  floor: number;
  /** Points of the tool's path, every so many rows. */
  path: Vector3[];
}

/** At how many moments of the run the arm is looked at for its extent. */
const MOMENTS = 24;

/** `solid` are points of what stands in the room. */
export function extent(run: Run, solid: Vector3[]): Extent {
  const kinematics = new Kinematics(run.scene.robot);
  const points: Vector3[] = [];
  const path: Vector3[] = [];
  const reach = Math.max(0.2, length(run, kinematics));
  for (let moment = 0; moment <= MOMENTS; moment++) {
    const row = Math.round((moment / MOMENTS) * Math.max(0, run.rows - 1));
    kinematics.update((joint) => run.q(joint, row));
    for (const body of kinematics.bodies.slice(1)) points.push(origin(body));
    path.push(origin(kinematics.tool));
    points.push(...looks(run).map((way) => origin(kinematics.tool).addScaledVector(way, 0.3 * reach)));
  }
  for (const body of run.scene.robot.bodies) {
    if (body.parent === 0 && body.kind === "prismatic") points.push(...railEnds(run.scene.robot, body, reach));
  }
  const all = [...points, ...path, ...goals(run), ...solid.filter((point) => point.length() < 4 * reach)];
  const low = new Vector3(Infinity, Infinity, Infinity);
  const high = low.clone().negate();
  for (const point of all) {
    low.min(point);
    high.max(point);
  }
  const middle = low.clone().add(high).multiplyScalar(0.5);
  const radius = Math.max(0.3 * reach, ...all.map((point) => point.distanceTo(middle)));
  const floor = ground(run) ?? Math.floor(Math.min(0, low.z - 0.02 * reach) / 0.05) * 0.05;
  return { reach, middle, radius, floor, path };
}

/** Points that a run has not come to yet. */
function goals(run: Run): Vector3[] {
  if (!run.scene.live) return [];
  return run.scene.tasks.filter((task) => !task.relative_to).flatMap(goalsOf).map((goal) => new Vector3(...goal));
}

/** Directions in which something is looked at, and a view cone reaches. */
function looks(run: Run): Vector3[] {
  const views = run.scene.tasks.filter((task) => task.direction && !task.relative_to && !task.frame);
  return views.map((task) => new Vector3(...task.direction!));
}

/** Height of a floor that the run has itself [m]. */
function ground(run: Run): number | null {
  const floor = run.scene.obstacles.find((it) => it.type === "half_space" && it.normal[2] > 0.999);
  return floor?.type === "half_space" ? floor.point_m[2] : null;
}

/** Length of the longest chain of bodies [m]. */
function length(run: Run, kinematics: Kinematics): number {
  const lengths = [0];
  run.scene.robot.bodies.forEach((body, i) => {
    const [from, to] = [kinematics.bodies[body.parent]!, kinematics.bodies[i + 1]!];
    // What stands between the world and the first joint is no part of the arm.
    const own = body.parent === 0 ? 0 : origin(from).distanceTo(origin(to));
    lengths.push(lengths[body.parent]! + own);
  });
  return Math.max(...lengths);
}
