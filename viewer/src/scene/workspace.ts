// Boxes that are not left: a `workspace` of the scenario becomes a set for each axis, and here they are
// together again.

import type { Task, Vector } from "../protocol";

export interface Cell {
  name: string;
  /** The sets of x, y and z. */
  sides: Task[];
  center_m: Vector;
  size_m: Vector;
}

export function cells(tasks: readonly Task[]): Cell[] {
  const named = new Map(tasks.filter(isWall).map((task) => [task.name, task]));
  const names = [...named.keys()].filter((name) => name.endsWith("/x")).map((name) => name.slice(0, -2));
  return names.flatMap((name) => {
    const [x, y, z] = ["x", "y", "z"].map((axis) => named.get(`${name}/${axis}`));
    if (!x || !y || !z) return [];
    const middle = ({ min, max }: Wall) => (min + max) / 2;
    const size = ({ min, max }: Wall) => max - min;
    return [{
      name,
      sides: [x, y, z],
      center_m: [middle(x), middle(y), middle(z)] as const,
      size_m: [size(x), size(y), size(z)] as const,
    }];
  });
}

type Wall = Task & { min: number; max: number };

function isWall(task: Task): task is Wall {
  return task.type === "coordinate" && typeof task.min === "number" && typeof task.max === "number";
}
