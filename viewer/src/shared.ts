// One scene after another, most of which is the same. What has not changed stays the same object, so that
// who draws it sees at once that there is nothing to do, and a thousand scenes take little room.

import type { Scene } from "./protocol";

/** `next`, made of the parts of `last` wherever those say the same. */
export function shared(last: Scene, next: Scene): Scene {
  return {
    ...next,
    robot: next.robot ?? last.robot,
    settings: same(last.settings, next.settings),
    shapes: each(last.shapes, next.shapes),
    obstacles: each(last.obstacles, next.obstacles),
    tasks: each(last.tasks, next.tasks),
  };
}

/** The same list if everything in it is the same. */
function each<T extends { name: string }>(last: T[], next: T[]): T[] {
  const named = new Map(last.map((thing) => [thing.name, thing]));
  const all = next.map((thing) => same(named.get(thing.name), thing));
  return all.length === last.length && all.every((thing, nth) => thing === last[nth]) ? last : all;
}

function same<T>(last: T | undefined, next: T): T {
  return JSON.stringify(last) === JSON.stringify(next) ? last! : next;
}
