// The bounds of a set, dragged on its bar.

import { element } from "../element";
import type { Bar } from "../panel/bar";
import type { TaskRow } from "../panel/task_row";
import { read, type Unit, unitOf, written } from "./units";
import type { Workbench } from "./workbench";

const WORDS = { min: "least", max: "greatest" } as const;
type Bound = keyof typeof WORDS;

/** Adds to a bar a grip for each bound that its task has; returns what brings them to the scene. */
export function gripBounds(bench: Workbench, row: TaskRow, bar: Bar, complain: (error: string | null) => void): () => void {
  const grips = (["min", "max"] as const).map((bound) => grip(bench, row, bar, bound, complain));
  const place = () => grips.forEach((each) => each.place());
  bar.onScale = place;
  // Grips are taller than the bar, which shows nothing beyond itself.
  const frame = element("div", { class: "bar-frame" });
  bar.element.replaceWith(frame);
  frame.append(bar.element, ...grips.map((each) => each.element));
  place();
  return place;
}

function grip(bench: Workbench, row: TaskRow, bar: Bar, bound: Bound, complain: (error: string | null) => void) {
  const made = element("i", { class: "bound" });
  let before: number | null = null;
  const put = (value: number) => {
    made.style.left = `${100 * bar.share(value)}%`;
    const { name } = row.task;
    bench.put(`task ${name} ${bound}`, [{ task: name, key: bound, value }], complain);
  };
  const place = () => {
    const value = row.task[bound];
    made.hidden = typeof value !== "number";
    const refusal = bench.refusal();
    made.title = refusal ?? `Drag to change the ${WORDS[bound]} allowed value`;
    made.classList.toggle("is-refused", refusal !== null);
    if (typeof value === "number" && before === null) made.style.left = `${100 * bar.share(value)}%`;
  };
  made.addEventListener("pointerdown", (event) => {
    if (bench.refusal() !== null) return;
    event.preventDefault();
    event.stopPropagation();
    made.setPointerCapture(event.pointerId);
    before = row.task[bound] ?? null;
    bar.isHeld = true;
  });
  made.addEventListener("pointermove", (event) => {
    if (before === null) return;
    const box = bar.element.getBoundingClientRect();
    put(even(bar.valueAt(Math.min(1, Math.max(0, (event.clientX - box.left) / box.width))), unitOf(row.task, bound)));
  });
  const end = () => {
    before = null;
    bar.isHeld = false;
    row.take(row.task);
    place();
  };
  made.addEventListener("pointerup", end);
  made.addEventListener("pointercancel", () => {
    if (before !== null) put(before);
    end();
  });
  return { element: made, place };
}

/** A value with few digits in the unit in which it is shown. */
function even(value: number, unit: Unit): number {
  const step = unit.step / 10;
  const shown = Math.round(unit.shown(value) / step) * step;
  return read(written(unit.meant(shown), unit), unit) ?? value;
}
