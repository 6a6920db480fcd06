//! What stands in the space around the arm: path, obstacles, waypoints, and the floor below them.

use conik_sim::scenario::{GoalConfig, TaskConfig, TaskKind};

use super::axis::nice_step;
use super::camera::{Camera, Vector, difference, dot};
use super::curve::decimate_in_space;
use super::run::Run;

/// Everything drawn in three dimensions.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The tool's path, in pieces of one mode each; a piece begins where the last one ended.
    pub path: Vec<Piece>,
    /// Regions that the tool may not enter, or may not leave.
    pub spheres: Vec<Sphere>,
    /// The like, where the point moves. What they hide depends on the time, so they hide nothing.
    pub moving: Vec<MovingSphere>,
    /// Where the tool should go, in order.
    pub targets: Vec<Target>,
    /// Whether the base is near enough to be shown.
    pub shows_base: bool,
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

/// The region of a distance task.
#[derive(Clone, Debug)]
pub struct Sphere {
    /// The task's name.
    pub name: String,
    /// Its point.
    pub centre: Vector,
    /// Its limit.
    pub radius: f64,
    /// Whether the inside is forbidden (a minimum), rather than the outside (a maximum).
    pub is_obstacle: bool,
}

/// The region of a distance task whose point moves.
#[derive(Clone, Debug)]
pub struct MovingSphere {
    /// The task's name.
    pub name: String,
    /// Its point at the start of the run.
    pub from: Vector,
    /// Its point at the end of the run; between the two it moved along a straight line.
    pub to: Vector,
    /// Its limit.
    pub radius: f64,
}

/// A point that the tool should reach.
#[derive(Clone, Debug)]
pub struct Target {
    /// The point.
    pub point: Vector,
    /// How near is near enough; 0 if nothing is said of it.
    pub acceptance: f64,
}

impl Scene {
    /// The scene of a run.
    pub fn of(run: &Run) -> Self {
        let mut scene = Self {
            path: path_of(run),
            spheres: Vec::new(),
            moving: Vec::new(),
            targets: Vec::new(),
            shows_base: true,
            low: [0.0; 3],
            high: [0.0; 3],
            step: 1.0,
        };
        // What is in the axes of a link moves with it, and is not drawn.
        let in_world = |task: &&TaskConfig| task.frames.relative_to.is_none();
        for task in run.tasks().iter().filter(in_world) {
            match (&task.kind, &task.goal) {
                (&TaskKind::Distance { point_m, motion }, GoalConfig::Set { min, max, .. }) => {
                    for (limit, is_obstacle) in [(min, true), (max, false)] {
                        let Some(radius) = limit.filter(|r| *r > 0.0 && r.is_finite()) else {
                            continue;
                        };
                        let name = task.name.clone();
                        match motion {
                            Some(motion) => scene.moving.push(MovingSphere {
                                name,
                                from: point_m,
                                to: motion.point_at(point_m, run.summary().ended_at_s),
                                radius,
                            }),
                            None => scene.spheres.push(Sphere {
                                name,
                                centre: point_m,
                                radius,
                                is_obstacle,
                            }),
                        }
                    }
                }
                (
                    _,
                    GoalConfig::Waypoints {
                        waypoints_m,
                        acceptance_m,
                        ..
                    },
                ) => {
                    scene
                        .targets
                        .extend(waypoints_m.iter().map(|&point| Target {
                            point,
                            acceptance: *acceptance_m,
                        }));
                }
                (TaskKind::Position, GoalConfig::Desired { desired, .. }) => {
                    if let [x, y, z] = desired[..] {
                        let point = [x, y, z];
                        scene.targets.push(Target {
                            point,
                            acceptance: 0.0,
                        });
                    }
                }
                _ => {}
            }
        }
        scene.enclose();
        scene
    }

    /// First and last position of the tool.
    pub fn ends(&self) -> Option<(Vector, Vector)> {
        let first = self.path.first()?.points.first()?;
        let last = self.path.last()?.points.last()?;
        Some((*first, *last))
    }

