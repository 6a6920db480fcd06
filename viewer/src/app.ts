// The page as a whole: a clock, a pane a run, and what all runs share.

import { hashOf, timeIn } from "./address";
import { Clock } from "./clock";
import { element } from "./element";
import { FrameTimes } from "./frame_times";
import { listen } from "./keyboard";
import { store, stored } from "./memory";
import { Pane } from "./pane";
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
const ABOUT_CLOSED = "conik-about-closed";

export class App {
  private readonly runs: Run[];
  private readonly clock: Clock;
  private readonly panes: Pane[];
  private readonly transport: Transport;
  private readonly timeline: Timeline;
  private readonly plots: Plots;
  private readonly frames = new FrameTimes();
  private readonly about: HTMLElement;
  private readonly said = element("p", { class: "unseen", role: "status" });
  private isTold = false;
  private told_ms = 0;

  constructor(recording: Recording, private readonly root: HTMLElement) {
    const colours = new ModeColours();
    this.runs = recording.runs.map((run) => new Run(run, colours));
    const isOne = this.runs.length === 1;
    this.clock = new Clock(
      Math.min(...this.runs.map((run) => run.begin_s)),
      Math.max(...this.runs.map((run) => run.end_s)),
    );
    this.panes = this.runs.map((run, nth) => new Pane(run, isOne ? null : `${run.name} (${nth === 0 ? "solid" : "dashed"}): ${rules(run.scene)}`));
    this.transport = new Transport(this.clock, (way) => this.jump(way));
    this.timeline = new Timeline(this.runs, this.clock);
    this.plots = new Plots(this.runs, this.clock, () => this.tell());
    this.about = about(() => this.toggleAbout());
    this.about.hidden = stored(ABOUT_CLOSED) === "yes";
    const help = new Help(this.frames);
    root.dataset["runs"] = String(this.runs.length);
    root.replaceChildren(
      header(this.runs, { about: () => this.toggleAbout(), theme: () => this.changeTheme(), help: () => help.toggle() }),
      element("main", {}, element("div", { class: "panes" }, ...this.panes.map((pane) => pane.element)), this.about),
      element("footer", {}, element("div", { class: "control" }, this.transport.element, this.timeline.element), this.plots.element),
      this.said,
      help.element,
    );
    this.linkCameras();
    this.listen(help);
  }

  /** Begins to show. */
  start(): void {
    document.title = `${this.runs.map((run) => run.title).join(" | ")} – Conik`;
    this.clock.seek(timeIn(location.hash) ?? this.clock.begin_s);
    const frame = (now_ms: number) => {
      const before = performance.now();
      this.clock.advance(now_ms);
      this.show(now_ms);
      if (this.clock.playing) this.frames.add(performance.now() - before);
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
    if (this.isTold || (this.clock.playing && now_ms - this.told_ms < TELL_EVERY)) return;
    this.told_ms = now_ms;
    this.tell();
  }

  private tell(): void {
    const { t_s } = this.clock;
    this.isTold = true;
    for (const pane of this.panes) pane.tell(t_s, this.clock.playing);
    const rows = this.panes.map((pane) => pane.rowAt(t_s));
    this.transport.update();
    this.timeline.update(rows[0]!);
    this.plots.update(rows);
  }

  private listen(help: Help): void {
    const { clock } = this;
    let address: ReturnType<typeof setTimeout> | undefined;
    clock.subscribe(() => {
      this.isTold = false;
      clearTimeout(address);
      // Browsers refuse an address that changes all the time.
      if (!clock.playing) address = setTimeout(() => history.replaceState(null, "", hashOf(clock.t_s)), 150);
    });
    window.addEventListener("hashchange", () => {
      const t_s = timeIn(location.hash);
      if (t_s !== null) clock.seek(t_s);
    });
    theme.follow(() => this.repaint());
    listen({
      toggle: () => clock.toggle(),
      move: (seconds) => clock.seek(clock.t_s + seconds),
      step: (ticks) => this.step(ticks),
      jump: (way) => this.jump(way),
      toEnd: (way) => clock.seek(way < 0 ? clock.begin_s : clock.end_s),
      speed: (step) => clock.changeSpeed(step),
      fit: (direction: Direction) => this.panes.forEach((pane) => pane.fit(direction)),
      plots: () => this.root.toggleAttribute("data-no-plots"),
      theme: () => this.changeTheme(),
      about: () => this.toggleAbout(),
      close: () => this.about.hidden || help.element.open || this.toggleAbout(),
      help: () => help.toggle(),
    });
  }

  /** By so many ticks of the first run. */
  private step(ticks: number): void {
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
    this.said.textContent = `${to.toFixed(2)} s: ${modes.join("; ")}`;
  }

  private toggleAbout(): void {
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
