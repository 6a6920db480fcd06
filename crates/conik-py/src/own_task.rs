//! Tasks that are written in Python.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use conik::{JacobianMut, Task};
use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;

use crate::failure::described;
use crate::kinematics::Kinematics;

/// What was raised in a task while the controller was at work, which can only be told afterwards.
#[derive(Clone, Default)]
pub struct Raised(Arc<Mutex<Option<PyErr>>>);

impl Raised {
    pub fn take(&self) -> Option<PyErr> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Keeps the first.
    fn keep(&self, error: PyErr) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.get_or_insert(error);
    }
}

/// A task whose value and Jacobian an object in Python gives.
pub struct OwnTask {
    object: Py<PyAny>,
    robot: Arc<conik::Robot>,
    dimension: usize,
    unit: &'static str,
    is_moving: bool,
    raised: Raised,
}

impl fmt::Debug for OwnTask {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OwnTask")
            .field("object", &self.object)
            .finish_non_exhaustive()
    }
}

impl OwnTask {
    pub fn new(
        object: &Bound<'_, PyAny>,
        robot: Arc<conik::Robot>,
        raised: Raised,
    ) -> PyResult<Self> {
        let unit: String = object.getattr("unit")?.extract()?;
        Ok(Self {
            dimension: object.getattr("dimension")?.extract()?,
            is_moving: object.hasattr("value_ahead")?,
            // A few bytes once for each task.
            unit: unit.leak(),
            object: object.clone().unbind(),
            robot,
            raised,
        })
    }

    /// Asks the object, and hands on what it gives: `count` numbers. Without them the tick fails, as it does
    /// where they are not finite, and what was raised is raised there.
    fn ask(
        &self,
        kinematics: &conik::Kinematics,
        method: &str,
        ahead_s: Option<f64>,
        count: usize,
        take: impl FnOnce(&[f64]),
    ) -> Option<()> {
        Python::attach(|py| {
            let here = Kinematics::new(kinematics.clone(), Arc::clone(&self.robot));
            let object = self.object.bind(py);
            let given = match ahead_s {
                Some(ahead_s) => object.call_method1(method, (here, ahead_s)),
                None => object.call_method1(method, (here,)),
            };
            let done = given.and_then(|given| {
                let array = float_array(&given)?;
                if array.len() != count {
                    return Err(described(format!(
                        "{method}() of {} gave {} numbers; {count} are expected",
                        object.repr()?,
                        array.len()
                    )));
                }
                take(array.readonly().as_slice()?);
                Ok(())
            });
            done.map_err(|error| self.raised.keep(error)).ok()
        })
    }
}

/// `numpy.ascontiguousarray(given, dtype=float)`
fn float_array<'py>(given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    static CONVERT: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let py = given.py();
    let convert = CONVERT.import(py, "numpy", "ascontiguousarray")?;
    let types = PyDict::new(py);
    types.set_item("dtype", "float64")?;
    Ok(convert.call((given,), Some(&types))?.cast_into()?)
}

impl Task for OwnTask {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn value(&self, kinematics: &conik::Kinematics, value: &mut [f64]) {
        let count = value.len();
        let asked = self.ask(kinematics, "value", None, count, |given| {
            value.copy_from_slice(given);
        });
        if asked.is_none() {
            value.fill(f64::NAN);
        }
    }

    fn jacobian(&self, kinematics: &conik::Kinematics, jacobian: &mut JacobianMut<'_>) {
        let dof = kinematics.dof();
        let count = self.dimension * dof;
        let asked = self.ask(kinematics, "jacobian", None, count, |given| {
            for (i, row) in given.chunks_exact(dof).enumerate() {
                jacobian.row(i).copy_from_slice(row);
            }
        });
        if asked.is_none() {
            for i in 0..self.dimension {
                jacobian.row(i).fill(f64::NAN);
            }
        }
    }

    fn is_moving(&self) -> bool {
        self.is_moving
    }

    fn value_ahead(&self, kinematics: &conik::Kinematics, ahead_s: f64, value: &mut [f64]) {
        let (count, ahead_s) = (value.len(), Some(ahead_s));
        let asked = self.ask(kinematics, "value_ahead", ahead_s, count, |given| {
            value.copy_from_slice(given);
        });
        if asked.is_none() {
            value.fill(f64::NAN);
        }
    }

    fn unit(&self) -> &'static str {
        self.unit
    }

    fn check(&self, _robot: &conik::Robot) -> Result<(), &'static str> {
        Ok(())
    }
}
