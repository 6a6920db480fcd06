// Numbers with their units, as people read them.

/** A narrow space between a number and its unit, where no line breaks. */
const GAP = "\u202f";

/** `value` with a fixed number of digits after the point and a true minus. */
export function fixed(value: number, digits: number): string {
  if (!Number.isFinite(value)) return "–";
  const text = value.toFixed(digits);
  // "-0.00" is zero.
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
}

/** A value as it stands in a list: digits after the point do not come and go while it changes. */
export function quantity(value: number, unit: string): string {
  if (!Number.isFinite(value)) return "–";
  switch (unit) {
    case "m":
      return Math.abs(value) < 1 ? `${fixed(value * 1e3, 1)}${GAP}mm` : `${fixed(value, 3)}${GAP}m`;
    case "rad":
      return `${fixed(degrees(value), 2)}°`;
    case "rad/s":
    case "rad/s²":
      return `${fixed(degrees(value), 1)}${GAP}${unit.replace("rad", "°")}`;
    case "-":
      return fixed(value, 4);
    default:
      return `${fixed(value, 4)}${GAP}${unit}`;
  }
}

/** A value that stands still, a limit for instance: as few digits as it has. */
export function exact(value: number, unit: string): string {
  if (!Number.isFinite(value)) return "–";
  const short = (number: number) => String(Number(number.toPrecision(4))).replace("-", "−");
  switch (unit) {
    case "m":
      return Math.abs(value) < 1 ? `${short(value * 1e3)}${GAP}mm` : `${short(value)}${GAP}m`;
    case "rad":
      return `${short(degrees(value))}°`;
    case "-":
      return short(value);
    default:
      return `${short(value)}${GAP}${unit}`;
  }
}

export function degrees(angle: number): number {
  return (angle * 180) / Math.PI;
}

/** A time with as many digits as its ticks need. */
export function seconds(t_s: number, digits = 2): string {
  return `${fixed(t_s, digits)}${GAP}s`;
}

/** A point or a direction. */
export function vector(values: readonly number[]): string {
  return `(${values.map((value) => String(Number(value.toPrecision(3))).replace("-", "−")).join(", ")})`;
}
