// The scene of one run in three dimensions, and the camera that looks at it.

import {
  Object3D, PCFShadowMap, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { element } from "../element";
import { Kinematics } from "../kinematics";
import type { Run } from "../run";
import { Arm } from "./arm";
import { Frames } from "./frames";
import { extent, type Extent } from "./extent";
import { type Look, look } from "./look";
import { Path } from "./path";
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
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(FIELD, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private readonly kinematics: Kinematics;
  private readonly extent: Extent;
  private readonly arm: Arm;
  private readonly frames: Frames;
  private readonly regions: Regions;
  private readonly views: Views;
  private readonly path: Path;
  private readonly waypoints: Waypoints;
  private readonly room: Room;
  private readonly labels = element("div", { class: "labels", "aria-hidden": "true" });
  private look: Look = look();
  private row = -1;
  private t_s = 0;
  private chosen: string | null = null;
  /** Where a pointer has gone to since the last frame, from -1 to 1. */
  private pointed: Vector2 | null = null;
  private readonly raycaster = new Raycaster();
  private isDirty = true;
  private isPainted = false;
  private hasMoved = false;

  /** Throws where there is no WebGL. */
  constructor(private readonly run: Run) {
    this.renderer = new WebGLRenderer({ antialias: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.camera.up.set(0, 0, 1);
    this.kinematics = new Kinematics(run.scene.robot);
    this.extent = extent(run, Regions.corners(run));
    const { reach, floor } = this.extent;
    this.frames = new Frames(run.scene.robot, this.kinematics);
    this.arm = new Arm(run.scene.robot, reach, floor);
    this.regions = new Regions(run, this.frames, reach);
    this.views = new Views(run, this.frames, reach);
    this.path = new Path(run);
    this.waypoints = new Waypoints(run, this.frames, reach);
    this.room = new Room(this.extent);
    this.frames.tool.add(triad(0.14 * reach));
    const parts: Object3D[] = [
      this.arm.object, this.frames.object, this.views.object, this.path.object,
      this.room.object, triad(0.09 * reach),
    ];
    this.scene.add(...parts);
    const canvas = this.renderer.domElement;
    canvas.setAttribute("role", "img");
    this.element = element("div", { class: "stage" }, canvas, this.labels);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => (this.isDirty = true));
    this.controls.addEventListener("start", () => (this.hasMoved = true));
    this.controls.addEventListener("change", () => this.onCamera?.());
    canvas.addEventListener("pointermove", (event) => this.followPointer(event));
    // Nobody points beyond the edge.
    canvas.addEventListener("pointerleave", () => (this.pointed = new Vector2(9, 9)));
    new ResizeObserver(() => this.resize()).observe(this.element);
    this.paint();
  }

  /** Brings everything to a row. */
  show(row: number, t_s: number): void {
    if (row === this.row && t_s === this.t_s) return;
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
    if (!this.isDirty || this.row < 0) return;
    this.isDirty = false;
    this.kinematics.update((joint) => this.run.q(joint, this.row));
    this.arm.update(this.kinematics);
    this.frames.update();
    this.regions.update(this.t_s);
    this.views.update(this.t_s);
    this.waypoints.update(this.t_s);
    this.path.update(this.row);
    if (!this.isPainted) this.light();
    this.renderer.render(this.scene, this.camera);
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
    this.renderer.setClearColor(this.look.background);
    this.arm.paint(this.look.limb, this.look.housing, this.look.ring);
    this.room.paint(this.look);
    this.path.paint(this.look);
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

  /** What is seen, for those who do not see it. */
  describe(text: string): void {
    this.renderer.domElement.setAttribute("aria-label", text);
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
    if (task === this.chosen) return;
    this.choose(task);
    this.onPoint?.(task);
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

  private resize(): void {
    const { clientWidth, clientHeight } = this.element;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    if (!this.hasMoved) this.fit();
    this.isDirty = true;
  }

  private placeLabels(): void {
    const { active } = this.run.modeAt(this.row);
    const shown = [
      ...this.waypoints.labels(this.chosen).map((label) => ({ ...label, kind: "waypoint" })),
      ...this.regions.labels(active, this.chosen).map((label) => ({ ...label, kind: "region" })),
      ...this.views.labels(active, this.chosen).map((label) => ({ ...label, kind: "region" })),
    ];
    while (this.labels.children.length < shown.length) this.labels.append(element("span"));
    const { clientWidth, clientHeight } = this.element;
    [...this.labels.children].forEach((child, i) => {
      const node = child as HTMLElement;
      const label = shown[i];
      node.hidden = !label;
      if (!label) return;
      if (node.textContent !== label.text) node.textContent = label.text;
      if (node.className !== label.kind) node.className = label.kind;
      const { x, y, z } = label.at.project(this.camera);
      node.hidden = z > 1;
      node.style.transform = `translate(${((x + 1) / 2) * clientWidth}px, ${((1 - y) / 2) * clientHeight}px)`;
    });
  }
}
