// What was in force when: each thing from a time on, until the next.

/** More than these are thinned; a hand that drags makes some thirty a second. */
const MOST = 4096;

export class History<T> {
  private from_s: number[] = [];
  private things: T[];

  /** `first` holds from ever. */
  constructor(first: T) {
    this.things = [first];
    this.from_s = [Number.NEGATIVE_INFINITY];
  }

  get last(): T {
    return this.things[this.things.length - 1]!;
  }

  /** From this time on; whatever was to hold then or later does not. */
  add(from_s: number, thing: T): void {
    while (this.things.length > 1 && this.from_s[this.from_s.length - 1]! >= from_s) {
      this.from_s.pop();
      this.things.pop();
    }
    this.from_s.push(from_s);
    this.things.push(thing);
    if (this.things.length > MOST) this.thin();
  }

  at(t_s: number): T {
    let low = 0, high = this.things.length;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      // As for rows: a time that was written down may be a little before what it means.
      if (this.from_s[middle]! <= t_s + 1e-6) low = middle;
      else high = middle;
    }
    return this.things[low]!;
  }

  /** All of them, each with when it came into force. */
  *[Symbol.iterator](): Generator<{ from_s: number; thing: T }> {
    for (let nth = 0; nth < this.things.length; nth++) yield { from_s: this.from_s[nth]!, thing: this.things[nth]! };
  }

  /** Keeps nothing but `first`, from ever. */
  restart(first: T): void {
    this.things = [first];
    this.from_s = [Number.NEGATIVE_INFINITY];
  }

  private thin(): void {
    const last = this.things.length - 1;
    const isKept = (_: unknown, nth: number) => nth % 2 === 0 || nth === last;
    this.things = this.things.filter(isKept);
    this.from_s = this.from_s.filter(isKept);
  }
}
