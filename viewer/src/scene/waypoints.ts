// Where the tool should go: points, those in turn with their numbers and the distance at which they count
// as reached, and the orientation that is asked for there.

import { Group, Mesh, MeshBasicMaterial, Object3D, Quaternion, SphereGeometry, Vector3 } from "three";
import type { Quaternion as Turn, Scene, Task, Vector } from "../protocol";
import type { Run } from "../run";
import { discard } from "./discard";
import type { Frames } from "./frames";
import { Glass } from "./glass";
import type { Look } from "./look";
import { shiftAt } from "./motion";
import { triad } from "./room";

interface Goal {
  task: Task;
  label: string;
  start: Vector3;
  object: Object3D;
  dot: MeshBasicMaterial;
  glass: Glass;
}

export class Waypoints {
  private goals: Goal[] = [];
  private tasks: Task[] = [];

  constructor(private readonly run: Run, private readonly frames: Frames, private readonly reach: number) {}

  /** Takes a scene; does nothing if the same goals are in it. */
  take(scene: Scene): void {
    const wanted = scene.tasks.filter((task) => goalsOf(task).length > 0);
    if (wanted.length === this.tasks.length && wanted.every((task, nth) => task === this.tasks[nth])) return;
    for (const { object } of this.goals) {
      object.removeFromParent();
      discard(object);
    }
    this.goals = [];
    this.tasks = wanted;
    for (const task of wanted) {
      goalsOf(task).forEach((where, nth) => {
        const label = task.waypoints_m?.length ? String(nth + 1) : task.name;
        const turn = task.waypoints_quaternion_wxyz?.[nth] ?? task.desired_quaternion_wxyz;
        this.add(task, label, where, turn, this.frames.group(task.relative_to));
      });
    }
  }

  /** The one in use stands out. */
  paint(row: number, look: Look): void {
    const current = this.run.at("waypoint", row);
    for (const { task, label, dot, glass } of this.goals) {
      const isNow = !task.waypoints_m?.length || label === String(current + 1);
      dot.color.set(isNow ? look.accent : look.soft);
      glass.paint(isNow ? look.accent : look.soft, isNow ? 1.6 : 0.7);
    }
  }

  /** Brings those that move to where they are at a time. */
  update(t_s: number): void {
    for (const { task, start, object } of this.goals) {
      if (task.velocity_m_per_s) shiftAt(task, t_s, object.position).add(start);
    }
  }

  /** Numbers of those in turn, and the name of what somebody points at. */
  labels(chosen: string | null): { text: string; at: Vector3 }[] {
    const named = this.goals.filter(({ task }) => task.waypoints_m?.length || task.name === chosen);
    return named.map(({ label, object }) => ({ text: label, at: object.getWorldPosition(new Vector3()) }));
  }

  private add(task: Task, label: string, where: Vector, turn: Turn | undefined, group: Group): void {
    const dot = new MeshBasicMaterial();
    const glass = new Glass();
    const object = new Group();
    const start = new Vector3(...where);
    object.position.copy(start);
    object.add(
      new Mesh(new SphereGeometry(0.009 * this.reach, 20, 14), dot),
      new Mesh(new SphereGeometry(Math.max(task.acceptance_m ?? 0, 0.014 * this.reach), 28, 18), glass),
    );
    if (turn) {
      const [w, x, y, z] = turn;
      const desired = triad(0.07 * this.reach);
      desired.quaternion.copy(new Quaternion(x, y, z, w));
      object.add(desired);
    }
    group.add(object);
    this.goals.push({ task, label, start, object, dot, glass });
  }
}

/** The points that a task asks for. */
export function goalsOf(task: Task): readonly Vector[] {
  if (task.waypoints_m?.length) return task.waypoints_m;
  if (task.target_m) return [task.target_m];
  const [x, y, z] = task.type === "position" ? (task.desired ?? []) : [];
  return x !== undefined && y !== undefined && z !== undefined ? [[x, y, z]] : [];
}
