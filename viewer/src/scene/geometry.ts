// Geometries of the scenario's shapes, each in the frame that the shape is given in.

import {
  BoxGeometry, BufferGeometry, CapsuleGeometry, CylinderGeometry, Matrix4, PlaneGeometry, Quaternion,
  SphereGeometry, Vector3,
} from "three";
import type { Geometry, Vector } from "../protocol";

const Y = new Vector3(0, 1, 0);
const Z = new Vector3(0, 0, 1);

export function point(vector: Vector): Vector3 {
  return new Vector3(...vector);
}

/** A geometry of a shape; `size` is how much is drawn of what has no end [m]. */
export function geometryOf(shape: Geometry, size: number): BufferGeometry {
  switch (shape.type) {
    case "sphere":
      return sphere(shape.radius_m).translate(...shape.center_m);
    case "capsule":
    case "cylinder": {
      const from = point(shape.from_m), to = point(shape.to_m);
      const length = from.distanceTo(to);
      const made = shape.type === "capsule"
        ? new CapsuleGeometry(shape.radius_m, length, 10, 28)
        : new CylinderGeometry(shape.radius_m, shape.radius_m, length, 32);
      return made.applyMatrix4(along(from, to));
    }
    case "box": {
      const made = new BoxGeometry(...shape.size_m);
      const turn = point(shape.rotation_rad ?? [0, 0, 0]);
      const angle = turn.length();
      if (angle > 0) made.applyQuaternion(new Quaternion().setFromAxisAngle(turn.normalize(), angle));
      return made.translate(...shape.center_m);
    }
    case "half_space":
      return plane(point(shape.point_m), point(shape.normal), size);
  }
}

/** A square of a plane, its middle at `at`. */
export function plane(at: Vector3, normal: Vector3, size: number): BufferGeometry {
  const turn = new Quaternion().setFromUnitVectors(Z, normal.clone().normalize());
  return new PlaneGeometry(size, size).applyQuaternion(turn).translate(at.x, at.y, at.z);
}

export function sphere(radius: number): BufferGeometry {
  return new SphereGeometry(radius, 36, 24);
}

/** Takes what stands along y around the origin to what lies between two points. */
export function along(from: Vector3, to: Vector3): Matrix4 {
  const axis = to.clone().sub(from);
  const turn = axis.length() > 0 ? new Quaternion().setFromUnitVectors(Y, axis.normalize()) : new Quaternion();
  const middle = from.clone().add(to).multiplyScalar(0.5);
  return new Matrix4().compose(middle, turn, new Vector3(1, 1, 1));
}

/** Points by which a shape is seen whole; none of what has no end. */
export function corners(shape: Geometry): Vector3[] {
  switch (shape.type) {
    case "sphere":
      return around(point(shape.center_m), shape.radius_m);
    case "capsule":
    case "cylinder":
      return [...around(point(shape.from_m), shape.radius_m), ...around(point(shape.to_m), shape.radius_m)];
    case "box": {
      const box = geometryOf(shape, 0);
      box.computeBoundingBox();
      return [box.boundingBox!.min, box.boundingBox!.max];
    }
    case "half_space":
      return [];
  }
}

function around(at: Vector3, radius: number): Vector3[] {
  const step = new Vector3(radius, radius, radius);
  return [at.clone().sub(step), at.clone().add(step)];
}
