//! Robots.

use std::path::PathBuf;
use std::sync::Arc;

use conik::{Frame, JointVec};
use conik_sim::scenario::{LimitsConfig, PlacesConfig, RobotConfig, RobotSource, UrdfConfig};
use numpy::PyArray2;
use pyo3::prelude::*;

use crate::failure::described;
use crate::kinematics::{self, Kinematics};
use crate::numbers::{Numbers, matrix};

/// A robot: the joints between its base and its tool.
#[pyclass(frozen, module = "conik")]
pub struct Robot {
    pub(crate) config: RobotConfig,
    pub(crate) robot: Arc<conik::Robot>,
}

/// One name, or several.
#[derive(FromPyObject)]
enum Names {
    One(String),
    Several(Vec<String>),
}

impl From<Names> for Vec<String> {
    fn from(names: Names) -> Self {
        match names {
            Names::One(name) => vec![name],
            Names::Several(names) => names,
        }
    }
}

impl Robot {
    fn of(source: RobotSource, places: PlacesConfig, limits: LimitsConfig) -> PyResult<Self> {
        let mut config = RobotConfig {
            source,
            places,
            q0_rad: Vec::new(),
            limits,
        };
        let robot = config.limited().map_err(described)?;
        config.q0_rad = vec![0.0; robot.dof()];
        Ok(Self {
            config,
            robot: Arc::new(robot),
        })
    }

    /// The frame of a link, or the tool's.
    pub fn frame(&self, link: Option<&str>) -> PyResult<Frame> {
        kinematics::frame(&self.robot, link)
    }
}

#[pymethods]
impl Robot {
    #[staticmethod]
    fn builtin(name: &str) -> PyResult<Self> {
        let model = name.to_owned();
        Self::of(
            RobotSource::Model { model },
            PlacesConfig::default(),
            LimitsConfig::default(),
        )
    }

    #[staticmethod]
    fn builtin_names() -> Vec<&'static str> {
        conik::Robot::builtin_names().to_vec()
    }

    #[staticmethod]
    #[pyo3(signature = (path, tool=None, base=None))]
    fn from_urdf(path: PathBuf, tool: Option<Names>, base: Option<String>) -> PyResult<Self> {
        let source = UrdfConfig::load(&path, base, tool.map_or(Vec::new(), Names::into))
            .map_err(described)?;
        Self::of(
            RobotSource::Urdf(source),
            PlacesConfig::default(),
            LimitsConfig::default(),
        )
    }

    #[staticmethod]
    #[pyo3(signature = (text, tool=None, base=None))]
    fn from_urdf_text(text: String, tool: Option<Names>, base: Option<String>) -> PyResult<Self> {
        let source = UrdfConfig {
            urdf: "robot.urdf".to_owned(),
            base,
            tool: tool.map_or(Vec::new(), Names::into),
            urdf_text: text,
        };
        Self::of(
            RobotSource::Urdf(source),
            PlacesConfig::default(),
            LimitsConfig::default(),
        )
    }

    #[pyo3(signature = (*, position=None, rpy=None))]
    fn standing_at(&self, position: Option<[f64; 3]>, rpy: Option<[f64; 3]>) -> PyResult<Self> {
        let places = PlacesConfig {
            base_position_m: position,
            base_rpy_deg: rpy.map(|rpy| rpy.map(f64::to_degrees)),
            ..self.config.places
        };
        Self::of(
            self.config.source.clone(),
            places,
            self.config.limits.clone(),
        )
    }

    #[pyo3(signature = (position=None, rpy=None))]
    fn with_tool_offset(
        &self,
        position: Option<[f64; 3]>,
        rpy: Option<[f64; 3]>,
    ) -> PyResult<Self> {
        let places = PlacesConfig {
            tool_offset_m: position,
            tool_offset_rpy_deg: rpy.map(|rpy| rpy.map(f64::to_degrees)),
            ..self.config.places
        };
        Self::of(
            self.config.source.clone(),
            places,
            self.config.limits.clone(),
        )
    }

    #[pyo3(signature = (*, position=None, speed=None, acceleration=None))]
    fn with_limits(
        &self,
        position: Option<Vec<Option<[f64; 2]>>>,
        speed: Option<Vec<f64>>,
        acceleration: Option<Vec<f64>>,
    ) -> PyResult<Self> {
        let before = self.config.limits.clone();
        let limits = LimitsConfig {
            position_limits_rad: position.or(before.position_limits_rad),
            speed_limits_rad_per_s: speed.or(before.speed_limits_rad_per_s),
            acceleration_limits_rad_per_s2: acceleration.or(before.acceleration_limits_rad_per_s2),
        };
        for (what, count) in [
            (
                "position",
                limits.position_limits_rad.as_ref().map(Vec::len),
            ),
            (
                "speed",
                limits.speed_limits_rad_per_s.as_ref().map(Vec::len),
            ),
            (
                "acceleration",
                limits.acceleration_limits_rad_per_s2.as_ref().map(Vec::len),
            ),
        ] {
            if let Some(count) = count.filter(|&count| count != self.dof()) {
                return Err(described(format!(
                    "{what}: {count} limits for {} joints; give one for each",
                    self.dof()
                )));
            }
        }
        Self::of(
            self.config.source.clone(),
            self.config.places.clone(),
            limits,
        )
    }

    #[getter]
    fn name(&self) -> &str {
        self.robot.name()
    }

    #[getter]
    fn dof(&self) -> usize {
        self.robot.dof()
    }

    #[getter]
    fn joint_names(&self) -> Vec<&str> {
        self.robot.joint_names().collect()
    }

    #[getter]
    fn link_names(&self) -> Vec<&str> {
        self.robot.link_names().collect()
    }

    #[getter]
    fn tool_name(&self) -> &str {
        self.robot.tool_name()
    }

    #[getter]
    fn position_limits(&self) -> Vec<Option<(f64, f64)>> {
        let joints = self.robot.joints().iter();
        joints.map(|joint| joint.limits.position).collect()
    }

    #[getter]
    fn speed_limits(&self) -> Vec<Option<f64>> {
        let joints = self.robot.joints().iter();
        joints.map(|joint| joint.limits.speed).collect()
    }

    #[getter]
    fn acceleration_limits(&self) -> Vec<Option<f64>> {
        let joints = self.robot.joints().iter();
        joints.map(|joint| joint.limits.acceleration).collect()
    }

    #[pyo3(signature = (q, link=None))]
    fn forward_kinematics<'py>(
        &self,
        py: Python<'py>,
        q: Numbers<'py>,
        link: Option<&str>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let frame = self.frame(link)?;
        let kinematics = self.at(q)?;
        let base_from_frame = kinematics.world_from(frame);
        matrix(py, &base_from_frame.to_matrix())
    }

    fn kinematics(&self, q: Numbers<'_>) -> PyResult<Kinematics> {
        let kinematics = self.at(q)?;
        Ok(Kinematics::new(kinematics, Arc::clone(&self.robot)))
    }

    fn __repr__(&self) -> String {
        format!(
            "<conik.Robot {}, {} joints, tool {}>",
            self.name(),
            self.dof(),
            self.tool_name()
        )
    }
}

impl Robot {
    fn at(&self, q: Numbers<'_>) -> PyResult<conik::Kinematics> {
        let q = JointVec::from_slice(q.as_slice()?).map_err(described)?;
        if q.len() != self.dof() {
            return Err(described(format!(
                "{} joint positions expected, {} found",
                self.dof(),
                q.len()
            )));
        }
        let mut kinematics = conik::Kinematics::new(&self.robot);
        kinematics.update(&q);
        Ok(kinematics)
    }
}
