// What is said to those who do not see the page: changes of mode, not too often, and faults at once.

import { element } from "../element";

/** Who hears something has to hear its end [ms]. */
const EVERY = 1000;

export class Announcer {
  readonly element = element("p", { class: "unseen", role: "status" });
  private said = "";
  private said_ms = Number.NEGATIVE_INFINITY;

  /** Says something at once. */
  say(text: string): void {
    this.said = text;
    this.element.textContent = text;
  }

  /** Says which mode is in force, if it is another one and nothing was said within the last second. */
  mode(label: string, now_ms: number): void {
    if (label === this.said || now_ms - this.said_ms < EVERY) return;
    this.said_ms = now_ms;
    this.say(label);
  }
}