    /// The view in which most of the path is seen: the longest on paper, spheres hiding none of it.
    /// Azimuth and elevation [degrees] as of [`Camera::at`].
    pub fn best_view_deg(&self) -> (f64, f64) {
        // Away from right angles to the axes, where an axis would be seen as a point.
        let azimuths = [30.0, 60.0, 120.0, 150.0, -150.0, -120.0, -60.0, -30.0];
        // From higher up the floor is more of a map and heights are lost: only for more path.
        let elevations = [28.0, 38.0, 48.0];
        let mut best = (f64::NEG_INFINITY, (azimuths[0], elevations[0]));
        let views = elevations.map(|elevation| azimuths.map(|azimuth| (azimuth, elevation)));
        for view in views.into_iter().flatten() {
            let camera = Camera::at(view.0, view.1);
            // Axes of the base across the path or an obstacle make both hard to read.
            let clear = if self.base_is_aside(&camera) {
                1.0
            } else {
                0.75
            };
            let seen = clear * self.seen_length(&camera);
            // A few hundredths of the path more are no reason to look from elsewhere.
            if seen > 1.03 * best.0.max(0.0) + 1e-9 {
                best = (seen, view);
            }
        }
        best.1
    }

    /// Whether the base is in the background, and no obstacle in front of it.
    fn base_is_aside(&self, camera: &Camera) -> bool {
        let middle = [0, 1, 2].map(|k| f64::midpoint(self.low[k], self.high[k]));
        let clear = self.obstacles().all(|sphere| {
            let (right, up) = camera.project(sphere.centre);
            right.hypot(up) > 1.1 * sphere.radius
        });
        !self.shows_base
            || (clear && camera.nearness(middle) > camera.nearness([0.0, 0.0, middle[2]]))
    }

    fn seen_length(&self, camera: &Camera) -> f64 {
        let mut length = 0.0;
        for pair in self.path.iter().flat_map(|piece| piece.points.windows(2)) {
            let (right, up) = camera.project(difference(pair[0], pair[1]));
            let hidden = self
                .obstacles()
                .any(|sphere| camera.is_behind(pair[1], sphere.centre, sphere.radius));
            if !hidden {
                length += right.hypot(up);
            }
        }
        length
    }

    /// The spheres that may not be entered.
    pub fn obstacles(&self) -> impl Iterator<Item = &Sphere> {
        self.spheres.iter().filter(|sphere| sphere.is_obstacle)
    }

    fn enclose(&mut self) {
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
        for point in self.path.iter().flat_map(|piece| &piece.points) {
            include(*point, 0.0);
        }
        for sphere in self.spheres.iter().filter(|sphere| sphere.is_obstacle) {
            include(sphere.centre, sphere.radius);
        }
        for sphere in &self.moving {
            include(sphere.from, sphere.radius);
            include(sphere.to, sphere.radius);
        }
        for target in &self.targets {
            include(target.point, target.acceptance);
        }
        if low[0] > high[0] {
            (low, high) = ([-0.5; 3], [0.5; 3]);
        }
        // A path far away from the base is not made tiny to show both.
        let size = difference(low, high);
        let with_base = [0, 1, 2].map(|k| high[k].max(0.0) - low[k].min(0.0));
        self.shows_base = dot(with_base, with_base) <= 6.25 * dot(size, size).max(1e-4);
        let step = nice_step(size.into_iter().fold(0.02, f64::max) / 10.0);
        for k in 0..3 {
            let room = if k == 2 { 0.0 } else { 0.3 * step };
            if self.shows_base {
                low[k] = low[k].min(0.0);
                high[k] = high[k].max(0.0);
            }
            low[k] = ((low[k] - room) / step).floor() * step;
            high[k] = ((high[k] + room) / step).ceil() * step;
            if high[k] - low[k] < step {
                high[k] = low[k] + step;
            }
        }
        (self.low, self.high, self.step) = (low, high, step);
    }
}

fn path_of(run: &Run) -> Vec<Piece> {
    let log = run.log();
    let coordinates =
        ["tool_x_m", "tool_y_m", "tool_z_m"].map(|name| log.column(name).unwrap_or_default());
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
