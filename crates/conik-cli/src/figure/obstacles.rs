//! What stands in the way of a run: the shapes and planes that its sets keep the robot away from.

use conik::{HalfSpace, Pose, Shape, Sphere, Vec3};
use conik_sim::scenario::{Axis, GoalConfig, Motion, TaskConfig, TaskKind};

use super::camera::Vector;
use super::run::Run;
use super::shading::NEUTRAL;

/// A shape that is kept away from.
#[derive(Clone, Debug)]
pub struct Obstacle {
    /// Its name, or that of its set.
    pub name: String,
    /// The shape, in the world; where it is at the end of the run, if it moves.
    pub shape: Shape,
    /// From where it was at the start of the run to where it is at the end [m], if it moves.
    pub moved: Option<Vector>,
    /// The colour of the mode in which it was in the way, the longest one if there are several.
    pub tint: &'static str,
}

/// A plane of which one side is forbidden.
#[derive(Clone, Debug)]
pub struct Wall {
    /// Its name, or that of its set.
    pub name: String,
    /// A point of it [m].
    pub point: Vec3,
    /// Its normal, towards the side that is allowed.
    pub normal: Vec3,
    /// As that of an obstacle.
    pub tint: &'static str,
}

/// A point that the tool keeps looking at.
#[derive(Clone, Debug)]
pub struct Sight {
    /// The task's name.
    pub name: String,
    /// The point at the start of the run.
    pub from: Vector,
    /// The point at the end of the run.
    pub to: Vector,
}

/// A sphere that is not left.
#[derive(Clone, Debug)]
pub struct Bound {
    /// The task's name.
    pub name: String,
    /// Its middle.
    pub centre: Vector,
    /// The greatest distance from it.
    pub radius: f64,
}

/// A box that is not left.
#[derive(Clone, Debug)]
pub struct Cell {
    /// The task's name.
    pub name: String,
    /// Its middle [m].
    pub middle: Vec3,
    /// Half of its edges [m].
    pub half: Vec3,
}

impl Cell {
    /// The ends of its edges.
    pub fn edges(&self) -> Vec<[Vector; 2]> {
        let corner = |nth: usize| {
            let side = |axis: usize, half: f64| if nth >> axis & 1 == 1 { half } else { -half };
            let away = Vec3::new(
                side(0, self.half.x),
                side(1, self.half.y),
                side(2, self.half.z),
            );
            (self.middle + away).to_array()
        };
        let along = |axis: usize| (0..8).filter(move |nth| nth >> axis & 1 == 0);
        let edges = (0..3).flat_map(|axis| along(axis).map(move |nth| (nth, nth | 1 << axis)));
        edges.map(|(from, to)| [corner(from), corner(to)]).collect()
    }
}

/// All of these of a run.
#[derive(Clone, Debug, Default)]
pub struct Surroundings {
    /// Shapes that are kept away from.
    pub obstacles: Vec<Obstacle>,
    /// Planes that are kept away from.
    pub walls: Vec<Wall>,
    /// Spheres that are not left.
    pub bounds: Vec<Bound>,
    /// Boxes that are not left.
    pub cells: Vec<Cell>,
    /// Points that are looked at.
    pub sights: Vec<Sight>,
}

impl Surroundings {
    /// What stands around the robot in that run.
    pub fn of(run: &Run) -> Self {
        let mut found = Self::default();
        // What is in the axes of a link moves with it, and is not drawn.
        let in_world = |task: &&TaskConfig| task.frames.relative_to.is_none();
        for task in run.tasks().iter().filter(in_world) {
            found.add_task(run, task);
        }
        found.join_walls();
        let collision = &run.summary().settings.scenario.collision;
        for obstacle in &collision.obstacles {
            let measures_it = |set: &str| {
                let task = run.tasks().iter().find(|task| task.name == set);
                task.is_some_and(|task| match &task.kind {
                    TaskKind::ShapeDistance { shapes } => shapes.contains(&obstacle.name),
                    _ => false,
                })
            };
            // A set of the obstacle's own has the name of a shape, and then its.
            let of_it = |set: &str| {
                let shape = set.strip_suffix(obstacle.name.as_str());
                shape.is_some_and(|shape| shape.ends_with('/')) || measures_it(set)
            };
            let shape = obstacle.geometry.shape();
            let tint = tint(run, of_it);
            found.add_shape(run, &obstacle.name, shape, &obstacle.motion, tint);
        }
        found
    }

