//! What a key of the file is: its name, what it may hold, and what it is for.

use super::choice::Choice;

/// A key of a table in the scenario file. Reader, schema and messages all follow from it.
#[derive(Debug)]
pub(super) struct Key {
    /// As written in the file.
    pub(super) name: &'static str,
    /// What it is, in one line for people.
    pub(super) about: &'static str,
    /// Unit for people: `m`, `1/s`; empty where there is none.
    pub(super) unit: &'static str,
    /// What it may hold.
    pub(super) holds: Holds,
    /// A right value, as it would stand in the file.
    pub(super) example: &'static str,
}

impl Key {
    pub(super) const fn new(
        name: &'static str,
        unit: &'static str,
        about: &'static str,
        holds: Holds,
        example: &'static str,
    ) -> Self {
        Self {
            name,
            about,
            unit,
            holds,
            example,
        }
    }

    /// The numbers that it may hold.
    pub(super) fn range(&self) -> Range {
        match self.holds {
            Holds::Number(range)
            | Holds::JointNumbers(range)
            | Holds::NumberOrJointNumbers(range)
            | Holds::JointPairs(range)
            | Holds::Vector(range)
            | Holds::Points(range)
            | Holds::Quaternion(range)
            | Holds::Quaternions(range)
            | Holds::ChoiceOrNumber(_, range) => range,
            _ => Range::FINITE,
        }
    }

    /// "write for example `rate_hz = 125`"
    pub(super) fn write_example(&self) -> String {
        match self.holds {
            Holds::Table | Holds::Tables => {
                format!("write `{}` on a line of its own", self.example)
            }
            _ => format!("write for example `{} = {}`", self.name, self.example),
        }
    }
}

/// What a key may hold.
#[derive(Clone, Copy, Debug)]
pub(super) enum Holds {
    /// A line of text.
    Text,
    /// Name of a task: `[A-Za-z0-9_./-]+`.
    TaskName,
    /// Name of a known robot.
    Robot,
    /// Name of a task type.
    TaskType,
    /// A number.
    Number(Range),
    /// A number for each joint of the robot.
    JointNumbers(Range),
    /// One number for all joints of the robot, or one for each.
    NumberOrJointNumbers(Range),
    /// For each joint of the robot two numbers, the lesser one first, or none.
    JointPairs(Range),
    /// Three numbers.
    Vector(Range),
    /// One or more points of three numbers.
    Points(Range),
    /// Four numbers.
    Quaternion(Range),
    /// One or more lists of four numbers.
    Quaternions(Range),
    /// 1-based number of a joint, or its name.
    Joint,
    /// Some joints, each by its number or its name.
    Joints,
    /// Name of a link of the robot.
    Link,
    /// One of a fixed list of names, each with one line for people.
    Choice(fn() -> Vec<(&'static str, &'static str)>),
    /// One of a fixed list of names, or a number.
    ChoiceOrNumber(fn() -> Vec<(&'static str, &'static str)>, Range),
    /// A name, or a list of one or more.
    NameOrNames,
    /// Two different names.
    TwoNames,
    /// Groups of task names.
    NameGroups,
    /// A table of its own, `[name]`.
    Table,
    /// A list of tables, `[[name]]`.
    Tables,
}

impl Holds {
    /// One of the values of a [`Choice`].
    pub(super) const fn choice<T: Choice>() -> Self {
        Self::Choice(named::<T>)
    }

    /// One of the values of a [`Choice`], or a number.
    pub(super) const fn choice_or_number<T: Choice>(range: Range) -> Self {
        Self::ChoiceOrNumber(named::<T>, range)
    }

    /// For "expected ..., found ...".
    pub(super) fn expected(&self) -> &'static str {
        match self {
            Self::Text
            | Self::TaskName
            | Self::Robot
            | Self::TaskType
            | Self::Link
            | Self::Choice(_) => "text in quotes",
            Self::Number(_) => "a number",
            Self::JointNumbers(_) => "a list of numbers, one for each joint",
            Self::NumberOrJointNumbers(_) => "a number, or a list of numbers, one for each joint",
            Self::JointPairs(_) => "a list of pairs of numbers, one for each joint",
            Self::Vector(_) => "a list of three numbers",
            Self::Points(_) => "a list of points, each of three numbers",
            Self::Quaternion(_) => "a list of four numbers",
            Self::Quaternions(_) => "a list of lists, each of four numbers",
            Self::Joint => "the number of a joint or its name",
            Self::Joints => "a list of joints, each by its number or its name",
            Self::ChoiceOrNumber(..) => "text in quotes, or a number",
            Self::NameOrNames => "text in quotes, or a list of it",
            Self::TwoNames => "a list of two names",
            Self::NameGroups => "a list of groups, each a list of task names",
            Self::Table => "a table",
            Self::Tables => "a list of tables",
        }
    }
}

/// The names of the values of a [`Choice`], each with one line for people.
fn named<T: Choice>() -> Vec<(&'static str, &'static str)> {
    let values = T::ALL.iter();
    values
        .map(|(value, about)| (value.name(), *about))
        .collect()
}

/// Which numbers are allowed; NaN and the infinities never are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Range {
    /// Least allowed value, or the value that must be exceeded.
    pub(super) least: f64,
    /// `least` itself is not allowed.
    pub(super) open: bool,
    /// Greatest allowed value.
    pub(super) most: f64,
}

impl Range {
    /// Any number within reason: a kilometre or a turn is far below it, and sums and squares of
    /// what is below it are exact enough.
    pub(super) const SANE: Self = Self::within(1e6);

    /// Any finite number.
    pub(super) const FINITE: Self = Self::within(f64::MAX);

    /// Numbers of at most this size.
    pub(super) const fn within(most: f64) -> Self {
        Self::between(-most, most)
    }

    /// Numbers from `least` to `most`.
    pub(super) const fn between(least: f64, most: f64) -> Self {
        Self {
            least,
            open: false,
            most,
        }
    }

    /// Numbers above zero, up to `most`.
    pub(super) const fn positive(most: f64) -> Self {
        Self {
            least: 0.0,
            open: true,
            most,
        }
    }

    /// Whether a number is allowed.
    pub(super) fn contains(&self, x: f64) -> bool {
        let low_enough = x <= self.most;
        let high_enough = if self.open {
            x > self.least
        } else {
            x >= self.least
        };
        low_enough && high_enough
    }

    /// For "allowed: ...".
    pub(super) fn describe(&self, unit: &str) -> String {
        let unit = if unit.is_empty() {
            String::new()
        } else {
            format!(" {unit}")
        };
        if *self == Self::FINITE {
            "any finite number".to_owned()
        } else if self.open {
            format!("more than {}, at most {}{unit}", self.least, self.most)
        } else {
            format!("from {} to {}{unit}", self.least, self.most)
        }
    }
}
