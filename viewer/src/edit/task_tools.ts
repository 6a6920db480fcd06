// What changes a task, in its row of the list.

import { button, element, icon, mark, say } from "../element";
import { isListed, type RowTools } from "../panel/hierarchy";
import type { TaskRow } from "../panel/task_row";
import { gripBounds } from "./bounds";
import { Editor } from "./editor";
import { dragOrder, listed, shift } from "./order";
import type { Workbench } from "./workbench";

const PEN = "M10.5 2.5l3 3L6 13l-3.5.5L3 10z";
const UP = "M8 13V3.5M4 7l4-4 4 4";
const DOWN = "M8 3v9.5M4 9l4 4 4-4";

/** Equips a row; `null` where the task is none of the scenario's list. */
export function taskTools(bench: Workbench, row: TaskRow): RowTools | null {
  return isListed(row.task) ? new TaskTools(bench, row) : null;
}

class TaskTools implements RowTools {
  private editor: Editor | null = null;
  private readonly pen: HTMLButtonElement;
  private readonly changed = element("span", { class: "changed", title: "Not as it was at the start" }, "changed");
  private readonly error = element("p", { class: "field-error", role: "alert" });
  private readonly order: HTMLElement;
  private readonly up: HTMLButtonElement;
  private readonly down: HTMLButtonElement;
  private readonly placeBounds: (() => void) | null;

  constructor(private readonly bench: Workbench, private readonly row: TaskRow) {
    const { name } = row.task;
    const complain = (error: string | null) => this.complain(error);
    this.pen = button(`Change ${name}`, icon(PEN), () => this.toggle());
    this.pen.classList.add("pen");
    mark(this.pen, "aria-expanded", "false");
    this.up = button(`More important: ${name}`, icon(UP), () => shift(bench, name, -1, complain), "Alt+↑");
    this.down = button(`Less important: ${name}`, icon(DOWN), () => shift(bench, name, 1, complain), "Alt+↓");
    this.order = element("div", { class: "order" }, element("span", { class: "field-name" }, "priority"), this.up, this.down);
    row.head.querySelector(".name")?.after(this.changed);
    row.head.append(this.pen);
    row.element.append(this.error);
    row.element.addEventListener("keydown", (event) => this.key(event));
    row.number.title = "Drag to another place: what is higher is more important";
    dragOrder(bench, row, complain);
    this.placeBounds = row.bar ? gripBounds(bench, row, row.bar, complain) : null;
    this.error.hidden = true;
    this.update();
  }

  update(): void {
    const { bench, row } = this;
    const subject = { kind: "task", name: row.task.name } as const;
    const names = listed(bench.run.scene.tasks);
    const isRefused = bench.refusal() !== null;
    this.changed.hidden = !bench.isChanged(subject);
    this.up.disabled = isRefused || names[0] === row.task.name;
    this.down.disabled = isRefused || names[names.length - 1] === row.task.name;
    this.placeBounds?.();
    const isOpen = bench.isOpen(subject);
    mark(this.pen, "aria-expanded", String(isOpen));
    row.element.toggleAttribute("data-open", isOpen);
    if (!isOpen) {
      this.editor?.element.remove();
      this.editor = null;
    } else if (this.editor) {
      this.editor.update();
    } else {
      this.editor = new Editor(bench, subject);
      this.editor.element.prepend(this.order);
      row.element.append(this.editor.element);
      row.element.scrollIntoView({ block: "nearest" });
    }
  }

  private toggle(): void {
    const subject = { kind: "task", name: this.row.task.name } as const;
    this.bench.open(this.bench.isOpen(subject) ? null : subject);
  }

  private key(event: KeyboardEvent): void {
    if (event.target !== this.row.element) return;
    if (event.altKey && (event.key === "ArrowUp" || event.key === "ArrowDown")) {
      event.preventDefault();
      shift(this.bench, this.row.task.name, event.key === "ArrowUp" ? -1 : 1, (error) => this.complain(error));
    } else if (event.key === "Enter") {
      this.toggle();
    }
  }

  private complain(error: string | null): void {
    say(this.error, error ?? "");
    this.error.hidden = error === null;
  }
}
