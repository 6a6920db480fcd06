// Three arrows at what is selected, along the axes of the world, to move it along one of them.

import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, type Raycaster, Vector3 } from "three";
import { AXES } from "../palette";

/** Length of an arrow as a share of its distance from the camera. */
const SIZE = 0.13;
const WAYS = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)] as const;

export class Arrows {
  readonly object = new Group();
  private readonly grips: Mesh[] = [];
  private readonly materials: MeshBasicMaterial[] = [];

  constructor() {
    WAYS.forEach((way, nth) => {
      const material = new MeshBasicMaterial({ color: AXES[nth]!, depthTest: false, transparent: true });
      const shaft = new Mesh(new CylinderGeometry(0.018, 0.018, 0.7, 12).translate(0, 0.55, 0), material);
      const tip = new Mesh(new ConeGeometry(0.07, 0.22, 20).translate(0, 1, 0), material);
      // A finger is wider than an arrow.
      const grip = new Mesh(new CylinderGeometry(0.12, 0.12, 1.05, 8).translate(0, 0.62, 0), material);
      grip.visible = false;
      const arrow = new Group();
      arrow.add(shaft, tip, grip);
      arrow.quaternion.setFromUnitVectors(WAYS[1], way);
      for (const part of [shaft, tip]) part.renderOrder = 10;
      this.object.add(arrow);
      this.grips.push(grip);
      this.materials.push(material);
    });
    this.object.visible = false;
  }

  /** Puts them at a place, as large as they must be to be taken hold of. */
  put(at: Vector3, camera: Vector3): void {
    this.object.position.copy(at);
    this.object.scale.setScalar(SIZE * camera.distanceTo(at));
  }

  /** The axis whose arrow a ray meets first. */
  hit(ray: Raycaster): Vector3 | null {
    if (!this.object.visible) return null;
    this.object.updateMatrixWorld();
    const hit = ray.intersectObjects(this.grips, false)[0];
    return WAYS[this.grips.findIndex((grip) => grip === hit?.object)] ?? null;
  }

  /** Makes one of them stand out. */
  light(way: Vector3 | null): void {
    this.materials.forEach((material, nth) => (material.opacity = way === null || way === WAYS[nth] ? 1 : 0.35));
  }
}
