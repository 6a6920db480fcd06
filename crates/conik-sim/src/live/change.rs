//! A change of a scenario that is being run: a key of a task or an obstacle, a setting, the order of the tasks.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::edit::{FIXED, list, named, reorder, set, shortened};
use super::glide::GlideSpeed;
use crate::scenario::{Scenario, ScenarioErrors};

/// One change. Keys and values are those of a scenario as `summary.json` has it: angles in radians,
/// orientations as quaternions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, deny_unknown_fields)]
pub enum Change {
    /// A key of a task in the scenario's list gets another value.
    Task {
        /// Name of the task.
        task: String,
        /// The key.
        key: String,
        /// Its value; null takes away a key that need not be there. Where something moves, it is the value
        /// at the time of the change.
        value: Value,
        /// How fast a set glides there [m/s, rad/s or task's unit/s].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        speed: Option<f64>,
    },
    /// A key of an obstacle gets another value.
    Obstacle {
        /// Name of the obstacle.
        obstacle: String,
        /// The key.
        key: String,
        /// Its value, as of a task.
        value: Value,
        /// How fast it glides there [m/s].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        speed: Option<f64>,
    },
    /// A setting of the controller: `mode_rule`, `border`, `recursion`.
    Control {
        /// Which.
        control: String,
        /// Its value.
        value: Value,
    },
    /// The tasks of the list, the most important first.
    Order {
        /// The names of all of them.
        order: Vec<String>,
    },
}

/// Why a scenario cannot be changed so.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ChangeError {
    /// There is nothing of that name.
    #[error("there is no {what} `{name}`; there are: {known}")]
    Unknown {
        /// Task or obstacle.
        what: &'static str,
        /// The name.
        name: String,
        /// The names that there are.
        known: String,
    },
    /// A task that the list does not have.
    #[error(
        "`{0}` follows from the robot's limits or from shapes and obstacles: change those instead"
    )]
    Derived(String),
    /// What must stay as it is.
    #[error("`{key}` of `{name}` cannot be changed while the run goes on; change it in the file")]
    Fixed {
        /// The key.
        key: String,
        /// Of what.
        name: String,
    },
    /// Not a key that it has or may have.
    #[error("`{name}` has no key `{key}`; it has: {known}")]
    UnknownKey {
        /// Of what.
        name: String,
        /// The key.
        key: String,
        /// Keys that it has.
        known: String,
    },
    /// A value of the wrong type.
    #[error("`{key}` of `{name}` cannot be {value}")]
    BadValue {
        /// Of what.
        name: String,
        /// The key.
        key: String,
        /// The value.
        value: String,
    },
    /// An order in which something is missing, or there twice.
    #[error("`order` must have the name of each task once: {0}")]
    Order(String),
    /// A speed that is none.
    #[error("`speed` must be a number above 0, at most 100, not {0}")]
    Speed(f64),
    /// What comes out is no scenario that can be run.
    #[error("{0}")]
    Scenario(String),
}

/// Settings of the controller that may change while a run goes on.
const CONTROL: &[&str] = &["mode_rule", "border", "recursion"];

/// Speeds above are no speeds of anything near an arm.
const FASTEST: f64 = 100.0;

impl Scenario {
    /// The scenario after `changes`, made at `t_s` [s], all of them or none; and the names of tasks that are
    /// to glide to where it has them at a speed of their own.
    pub fn changed(
        &self,
        changes: &[Change],
        t_s: f64,
    ) -> Result<(Self, Vec<(String, GlideSpeed)>), ChangeError> {
        // A scenario is text, numbers and lists: all that JSON has.
        let mut json =
            serde_json::to_value(self).map_err(|error| ChangeError::Scenario(error.to_string()))?;
        for change in changes {
            change.apply(&mut json, t_s)?;
            json = change.checked(json)?;
        }
        let changed: Self = serde_json::from_value(json)
            .map_err(|error| ChangeError::Scenario(error.to_string()))?;
        let changed = Self::from_toml_knowing(&self.robot.source, &changed.to_toml())
            .map_err(|errors| first(&errors))?;
        let mut speeds = Vec::new();
        for change in changes {
            change.push_speeds(&changed, &mut speeds)?;
        }
        Ok((changed, speeds))
    }
}

