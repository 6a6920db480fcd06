// From the page's poses to those of the 3-D library.

import { Matrix4, Object3D, Vector3 } from "three";
import type { Pose } from "../kinematics";

/** Puts an object at a pose. */
export function place(object: Object3D, pose: ArrayLike<number>): void {
  object.matrixAutoUpdate = false;
  setMatrix(object.matrix, pose);
  object.matrixWorldNeedsUpdate = true;
}

export function setMatrix(matrix: Matrix4, p: ArrayLike<number>): void {
  matrix.set(
    p[0]!, p[1]!, p[2]!, p[3]!,
    p[4]!, p[5]!, p[6]!, p[7]!,
    p[8]!, p[9]!, p[10]!, p[11]!,
    0, 0, 0, 1,
  );
}

export function origin(pose: Pose, into = new Vector3()): Vector3 {
  return into.set(pose[3]!, pose[7]!, pose[11]!);
}
