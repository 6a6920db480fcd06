// What can be moved and changed, and what is sent for it.

import { Ray, Vector3 } from "three";
import { describe, expect, test } from "vitest";
import { handles } from "../../src/edit/handles";
import { listed, placed } from "../../src/edit/order";
import { read, unitOf, written } from "../../src/edit/units";
import type { Obstacle, Task } from "../../src/protocol";
import { along, facing } from "../../src/scene/course";
import { nowOf, startOf } from "../../src/scene/motion";
import { OBSTACLE, POSITION, VIEW, recorded } from "./recorded";

const { scene } = recorded();
const all = (tasks: Task[], obstacles: Obstacle[] = []) => handles({ ...scene, tasks, obstacles });

describe("what can be moved", () => {
  test("is a point, each waypoint by itself, and a direction", () => {
    const found = all([OBSTACLE, POSITION, VIEW]);
    expect(found.map(({ label, kind }) => [label, kind])).toEqual([
      ["obstacle", "body"], ["waypoint 1 of position", "point"], ["waypoint 2 of position", "point"], ["direction of view", "direction"],
    ]);
    expect(found[2]!.move([5, 6, 7])).toEqual([{ task: "position", key: "waypoints_m", value: [[1, 0, 0], [5, 6, 7]] }]);
    expect(found[3]!.move([0, 1, 0])).toEqual([{ task: "view", key: "direction", value: [0, 1, 0] }]);
  });

  test("is not what has no place: a distance of shapes, a joint, a posture", () => {
    const types = ["shape_distance", "joint", "posture", "manipulability", "elbow"];
    const tasks = types.map((type): Task => ({ ...VIEW, name: type, type, ...(type === "elbow" ? {} : { direction: undefined as never }) }));
    expect(all(tasks)).toEqual([]);
  });

  test("is an obstacle by its middle, and a capsule keeps its length", () => {
    const capsule: Obstacle = { name: "post", type: "capsule", from_m: [0, 0, 0], to_m: [0, 0, 2], radius_m: 0.1 };
    const [handle] = all([], [capsule]);
    expect(handle!.at).toEqual([0, 0, 1]);
    expect(handle!.move([1, 1, 1])).toEqual([
      { obstacle: "post", key: "from_m", value: [1, 1, 0] },
      { obstacle: "post", key: "to_m", value: [1, 1, 2] },
    ]);
  });

  test("may move by itself, and is then sent where it is now", () => {
    const motion = { velocity_m_per_s: [1, 0, 0], moves_until_s: 2 } as const;
    expect(nowOf([0, 5, 0], motion, false, 1.5)).toEqual([1.5, 5, 0]);
    expect(nowOf([0, 5, 0], motion, false, 9)).toEqual([2, 5, 0]);
    expect(startOf([2, 5, 0], motion, false, 9)).toEqual([0, 5, 0]);
    const turning = { angular_velocity_rad_per_s: [0, 0, Math.PI / 2] } as const;
    const turned = nowOf([1, 0, 0], turning, true, 1);
    expect(turned[1]).toBeCloseTo(1, 12);
    startOf(turned, turning, true, 1).forEach((value, nth) => expect(value).toBeCloseTo([1, 0, 0][nth]!, 12));
  });
});

describe("a hand that drags", () => {
  const from = new Vector3(0, -4, 0);
  const ray = (x: number, z: number) => new Ray(from.clone(), new Vector3(x, 4, z).normalize());

  test("stays in the plane that faces whoever looks", () => {
    const met = facing(new Vector3(0, 0, 0), new Vector3(0, 1, 0)).meet(ray(0.5, 0.25))!;
    met.toArray().forEach((value, nth) => expect(value).toBeCloseTo([0.5, 0, 0.25][nth]!, 12));
  });

  test("stays on a line, at the point that is nearest", () => {
    const met = along(new Vector3(0, 0, 0), new Vector3(0, 0, 1)).meet(ray(0.5, 0.25))!;
    expect([met.x, met.y]).toEqual([0, 0]);
    expect(met.z).toBeGreaterThan(0.2);
    expect(met.z).toBeLessThan(0.26);
  });

  test("throws nothing to the horizon", () => {
    expect(facing(new Vector3(0, 0, -0.5), new Vector3(0, 0, 1)).meet(ray(0, -0.01))).toBeNull();
    expect(along(new Vector3(0, 0, 0), new Vector3(0, 1, 0)).meet(ray(0, 0)), "a line seen end on").toBeNull();
  });
});

describe("numbers as people write them", () => {
  test("are in the units that the page shows, and back", () => {
    const cases: [Task, string, number, string, string][] = [
      [OBSTACLE, "min", 0.18, "180", "mm"],
      [VIEW, "max", 2 * Math.sin((15 * Math.PI) / 360), "15", "°"],
      [{ ...VIEW, type: "look_at", unit: "rad" }, "max", Math.PI / 6, "30", "°"],
      [POSITION, "gain_per_s", 0.3, "0.3", "1/s"],
      [POSITION, "acceptance_m", 0.02, "20", "mm"],
      [{ ...VIEW, type: "look_at", unit: "rad" }, "recovery_per_s", Math.PI / 180, "1", "°/s"],
    ];
    for (const [task, key, value, text, name] of cases) {
      const unit = unitOf(task, key);
      expect(written(value, unit), key).toBe(text);
      expect(unit.name).toBe(name);
      expect(read(text, unit)).toBeCloseTo(value, 6);
    }
  });

  test("may have a comma or a true minus, and are numbers", () => {
    const unit = unitOf(POSITION, "gain_per_s");
    expect(read(" 0,5 ", unit)).toBe(0.5);
    expect(read("−2", unit)).toBe(-2);
    for (const text of ["", "x", "1e999", "NaN", "1 2"]) expect(read(text, unit), text).toBeUndefined();
  });
});

describe("the order of tasks", () => {
  test("is that of the scenario's list, without what joints and shapes became", () => {
    const limit = { ...VIEW, name: "limit/elbow" };
    const pair = { ...VIEW, name: "hand/post", between: ["hand", "post"] as [string, string] };
    const gap = { ...VIEW, name: "gap", between: ["hand", "post"] as [string, string] };
    expect(listed([limit, pair, gap, POSITION])).toEqual(["gap", "position"]);
  });

  test("changes by one task that goes elsewhere", () => {
    const names = ["a", "b", "c"];
    expect(placed(names, "a", 1)).toEqual(["b", "a", "c"]);
    expect(placed(names, "c", 0)).toEqual(["c", "a", "b"]);
    expect(placed(names, "b", 9)).toEqual(["a", "c", "b"]);
    expect(placed(names, "b", -1)).toEqual(["b", "a", "c"]);
  });
});
