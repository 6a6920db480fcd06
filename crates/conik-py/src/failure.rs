//! Exceptions.

use std::fmt::Display;

use pyo3::PyErr;
use pyo3::create_exception;
use pyo3::exceptions::PyException;

create_exception!(
    conik,
    ConikError,
    PyException,
    "What conik cannot do, and why."
);
create_exception!(
    conik,
    ScenarioError,
    ConikError,
    "A scenario, a robot or a stack of tasks with mistakes: one line for each."
);
create_exception!(
    conik,
    StepError,
    ConikError,
    "A tick that gave no reference. The last one stands: stop the arm."
);

/// As a mistake in what was described.
pub fn described(error: impl Display) -> PyErr {
    ScenarioError::new_err(error.to_string())
}

/// As what cannot be done.
pub fn refused(error: impl Display) -> PyErr {
    ConikError::new_err(error.to_string())
}
