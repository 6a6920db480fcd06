//! Reading what refers to the joints of the robot: as many numbers as it has, one of them by number
//! or name.

use super::key::{Key, Range};
use super::mistake::Mistakes;
use super::robots::RobotFacts;
use super::table::{Entry, Table, unknown_name};
use super::value::shown;

/// Joints that a robot may have at most.
const MOST_JOINTS: usize = 32;

impl Table<'_> {
    /// Numbers in the range that the key allows, one for each joint of the robot, if it is known.
    pub(super) fn joint_numbers(
        &self,
        key: &'static Key,
        robot: Option<&RobotFacts>,
        found: &mut Mistakes,
    ) -> Entry<Vec<f64>> {
        self.entry(key, |value| {
            let numbers = value.numbers(&key.range(), found);
            let given = value.toml.get_ref().as_array()?.len();
            let Some(robot) = robot.filter(|robot| robot.joint_names.len() != given) else {
                return numbers;
            };
            let joints = robot.joint_names.len();
            found.add(
                value.span(),
                &*value.path,
                format!(
                    "robot {:?} has {joints} joints, found {given} numbers",
                    robot.name
                ),
                format!(
                    "give {joints} numbers, from base to tool: {}",
                    robot.joint_names.join(", ")
                ),
            );
            None
        })
    }

    /// The 1-based number of a joint, given as a number or by the joint's name.
    pub(super) fn joint(
        &self,
        key: &'static Key,
        robot: Option<&RobotFacts>,
        found: &mut Mistakes,
    ) -> Entry<usize> {
        self.entry(key, |value| {
            let names: &[String] = match robot {
                Some(robot) => &robot.joint_names,
                None => &[],
            };
            if let Some(name) = value.toml.get_ref().as_str() {
                // The names of an unknown robot's joints are unknown too; that is noted already.
                robot?;
                let index = names.iter().position(|joint| *joint == name);
                if index.is_none() {
                    let (what, help) = unknown_name(name, names.iter().map(String::as_str));
                    found.add(value.span(), &*value.path, what, help);
                }
                return index.map(|index| index + 1);
            }
            if !value.toml.get_ref().is_integer() && !value.toml.get_ref().is_float() {
                value.wrong_kind(key.holds.expected(), found);
                return None;
            }
            let number = value.number(&Range::FINITE, found)?;
            let most = if robot.is_some() {
                names.len()
            } else {
                MOST_JOINTS
            };
            let joint = (1..=most).find(|joint| *joint as f64 == number);
            if joint.is_none() {
                found.add(
                    value.span(),
                    &*value.path,
                    format!("there is no joint {}", shown(number)),
                    format!(
                        "the joints are 1 to {most}, from base to tool: {}",
                        names.join(", ")
                    ),
                );
            }
            joint
        })
    }
}
