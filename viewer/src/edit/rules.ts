// The three settings of the method, changed while the run goes on.

import { element, say } from "../element";
import type { Workbench } from "./workbench";

const CHOICES = {
  mode_rule: { label: "mode rule", of: ["cone", "border", "paper"] },
  border: { label: "border", of: ["land", "freeze"] },
  recursion: { label: "recursion", of: ["siciliano-slotine", "chiaverini"] },
} as const;
type Key = keyof typeof CHOICES;

export class Rules {
  readonly element: HTMLElement;
  private readonly selects = new Map<Key, HTMLSelectElement>();
  private readonly error = element("p", { class: "field-error", role: "alert" });

  constructor(private readonly bench: Workbench) {
    const labels = (Object.keys(CHOICES) as Key[]).map((key) => {
      const { label, of } = CHOICES[key];
      const select = element("select", {}, ...of.map((choice) => element("option", { value: choice }, choice)));
      select.addEventListener("change", () => this.put(key, select.value));
      this.selects.set(key, select);
      return element("label", { class: "rule" }, element("span", { class: "field-name" }, label), select);
    });
    this.element = element("section", { class: "rules", "aria-label": "Method" }, element("h2", {}, "Method"), ...labels, this.error);
    this.error.hidden = true;
    this.update();
  }

  update(): void {
    const { settings } = this.bench.run.scene;
    const refusal = this.bench.refusal();
    for (const [key, select] of this.selects) {
      if (select.value !== settings[key]) select.value = settings[key];
      select.disabled = refusal !== null;
      select.title = refusal ?? "";
    }
  }

  private put(key: Key, value: string): void {
    this.bench.put(`control ${key}`, [{ control: key, value }], (error) => {
      say(this.error, error ?? "");
      this.error.hidden = error === null;
      // What was refused is not in force.
      this.update();
    });
  }
}
