// A hand in the scene: what it points at, drags and lets go.

import { type Camera, Group, Raycaster, Vector2, Vector3 } from "three";
import { type Handle, handles, minus, moved } from "../edit/handles";
import type { Scene, Vector } from "../protocol";
import type { Gliding, Run } from "../run";
import { Arrows } from "./arrows";
import { along, type Course, facing } from "./course";
import { type Ghost, Ghosts } from "./ghosts";
import { Grips } from "./grips";
import type { Look } from "./look";
import { nowOf, startOf } from "./motion";
import type { Places } from "./places";
import type { Regions } from "./regions";

/** Who takes what the hand does. */
export interface Bench {
  /** Why nothing can be moved now; `null`: it can. */
  refusal: () => string | null;
  /** Moves something to where it shall be now; told when that is answered. */
  move: (handle: Handle, to: Vector, done: () => void) => void;
  select: (handle: Handle | null) => void;
  /** Id of the handle that is selected. */
  selected: () => string | null;
}

interface Drag {
  handle: Handle;
  course: Course;
  /** Where it was and where it was taken hold of, in the world; and where it was in its own axes. */
  start: Vector3;
  taken: Vector3;
  before: Vector;
  way: Vector3 | null;
  hasMoved: boolean;
}

export class Mover {
  readonly object = new Group();
  private scene: Scene | null = null;
  private all: Handle[] = [];
  private drag: Drag | null = null;
  /** Where something is that was moved and has no answer yet. */
  private local: { id: string; at: Vector } | null = null;
  private sent = 0;
  private t_s = 0;
  private readonly arrows = new Arrows();
  private readonly ghosts: Ghosts;
  private readonly grips: Grips;
  private readonly ray = new Raycaster();
  private colour = "";

  constructor(
    private readonly run: Run,
    private readonly bench: Bench,
    private readonly places: Places,
    regions: Regions,
    private readonly camera: Camera,
    reach: number,
  ) {
    this.ghosts = new Ghosts(reach);
    this.grips = new Grips(reach, regions);
    this.object.add(this.grips.object, this.ghosts.object, this.arrows.object);
  }

  get isDragging(): boolean {
    return this.drag !== null;
  }

  /** Takes the newest scene, of which a key or a press may come before the next frame. */
  take(): void {
    if (this.scene === this.run.scene) return;
    this.scene = this.run.scene;
    this.all = handles(this.scene);
    this.grips.take(this.all);
  }

  paint({ accent }: Look): void {
    this.colour = accent;
    this.grips.paint(accent);
  }

  /** The handle under a pointer, from -1 to 1, and the axis if it is that of an arrow. */
  at(pointer: Vector2): { handle: Handle; way: Vector3 | null } | null {
    this.take();
    this.ray.setFromCamera(pointer, this.camera);
    const way = this.arrows.hit(this.ray);
    const selected = this.selected();
    if (!this.drag) this.arrows.light(way);
    if (way && selected) return { handle: selected, way };
    const handle = this.grips.hit(this.ray);
    return handle && { handle, way: null };
  }

  /** Takes hold of what is under a pointer; whether there was anything to take. */
  begin(pointer: Vector2): boolean {
    const found = this.at(pointer);
    if (!found || this.bench.refusal() !== null) return false;
    const { handle, way } = found;
    this.bench.select(handle);
    const start = this.places.ofHandle(handle, this.t_s, this.localOf(handle));
    const course = this.course(handle, start, way);
    const taken = course.meet(this.ray.ray) ?? start.clone();
    this.drag = { handle, course, start, taken, before: handle.at, way, hasMoved: false };
    return true;
  }

  /** Drags to where a pointer is. */
  move(pointer: Vector2): void {
    const { drag } = this;
    if (!drag) return;
    this.ray.setFromCamera(pointer, this.camera);
    const met = drag.course.meet(this.ray.ray);
    if (!met) return;
    drag.hasMoved = true;
    this.send(drag.handle, drag.start.clone().add(met).sub(drag.taken));
  }

  /** Lets go; whether anything was moved. */
  end(): boolean {
    const hasMoved = this.drag?.hasMoved ?? false;
    this.drag = null;
    if (this.sent === 0) this.local = null;
    return hasMoved;
  }

