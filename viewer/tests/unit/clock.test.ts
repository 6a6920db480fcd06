import { describe, expect, test } from "vitest";
import { Clock, horizon } from "../../src/clock";

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

describe("the clock of a run that is going on", () => {
  const live = () => {
    const clock = new Clock(0, 0);
    clock.live = true;
    clock.grow(0, 5);
    clock.follow();
    return clock;
  };

  test("stays at now while it follows, and in the past when somebody looks there", () => {
    const clock = live();
    clock.grow(0, 6);
    expect(clock.t_s).toBe(6);
    clock.seek(2);
    clock.grow(0, 9);
    expect([clock.t_s, clock.following]).toEqual([2, false]);
    clock.seek(99);
    expect([clock.t_s, clock.following]).toEqual([9, true]);
  });

  test("goes on with the run when a replay has caught up", () => {
    const clock = live();
    clock.seek(4.9);
    clock.toggle();
    for (const ms of [0, 100, 200]) clock.advance(ms);
    expect([clock.t_s, clock.following, clock.playing]).toEqual([5, true, false]);
  });

  test("goes back with a run that begins again", () => {
    const clock = live();
    clock.seek(4);
    clock.grow(0, 1);
    expect(clock.t_s).toBe(1);
  });

  test("stops at the end of a run that is over", () => {
    const clock = live();
    clock.live = false;
    clock.seek(5);
    expect(clock.following).toBe(false);
  });

  test("has axes that end somewhat later, at a round time", () => {
    const ends = [0, 10, 10.1, 59, 61, 299, 301, 3600].map(horizon);
    expect(ends).toEqual([10, 10, 20, 60, 90, 300, 600, 3600]);
  });
});
