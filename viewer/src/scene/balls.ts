// Balls that are seen through. Those that look alike and move with the same link are drawn at once, so that
// fifty obstacles cost little more than one.

import { type BufferGeometry, type Group, InstancedMesh, Matrix4, type Mesh } from "three";
import type { Frames } from "./frames";
import { Glasses, isBright, type Kind, type State } from "./glass";
import type { Part } from "./parts";

export interface Ball {
  part: Part;
  /** Not drawn itself: the ball is where this is. */
  mesh: Mesh;
  /** What the mesh hangs in, in the axes of its frame. */
  object: Group;
}

export class Balls {
  private readonly glasses = new Glasses();
  private readonly flocks = new Map<string, InstancedMesh>();
  /** Where each ball is drawn: in which mesh, and which of its balls it is. */
  private readonly seats = new Map<Ball, { mesh: InstancedMesh; nth: number }>();
  private readonly matrix = new Matrix4();

  /** `geometry` is that of a ball of radius 1. */
  constructor(private readonly frames: Frames, private readonly geometry: BufferGeometry) {}

  /** Draws these balls, each as its state asks for, and no others. */
  arrange(balls: readonly { ball: Ball; state: State }[]): void {
    this.seats.clear();
    for (const mesh of this.flocks.values()) mesh.count = 0;
    const alike = new Map<string, Ball[]>();
    for (const { ball, state } of balls) {
      const key = `${ball.part.kind} ${state} ${ball.part.frame ?? ""}`;
      const group = alike.get(key);
      if (group) group.push(ball);
      else alike.set(key, [ball]);
    }
    for (const [key, group] of alike) {
      const mesh = this.flock(key, group);
      group.forEach((ball, nth) => {
        this.seats.set(ball, { mesh, nth });
        this.move(ball);
      });
    }
  }

  /** Brings a ball to where it is now. */
  move(ball: Ball): void {
    const seat = this.seats.get(ball);
    if (!seat) return;
    seat.mesh.setMatrixAt(seat.nth, this.matrix.multiplyMatrices(ball.object.matrix, ball.mesh.matrix));
    seat.mesh.instanceMatrix.needsUpdate = true;
  }

  paint(rest: string, lit: string, chosen: string): void {
    this.glasses.paint(rest, lit, chosen);
  }

  /** A mesh with room for a group of balls, which are alike. */
  private flock(key: string, group: Ball[]): InstancedMesh {
    const known = this.flocks.get(key);
    if (known && known.instanceMatrix.count >= group.length) {
      known.count = group.length;
      return known;
    }
    known?.removeFromParent();
    known?.dispose();
    const [kind, state] = key.split(" ") as [Kind, State];
    const mesh = new InstancedMesh(this.geometry, this.glasses.glass(kind, state), group.length);
    // What is active is not veiled by what is not.
    mesh.renderOrder = isBright(state) ? 1 : 0;
    mesh.frustumCulled = false;
    mesh.matrixAutoUpdate = false;
    this.frames.group(group[0]!.part.frame).add(mesh);
    this.flocks.set(key, mesh);
    return mesh;
  }
}
