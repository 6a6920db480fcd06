// One run: its scene, what is in force, its hierarchy and its joints; and of a run that can be changed, what
// changes it.

import { Obstacles } from "./edit/obstacles";
import { Rules } from "./edit/rules";
import { taskTools } from "./edit/task_tools";
import type { Workbench } from "./edit/workbench";
import { element } from "./element";
import { Hierarchy } from "./panel/hierarchy";
import { Joints } from "./panel/joints";
import { monitors } from "./panel/monitors";
import { Now } from "./panel/now";
import type { TaskRow } from "./panel/task_row";
import type { Result } from "./protocol";
import type { Run } from "./run";
import { type Direction, Stage } from "./scene/stage";

const NO_3D = "This browser shows no 3-D graphics (WebGL), so there is no picture of the arm. Everything else is here.";

export class Pane {
  readonly element: HTMLElement;
  readonly stage: Stage | null;
  private readonly now: Now;
  private readonly hierarchy: Hierarchy;
  private readonly joints: Joints;
  private readonly obstacles: Obstacles | null;
  private readonly rules: Rules | null;
  private readonly watched = element("div");
  private result: Result | null = null;

  /** `bench` is where a run is changed that can be. */
  constructor(readonly run: Run, title: string | null, private readonly bench: Workbench | null = null) {
    this.stage = stageOf(run, bench);
    this.now = new Now(run, title);
    const equip = bench && ((row: TaskRow) => taskTools(bench, row));
    this.hierarchy = new Hierarchy(run, (task) => this.stage?.choose(task ?? bench?.name ?? null), equip);
    this.obstacles = bench && new Obstacles(bench);
    this.rules = bench && new Rules(bench);
    if (bench) bench.onComplaint = (text) => this.stage?.complain(text);
    this.joints = new Joints(run);
    if (this.stage) this.stage.onPoint = (task) => this.hierarchy.point(task);
    const picture = this.stage?.element ?? element("div", { class: "stage no-3d", role: "note" }, element("p", {}, NO_3D));
    this.element = element(
      "div",
      { class: "pane" },
      picture,
      element(
        "div",
        { class: "side" },
        this.now.element,
        element("section", { "aria-label": "Hierarchy" }, element("h2", {}, "Tasks, the most important first", filter(this.hierarchy.element)), this.hierarchy.element),
        ...(this.obstacles ? [this.obstacles.element] : []),
        ...(this.rules ? [this.rules.element] : []),
        element("section", { "aria-label": "Joints" }, element("h2", {}, "Joints: where, and below it how fast"), this.joints.element),
        this.watched,
      ),
    );
  }

  /** The row at a time. */
  rowAt(t_s: number): number {
    return this.run.rowAt(t_s);
  }

  /** Brings the scene to a time. */
  show(t_s: number): void {
    this.stage?.show(this.rowAt(t_s), t_s);
  }

  /** Brings the words and numbers to a time. */
  tell(t_s: number, isHurried: boolean, isNow = true): void {
    const row = this.rowAt(t_s);
    this.now.update(row);
    // In the past the tasks are what they were then.
    this.hierarchy.take((isNow ? this.run.scene : this.run.sceneAt(t_s)).tasks);
    this.hierarchy.update(row, isHurried, this.run.glidingAt(t_s));
    this.joints.update(row);
    const { robot } = this.run.scene;
    this.stage?.describe(`${robot.name} at ${t_s.toFixed(2)} s, ${this.run.modeAt(row).label}`);
  }

  /** Brings what changes the run to what may be changed now. */
  refresh(): void {
    this.hierarchy.updateTools();
    this.obstacles?.update();
    this.rules?.update();
    this.stage?.choose(this.bench?.name ?? null);
    this.stage?.refresh();
    const { result } = this.run.scene;
    if (result === this.result) return;
    this.result = result;
    const seen = monitors(result);
    this.watched.replaceChildren(...(seen ? [seen] : []));
  }

  paint(): void {
    this.stage?.paint();
  }

  fit(direction: Direction): void {
    this.stage?.fit(direction);
  }
}

/** Leaves out of a long list what is inside its set. */
function filter(list: HTMLElement): HTMLElement {
  const box = element("input", { type: "checkbox" });
  box.addEventListener("change", () => list.toggleAttribute("data-filtered", box.checked));
  return element("label", { class: "filter" }, box, "only what is held");
}

function stageOf(run: Run, bench: Workbench | null): Stage | null {
  try {
    return new Stage(run, bench);
  } catch {
    return null;
  }
}
