// What the sets keep to, seen in space: obstacles, regions around points, shapes on links, planes. They
// light up while their task is active.

import { BufferGeometry, EdgesGeometry, Group, LineSegments, Mesh, Object3D, Raycaster, Vector3 } from "three";
import type { Geometry, Motion, Obstacle, LinkShape, Task } from "../protocol";
import type { Run } from "../run";
import { isSet } from "../words";
import type { Frames } from "./frames";
import { corners, geometryOf, plane, point, sphere } from "./geometry";
import { Glasses, type Kind } from "./glass";
import type { Look } from "./look";
import { shiftAt } from "./motion";
import { type Cell, cells } from "./workspace";

/** Edges flatter than this are none [deg]. */
const EDGE = 25;
/** A square of a plane, as a share of the reach. */
const PLANE = 2.2;

/** One thing that is seen through. */
interface Region {
  /** Names of the tasks that it shows. */
  tasks: string[];
  /** What it is called in the scene. */
  label: string;
  kind: Kind;
  mesh: Mesh;
  edges: LineSegments | null;
  object: Object3D;
  /** Where its label is, in the object's frame. */
  middle: Vector3;
  motion: Motion | null;
  isThin: boolean;
}

export class Regions {
  private readonly regions: Region[] = [];
  private readonly glasses = new Glasses();
  /** Of radius 1, for all balls. */
  private readonly ball = sphere(1);

  constructor(run: Run, frames: Frames, reach: number) {
    const { scene } = run;
    const tasks = scene.tasks;
    const pairs = (name: string) =>
      tasks.filter((task) => task.between?.includes(name)).map((task) => task.name);
    for (const obstacle of scene.obstacles) this.addObstacle(obstacle, pairs(obstacle.name), frames, reach);
    for (const shape of scene.shapes) this.addLinkShape(shape, pairs(shape.name), frames, reach);
    const boxes = cells(tasks);
    for (const box of boxes) this.addCell(box, frames);
    const sides = new Set(boxes.flatMap((box) => box.sides));
    for (const task of tasks.filter(isSet)) if (!sides.has(task)) this.addTask(task, frames, reach);
  }

  /** Points by which everything that stands still is seen whole. */
  static corners(run: Run): Vector3[] {
    const regions = run.scene.tasks.flatMap((task) => {
      if (task.relative_to || !task.point_m) return [];
      // A greatest distance may reach beyond everything.
      return corners({ type: "sphere", center_m: task.point_m, radius_m: task.min ?? 0 });
    });
    const boxes = cells(run.scene.tasks).filter(({ sides }) => !sides[0]!.relative_to);
    const shapes = [...run.scene.obstacles, ...boxes.map((box) => ({ type: "box" as const, ...box }))];
    return [...regions, ...shapes.flatMap(corners)];
  }

  /** Colours for the sets that are active; `chosen` is a task that somebody points at. */
  light(active: ReadonlySet<string>, colour: string | null, chosen: string | null, look: Look): void {
    for (const region of this.regions) {
      const isLit = region.tasks.some((task) => active.has(task));
      const isChosen = chosen !== null && region.tasks.includes(chosen);
      const state = isLit ? "lit" : isChosen ? "chosen" : region.isThin ? "thin" : "rest";
      region.mesh.material = this.glasses.glass(region.kind, state);
      if (region.edges) region.edges.material = this.glasses.edge(state);
    }
    this.glasses.paint(look.glass, colour ?? look.glass, look.accent);
  }

  /** The task whose region a ray meets first: of several the one that is active. Planes are behind everything. */
  pick(ray: Raycaster, active: ReadonlySet<string>): string | null {
    const solid = this.regions.filter(({ kind, tasks }) => kind === "solid" && tasks.length > 0);
    const hit = ray.intersectObjects(solid.map(({ mesh }) => mesh), false)[0];
    const tasks = solid.find(({ mesh }) => mesh === hit?.object)?.tasks ?? [];
    return tasks.find((task) => active.has(task)) ?? tasks[0] ?? null;
  }

  /** What is called by its name: what is active, and what somebody points at. */
  labels(active: ReadonlySet<string>, chosen: string | null): { text: string; at: Vector3 }[] {
    return this.regions
      .filter(({ tasks }) => tasks.some((task) => active.has(task) || task === chosen))
      .map(({ label, object, middle }) => ({ text: label, at: object.localToWorld(middle.clone()) }));
  }

