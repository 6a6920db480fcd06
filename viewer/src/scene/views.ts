// View cones: where a direction may point, and where it does.

import {
  BufferGeometry, ConeGeometry, Group, Line, LineBasicMaterial, Mesh, MeshBasicMaterial, Object3D,
  SphereGeometry, TorusGeometry, Vector3,
} from "three";
import type { Glide, Scene, Task } from "../protocol";
import type { Gliding } from "../run";
import { discard } from "./discard";
import type { Frames } from "./frames";
import { point } from "./geometry";
import { Glass } from "./glass";
import type { Look } from "./look";
import { directionAt, shiftAt } from "./motion";

/** Length of a cone, as a share of the reach. */
const LENGTH = 0.3;
/** A cone wider than this is drawn as wide [rad]. */
const WIDEST = 1.3;
const Z = new Vector3(0, 0, 1);
const TYPES = ["field_of_view", "pointing_angle", "look_at"];

interface View {
  task: Task;
  cone: Group | null;
  glass: Glass | null;
  rim: MeshBasicMaterial | null;
  ray: Line<BufferGeometry, LineBasicMaterial>;
  target: Object3D | null;
}

export class Views {
  readonly object = new Group();
  /** Length of a cone [m]. */
  readonly length: number;
  private views: View[] = [];
  private readonly apex = new Vector3();
  private readonly axis = new Vector3();
  private readonly end = new Vector3();
  private readonly turn = new Vector3();

  constructor(private readonly frames: Frames, private readonly reach: number) {
    this.length = LENGTH * reach;
  }

  /** Takes a scene; does nothing if there are the same views in it. */
  take({ tasks }: Scene): void {
    const wanted = tasks.filter(({ type }) => TYPES.includes(type));
    if (wanted.length === this.views.length && wanted.every((task, nth) => task === this.views[nth]!.task)) return;
    discard(this.object);
    this.views = wanted.map((task) => this.made(task));
  }

  light(active: ReadonlySet<string>, colour: string | null, chosen: string | null, look: Look): void {
    for (const { task, glass, rim, ray } of this.views) {
      const isLit = active.has(task.name) && colour !== null;
      const isChosen = task.name === chosen;
      const paint = isLit ? colour : isChosen ? look.accent : look.glass;
      glass?.paint(paint, isLit || isChosen ? 2.2 : 1);
      rim?.color.set(paint);
      ray.material.color.set(isLit ? colour : look.soft);
    }
  }

  labels(active: ReadonlySet<string>, chosen: string | null): { text: string; at: Vector3 }[] {
    return this.views
      .filter(({ task, cone }) => cone && (active.has(task.name) || task.name === chosen))
      .map(({ task, cone }) => ({ text: task.name, at: cone!.localToWorld(new Vector3(0, 0, this.length)) }));
  }

  update(t_s: number, gliding: Gliding): void {
    for (const { task, cone, ray, target } of this.views) {
      const glide = gliding.get(task.name);
      this.frames.at(task.frame, this.apex);
      const measured = this.frames.measured(task.frame);
      if (task.type === "look_at") {
        this.frames.direction(measured, [0, 0, 1], this.axis);
        this.aim(task, t_s, glide);
        target?.position.copy(this.end);
      } else {
        const direction = directionAt(task.direction ?? [0, 0, 1], task, t_s);
        if (glide?.away_rad) rotate(direction, this.turn.set(...glide.away_rad));
        this.frames.direction(task.relative_to, direction.toArray(), this.axis);
        const own = typeof task.axis === "object" ? task.axis : [0, 0, 1];
        this.frames.direction(measured, own, this.end);
        this.end.multiplyScalar(1.25 * this.length).add(this.apex);
      }
      if (cone) {
        cone.position.copy(this.apex);
        cone.quaternion.setFromUnitVectors(Z, this.axis.normalize());
        const wide = this.radius(task, glide?.away_max ?? 0) / this.radius(task, 0);
        cone.scale.set(wide, wide, 1);
      }
      const ends = ray.geometry.getAttribute("position");
      ends.setXYZ(0, this.apex.x, this.apex.y, this.apex.z);
      ends.setXYZ(1, this.end.x, this.end.y, this.end.z);
      ends.needsUpdate = true;
    }
  }

  /** Where the point of a `look_at` is now. */
  private aim(task: Task, t_s: number, glide: Glide | undefined): void {
    const at = shiftAt(task, t_s, new Vector3()).add(point(task.point_m ?? [0, 0, 0]));
    if (glide?.away_m) at.add(this.turn.set(...glide.away_m));
    if (task.relative_to) {
      const start = this.frames.at(task.relative_to, new Vector3());
      this.frames.direction(task.relative_to, at.toArray(), this.end).add(start);
    } else {
      this.end.copy(at);
    }
  }

  /** Radius of the rim of a cone whose bound is so far from where the task has it [m]. */
  private radius(task: Task, away: number): number {
    const half = halfAngle({ ...task, max: (task.max ?? 0) + away }) ?? 0;
    return this.length * Math.tan(Math.min(Math.max(half, 1e-3), WIDEST));
  }

  private made(task: Task): View {
    const { reach } = this;
    let cone: Group | null = null, glass: Glass | null = null, rim: MeshBasicMaterial | null = null;
    if (halfAngle(task) !== null) {
      cone = new Group();
      glass = new Glass("shell");
      rim = new MeshBasicMaterial();
      const radius = this.radius(task, 0);
      // Its point at the origin, open towards z.
      const geometry = new ConeGeometry(radius, this.length, 56, 1, true)
        .translate(0, -this.length / 2, 0)
        .rotateX(-Math.PI / 2);
      const ring = new Mesh(new TorusGeometry(radius, 0.0016 * reach, 8, 72), rim);
      ring.position.z = this.length;
      cone.add(new Mesh(geometry, glass), ring);
      this.object.add(cone);
    }
    const ray = new Line(
      new BufferGeometry().setFromPoints([new Vector3(), new Vector3(0, 0, 1)]),
      new LineBasicMaterial(),
    );
    ray.frustumCulled = false;
    this.object.add(ray);
    let target: Object3D | null = null;
    if (task.type === "look_at") {
      target = new Mesh(new SphereGeometry(0.012 * reach, 20, 14), ray.material);
      this.object.add(target);
    }
    return { task, cone, glass, rim, ray, target };
  }
}

/** Turns a direction by a rotation vector. */
function rotate(direction: Vector3, turn: Vector3): void {
  const angle = turn.length();
  if (angle > 0) direction.applyAxisAngle(turn.divideScalar(angle), angle);
}

/** Half the angle of a cone [rad], of a task that has one. */
export function halfAngle(task: Task): number | null {
  if (typeof task.max !== "number") return null;
  // The value of a field of view is 2 sin(angle / 2).
  return task.type === "field_of_view" ? 2 * Math.asin(Math.min(1, task.max / 2)) : task.max;
}
