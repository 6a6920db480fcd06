//! Numbers from Python: of a numpy array at no cost, or of anything that is a sequence of them.

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;

/// Numbers one after the other.
pub enum Numbers<'py> {
    Array(PyReadonlyArray1<'py, f64>),
    List(Vec<f64>),
}

impl Numbers<'_> {
    /// The numbers, if they lie one after the other in memory or were copied.
    pub fn as_slice(&self) -> PyResult<&[f64]> {
        match self {
            Self::Array(array) => Ok(array.as_slice()?),
            Self::List(list) => Ok(list),
        }
    }
}

impl<'a, 'py> FromPyObject<'a, 'py> for Numbers<'py> {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(array) = object.cast::<PyArray1<f64>>() {
            let array = array.readonly();
            if array.as_slice().is_ok() {
                return Ok(Self::Array(array));
            }
        }
        object.extract().map(Self::List)
    }
}

/// A matrix as numpy has it.
pub fn matrix<'py, const N: usize>(
    py: Python<'py>,
    rows: &[[f64; N]],
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let flat: Vec<f64> = rows.iter().flatten().copied().collect();
    PyArray1::from_vec(py, flat).reshape([rows.len(), N])
}