/// The first mistake, in a sentence.
fn first(errors: &ScenarioErrors) -> ChangeError {
    let mistakes = errors.mistakes().iter();
    let mut sentences = mistakes.map(|it| format!("{}: {}; {}", it.key, it.what, it.help));
    ChangeError::Scenario(sentences.next().unwrap_or_else(|| errors.to_string()))
}

impl Change {
    fn apply(&self, scenario: &mut Value, t_s: f64) -> Result<(), ChangeError> {
        match self {
            Self::Task {
                task, key, value, ..
            } => {
                let tasks = list(scenario, "task");
                let item = named(tasks, "task", task).map_err(|error| {
                    if task.contains('/') {
                        ChangeError::Derived(task.clone())
                    } else {
                        error
                    }
                })?;
                set(item, task, key, value, t_s)
            }
            Self::Obstacle {
                obstacle,
                key,
                value,
                ..
            } => {
                let obstacles = list(scenario, "obstacle");
                let item = named(obstacles, "obstacle", obstacle)?;
                set(item, obstacle, key, value, t_s)
            }
            Self::Control { control, value } => {
                if !CONTROL.contains(&control.as_str()) {
                    return Err(ChangeError::UnknownKey {
                        name: "control".to_owned(),
                        key: control.clone(),
                        known: CONTROL.join(", "),
                    });
                }
                scenario["control"][control] = value.clone();
                Ok(())
            }
            Self::Order { order } => reorder(list(scenario, "task"), order),
        }
    }

    /// The scenario as its types have it, where the change is still there.
    fn checked(&self, json: Value) -> Result<Value, ChangeError> {
        let (name, key, value) = match self {
            Self::Order { .. } => return Ok(json),
            Self::Control { control, value } => ("control", control, value),
            Self::Task {
                task, key, value, ..
            } => (task.as_str(), key, value),
            Self::Obstacle {
                obstacle,
                key,
                value,
                ..
            } => (obstacle.as_str(), key, value),
        };
        let bad = || ChangeError::BadValue {
            name: name.to_owned(),
            key: key.clone(),
            value: shortened(value),
        };
        let scenario: Scenario = serde_json::from_value(json).map_err(|_| bad())?;
        let mut json = serde_json::to_value(scenario).map_err(|_| bad())?;
        let item = match self {
            Self::Task { task, .. } => named(list(&mut json, "task"), "task", task)?,
            Self::Obstacle { obstacle, .. } => {
                named(list(&mut json, "obstacle"), "obstacle", obstacle)?
            }
            _ => return Ok(json),
        };
        // What no type has a place for is left out.
        let is_there = item.get(key).is_some_and(|value| !value.is_null());
        if is_there == value.is_null() {
            let known = item.keys().map(String::as_str);
            let known = known.filter(|key| !FIXED.contains(key));
            return Err(if value.is_null() {
                bad()
            } else {
                ChangeError::UnknownKey {
                    name: name.to_owned(),
                    key: key.clone(),
                    known: known.collect::<Vec<_>>().join(", "),
                }
            });
        }
        Ok(json)
    }

    /// The tasks that glide at a speed of their own.
    fn push_speeds(
        &self,
        scenario: &Scenario,
        speeds: &mut Vec<(String, GlideSpeed)>,
    ) -> Result<(), ChangeError> {
        let (Self::Task { speed, .. } | Self::Obstacle { speed, .. }) = self else {
            return Ok(());
        };
        let Some(speed) = *speed else { return Ok(()) };
        if !(speed > 0.0 && speed <= FASTEST) {
            return Err(ChangeError::Speed(speed));
        }
        match self {
            Self::Task { task, .. } => speeds.push((task.clone(), GlideSpeed::of(speed))),
            Self::Obstacle { obstacle, .. } => {
                for task in scenario.all_tasks() {
                    let between = scenario.between(&task);
                    if between.is_some_and(|between| between.contains(obstacle)) {
                        speeds.push((task.name, GlideSpeed::of(speed)));
                    }
                }
            }
            _ => {}
        }
        Ok(())
    }
}
