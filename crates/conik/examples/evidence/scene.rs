//! A scene: start, tasks, waypoints, rate. Random ones are drawn here.

use conik::{
    Axis, Coordinate, Distance, FieldOfView, Interval, JointPosition, Position, Robot, Stack,
    StackError, TaskId,
};

use crate::chain::{Chain, Measure, Vector};
use crate::random::Random;

/// A set-based task.
#[derive(Clone, Copy, Debug)]
pub struct Set {
    pub measure: Measure,
    pub min: f64,
    pub max: f64,
}

impl Set {
    /// How far a value is outside; negative inside.
    pub fn outside(&self, sigma: f64) -> f64 {
        (self.min - sigma).max(sigma - self.max)
    }
}

/// What the arm is to do.
#[derive(Clone, Debug)]
pub struct Scene {
    pub q0: [f64; 6],
    /// Above the position task.
    pub high: Vec<Set>,
    /// Below it, each with the gain that brings it back [1/s].
    pub low: Vec<(Set, f64)>,
    /// An equality task below all others: the joint, its desired value [rad], the gain [1/s].
    pub posture: Option<(usize, f64, f64)>,
    pub waypoints: Vec<Vector>,
    /// Gain of the position task [1/s].
    pub gain: f64,
    pub rate_hz: f64,
    pub duration_s: f64,
}

/// Circle of acceptance [m].
pub const ACCEPTANCE: f64 = 0.02;

impl Scene {
    /// Scene `index` of a seed.
    ///
    /// One to four obstacles, up to two bounds of coordinates, up to two of joints, in three of five
    /// a view cone, in any order; one set in eight may start outside. One scene in four has sets of
    /// low priority as well, one in five a posture. Half of the waypoints are out of reach: beyond the
    /// arm or inside an obstacle.
    pub fn random(seed: u64, index: u64) -> Self {
        let random = &mut Random::new(seed, index);
        let q0 = configuration(random);
        let start = Chain::at(&q0);
        let mut high = Vec::new();
        for _ in 0..=random.below(4) {
            high.push(obstacle(random, &start));
        }
        for _ in 0..random.below(3) {
            let measure = Measure::Coordinate(random.below(3));
            high.push(bound(random, &start, measure, 0.3));
        }
        for _ in 0..random.below(3) {
            let measure = Measure::Joint(random.below(6));
            high.push(bound(random, &start, measure, 1.0));
        }
        if random.chance(0.6) {
            high.push(view(random, &start));
        }
        for i in (1..high.len()).rev() {
            high.swap(i, random.below(i + 1));
        }
        let waypoints = (0..2).map(|_| waypoint(random, &high)).collect();
        let mut low = Vec::new();
        if random.chance(0.25) {
            for _ in 0..=random.below(2) {
                let set = match random.below(3) {
                    0 => view(random, &start),
                    1 => {
                        let measure = Measure::Coordinate(random.below(3));
                        bound(random, &start, measure, 0.3)
                    }
                    _ => {
                        let measure = Measure::Joint(random.below(6));
                        bound(random, &start, measure, 0.5)
                    }
                };
                low.push((set, random.between(0.3, 1.5)));
            }
        }
        let posture = random.chance(0.2).then(|| {
            let joint = random.below(6);
            (
                joint,
                q0[joint] + random.between(-1.0, 1.0),
                random.between(0.2, 1.0),
            )
        });
        Self {
            q0,
            high,
            low,
            posture,
            waypoints,
            gain: random.between(0.3, 1.2),
            rate_hz: [50.0, 125.0, 500.0, 1000.0][random.below(4)],
            duration_s: 16.0,
        }
    }

