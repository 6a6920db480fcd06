// What the sets keep to, seen in space. It lights up while its task is active, and is drawn where it is
// while it is on its way to where it shall be.

import { EdgesGeometry, Group, LineSegments, Mesh, Raycaster, Vector3 } from "three";
import type { Glide, Scene } from "../protocol";
import type { Gliding } from "../run";
import { Balls } from "./balls";
import type { Frames } from "./frames";
import { geometryOf, point, sphere } from "./geometry";
import { Glasses, type State } from "./glass";
import type { Look } from "./look";
import { shiftAt } from "./motion";
import { type Part, parts } from "./parts";

/** Edges flatter than this are none [deg]. */
const EDGE = 25;
/** Squares of planes, as shares of the reach: of obstacles, and of bounds. */
const PLANE = 2.2;
const SMALL_PLANE = 1.76;

interface Region {
  part: Part;
  mesh: Mesh;
  edges: LineSegments | null;
  object: Group;
  /** Where its label is, in the object's frame. */
  middle: Vector3;
  /** Whether it is anywhere else than where the scene has it. */
  isAway: boolean;
}

export class Regions {
  private regions: Region[] = [];
  private readonly glasses = new Glasses();
  /** Of radius 1, for all balls. */
  private readonly ball = sphere(1);
  private readonly balls: Balls;
  private readonly shift = new Vector3();

  constructor(private readonly frames: Frames, private readonly reach: number) {
    this.balls = new Balls(frames, this.ball);
  }

  /** Takes a scene. What has not changed in it stays. */
  take(scene: Scene): void {
    const known = new Map(this.regions.map((region) => [region.part.key, region]));
    this.regions = parts(scene).map((part) => {
      const region = known.get(part.key);
      if (!region || !isSame(region.part, part)) return this.made(part);
      known.delete(part.key);
      return region;
    });
    for (const region of known.values()) this.drop(region);
  }

  /** Colours for the sets that are active; `chosen` is a task that somebody points at. */
  light(active: ReadonlySet<string>, colour: string | null, chosen: string | null, look: Look): void {
    const stateOf = ({ tasks, label, isThin }: Part): State => {
      if (tasks.some((task) => active.has(task))) return "lit";
      if (chosen !== null && (tasks.includes(chosen) || label === chosen)) return "chosen";
      return isThin ? "thin" : "rest";
    };
    const states = this.regions.map((region) => ({ region, state: stateOf(region.part) }));
    for (const { region: { part, mesh, edges }, state } of states) {
      if (!isBall(part)) mesh.material = this.glasses.glass(part.kind, state);
      if (edges) edges.material = this.glasses.edge(state);
    }
    this.balls.arrange(states.filter(({ region }) => isBall(region.part)).map(({ region, state }) => ({ ball: region, state })));
    for (const glasses of [this.glasses, this.balls]) glasses.paint(look.glass, colour ?? look.glass, look.accent);
  }

  /** The task whose region a ray meets first: of several the one that is active. Planes are behind everything. */
  pick(ray: Raycaster, active: ReadonlySet<string>): string | null {
    const { tasks } = this.hit(ray, (part) => part.tasks.length > 0)?.part ?? { tasks: [] };
    return tasks.find((task) => active.has(task)) ?? tasks[0] ?? null;
  }

  /** The body that a ray meets first of those that are wanted, and how far away. */
  hit(ray: Raycaster, isWanted: (part: Part) => boolean): { part: Part; distance: number } | null {
    const solid = this.regions.filter(({ part }) => part.kind === "solid" && isWanted(part));
    const hit = ray.intersectObjects(solid.map(({ mesh }) => mesh), false)[0];
    const region = solid.find(({ mesh }) => mesh === hit?.object);
    return hit && region ? { part: region.part, distance: hit.distance } : null;
  }

  /** What is called by its name: what is active, and what somebody points at. */
  labels(active: ReadonlySet<string>, chosen: string | null): { text: string; at: Vector3 }[] {
    return this.regions
      .filter(({ part }) => part.label === chosen || part.tasks.some((task) => active.has(task) || task === chosen))
      .map(({ part, object, middle }) => ({ text: part.label, at: object.localToWorld(middle.clone()) }));
  }

  /** Brings what moves, and what is on its way, to where it is at a time. */
  update(t_s: number, gliding: Gliding): void {
    for (const region of this.regions) {
      const { part, object } = region;
      // A shape of the robot may be called as a task is.
      const glide = part.key.startsWith("shape ") ? undefined : gliding.get(part.label);
      const isAway = glide !== undefined || part.motion?.velocity_m_per_s !== undefined;
      if (!isAway && !region.isAway) continue;
      region.isAway = isAway;
      if (part.motion) shiftAt(part.motion, t_s, object.position);
      else object.position.set(0, 0, 0);
      if (glide?.away_m) object.position.add(this.shift.set(...glide.away_m));
      this.widen(region, glide);
      object.updateMatrix();
      object.matrixWorldNeedsUpdate = true;
      if (isBall(part)) this.balls.move(region);
    }
  }

  /** Brings what a bound makes larger, or moves, to where the bound is. */
  private widen({ part, mesh, object }: Region, glide: Glide | undefined): void {
    if (!part.bound) return;
    const away = glide?.[`away_${part.bound}`] ?? 0;
    if (part.along) object.position.addScaledVector(this.shift.set(...part.along), away);
    if (part.shape.type !== "sphere") return;
    mesh.scale.setScalar(Math.max(1e-4, part.shape.radius_m + away));
    mesh.updateMatrix();
  }

  private made(part: Part): Region {
    const { shape, kind } = part;
    const size = (part.along ? SMALL_PLANE : PLANE) * this.reach;
    const geometry = shape.type === "sphere" ? this.ball : geometryOf(shape, size);
    const mesh = new Mesh(geometry);
    const object = new Group();
    object.add(mesh);
    let edges: LineSegments | null = null;
    if (kind === "sheet" || shape.type === "box" || shape.type === "cylinder") {
      edges = new LineSegments(new EdgesGeometry(geometry, EDGE));
      object.add(edges);
    }
    geometry.computeBoundingSphere();
    const middle = geometry.boundingSphere?.center.clone() ?? new Vector3();
    if (shape.type === "sphere") {
      middle.copy(point(shape.center_m));
      mesh.position.copy(middle);
      mesh.scale.setScalar(shape.radius_m);
      // Drawn with the other balls, but found by a ray.
      mesh.visible = false;
    }
    // What moves moves as a whole; nothing in it does.
    for (const each of [object, ...object.children]) {
      each.updateMatrix();
      each.matrixAutoUpdate = false;
    }
    this.frames.group(part.frame).add(object);
    return { part, mesh, edges, object, middle, isAway: false };
  }

  private drop({ mesh, edges, object }: Region): void {
    object.removeFromParent();
    if (mesh.geometry !== this.ball) mesh.geometry.dispose();
    edges?.geometry.dispose();
  }
}

function isBall({ shape }: Part): boolean {
  return shape.type === "sphere";
}

function isSame(a: Part, b: Part): boolean {
  return a.from.length === b.from.length && a.from.every((thing, nth) => thing === b.from[nth]);
}
