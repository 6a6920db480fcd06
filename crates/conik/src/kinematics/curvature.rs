//! Second derivatives: how the Jacobians of points, of axes and of orientations change with q.

use super::{Kinematics, Motion, TwoTwists};
use crate::geometry::Vec3;
use crate::robot::JointKind;

/// Two bodies on the way between two frames, one of which turns what the other does.
struct Pair {
    /// The joint that turns the other one's effect.
    joint: usize,
    other: usize,
    /// Whether they are one body.
    is_one: bool,
    /// d · (zᵢ × Jⱼ), each per unit of its joint.
    bend: f64,
}

impl Kinematics {
    /// Adds the second derivatives [m/rad²] of a point along `direction` to `hessian`, one row of one
    /// entry per joint for each joint.
    pub fn add_point_curvature(
        &self,
        motion: Motion,
        point: Vec3,
        direction: Vec3,
        hessian: &mut [f64],
    ) {
        self.for_each_pair(motion, direction, of_point(point), |pair| {
            pair.add_to(hessian, self.dof());
        });
    }

    /// Adds the second derivatives [1/rad²] of a unit vector that is fixed to a frame, along `direction`,
    /// to `hessian`, one row of one entry per joint for each joint.
    pub fn add_axis_curvature(
        &self,
        motion: Motion,
        axis: Vec3,
        direction: Vec3,
        hessian: &mut [f64],
    ) {
        let of_axis = |direction: Vec3, twist: &TwoTwists, i: usize| {
            twist.get(i).0.dot(axis.cross(direction))
        };
        self.for_each_pair(motion, direction, of_axis, |pair| {
            pair.add_to(hessian, self.dof());
        });
    }

    /// Adds the derivatives ∂(d · J v)/∂q of the speed of a point along d = `direction` at joint velocities
    /// v that stay, one entry per joint.
    pub(crate) fn add_point_speed_gradient(
        &self,
        motion: Motion,
        point: Vec3,
        direction: Vec3,
        velocities: &[f64],
        gradient: &mut [f64],
    ) {
        self.for_each_pair(motion, direction, of_point(point), |pair| {
            gradient[pair.joint] += pair.bend * velocities[pair.other];
            if !pair.is_one {
                gradient[pair.other] += pair.bend * velocities[pair.joint];
            }
        });
    }

    /// The same of the angular velocity about d, whose Jacobian is no derivative of anything: only the
    /// joints nearer to where the frame is seen from turn the axes of the others.
    pub(crate) fn add_turn_speed_gradient(
        &self,
        motion: Motion,
        direction: Vec3,
        velocities: &[f64],
        gradient: &mut [f64],
    ) {
        let of_turn = |direction: Vec3, twist: &TwoTwists, i: usize| twist.get(i).0.dot(direction);
        self.for_each_pair(motion, direction, of_turn, |pair| {
            gradient[pair.joint] += pair.bend * velocities[pair.other];
        });
    }

    /// Of two joints between the frames, the one nearer to where they are seen from turns all that the
    /// other does: the second derivative along d is d · (zᵢ × Jⱼ), which is entry j of the row along
    /// d × zᵢ.
    fn for_each_pair(
        &self,
        motion: Motion,
        direction: Vec3,
        entry: impl Fn(Vec3, &TwoTwists, usize) -> f64,
        mut visit: impl FnMut(Pair),
    ) {
        // From there the way goes back to what carries both, then forward.
        let back = (0..self.bodies.len())
            .rev()
            .filter(|i| motion.backward >> i & 1 == 1);
        let forth = (0..self.bodies.len()).filter(|i| motion.forward >> i & 1 == 1);
        let way = back.chain(forth);
        for (place, i) in way.clone().enumerate() {
            if self.bodies[i].kind == JointKind::Prismatic {
                continue;
            }
            let (joint, rate) = self.drive(i);
            let rate = rate * motion.sign(i);
            let (axis, _) = self.twists[i / 2].get(i % 2);
            let along = direction.cross(axis) * rate;
            for j in way.clone().skip(place) {
                let (other, other_rate) = self.drive(j);
                let bend = entry(along, &self.twists[j / 2], j % 2) * other_rate * motion.sign(j);
                visit(Pair {
                    joint,
                    other,
                    is_one: i == j,
                    bend,
                });
            }
        }
    }
}

impl Pair {
    fn add_to(&self, hessian: &mut [f64], dof: usize) {
        hessian[self.joint * dof + self.other] += self.bend;
        if !self.is_one {
            hessian[self.other * dof + self.joint] += self.bend;
        }
    }
}

/// d · (ω × p + v), as in `point_row`.
fn of_point(point: Vec3) -> impl Fn(Vec3, &TwoTwists, usize) -> f64 {
    move |direction, twist, i| {
        let (turn, slide) = twist.get(i);
        turn.dot(point.cross(direction)) + slide.dot(direction)
    }
}
