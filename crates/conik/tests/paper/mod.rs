//! The three examples of the paper (Section IV), built by hand from its tables.

use conik::{
    Controller, Distance, FieldOfView, JointVec, Position, Robot, Settings, Stack, TaskId, Vec3,
    Waypoints,
};

/// Circle of acceptance [m].
const ACCEPTANCE: f64 = 0.02;
/// Eqs. (6) and (7) [m].
const WAYPOINTS: [[f64; 3]; 2] = [[0.486, -0.066, -0.250], [0.320, 0.370, -0.250]];
/// Eq. (8) [1/s].
const POSITION_GAIN: f64 = 0.3;
/// Eq. (18) [1/s].
const VIEW_GAIN: f64 = 1.0;
/// Largest field-of-view error [-].
const VIEW_MAX: f64 = 0.2622;

/// An example of the paper, ready to run.
pub struct Example {
    pub controller: Controller,
    pub position: TaskId,
    pub waypoints: Waypoints,
    pub q: JointVec,
}

impl Example {
    /// Example 1, 2 or 3 from `q0` [rad].
    pub fn new(number: u8, q0: [f64; 6], settings: Settings) -> Self {
        let robot = Robot::builtin("ur5-paper").expect("built in");
        let mut stack = Stack::new(&robot);
        let (position, sets) = fill(&mut stack, number).expect("the paper's tables are sound");
        stack.exclude_together(&sets[..2]).expect("both are sets");
        Self {
            controller: Controller::new(&robot, stack, settings).expect("sound settings"),
            position,
            waypoints: Waypoints::new(WAYPOINTS.map(Vec3::from).to_vec(), ACCEPTANCE)
                .expect("two points"),
            q: JointVec::from(q0),
        }
    }

    /// One tick. `q` is then the next reference.
    pub fn tick(&mut self) -> &conik::Step {
        let tool = self
            .controller
            .kinematics_at(&self.q)
            .world_from(conik::Frame::Tool)
            .origin;
        self.waypoints.advance(tool);
        let target = self.waypoints.target().to_array();
        self.controller
            .setpoints()
            .set_desired(self.position, &target)
            .expect("three finite numbers");
        let step = self.controller.step(&self.q).expect("finite configuration");
        self.q = step.q_ref;
        self.controller.last_step()
    }
}

fn fill(stack: &mut Stack, number: u8) -> Result<(TaskId, Vec<TaskId>), conik::StackError> {
    let along = || FieldOfView::of_tool_along([1.0, 0.0, 0.0]);
    let mut sets = vec![
        stack.set(
            "obstacle_a",
            Distance::of_tool_to([0.40, -0.25, -0.33]),
            0.18..,
        )?,
        stack.set(
            "obstacle_b",
            Distance::of_tool_to([0.40, 0.15, -0.33]),
            0.15..,
        )?,
    ];
    if number == 2 {
        sets.push(stack.set("view", along(), ..=VIEW_MAX)?);
    }
    let position = stack.equality(
        "position",
        Position::of_tool(),
        &WAYPOINTS[0],
        POSITION_GAIN,
    )?;
    match number {
        1 => {
            stack.equality("view", along(), &[0.0], VIEW_GAIN)?;
        }
        3 => sets.push(stack.set_with_gain("view", along(), ..=VIEW_MAX, VIEW_GAIN)?),
        _ => {}
    }
    Ok((position, sets))
}

/// The start of a thesis that used the paper's scene [rad].
pub fn thesis() -> [f64; 6] {
    [-48.0, -158.0, -108.0, -90.0, -85.0, 0.0].map(f64::to_radians)
}

/// A start fitted to the times that the paper prints [rad].
#[allow(dead_code, reason = "not every user of this module needs it")]
pub fn fitted() -> [f64; 6] {
    [-1.16, -2.77, -2.26, -1.27, -1.2, 0.0]
}
