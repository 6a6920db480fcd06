// Numbers that become more all the time. Room for them doubles, so that one more costs the same however
// many there are.

const FIRST = 256;

export class Growing {
  private room = new Float64Array(FIRST);
  private taken = 0;
  private view = this.room.subarray(0, 0);

  get length(): number {
    return this.taken;
  }

  /** Those there are now. What is added later is not among them. */
  get values(): Float64Array {
    if (this.view.length !== this.taken) this.view = this.room.subarray(0, this.taken);
    return this.view;
  }

  /** The number in a row, NaN where there is none. */
  at(row: number): number {
    return row < this.taken ? (this.room[row] ?? Number.NaN) : Number.NaN;
  }

  /** `null` is no number, and becomes NaN. */
  add(numbers: ArrayLike<number | null>): void {
    this.reserve(this.taken + numbers.length);
    for (let nth = 0; nth < numbers.length; nth++) this.room[this.taken++] = numbers[nth] ?? Number.NaN;
  }

  /** Fills up with NaN to a length. */
  fill(length: number): void {
    if (length <= this.taken) return;
    this.reserve(length);
    this.room.fill(Number.NaN, this.taken, length);
    this.taken = length;
  }

  clear(): void {
    this.taken = 0;
    this.view = this.room.subarray(0, 0);
  }

  private reserve(length: number): void {
    if (length <= this.room.length) return;
    const room = new Float64Array(Math.max(length, 2 * this.room.length));
    room.set(this.values);
    this.room = room;
    this.view = room.subarray(0, this.taken);
  }
}
