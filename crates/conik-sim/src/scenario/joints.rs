//! Reading what refers to the joints of the robot: as many numbers as it has, one of them by number
//! or name.

use super::key::{Holds, Key, Range};
use super::mistake::Mistakes;
use super::robots::RobotFacts;
use super::table::{Entry, Table, unknown_name};
use super::value::{Value, shown};

/// Joints that a robot may have at most.
const MOST_JOINTS: usize = 32;

/// Two numbers, the lesser one first, or none.
pub(super) type Pair = Option<[f64; 2]>;

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
            fits(value, given, robot, found).then_some(numbers)?
        })
    }

    /// As [`joint_numbers`](Self::joint_numbers), or one number that stands for all joints.
    pub(super) fn number_or_joint_numbers(
        &self,
        key: &'static Key,
        robot: Option<&RobotFacts>,
        found: &mut Mistakes,
    ) -> Entry<Vec<f64>> {
        let is_one = |value: &Value| {
            let value = value.toml.get_ref();
            value.is_integer() || value.is_float()
        };
        match self.value(key) {
            Some(value) if is_one(&value) => self.entry(key, |value| {
                let number = value.number(&key.range(), found)?;
                let robot = robot?;
                if robot.slides.contains(&true) && robot.slides.contains(&false) {
                    found.add(
                        value.span(),
                        &*value.path,
                        "one number for joints that turn and joints that slide",
                        format!("give one for each joint: {}", robot.joint_names.join(", ")),
                    );
                    return None;
                }
                Some(vec![number; robot.joint_names.len()])
            }),
            _ => self.joint_numbers(key, robot, found),
        }
    }

    /// For each joint of the robot two numbers, the lesser one first, or none.
    pub(super) fn joint_pairs(
        &self,
        key: &'static Key,
        robot: Option<&RobotFacts>,
        found: &mut Mistakes,
    ) -> Entry<Vec<Pair>> {
        self.entry(key, |value| {
            let members = value.lists("a pair of numbers, or `[]`", found)?;
            // Every pair is looked at, also after a wrong one.
            let pairs: Vec<_> = members.iter().map(|member| pair(member, found)).collect();
            let pairs = pairs.into_iter().collect();
            fits(value, members.len(), robot, found).then_some(pairs)?
        })
    }

    /// The 1-based number of a joint, given as a number or by the joint's name.
    pub(super) fn joint(
        &self,
        key: &'static Key,
        robot: Option<&RobotFacts>,
        found: &mut Mistakes,
    ) -> Entry<usize> {
        self.entry(key, |value| value.joint(robot, found))
    }

    /// Numbers in the range that the key allows, however many.
    pub(super) fn any_joint_numbers(
        &self,
        key: &'static Key,
        found: &mut Mistakes,
    ) -> Entry<Vec<f64>> {
        self.entry(key, |value| value.numbers(&key.range(), found))
    }
}

impl Value<'_> {
    /// The 1-based number of a joint, given as a number or by the joint's name.
    pub(super) fn joint(&self, robot: Option<&RobotFacts>, found: &mut Mistakes) -> Option<usize> {
        let names: &[String] = match robot {
            Some(robot) => &robot.joint_names,
            None => &[],
        };
        if let Some(name) = self.toml.get_ref().as_str() {
            // The names of an unknown robot's joints are unknown too; that is noted already.
            robot?;
            let index = names.iter().position(|joint| *joint == name);
            if index.is_none() {
                let (what, help) = unknown_name(name, names.iter().map(String::as_str));
                found.add(self.span(), &*self.path, what, help);
            }
            return index.map(|index| index + 1);
        }
        if !self.toml.get_ref().is_integer() && !self.toml.get_ref().is_float() {
            self.wrong_kind(self.key.holds.expected(), found);
            return None;
        }
        let number = self.number(&Range::FINITE, found)?;
        let most = if robot.is_some() {
            names.len()
        } else {
            MOST_JOINTS
        };
        let joint = (1..=most).find(|joint| *joint as f64 == number);
        if joint.is_none() {
            found.add(
                self.span(),
                &*self.path,
                format!("there is no joint {}", shown(number)),
                format!(
                    "the joints are 1 to {most}, from base to tool: {}",
                    names.join(", ")
                ),
            );
        }
        joint
    }
}

/// Whether the robot, if it is known, has as many joints as the list has members; noted if not.
fn fits(value: &Value, given: usize, robot: Option<&RobotFacts>, found: &mut Mistakes) -> bool {
    let Some(robot) = robot.filter(|robot| robot.joint_names.len() != given) else {
        return true;
    };
    let joints = robot.joint_names.len();
    let members = match value.key.holds {
        Holds::JointPairs(_) => "pairs",
        _ => "numbers",
    };
    found.add(
        value.span(),
        &*value.path,
        format!(
            "robot {:?} has {joints} joints, found {given} {members}",
            robot.name
        ),
        format!(
            "give {joints} {members}, from base to tool: {}",
            robot.joint_names.join(", ")
        ),
    );
    false
}

/// Two numbers, the lesser one first: `Some(None)` for an empty list.
fn pair(value: &Value, found: &mut Mistakes) -> Option<Pair> {
    let numbers = value.numbers(&value.key.range(), found)?;
    let (what, help) = match numbers[..] {
        [] => return Some(None),
        [min, max] if min <= max => return Some(Some([min, max])),
        [min, max] => (
            format!("{} is greater than {}", shown(min), shown(max)),
            "the least position stands first".to_owned(),
        ),
        _ => (
            format!("expected two numbers or none, found {}", numbers.len()),
            value.key.write_example(),
        ),
    };
    found.add(value.span(), &*value.path, what, help);
    None
}
