// The page as a whole: a clock, a pane a run, and what all runs share.

import { addressed, onMoment, timeIn, write } from "./address";
import { Clock } from "./clock";
import { element } from "./element";
import { FrameTimes } from "./frame_times";
import { listen } from "./keyboard";
import { Live } from "./live/live";
import type { News } from "./live/session";
import { store, stored } from "./memory";
import { Pane } from "./pane";
import { Announcer } from "./panel/announcer";
import { header, rules } from "./panel/header";
import { about, Help } from "./panel/help";
import { Plots } from "./panel/plots";
import { Timeline } from "./panel/timeline";
import { Transport } from "./panel/transport";
import type { Recording } from "./protocol";
import { ModeColours, Run } from "./run";
import type { Direction } from "./scene/stage";
import * as theme from "./theme";

/** Numbers that change faster than this cannot be read [ms]. */
const TELL_EVERY = 66;
/** A curve that grows more often than this looks no smoother [ms]. */
const DRAW_EVERY = 100;
const ABOUT_CLOSED = "conik-about-closed";

export class App {
  private readonly runs: Run[];
  private readonly clock: Clock;
  private readonly panes: Pane[];
  private readonly transport: { element: HTMLElement; update: () => void };
  private readonly live: Live | null;
  private readonly timeline: Timeline;
  private readonly plots: Plots;
  private readonly frames = new FrameTimes();
  private readonly about: HTMLElement;
  private readonly announcer = new Announcer();
  /** Drawings that are older than what is to be seen in them. */
  private readonly stale = new Set<{ redraw: () => void }>();
  private readonly addressed = addressed();
  /** Whether there are rows of which nothing has been shown. */
  private hasGrown = false;
  /** Whether drawings show the newest rows, and when they were last begun. */
  private isDrawn = true;
  private drawn_ms = 0;
  private isTold = false;
  private told_ms = 0;

  /** `live` is where the run is followed, if it is going on. */
  constructor(recording: Recording, private readonly root: HTMLElement, live: string | null = null) {
    const colours = new ModeColours();
    this.runs = recording.runs.map((run) => new Run(run, colours));
    const isOne = this.runs.length === 1;
    this.clock = new Clock(
      Math.min(...this.runs.map((run) => run.begin_s)),
      Math.max(...this.runs.map((run) => run.end_s)),
    );
    this.live = live === null ? null : new Live(live, this.runs[0]!, this.clock, (way) => this.jump(way));
    const title = (run: Run, nth: number) => (isOne ? null : `${run.name} (${nth === 0 ? "solid" : "dashed"}): ${rules(run.scene)}`);
    this.panes = this.runs.map((run, nth) => new Pane(run, title(run, nth), this.live?.bench));
    this.transport = this.live?.transport ?? new Transport(this.clock, (way) => this.jump(way));
    this.timeline = new Timeline(this.runs, this.clock);
    this.plots = new Plots(this.runs, this.clock, () => this.tell());
    this.about = about(() => this.toggleAbout(), this.live?.invitation);
    this.about.hidden = stored(ABOUT_CLOSED) === "yes";
    const help = new Help(this.frames, this.live?.session ?? null);
    root.dataset["runs"] = String(this.runs.length);
    root.toggleAttribute("data-live", this.live !== null);
    root.replaceChildren(
      header(
        this.runs,
        { about: () => this.toggleAbout(), theme: () => this.changeTheme(), help: () => help.toggle() },
        this.live && { chips: this.live.status.chips, acts: this.live.acts },
      ),
      ...(this.live ? [this.live.status.banner] : []),
      element("main", {}, element("div", { class: "panes" }, ...this.panes.map((pane) => pane.element)), this.about),
      element("footer", {}, element("div", { class: "control" }, this.transport.element, this.timeline.element), this.plots.element),
      this.announcer.element,
      help.element,
      ...(this.live ? [this.live.dialog] : []),
    );
    this.linkCameras();
    this.listen(help);
  }

