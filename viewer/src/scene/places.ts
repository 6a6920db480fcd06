// Where handles are in the world, and where a place in the world is for them.

import { Matrix4, Vector3 } from "three";
import type { Handle } from "../edit/handles";
import type { Glide, Vector } from "../protocol";
import type { Frames } from "./frames";
import { directionAt, shiftAt } from "./motion";

export class Places {
  private readonly back = new Matrix4();
  private readonly apex = new Vector3();
  private readonly shift = new Vector3();

  /** `length` is how far from where it is looked from a direction is taken hold of [m]. */
  constructor(private readonly frames: Frames, private readonly length: number) {}

  /** Where a handle is at a time, or would be if it were `at`. */
  ofHandle(handle: Handle, t_s: number, at: Vector = handle.at, glide?: Glide): Vector3 {
    const { frame, kind, motion } = handle;
    if (kind === "direction") {
      const turned = directionAt(at, motion, t_s).normalize();
      const way = this.frames.direction(frame, turned.toArray(), new Vector3());
      return way.multiplyScalar(this.length).add(this.frames.at(handle.from, this.apex));
    }
    const place = shiftAt(motion, t_s, new Vector3()).add(this.shift.set(...at));
    if (glide?.away_m) place.add(this.shift.set(...glide.away_m));
    return this.frames.group(frame).localToWorld(place);
  }

  /** What a place in the world is in the axes of a handle: where it shall be now. */
  inFrame({ frame, kind, from }: Handle, place: Vector3): Vector {
    const group = this.frames.group(frame);
    if (kind !== "direction") return rounded(group.worldToLocal(place.clone()).toArray());
    const way = place.clone().sub(this.frames.at(from, this.apex));
    group.updateWorldMatrix(true, false);
    return rounded(way.transformDirection(this.back.copy(group.matrixWorld).invert()).toArray());
  }

  /** Where a direction is looked at from. */
  apexOf(handle: Handle): Vector3 {
    return this.frames.at(handle.from, new Vector3());
  }

  /** The normal of a plane, in the world. */
  normalOf({ frame, normal }: Handle): Vector3 {
    return this.frames.direction(frame, normal ?? [0, 0, 1], new Vector3()).normalize();
  }
}

/** A tenth of a millimetre is more than a hand can tell, and reads well in a file. */
function rounded(vector: readonly [number, number, number]): Vector {
  const round = (value: number) => Number(value.toFixed(4)) + 0;
  return [round(vector[0]), round(vector[1]), round(vector[2])];
}
