// Changes in the order in which hands make them, one at a time: while one is on its way to the run, the
// newest of those to the same thing waits, and those before it are left out.

import type { Change } from "./messages";

interface Waiting {
  changes: Change[];
  /** Told the sentence why it was not done, or `null`. */
  done: (error: string | null) => void;
}

export class Changer {
  private readonly waiting = new Map<string, Waiting>();
  private isBusy = false;

  constructor(private readonly send: (changes: Change[]) => Promise<void>) {}

  /** `key` names what is changed. Of changes with one key only the last matters. */
  put(key: string, changes: Change[], done: (error: string | null) => void): void {
    this.waiting.set(key, { changes, done });
    if (!this.isBusy) void this.work();
  }

  /** Forgets what waits under a key; what is on its way arrives. */
  drop(key: string): void {
    this.waiting.delete(key);
  }

  private async work(): Promise<void> {
    this.isBusy = true;
    for (let next = this.take(); next; next = this.take()) {
      const { changes, done } = next;
      const error = await this.send(changes).then(() => null, (error: Error) => error.message);
      done(error);
    }
    this.isBusy = false;
  }

  private take(): Waiting | undefined {
    for (const [key, waiting] of this.waiting) {
      this.waiting.delete(key);
      return waiting;
    }
    return undefined;
  }
}
