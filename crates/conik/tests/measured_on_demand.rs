//! Sets that are not measured where they cannot matter change nothing: references, reasons and values are
//! the same to the bit.

use conik::{
    Border, Capsule, Controller, Cuboid, Frame, JointVec, ModeRule, Pose, Position, Recursion,
    Robot, Settings, Shape, ShapeDistance, Sphere, Stack, Step, TaskId, Vec3,
};
use proptest::prelude::*;

const TICKS: usize = 150;

/// A shape in the world: where, how large, whether a box, and the distance to be kept [m].
type Obstacle = (Vec3, f64, bool, f64);

#[derive(Clone, Debug)]
struct Scene {
    obstacles: Vec<Obstacle>,
    /// The first obstacle's velocity [m/s], if it moves.
    velocity: Option<Vec3>,
    targets: [Vec3; 3],
    gain: f64,
    settings: Settings,
    /// When a least distance of the last obstacle changes, to what [m], and by how much that obstacle then
    /// jumps [m].
    change: (usize, f64, Vec3),
}

fn vector(least: f64, most: f64) -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(least..most).prop_map(Vec3::from)
}

fn settings() -> impl Strategy<Value = Settings> {
    let rules = vec![ModeRule::Cone, ModeRule::Cone, ModeRule::Border];
    let borders = vec![Border::Land, Border::Land, Border::Freeze];
    (
        prop::sample::select(rules),
        prop::sample::select(borders),
        any::<bool>(),
        prop::sample::select(vec![50.0, 125.0, 500.0]),
    )
        .prop_map(|(mode_rule, border, is_chiaverini, rate_hz)| Settings {
            mode_rule,
            border,
            recursion: if is_chiaverini {
                Recursion::Chiaverini
            } else {
                Recursion::SicilianoSlotine
            },
            ..Settings::at_rate(rate_hz)
        })
}

fn scene() -> impl Strategy<Value = Scene> {
    let obstacle = (vector(-1.0, 1.0), 0.02..0.2, any::<bool>(), 0.0..0.2);
    (
        prop::collection::vec(obstacle, 3..10),
        prop::option::of(vector(-0.5, 0.5)),
        prop::array::uniform3(vector(-0.7, 0.7)),
        0.3..20.0,
        settings(),
        (0..TICKS, 0.0..0.5, vector(-1.0, 1.0)),
    )
        .prop_map(
            |(obstacles, velocity, targets, gain, settings, change)| Scene {
                obstacles,
                velocity,
                targets,
                gain,
                settings,
                change,
            },
        )
}

/// The arm's links, each with a shape.
fn links() -> [(usize, Shape); 4] {
    [
        (
            2,
            Capsule::new([0.0, 0.0, 0.13], [0.425, 0.0, 0.13], 0.06).into(),
        ),
        (
            3,
            Capsule::new([0.0, 0.0, 0.02], [0.392, 0.0, 0.02], 0.05).into(),
        ),
        (5, Sphere::new([0.0; 3], 0.05).into()),
        (6, Cuboid::new(Pose::IDENTITY, [0.08, 0.08, 0.1]).into()),
    ]
}

struct Run {
    controller: Controller,
    obstacles: Vec<TaskId>,
    position: TaskId,
    q: JointVec,
}

