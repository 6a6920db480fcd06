// An interval as a bar: what is allowed, and a mark where the value is.

import { element, mark } from "../element";

export class Bar {
  readonly element: HTMLElement;
  /** Called whenever its ends or bounds are others. */
  onScale: (() => void) | null = null;
  isHeld = false;
  private readonly pointer = element("i", { class: "mark" });
  private readonly allowed = element("i", { class: "allowed" });
  private drawn = "";

  /** `low` and `high` are the ends of the bar; `min` and `max` bound what is allowed, if anything does. */
  constructor(private low: number, private high: number, min: number | null, max: number | null) {
    this.element = element("div", { class: "bar", "aria-hidden": "true" }, this.allowed, this.pointer);
    this.scale(low, high, min, max);
  }

  /** Takes other ends and bounds; while a bound is in somebody's hand, the ends stay. */
  scale(low: number, high: number, min: number | null, max: number | null): void {
    if (this.isHeld) [low, high] = [this.low, this.high];
    const asked = [low, high, min, max].join();
    if (asked === this.drawn) return;
    this.drawn = asked;
    [this.low, this.high] = [low, high];
    const from = min === null ? 0 : 100 * this.share(min);
    const to = max === null ? 100 : 100 * this.share(max);
    this.allowed.style.left = `${from}%`;
    this.allowed.style.width = `${Math.max(0, to - from)}%`;
    this.allowed.classList.toggle("has-min", min !== null);
    this.allowed.classList.toggle("has-max", max !== null);
    this.onScale?.();
  }

  /** Whether a value is on the bar. */
  has(value: number): boolean {
    return !(value < this.low || value > this.high);
  }

  set(value: number): void {
    const share = this.share(value);
    // The mark is as wide as the bar, so that its share of itself is its share of the bar.
    mark(this.pointer, "style", `transform:translateX(${(100 * share).toFixed(2)}%)`);
  }

  /** Where a value is, from 0 to 1. */
  share(value: number): number {
    const share = (value - this.low) / (this.high - this.low || 1);
    return Number.isFinite(share) ? Math.min(1, Math.max(0, share)) : 0;
  }

  /** The value at a share of the bar, which may be beyond its ends. */
  valueAt(share: number): number {
    return this.low + share * (this.high - this.low);
  }
}

/** Ends of a bar: what was seen and what is allowed, with a margin. */
export function ends(seen: [number, number], bounds: (number | null | undefined)[]): [number, number] {
  const all = [...seen, ...bounds.filter((bound): bound is number => typeof bound === "number")];
  const low = Math.min(...all), high = Math.max(...all);
  const margin = 0.08 * (high - low) || 0.5 * Math.abs(high) || 1;
  return [low - margin, high + margin];
}
