// The tool's path: faint where it will go, in the colours of the modes where it has been.

import { Color, Group, InstancedInterleavedBuffer, InterleavedBufferAttribute } from "three";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import type { Run } from "../run";
import type { Look } from "./look";

/** A line of more pieces than this looks no smoother. */
const MOST = 3000;
/** Numbers of a piece: its two ends, or their colours. */
const PIECE = 6;
const AXES = ["tool_x_m", "tool_y_m", "tool_z_m"] as const;

export class Path {
  readonly object = new Group();
  private readonly places = buffer();
  private readonly colours = buffer();
  private readonly whole = geometry(this.places);
  private readonly gone = geometry(this.places, this.colours);
  private readonly ahead = new LineMaterial({ linewidth: 1.5, transparent: true, opacity: 0.55 });
  private readonly behind = new LineMaterial({ linewidth: 4, vertexColors: true });
  /** Rows for each piece, how many pieces there are, and of which rows. */
  private step = 1;
  private pieces = 0;
  private generation = 0;
  private readonly idle = new Color();
  private readonly colour = new Color();

  constructor(private readonly run: Run) {
    const lines = [new LineSegments2(this.whole, this.ahead), new LineSegments2(this.gone, this.behind)];
    // Where the path is is known only later.
    for (const line of lines) line.frustumCulled = false;
    lines[1]!.renderOrder = 1;
    this.object.add(...lines);
    this.restart();
  }

  paint(look: Look): void {
    this.ahead.color.set(look.soft);
    this.idle.set(look.ink);
    this.restart();
  }

  update(row: number): void {
    const { run } = this;
    const isLong = run.rows - 1 > MOST * this.step;
    if (isLong || run.generation !== this.generation) this.restart();
    this.extend();
    this.whole.instanceCount = this.pieces;
    this.gone.instanceCount = Math.min(Math.floor(row / this.step), this.pieces);
  }

  private restart(): void {
    this.generation = this.run.generation;
    // Twice as coarse as it must be leaves room to grow.
    const { live } = this.run.scene;
    this.step = Math.max(1, Math.ceil(((this.run.rows - 1) * (live ? 2 : 1)) / MOST));
    this.pieces = 0;
    this.extend();
  }

  /** Adds the pieces whose rows are there by now. */
  private extend(): void {
    const { run, step } = this;
    const from = this.pieces;
    const to = Math.min(MOST, Math.floor(Math.max(0, run.rows - 1) / step));
    for (; this.pieces < to; this.pieces++) {
      const row = this.pieces * step;
      this.put(this.pieces * PIECE, row);
      this.put(this.pieces * PIECE + 3, row + step);
    }
    if (this.pieces === from) return;
    for (const made of [this.places, this.colours]) {
      made.addUpdateRange(from * PIECE, (this.pieces - from) * PIECE);
      made.needsUpdate = true;
    }
  }

  private put(at: number, row: number): void {
    AXES.forEach((axis, nth) => (this.places.array[at + nth] = this.run.at(axis, row)));
    const { colour } = this.run.modeAt(row);
    (colour ? this.colour.set(colour) : this.idle).toArray(this.colours.array, at);
  }
}

function buffer(): InstancedInterleavedBuffer {
  return new InstancedInterleavedBuffer(new Float32Array(MOST * PIECE), PIECE, 1);
}

function geometry(places: InstancedInterleavedBuffer, colours?: InstancedInterleavedBuffer): LineSegmentsGeometry {
  const made = new LineSegmentsGeometry();
  const ends = (name: string, of: InstancedInterleavedBuffer) => {
    made.setAttribute(`instance${name}Start`, new InterleavedBufferAttribute(of, 3, 0));
    made.setAttribute(`instance${name}End`, new InterleavedBufferAttribute(of, 3, 3));
  };
  ends("", places);
  if (colours) ends("Color", colours);
  made.instanceCount = 0;
  return made;
}
