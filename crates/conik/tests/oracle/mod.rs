//! The method written down a second time, as plainly as the paper prints it. Shares no code with the
//! crate: homogeneous matrices, eigenvectors, all 2ⁿ modes, an interior-point solver.

#![allow(dead_code, reason = "not every test needs all of it")]

pub mod arm;
pub mod cone;
pub mod enumeration;
pub mod program;
pub mod scene;

#[derive(Clone, Copy, Debug)]
pub enum Measure {
    Position,
    Coordinate(usize),
    Distance([f64; 3]),
    FieldOfView([f64; 3]),
    Joint(usize),
}

#[derive(Clone, Debug)]
pub enum Goal {
    Equality(Vec<f64>),
    Set(f64, f64),
}

#[derive(Clone, Debug)]
pub struct Task {
    pub measure: Measure,
    pub goal: Goal,
    pub gain: f64,
}

impl Task {
    /// The bounds of a set.
    pub fn bounds(&self) -> Option<(f64, f64)> {
        match self.goal {
            Goal::Set(min, max) => Some((min, max)),
            Goal::Equality(_) => None,
        }
    }
}

/// Number of tasks above the first equality task.
pub fn high_priority(tasks: &[Task]) -> usize {
    tasks
        .iter()
        .take_while(|task| task.bounds().is_some())
        .count()
}
