// Groups that move with the robot's links: what is in the axes of a link is hung into its group.

import { Group, Vector3 } from "three";
import type { Kinematics } from "../kinematics";
import type { Robot } from "../protocol";
import { origin, place } from "./pose";

export class Frames {
  readonly object = new Group();
  private readonly world = new Group();
  private readonly used = new Map<number, Group>();
  private readonly numbers: Map<string, number>;

  constructor(private readonly robot: Robot, private readonly kinematics: Kinematics) {
    this.numbers = new Map(robot.links.map((link, number) => [link.name, number]));
    this.object.add(this.world);
  }

  /** The group of a link; without a name, the world's. */
  group(link: string | undefined): Group {
    const number = link === undefined ? undefined : this.numbers.get(link);
    if (number === undefined) return this.world;
    const known = this.used.get(number);
    if (known) return known;
    const made = new Group();
    this.used.set(number, made);
    this.object.add(made);
    return made;
  }

  /** The group of the tool. */
  get tool(): Group {
    return this.group(this.robot.links[this.robot.tool]!.name);
  }

  /** Where a frame is; without a name, the tool. */
  at(frame: string | undefined, into: Vector3): Vector3 {
    return origin(this.pose(frame), into);
  }

  /** A direction in a frame, in the world; without a name, the frame is the world. */
  direction(frame: string | undefined, of: readonly number[], into: Vector3): Vector3 {
    const [x = 0, y = 0, z = 0] = of;
    if (frame === undefined) return into.set(x, y, z);
    const p = this.pose(frame);
    return into.set(
      p[0]! * x + p[1]! * y + p[2]! * z,
      p[4]! * x + p[5]! * y + p[6]! * z,
      p[8]! * x + p[9]! * y + p[10]! * z,
    );
  }

  /** Name of the frame that a task measures. */
  measured(frame: string | undefined): string {
    return frame ?? this.robot.links[this.robot.tool]!.name;
  }

  update(): void {
    for (const [number, group] of this.used) place(group, this.kinematics.links[number]!);
  }

  private pose(frame: string | undefined) {
    const number = this.numbers.get(this.measured(frame));
    return number === undefined ? this.kinematics.tool : this.kinematics.links[number]!;
  }
}
