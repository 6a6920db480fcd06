//! The scaling scenes: an arm follows a circle while it carries many sets, most of them inactive.
//!
//! A file has the numbers of joints and of sets; a row a, α, d of the Denavit-Hartenberg table for each
//! joint [m, rad, m]; the start [rad]; the circle's point p₀ [m]; and for each set the frame whose
//! origin must stay away, from where, and how far [m].

use std::f64::consts::TAU;
use std::fmt::Debug;
use std::str::{FromStr, SplitWhitespace};

use conik::{
    Controller, DhRow, Distance, Frame, JointVec, Position, Robot, Settings, Stack, TaskId,
};

const GAIN: f64 = 1.5;
const RADIUS: f64 = 0.08;
const ROUND_S: f64 = 4.0;

pub struct Scene {
    pub controller: Controller,
    pub position: TaskId,
    pub q: JointVec,
    p0: [f64; 3],
}

struct Words<'a>(SplitWhitespace<'a>);

impl Words<'_> {
    fn read<T: FromStr<Err: Debug>>(&mut self) -> T {
        let word = self.0.next().expect("the file is complete");
        word.parse().expect("a number")
    }

    fn point(&mut self) -> [f64; 3] {
        [self.read(), self.read(), self.read()]
    }
}

impl Scene {
    #[allow(dead_code, reason = "not every program that has scenes has plain ones")]
    pub fn new(text: &str, settings: Settings) -> Self {
        Self::crowded(text, settings, |_, _, _| ())
    }

    /// The same, with more sets, which are added at the start.
    pub fn crowded(
        text: &str,
        settings: Settings,
        add: impl FnOnce(&Robot, &[f64], &mut Stack),
    ) -> Self {
        let mut words = Words(text.split_whitespace());
        let (dof, sets): (usize, usize) = (words.read(), words.read());
        let rows: Vec<DhRow> = (0..dof)
            .map(|_| DhRow::new(words.read(), words.read(), words.read()))
            .collect();
        let start: Vec<f64> = (0..dof).map(|_| words.read()).collect();
        let p0 = words.point();
        let robot = Robot::from_dh("scene", &rows).expect("at most 32 joints");
        let mut stack = Stack::new(&robot);
        for i in 0..sets {
            let distance = Distance::between(Frame::Link(words.read()), words.point());
            stack
                .set(&format!("set_{i}"), distance, words.read::<f64>()..)
                .expect("a frame of the robot");
        }
        add(&robot, &start, &mut stack);
        let position = stack
            .equality("position", Position::of_tool(), &p0, GAIN)
            .expect("three finite numbers");
        Self {
            controller: Controller::new(&robot, stack, settings).expect("sound settings"),
            position,
            q: JointVec::from_slice(&start).expect("at most 32 joints"),
            p0,
        }
    }

    /// Where the tool is to be at time `t` [s].
    pub fn target(&self, t: f64) -> [f64; 3] {
        let (sin, cos) = (TAU * t / ROUND_S).sin_cos();
        let [x, y, z] = self.p0;
        [x, y + RADIUS * sin, z + RADIUS * (1.0 - cos)]
    }

    /// One tick at the start of which the tool is to be at `target`. `q` is then the next reference.
    pub fn tick(&mut self, target: [f64; 3]) {
        self.controller
            .setpoints()
            .set_desired(self.position, &target)
            .expect("finite");
        self.q = self.controller.step(&self.q).expect("finite").q_ref;
    }
}
