// Where the arm says that it is, drawn through the one that is asked of it, where the two differ.

import { Kinematics } from "../kinematics";
import type { Run } from "../run";
import { Arm } from "./arm";
import type { Look } from "./look";

/** A difference in a joint that can be seen [rad, or m where it slides]. */
const SEEN = { revolute: (0.5 * Math.PI) / 180, prismatic: 0.005 };
const OPACITY = 0.38;

export class Measured {
  private readonly arm: Arm;
  private readonly kinematics: Kinematics;

  constructor(private readonly run: Run, reach: number, floor: number) {
    const { robot } = run.scene;
    this.kinematics = new Kinematics(robot);
    this.arm = new Arm(robot, reach, floor);
    this.arm.fade(OPACITY);
    this.arm.object.visible = false;
  }

  get object() {
    return this.arm.object;
  }

  paint({ accent }: Look): void {
    this.arm.paint(accent, accent, accent);
  }

  update(row: number): void {
    const { run } = this;
    const { joints } = run.scene.robot;
    const measured = (joint: number) => run.at(`q${joint + 1}_measured_rad`, row);
    const differs = joints.some(({ kind }, joint) => Math.abs(measured(joint) - run.q(joint, row)) > SEEN[kind]);
    this.arm.object.visible = differs;
    if (!differs) return;
    this.kinematics.update((joint) => measured(joint) || 0);
    this.arm.update(this.kinematics);
  }
}
