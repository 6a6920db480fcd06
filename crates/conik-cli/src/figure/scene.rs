//! What is drawn of the space around the arm: path, obstacles, waypoints, and the floor below them.

use conik::{Pose, Shape, Vec3};
use conik_sim::scenario::{GoalConfig, TaskConfig, TaskKind};

use super::axis::nice_step;
use super::camera::{Vector, difference, dot};
use super::curve::decimate_in_space;
use super::obstacles::{Cell, Obstacle, Surroundings, at_end};
use super::run::Run;
use super::solid::rim;

/// Everything drawn in three dimensions.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The tool's path, in pieces of one mode each; a piece begins where the last one ended.
    pub path: Vec<Piece>,
    /// What stands around.
    pub around: Surroundings,
    /// Where the tool should go, in order.
    pub targets: Vec<Target>,
    /// Whether the origin is near enough to be shown.
    pub shows_base: bool,
    /// What is at the origin.
    pub origin: &'static str,
    /// The corner of the box around it all with the least coordinates; its z is the floor.
    pub low: Vector,
    /// The opposite corner.
    pub high: Vector,
    /// Distance of the grid's lines [m].
    pub step: f64,
}

/// A part of the path in one mode.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Index into [`Run::modes`].
    pub mode: usize,
    /// The tool's positions.
    pub points: Vec<Vector>,
}

/// A point that the tool should reach.
#[derive(Clone, Debug)]
pub struct Target {
    /// The point at the end of the run.
    pub point: Vector,
    /// The point at the start of the run.
    pub from: Vector,
    /// How the tool should be turned there, if that is asked for; at the end of the run.
    pub turn: Option<Pose>,
    /// How near is near enough; 0 if nothing is said of it.
    pub acceptance: f64,
}

impl Scene {
    /// The scene of a run.
    pub fn of(run: &Run) -> Self {
        Self::with(run, &[])
    }

    /// The same, large enough for the points of the arm, which then stands where else the base is marked.
    pub fn with(run: &Run, arm: &[Vector]) -> Self {
        let places = &run.summary().settings.scenario.robot.places;
        let is_moved = places.base_position_m.is_some() || places.base_rpy_deg.is_some();
        let mut scene = Self {
            path: path_of(run),
            around: Surroundings::of(run),
            targets: targets_of(run),
            shows_base: true,
            origin: if is_moved { "world" } else { "base" },
            low: [0.0; 3],
            high: [0.0; 3],
            step: 1.0,
        };
        scene.enclose(arm);
        scene
    }

    /// First and last position of the tool.
    pub fn ends(&self) -> Option<(Vector, Vector)> {
        let first = self.path.first()?.points.first()?;
        let last = self.path.last()?.points.last()?;
        Some((*first, *last))
    }

    /// What stands in the way all the time. What a thing that moves hides depends on the time, so that it
    /// hides nothing.
    pub fn standing(&self) -> impl Iterator<Item = &Obstacle> {
        let obstacles = self.around.obstacles.iter();
        obstacles.filter(|obstacle| obstacle.moved.is_none())
    }

    /// Every shape that is drawn, those that move where they are at the start and at the end.
    pub fn shapes(&self) -> impl Iterator<Item = Shape> {
        let obstacles = self.around.obstacles.iter();
        let starts = obstacles.clone().filter(|it| it.moved.is_some());
        obstacles
            .map(|it| it.shape)
            .chain(starts.map(Obstacle::at_start))
    }

