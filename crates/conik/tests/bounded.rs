//! Stated bounds on the work of a tick, with 48 set-based tasks on six joints, twenty of them at their
//! border at once; and what happens when the pivots run out.

use conik::{
    Axis, Border, Controller, Coordinate, DhRow, Distance, FieldOfView, Interval, JacobianMut,
    JointPosition, JointVec, Kinematics, MAX_PIVOTS, ModeRule, Position, Reason, Recursion, Robot,
    Settings, Stack, Task,
};

/// At most this many configurations are computed in a tick.
const MAX_KINEMATICS: usize = 9;
const SETS: usize = 48;
const AT_BORDER: usize = 20;

/// A sequence of numbers in [0, 1) that is the same on every machine (splitmix64).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, min: f64, max: f64) -> f64 {
        min + (max - min) * self.next()
    }
}

/// A stack that fills, and where the arm is meanwhile.
struct Crowd {
    stack: Stack,
    kinematics: Kinematics,
    numbers: Numbers,
    /// A joint velocity that keeps all sets.
    way: [f64; 6],
}

impl Crowd {
    /// Adds a set whose border lies `margin` from the present value, on the side from which `way` leads
    /// away: so there is always room to move.
    fn add(&mut self, name: &str, task: impl Task, margin: f64) {
        let mut value = [0.0];
        task.value(&self.kinematics, &mut value);
        let mut row = [0.0; 6];
        task.jacobian(&self.kinematics, &mut JacobianMut::new(&mut row, 6));
        let rate: f64 = row.iter().zip(self.way).map(|(a, v)| a * v).sum();
        let interval = if rate < 0.0 {
            Interval::from(..=value[0] + margin)
        } else {
            Interval::from(value[0] - margin..)
        };
        self.stack.set(name, task, interval).expect("a sound set");
    }

    fn vector(&mut self) -> [f64; 3] {
        std::array::from_fn(|_| self.numbers.between(-1.0, 1.0))
    }
}

/// The start and the stack of a crowded scene: the first twenty sets have their border exactly where
/// the arm is.
fn crowd(seed: u64) -> ([f64; 6], Stack) {
    let mut numbers = Numbers(seed);
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let q0: [f64; 6] = std::array::from_fn(|_| numbers.between(-2.5, 2.5));
    let mut kinematics = Kinematics::new(&robot);
    kinematics.update(&q0);
    let stack = Stack::new(&robot);
    let mut crowd = Crowd {
        stack,
        kinematics,
        way: std::array::from_fn(|_| numbers.between(-1.0, 1.0)),
        numbers,
    };
    for i in 0..SETS {
        let name = format!("set {i}");
        let margin = if i < AT_BORDER {
            0.0
        } else {
            crowd.numbers.between(0.005, 0.3)
        };
        let vector = crowd.vector();
        match i % 4 {
            0 => crowd.add(&name, Distance::of_tool_to(vector), margin),
            1 => {
                let axis = [Axis::X, Axis::Y, Axis::Z][i / 4 % 3];
                crowd.add(&name, Coordinate::of_tool(axis), margin);
            }
            2 => crowd.add(&name, FieldOfView::of_tool_along(vector), margin),
            _ => crowd.add(&name, JointPosition::of(i / 4 % 6), margin),
        }
    }
    let target = crowd.vector().map(|v| 0.5 * v);
    let Crowd { mut stack, .. } = crowd;
    stack
        .equality("position", Position::of_tool(), &target, 0.5)
        .expect("a sound task");
    let along = FieldOfView::of_tool_along([1.0, 0.3, -0.2]);
    stack
        .equality("view", along, &[0.0], 0.5)
        .expect("a sound task");
    (q0, stack)
}

#[test]
fn crowds_are_kept_within_the_bounds_on_work() {
    let robot = Robot::builtin("ur5-paper").expect("built in");
    let mut moved = 0;
    let rates = [50.0, 125.0, 500.0, 1000.0].into_iter().cycle();
    for (seed, rate_hz) in (0..24).zip(rates) {
        for recursion in [Recursion::Chiaverini, Recursion::SicilianoSlotine] {
            let settings = Settings {
                mode_rule: ModeRule::Cone,
                border: Border::Land,
                recursion,
                ..Settings::at_rate(rate_hz)
            };
            let (q0, stack) = crowd(seed);
            let mut controller = Controller::new(&robot, stack, settings).expect("sound");
            let mut q = JointVec::from(q0);
            for tick in 0..200 {
                let step = controller.step(&q).expect("finite").clone();
                assert!(step.qd.is_finite() && step.q_ref.is_finite());
                assert!(step.pivots <= MAX_PIVOTS, "{} pivots", step.pivots);
                assert!(step.landed.kinematics <= MAX_KINEMATICS);
                // Every set starts on its border or inside.
                for (id, level) in controller.stack().iter().take(SETS) {
                    let interval = level.interval().expect("a set");
                    let violation = interval.violation(step.value(id)[0]);
                    assert!(
                        violation <= 1e-12,
                        "seed {seed}, {recursion:?}, tick {tick}: {} is {violation} outside",
                        level.name()
                    );
                }
                q = step.q_ref;
            }
            let far = q0.iter().zip(q.iter()).map(|(a, b)| (a - b).abs());
            moved += usize::from(far.fold(0.0, f64::max) > 1e-3);
        }
    }
    assert!(moved > 24, "in every scene there is room to move: {moved}");
}

