// Everything of a task or an obstacle that can be changed, as numbers.

import { element } from "../element";
import type { Change, Value } from "../live/messages";
import type { Obstacle, Scene, Task, Vector } from "../protocol";
import { isSet } from "../words";
import { Field } from "./field";
import { nowOf } from "../scene/motion";
import { type Handle, handles, type Subject } from "./handles";
import { METRES, MILLIMETRES, PLAIN, type Unit, unitOf } from "./units";
import type { Workbench } from "./workbench";

/** One number: where it is in a scene, and what changes it. */
interface Entry {
  field: Field;
  value: (scene: Scene) => number | null;
}

const NAMES: Record<string, string> = {
  min: "least", max: "greatest", gain_per_s: "gain", recovery_per_s: "recovery", acceptance_m: "reached within",
  acceptance_rad: "and turned within", desired: "desired", radius_m: "radius", distance_m: "keep away by",
};

export class Editor {
  readonly element = element("div", { class: "editor" });
  private readonly entries: Entry[] = [];
  private readonly note = element("p", { class: "refusal" });

  constructor(private readonly bench: Workbench, private readonly subject: Subject) {
    const { scene } = bench.run;
    const task = scene.tasks.find(({ name }) => name === subject.name);
    const obstacle = scene.obstacles.find(({ name }) => name === subject.name);
    if (subject.kind === "task" && task) this.addTask(task);
    if (subject.kind === "obstacle" && obstacle) this.addObstacle(obstacle);
    this.addPlaces(scene);
    this.element.append(this.note);
    this.update();
  }

  /** Brings all numbers to what the scene has. */
  update(): void {
    const refusal = this.bench.refusal();
    const { scene } = this.bench.run;
    this.note.textContent = refusal ?? "";
    this.note.hidden = refusal === null;
    for (const { field, value } of this.entries) field.set(value(scene), refusal !== null);
  }

  private addTask(task: Task): void {
    const keys = isSet(task) ? SET : EQUALITY.filter((key) => typeof single(task, key) === "number");
    const row = element("div", { class: "fields" });
    for (const key of keys) {
      const isOptional = isSet(task);
      const value = (scene: Scene) => single(scene.tasks.find(({ name }) => name === task.name), key) ?? null;
      // A desired value is a list, of one number here.
      const change = (to: number | null): Change[] => {
        const meant = key === "desired" && to !== null ? [to] : to;
        return [{ task: task.name, key, value: meant }];
      };
      row.append(this.add(NAMES[key] ?? key, unitOf(task, key), value, change, isOptional, key));
    }
    if (keys.length) this.element.append(row);
  }

  private addObstacle(obstacle: Obstacle): void {
    const row = element("div", { class: "fields" });
    const keys = ["radius_m", "distance_m"].filter((key) => key in obstacle);
    for (const key of keys) {
      const value = (scene: Scene) => {
        const found = scene.obstacles.find(({ name }) => name === obstacle.name) as Record<string, unknown> | undefined;
        return (found?.[key] as number | undefined) ?? null;
      };
      const change = (to: number | null): Change[] => [{ obstacle: obstacle.name, key, value: to as Value }];
      row.append(this.add(NAMES[key]!, MILLIMETRES, value, change, key === "distance_m", key));
    }
    if (keys.length) this.element.append(row);
  }

  /** Coordinates of everything of it that can be moved. */
  private addPlaces(scene: Scene): void {
    const isOurs = ({ subject }: { subject: Subject }) =>
      subject.kind === this.subject.kind && subject.name === this.subject.name;
    for (const { id, label, kind } of handles(scene).filter(isOurs)) {
      const name = kind === "direction" ? "direction" : (/^waypoint \d+/.exec(label)?.[0] ?? "place");
      const row = element("div", { class: "fields place", role: "group", "aria-label": `${name} of ${this.subject.name}` });
      row.append(element("span", { class: "place-name" }, kind === "direction" ? name : `${name} [m]`));
      (["x", "y", "z"] as const).forEach((axis, nth) => {
        const find = (now: Scene) => handles(now).find((handle) => handle.id === id);
        const isDirection = kind === "direction";
        const placeOf = (handle: Handle) => nowOf(handle.at, handle.motion, isDirection, this.bench.t_s);
        const value = (now: Scene) => {
          const handle = find(now);
          return handle ? placeOf(handle)[nth]! : null;
        };
        const change = (to: number | null): Change[] => {
          const handle = find(this.bench.run.scene);
          if (!handle || to === null) return [];
          const at = [...placeOf(handle)] as [number, number, number];
          at[nth] = to;
          return handle.move(at as Vector);
        };
        row.append(this.add(axis, kind === "direction" ? PLAIN : METRES, value, change, false, id));
      });
      this.element.append(row);
    }
  }

  private add(
    label: string,
    unit: Unit,
    value: Entry["value"],
    change: (to: number | null) => Change[],
    isOptional: boolean,
    key: string,
  ): HTMLElement {
    const { kind, name } = this.subject;
    const field = new Field(label, unit, {
      take: (to, done) => this.bench.put(`${kind} ${name} ${key} ${label}`, change(to), done),
    }, isOptional);
    this.entries.push({ field, value });
    return field.element;
  }
}

const SET = ["min", "max", "gain_per_s", "recovery_per_s"] as const;
const EQUALITY = ["desired", "gain_per_s", "acceptance_m", "acceptance_rad"] as const;
type Key = (typeof SET)[number] | (typeof EQUALITY)[number];

/** A number of a task, where that is one. */
function single(task: Task | undefined, key: Key): number | undefined {
  const value = task?.[key];
  if (Array.isArray(value)) return task?.value !== null && value.length === 1 ? value[0] : undefined;
  return typeof value === "number" ? value : undefined;
}
