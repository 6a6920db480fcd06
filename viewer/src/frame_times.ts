// How long the page's own script takes for a frame.

/** Frames that are kept: some seconds. */
const KEPT = 600;

export class FrameTimes {
  private readonly times: number[] = [];
  private next = 0;

  add(ms: number): void {
    this.times[this.next] = ms;
    this.next = (this.next + 1) % KEPT;
  }

  /** Median and 99th percentile [ms]. */
  get summary(): { frames: number; median: number; p99: number } {
    const sorted = [...this.times].sort((a, b) => a - b);
    const at = (share: number) => sorted[Math.floor(share * (sorted.length - 1))] ?? 0;
    return { frames: sorted.length, median: at(0.5), p99: at(0.99) };
  }
}
