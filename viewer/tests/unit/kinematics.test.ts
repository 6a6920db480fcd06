import { describe, expect, test } from "vitest";
import { Kinematics, inverse, pose } from "../../src/kinematics";
import type { Body, Robot } from "../../src/protocol";

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
const at = (x: number, y: number, z: number) => [1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z];
/** x to y, y to z, z to x, then 1, 2, 3. */
const TURNED = [0, 0, 1, 1, 1, 0, 0, 2, 0, 1, 0, 3];

function robot(bodies: Partial<Body>[], link: { body: number; placement: number[] }): Robot {
  const whole = bodies.map((body, joint) => ({
    parent: joint, before: IDENTITY, after: IDENTITY, kind: "revolute" as const, joint, multiplier: 1, offset: 0, ...body,
  }));
  return { name: "", joints: [], bodies: whole, links: [{ name: "tool", ...link }], tool: 0 };
}

function tool(robot: Robot, ...q: number[]): number[] {
  const kinematics = new Kinematics(robot);
  kinematics.update((joint) => q[joint]!);
  return [3, 7, 11].map((i) => kinematics.tool[i]!);
}

function near(found: number[], wanted: number[]): void {
  wanted.forEach((value, i) => expect(found[i]).toBeCloseTo(value, 12));
}

describe("kinematics of the page", () => {
  test("of two arms in a plane are the sums of their angles", () => {
    const two = robot([{ after: at(2, 0, 0) }, { after: at(1, 0, 0) }], { body: 2, placement: IDENTITY });
    near(tool(two, 0.3, 0.4), [2 * Math.cos(0.3) + Math.cos(0.7), 2 * Math.sin(0.3) + Math.sin(0.7), 0]);
  });

  test("slide along the z axis of the joint", () => {
    const rail = robot([{ before: TURNED, kind: "prismatic" }], { body: 1, placement: IDENTITY });
    // z of the joint is x of the world.
    near(tool(rail, 0.5), [1.5, 2, 3]);
  });

  test("let a follower follow", () => {
    const gripper = robot(
      [{ kind: "prismatic" }, { kind: "prismatic", parent: 0, joint: 0, multiplier: -2, offset: 0.1 }],
      { body: 2, placement: at(0, 0, 1) },
    );
    near(tool(gripper, 0.3), [0, 0, 0.5]);
  });

  test("undo a pose", () => {
    const back = inverse(pose(TURNED));
    const there = robot([{ before: TURNED, after: [...back] }], { body: 1, placement: IDENTITY });
    near(tool(there, 0), [0, 0, 0]);
  });
});
