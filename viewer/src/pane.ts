// One run: its scene, what is in force, its hierarchy and its joints.

import { element } from "./element";
import { Hierarchy } from "./panel/hierarchy";
import { Joints } from "./panel/joints";
import { Now } from "./panel/now";
import type { Run } from "./run";
import { type Direction, Stage } from "./scene/stage";

const NO_3D = "This browser shows no 3-D graphics (WebGL), so there is no picture of the arm. Everything else is here.";

export class Pane {
  readonly element: HTMLElement;
  readonly stage: Stage | null;
  private readonly now: Now;
  private readonly hierarchy: Hierarchy;
  private readonly joints: Joints;

  constructor(readonly run: Run, title: string | null) {
    this.stage = stageOf(run);
    this.now = new Now(run, title);
    this.hierarchy = new Hierarchy(run, (task) => this.stage?.choose(task));
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
        element("section", { "aria-label": "Joints" }, element("h2", {}, "Joints: where, and below it how fast"), this.joints.element),
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
  tell(t_s: number, isHurried: boolean): void {
    const row = this.rowAt(t_s);
    this.now.update(row);
    this.hierarchy.update(row, isHurried);
    this.joints.update(row);
    const { robot } = this.run.scene;
    this.stage?.describe(`${robot.name} at ${t_s.toFixed(2)} s, ${this.run.modeAt(row).label}`);
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

function stageOf(run: Run): Stage | null {
  try {
    return new Stage(run);
  } catch {
    return null;
  }
}
