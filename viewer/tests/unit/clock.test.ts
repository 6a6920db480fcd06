import { describe, expect, test } from "vitest";
import { Clock } from "../../src/clock";

describe("the clock", () => {
  test("runs at its speed, and stops at the end", () => {
    const clock = new Clock(0, 1);
    clock.setSpeed(2);
    clock.toggle();
    clock.advance(1000);
    expect(clock.t_s).toBe(0);
    clock.advance(1100);
    expect(clock.t_s).toBeCloseTo(0.2);
    for (let ms = 1200; ms < 2000; ms += 100) clock.advance(ms);
    expect(clock.t_s).toBe(1);
    expect(clock.playing).toBe(false);
    clock.toggle();
    expect(clock.t_s, "begins again").toBe(0);
  });

  test("does not leap after a while in the background", () => {
    const clock = new Clock(0, 1000);
    clock.toggle();
    clock.advance(0);
    clock.advance(60_000);
    expect(clock.t_s).toBeLessThanOrEqual(0.25);
  });

  test("does not run while it is paused", () => {
    const clock = new Clock(0, 10);
    clock.toggle();
    clock.advance(0);
    clock.pause();
    clock.advance(5000);
    expect(clock.t_s).toBe(0);
  });

  test("keeps within the run, and tells of every change", () => {
    const clock = new Clock(2, 5);
    let told = 0;
    clock.subscribe(() => told++);
    clock.seek(9);
    expect(clock.t_s).toBe(5);
    clock.seek(-9);
    expect(clock.t_s).toBe(2);
    clock.seek(Number.NaN);
    expect(clock.t_s).toBe(2);
    clock.changeSpeed(-1);
    expect(clock.speed).toBe(0.5);
    for (let step = 0; step < 20; step++) clock.changeSpeed(1);
    expect(clock.speed).toBe(8);
    expect(told).toBe(24);
  });
});
