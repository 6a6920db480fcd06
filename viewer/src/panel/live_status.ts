// How a run that is going on fares: in the header, and across the page what nobody may overlook.

import { button, element, mark, say } from "../element";
import type { Session } from "../live/session";
import type { Result, StepTime } from "../protocol";
import { fixed } from "../quantity";
import type { Run } from "../run";
import { sentence } from "../words";
import { ending } from "./header";

/** Arms that are none: nobody stands beside them. */
const SIMULATED = ["ideal", "emulator"];

export class LiveStatus {
  readonly chips: HTMLElement[];
  /** A fault, or that the connection is lost; hidden otherwise. */
  readonly banner = element("div", { class: "banner", role: "alert" });
  private readonly words = element("div", { class: "banner-words" });
  private readonly state = element("span", { class: "chip state-chip" });
  private readonly pace = element("span", { class: "chip arm" });
  private readonly missed = element("span", { class: "chip bad" });
  /** How the run ended, once that is known. */
  private readonly end = element("span");
  private result: Result | null = null;
  private readonly again: HTMLButtonElement;

  constructor(private readonly session: Session, private readonly run: Run) {
    this.again = button("Try again now", "Try again now", () => session.open());
    this.chips = [this.state, this.missed, this.end, this.pace];
    this.banner.append(this.words, this.again);
    this.update();
  }

  update(): void {
    const { session, run } = this;
    const { state, link } = session;
    const kind = link !== "open" ? "lost" : state?.outcome?.kind === "fault" ? "fault" : (state?.running ?? "waiting");
    mark(this.state, "data-kind", kind);
    say(this.state, WORDS[kind]);
    const { arm, rate_hz } = run.scene;
    const us = state?.step_time_us?.median ?? run.scene.result?.step_time_us.median;
    const step = us === undefined ? "" : `, ${Number(us.toPrecision(2))} µs a step`;
    const speed = state && state.speed !== 1 ? `, ${state.speed}× speed` : "";
    say(this.pace, `${arm === "ideal" ? "ideal arm" : arm}, ${rate_hz} Hz${step}${speed}`);
    this.pace.title = state?.step_time_us ? times(state.step_time_us) : "";
    const misses = state?.deadline_misses ?? 0;
    say(this.missed, `${misses} ${misses === 1 ? "cycle" : "cycles"} missed`);
    this.missed.hidden = misses === 0;
    const { result } = run.scene;
    if (result !== this.result) this.end.replaceChildren(...(result ? [ending(run.scene)] : []));
    this.result = result;
    this.warn();
  }

  private warn(): void {
    const { link, state } = this.session;
    const outcome = state?.outcome;
    this.again.hidden = link === "open" || link === "connecting";
    if (outcome?.kind === "fault") {
      const beside = SIMULATED.includes(this.run.scene.arm)
        ? ""
        : " Do not go near the arm before its own controller says that it has stopped.";
      mark(this.banner, "data-kind", "fault");
      say(this.words, `Fault: ${outcome.name}. ${sentence(outcome.detail)} The run is over, and nothing steers the arm any more.${beside}`);
    } else if (link === "lost" || link === "gone") {
      mark(this.banner, "data-kind", "lost");
      say(this.words, link === "lost"
        ? "The connection to the run is cut off. Trying again …"
        : "The program that runs this does not answer any more. What was seen of the run stays here, to be replayed.");
    } else {
      say(this.words, "");
    }
    this.banner.hidden = this.words.textContent === "";
  }
}

const WORDS = {
  waiting: "not begun", running: "● running", paused: "‖ run paused", ended: "■ ended", fault: "✕ fault", lost: "△ no connection",
} as const;

/** How long steps of the controller took. */
function times({ median, p99, max }: StepTime): string {
  const us = (time: number) => `${fixed(time, 2)} µs`;
  return `A step of the controller: median ${us(median)}, 99 % below ${us(p99)}, at most ${us(max)}`;
}
