// An interval as a bar: what is allowed, and a mark where the value is.

import { element, mark } from "../element";

export class Bar {
  readonly element: HTMLElement;
  private readonly pointer = element("i", { class: "mark" });

  /** `low` and `high` are the ends of the bar; `min` and `max` bound what is allowed, if anything does. */
  constructor(private readonly low: number, private readonly high: number, min: number | null, max: number | null) {
    const share = (value: number) => 100 * this.share(value);
    const from = min === null ? 0 : share(min);
    const to = max === null ? 100 : share(max);
    const allowed = element("i", { class: "allowed" });
    allowed.style.left = `${from}%`;
    allowed.style.width = `${Math.max(0, to - from)}%`;
    if (min !== null) allowed.classList.add("has-min");
    if (max !== null) allowed.classList.add("has-max");
    this.element = element("div", { class: "bar", "aria-hidden": "true" }, allowed, this.pointer);
  }

  set(value: number): void {
    const share = this.share(value);
    // The mark is as wide as the bar, so that its share of itself is its share of the bar.
    mark(this.pointer, "style", `transform:translateX(${(100 * share).toFixed(2)}%)`);
  }

  private share(value: number): number {
    const share = (value - this.low) / (this.high - this.low || 1);
    return Number.isFinite(share) ? Math.min(1, Math.max(0, share)) : 0;
  }
}

/** Ends of a bar: what was seen and what is allowed, with a margin. */
export function ends(seen: [number, number], bounds: (number | null | undefined)[]): [number, number] {
  const all = [...seen, ...bounds.filter((bound): bound is number => typeof bound === "number")];
  const low = Math.min(...all), high = Math.max(...all);
  const margin = 0.08 * (high - low) || 0.5 * Math.abs(high) || 1;
  return [low - margin, high + margin];
}
