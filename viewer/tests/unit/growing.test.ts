import { describe, expect, test } from "vitest";
import { Growing } from "../../src/growing";
import { History } from "../../src/history";

describe("numbers that become more", () => {
  test("are kept, and nothing is nothing", () => {
    const growing = new Growing();
    for (let nth = 0; nth < 1000; nth++) growing.add([nth, null, -nth]);
    expect(growing.length).toBe(3000);
    expect(growing.at(3 * 777)).toBe(777);
    expect(growing.at(3 * 777 + 1)).toBeNaN();
    expect(growing.at(3000)).toBeNaN();
    expect([...growing.values.slice(-3)]).toEqual([999, Number.NaN, -999]);
    growing.clear();
    expect(growing.values).toHaveLength(0);
    growing.fill(2);
    growing.add([5]);
    expect([...growing.values]).toEqual([Number.NaN, Number.NaN, 5]);
  });

  test("are copied so seldom that an hour at 125 Hz is nothing", () => {
    const growing = new Growing();
    const rooms = new Set<ArrayBufferLike>();
    for (let nth = 0; nth < 3600 * 30; nth++) {
      growing.add([1, 2, 3, 4]);
      rooms.add(growing.values.buffer);
    }
    expect(growing.length).toBe(432_000);
    expect(rooms.size).toBeLessThan(15);
  });
});

describe("what was in force", () => {
  test("is what began last, until the next", () => {
    const history = new History("first");
    history.add(1, "second");
    history.add(2, "third");
    const at: [number, string][] = [[-5, "first"], [0.9, "first"], [1, "second"], [0.9999999, "second"], [1.9, "second"], [2, "third"], [99, "third"]];
    for (const [t_s, thing] of at) expect(history.at(t_s), `at ${t_s}`).toBe(thing);
    expect(history.last).toBe("third");
  });

  test("is overtaken by what began at the same time or before", () => {
    const history = new History("first");
    history.add(1, "second");
    history.add(3, "third");
    history.add(1, "fourth");
    expect([history.at(0), history.at(1), history.at(5)]).toEqual(["first", "fourth", "fourth"]);
  });

  test("is thinned when a hand drags for minutes, and begins and ends as before", () => {
    const history = new History(0);
    for (let nth = 1; nth <= 20_000; nth++) history.add(nth, nth);
    expect(history.at(0)).toBe(0);
    expect(history.at(20_000)).toBe(20_000);
    expect(Math.abs(history.at(19_000) - 19_000)).toBeLessThan(10);
    const kept = new Set(Array.from({ length: 20_001 }, (_, t_s) => history.at(t_s)));
    expect(kept.size).toBeLessThan(5000);
  });
});