impl Run {
    fn of(scene: &Scene) -> Self {
        let robot = Robot::builtin("ur5-paper").expect("built in");
        let mut stack = Stack::new(&robot);
        let mut obstacles = Vec::new();
        for (i, &(place, size, is_box, least)) in scene.obstacles.iter().enumerate() {
            let other: Shape = if is_box {
                Cuboid::new(Pose::at(place), [size, 2.0 * size, size]).into()
            } else {
                Sphere::new(place, size).into()
            };
            for (link, shape) in links() {
                let distance = ShapeDistance::between(Frame::Link(link), shape, other);
                let set = stack.set(&format!("{link}/{i}"), distance, least..);
                obstacles.push(set.expect("sound"));
            }
        }
        let [_, _, (_, wrist), (link, tool)] = links();
        let own = ShapeDistance::between(Frame::Link(link), tool, links()[0].1)
            .relative_to(Frame::Link(2));
        stack.set("own", own, 0.01..).expect("sound");
        // Of two sides: measured always.
        let beam = ShapeDistance::between(Frame::Link(5), wrist, Sphere::new([0.0; 3], 0.1));
        stack.set("beam", beam, 0.05..=0.9).expect("sound");
        let position = stack
            .equality(
                "position",
                Position::of_tool(),
                &[0.4, 0.0, 0.0],
                scene.gain,
            )
            .expect("sound");
        let controller = Controller::new(&robot, stack, scene.settings).expect("sound");
        Self {
            controller,
            obstacles,
            position,
            q: JointVec::from([-0.84, -1.9, -1.5, -1.3, 1.5, 0.0]),
        }
    }

    fn tick(&mut self, scene: &Scene, tick: usize) -> Step {
        let mut setpoints = self.controller.setpoints();
        let target = scene.targets[tick * scene.targets.len() / TICKS].to_array();
        setpoints
            .set_desired(self.position, &target)
            .expect("finite");
        if let Some(velocity) = scene.velocity {
            let moved = velocity * (tick as f64 / scene.settings.rate_hz);
            for &task in &self.obstacles[..4] {
                let distance = setpoints
                    .task_mut::<ShapeDistance>(task)
                    .expect("it is one");
                distance.set_shift_moving(moved, velocity);
            }
        }
        if tick == scene.change.0 {
            let last = &self.obstacles[self.obstacles.len() - 4..];
            let least = scene.change.1..;
            setpoints.set_interval(last[3], least).expect("sound");
            for &task in last {
                let distance = setpoints
                    .task_mut::<ShapeDistance>(task)
                    .expect("a distance");
                distance.set_shift_moving(scene.change.2, Vec3::ZERO);
            }
        }
        let step = self.controller.step(&self.q).expect("finite").clone();
        self.q = step.q_ref;
        step
    }
}

/// How many values of how many were left out, over a run beside one that leaves out none.
fn compare(scene: &Scene) -> Result<(usize, usize), TestCaseError> {
    let (mut all, mut needed) = (Run::of(scene), Run::of(scene));
    needed.controller.measure_on_demand();
    let (mut left_out, mut of) = (0, 0);
    for tick in 0..TICKS {
        let (expected, found) = (all.tick(scene, tick), needed.tick(scene, tick));
        prop_assert_eq!(found.q_ref, expected.q_ref, "tick {}", tick);
        prop_assert_eq!(found.qd, expected.qd, "tick {}", tick);
        prop_assert_eq!(found.reasons(), expected.reasons(), "tick {}", tick);
        prop_assert_eq!(found.landed, expected.landed, "tick {}", tick);
        for (id, _) in all.controller.stack().iter() {
            of += 1;
            left_out += usize::from(found.value(id)[0].is_nan());
        }
        // All of the tick, values too.
        prop_assert_eq!(needed.controller.measure(), &expected, "tick {}", tick);
    }
    Ok((left_out, of))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn what_is_left_out_changes_nothing(scene in scene()) {
        compare(&scene)?;
    }
}

#[test]
fn most_far_sets_are_left_out_and_near_ones_are_not() {
    let far = Scene {
        obstacles: vec![(Vec3::new(1.5, 0.5, 0.5), 0.1, true, 0.05); 20],
        velocity: None,
        targets: [Vec3::new(0.4, 0.2, 0.0); 3],
        gain: 1.0,
        settings: Settings::at_rate(125.0),
        change: (TICKS, 0.0, Vec3::ZERO),
    };
    let (left_out, of) = compare(&far).expect("the same");
    assert!(left_out * 10 > of * 9, "{left_out} of {of}");
    let moving = Scene {
        velocity: Some(Vec3::new(0.01, 0.0, 0.0)),
        ..far.clone()
    };
    let (left_out, of) = compare(&moving).expect("the same");
    assert!(left_out * 10 > of * 8, "{left_out} of {of}");
}
