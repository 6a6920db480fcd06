//! One run of a plan, as a scenario.

use conik_sim::scenario::{DescriptionError, Geometry, GoalConfig, Scenario, TaskConfig, TaskKind};

use crate::plan::{Plan, Starts};
use crate::random::Random;

/// One run.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Its number, from 0.
    pub run: u64,
    /// What is run.
    pub scenario: Scenario,
    /// How far the arm lags behind its reference [s]; `None`: not at all.
    pub servo_lag_s: Option<f64>,
}

impl Plan {
    /// Run `run` of the plan.
    ///
    /// # Errors
    ///
    /// If there is no such robot, which a plan of a scenario that was read does not have.
    pub fn case(&self, run: u64) -> Result<Case, DescriptionError> {
        let mut random = Random::new(self.seed, run);
        let mut scenario = self.scenario.clone();
        // Each kind of numbers is drawn whether or not it varies, so that letting one more thing vary leaves the
        // others as they are.
        self.start(&mut scenario, &mut random)?;
        let varied = &self.varied;
        if let Some(rate_hz) = random.one_of(&varied.rates_hz) {
            scenario.control.rate_hz = rate_hz;
        }
        let lag = random.between(0.0, 1.0);
        let servo_lag_s = varied.servo_lag_s;
        let servo_lag_s = servo_lag_s.map(|[least, most]| least + lag * (most - least));
        for task in &mut scenario.tasks {
            vary(task, varied.obstacles_m, varied.targets_m, &mut random);
        }
        for obstacle in &mut scenario.collision.obstacles {
            let by = random.in_ball(varied.obstacles_m);
            shift(&mut obstacle.geometry, by);
        }
        Ok(Case {
            run,
            scenario,
            servo_lag_s,
        })
    }

    fn start(&self, scenario: &mut Scenario, random: &mut Random) -> Result<(), DescriptionError> {
        const HALF_A_TURN: f64 = std::f64::consts::PI;
        let robot = scenario.robot.limited()?;
        for (q, joint) in scenario.robot.q0_rad.iter_mut().zip(robot.joints()) {
            let (least, most) = joint.limits.position.unwrap_or((-HALF_A_TURN, HALF_A_TURN));
            let (least, most) = (least.max(-HALF_A_TURN), most.min(HALF_A_TURN));
            match self.varied.starts {
                Starts::Same => {}
                Starts::Anywhere => *q = random.between(least, most),
                Starts::Near(near) => *q = random.between(*q - near, *q + near),
            }
        }
        Ok(())
    }
}

/// Shifts what a task is given.
fn vary(task: &mut TaskConfig, obstacles_m: f64, targets_m: f64, random: &mut Random) {
    let by_obstacle = random.in_ball(obstacles_m);
    match &mut task.kind {
        TaskKind::Distance { point_m } | TaskKind::LookAt { point_m } => add(point_m, by_obstacle),
        TaskKind::Pose { target_m, .. } => add(target_m, random.in_ball(targets_m)),
        _ => {}
    }
    match &mut task.goal {
        GoalConfig::Waypoints { waypoints_m, .. } => {
            for waypoint in waypoints_m {
                add(waypoint, random.in_ball(targets_m));
            }
        }
        GoalConfig::Desired { desired, .. } if task.kind == TaskKind::Position => {
            if let [x, y, z] = &mut desired[..] {
                let by = random.in_ball(targets_m);
                (*x, *y, *z) = (*x + by[0], *y + by[1], *z + by[2]);
            }
        }
        GoalConfig::Desired { .. } | GoalConfig::Set { .. } => {}
    }
}

fn add(point: &mut [f64; 3], by: [f64; 3]) {
    for (point, by) in point.iter_mut().zip(by) {
        *point += by;
    }
}

fn shift(geometry: &mut Geometry, by: [f64; 3]) {
    match geometry {
        Geometry::Sphere { center_m, .. } | Geometry::Box { center_m, .. } => add(center_m, by),
        Geometry::Capsule { from_m, to_m, .. } | Geometry::Cylinder { from_m, to_m, .. } => {
            add(from_m, by);
            add(to_m, by);
        }
        Geometry::HalfSpace { point_m, .. } => add(point_m, by),
    }
}