  /** Begins to show. */
  start(): void {
    document.title = `${this.runs.map((run) => run.title).join(" | ")} – Conik`;
    const linked = timeIn(this.addressed.location.hash);
    if (this.live) this.clock.grow(this.clock.begin_s, this.clock.end_s);
    if (this.live && linked === null) this.clock.follow();
    else this.clock.seek(linked ?? this.clock.begin_s);
    this.live?.open((news) => this.hear(news));
    this.live?.bench.subscribe(() => this.panes[0]!.refresh());
    const frame = (now_ms: number) => {
      const before = performance.now();
      this.grow();
      this.clock.advance(now_ms);
      // First, as text in a drawing has the page's styles computed, which are known until something is changed.
      this.redrawOne(now_ms);
      this.show(now_ms);
      if (this.clock.isMoving) this.frames.add(performance.now() - before);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  private show(now_ms: number): void {
    const { t_s } = this.clock;
    for (const pane of this.panes) {
      pane.show(t_s);
      pane.stage?.draw();
    }
    if (this.isTold || (this.clock.isMoving && now_ms - this.told_ms < TELL_EVERY)) return;
    this.told_ms = now_ms;
    this.tell();
  }

  private tell(): void {
    const { t_s } = this.clock;
    this.isTold = true;
    const { isMoving, live, following } = this.clock;
    for (const pane of this.panes) pane.tell(t_s, isMoving, !live || following);
    const rows = this.panes.map((pane) => pane.rowAt(t_s));
    if (following) this.announcer.mode(this.runs[0]!.modeAt(rows[0]!).label, performance.now());
    this.transport.update();
    this.timeline.update(rows[0]!);
    this.plots.update(rows);
  }

  /** Takes in what is new of a run that is going on. */
  private hear(news: News): void {
    if (news === "ticks") this.hasGrown = true;
    else this.refresh();
    // Bounds are drawn too, and when waypoints were reached.
    if (news === "scene") this.makeStale();
  }

  /** Goes with a run that has grown: once a frame, however often it was heard of. */
  private grow(): void {
    if (!this.hasGrown) return;
    this.hasGrown = false;
    const run = this.runs[0]!;
    this.clock.grow(run.begin_s, run.end_s);
    this.plots.fill();
    this.isDrawn = false;
  }

  private makeStale(): void {
    for (const drawing of [this.timeline, ...this.plots.drawings]) this.stale.add(drawing);
  }

  /** Brings what can be done to what may be done now. */
  private refresh(): void {
    for (const pane of this.panes) pane.refresh();
    this.isTold = false;
  }

  /** One drawing a frame: all of them at once would take longer than a frame may. */
  private redrawOne(now_ms: number): void {
    if (!this.isDrawn && this.stale.size === 0 && now_ms - this.drawn_ms >= DRAW_EVERY) {
      [this.isDrawn, this.drawn_ms] = [true, now_ms];
      this.makeStale();
    }
    for (const drawing of this.stale) {
      this.stale.delete(drawing);
      drawing.redraw();
      return;
    }
  }

  private listen(help: Help): void {
    const { clock, live } = this;
    let address: ReturnType<typeof setTimeout> | undefined;
    let wasFollowing = clock.following;
    clock.subscribe(() => {
      this.isTold = false;
      clearTimeout(address);
      // Browsers refuse an address that changes all the time.
      // Now has no address.
      if (clock.following && location.hash !== "") history.replaceState(null, "", location.pathname + location.search);
      else if (!clock.isMoving) address = setTimeout(() => write(this.addressed, clock.t_s), 150);
      if (clock.following === wasFollowing) return;
      wasFollowing = clock.following;
      this.refresh();
    });
    onMoment(this.addressed, (t_s) => clock.seek(t_s));
    theme.follow(() => this.repaint());
    listen({
      toggle: () => (live ? live.transport.toggle() : clock.toggle()),
      move: (seconds) => clock.seek(clock.t_s + seconds),
      step: (ticks) => this.step(ticks),
      jump: (way) => this.jump(way),
      toEnd: (way) => clock.seek(way < 0 ? clock.begin_s : clock.end_s),
      speed: (step) => (live ? live.transport.changeSpeed(step) : clock.changeSpeed(step)),
      replay: () => live && !clock.following && clock.toggle(),
      nudge: (way, isFar) => live?.nudge(this.panes[0]!.stage, way, isFar) ?? false,
      fit: (direction: Direction) => this.panes.forEach((pane) => pane.fit(direction)),
      plots: () => this.root.toggleAttribute("data-no-plots"),
      theme: () => this.changeTheme(),
      about: () => this.toggleAbout(),
      close: () => this.letGo() || this.about.hidden || help.element.open || this.toggleAbout(),
      help: () => help.toggle(),
    });
  }

  /** Lets go of what is dragged or selected; whether anything was. */
  private letGo(): boolean {
    if (this.panes.some((pane) => pane.stage?.cancel())) return true;
    const { bench } = this.live ?? {};
    if (!bench?.name) return false;
    bench.open(null);
    return true;
  }

  /** By so many ticks of the first run. */
  private step(ticks: number): void {
    if (ticks > 0 && this.live?.transport.stepOn()) return;
    const run = this.runs[0]!;
    const row = Math.min(Math.max(run.rowAt(this.clock.t_s) + ticks, 0), run.rows - 1);
    this.clock.pause();
    this.clock.seek(run.t_s[row]!);
  }

  /** To the change of mode before or after. */
  private jump(way: -1 | 1): void {
    const { begin_s, end_s, t_s } = this.clock;
    const changes = [...new Set([begin_s, ...this.runs.flatMap((run) => run.changes_s), end_s])].sort((a, b) => a - b);
    const to = way > 0 ? changes.find((change) => change > t_s + 1e-6) : changes.findLast((change) => change < t_s - 1e-6);
    if (to === undefined) return;
    this.clock.pause();
    this.clock.seek(to);
    const modes = this.runs.map((run) => run.modeAt(run.rowAt(to)).label);
    this.announcer.say(`${to.toFixed(2)} s: ${modes.join("; ")}`);
  }

  private toggleAbout(): void {
    // Keys go to the page again, and not to a button that nobody sees.
    if (this.about.contains(document.activeElement)) (document.activeElement as HTMLElement).blur();
    this.about.hidden = !this.about.hidden;
    store(ABOUT_CLOSED, this.about.hidden ? "yes" : "no");
  }

  private changeTheme(): void {
    theme.toggle();
    this.repaint();
  }

  private repaint(): void {
    for (const pane of this.panes) pane.paint();
    this.timeline.redraw();
    this.plots.redraw();
  }

  /** Whoever turns one scene turns all. */
  private linkCameras(): void {
    const stages = this.panes.flatMap((pane) => (pane.stage ? [pane.stage] : []));
    if (stages.length < 2) return;
    for (const stage of stages) {
      stage.onCamera = () => stages.filter((other) => other !== stage).forEach((other) => other.follow(stage));
    }
  }
}