    fn enclose(&mut self, arm: &[Vector]) {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        let mut include = |point: Vector, around: f64| {
            for k in 0..3 {
                if point[k].is_finite() {
                    low[k] = low[k].min(point[k] - around);
                    high[k] = high[k].max(point[k] + around);
                }
            }
        };
        let path = self.path.iter().flat_map(|piece| &piece.points);
        for point in path.chain(arm) {
            include(*point, 0.0);
        }
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vec3::from);
        for shape in self.shapes() {
            for point in rim(&shape, x, y).into_iter().chain(rim(&shape, y, z)) {
                include(point, 0.0);
            }
        }
        for bound in &self.around.bounds {
            include(bound.centre, bound.radius);
        }
        for edge in self.around.cells.iter().flat_map(Cell::edges) {
            include(edge[0], 0.0);
            include(edge[1], 0.0);
        }
        for sight in &self.around.sights {
            include(sight.from, 0.0);
            include(sight.to, 0.0);
        }
        for target in &self.targets {
            include(target.point, target.acceptance);
            include(target.from, target.acceptance);
        }
        if low[0] > high[0] {
            (low, high) = ([-0.5; 3], [0.5; 3]);
        }
        self.reach_for_walls(&mut low, &mut high);
        // A path far away from the base is not made tiny to show both.
        let size = difference(low, high);
        let with_base = [0, 1, 2].map(|k| high[k].max(0.0) - low[k].min(0.0));
        self.shows_base =
            arm.is_empty() && dot(with_base, with_base) <= 6.25 * dot(size, size).max(1e-4);
        let step = nice_step(size.into_iter().fold(0.02, f64::max) / 10.0);
        for k in 0..3 {
            let room = if k == 2 { 0.0 } else { 0.3 * step };
            if self.shows_base {
                low[k] = low[k].min(0.0);
                high[k] = high[k].max(0.0);
            }
            // The floor is close below what stands on it, the grid's edges are lines of the grid. A number
            // that was rounded is no reason for another line.
            let grain = if k == 2 { step / 5.0 } else { step };
            low[k] = ((low[k] - room) / grain + 1e-6).floor() * grain;
            high[k] = ((high[k] + room) / step - 1e-6).ceil() * step;
            if high[k] - low[k] < step {
                high[k] = low[k] + step;
            }
        }
        (self.low, self.high, self.step) = (low, high, step);
    }

    /// Makes the box so large that planes near by are in it.
    fn reach_for_walls(&self, low: &mut Vector, high: &mut Vector) {
        let centre = [0, 1, 2].map(|k| f64::midpoint(low[k], high[k]));
        let size = difference(*low, *high);
        let near = 0.8 * dot(size, size).sqrt();
        for wall in &self.around.walls {
            let away = wall.normal.dot(Vec3::from(centre) - wall.point);
            if away.abs() > near {
                continue;
            }
            let foot = (Vec3::from(centre) - wall.normal * away).to_array();
            for k in 0..3 {
                low[k] = low[k].min(foot[k]);
                high[k] = high[k].max(foot[k]);
            }
        }
    }
}

/// Where the tool should go; of what moves, where it is in the end.
fn targets_of(run: &Run) -> Vec<Target> {
    let mut targets = Vec::new();
    let in_world = |task: &&TaskConfig| task.frames.relative_to.is_none();
    for task in run.tasks().iter().filter(in_world) {
        match (&task.kind, &task.goal) {
            (
                _,
                GoalConfig::Waypoints {
                    waypoints_m,
                    waypoints_quaternion_wxyz: turns,
                    acceptance_m,
                    ..
                },
            ) => {
                let points = waypoints_m.iter().enumerate();
                targets.extend(points.map(|(nth, &point)| Target {
                    point,
                    from: point,
                    turn: turns.get(nth).map(|it| Pose::from_quaternion_wxyz(*it)),
                    acceptance: acceptance_m.unwrap_or_default(),
                }));
            }
            (TaskKind::Position, GoalConfig::Desired { desired, .. }) => {
                if let [x, y, z] = desired[..] {
                    targets.push(Target {
                        point: at_end(run, [x, y, z], &task.motion),
                        from: [x, y, z],
                        turn: None,
                        acceptance: 0.0,
                    });
                }
            }
            (
                TaskKind::Pose {
                    target_m,
                    desired_quaternion_wxyz,
                },
                _,
            ) => {
                let turn = Pose::from_quaternion_wxyz(*desired_quaternion_wxyz);
                let turned = task.motion.turned_at(run.until_s()).into();
                targets.push(Target {
                    point: at_end(run, *target_m, &task.motion),
                    from: *target_m,
                    turn: Some(Pose {
                        x_axis: turn.x_axis.turned_by(turned),
                        y_axis: turn.y_axis.turned_by(turned),
                        z_axis: turn.z_axis.turned_by(turned),
                        ..turn
                    }),
                    acceptance: 0.0,
                });
            }
            _ => {}
        }
    }
    targets
}

fn path_of(run: &Run) -> Vec<Piece> {
    let log = run.log();
    let times = log.time_s();
    let end = if run.is_whole() {
        times.len()
    } else {
        times.partition_point(|&t_s| t_s <= run.until_s())
    };
    let coordinates = ["tool_x_m", "tool_y_m", "tool_z_m"].map(|name| {
        log.column(name)
            .and_then(|it| it.get(..end))
            .unwrap_or_default()
    });
    let mut pieces: Vec<Piece> = Vec::new();
    for row in decimate_in_space(coordinates, 330) {
        let point = coordinates.map(|values| values[row]);
        let mode = log.active()[row] as usize;
        if point.iter().any(|value| !value.is_finite()) {
            continue;
        }
        match pieces.last_mut() {
            Some(piece) if piece.mode == mode => piece.points.push(point),
            last => {
                // The step into a mode belongs to the mode that was in force before it.
                if let Some(piece) = last {
                    piece.points.push(point);
                }
                pieces.push(Piece {
                    mode,
                    points: vec![point],
                });
            }
        }
    }
    pieces
}
