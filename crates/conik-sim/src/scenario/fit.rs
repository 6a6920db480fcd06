//! Whether the tasks fit the robot, which only the controller's own objects know.

use std::ops::Range;

use super::config::Scenario;
use super::keys;
use super::mistake::{Mistakes, quoted};
use super::shape_keys::SHAPE;
use super::table::Table;
use super::task::ReadTask;
use crate::experiment::{Experiment, ExperimentError};

/// Where the tasks of the file stand: name, path and header of each.
pub(super) struct Places(Vec<(String, String, Range<usize>)>);

impl Places {
    pub(super) fn of(tasks: &[ReadTask]) -> Self {
        let named = tasks.iter().filter_map(|task| {
            let name = task.name.as_ref()?.value.clone();
            Some((name, task.path.clone(), task.header.clone()))
        });
        Self(named.collect())
    }
}

/// Makes of the scenario what runs it, and notes why that cannot be, if it cannot.
pub(super) fn check(scenario: &Scenario, places: &Places, file: &Table, found: &mut Mistakes) {
    let Err(error) = Experiment::new(scenario) else {
        return;
    };
    let ExperimentError::Stack(error) = error else {
        found.add(
            file.span_of(&keys::TASK),
            keys::TASK.name,
            error.to_string(),
            "change what the tasks name or ask for",
        );
        return;
    };
    let reason = error.reason.to_string();
    match places.0.iter().find(|(name, ..)| *name == error.task) {
        Some((_, path, header)) => found.add(
            header.clone(),
            path,
            reason,
            "change the links, joints or shapes that it is about",
        ),
        None => found.add(
            file.span_of(&SHAPE),
            SHAPE.name,
            format!("the set {} cannot be kept: {reason}", quoted(&error.task)),
            "change the shapes, or their names",
        ),
    }
}
