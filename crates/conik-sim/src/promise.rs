//! What the settings of a run promise, and whether the run kept it.
//!
//! Border `freeze` promises nothing between samples. Border `land` promises the properties 2 to 4 of
//! the paper's Section VI at every sample: a high-priority set is not left once it holds, and does
//! not get worse before. Properties 1 and 5 depend on the scenario and are promised by nothing.

use std::fmt;

use crate::scenario::{Border, Choice};
use crate::summary::{Outcome, Property, Summary};

/// A promise of the settings that a run did not keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrokenPromise<'a> {
    /// What was promised.
    promise: &'static str,
    /// What became of it.
    property: &'a Property,
    task: &'a str,
    /// Unit of the task's value; empty where it has none.
    unit: &'a str,
    border: Border,
}

impl fmt::Display for BrokenPromise<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "promise-broken: `{}` was {:.3e}{} {} at {} s; border `{}` promises that this does not \
             happen",
            self.task,
            self.property.worst,
            self.unit,
            self.promise,
            self.property.at_s.unwrap_or(0.0),
            self.border.name(),
        )
    }
}

impl Summary {
    /// The promises that the run did not keep, in the order of the properties.
    pub fn broken_promises(&self) -> Vec<BrokenPromise<'_>> {
        let border = self.settings.scenario.control.border;
        if border == Border::Freeze || self.modes.is_empty() {
            return vec![];
        }
        let properties = &self.properties;
        let promised = [
            (
                &properties.inside_stays,
                "outside a set that held at the start",
            ),
            (
                &properties.outside_never_worse,
                "further outside than it had been",
            ),
            (
                &properties.entered_stays,
                "outside a set that had been entered",
            ),
        ];
        promised
            .into_iter()
            .filter(|(property, _)| !property.holds)
            .map(|(property, promise)| {
                let task = property.task.as_deref().unwrap_or("?");
                let unit = self.settings.units.get(task).map_or("", String::as_str);
                BrokenPromise {
                    promise,
                    property,
                    task,
                    unit: match unit {
                        "m" => " m",
                        "rad" => " rad",
                        _ => "",
                    },
                    border,
                }
            })
            .collect()
    }

    /// What went wrong, a line each: the fault that ended the run, and every broken promise. Empty for
    /// a run that went as it should.
    pub fn faults(&self) -> Vec<String> {
        let fault = match &self.outcome {
            Outcome::Fault { name, detail } => Some(format!("{name}: {detail}")),
            Outcome::Completed | Outcome::Interrupted | Outcome::Running => None,
        };
        let broken = self.broken_promises();
        fault
            .into_iter()
            .chain(broken.iter().map(ToString::to_string))
            .collect()
    }
}
