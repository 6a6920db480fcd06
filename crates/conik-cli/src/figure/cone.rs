//! Cones of view: where an axis of the tool may point, or what the tool sees.

use conik::{Frame, Kinematics, Robot, Vec3};
use conik_sim::scenario::{GoalConfig, TaskConfig, TaskKind};

use super::camera::{Vector, View};
use super::ink::Stroke;
use super::obstacles::tint;
use super::run::Run;
use super::shading::mix;
use super::solid::{across, hull};
use super::svg::{Marks, Point};

/// Wider ones are no cones any more.
const WIDEST: f64 = 1.3;

/// A cone with its tip at a frame of the robot.
#[derive(Clone, Debug)]
pub struct Cone {
    tip: Vec3,
    /// Its axis as long as it is [m].
    axis: Vec3,
    half_angle_rad: f64,
    tint: &'static str,
    /// 1, or less for one of an earlier time.
    pub sheet: f64,
}

/// The cones of a run at `t_s`, the kinematics being those of that time; `length` is that of a cone that has
/// no end [m].
pub fn of(
    run: &Run,
    robot: &Robot,
    (t_s, kinematics): (f64, &Kinematics),
    length: f64,
    sheet: f64,
) -> Vec<Cone> {
    let cone = |task: &TaskConfig| {
        let GoalConfig::Set { max: Some(max), .. } = task.goal else {
            return None;
        };
        let frame = match &task.frames.frame {
            Some(link) => robot.frame(link)?,
            None => Frame::Tool,
        };
        let pose = kinematics.world_from(frame);
        let along = |direction: &Vector| {
            let turned = Vec3::from(*direction).turned_by(task.motion.turned_at(t_s).into());
            turned * length
        };
        let (axis, half_angle_rad) = match &task.kind {
            TaskKind::FieldOfView { direction } => {
                (along(direction), 2.0 * (0.5 * max).min(1.0).asin())
            }
            TaskKind::PointingAngle { direction, .. } => (along(direction), max),
            TaskKind::LookAt { point_m } => {
                let point = task.motion.point_at(*point_m, t_s);
                let away = (Vec3::from(point) - pose.origin).norm();
                (pose.z_axis * away.min(4.0 * length), max)
            }
            _ => return None,
        };
        let is_seen = task.frames.relative_to.is_none() && half_angle_rad < WIDEST;
        is_seen.then(|| Cone {
            tip: pose.origin,
            axis,
            half_angle_rad,
            tint: tint(run, |set| set == task.name),
            sheet,
        })
    };
    run.tasks().iter().filter_map(cone).collect()
}

impl Cone {
    /// Points around its wide end [m].
    pub fn rim(&self) -> Vec<Vector> {
        let (sin, cos) = self.half_angle_rad.sin_cos();
        let (a, b) = across(self.axis);
        let length = self.axis.norm();
        let centre = self.tip + self.axis * cos;
        let point = |nth: u32| {
            let (s, c) = (f64::from(nth) * 10_f64.to_radians()).sin_cos();
            (centre + (a * c + b * s) * (length * sin)).to_array()
        };
        (0..36).map(point).collect()
    }

    /// Draws it, translucent.
    pub fn draw(&self, view: &View, marks: &mut Marks) {
        let tip = view.place(self.tip.to_array());
        let rim: Vec<Point> = self
            .rim()
            .into_iter()
            .map(|point| view.place(point))
            .collect();
        let mut all = rim.clone();
        all.push(tip);
        let edge = mix(self.tint, -0.2);
        let fill = mix(self.tint, 0.3);
        marks.open_sheet(self.sheet);
        marks.face(&hull(all), &fill, 0.14, Stroke::solid(&edge, 0.8));
        marks.face(&rim, &fill, 0.1, Stroke::solid(&edge, 0.8));
        let end = view.place((self.tip + self.axis).to_array());
        marks.line(tip, end, Stroke::dashed(&edge, 0.8, "4 3"));
        marks.close_sheet();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rim_is_at_the_half_angle_all_round() {
        let cone = Cone {
            tip: Vec3::new(0.1, -0.2, 0.3),
            axis: Vec3::new(0.3, 0.4, 0.0),
            half_angle_rad: 0.35,
            tint: "#000000",
            sheet: 1.0,
        };
        for point in cone.rim() {
            let side = Vec3::from(point) - cone.tip;
            let cos = side.dot(cone.axis) / (side.norm() * cone.axis.norm());
            assert!((cos.acos() - 0.35).abs() < 1e-9, "{point:?}");
            assert!((side.norm() - 0.5).abs() < 1e-9, "{point:?}");
        }
    }
}
