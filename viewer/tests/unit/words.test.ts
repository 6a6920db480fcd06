import { describe, expect, test } from "vitest";
import { ModeColours, Run } from "../../src/run";
import { asked, decided, inside, measured, standing } from "../../src/words";
import { OBSTACLE, POSITION, VIEW, recorded } from "./recorded";

const run = new Run(recorded(), new ModeColours());

describe("a task in words", () => {
  test("says what is measured and what is asked", () => {
    expect(measured(OBSTACLE)).toBe("distance of tool to (0.4, 0, 0.1)");
    expect(asked(OBSTACLE)).toBe("at least 200\u202fmm");
    expect(measured({ ...VIEW, frame: "camera", relative_to: "wrist" })).toBe("z axis of camera in wrist against (1, 0, 0)");
    expect(asked(VIEW)).toBe("at most 0.2622 (15.07°)");
    expect(asked(POSITION)).toBe("through 2 points");
    const turns = [[1, 0, 0, 0], [0, 1, 0, 0]] as const;
    expect(asked({ ...POSITION, type: "pose", waypoints_quaternion_wxyz: [...turns] })).toBe("through 2 poses");
    expect(asked({ ...POSITION, type: "orientation", waypoints_m: [], waypoints_quaternion_wxyz: [turns[0]] })).toBe("to one orientation");
    expect(asked({ ...OBSTACLE, max: 0.4 })).toBe("200\u202fmm … 400\u202fmm");
  });

  test("of a type that this page does not know says its name", () => {
    expect(measured({ ...VIEW, type: "some_new_type" })).toBe("some new type of tool");
  });

  test("says how a set stands, and why", () => {
    const says = (row: number, task = OBSTACLE) => standing(run, task, row);
    expect(says(0)).toMatchObject({ state: "inside", short: "inside by 300.0\u202fmm", long: "" });
    expect(says(1)).toMatchObject({ state: "held", short: "held at its least" });
    expect(says(3)).toMatchObject({ state: "held", short: "frozen inside" });
    expect(says(4).long).toContain("Just let go");
    expect(says(2, VIEW)).toMatchObject({ state: "held", short: "driven back" });
    expect(says(3, VIEW)).toMatchObject({ state: "outside" });
  });

  test("says that a set is outside, and whether it is brought back in", () => {
    const left = new Run(recorded(), new ModeColours());
    const far = { ...OBSTACLE, min: 0.3 };
    expect(standing(left, far, 1)).toMatchObject({ state: "held", short: "held outside" });
    expect(standing(left, { ...far, recovery_per_s: 0.1 }, 1)).toMatchObject({ short: "brought in" });
    expect(standing(left, { ...far, min: 0.6 }, 0)).toMatchObject({ state: "outside", short: "outside" });
  });

  test("says how an equality task fares", () => {
    expect(standing(run, POSITION, 0)).toMatchObject({ state: "equality", short: "on its way", long: "" });
    expect(standing(run, POSITION, 1).long).toContain("what freedom the active sets leave");
    expect(standing(run, POSITION, 4)).toMatchObject({ short: "there" });
    expect(standing(run, POSITION, 4).long).toContain("singularity");
  });

  test("says what else decided the tick", () => {
    expect(decided(run, 0)).toEqual([]);
    expect(decided(run, 1)[0]).toContain("Corrected");
    expect(decided(run, 2)[0]).toContain("speed limit of elbow");
  });

  test("measures how far inside a value is", () => {
    expect(inside({ ...OBSTACLE, min: 1, max: 3 }, 2.5)).toBe(0.5);
    expect(inside({ ...OBSTACLE, min: 1 }, 0.5)).toBe(-0.5);
  });
});
