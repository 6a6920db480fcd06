// The scene of one run in three dimensions, and the camera that looks at it.

import { Object3D, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { element } from "../element";
import { Kinematics } from "../kinematics";
import type { Scene as Facts } from "../protocol";
import type { Run } from "../run";
import { Arm } from "./arm";
import { Draughtsman } from "./draughtsman";
import { Frames } from "./frames";
import { extent, type Extent } from "./extent";
import { Labels } from "./labels";
import { type Look, look } from "./look";
import { Measured } from "./measured";
import { type Bench, Mover } from "./mover";
import { solidCorners } from "./parts";
import { Path } from "./path";
import { Places } from "./places";
import { Pointer } from "./pointer";
import { Regions } from "./regions";
import { Room, triad } from "./room";
import { Views } from "./views";
import { Waypoints } from "./waypoints";

/** Height of what the camera sees [deg]. */
const FIELD = 32;
const DIRECTIONS = {
  perspective: new Vector3(0.85, -1, 0.62),
  front: new Vector3(1, 0, 0.02),
  side: new Vector3(0, -1, 0.02),
  top: new Vector3(0, -1e-3, 1),
};
export type Direction = keyof typeof DIRECTIONS;

export class Stage {
  readonly element: HTMLElement;
  /** Called when a person moves the camera. */
  onCamera: (() => void) | null = null;
  /** Told which task a person points at in the scene. */
  onPoint: ((task: string | null) => void) | null = null;
  private readonly draughtsman: Draughtsman;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(FIELD, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private readonly kinematics: Kinematics;
  private readonly extent: Extent;
  private readonly arm: Arm;
  private readonly measured: Measured;
  private readonly frames: Frames;
  private readonly regions: Regions;
  private readonly views: Views;
  private readonly path: Path;
  private readonly waypoints: Waypoints;
  private readonly room: Room;
  /** Where there is something to move. */
  private readonly mover: Mover | null = null;
  private readonly pointer: Pointer | null = null;
  private readonly labels = new Labels();
  private look: Look = look();
  private row = -1;
  private t_s = 0;
  /** The scene that is drawn, the newest one, and of which rows. */
  private shown: Facts | null = null;
  private newest: Facts | null = null;
  private generation = -1;
  private chosen: string | null = null;
  /** Where a pointer has gone to since the last frame, from -1 to 1. */
  private pointed: Vector2 | null = null;
  private readonly raycaster = new Raycaster();
  /** Of the picture [px]; whoever asks the element for it has the whole page laid out. */
  private size = { width: 0, height: 0 };
  private isDirty = true;
  private isPainted = false;
  private hasMoved = false;

  /** Throws where there is no WebGL. `bench` takes what hands do in the scene, where they may. */
  constructor(private readonly run: Run, bench: Bench | null = null) {
    this.camera.up.set(0, 0, 1);
    this.kinematics = new Kinematics(run.scene.robot);
    this.extent = extent(run, solidCorners(run.scene));
    const { reach, floor } = this.extent;
    this.frames = new Frames(run.scene.robot, this.kinematics);
    this.arm = new Arm(run.scene.robot, reach, floor);
    this.measured = new Measured(run, reach, floor);
    this.regions = new Regions(this.frames, reach);
    this.views = new Views(this.frames, reach);
    this.path = new Path(run);
    this.waypoints = new Waypoints(run, this.frames, reach);
    this.room = new Room(this.extent);
    this.draughtsman = new Draughtsman((are) => this.room.throwShadows(are));
    this.frames.tool.add(triad(0.14 * reach));
    const parts: Object3D[] = [
      this.arm.object, this.frames.object, this.views.object, this.path.object,
      this.room.object, this.measured.object, triad(0.09 * reach),
    ];
    this.scene.add(...parts);
    const { canvas } = this.draughtsman;
    canvas.setAttribute("role", "img");
    this.element = element("div", { class: "stage" }, canvas, this.labels.element);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => (this.isDirty = true));
    this.controls.addEventListener("start", () => (this.hasMoved = true));
    this.controls.addEventListener("change", () => this.onCamera?.());
    canvas.addEventListener("pointermove", (event) => this.followPointer(event));
    // Nobody points beyond the edge.
    canvas.addEventListener("pointerleave", () => (this.pointed = new Vector2(9, 9)));
    new ResizeObserver(([box]) => this.resize(box!.contentRect)).observe(this.element);
    if (bench) {
      const places = new Places(this.frames, this.views.length);
      this.mover = new Mover(run, bench, places, this.regions, this.camera, reach);
      this.pointer = new Pointer(this.element, canvas, this.mover, bench, this.controls, () => (this.isDirty = true));
      this.scene.add(this.mover.object);
      this.element.append(this.pointer.tip);
      canvas.tabIndex = 0;
    }
    this.paint();
  }

  /** Brings everything to a row. */
  show(row: number, t_s: number): void {
    this.take(t_s);
    if (row === this.row && t_s === this.t_s && this.run.generation === this.generation) return;
    this.generation = this.run.generation;
    const mode = this.run.modeAt(row);
    if (this.row < 0 || mode !== this.run.modeAt(this.row) || this.waypoint(row) !== this.waypoint(this.row)) {
      this.isPainted = false;
    }
    this.row = row;
    this.t_s = t_s;
    this.isDirty = true;
  }

  /** Draws, if anything has changed. */
  draw(): void {
    if (this.pointed) this.point(this.pointed);
    if (this.row < 0) return;
    if (!this.isDirty) {
      this.draughtsman.finish(this.scene, this.camera);
      return;
    }
    this.isDirty = false;
    this.kinematics.update((joint) => this.run.q(joint, this.row));
    const gliding = this.run.glidingAt(this.t_s);
    this.arm.update(this.kinematics);
    this.measured.update(this.row);
    this.frames.update();
    this.regions.update(this.t_s, gliding);
    this.views.update(this.t_s, gliding);
    this.waypoints.update(this.t_s);
    this.path.update(this.row);
    this.mover?.update(this.t_s, gliding);
    if (!this.isPainted) this.light();
    this.draughtsman.draw(this.scene, this.camera);
    this.placeLabels();
  }

  /** Makes a task stand out; `null`: none. */
  choose(task: string | null): void {
    if (task === this.chosen) return;
    this.chosen = task;
    this.isPainted = false;
    this.isDirty = true;
  }

  /** Takes on the colours of the theme that is in force now. */
  paint(): void {
    this.look = look();
    this.draughtsman.paint(this.look.background);
    this.arm.paint(this.look.limb, this.look.housing, this.look.ring);
    this.room.paint(this.look);
    this.path.paint(this.look);
    this.measured.paint(this.look);
    this.mover?.paint(this.look);
    this.isPainted = false;
    this.isDirty = true;
  }

  /** Looks at everything from a side. */
  fit(direction: Direction = "perspective"): void {
    const { middle, radius } = this.extent;
    const half = (FIELD / 2) * (Math.PI / 180);
    const narrow = Math.min(half, Math.atan(Math.tan(half) * this.camera.aspect));
    const distance = (0.98 * radius) / Math.sin(narrow);
    const from = DIRECTIONS[direction].clone().normalize().multiplyScalar(distance);
    this.controls.target.copy(middle);
    this.camera.position.copy(middle).add(from);
    this.camera.near = distance / 100;
    this.camera.far = distance * 12;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.hasMoved = direction !== "perspective";
  }

  /** Looks from where another stage's camera does. */
  follow(other: Stage): void {
    this.camera.position.copy(other.camera.position);
    this.controls.target.copy(other.controls.target);
    this.camera.near = other.camera.near;
    this.camera.far = other.camera.far;
    this.camera.updateProjectionMatrix();
    this.camera.lookAt(this.controls.target);
    this.isDirty = true;
  }

  /** Draws anew what hands may do: something is selected, or may not be moved any more. */
  refresh(): void {
    this.isDirty = true;
  }

  /** Moves what is selected, by steps to the right, away and up [m]. */
  nudge(right: number, away: number, up: number, step: number): void {
    this.mover?.nudge(right, away, up, step);
    this.isDirty = true;
  }

  /** Lets go of what is dragged, and back; whether anything was. */
  cancel(): boolean {
    return this.pointer?.cancel() ?? false;
  }

  /** Says beside the scene why something was not done. */
  complain(text: string): void {
    this.pointer?.complain(text);
  }

  /** What is seen, for those who do not see it. */
  describe(text: string): void {
    this.draughtsman.canvas.setAttribute("aria-label", text);
  }

  private followPointer(event: PointerEvent): void {
    // Whoever presses turns the scene.
    if (event.buttons !== 0) return;
    const { clientWidth, clientHeight } = this.element;
    this.pointed = new Vector2((2 * event.offsetX) / clientWidth - 1, 1 - (2 * event.offsetY) / clientHeight);
  }

  private point(at: Vector2): void {
    this.pointed = null;
    this.raycaster.setFromCamera(at, this.camera);
    const task = this.regions.pick(this.raycaster, this.run.modeAt(this.row).active);
    this.hover(at);
    if (task === this.chosen) return;
    this.choose(task);
    this.onPoint?.(task);
  }

  private hover(at: Vector2): void {
    if (!this.mover) return;
    const found = Math.abs(at.x) > 1 ? null : this.mover.at(at);
    this.pointer?.hover(found?.handle ?? null, at);
    this.isDirty = true;
  }

  /** Takes the scene that was in force at a time, and what shall be. */
  private take(t_s: number): void {
    const [shown, newest] = [this.run.sceneAt(t_s), this.run.scene];
    if (newest !== this.newest) {
      this.newest = newest;
      this.mover?.take();
      this.isDirty = true;
    }
    if (shown === this.shown) return;
    this.shown = shown;
    this.regions.take(shown);
    this.views.take(shown);
    this.waypoints.take(shown);
    this.isPainted = false;
    this.isDirty = true;
  }

  private waypoint(row: number): number {
    return this.run.at("waypoint", row);
  }

  private light(): void {
    const { active, colour } = this.run.modeAt(this.row);
    this.regions.light(active, colour, this.chosen, this.look);
    this.views.light(active, colour, this.chosen, this.look);
    this.waypoints.paint(this.row, this.look);
    this.isPainted = true;
  }

  private resize({ width, height }: DOMRectReadOnly): void {
    if (width === 0 || height === 0) return;
    this.size = { width, height };
    this.draughtsman.resize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (!this.hasMoved) this.fit();
    this.isDirty = true;
  }

  private placeLabels(): void {
    const { active } = this.run.modeAt(this.row);
    this.labels.place(this.camera, this.size, [
      ...this.waypoints.labels(this.chosen).map((label) => ({ ...label, kind: "waypoint" })),
      ...this.regions.labels(active, this.chosen).map((label) => ({ ...label, kind: "region" })),
      ...this.views.labels(active, this.chosen).map((label) => ({ ...label, kind: "region" })),
    ]);
  }
}