  /** Brings what moves to where it is at a time. */
  update(t_s: number): void {
    for (const { motion, object } of this.regions) {
      if (motion?.velocity_m_per_s) shiftAt(motion, t_s, object.position);
    }
  }

  private addObstacle(obstacle: Obstacle, tasks: string[], frames: Frames, reach: number): void {
    const geometry = this.geometry(obstacle, reach);
    const isThin = obstacle.type === "half_space";
    this.add(frames.group(undefined), geometry, { tasks, label: obstacle.name, motion: obstacle, isThin, shape: obstacle, kind: isThin ? "sheet" : "solid" });
  }

  private addLinkShape(shape: LinkShape, tasks: string[], frames: Frames, reach: number): void {
    const geometry = this.geometry(shape, reach);
    this.add(frames.group(shape.link), geometry, { tasks, label: shape.name, motion: null, isThin: true, shape, kind: "solid" });
  }

  private addCell({ name, sides, center_m, size_m }: Cell, frames: Frames): void {
    const shape = { type: "box", center_m, size_m } as const;
    const tasks = sides.map((side) => side.name);
    const facts = { tasks, label: name, motion: null, isThin: true, shape, kind: "cell" } as const;
    this.add(frames.group(sides[0]!.relative_to), geometryOf(shape, 0), facts);
  }

  private addTask(task: Task, frames: Frames, reach: number): void {
    const group = frames.group(task.relative_to);
    const label = task.name;
    const motion = task.velocity_m_per_s ? task : null;
    const bounds = [task.min, task.max].filter((bound) => typeof bound === "number");
    if (task.type === "distance" && task.point_m) {
      for (const bound of bounds.filter((radius) => radius > 0)) {
        const shape = { type: "sphere", center_m: task.point_m, radius_m: bound } as const;
        const isThin = bound === task.max;
        this.add(group, this.ball, { tasks: [label], label, motion, isThin, shape, kind: isThin ? "shell" : "solid" });
      }
    }
    const normal = normalOf(task);
    if (!normal) return;
    for (const bound of bounds) {
      const at = normal.clone().multiplyScalar((task.offset_m ?? 0) + bound);
      const geometry = plane(at, normal, 0.8 * PLANE * reach);
      this.add(group, geometry, { tasks: [label], label, motion: null, isThin: true, shape: null, kind: "sheet" });
    }
  }

  private geometry(shape: Geometry, reach: number): BufferGeometry {
    return shape.type === "sphere" ? this.ball : geometryOf(shape, PLANE * reach);
  }

  private add(
    group: Group,
    geometry: BufferGeometry,
    { shape, ...facts }: Omit<Region, "mesh" | "edges" | "object" | "middle"> & { shape: Geometry | null },
  ): void {
    const mesh = new Mesh(geometry);
    const object = new Group();
    object.add(mesh);
    let edges: LineSegments | null = null;
    if (!shape || facts.kind === "sheet" || shape.type === "box" || shape.type === "cylinder") {
      edges = new LineSegments(new EdgesGeometry(geometry, EDGE));
      object.add(edges);
    }
    geometry.computeBoundingSphere();
    const middle = geometry.boundingSphere?.center.clone() ?? new Vector3();
    if (shape?.type === "sphere") {
      middle.copy(point(shape.center_m));
      mesh.position.copy(middle);
      mesh.scale.setScalar(shape.radius_m);
    }
    // What moves by itself moves as a whole; nothing in it does.
    for (const part of object.children) {
      part.updateMatrix();
      part.matrixAutoUpdate = false;
    }
    if (!facts.motion?.velocity_m_per_s) object.matrixAutoUpdate = false;
    group.add(object);
    this.regions.push({ ...facts, mesh, edges, object, middle });
  }
}

/** Which way a task counts along a line in space, if it does. */
function normalOf(task: Task): Vector3 | null {
  if (task.type === "plane" && task.normal) return point(task.normal).normalize();
  if (task.type === "height") return new Vector3(0, 0, 1);
  if (task.type !== "coordinate") return null;
  const axis = ["x", "y", "z"].indexOf(String(task.axis));
  return axis < 0 ? null : new Vector3().setComponent(axis, 1);
}
