// A number that can be changed: its name, its unit, and why it was not.

import { element, mark, say } from "../element";
import { read, type Unit, written } from "./units";

/** What becomes of what somebody wrote. */
export interface Taker {
  /** `null` where nothing is written and nothing need be; `done` is told why not, or `null`. */
  take: (value: number | null, done: (error: string | null) => void) => void;
}

/** So soon after it was taken, what was asked for is seen in the scene. */
const COMES_WITHIN_MS = 1000;

let ids = 0;

export class Field {
  readonly element: HTMLElement;
  private readonly input: HTMLInputElement;
  private readonly error = element("span", { class: "field-error", role: "alert" });
  private value: number | null = null;
  /** What was asked for instead of which value, and is not there yet. */
  private asked: { value: number | null; before: number | null; until_ms: number } | null = null;

  /** Where it is `optional` it may be empty. */
  constructor(label: string, private readonly unit: Unit, private readonly taker: Taker, private readonly isOptional = false) {
    this.error.id = `field-${ids++}`;
    this.error.hidden = true;
    const name = unit.name ? `${label} [${unit.name}]` : label;
    this.input = element("input", {
      type: "text", inputmode: "decimal", autocomplete: "off", size: "7", "aria-label": name,
      "aria-describedby": this.error.id, placeholder: isOptional ? "none" : "",
    });
    this.input.addEventListener("change", () => this.commit());
    this.input.addEventListener("keydown", (event) => this.key(event));
    this.input.addEventListener("input", () => (this.input.dataset["touched"] = "yes"));
    const shown = [element("span", { class: "field-name" }, label), this.input, element("span", { class: "unit" }, unit.name)];
    this.element = element("label", { class: "field" }, ...shown, this.error);
  }

  /** Shows a value, unless somebody is writing. */
  set(value: number | null, isFrozen: boolean): void {
    this.value = value;
    this.input.disabled = isFrozen;
    if (this.asked && (value !== this.asked.before || performance.now() > this.asked.until_ms)) this.asked = null;
    // What came of it is shown when it has come.
    if (this.asked) return;
    if (document.activeElement === this.input && this.input.dataset["touched"]) return;
    const text = value === null ? "" : written(value, this.unit);
    if (this.input.value !== text) this.input.value = text;
  }

  /** Says why something was not done; `null`: nothing to say. */
  complain(error: string | null): void {
    say(this.error, error ?? "");
    this.error.hidden = error === null;
    mark(this.input, "aria-invalid", String(error !== null));
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowUp: this.unit.step, ArrowDown: -this.unit.step }[event.key];
    if (event.key === "Escape") {
      event.stopPropagation();
      this.restore();
      this.input.blur();
    } else if (event.key === "Enter") {
      this.commit();
    } else if (step !== undefined && !event.altKey) {
      event.preventDefault();
      const now = Number(this.input.value.replace(",", ".")) || 0;
      this.input.value = String(Number((now + step * (event.shiftKey ? 10 : 1)).toPrecision(9)));
      this.commit();
    }
  }

  private commit(): void {
    delete this.input.dataset["touched"];
    const isEmpty = this.input.value.trim() === "";
    const value = isEmpty && this.isOptional ? null : read(this.input.value, this.unit);
    if (value === undefined) {
      this.complain(`"${this.input.value}" is no number.`);
      this.restore();
      return;
    }
    const present = this.asked ? this.asked.value : this.value;
    if (value === present || (value !== null && present !== null && this.input.value === written(present, this.unit))) return;
    const asked = { value, before: this.value, until_ms: Infinity };
    this.asked = asked;
    this.taker.take(value, (error) => {
      this.complain(error);
      asked.until_ms = performance.now() + COMES_WITHIN_MS;
      if (error === null) return;
      this.asked = null;
      this.restore();
    });
  }

  private restore(): void {
    delete this.input.dataset["touched"];
    this.input.value = this.value === null ? "" : written(this.value, this.unit);
  }
}
