//! What follows from one configuration.

use std::sync::Arc;

use conik::{Frame, Vec3};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

use crate::failure::described;
use crate::numbers::matrix;

/// A robot in one configuration.
#[pyclass(frozen, module = "conik")]
pub struct Kinematics {
    kinematics: conik::Kinematics,
    robot: Arc<conik::Robot>,
}

impl Kinematics {
    pub fn new(kinematics: conik::Kinematics, robot: Arc<conik::Robot>) -> Self {
        Self { kinematics, robot }
    }
}

/// The frame of a link; without a name the tool's.
pub fn frame(robot: &conik::Robot, link: Option<&str>) -> PyResult<Frame> {
    match link {
        None => Ok(Frame::Tool),
        Some(link) => robot.frame(link).ok_or_else(|| {
            let names: Vec<_> = robot.link_names().collect();
            described(format!(
                "the robot has no link `{link}`; there are: {}",
                names.join(", ")
            ))
        }),
    }
}

#[pymethods]
impl Kinematics {
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.kinematics.q())
    }

    #[getter]
    fn dof(&self) -> usize {
        self.kinematics.dof()
    }

    #[pyo3(signature = (link=None))]
    fn world_from<'py>(
        &self,
        py: Python<'py>,
        link: Option<&str>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let frame = frame(&self.robot, link)?;
        matrix(py, &self.kinematics.world_from(frame).to_matrix())
    }

    #[pyo3(signature = (link=None))]
    fn jacobian<'py>(
        &self,
        py: Python<'py>,
        link: Option<&str>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let frame = frame(&self.robot, link)?;
        let dof = self.kinematics.dof();
        let motion = self.kinematics.motion(frame);
        let origin = self.kinematics.world_from(frame).origin;
        let mut entries = vec![0.0; 6 * dof];
        let (points, turns) = entries.split_at_mut(3 * dof);
        let mut rows = points.chunks_exact_mut(dof);
        if let (Some(x), Some(y), Some(z)) = (rows.next(), rows.next(), rows.next()) {
            self.kinematics.point_rows(motion, origin, [x, y, z]);
        }
        for (row, axis) in turns.chunks_exact_mut(dof).zip(AXES) {
            self.kinematics.turn_row(motion, axis, row);
        }
        PyArray1::from_vec(py, entries).reshape([6, dof])
    }

    fn __repr__(&self) -> String {
        format!(
            "<conik.Kinematics of {} at {:?}>",
            self.robot.name(),
            &self.kinematics.q()[..]
        )
    }
}

const AXES: [Vec3; 3] = [
    Vec3::new(1.0, 0.0, 0.0),
    Vec3::new(0.0, 1.0, 0.0),
    Vec3::new(0.0, 0.0, 1.0),
];