/// The weighted sum of all joint positions.
#[derive(Debug)]
struct Sum(Vec<f64>);

impl Task for Sum {
    fn dimension(&self) -> usize {
        1
    }

    fn value(&self, kinematics: &Kinematics, value: &mut [f64]) {
        let weighted = self.0.iter().zip(kinematics.q().iter());
        value[0] = weighted.map(|(weight, q)| weight * q).sum();
    }

    fn jacobian(&self, _kinematics: &Kinematics, jacobian: &mut JacobianMut<'_>) {
        jacobian.row(0).copy_from_slice(&self.0);
    }

    fn unit(&self) -> &'static str {
        "rad"
    }

    fn check(&self, _robot: &Robot) -> Result<(), &'static str> {
        Ok(())
    }
}

const MANY_JOINTS: usize = 30;

/// Thirty joints, each at its lower bound, and `levels` sums of them that want to go down.
fn many_joints(levels: usize, settings: Settings) -> Controller {
    let rows = [DhRow::new(0.1, 0.4, 0.02); MANY_JOINTS];
    let robot = Robot::from_dh("many", &rows).expect("sound");
    let mut stack = Stack::new(&robot);
    for i in 0..MANY_JOINTS {
        stack
            .set(&format!("joint {i}"), JointPosition::of(i), 0.0..)
            .expect("sound");
    }
    let mut numbers = Numbers(7);
    for level in 0..levels {
        let weights = (0..MANY_JOINTS).map(|_| numbers.between(-1.0, 1.0));
        let sum = Sum(weights.collect());
        stack
            .equality(&format!("sum {level}"), sum, &[-1.0], 1.0)
            .expect("sound");
    }
    Controller::new(&robot, stack, settings).expect("sound")
}

/// A level for which no pivots are left changes nothing: the velocity is that of the levels above it.
#[test]
fn out_of_pivots_the_velocity_of_the_levels_above_stands() {
    const LEVELS: usize = 12;
    for recursion in [Recursion::Chiaverini, Recursion::SicilianoSlotine] {
        let settings = Settings {
            mode_rule: ModeRule::Cone,
            border: Border::Freeze,
            recursion,
            ..Settings::at_rate(125.0)
        };
        let first = |levels| {
            let mut controller = many_joints(levels, settings);
            controller
                .step(&[0.0; MANY_JOINTS])
                .expect("finite")
                .clone()
        };
        let all = first(LEVELS);
        assert_eq!(all.pivots, MAX_PIVOTS, "{recursion:?}: they do run out");
        let solved = (1..LEVELS)
            .take_while(|&levels| first(levels).pivots < MAX_PIVOTS)
            .last()
            .expect("the first level is solved");
        let above = first(solved);
        assert!(above.qd.largest().expect("joints").1 > 0.0);
        assert_eq!(all.qd, above.qd, "{recursion:?}, {solved} levels solved");
    }
}

#[test]
fn out_of_pivots_sets_are_kept_all_the_same() {
    for recursion in [Recursion::Chiaverini, Recursion::SicilianoSlotine] {
        let settings = Settings {
            mode_rule: ModeRule::Cone,
            border: Border::Land,
            recursion,
            ..Settings::at_rate(125.0)
        };
        let mut controller = many_joints(12, settings);
        let mut q = JointVec::zeros(MANY_JOINTS);
        let (mut ran_out, mut moved) = (0, 0);
        for _ in 0..200 {
            let step = controller.step(&q).expect("finite");
            assert!(step.qd.is_finite() && step.pivots <= MAX_PIVOTS);
            ran_out += usize::from(step.reasons().contains(&Reason::OutOfPivots));
            moved += usize::from(step.qd.largest().expect("joints").1 > 1e-3);
            assert!(step.q_ref.iter().all(|q| *q >= 0.0), "{:?}", step.q_ref);
            q = step.q_ref;
        }
        assert!(ran_out > 0, "they do run out");
        assert!(moved > 0, "enough are left to land: {recursion:?}");
    }
}
