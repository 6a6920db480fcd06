//! The controller.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard};

use conik::{Stack, StackError, TaskId};
use conik_sim::experiment::Experiment;
use conik_sim::scenario::{GoalConfig, TaskConfig};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::failure::{ConikError, StepError, described};
use crate::numbers::Numbers;
use crate::own_task::{OwnTask, Raised};
use crate::robot::Robot;
use crate::scenario;
use crate::setpoints::Change;
use crate::step::{Listed, Step};

/// A controller for one robot and one stack of tasks.
#[pyclass(frozen, subclass, module = "conik")]
pub struct Controller {
    /// Held for as long as a call takes.
    inner: Mutex<conik::Controller>,
    tasks: Arc<[Listed]>,
    /// The tasks that are written in Python.
    own: Vec<TaskId>,
    raised: Raised,
    text: String,
}

/// A task that is written in Python, and what is desired of it if it is an equality task.
#[derive(FromPyObject)]
struct Own {
    #[pyo3(item)]
    task: Py<PyAny>,
    #[pyo3(item)]
    desired: Vec<f64>,
}

impl Controller {
    pub fn with_stack<T>(&self, look: impl FnOnce(&Stack) -> T) -> PyResult<T> {
        Ok(look(self.lock()?.stack()))
    }

    fn lock(&self) -> PyResult<MutexGuard<'_, conik::Controller>> {
        // Nobody is waited for: a task in Python that asks its own controller would wait for itself.
        self.inner.try_lock().map_err(|_| {
            ConikError::new_err("the controller is at work: it takes one call at a time")
        })
    }

    fn find(&self, name: &str) -> PyResult<TaskId> {
        let listed = self.tasks.iter().find(|task| task.name == name);
        listed.map(|task| task.id).ok_or_else(|| {
            let names: Vec<_> = self.tasks.iter().map(|task| task.name.as_str()).collect();
            described(format!(
                "there is no task `{name}`; there are: {}",
                names.join(", ")
            ))
        })
    }
}

/// Adds a task that is written in Python.
fn add(
    stack: &mut Stack,
    config: &TaskConfig,
    task: OwnTask,
    desired: &[f64],
) -> Result<TaskId, StackError> {
    let name = &config.name;
    match config.goal {
        GoalConfig::Set {
            min,
            max,
            gain_per_s,
            ..
        } => {
            let allowed = conik::Interval {
                min: min.unwrap_or(f64::NEG_INFINITY),
                max: max.unwrap_or(f64::INFINITY),
            };
            match gain_per_s {
                Some(gain) => stack.set_with_gain(name, task, allowed, gain),
                None => stack.set(name, task, allowed),
            }
        }
        GoalConfig::Desired { gain_per_s, .. } | GoalConfig::Waypoints { gain_per_s, .. } => {
            stack.equality(name, task, desired, gain_per_s)
        }
    }
}

#[pymethods]
impl Controller {
    #[new]
    fn new(
        py: Python<'_>,
        robot: &Robot,
        tables: &Bound<'_, PyDict>,
        own: HashMap<String, Own>,
    ) -> PyResult<Self> {
        let scenario = scenario::of_robot(&robot.config, tables)?;
        let raised = Raised::default();
        let mut tasks = HashMap::new();
        for (name, own) in own {
            let task = OwnTask::new(own.task.bind(py), Arc::clone(&robot.robot), raised.clone())?;
            tasks.insert(name, (task, own.desired));
        }
        let mut ids = Vec::new();
        let experiment = Experiment::with_own(&scenario, |stack, config| {
            let (task, desired) = tasks.remove(&config.name)?;
            let added = add(stack, config, task, &desired);
            ids.extend(added.as_ref().ok());
            Some(added)
        });
        let controller = experiment.map_err(described)?.controller;
        let listed = controller.stack().iter().map(|(id, level)| Listed {
            id,
            name: level.name().to_owned(),
            is_set: level.interval().is_some(),
        });
        Ok(Self {
            tasks: listed.collect(),
            inner: Mutex::new(controller),
            own: ids,
            raised,
            text: scenario.to_toml(),
        })
    }

    fn step(this: &Bound<'_, Self>, q: Numbers<'_>) -> PyResult<Step> {
        let own = this.get();
        let mut controller = own.lock()?;
        for &task in &own.own {
            // Its parameters are Python's, where anybody may have changed them.
            controller.setpoints().task_mut::<OwnTask>(task);
        }
        let step = match controller.step(q.as_slice()?) {
            Ok(step) => step.clone(),
            Err(error) => {
                let raised = own.raised.take();
                return Err(raised.unwrap_or_else(|| StepError::new_err(error.to_string())));
            }
        };
        drop(controller);
        Ok(Step::new(
            step,
            Arc::clone(&own.tasks),
            this.clone().unbind(),
        ))
    }

    #[pyo3(name = "_change")]
    fn change(&self, name: &str, change: Change) -> PyResult<()> {
        let task = self.find(name)?;
        change.make(&mut *self.lock()?, task)
    }

    #[getter]
    fn task_names(&self) -> Vec<&str> {
        self.tasks.iter().map(|task| task.name.as_str()).collect()
    }

    #[getter]
    fn rate_hz(&self) -> PyResult<f64> {
        Ok(self.lock()?.settings().rate_hz)
    }

    /// The scenario of which it was made, without tasks written in Python.
    #[getter]
    fn _toml(&self) -> &str {
        &self.text
    }
}
