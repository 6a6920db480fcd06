// Numbers as people enter them: in the units in which the page shows them.

import type { Task } from "../protocol";

/** How a number is written, and what it means. */
export interface Unit {
  name: string;
  /** From what the run has to what is written, and back. */
  shown: (value: number) => number;
  meant: (shown: number) => number;
  /** Of a press of an arrow key. */
  step: number;
}

function scaled(name: string, factor: number, step: number): Unit {
  return { name, shown: (value) => value * factor, meant: (shown) => shown / factor, step };
}

const DEGREES = 180 / Math.PI;
export const METRES = scaled("m", 1, 0.01);
export const MILLIMETRES = scaled("mm", 1e3, 5);
export const PLAIN = scaled("", 1, 0.05);
const ANGLE = scaled("°", DEGREES, 1);
const GAIN = scaled("1/s", 1, 0.1);
/** The value of a field of view is 2 sin(angle / 2). */
const VIEW: Unit = {
  name: "°",
  shown: (value) => 2 * Math.asin(Math.min(1, Math.max(-1, value / 2))) * DEGREES,
  meant: (shown) => 2 * Math.sin(shown / DEGREES / 2),
  step: 1,
};

/** The unit of a number of a task. */
export function unitOf(task: Task, key: string): Unit {
  switch (key) {
    case "gain_per_s":
      return GAIN;
    case "acceptance_m":
      return MILLIMETRES;
    case "acceptance_rad":
      return ANGLE;
    case "recovery_per_s":
      return perSecond(ofValue(task.unit));
    default:
      return task.type === "field_of_view" ? VIEW : ofValue(task.unit);
  }
}

function ofValue(unit: string): Unit {
  if (unit === "m") return MILLIMETRES;
  if (unit === "rad") return ANGLE;
  return unit === "-" ? PLAIN : scaled(unit, 1, 0.01);
}

function perSecond(unit: Unit): Unit {
  return { ...unit, name: unit.name ? `${unit.name}/s` : "1/s" };
}

/** As few digits as it has: what is read again is the same to six of them. */
export function written(value: number, unit: Unit): string {
  return String(Number(unit.shown(value).toPrecision(6)));
}

/** What somebody wrote; `undefined` if that is no number. */
export function read(text: string, unit: Unit): number | undefined {
  const plain = text.trim().replace(",", ".").replace("−", "-");
  const number = plain === "" ? Number.NaN : Number(plain);
  return Number.isFinite(number) ? Number(unit.meant(number).toPrecision(9)) : undefined;
}
