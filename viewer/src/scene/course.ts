// Along what a hand drags something: in the plane that faces the camera, or along a line.

import { Plane, type Ray, Vector3 } from "three";

export interface Course {
  /** Where a ray meets it; `null` where it does not, or too far away to be meant. */
  meet: (ray: Ray) => Vector3 | null;
}

/** What is farther away than so many times as the thing that is dragged is not meant. */
const FARTHEST = 4;

/** The plane through a point that faces whoever looks that way. */
export function facing(at: Vector3, looking: Vector3): Course {
  const plane = new Plane().setFromNormalAndCoplanarPoint(looking, at);
  return {
    meet: (ray) => {
      const met = ray.intersectPlane(plane, new Vector3());
      return met && isNear(met, at, ray) ? met : null;
    },
  };
}

/** The line through a point along a direction of length 1. */
export function along(at: Vector3, direction: Vector3): Course {
  return {
    meet: (ray) => {
      // The point of the line that is nearest to the ray.
      const between = ray.origin.clone().sub(at);
      const cos = direction.dot(ray.direction);
      const across = 1 - cos * cos;
      // A line that is seen end on leads nowhere.
      if (across < 1e-3) return null;
      const way = (direction.dot(between) - cos * ray.direction.dot(between)) / across;
      const met = at.clone().addScaledVector(direction, way);
      return isNear(met, at, ray) ? met : null;
    },
  };
}

function isNear(met: Vector3, at: Vector3, ray: Ray): boolean {
  return met.distanceTo(ray.origin) < FARTHEST * at.distanceTo(ray.origin);
}
