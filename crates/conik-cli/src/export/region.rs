//! What tasks keep to, seen in space: obstacles, shapes on links, spheres, planes, and where to go.

use conik::{HalfSpace, Pose, Shape, Sphere, Vec3};
use conik_sim::scenario::{Axis, GoalConfig, Motion, Scenario, TaskConfig, TaskKind};

use super::frames::{FrameTree, WORLD};
use super::primitive::{self, Colour, colour};
use super::protobuf::Message;
use super::source::{Source, SourceTask};

/// Something in the scene.
#[derive(Clone, Debug)]
pub struct Region {
    id: String,
    /// The frame that it is fixed to.
    frame: String,
    /// The tasks that it shows.
    tasks: Vec<String>,
    shape: Shape,
    motion: Motion,
    look: Look,
    label: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Look {
    /// What is kept away from.
    Solid,
    /// What is around or behind everything: it must not hide it.
    Glass,
    /// Where to go.
    Goal,
}

impl Region {
    /// Everything in that run.
    pub fn all(source: &Source, frames: &FrameTree) -> Vec<Self> {
        let scenario = &source.summary.settings.scenario;
        let mut found = Vec::new();
        for obstacle in &scenario.collision.obstacles {
            let shape = obstacle.geometry.shape();
            let look = match shape {
                Shape::HalfSpace(_) => Look::Glass,
                _ => Look::Solid,
            };
            found.push(Self {
                id: format!("obstacle/{}", obstacle.name),
                frame: WORLD.to_owned(),
                tasks: tasks_of(&obstacle.name, scenario, &source.tasks),
                shape,
                motion: obstacle.motion,
                look,
                label: None,
            });
        }
        for shape in &scenario.collision.shapes {
            let Some(frame) = frames.of_link(&shape.link) else {
                continue;
            };
            found.push(Self {
                id: format!("shape/{}", shape.name),
                frame: frame.to_owned(),
                tasks: tasks_of(&shape.name, scenario, &source.tasks),
                shape: shape.geometry.shape(),
                motion: Motion::default(),
                look: Look::Glass,
                label: None,
            });
        }
        for task in &source.tasks {
            add_task(&task.config, frames, &mut found);
        }
        found
    }

    /// Whether it moves by itself.
    pub fn moves(&self) -> bool {
        self.motion.velocity_m_per_s.is_some()
    }

    /// Until when it moves [s]; 0 if it does not.
    pub fn moves_until_s(&self) -> f64 {
        match self.motion {
            _ if !self.moves() => 0.0,
            motion => motion.moves_until_s.unwrap_or(f64::INFINITY),
        }
    }

    /// Whether one of its tasks is active.
    pub fn is_lit(&self, active: &[String]) -> bool {
        self.tasks.iter().any(|task| active.contains(task))
    }