  /** Lets go, and back to where it was; whether anything was in hand. */
  cancel(): boolean {
    const { drag } = this;
    if (!drag) return false;
    this.drag = null;
    const { handle, before } = drag;
    if (drag.hasMoved) this.put(handle, nowOf(before, handle.motion, handle.kind === "direction", this.t_s));
    return true;
  }

  /** Moves what is selected by so many steps to the right, away and up, as the camera sees it. */
  nudge(right: number, away: number, up: number, step: number): void {
    this.take();
    const handle = this.selected();
    if (!handle || this.bench.refusal() !== null) return;
    const seen = new Vector3(1, 0, 0).transformDirection(this.camera.matrixWorld);
    // Along the axes of the world that are nearest to that.
    const side = Math.abs(seen.x) > Math.abs(seen.y)
      ? new Vector3(Math.sign(seen.x), 0, 0)
      : new Vector3(0, Math.sign(seen.y), 0);
    const ahead = new Vector3(0, 0, 1).cross(side);
    const by = side.multiplyScalar(right).addScaledVector(ahead, away).add(new Vector3(0, 0, up));
    if (handle.kind === "plane") {
      const normal = this.places.normalOf(handle);
      by.copy(normal.multiplyScalar(Math.sign(normal.dot(by)) || 0));
    }
    const place = this.places.ofHandle(handle, this.t_s, this.localOf(handle));
    this.send(handle, place.addScaledVector(by, step));
  }

  update(t_s: number, gliding: Gliding): void {
    this.t_s = t_s;
    const isRefused = this.bench.refusal() !== null;
    this.grips.object.visible = !isRefused;
    this.grips.update((handle) => this.places.ofHandle(handle, t_s, this.localOf(handle)));
    this.ghosts.show(this.wanted(t_s, gliding), this.colour);
    const selected = this.selected();
    const isShown = selected !== null && !isRefused && (!this.drag || this.drag.way !== null);
    this.arrows.object.visible = isShown && selected.kind !== "plane";
    if (isShown) this.arrows.put(this.places.ofHandle(selected, t_s, this.localOf(selected)), this.camera.position);
  }

  private course(handle: Handle, start: Vector3, way: Vector3 | null): Course {
    if (way) return along(start, way);
    if (handle.kind === "plane") return along(start, this.places.normalOf(handle));
    return facing(start, this.camera.getWorldDirection(new Vector3()));
  }

  private selected(): Handle | null {
    const id = this.bench.selected();
    return this.all.find((handle) => handle.id === id) ?? null;
  }

  private localOf({ id, at }: Handle): Vector {
    return this.local?.id === id ? this.local.at : at;
  }

  private send(handle: Handle, place: Vector3): void {
    this.put(handle, this.places.inFrame(handle, place));
  }

  /** Sends where something shall be now. */
  private put(handle: Handle, now: Vector): void {
    this.local = { id: handle.id, at: startOf(now, handle.motion, handle.kind === "direction", this.t_s) };
    const sent = ++this.sent;
    this.bench.move(handle, now, () => {
      // Only the last answer counts: those before it were overtaken.
      if (sent !== this.sent) return;
      this.sent = 0;
      if (!this.drag) this.local = null;
    });
  }

  /** Everything that is elsewhere than it shall be. */
  private wanted(t_s: number, gliding: Gliding): Ghost[] {
    const shown = this.run.sceneAt(t_s);
    const isBehind = shown !== this.run.scene;
    const was = isBehind ? new Map(handles(shown).map((handle) => [handle.id, handle.at])) : null;
    return this.all.flatMap((handle) => {
      const glide = gliding.get(handle.subject.name);
      const isGliding = handle.kind === "direction" ? glide?.away_rad !== undefined : glide?.away_m !== undefined;
      const before = was?.get(handle.id) ?? handle.at;
      const isLocal = this.local?.id === handle.id;
      if (!isGliding && !isLocal && String(before) === String(handle.at)) return [];
      const from = this.places.ofHandle(handle, t_s, before, glide);
      const to = this.places.ofHandle(handle, t_s, this.localOf(handle));
      const shape = handle.shape && handle.frame === undefined ? moved(handle.shape, minus(to.toArray(), handle.at)) : null;
      return [{ from, to, shape, apex: handle.kind === "direction" ? this.places.apexOf(handle) : null }];
    });
  }
}
