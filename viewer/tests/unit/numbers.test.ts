import { describe, expect, test } from "vitest";
import { hashOf, timeIn } from "../../src/address";
import { ends } from "../../src/panel/bar";
import { ticks } from "../../src/panel/timeline";
import { exact, fixed, quantity } from "../../src/quantity";

describe("numbers", () => {
  test("come with the unit in which they read well", () => {
    const cases: [number, string, string][] = [
      [0.1832, "m", "183.2\u202fmm"], [-0.2, "m", "−200.0\u202fmm"], [1.5, "m", "1.500\u202fm"],
      [Math.PI / 2, "rad", "90.00°"], [0.26, "-", "0.2600"], [Number.NaN, "m", "–"], [0.11, "m³", "0.1100\u202fm³"],
    ];
    for (const [value, unit, text] of cases) expect(quantity(value, unit)).toBe(text);
  });

  test("have no negative zero", () => {
    expect(fixed(-0.0001, 2)).toBe("0.00");
  });

  test("that stand still have as few digits as they need", () => {
    expect(exact(0.18, "m")).toBe("180\u202fmm");
    expect(exact(0.2622, "-")).toBe("0.2622");
  });

  test("on axes are round", () => {
    expect(ticks(0, 60, 6)).toEqual([0, 10, 20, 30, 40, 50, 60]);
    expect(ticks(-0.3, 0.3, 6)).toEqual([-0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3]);
    expect(ticks(1, 1, 5)).toEqual([]);
    expect(ticks(0, Number.NaN, 5)).toEqual([]);
  });

  test("of a time go into an address and come back", () => {
    for (const t_s of [0, 12.3, 59.992, 0.008]) expect(timeIn(hashOf(t_s))).toBe(t_s);
    expect(hashOf(0.1 + 0.2)).toBe("#t=0.3");
    for (const hash of ["", "#t=", "#t=x", "#t=1e9", "#x=1"]) expect(timeIn(hash)).toBeNull();
  });

  test("bound a bar with a margin, whatever is missing", () => {
    const [low, high] = ends([1, 2], [0, null]);
    expect(low).toBeLessThan(0);
    expect(high).toBeGreaterThan(2);
    expect(ends([5, 5], [])[0]).toBeLessThan(5);
  });
});
