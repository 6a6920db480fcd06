// The plots, and the choice of what is plotted.

import type { Clock } from "../clock";
import { element } from "../element";
import type { Run } from "../run";
import { isSet } from "../words";
import { isListed } from "./hierarchy";
import { Plot, type Quantity } from "./plot";

/** Plots to begin with. */
const FIRST = 4;

export class Plots {
  readonly element: HTMLElement;
  private readonly grid = element("div", { class: "plot-grid" });
  private readonly choice = element("select", { "aria-label": "Add a plot" });
  /** The tasks and how many columns there were when it was last looked what can be plotted. */
  private known: readonly unknown[] = [];
  private all = new Map<string, { group: string; quantity: Quantity }>();
  private plots: Plot[] = [];

  constructor(private readonly runs: Run[], private readonly clock: Clock, private readonly refresh: () => void) {
    this.choice.addEventListener("change", () => {
      this.add(this.choice.value);
      this.choice.value = "";
      this.refresh();
    });
    this.fill();
    this.element = element("section", { class: "plots", "aria-label": "Plots" }, this.grid, this.choice);
  }

  /** Offers the columns that there are, and begins with some if nothing is plotted. */
  fill(): void {
    const [run] = this.runs as [Run];
    const known = [run.scene.tasks, run.names.length] as const;
    if (known.every((thing, nth) => thing === this.known[nth])) return;
    this.known = known;
    const all = quantities(run);
    if (this.all.size > 0 && this.all.size === all.size) return;
    this.all = all;
    const groups = new Map<string, HTMLOptGroupElement>();
    this.choice.replaceChildren(element("option", { value: "" }, "Add a plot …"));
    for (const [column, { group, quantity }] of this.all) {
      const list = groups.get(group) ?? element("optgroup", { label: group });
      groups.set(group, list);
      list.append(element("option", { value: column }, quantity.title));
    }
    this.choice.append(...groups.values());
    if (this.plots.length === 0) for (const column of first(this.runs[0]!)) this.add(column);
  }

  update(rows: number[]): void {
    for (const plot of this.plots) plot.update(rows);
  }

  /** Those there are, each of which can be drawn by itself. */
  get drawings(): readonly { redraw: () => void }[] {
    return this.plots;
  }

  redraw(): void {
    for (const plot of this.plots) plot.redraw();
  }

  private add(column: string): void {
    const found = this.all.get(column);
    if (!found || this.plots.some((plot) => plot.quantity.column === column)) return;
    const plot = new Plot(this.runs, this.clock, found.quantity, () => {
      this.plots = this.plots.filter((other) => other !== plot);
      plot.element.remove();
    });
    this.plots.push(plot);
    this.grid.append(plot.element);
  }
}

/** What is worth a look first: the sets that were active, longest first, and the errors. */
function first(run: Run): string[] {
  const active = (name: string) =>
    run.spans.filter((span) => span.mode.active.has(name)).reduce((sum, span) => sum + span.to_s - span.from_s, 0);
  const sets = run.scene.tasks
    .filter((task) => isSet(task) && task.value !== null && active(task.name) > 0)
    .sort((a, b) => active(b.name) - active(a.name))
    .slice(0, FIRST - 1)
    .map((task) => task.value!);
  const errors = run.scene.tasks.flatMap((task) => (task.error !== null ? [task.error] : []));
  // What somebody wrote down says more than what joints and shapes became.
  const tasks = [...run.scene.tasks.filter(isListed), ...run.scene.tasks.filter((task) => !isListed(task))];
  const rest = tasks.flatMap((task) => (isSet(task) && task.value !== null ? [task.value] : []));
  return [...new Set([...sets, ...errors, ...rest])].slice(0, FIRST);
}

function quantities(run: Run): Map<string, { group: string; quantity: Quantity }> {
  const all = new Map<string, { group: string; quantity: Quantity }>();
  for (const task of run.scene.tasks) {
    const { unit } = task;
    if (task.value !== null && run.column(task.value)) {
      all.set(task.value, { group: "Values of tasks", quantity: { column: task.value, title: task.name, unit, task } });
    }
    if (task.error !== null && run.column(task.error)) {
      const title = `error of ${task.name}`;
      all.set(task.error, { group: "Errors", quantity: { column: task.error, title, unit, task: null } });
    }
  }
  const joints = run.scene.robot.joints;
  for (const column of run.names) {
    if (all.has(column)) continue;
    const joint = /^(q|qd|qdd)(\d+)_(measured_rad|rad|rad_s|rad_s2)$/.exec(column);
    const at = joint ? joints[Number(joint[2]) - 1] : undefined;
    const [group, title] = at && joint ? [GROUPS[joint[3]!]!, `${at.name}${SUFFIX[joint[3]!]!}`] : ["Other", column];
    const own = at?.kind === "prismatic" ? "m" : "rad";
    const per = joint ? PER[joint[3]!]! : "";
    const unit = at ? `${own}${per}` : column.endsWith("_m") ? "m" : "-";
    all.set(column, { group, quantity: { column, title, unit, task: null } });
  }
  return all;
}

const GROUPS: Record<string, string> = {
  rad: "Joint positions", rad_s: "Joint speeds", rad_s2: "Joint accelerations", measured_rad: "Measured positions",
};
const SUFFIX: Record<string, string> = { rad: "", rad_s: " speed", rad_s2: " acceleration", measured_rad: " measured" };
const PER: Record<string, string> = { rad: "", rad_s: "/s", rad_s2: "/s²", measured_rad: "" };
