// Where every link of the robot is, from q.

import type { Robot, Rows } from "./protocol";

/** A pose: the first three rows of a homogeneous matrix, row by row. */
export type Pose = Float64Array;

export function pose(rows: Rows): Pose {
  return Float64Array.from(rows);
}

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/** `into` = a · b; `into` must be neither. */
function multiply(a: Pose, b: Pose, into: Pose): void {
  for (let row = 0; row < 12; row += 4) {
    const x = a[row]!, y = a[row + 1]!, z = a[row + 2]!;
    into[row] = x * b[0]! + y * b[4]! + z * b[8]!;
    into[row + 1] = x * b[1]! + y * b[5]! + z * b[9]!;
    into[row + 2] = x * b[2]! + y * b[6]! + z * b[10]!;
    into[row + 3] = x * b[3]! + y * b[7]! + z * b[11]! + a[row + 3]!;
  }
}

/** `inverse(a)` · a is the identity. */
export function inverse(a: Pose): Pose {
  const out = pose(IDENTITY);
  for (let row = 0; row < 3; row++) {
    for (let column = 0; column < 3; column++) out[4 * row + column] = a[4 * column + row]!;
    out[4 * row + 3] = -(a[row]! * a[3]! + a[4 + row]! * a[7]! + a[8 + row]! * a[11]!);
  }
  return out;
}

/** The poses of all bodies and links; `update` brings them to a configuration and allocates nothing. */
export class Kinematics {
  /** World from body; 0 is what does not move. */
  readonly bodies: Pose[];
  /** World from link. */
  readonly links: Pose[];
  private readonly placements: { before: Pose; after: Pose }[];
  private readonly onBody: Pose[];
  private readonly joint = pose(IDENTITY);
  private readonly moved = pose(IDENTITY);

  constructor(private readonly robot: Robot) {
    this.bodies = [IDENTITY, ...robot.bodies].map(() => pose(IDENTITY));
    this.placements = robot.bodies.map(({ before, after }) => ({
      before: pose(before),
      after: pose(after),
    }));
    this.onBody = robot.links.map((link) => pose(link.placement));
    this.links = robot.links.map(() => pose(IDENTITY));
    this.update(() => 0);
  }

  /** World from tool. */
  get tool(): Pose {
    return this.links[this.robot.tool]!;
  }

  /** Brings the robot to the configuration whose positions `q` gives by number of the joint. */
  update(q: (joint: number) => number): void {
    this.robot.bodies.forEach((body, i) => {
      const { before, after } = this.placements[i]!;
      const position = body.multiplier * q(body.joint) + body.offset;
      multiply(this.bodies[body.parent]!, before, this.joint);
      if (body.kind === "revolute") turn(this.joint, position, this.moved);
      else slide(this.joint, position, this.moved);
      multiply(this.moved, after, this.bodies[i + 1]!);
    });
    this.robot.links.forEach((link, i) => {
      multiply(this.bodies[link.body]!, this.onBody[i]!, this.links[i]!);
    });
  }
}

function turn(a: Pose, angle: number, into: Pose): void {
  const sin = Math.sin(angle), cos = Math.cos(angle);
  for (let row = 0; row < 12; row += 4) {
    const x = a[row]!, y = a[row + 1]!;
    into[row] = x * cos + y * sin;
    into[row + 1] = y * cos - x * sin;
    into[row + 2] = a[row + 2]!;
    into[row + 3] = a[row + 3]!;
  }
}

function slide(a: Pose, distance: number, into: Pose): void {
  into.set(a);
  for (let row = 0; row < 12; row += 4) into[row + 3] = a[row + 3]! + a[row + 2]! * distance;
}
