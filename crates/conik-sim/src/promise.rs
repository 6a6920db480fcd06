//! What the settings of a run promise, and whether the run kept it.
//!
//! Border `freeze` promises nothing between samples. Border `land` promises the properties 2 to 4 of
//! the paper's Section VI at every sample: a high-priority set is not left once it holds, and does
//! not get worse before. Properties 1 and 5 depend on the scenario and are promised by nothing.
//!
//! Where points move, a set can be left because no velocity within the limits keeps it. The tick before
//! announces that. It counts as broken all the same: what had to be kept was not, whoever is to
//! blame, and whoever relies on the exit status wants to know; the message says that it was announced.
//! What was *not* announced is broken besides, however small it is: that the next sample is inside, or
//! that this tick says that it is not, is promised without a tolerance.
//!
//! Who changes the border while the run goes on takes the promise away.

use std::fmt;

use crate::live::Change;
use crate::scenario::{Border, Choice};
use crate::summary::{Outcome, Summary};

/// A promise of the settings that a run did not keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrokenPromise<'a> {
    /// What was done that was promised not to be.
    offence: &'static str,
    /// How far it went [task's unit], and when that was [s].
    worst: f64,
    at_s: Option<f64>,
    /// What is to be said besides.
    remark: &'static str,
    task: &'a str,
    /// Unit of the task's value; empty where it has none.
    unit: &'static str,
    border: Border,
}

impl fmt::Display for BrokenPromise<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "promise-broken: `{}` was {:.3e}{} {} at {} s; border `{}` promises that this does not \
             happen{}",
            self.task,
            self.worst,
            self.unit,
            self.offence,
            self.at_s.unwrap_or(0.0),
            self.border.name(),
            self.remark,
        )
    }
}

impl Summary {
    /// Whether people chose another border while the run went on: then nothing is promised of the whole.
    fn was_border_changed(&self) -> bool {
        let mut changes = self.changes.iter().flat_map(|made| &made.changes);
        changes
            .any(|change| matches!(change, Change::Control { control, .. } if control == "border"))
    }

    /// The promises that the run did not keep, in the order of the properties; then a sample outside
    /// that was not announced.
    pub fn broken_promises(&self) -> Vec<BrokenPromise<'_>> {
        let border = self.settings.scenario.control.border;
        if border == Border::Freeze || self.modes.is_empty() || self.was_border_changed() {
            return vec![];
        }
        let unannounced = self.monitors.as_ref().map(|seen| &seen.unannounced);
        let unannounced = unannounced.filter(|seen| seen.is_seen());
        let announced = self.monitors.as_ref().map(|seen| &seen.went_outside);
        let remark = match announced.filter(|seen| seen.is_seen()) {
            Some(_) if unannounced.is_none() => {
                " (no velocity within the limits kept every set, as the tick before had announced)"
            }
            _ => "",
        };
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
        let broken = promised.into_iter().filter(|(property, _)| !property.holds);
        let unannounced = unannounced.map(|seen| BrokenPromise {
            offence: "outside, of which the tick before had said nothing,",
            worst: seen.worst,
            at_s: seen.at_s,
            remark: "",
            ..self.promise_about(seen.task.as_deref())
        });
        broken
            .map(|(property, offence)| BrokenPromise {
                offence,
                worst: property.worst,
                at_s: property.at_s,
                remark,
                ..self.promise_about(property.task.as_deref())
            })
            .chain(unannounced)
            .collect()
    }

    /// A promise about a task, of which only that is known.
    fn promise_about<'a>(&self, task: Option<&'a str>) -> BrokenPromise<'a> {
        let task = task.unwrap_or("?");
        BrokenPromise {
            offence: "",
            worst: 0.0,
            at_s: None,
            remark: "",
            task,
            unit: match self.settings.units.get(task).map(String::as_str) {
                Some("m") => " m",
                Some("rad") => " rad",
                _ => "",
            },
            border: self.settings.scenario.control.border,
        }
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
