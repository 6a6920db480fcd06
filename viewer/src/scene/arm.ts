// The arm, drawn from its joints alone: a limb from each joint to those it carries, thinner towards the
// tool, and a housing about each joint's axis. No meshes of any maker.

import {
  BoxGeometry, BufferGeometry, CylinderGeometry, Group, Matrix4, Mesh, MeshStandardMaterial, SphereGeometry,
  Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { inverse, type Kinematics, type Pose, pose } from "../kinematics";
import type { Body, Robot, Rows } from "../protocol";
import { along } from "./geometry";
import { place, setMatrix } from "./pose";

/** Shares of the reach: radius of the first limb, and of the last. */
const THICK = 0.052;
const THIN = 0.024;
/** What is shorter than this share of the reach is not drawn. */
const SHORT = 0.004;

export class Arm {
  readonly object = new Group();
  private readonly groups: Group[];
  private readonly limb = new MeshStandardMaterial({ roughness: 0.55, metalness: 0.05 });
  private readonly housing = new MeshStandardMaterial({ roughness: 0.45, metalness: 0.15 });
  private readonly ring = new MeshStandardMaterial({ roughness: 0.5, metalness: 0.1 });

  constructor(robot: Robot, reach: number, floor: number) {
    const parts = new Parts(robot, reach, floor);
    this.groups = [0, ...robot.bodies].map((_, body) => {
      const group = new Group();
      for (const [kind, material] of [["limb", this.limb], ["housing", this.housing], ["ring", this.ring]] as const) {
        const geometries = parts.of(body, kind);
        if (geometries.length === 0) continue;
        // One mesh of each material, for the sake of speed.
        const mesh = new Mesh(mergeGeometries(geometries), material);
        mesh.castShadow = mesh.receiveShadow = true;
        group.add(mesh);
      }
      return group;
    });
    this.object.add(...this.groups);
  }

  /** Takes on the colours of a theme. */
  paint(limb: string, housing: string, ring: string): void {
    this.limb.color.set(limb);
    this.housing.color.set(housing);
    this.ring.color.set(ring);
  }

  /** Makes it something that is seen through and throws no shadow. */
  fade(opacity: number): void {
    for (const material of [this.limb, this.housing, this.ring]) {
      material.transparent = true;
      material.opacity = opacity;
      material.depthWrite = false;
    }
    this.object.traverse((part) => (part.castShadow = part.receiveShadow = false));
  }

  update(kinematics: Kinematics): void {
    this.groups.forEach((group, body) => place(group, kinematics.bodies[body]!));
  }
}

type Kind = "limb" | "housing" | "ring";

/** Geometries of each body, in its frame. */
class Parts {
  private readonly made: { body: number; kind: Kind; geometry: BufferGeometry }[] = [];
  private readonly depths: number[] = [0];

  constructor(private readonly robot: Robot, private readonly reach: number, floor: number) {
    for (const body of robot.bodies) this.depths.push(this.depths[body.parent]! + 1);
    robot.bodies.forEach((body, i) => this.addJoint(body, i + 1));
    this.depths.forEach((_, body) => this.addLimbs(body));
    this.addTool();
    this.addStand(floor);
  }

  of(body: number, kind: Kind): BufferGeometry[] {
    return this.made.filter((part) => part.body === body && part.kind === kind).map((part) => part.geometry);
  }

  private add(body: number, kind: Kind, geometry: BufferGeometry, at: Matrix4): void {
    this.made.push({ body, kind, geometry: geometry.applyMatrix4(at) });
  }

  /** Radius of the limb of a body [m]. */
  private radius(body: number): number {
    const share = this.depths[body]! / Math.max(...this.depths);
    return this.reach * (THICK + (THIN - THICK) * share);
  }

  /** The housing of the joint that moves a body, on what carries it. */
  private addJoint(body: Body, index: number): void {
    const radius = this.radius(index);
    const at = matrix(body.before);
    if (body.kind === "revolute") {
      this.add(body.parent, "housing", upright(1.2 * radius, 1.2 * radius, 2.3 * radius), at);
      this.add(body.parent, "ring", upright(1.22 * radius, 1.22 * radius, 0.22 * radius), at);
      return;
    }
    const [low, high] = slides(this.robot, body, this.reach);
    const length = Math.abs(high - low);
    // Between a finger's ends a rail would be as large as the finger.
    const width = Math.min(1.1 * radius, Math.max(length / 8, 0.3 * radius));
    const rail = new BoxGeometry(width, 1.6 * width, length + 2 * width);
    this.add(body.parent, "housing", rail.translate(0, 0, (low + high) / 2), at);
    const carriage = new BoxGeometry(2.2 * width, 2.6 * width, 2.4 * width);
    this.add(index, "limb", carriage, matrix(inverse(pose(body.after))));
  }

  /** Where the joint of a body is in the body's own frame, and its axis. */
  private own(body: number): { at: Vector3; axis: Vector3 } {
    if (body === 0) return { at: this.base(), axis: new Vector3(0, 0, 1) };
    const back = inverse(pose(this.robot.bodies[body - 1]!.after));
    return { at: translation(back), axis: new Vector3(back[2], back[6], back[10]) };
  }

  /** Where the arm stands: at its base link if it has one, else at its first joint. */
  private base(): Vector3 {
    const first = this.robot.bodies.find((body) => body.parent === 0);
    const at = translation(pose(first?.before ?? []));
    const links = this.robot.links.filter((link) => link.body === 0).map((link) => translation(pose(link.placement)));
    const nearest = links.sort((a, b) => a.distanceTo(at) - b.distanceTo(at))[0];
    return nearest && nearest.distanceTo(at) < this.reach / 2 ? nearest : at;
  }

  private addLimbs(body: number): void {
    const { at, axis } = this.own(body);
    this.robot.bodies.forEach((child, i) => {
      // A rail has its own stand.
      if (child.parent !== body || (body === 0 && child.kind === "prismatic")) return;
      const to = translation(pose(child.before));
      this.addLimb(body, [at, ...bend(at, to, axis), to], this.radius(body), this.radius(i + 1));
    });
  }

  private addLimb(body: number, points: Vector3[], thick: number, thin: number): void {
    points.slice(1).forEach((to, i) => {
      const from = points[i]!;
      const length = from.distanceTo(to);
      if (length < SHORT * this.reach) return;
      this.add(body, "limb", new CylinderGeometry(thin, i === 0 ? thick : thin, length, 32), along(from, to));
      this.add(body, "limb", new SphereGeometry(thin, 28, 20), new Matrix4().setPosition(to));
    });
  }

  /** From the last joint to the tool, and a flange there. */
  private addTool(): void {
    const tool = this.robot.links[this.robot.tool]!;
    const placement = pose(tool.placement);
    const { at } = this.own(tool.body);
    const radius = 0.8 * this.radius(tool.body);
    this.addLimb(tool.body, [at, translation(placement)], radius, 0.75 * radius);
    const flange = upright(radius, radius, 0.5 * radius).translate(0, 0, -0.25 * radius);
    this.add(tool.body, "housing", flange, matrix(tool.placement));
  }

  /** What the arm stands on. */
  private addStand(floor: number): void {
    const first = this.robot.bodies.find((body) => body.parent === 0);
    if (!first) return;
    const radius = this.radius(0);
    if (first.kind === "prismatic") {
      for (const end of railEnds(this.robot, first, this.reach)) this.addPost(end, floor, 0.5 * radius);
      return;
    }
    const at = this.base();
    const plate = upright(1.7 * radius, 1.8 * radius, 0.4 * radius).translate(0, 0, 0.2 * radius);
    this.add(0, "housing", plate, new Matrix4().setPosition(at));
    const height = at.z - floor;
    // Hung from a ceiling or a wall it needs none.
    const isUpright = first.before[10]! > 0.9;
    if (isUpright && height > 0.5 * radius) this.addPost(at, floor, 1.2 * radius);
  }

  /** From a point down to the floor. */
  private addPost(at: Vector3, floor: number, radius: number): void {
    const height = at.z - floor;
    const post = upright(0.95 * radius, 1.15 * radius, Math.max(height, 0));
    this.add(0, "housing", post, new Matrix4().setPosition(at.x, at.y, floor + height / 2));
  }
}

/** Ends of the way of a joint that slides on what does not move, in the world. */
export function railEnds(robot: Robot, body: Body, reach: number): Vector3[] {
  return slides(robot, body, reach).map((end) => new Vector3(0, 0, end).applyMatrix4(matrix(body.before)));
}

/** Least and greatest position of a joint that slides [m]. */
function slides(robot: Robot, body: Body, reach: number): [number, number] {
  const [low, high] = robot.joints[body.joint]?.position_limits ?? [null, null];
  return [body.multiplier * (low ?? -reach / 2) + body.offset, body.multiplier * (high ?? reach / 2) + body.offset];
}

/** A corner on the way between two points: off the axis of the joint first, then along it. */
function bend(from: Vector3, to: Vector3, axis: Vector3): Vector3[] {
  const way = to.clone().sub(from);
  const lift = axis.clone().multiplyScalar(way.dot(axis));
  const across = way.clone().sub(lift);
  if (lift.length() < 0.15 * way.length() || across.length() < 0.15 * way.length()) return [];
  return [from.clone().add(across.length() > lift.length() ? across : lift)];
}

/** A cylinder along z, which the library makes along y. */
function upright(top: number, bottom: number, height: number): BufferGeometry {
  return new CylinderGeometry(top, bottom, height, 40).rotateX(Math.PI / 2);
}

function translation(p: Pose): Vector3 {
  return new Vector3(p[3], p[7], p[11]);
}

function matrix(rows: Rows | Pose): Matrix4 {
  const made = new Matrix4();
  setMatrix(made, rows);
  return made;
}
