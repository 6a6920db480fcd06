// Everything of a run that is going on that a recorded one has not: who it is heard from, what changes it,
// and how it is steered.

import type { Clock } from "../clock";
import { Save } from "../edit/save";
import { Workbench } from "../edit/workbench";
import { button, element, say } from "../element";
import { LiveStatus } from "../panel/live_status";
import { LiveTransport } from "../panel/live_transport";
import type { Run } from "../run";
import type { Stage } from "../scene/stage";
import { type News, Session } from "./session";

/** How far a key moves what is selected [m]. */
const STEP = 0.005;
const FAR = 0.05;

export class Live {
  readonly session: Session;
  readonly bench: Workbench;
  readonly status: LiveStatus;
  readonly transport: LiveTransport;
  /** What keeps or takes back changes. */
  readonly acts: HTMLElement[];
  readonly dialog: HTMLElement;
  /** What there is to try. */
  readonly invitation = element("p", { class: "invitation" });
  private readonly save: Save;
  private readonly undo: HTMLButtonElement;

  constructor(url: string, private readonly run: Run, private readonly clock: Clock, jump: (way: -1 | 1) => void) {
    this.session = new Session(url, run, () => location.reload());
    this.bench = new Workbench(this.session, run, clock);
    this.status = new LiveStatus(this.session, run);
    this.transport = new LiveTransport(this.session, clock, jump);
    this.save = new Save(this.session);
    this.undo = button("Undo all changes", "Undo all", () => {
      this.session.ask({ kind: "reset" }).catch((error: Error) => this.bench.onComplaint?.(error.message));
    });
    this.acts = [this.undo, this.save.element];
    this.dialog = this.save.dialog;
    clock.live = true;
  }

  /** `heard` is told what there is that is new. */
  open(heard: (news: News) => void): void {
    this.session.subscribe((news) => {
      if (news !== "ticks") {
        // What is said of the run is said of all rows that came before it: of its end, and of where it paused.
        if (this.run.rows > 0) this.clock.grow(this.run.begin_s, this.run.end_s);
        this.update();
      }
      heard(news);
    });
    this.update();
    this.session.open();
  }

  update(): void {
    const { session, clock } = this;
    if (clock.live === session.isOver) {
      clock.live = !session.isOver;
      if (session.isOver) clock.following = false;
    }
    this.status.update();
    this.transport.update();
    this.undo.hidden = session.state?.edited !== true || session.refusal("change") !== null;
    this.save.element.hidden = session.link !== "open";
    const refusal = session.refusal("change");
    if (session.link === "open") say(this.invitation, refusal ? `${WATCH} ${refusal}` : INVITATION);
  }

  /** Moves what is selected by a key; whether anything is. */
  nudge(stage: Stage | null, way: readonly [number, number, number], isFar: boolean): boolean {
    if (this.bench.selected() === null || this.bench.refusal() !== null || !stage) return false;
    stage.nudge(...way, isFar ? FAR : STEP);
    return true;
  }
}

const INVITATION =
  "This one is going on now, and you can take part: drag the obstacle into the tool's way, or a waypoint to " +
  "another place, and watch which task becomes active. An outline shows where a thing shall go; it glides " +
  "there, so that the arm can evade in time. The pen beside a task changes its numbers, and Undo all takes " +
  "everything back.";
const WATCH = "This one is going on now, and you can watch it: which task becomes active, and what the others do then.";
