//! Scenarios from Python: files, and tables of the same keys.

use std::path::Path;

use conik_sim::scenario::{RobotConfig, Scenario};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyString};
use toml::Value;

use crate::failure::{described, refused};
use crate::robot::Robot;

/// A scenario of a robot, and of the other tables of a file.
pub fn of_robot(robot: &RobotConfig, tables: &Bound<'_, PyDict>) -> PyResult<Scenario> {
    let text = robot.to_toml() + "\n" + &toml(tables)?;
    let scenario = Scenario::from_toml_knowing(&robot.source, &text);
    scenario.map_err(|errors| described(errors.without_places()))
}

/// A scenario of all tables of a file.
pub fn of_tables(tables: &Bound<'_, PyDict>) -> PyResult<Scenario> {
    of_text(&toml(tables)?)
}

/// A scenario from a file.
pub fn of_file(path: &Path) -> PyResult<Scenario> {
    Scenario::load(path).map_err(described)
}

/// The same with other settings: entries of its table `control`.
pub fn with_control(scenario: &Scenario, control: &Bound<'_, PyDict>) -> PyResult<Scenario> {
    if control.is_empty() {
        return Ok(scenario.clone());
    }
    let mut tables: toml::Table = toml::from_str(&scenario.to_toml()).map_err(refused)?;
    if let (Some(Value::Table(there)), Value::Table(given)) =
        (tables.get_mut("control"), value(control.as_any())?)
    {
        there.extend(given);
    }
    let text = toml::to_string(&tables).map_err(refused)?;
    let scenario = Scenario::from_toml_knowing(&scenario.robot.source, &text);
    scenario.map_err(|errors| described(errors.without_places()))
}

fn of_text(text: &str) -> PyResult<Scenario> {
    // Its lines and columns are nobody's.
    Scenario::from_toml(text).map_err(|errors| described(errors.without_places()))
}

fn toml(tables: &Bound<'_, PyDict>) -> PyResult<String> {
    toml::to_string(&value(tables.as_any())?).map_err(refused)
}

/// A Python object as the file would have it.
fn value(object: &Bound<'_, PyAny>) -> PyResult<Value> {
    if let Ok(flag) = object.cast::<PyBool>() {
        return Ok(Value::Boolean(flag.is_true()));
    }
    if let Ok(text) = object.cast::<PyString>() {
        return Ok(Value::String(text.to_str()?.to_owned()));
    }
    if let Ok(table) = object.cast::<PyDict>() {
        let entries = table
            .iter()
            .map(|(key, entry)| Ok((key.extract()?, value(&entry)?)));
        return Ok(Value::Table(entries.collect::<PyResult<_>>()?));
    }
    if !object.is_instance_of::<PyFloat>()
        && let Ok(number) = object.extract()
    {
        return Ok(Value::Integer(number));
    }
    if let Ok(number) = object.extract() {
        return Ok(Value::Float(number));
    }
    let Ok(entries) = object.try_iter() else {
        let what = format!("{} has no place in a scenario", object.repr()?);
        return Err(PyTypeError::new_err(what));
    };
    let entries = entries.map(|entry| value(&entry?));
    Ok(Value::Array(entries.collect::<PyResult<_>>()?))
}

/// Raises what is wrong with the tables of a scenario of this robot.
#[pyfunction]
pub fn check(robot: &Robot, tables: &Bound<'_, PyDict>) -> PyResult<()> {
    of_robot(&robot.config, tables).map(drop)
}
