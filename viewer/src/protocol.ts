// The page's data, version 1, as docs/page.md describes it. What is here comes from another program
// and is read only.

export const PROTOCOL = 1;

/** Three coordinates [m], or a direction. */
export type Vector = readonly [number, number, number];

/** An orientation, its real part first. */
export type Quaternion = readonly [number, number, number, number];

/** The first three rows of a homogeneous matrix, row by row. */
export type Rows = readonly number[];

export interface Recording {
  kind: "recording";
  protocol: number;
  /** One, or two to be compared. */
  runs: RecordedRun[];
}

export interface RecordedRun {
  name: string;
  scene: Scene;
  /** The scenes after changes that people made, each with `from_s` and without its robot. */
  later?: Scene[];
  ticks: Ticks;
}

/** What there is. */
export interface Scene {
  kind: "scene";
  protocol: number;
  title: string | null;
  live: boolean;
  editable: boolean;
  /** Of a run that is going on: its file's name, how many changes there were, and since when it holds. */
  name?: string;
  revision?: number;
  from_s?: number;
  arm: string;
  rate_hz: number;
  duration_s: number;
  settings: { mode_rule: string; border: string; recursion: string };
  robot: Robot;
  shapes: LinkShape[];
  obstacles: Obstacle[];
  tasks: Task[];
  result: Result | null;
}

export interface Robot {
  name: string;
  joints: Joint[];
  bodies: Body[];
  links: Link[];
  tool: number;
}

export type JointKind = "revolute" | "prismatic";

export interface Joint {
  name: string;
  kind: JointKind;
  position_limits: [number | null, number | null] | null;
  speed_limit: number | null;
  acceleration_limit: number | null;
}

/** world_from_body[i] = world_from_body[parent] · before · motion(multiplier · q[joint] + offset) · after */
export interface Body {
  parent: number;
  before: Rows;
  after: Rows;
  kind: JointKind;
  joint: number;
  multiplier: number;
  offset: number;
}

export interface Link {
  name: string;
  body: number;
  placement: Rows;
}

export type Geometry =
  | { type: "sphere"; center_m: Vector; radius_m: number }
  | { type: "capsule" | "cylinder"; from_m: Vector; to_m: Vector; radius_m: number }
  | { type: "box"; center_m: Vector; size_m: Vector; rotation_rad?: Vector }
  | { type: "half_space"; point_m: Vector; normal: Vector };

/** How something moves: a point along a straight line, a direction about an axis, a desired value. */
export interface Motion {
  velocity_m_per_s?: Vector;
  angular_velocity_rad_per_s?: Vector;
  desired_per_s?: number;
  moves_until_s?: number;
}

export type LinkShape = Geometry & { name: string; link: string };

export type Obstacle = Geometry & Motion & { name: string; distance_m?: number };

export type Role = "high-priority set" | "equality" | "low-priority set";

/** A task, with its own keys as in the scenario. */
export interface Task extends Motion {
  name: string;
  type: string;
  role: Role;
  unit: string;
  /** Column of its value. */
  value: string | null;
  /** Column of the norm of its error. */
  error: string | null;
  /** The two shapes that it keeps apart. */
  between: [string, string] | null;
  min?: number | null;
  max?: number | null;
  desired?: number[];
  gain_per_s?: number;
  recovery_per_s?: number;
  frame?: string;
  relative_to?: string;
  waypoints_m?: Vector[];
  waypoints_quaternion_wxyz?: Quaternion[];
  acceptance_m?: number;
  acceptance_rad?: number;
  target_m?: Vector;
  desired_quaternion_wxyz?: Quaternion;
  point_m?: Vector;
  direction?: Vector;
  axis?: string | Vector;
  normal?: Vector;
  offset_m?: number;
  joint?: number;
  joints?: number[];
  part?: string;
}

export type Outcome =
  | { kind: "running" | "completed" | "interrupted" }
  | { kind: "fault"; name: string; detail: string };

export interface Property {
  holds: boolean;
  worst: number;
  at_s: number | null;
  task: string | null;
}

export interface Result {
  outcome: Outcome;
  ended_at_s: number;
  waypoints_reached_s: (number | null)[];
  properties: Record<string, Property>;
  step_time_us: StepTime;
  deadline_misses: number;
  monitors?: Record<string, unknown> | null;
}

export interface StepTime {
  median: number;
  p99: number;
  max: number;
}

/** What happened, column by column; a row is a tick. */
export interface Ticks {
  kind: "ticks";
  protocol: number;
  every: number;
  t_s: number[];
  mode: (number | null)[];
  active: number[];
  active_sets: string[][];
  why: number[];
  reasons: string[][];
  columns: Record<string, (number | null)[]>;
  /** Of a run that is going on: this is all there is, and what came before is to be forgotten. */
  reset?: boolean;
  gliding?: Glide[];
}

/** What to add to where the scene has something, to have where it is: it is on its way. */
export interface Glide {
  name: string;
  away_m?: Vector;
  away_rad?: Vector;
  away_min?: number;
  away_max?: number;
}
