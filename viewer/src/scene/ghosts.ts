// Where things shall go while they are still elsewhere: an outline there, and a line from where they are.

import {
  BufferGeometry, Group, Line, LineBasicMaterial, LineDashedMaterial, Mesh, MeshBasicMaterial, SphereGeometry,
  type Vector3, WireframeGeometry, LineSegments,
} from "three";
import type { Geometry } from "../protocol";
import { discard } from "./discard";
import { geometryOf } from "./geometry";

export interface Ghost {
  /** Where it is, and where it shall be, in the world. */
  from: Vector3;
  to: Vector3;
  /** The shape, already where it shall be, in the axes of the world; `null` of a point. */
  shape: Geometry | null;
  /** Of a direction, where it is looked at from. */
  apex: Vector3 | null;
}

export class Ghosts {
  readonly object = new Group();
  private shown = "";

  constructor(private readonly reach: number) {}

  show(ghosts: Ghost[], colour: string): void {
    const key = JSON.stringify(ghosts) + colour;
    if (key === this.shown) return;
    this.shown = key;
    discard(this.object);
    for (const ghost of ghosts) this.add(ghost, colour);
  }

  private add({ from, to, shape, apex }: Ghost, color: string): void {
    if (shape) {
      // Wide meshes, so that it is told from what is really there.
      const outline = new WireframeGeometry(coarse(shape, 0.8 * this.reach));
      this.object.add(new LineSegments(outline, new LineBasicMaterial({ color, transparent: true, opacity: 0.55 })));
    }
    const dot = new Mesh(new SphereGeometry(0.012 * this.reach, 16, 10), new MeshBasicMaterial({ color }));
    dot.position.copy(to);
    const dash = 0.015 * this.reach;
    const dashed = new LineDashedMaterial({ color, dashSize: dash, gapSize: dash });
    const way = new Line(new BufferGeometry().setFromPoints(apex ? [apex, to] : [from, to]), dashed);
    way.computeLineDistances();
    this.object.add(dot, way);
  }
}

function coarse(shape: Geometry, size: number): BufferGeometry {
  return shape.type === "sphere"
    ? new SphereGeometry(shape.radius_m, 14, 10).translate(...shape.center_m)
    : geometryOf(shape, size);
}
