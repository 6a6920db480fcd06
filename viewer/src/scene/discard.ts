// Takes out of a scene what is not wanted any more, and gives back what the graphics hold for it.

import { Line, type Material, Mesh, type Object3D } from "three";

/** Everything in an object, at any depth. What is shared with others must not be in it. */
export function discard(object: Object3D): void {
  object.traverse((part) => {
    if (!(part instanceof Mesh || part instanceof Line)) return;
    part.geometry.dispose();
    (part.material as Material).dispose();
  });
  object.clear();
}