    /// A `workspace` that is a box has become a set for each axis: together they are a box again.
    fn join_walls(&mut self) {
        let names: Vec<String> = self.walls.iter().map(|wall| wall.name.clone()).collect();
        for name in names.iter().filter_map(|name| name.strip_suffix("/x")) {
            let mut sides = Vec::new();
            for (letter, axis) in ["x", "y", "z"].iter().zip(0..) {
                let of_axis = self
                    .walls
                    .iter()
                    .filter(|wall| wall.name == format!("{name}/{letter}"));
                let mut levels: Vec<f64> =
                    of_axis.map(|wall| wall.point.to_array()[axis]).collect();
                levels.sort_by(f64::total_cmp);
                if let [low, high] = levels[..] {
                    sides.push((low, high));
                }
            }
            let [x, y, z] = sides[..] else { continue };
            let middle = [x, y, z].map(|(low, high)| f64::midpoint(low, high));
            let half = [x, y, z].map(|(low, high)| 0.5 * (high - low));
            self.walls.retain(|wall| {
                let letter = wall.name.strip_prefix(name).unwrap_or_default();
                !matches!(letter, "/x" | "/y" | "/z")
            });
            self.cells.push(Cell {
                name: name.to_owned(),
                middle: middle.into(),
                half: half.into(),
            });
        }
    }

    fn add_task(&mut self, run: &Run, task: &TaskConfig) {
        let (min, max) = match task.goal {
            GoalConfig::Set { min, max, .. } => (min, max),
            _ => (None, None),
        };
        let tint = tint(run, |set| set == task.name);
        match &task.kind {
            TaskKind::Distance { point_m } => {
                let is_radius = |radius: &f64| *radius > 0.0 && radius.is_finite();
                if let Some(radius) = min.filter(is_radius) {
                    let shape = Sphere::new(*point_m, radius).into();
                    self.add_shape(run, &task.name, shape, &task.motion, tint);
                }
                if let Some(radius) = max.filter(is_radius) {
                    self.bounds.push(Bound {
                        name: task.name.clone(),
                        centre: at_end(run, *point_m, &task.motion),
                        radius,
                    });
                }
            }
            TaskKind::LookAt { point_m } => self.sights.push(Sight {
                name: task.name.clone(),
                from: *point_m,
                to: at_end(run, *point_m, &task.motion),
            }),
            TaskKind::Plane { normal, offset_m } => {
                let limits = (min.map(|it| it + offset_m), max.map(|it| it + offset_m));
                self.add_planes(task, Vec3::from(*normal), limits, tint);
            }
            TaskKind::Height => self.add_planes(task, Pose::IDENTITY.z_axis, (min, max), tint),
            TaskKind::Coordinate { axis } => {
                let normal = match axis {
                    Axis::X => Pose::IDENTITY.x_axis,
                    Axis::Y => Pose::IDENTITY.y_axis,
                    Axis::Z => Pose::IDENTITY.z_axis,
                };
                self.add_planes(task, normal, (min, max), tint);
            }
            _ => {}
        }
    }

    /// The planes between which a set keeps something.
    fn add_planes(
        &mut self,
        task: &TaskConfig,
        normal: Vec3,
        (min, max): (Option<f64>, Option<f64>),
        tint: &'static str,
    ) {
        for (limit, side) in [(min, 1.0), (max, -1.0)] {
            let Some(limit) = limit else { continue };
            self.walls.push(Wall {
                name: task.name.clone(),
                point: normal * limit,
                normal: normal * side,
                tint,
            });
        }
    }

    fn add_shape(
        &mut self,
        run: &Run,
        name: &str,
        shape: Shape,
        motion: &Motion,
        tint: &'static str,
    ) {
        let name = name.to_owned();
        let moved = (!motion.is_rest()).then(|| at_end(run, [0.0; 3], motion));
        let shape = shape.placed(&Pose::at(moved.unwrap_or_default().into()));
        if let Shape::HalfSpace(half_space) = shape {
            self.walls.push(of_half_space(name, &half_space, tint));
        } else {
            self.obstacles.push(Obstacle {
                name,
                shape,
                moved,
                tint,
            });
        }
    }
}

impl Obstacle {
    /// The shape where it was at the start.
    pub fn at_start(&self) -> Shape {
        let back = self.moved.unwrap_or_default().map(|moved| -moved);
        self.shape.placed(&Pose::at(back.into()))
    }
}

fn of_half_space(name: String, half_space: &HalfSpace, tint: &'static str) -> Wall {
    Wall {
        name,
        point: half_space.point(),
        normal: half_space.normal(),
        tint,
    }
}

/// Where a point is at the end of the run, or at the time that it is shown at.
pub(super) fn at_end(run: &Run, point: Vector, motion: &Motion) -> Vector {
    motion.point_at(point, run.until_s())
}

/// The colour of the mode that was longest in force among those in which a set was active that `is_meant`.
pub fn tint(run: &Run, is_meant: impl Fn(&str) -> bool) -> &'static str {
    let mut lasted_s = vec![0.0; run.modes().len()];
    for span in run.spans() {
        lasted_s[span.mode] += span.to_s - span.from_s;
    }
    let modes = run.modes().iter().zip(lasted_s);
    let meant = modes.filter(|(mode, _)| mode.active.iter().any(|set| is_meant(set)));
    // Of several the first.
    let longest = meant.min_by(|a, b| b.1.total_cmp(&a.1));
    longest.map_or(NEUTRAL, |(mode, _)| mode.colour)
}
