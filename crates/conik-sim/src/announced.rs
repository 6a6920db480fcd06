//! Whether every sample outside a set was announced by the tick before it.
//!
//! Where a point moves, a set may be left because no velocity within the limits keeps it. Border `land`
//! then says in that very tick that the next sample will be outside, and by how much at most.

use conik::{Occurrence, Stack, Step, TaskId};

/// What is less is the rounding of a point that moves [task's unit].
const ROUNDING: f64 = 1e-12;

/// Watches the samples of a run.
#[derive(Clone, Debug)]
pub struct Announcements {
    entered: Vec<bool>,
    /// By how much the last tick said that this one would be outside.
    announced: f64,
    unannounced: Occurrence,
}

impl Announcements {
    /// For a run of this stack.
    pub fn new(stack: &Stack) -> Self {
        Self {
            entered: vec![false; stack.len()],
            announced: 0.0,
            unannounced: Occurrence::default(),
        }
    }

    /// Takes in one tick: the state at `t_s` [s], before the step.
    pub fn observe(&mut self, stack: &Stack, step: &Step, t_s: f64) {
        for (id, level) in stack.iter() {
            let Some(set) = level.interval() else { break };
            let violation = set.violation(step.value(id)[0]);
            let entered = &mut self.entered[id.index()];
            if *entered && violation > self.announced + ROUNDING {
                self.unannounced.add(violation, t_s, Some(id));
            }
            *entered |= violation <= 0.0;
        }
        self.announced = step.landed.outside.map_or(0.0, |outside| outside.by);
    }

    /// Goes on where `before` was, in the same tick of the same run: `places` has for each task its place in
    /// the stack of then, or none of a task that is not what it was.
    pub(crate) fn take_over(&mut self, before: &Self, places: &[Option<TaskId>], stack: &Stack) {
        for (entered, place) in self.entered.iter_mut().zip(places) {
            *entered = place.is_some_and(|place| before.entered[place.index()]);
        }
        self.announced = before.announced;
        self.unannounced = before.unannounced;
        self.unannounced.task = before.unannounced.task.and_then(|task| {
            let mut ids = stack.iter().map(|(id, _)| id);
            ids.find(|id| places[id.index()] == Some(task))
        });
    }

    /// What was seen so far.
    pub fn unannounced(&self) -> Occurrence {
        self.unannounced
    }
}

#[cfg(test)]
mod tests {
    use conik::{Controller, Distance, Frame, JointVec, Robot, Settings, Vec3};

    use super::*;

    /// An obstacle of 0.1 m beside a tool at rest that moves towards it at `speed` [m/s], or jumps.
    fn watch(speed: f64, jump: bool) -> (Occurrence, usize) {
        let robot = Robot::builtin("ur5-paper").expect("built in");
        let mut q = JointVec::from([-0.84, -2.76, -1.88, -1.57, -1.48, 0.0]);
        let mut kinematics = conik::Kinematics::new(&robot);
        kinematics.update(&q);
        let tool = kinematics.world_from(Frame::Tool).origin;
        let mut stack = Stack::new(&robot);
        let task = Distance::of_tool_to(tool + Vec3::new(0.15, 0.0, 0.0));
        let id = stack.set("ball", task, 0.1..).expect("sound");
        let settings = Settings::at_rate(125.0);
        let mut controller = Controller::new(&robot, stack, settings).expect("sound");
        let mut announcements = Announcements::new(controller.stack());
        let mut outside = 0;
        for tick in 0..40 {
            let t_s = f64::from(tick) / 125.0;
            let away = if jump && tick >= 20 {
                0.05
            } else {
                0.15 - speed * t_s
            };
            let point = tool + Vec3::new(away, 0.0, 0.0);
            let mut setpoints = controller.setpoints();
            let ball = setpoints.task_mut::<Distance>(id).expect("a distance");
            ball.set_point_moving(point, [-speed, 0.0, 0.0]);
            let step = controller.step(&q).expect("finite");
            outside += usize::from(step.value(id)[0] < 0.1 - 1e-12);
            q = step.q_ref;
            let step = step.clone();
            announcements.observe(controller.stack(), &step, t_s);
        }
        (announcements.unannounced(), outside)
    }

    #[test]
    fn obstacle_that_is_too_fast_is_announced_and_one_that_jumps_is_not() {
        let (slow, outside) = watch(0.2, false);
        assert_eq!((slow, outside), (Occurrence::default(), 0));
        let (fast, outside) = watch(8.0, false);
        assert!(outside > 0, "nothing can avoid it");
        assert_eq!(fast, Occurrence::default());
        let (jumped, _) = watch(0.0, true);
        assert_eq!(jumped.ticks, 1);
        assert!((jumped.worst - 0.05).abs() < 1e-6, "{jumped:?}");
        assert_eq!(jumped.at_s, Some(0.16));
    }
}