    /// Control periods of the whole scene.
    pub fn ticks(&self) -> usize {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "small and positive"
        )]
        let ticks = (self.duration_s * self.rate_hz).round() as usize;
        ticks
    }

    /// The tasks for the controller; sets stand there in the order in which they stand here.
    pub fn stack(&self, robot: &Robot) -> Result<(Stack, TaskId), StackError> {
        let mut stack = Stack::new(robot);
        for (i, set) in self.high.iter().enumerate() {
            add(&mut stack, &format!("high_{i}"), set, 1.0)?;
        }
        let position = stack.equality(
            "position",
            Position::of_tool(),
            &self.waypoints[0],
            self.gain,
        )?;
        for (i, (set, gain)) in self.low.iter().enumerate() {
            add(&mut stack, &format!("low_{i}"), set, *gain)?;
        }
        if let Some((joint, desired, gain)) = self.posture {
            stack.equality("posture", JointPosition::of(joint), &[desired], gain)?;
        }
        Ok((stack, position))
    }
}

fn add(stack: &mut Stack, name: &str, set: &Set, gain: f64) -> Result<TaskId, StackError> {
    let interval = Interval {
        min: set.min,
        max: set.max,
    };
    match set.measure {
        Measure::Coordinate(k) => {
            let axis = [Axis::X, Axis::Y, Axis::Z][k];
            stack.set_with_gain(name, Coordinate::of_tool(axis), interval, gain)
        }
        Measure::Distance(point) => {
            stack.set_with_gain(name, Distance::of_tool_to(point), interval, gain)
        }
        Measure::View(along) => {
            stack.set_with_gain(name, FieldOfView::of_tool_along(along), interval, gain)
        }
        Measure::Joint(i) => stack.set_with_gain(name, JointPosition::of(i), interval, gain),
    }
}

fn configuration(random: &mut Random) -> [f64; 6] {
    std::array::from_fn(|_| random.between(-2.9, 2.9))
}

/// A point within reach.
fn reachable(random: &mut Random) -> Vector {
    Chain::at(&configuration(random)).tool()
}

fn obstacle(random: &mut Random, start: &Chain) -> Set {
    loop {
        let point = reachable(random);
        let measure = Measure::Distance(point);
        let (away, radius) = (start.value(measure), random.between(0.08, 0.25));
        if away > radius || (away > 0.05 && random.chance(0.125)) {
            return Set {
                measure,
                min: radius,
                max: f64::INFINITY,
            };
        }
    }
}

/// A bound, or both, up to `room` from the value at the start.
fn bound(random: &mut Random, start: &Chain, measure: Measure, room: f64) -> Set {
    let sigma = start.value(measure);
    let mut distance = || {
        let distance = random.between(0.02, room);
        if random.chance(0.125) {
            -0.3 * distance
        } else {
            distance
        }
    };
    let (below, above) = (distance(), distance());
    let (min, max) = match random.below(3) {
        0 => (sigma - below, f64::INFINITY),
        1 => (f64::NEG_INFINITY, sigma + above),
        _ => (sigma - below.abs(), sigma + above.abs()),
    };
    Set { measure, min, max }
}

fn view(random: &mut Random, start: &Chain) -> Set {
    let axis = start.view();
    let to_the_side = random.direction();
    let amount = random.between(0.0, 0.6);
    let mixed: Vector = std::array::from_fn(|i| axis[i] + amount * to_the_side[i]);
    let length = crate::chain::norm(mixed);
    let measure = Measure::View(mixed.map(|c| c / length));
    let sigma = start.value(measure);
    let max = if random.chance(0.125) {
        (0.7 * sigma).max(0.05)
    } else {
        (sigma + random.between(0.01, 0.5)).max(0.1)
    };
    Set {
        measure,
        min: f64::NEG_INFINITY,
        max,
    }
}

fn waypoint(random: &mut Random, high: &[Set]) -> Vector {
    if random.chance(0.5) {
        return reachable(random);
    }
    let centres: Vec<Vector> = high
        .iter()
        .filter_map(|set| match set.measure {
            Measure::Distance(point) => Some(point),
            _ => None,
        })
        .collect();
    if random.chance(0.3) {
        let offset = random.direction();
        let centre = centres[random.below(centres.len())];
        return std::array::from_fn(|i| centre[i] + 0.04 * offset[i]);
    }
    let (direction, length) = (random.direction(), random.between(1.0, 1.5));
    direction.map(|c| c * length)
}
