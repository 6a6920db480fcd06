// The time that is shown, and whether it runs.

export type Listener = () => void;

/** Speeds of replay, as multiples of the run's own time. */
export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8] as const;

export class Clock {
  t_s: number;
  playing = false;
  speed = 1;
  private last_ms: number | null = null;
  private readonly listeners: Listener[] = [];

  constructor(readonly begin_s: number, readonly end_s: number) {
    this.t_s = begin_s;
  }

  /** Called after every change of time, state or speed. */
  subscribe(listener: Listener): void {
    this.listeners.push(listener);
  }

  seek(t_s: number): void {
    const within = Math.min(Math.max(t_s, this.begin_s), this.end_s);
    this.t_s = Number.isFinite(within) ? within : this.begin_s;
    this.tell();
  }

  toggle(): void {
    this.playing = !this.playing;
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
      this.last_ms = null;
    }
    this.tell();
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}
