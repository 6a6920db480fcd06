// What of a scene can be moved, where it is, and which change moves it.

import type { Change, Value } from "../live/messages";
import type { Geometry, Motion, Obstacle, Scene, Task, Vector } from "../protocol";

/** What something belongs to. */
export interface Subject {
  kind: "task" | "obstacle";
  name: string;
}

export interface Handle {
  /** No other handle has it. */
  id: string;
  subject: Subject;
  /** What it is, for people. */
  label: string;
  /** A `body` is moved by all of it, a `plane` along its normal, a `direction` turned; a `point` is a point. */
  kind: "point" | "body" | "plane" | "direction";
  /** Where it is in the axes of its frame, at the start if it moves by itself [m]; or a direction. */
  at: Vector;
  /** The link in whose axes it is; without one, the world. */
  frame: string | undefined;
  /** Of a direction: the link that it is looked at from. */
  from: string | undefined;
  normal: Vector | null;
  motion: Motion;
  shape: Geometry | null;
  /** What brings it to where it shall be now, in the same axes. */
  move: (to: Vector) => Change[];
}

/** Everything that can be moved. */
export function handles({ tasks, obstacles }: Scene): Handle[] {
  return [...obstacles.map(ofObstacle), ...tasks.flatMap(ofTask)];
}

function ofObstacle(obstacle: Obstacle): Handle {
  const { name } = obstacle;
  const change = (key: string, value: Value): Change => ({ obstacle: name, key, value });
  const common = {
    id: `obstacle ${name}`, subject: { kind: "obstacle" as const, name }, label: name, kind: "body" as const,
    frame: undefined, from: undefined, normal: null, motion: obstacle, shape: obstacle,
  };
  switch (obstacle.type) {
    case "sphere":
    case "box":
      return { ...common, at: obstacle.center_m, move: (to) => [change("center_m", to)] };
    case "half_space": {
      const { point_m, normal } = obstacle;
      return { ...common, kind: "plane", at: point_m, normal, move: (to) => [change("point_m", to)] };
    }
    case "capsule":
    case "cylinder": {
      const { from_m, to_m } = obstacle;
      const half = scaled(minus(to_m, from_m), 0.5);
      // Both ends, so that it keeps its length and its direction.
      const move = (to: Vector) => [change("from_m", minus(to, half)), change("to_m", plus(to, half))];
      return { ...common, at: plus(from_m, half), move };
    }
  }
}

function ofTask(task: Task): Handle[] {
  const { name } = task;
  const common = {
    subject: { kind: "task" as const, name }, kind: "point" as const, frame: task.relative_to, from: undefined,
    normal: null, motion: task, shape: null,
  };
  const change = (key: string, value: Value): Change[] => [{ task: name, key, value }];
  if (task.waypoints_m?.length) {
    const { waypoints_m } = task;
    return waypoints_m.map((at, nth) => ({
      ...common, id: `task ${name} waypoint ${nth}`, label: `waypoint ${nth + 1} of ${name}`, at,
      move: (to) => change("waypoints_m", waypoints_m.map((point, other) => (other === nth ? to : point))),
    }));
  }
  const point = (key: "point_m" | "target_m" | "desired", label: string, at: Vector): Handle[] => {
    const shape = key === "point_m" && task.type === "distance" ? ball(task, at) : null;
    const kind = shape ? "body" : "point";
    return [{ ...common, id: `task ${name} ${key}`, label, at, shape, kind, move: (to) => change(key, to) }];
  };
  if (task.point_m) return point("point_m", task.type === "look_at" ? `what ${name} looks at` : name, task.point_m);
  if (task.target_m) return point("target_m", `goal of ${name}`, task.target_m);
  const [x, y, z] = task.type === "position" ? (task.desired ?? []) : [];
  if (x !== undefined && y !== undefined && z !== undefined) return point("desired", `goal of ${name}`, [x, y, z]);
  if (task.direction && ["field_of_view", "pointing_angle"].includes(task.type)) {
    const move = (to: Vector) => change("direction", to);
    const own = { id: `task ${name} direction`, label: `direction of ${name}`, at: task.direction, from: task.frame };
    return [{ ...common, ...own, kind: "direction", move }];
  }
  return [];
}

/** The ball that is kept free, of a distance that has one. */
function ball({ min }: Task, center_m: Vector): Geometry | null {
  return typeof min === "number" && min > 0 ? { type: "sphere", center_m, radius_m: min } : null;
}

/** A shape with its middle, or a point of it, moved. */
export function moved(shape: Geometry, by: Vector): Geometry {
  switch (shape.type) {
    case "sphere":
    case "box":
      return { ...shape, center_m: plus(shape.center_m, by) };
    case "half_space":
      return { ...shape, point_m: plus(shape.point_m, by) };
    case "capsule":
    case "cylinder":
      return { ...shape, from_m: plus(shape.from_m, by), to_m: plus(shape.to_m, by) };
  }
}

export function plus(a: Vector, b: Vector): Vector {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function minus(a: Vector, b: Vector): Vector {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

function scaled([x, y, z]: Vector, by: number): Vector {
  return [x * by, y * by, z * by];
}
