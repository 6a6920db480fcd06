// What a hand can take hold of in the scene, and which of it is under a pointer.

import { Group, Mesh, MeshBasicMaterial, type Raycaster, SphereGeometry, type Vector3 } from "three";
import type { Handle } from "../edit/handles";
import type { Regions } from "./regions";

/** Radii as shares of the reach: of a knob that is seen, and of what is taken for it. */
const SEEN = 0.014;
const TAKEN = 0.032;

export class Grips {
  readonly object = new Group();
  private handles: readonly Handle[] = [];
  private knobs: { handle: Handle; grip: Mesh; knob: Mesh }[] = [];
  private readonly material = new MeshBasicMaterial();
  private readonly seen: SphereGeometry;
  private readonly taken: SphereGeometry;

  constructor(reach: number, private readonly regions: Regions) {
    this.seen = new SphereGeometry(SEEN * reach, 20, 14);
    this.taken = new SphereGeometry(TAKEN * reach, 10, 8);
  }

  take(handles: readonly Handle[]): void {
    this.handles = handles;
    this.object.clear();
    this.knobs = handles.filter(({ kind }) => kind !== "body").map((handle) => {
      const [grip, knob] = [new Mesh(this.taken), new Mesh(this.seen, this.material)];
      grip.visible = false;
      // Points have their own dots.
      knob.visible = handle.kind !== "point";
      this.object.add(grip, knob);
      return { handle, grip, knob };
    });
  }

  paint(colour: string): void {
    this.material.color.set(colour);
  }

  /** Brings knobs to where their handles are. */
  update(place: (handle: Handle) => Vector3): void {
    for (const { handle, grip, knob } of this.knobs) {
      grip.position.copy(place(handle));
      knob.position.copy(grip.position);
    }
  }

  /** The handle under a ray. Knobs come before bodies: they may be inside one. */
  hit(ray: Raycaster): Handle | null {
    this.object.updateMatrixWorld();
    const [knob] = ray.intersectObjects(this.knobs.map(({ grip }) => grip), false);
    if (knob) return this.knobs.find(({ grip }) => grip === knob.object)?.handle ?? null;
    const bodies = new Map(this.handles.filter(({ kind }) => kind === "body").map((handle) => [handle.id, handle]));
    const idOf = (key: string, label: string) => (key.startsWith("task ") ? `task ${label} point_m` : key);
    const hit = this.regions.hit(ray, ({ key, label }) => bodies.has(idOf(key, label)));
    return hit ? (bodies.get(idOf(hit.part.key, hit.part.label)) ?? null) : null;
  }
}
