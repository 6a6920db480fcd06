// A run made up for tests: two joints, an obstacle, a view of low priority and a position.

import type { RecordedRun, Task } from "../../src/protocol";

export const OBSTACLE: Task = {
  name: "obstacle", type: "distance", role: "high-priority set", unit: "m", value: "obstacle", error: null,
  between: null, point_m: [0.4, 0, 0.1], min: 0.2,
};
export const POSITION: Task = {
  name: "position", type: "position", role: "equality", unit: "m", value: null, error: "position_error",
  between: null, waypoints_m: [[1, 0, 0], [0, 1, 0]], acceptance_m: 0.02, gain_per_s: 0.5,
};
export const VIEW: Task = {
  name: "view", type: "field_of_view", role: "low-priority set", unit: "-", value: "view", error: null,
  between: null, direction: [1, 0, 0], max: 0.2622, gain_per_s: 1,
};

const JOINT = { kind: "revolute", position_limits: null, speed_limit: 3, acceleration_limit: null } as const;

export function recorded(): RecordedRun {
  return {
    name: "made-up",
    scene: {
      kind: "scene", protocol: 1, title: null, live: false, editable: false, arm: "ideal", rate_hz: 2, duration_s: 2,
      settings: { mode_rule: "cone", border: "land", recursion: "siciliano-slotine" },
      robot: {
        name: "two", tool: 0, bodies: [], links: [],
        joints: [{ ...JOINT, name: "shoulder" }, { ...JOINT, name: "elbow" }],
      },
      shapes: [], obstacles: [], tasks: [OBSTACLE, POSITION, VIEW], result: null,
    },
    ticks: {
      kind: "ticks", protocol: 1, every: 1,
      t_s: [0, 0.5, 1, 1.5, 2],
      mode: [1, 2, 4, 2, 1],
      active: [0, 1, 2, 1, 0],
      active_sets: [[], ["obstacle"], ["obstacle", "view"]],
      why: [0, 1, 2, 3, 4],
      reasons: [[], ["hold:obstacle", "corrected"], ["hold:obstacle", "hold:view", "speed:q2"], ["hold-inside:obstacle"], ["free:obstacle", "rank:position"]],
      columns: {
        obstacle: [0.5, 0.2, 0.2, 0.25, 0.3],
        view: [0.1, 0.2, 0.3, 0.28, 0.2],
        position_error: [1, 0.5, 0.2, 0.1, 0.0001],
        waypoint: [0, 0, 1, 1, 1],
        q1_rad: [0, 0.1, 0.2, 0.3, null],
      },
    },
  };
}
