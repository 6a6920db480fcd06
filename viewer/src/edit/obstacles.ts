// The obstacles of a run that can be changed, as a list: each with its numbers.

import { button, element, icon, mark } from "../element";
import type { Obstacle } from "../protocol";
import { exact } from "../quantity";
import { Editor } from "./editor";
import type { Workbench } from "./workbench";

const PEN = "M10.5 2.5l3 3L6 13l-3.5.5L3 10z";

export class Obstacles {
  readonly element: HTMLElement;
  private readonly list = element("ul", { class: "obstacles" });
  private rows: Row[] = [];
  private obstacles: Obstacle[] = [];

  constructor(private readonly bench: Workbench) {
    this.element = element("section", { "aria-label": "Obstacles" }, element("h2", {}, "Obstacles"), this.list);
    this.update();
  }

  update(): void {
    const { obstacles } = this.bench.run.scene;
    const isSame = obstacles.length === this.obstacles.length
      && obstacles.every(({ name }, nth) => name === this.obstacles[nth]!.name);
    this.obstacles = obstacles;
    this.element.hidden = obstacles.length === 0;
    if (!isSame || this.rows.length === 0) {
      this.rows = obstacles.map(({ name }) => new Row(this.bench, name));
      this.list.replaceChildren(...this.rows.map((row) => row.element));
    }
    this.rows.forEach((row, nth) => row.update(obstacles[nth]!));
  }
}

class Row {
  readonly element: HTMLLIElement;
  private readonly what = element("span", { class: "what" });
  private readonly changed = element("span", { class: "changed", title: "Not as it was at the start" }, "changed");
  private readonly pen: HTMLButtonElement;
  private editor: Editor | null = null;

  constructor(private readonly bench: Workbench, private readonly name: string) {
    this.pen = button(`Change ${name}`, icon(PEN), () => {
      const subject = { kind: "obstacle", name } as const;
      bench.open(bench.isOpen(subject) ? null : subject);
    });
    this.pen.classList.add("pen");
    const line = [element("span", { class: "name" }, name), this.changed, this.what, this.pen];
    this.element = element("li", { class: "obstacle" }, element("div", { class: "line" }, ...line));
  }

  update(obstacle: Obstacle): void {
    const subject = { kind: "obstacle", name: this.name } as const;
    const kept = obstacle.distance_m === undefined ? "keeps nothing away" : `kept ${exact(obstacle.distance_m, "m")} away`;
    this.what.textContent = `${obstacle.type.replace("_", " ")} · ${kept}`;
    this.changed.hidden = !this.bench.isChanged(subject);
    const isOpen = this.bench.isOpen(subject);
    mark(this.pen, "aria-expanded", String(isOpen));
    if (!isOpen) {
      this.editor?.element.remove();
      this.editor = null;
    } else if (this.editor) {
      this.editor.update();
    } else {
      this.editor = new Editor(this.bench, subject);
      this.element.append(this.editor.element);
      this.element.scrollIntoView({ block: "nearest" });
    }
  }
}
