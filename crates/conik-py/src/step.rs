//! What one tick decided.

use std::sync::Arc;

use conik::TaskId;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::controller::Controller;

/// Tasks as they stand in the stack.
pub struct Listed {
    pub id: TaskId,
    pub name: String,
    pub is_set: bool,
}

/// One tick of a controller.
#[pyclass(frozen, module = "conik")]
pub struct Step {
    tick: conik::Step,
    tasks: Arc<[Listed]>,
    controller: Py<Controller>,
}

impl Step {
    pub fn new(tick: conik::Step, tasks: Arc<[Listed]>, controller: Py<Controller>) -> Self {
        Self {
            tick,
            tasks,
            controller,
        }
    }
}

/// A number, or an array of several.
fn numbers<'py>(py: Python<'py>, values: &[f64]) -> PyResult<Bound<'py, PyAny>> {
    match values {
        [value] => Ok(value.into_pyobject(py)?.into_any()),
        values => Ok(PyArray1::from_slice(py, values).into_any()),
    }
}

#[pymethods]
impl Step {
    #[getter]
    fn qd<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.tick.qd)
    }

    #[getter]
    fn qdd<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.tick.qdd)
    }

    #[getter]
    fn q_ref<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.tick.q_ref)
    }

    #[getter]
    fn active<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let active = self.tick.active;
        let names = self.tasks.iter().filter(|task| active.contains(task.id));
        let names: Vec<&str> = names.map(|task| task.name.as_str()).collect();
        PyTuple::new(py, names)
    }

    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let values = PyDict::new(py);
        for task in &*self.tasks {
            values.set_item(&task.name, numbers(py, self.tick.value(task.id))?)?;
        }
        Ok(values)
    }

    #[getter]
    fn errors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let errors = PyDict::new(py);
        for task in self.tasks.iter().filter(|task| !task.is_set) {
            errors.set_item(&task.name, numbers(py, self.tick.error(task.id))?)?;
        }
        Ok(errors)
    }

    #[getter]
    fn why(&self) -> PyResult<Vec<String>> {
        let reasons = self.tick.reasons();
        self.controller.get().with_stack(|stack| {
            let words = reasons
                .iter()
                .map(|reason| reason.in_words(stack).to_string());
            words.collect()
        })
    }

    #[getter]
    fn codes(&self) -> PyResult<Vec<String>> {
        let reasons = self.tick.reasons();
        self.controller.get().with_stack(|stack| {
            let codes = reasons.iter().map(|reason| reason.code(stack).to_string());
            codes.collect()
        })
    }

    #[getter]
    fn stood_still(&self) -> bool {
        self.tick.landed.stood_still || self.tick.no_mode
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let active = self.active(py)?;
        Ok(format!(
            "<conik.Step to q_ref {:?}, active {}>",
            &self.tick.q_ref[..],
            active.repr()?
        ))
    }
}
