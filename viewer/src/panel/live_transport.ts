// What steers a run that is going on, and what of it is seen: now, or its past.

import { type Clock, SPEEDS } from "../clock";
import { button, element, icon, mark, say } from "../element";
import type { Request } from "../live/messages";
import type { Session } from "../live/session";
import { fixed } from "../quantity";

const PLAY = "M4.5 2.5v11l9-5.5z";
const PAUSE = "M4 2.5h3v11H4zM9 2.5h3v11H9z";
const BACK = "M12.5 2.5v11l-7-5.5zM3.5 2.5h1.6v11H3.5z";
const ON = "M3.5 2.5v11l7-5.5zM10.9 2.5h1.6v11h-1.6z";
const STEP = "M3 2.5h2.6v11H3zM7.5 3.5v9l6-4.5z";
const RESTART = "M3.2 8a4.8 4.8 0 1 0 1.5-3.5M3.2 2.4v2.9h2.9";
/** Speeds of a run, as multiples of the time on the wall. */
const FACTORS = [0.1, 0.25, 0.5, 1, 2, 5, 10];

export class LiveTransport {
  readonly element: HTMLElement;
  private readonly main: HTMLButtonElement;
  private readonly mainWord = element("span", { class: "main-word" });
  private readonly mainIcon = element("span");
  private readonly step: HTMLButtonElement;
  private readonly restart: HTMLButtonElement;
  private readonly live: HTMLButtonElement;
  private readonly replay: HTMLButtonElement;
  private readonly factor = element("select", { "aria-label": "Speed of the run" });
  private readonly speed = element("select", { "aria-label": "Speed of replay" });
  private readonly time = element("span", { class: "clock" });
  private readonly when = element("span", { class: "when" });
  private readonly error = element("p", { class: "field-error", role: "alert" });

  constructor(private readonly session: Session, private readonly clock: Clock, jump: (way: -1 | 1) => void) {
    this.main = button("Pause the run", this.mainIcon, () => this.toggle(), "space");
    this.main.classList.add("play", "main");
    this.main.append(this.mainWord);
    this.step = button("One tick", icon(STEP), () => this.stepOn(), ".");
    this.restart = button("Restart the run", icon(RESTART), () => this.ask({ kind: "restart" }));
    this.restart.classList.add("outlined");
    this.live = button("Go to now", element("span", {}, "LIVE"), () => clock.follow(), "End");
    this.live.classList.add("live");
    this.replay = button("Replay from here", icon(PLAY), () => clock.toggle(), "K");
    for (const factor of FACTORS) this.factor.append(element("option", { value: String(factor) }, `${factor}×`));
    this.factor.addEventListener("change", () => this.ask({ kind: "speed", factor: Number(this.factor.value) }));
    for (const speed of SPEEDS) this.speed.append(element("option", { value: String(speed) }, `${speed}×`));
    this.speed.addEventListener("change", () => clock.setSpeed(Number(this.speed.value)));
    this.error.hidden = true;
    this.element = element(
      "div",
      { class: "transport", role: "group", "aria-label": "The run" },
      this.main, this.step, this.restart, this.factor,
      button("To the change of mode before", icon(BACK), () => jump(-1), "["),
      this.replay,
      button("To the next change of mode", icon(ON), () => jump(1), "]"),
      this.speed, this.live,
      element("span", { class: "time" }, this.time, this.when),
      this.error,
    );
  }

  /** What space does: it stops the run where that may be stopped, and else what is seen of it. */
  toggle(): void {
    const { clock, session } = this;
    if (session.isOver) clock.toggle();
    else if (session.refusal("pause") === null) this.ask({ kind: session.state?.running === "paused" ? "resume" : "pause" });
    else if (clock.following) clock.seek(clock.t_s - 1e-6);
    else clock.follow();
  }

  /** A tick of the run, where it stands; whether it could be asked. */
  stepOn(): boolean {
    if (!this.clock.following || this.stepRefusal() !== null) return false;
    this.ask({ kind: "step", ticks: 1 });
    return true;
  }

