// The time that is shown, and whether it runs: by itself in a replay, or with a run that is going on.

export type Listener = () => void;

/** Speeds of replay, as multiples of the run's own time. */
export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8] as const;

/** Axes of time that grow end at one of these [s], and then at whole multiples of the last. */
const ENDS = [10, 20, 30, 60, 90, 120, 180, 240, 300];

export class Clock {
  t_s: number;
  playing = false;
  speed = 1;
  /** Whether the time shown is that of the last row, whatever that will be. */
  following = false;
  /** Whether there is more to come, so that the end is now. */
  live = false;
  /** Where axes of time end [s]. */
  horizon_s: number;
  private last_ms: number | null = null;
  private readonly listeners: Listener[] = [];

  constructor(public begin_s: number, public end_s: number) {
    this.t_s = begin_s;
    this.horizon_s = end_s;
  }

  /** Called after every change of time, state or speed. */
  subscribe(listener: Listener): void {
    this.listeners.push(listener);
  }

  /** Whether the time changes without anybody's doing. */
  get isMoving(): boolean {
    return this.playing || this.following;
  }

  seek(t_s: number): void {
    if (this.live && t_s >= this.end_s) {
      this.follow();
      return;
    }
    const within = Math.min(Math.max(t_s, this.begin_s), this.end_s);
    this.t_s = Number.isFinite(within) ? within : this.begin_s;
    this.following = false;
    this.tell();
  }

  /** Glues the time to the last row. */
  follow(): void {
    this.following = true;
    this.playing = false;
    this.last_ms = null;
    this.t_s = this.end_s;
    this.tell();
  }

  /** Takes the ends of a run that is going on. */
  grow(begin_s: number, end_s: number): void {
    this.begin_s = begin_s;
    this.end_s = end_s;
    this.horizon_s = horizon(end_s);
    if (this.following) this.t_s = end_s;
    else this.t_s = Math.min(Math.max(this.t_s, begin_s), end_s);
    this.tell();
  }

  toggle(): void {
    this.playing = !this.playing;
    this.following = false;
    this.last_ms = null;
    // At the end there is nothing left to play.
    if (this.playing && this.t_s >= this.end_s) this.t_s = this.begin_s;
    this.tell();
  }

  pause(): void {
    if (this.playing) this.toggle();
  }

  /** One step along the list of speeds, either way. */
  changeSpeed(step: number): void {
    const at = SPEEDS.findIndex((speed) => speed === this.speed);
    this.setSpeed(SPEEDS[Math.min(Math.max(at + step, 0), SPEEDS.length - 1)]!);
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.tell();
  }

  /** Lets time pass while playing; `now_ms` is that of a frame. */
  advance(now_ms: number): void {
    if (!this.playing) return;
    const passed_s = this.last_ms === null ? 0 : (now_ms - this.last_ms) / 1e3;
    this.last_ms = now_ms;
    if (passed_s === 0) return;
    // A page that was in the background goes on where it was.
    this.t_s = Math.min(this.t_s + Math.min(passed_s, 0.25) * this.speed, this.end_s);
    if (this.t_s >= this.end_s) {
      this.playing = false;
      // Who has caught up goes on with the run.
      this.following = this.live;
      this.last_ms = null;
    }
    this.tell();
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}

/** The end of an axis that a run so long fits on. */
export function horizon(end_s: number): number {
  const last = ENDS[ENDS.length - 1]!;
  return ENDS.find((end) => end >= end_s) ?? last * Math.ceil(end_s / last);
}
