// A run that is going on: rows come in pieces, and the scene changes.

import { describe, expect, test } from "vitest";
import type { Ticks } from "../../src/protocol";
import { ModeColours, Run } from "../../src/run";
import { shared } from "../../src/shared";
import { OBSTACLE, recorded } from "./recorded";

/** Rows of a recorded run as a message, its sets numbered in the message's own way. */
function piece(from: number, to: number): Ticks {
  const { ticks } = recorded();
  const cut = <T>(list: T[]) => list.slice(from, to);
  const active_sets = [...ticks.active_sets].reverse();
  const last = active_sets.length - 1;
  return {
    ...ticks, t_s: cut(ticks.t_s), mode: cut(ticks.mode), active: cut(ticks.active).map((nth) => last - nth), active_sets,
    why: cut(ticks.why), columns: Object.fromEntries(Object.entries(ticks.columns).map(([name, list]) => [name, cut(list)])),
  };
}

function begun(): Run {
  const run = recorded();
  return new Run({ ...run, ticks: piece(0, 0) }, new ModeColours());
}

describe("a run that is going on", () => {
  test("is in the end what it is if it is read at once", () => {
    const run = begun();
    for (const [from, to] of [[0, 1], [1, 3], [3, 3], [3, 5]] as const) run.take(piece(from, to));
    const whole = new Run(recorded(), new ModeColours());
    expect([...run.t_s]).toEqual([...whole.t_s]);
    const told = ({ spans }: Run) => spans.map(({ from_s, to_s, mode }) => [from_s, to_s, mode.label]);
    expect(told(run)).toEqual(told(whole));
    for (let row = 0; row < 5; row++) {
      expect(run.modeAt(row).label).toBe(whole.modeAt(row).label);
      expect(run.modeNumber(row)).toBe(whole.modeNumber(row));
      expect(run.reasons(row)).toEqual(whole.reasons(row));
      for (const name of whole.names) expect(run.at(name, row), `${name} ${row}`).toBe(whole.at(name, row));
    }
    expect(run.range("obstacle")).toEqual(whole.range("obstacle"));
  });

  test("has a range that widens with its rows", () => {
    const run = begun();
    expect(run.range("obstacle")).toEqual([0, 0]);
    run.take(piece(0, 1));
    expect(run.range("obstacle")).toEqual([0.5, 0.5]);
    run.take(piece(1, 5));
    expect(run.range("obstacle")).toEqual([0.2, 0.5]);
  });

  test("forgets everything when it begins again", () => {
    const run = begun();
    run.take(piece(0, 5));
    run.take({ ...piece(3, 4), reset: true });
    expect([...run.t_s]).toEqual([1.5]);
    expect(run.spans).toHaveLength(1);
    expect(run.range("obstacle")).toEqual([0.25, 0.25]);
    expect(run.generation).toBe(1);
  });

  test("has nothing in rows before a column was first heard of", () => {
    const run = begun();
    run.take(piece(0, 2));
    const late = piece(2, 3);
    late.columns["q1_measured_rad"] = [0.7];
    run.take(late);
    expect(run.at("q1_measured_rad", 1)).toBeNaN();
    expect(run.at("q1_measured_rad", 2)).toBe(0.7);
    run.take(piece(3, 5));
    expect(run.at("q1_measured_rad", 4)).toBeNaN();
    expect(run.column("q1_measured_rad")).toHaveLength(5);
  });

  test("has in the past the scene that was in force then", () => {
    const run = begun();
    run.take(piece(0, 5));
    const before = run.scene;
    const tasks = before.tasks.map((task) => (task.name === "obstacle" ? { ...task, min: 0.3 } : { ...task }));
    run.change({ ...before, tasks }, 1);
    const min = (t_s: number) => run.sceneAt(t_s).tasks[0]!.min;
    expect([min(0.5), min(1), min(2)]).toEqual([0.2, 0.3, 0.3]);
    expect(run.scene.tasks[1], "what did not change is the same").toBe(before.tasks[1]);
    expect(run.scene.tasks[0]).not.toBe(before.tasks[0]);
  });

  test("knows what bounded a task when, wherever it stood in the list", () => {
    const run = begun();
    run.take(piece(0, 5));
    const { scene } = run;
    const { min, max = null } = scene.tasks[0]!;
    const changed = scene.tasks.map((task) => (task.name === "obstacle" ? { ...task, min: 0.3 } : task));
    run.change({ ...scene, title: "another", tasks: scene.tasks.map((task) => ({ ...task })) }, 0.5);
    run.change({ ...scene, tasks: changed }, 1);
    run.change({ ...scene, tasks: [...changed].reverse() }, 1.5);
    run.change({ ...scene, tasks: changed.slice(1) }, 2);
    expect(run.boundsOf("obstacle")).toEqual([
      { from_s: Number.NEGATIVE_INFINITY, min, max },
      { from_s: 1, min: 0.3, max },
      { from_s: 2, min: null, max: null },
    ]);
  });

  test("knows what was on its way when", () => {
    const run = begun();
    run.take(piece(0, 2));
    expect(run.glidingAt(1).size).toBe(0);
    run.take({ ...piece(2, 3), gliding: [{ name: "obstacle", away_m: [0.1, 0, 0] }] });
    expect(run.glidingAt(1).get("obstacle")?.away_m).toEqual([0.1, 0, 0]);
    run.take({ ...piece(3, 5), gliding: [] });
    expect(run.glidingAt(2).size).toBe(0);
    expect(run.glidingAt(1.2).size).toBe(1);
  });
});

describe("a scene after another", () => {
  test("shares what has not changed, also in another order", () => {
    const { scene } = recorded();
    const copy = structuredClone(scene);
    expect(shared(scene, copy).tasks).toBe(scene.tasks);
    const turned = { ...copy, tasks: [...copy.tasks].reverse() };
    const next = shared(scene, turned);
    expect(next.tasks).not.toBe(scene.tasks);
    expect(next.tasks[2]).toBe(OBSTACLE);
  });
});