  /** A speed faster or slower. */
  changeSpeed(way: -1 | 1): void {
    const { clock, session } = this;
    if (!clock.following || session.refusal("speed") !== null) {
      clock.changeSpeed(way);
      return;
    }
    const now = session.state?.speed ?? 1;
    const next = way > 0 ? FACTORS.find((factor) => factor > now) : FACTORS.findLast((factor) => factor < now);
    if (next !== undefined) this.ask({ kind: "speed", factor: next });
  }

  update(): void {
    const { clock, session } = this;
    const { state, isOver } = session;
    const isPaused = state?.running === "paused";
    const label = isOver
      ? clock.playing ? "Pause the replay" : "Play the replay"
      : session.refusal("pause") === null
        ? isPaused ? "Resume the run" : "Pause the run"
        : clock.following ? "Hold the view" : "Back to live";
    const isGoing = /^(Pause|Hold)/.test(label);
    if (this.main.getAttribute("aria-label") !== label) {
      this.mainIcon.replaceChildren(icon(isGoing ? PAUSE : PLAY));
      mark(this.main, "aria-label", label);
      say(this.mainWord, label.replace(" the", ""));
    }
    const why = isOver ? null : session.refusal("pause");
    mark(this.main, "title", why ? `${label} (space). The run goes on: ${why}` : `${label} (space)`);
    allow(this.step, "One tick (.)", this.stepRefusal());
    allow(this.restart, "Restart the run", session.refusal("restart"));
    allow(this.factor, "Speed of the run", session.refusal("speed"));
    const factor = String(state?.speed ?? 1);
    if (![...this.factor.options].some(({ value }) => value === factor)) this.factor.append(element("option", { value: factor }, `${factor}×`));
    if (this.factor.value !== factor && document.activeElement !== this.factor) this.factor.value = factor;
    this.factor.hidden = isOver;
    this.step.hidden = isOver;
    this.live.hidden = isOver;
    mark(this.live, "aria-pressed", String(clock.following));
    this.replay.hidden = isOver || clock.following;
    this.speed.hidden = !isOver && clock.following;
    if (this.speed.value !== String(clock.speed)) this.speed.value = String(clock.speed);
    const word = clock.playing ? "Stop the replay" : "Replay from here";
    if (this.replay.getAttribute("aria-label") !== word) {
      this.replay.replaceChildren(icon(clock.playing ? PAUSE : PLAY));
      mark(this.replay, "aria-label", word);
      mark(this.replay, "title", `${word} (K)`);
    }
    say(this.time, fixed(clock.t_s, 2));
    say(this.when, this.words(isPaused));
    mark(this.element, "data-when", clock.following ? "now" : "past");
  }

  /** What is seen, so that nobody takes one pause for the other. */
  private words(isPaused: boolean): string {
    const { clock, session } = this;
    if (session.isOver) return ` / ${fixed(clock.end_s, 1)} s`;
    if (session.link !== "open") return " s, connection lost";
    if (clock.following) return isPaused ? " s, run paused" : " s, now";
    const ago = `${fixed(clock.end_s - clock.t_s, 1)} s ago`;
    return isPaused ? ` s: ${ago}, run paused` : ` s: ${ago}, the run goes on`;
  }

  private stepRefusal(): string | null {
    const refusal = this.session.refusal("step");
    if (refusal) return refusal;
    if (!this.clock.following) return "This is the past. Go back to now (End) to go on by a tick.";
    return this.session.state?.running === "paused" ? null : "Pause the run to go on tick by tick.";
  }

  private ask(request: Request): void {
    if (request.kind === "restart" || request.kind === "resume" || request.kind === "step") this.clock.follow();
    this.session.ask(request).then(() => this.complain(null), (error: Error) => {
      this.complain(error.message);
      // What was refused is not in force.
      this.factor.blur();
    });
  }

  private complain(error: string | null): void {
    say(this.error, error ?? "");
    this.error.hidden = error === null;
  }
}

function allow(control: HTMLButtonElement | HTMLSelectElement, title: string, refusal: string | null): void {
  control.disabled = refusal !== null;
  mark(control, "title", refusal ? `${title}: ${refusal}` : title);
}
