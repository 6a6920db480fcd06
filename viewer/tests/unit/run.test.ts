import { describe, expect, test } from "vitest";
import { ModeColours, Run } from "../../src/run";
import { OBSTACLE, VIEW, recorded } from "./recorded";

const run = new Run(recorded(), new ModeColours());

describe("a run", () => {
  test("knows the row in force at a time", () => {
    const rows: [number, number][] = [[-1, 0], [0, 0], [0.49, 0], [0.5, 1], [0.4999999, 1], [1.99, 3], [2, 4], [9, 4]];
    for (const [t_s, row] of rows) expect(run.rowAt(t_s), `at ${t_s}`).toBe(row);
  });

  test("is parted where the mode changes", () => {
    expect(run.spans.map(({ from_s, to_s, mode }) => [from_s, to_s, mode.label])).toEqual([
      [0, 0.5, "no set active"],
      [0.5, 1, "obstacle"],
      [1, 1.5, "obstacle + view"],
      [1.5, 2, "obstacle"],
      [2, 2, "no set active"],
    ]);
    expect(run.changes_s).toEqual([0.5, 1, 1.5, 2]);
    expect(run.activeSpans(OBSTACLE)).toHaveLength(3);
    expect(run.activeSpans(VIEW)).toHaveLength(1);
  });

  test("gives each mode the colour that the figures give it", () => {
    expect(run.modes.map((mode) => mode.colour)).toEqual([null, "#D55E00", "#0072B2"]);
  });

  test("shares the colours of modes with the run beside it", () => {
    const colours = new ModeColours();
    const other = recorded();
    other.ticks.active_sets = [[], ["view", "obstacle"], ["obstacle"]];
    const runs = [new Run(recorded(), colours), new Run(other, colours)];
    expect(runs[1]!.modes[1]!.colour).toBe(runs[0]!.modes[2]!.colour);
    expect(runs[1]!.modes[2]!.colour).toBe(runs[0]!.modes[1]!.colour);
  });

  test("has no number where none was logged", () => {
    expect(run.at("q1_rad", 4)).toBeNaN();
    expect(run.at("nothing", 0)).toBeNaN();
    expect(run.at(null, 0)).toBeNaN();
    expect(run.range("q1_rad")).toEqual([0, 0.3]);
  });

  test("tells why", () => {
    expect(run.reasons(1)).toEqual(["hold:obstacle", "corrected"]);
    expect(run.reasons(99)).toEqual([]);
    const silent = recorded();
    [silent.ticks.why, silent.ticks.reasons] = [[], []];
    expect(new Run(silent, new ModeColours()).reasons(1)).toEqual([]);
  });
});
