// What the sets keep to, as shapes in space: obstacles, regions around points, shapes on links, planes.

import { Vector3 } from "three";
import type { Geometry, Motion, Scene, Task, Vector } from "../protocol";
import { isSet } from "../words";
import { corners, point } from "./geometry";
import type { Kind } from "./glass";
import { cells } from "./workspace";

/** One thing that is seen through. */
export interface Part {
  /** What it is, in words that no other part has. */
  key: string;
  /** What it was made from: while all of this is the same, the part is. */
  from: readonly unknown[];
  /** Names of the tasks that it shows. */
  tasks: string[];
  /** What it is called in the scene, which is the name of its obstacle or task. */
  label: string;
  /** The link that it moves with; without one, the world. */
  frame: string | undefined;
  shape: Geometry;
  kind: Kind;
  isThin: boolean;
  motion: Motion | null;
  /** Which bound of its task it shows, and along which direction that moves it; a ball it makes larger. */
  bound: "min" | "max" | null;
  along: Vector | null;
}

type Facts = Pick<Part, "key" | "from" | "tasks" | "label" | "shape" | "kind"> & Partial<Part>;

function part(facts: Facts): Part {
  return { frame: undefined, isThin: false, motion: null, bound: null, along: null, ...facts };
}

export function parts(scene: Scene): Part[] {
  const { tasks, obstacles, shapes } = scene;
  const pairs = (name: string) => tasks.filter((task) => task.between?.includes(name)).map((task) => task.name);
  const boxes = cells(tasks);
  const sides = new Set(boxes.flatMap((box) => box.sides));
  return [
    ...obstacles.map((obstacle) => {
      const [label, isThin] = [obstacle.name, obstacle.type === "half_space"];
      const kind = isThin ? "sheet" : "solid";
      const own = pairs(label);
      return part({ key: `obstacle ${label}`, from: [obstacle, own.join()], tasks: own, label, shape: obstacle, motion: obstacle, isThin, kind });
    }),
    ...shapes.map((shape) => {
      const [label, frame] = [shape.name, shape.link];
      const own = pairs(label);
      return part({ key: `shape ${label}`, from: [shape, own.join()], tasks: own, label, frame, shape, isThin: true, kind: "solid" });
    }),
    ...boxes.map(({ name, sides, center_m, size_m }) => {
      const [frame, own] = [sides[0]!.relative_to, sides.map((side) => side.name)];
      const shape = { type: "box", center_m, size_m } as const;
      return part({ key: `cell ${name}`, from: sides, tasks: own, label: name, frame, shape, isThin: true, kind: "cell" });
    }),
    ...tasks.filter((task) => isSet(task) && !sides.has(task)).flatMap(partsOf),
  ];
}

function partsOf(task: Task): Part[] {
  const bounds = (["min", "max"] as const).filter((bound) => typeof task[bound] === "number");
  return bounds.flatMap((bound) => {
    const value = task[bound]!;
    const facts = {
      key: `task ${task.name} ${bound}`, from: [task], tasks: [task.name], label: task.name, frame: task.relative_to, bound,
    };
    if (task.type === "distance" && task.point_m) {
      if (value <= 0) return [];
      const isThin = value === task.max;
      const shape = { type: "sphere", center_m: task.point_m, radius_m: value } as const;
      const motion = task.velocity_m_per_s ? task : null;
      return [part({ ...facts, shape, motion, isThin, kind: isThin ? "shell" : "solid" })];
    }
    const normal = normalOf(task);
    if (!normal) return [];
    const at = normal.clone().multiplyScalar((task.offset_m ?? 0) + value);
    const along = normal.toArray();
    const shape = { type: "half_space", point_m: at.toArray(), normal: along } as const;
    return [part({ ...facts, shape, along, isThin: true, kind: "sheet" })];
  });
}

/** Which way a task counts along a line in space, if it does. */
function normalOf(task: Task): Vector3 | null {
  if (task.type === "plane" && task.normal) return point(task.normal).normalize();
  if (task.type === "height") return new Vector3(0, 0, 1);
  if (task.type !== "coordinate") return null;
  const axis = ["x", "y", "z"].indexOf(String(task.axis));
  return axis < 0 ? null : new Vector3().setComponent(axis, 1);
}

/** Points by which everything that stands still is seen whole. */
export function solidCorners({ tasks, obstacles }: Scene): Vector3[] {
  const regions = tasks.flatMap((task) => {
    if (task.relative_to || !task.point_m) return [];
    // A greatest distance may reach beyond everything.
    return corners({ type: "sphere", center_m: task.point_m, radius_m: task.min ?? 0 });
  });
  const boxes = cells(tasks).filter(({ sides }) => !sides[0]!.relative_to);
  const shapes = [...obstacles, ...boxes.map((box) => ({ type: "box" as const, ...box }))];
  return [...regions, ...shapes.flatMap(corners)];
}