    /// Adds it to a `foxglove.SceneUpdate` as it is at a time.
    pub fn show(&self, nanoseconds: u64, active: &[String], plate_m: f64, update: &mut Message) {
        let t_s = nanoseconds as f64 * 1e-9;
        let shift = Vec3::from(self.motion.point_at([0.0; 3], t_s));
        let shape = self.shape.placed(&Pose::at(shift));
        let colour = self.look.colour(self.is_lit(active));
        primitive::entity(update, (&self.frame, &self.id), nanoseconds, |entity| {
            primitive::shape(entity, &shape, colour, plate_m);
            if let (Some(label), Shape::Sphere(ball)) = (&self.label, shape) {
                let size_m = 0.03 * plate_m;
                let above = Vec3::new(0.0, 0.0, ball.radius() + size_m);
                primitive::text(entity, ball.center() + above, label, colour, size_m);
            }
        });
    }
}

impl Look {
    fn colour(self, is_lit: bool) -> Colour {
        match (self, is_lit) {
            (Self::Solid, false) => colour("#8c959f", 0.6),
            (Self::Solid, true) => colour("#D55E00", 0.8),
            (Self::Glass, false) => colour("#8c959f", 0.12),
            (Self::Glass, true) => colour("#D55E00", 0.3),
            (Self::Goal, _) => colour("#009E73", 0.6),
        }
    }
}

/// The tasks that measure how far the shape or the obstacle of that name is from others.
fn tasks_of(name: &str, scenario: &Scenario, tasks: &[SourceTask]) -> Vec<String> {
    let own = scenario.tasks.iter().filter(|task| match &task.kind {
        TaskKind::ShapeDistance { shapes } => shapes.iter().any(|shape| shape == name),
        _ => false,
    });
    let shapes = scenario.collision.shapes.iter().map(|it| &it.name);
    let obstacles = scenario.collision.obstacles.iter().map(|it| &it.name);
    // The sets that shapes and obstacles become are named after both.
    let others = shapes.chain(obstacles);
    let pairs = others.flat_map(|other| [format!("{name}/{other}"), format!("{other}/{name}")]);
    let is_there = |pair: &String| tasks.iter().any(|task| task.config.name == *pair);
    let own = own.map(|task| task.name.clone());
    own.chain(pairs.filter(is_there)).collect()
}

fn add_task(task: &TaskConfig, frames: &FrameTree, found: &mut Vec<Region>) {
    let frame = match &task.frames.relative_to {
        Some(link) => frames.of_link(link).unwrap_or(WORLD),
        None => WORLD,
    };
    let region = |id: String, shape: Shape, look: Look| Region {
        id,
        frame: frame.to_owned(),
        tasks: vec![task.name.clone()],
        shape,
        motion: task.motion,
        look,
        label: None,
    };
    let (min, max) = match task.goal {
        GoalConfig::Set { min, max, .. } => (min, max),
        _ => (None, None),
    };
    let name = &task.name;
    if let TaskKind::Distance { point_m } = task.kind {
        for (bound, which, look) in [(min, "min", Look::Solid), (max, "max", Look::Glass)] {
            if let Some(radius) = bound.filter(|it| *it > 0.0 && it.is_finite()) {
                let ball = Sphere::new(point_m, radius).into();
                found.push(region(format!("task/{name}/{which}"), ball, look));
            }
        }
    }
    if let Some((normal, offset)) = plane_of(&task.kind) {
        for (bound, which, side) in [(min, "min", 1.0), (max, "max", -1.0)] {
            if let Some(bound) = bound {
                let plane = HalfSpace::new(normal * (offset + bound), normal * side).into();
                found.push(region(format!("task/{name}/{which}"), plane, Look::Glass));
            }
        }
    }
    for (nth, (point, radius)) in goals_of(task).into_iter().enumerate() {
        let is_one_of_many = task.goal.waypoint_count().is_some();
        found.push(Region {
            tasks: Vec::new(),
            label: is_one_of_many.then(|| (nth + 1).to_string()),
            ..region(
                format!("goal/{name}/{nth}"),
                Sphere::new(point, radius).into(),
                Look::Goal,
            )
        });
    }
}

/// The normal of the planes in which a task's value stays the same, and where it is 0 along it.
fn plane_of(kind: &TaskKind) -> Option<(Vec3, f64)> {
    let world = Pose::IDENTITY;
    Some(match kind {
        TaskKind::Plane { normal, offset_m } => (Vec3::from(*normal), *offset_m),
        TaskKind::Height | TaskKind::Coordinate { axis: Axis::Z } => (world.z_axis, 0.0),
        TaskKind::Coordinate { axis: Axis::X } => (world.x_axis, 0.0),
        TaskKind::Coordinate { axis: Axis::Y } => (world.y_axis, 0.0),
        _ => return None,
    })
}

/// Radius of a goal of which none is given [m].
const SMALL: f64 = 0.012;

/// The points that a task leads to or looks at, with the radius of what is shown there [m].
fn goals_of(task: &TaskConfig) -> Vec<([f64; 3], f64)> {
    match (&task.kind, &task.goal) {
        (
            _,
            GoalConfig::Waypoints {
                waypoints_m,
                acceptance_m,
                ..
            },
        ) => {
            let radius = acceptance_m.unwrap_or(SMALL).max(SMALL);
            waypoints_m.iter().map(|point| (*point, radius)).collect()
        }
        (TaskKind::LookAt { point_m }, _) => vec![(*point_m, SMALL)],
        (TaskKind::Pose { target_m, .. }, _) => vec![(*target_m, SMALL)],
        (TaskKind::Position, GoalConfig::Desired { desired, .. }) => {
            let point = desired.as_slice().try_into();
            point.map_or(Vec::new(), |point| vec![(point, SMALL)])
        }
        _ => Vec::new(),
    }
}
