//! Why a tick came out as it did: for each active set, each set let go, each limit that bound.
//!
//! A reason is a few numbers, so that the control loop can keep all of a tick's without allocating.
//! [`Reason::in_words`] says it to people, [`Reason::code`] to a log.

use core::fmt;

use crate::landing::Outside;
use crate::limits::{Exceeded, Shortened};
use crate::stack::Stack;
use crate::task_id::TaskId;

/// One reason for what a tick decided.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reason {
    /// A set is active. Let go, it would be `crossing` further out at the end of the period
    /// [task's unit] than its border, or than where it now is outside of it; 0 if it is only on its
    /// border, and nothing moves it away from there.
    Holds {
        /// The set-based task.
        task: TaskId,
        /// Whether the upper bound holds it.
        is_upper: bool,
        /// How far it would go.
        crossing: f64,
        /// Rate at which it moves inward all the same, to first order [task's unit/s].
        rate: f64,
    },
    /// A set is active though it is strictly inside, at this distance from its border [task's unit]:
    /// rule `Paper` freezes it to stop another one.
    HoldsInside {
        /// The set-based task.
        task: TaskId,
        /// How far inside.
        inside: f64,
    },
    /// A set that was active in the last tick is not any more: the velocity of this tick takes it
    /// inward at this rate [task's unit/s].
    LetsGo {
        /// The set-based task.
        task: TaskId,
        /// Rate into the set; 0 if others hold it on its border.
        inward: f64,
    },
    /// A level has fewer directions than its task has components, beside the rows above it. What it
    /// asks for in the others is damped.
    LosesRank {
        /// The task.
        task: TaskId,
        /// Directions lost, or about to be.
        directions: usize,
    },
    /// The whole velocity, or with rule `Cone` and limited accelerations that of a level, was shortened to a
    /// joint's speed limit.
    SpeedLimit(Shortened),
    /// A change of velocity was shortened to a joint's acceleration limit: with rule `Cone` that of a level,
    /// else the whole.
    AccelerationLimit(Shortened),
    /// A joint accelerated beyond its limit for the sake of a set.
    AccelerationExceeded(Exceeded),
    /// The velocity was corrected so many times before it landed inside every set.
    Corrected(usize),
    /// The velocity was halved so many times before it landed inside every set.
    Halved(usize),
    /// The tick set out with this share of the velocity, because one before had to stand still.
    Cautious(f64),
    /// No velocity was found that lands inside every set: the arm stands still for this period.
    StandsStill,
    /// A set that moves, or whose bound does, cannot be kept at the end of this period.
    GoesOutside(Outside),
    /// The exclusions leave no mode that keeps every set.
    NoMode,
    /// The quadratic programs of this tick were cut off at [`MAX_PIVOTS`](crate::MAX_PIVOTS).
    OutOfPivots,
}

impl Reason {
    /// The task that it is about.
    pub fn task(&self) -> Option<TaskId> {
        match *self {
            Self::Holds { task, .. }
            | Self::HoldsInside { task, .. }
            | Self::LetsGo { task, .. }
            | Self::LosesRank { task, .. }
            | Self::GoesOutside(Outside { task, .. }) => Some(task),
            _ => None,
        }
    }

    /// The same reason, with its task, if it is about one, under the number that it has elsewhere.
    #[must_use]
    pub fn renumbered(mut self, number: impl FnOnce(TaskId) -> TaskId) -> Self {
        match &mut self {
            Self::Holds { task, .. }
            | Self::HoldsInside { task, .. }
            | Self::LetsGo { task, .. }
            | Self::LosesRank { task, .. }
            | Self::GoesOutside(Outside { task, .. }) => *task = number(*task),
            _ => {}
        }
        self
    }

    /// The joint that it is about, counted from 0.
    pub fn joint(&self) -> Option<usize> {
        match *self {
            Self::SpeedLimit(Shortened { joint, .. })
            | Self::AccelerationLimit(Shortened { joint, .. })
            | Self::AccelerationExceeded(Exceeded { joint, .. }) => Some(joint),
            _ => None,
        }
    }

    /// A word for logs: `hold`, `hold-inside`, `free`, `rank`, `speed`, `acceleration`,
    /// `acceleration-exceeded`, `corrected`, `halved`, `cautious`, `still`, `outside`, `no-mode`, `pivots`.
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Holds { .. } => "hold",
            Self::HoldsInside { .. } => "hold-inside",
            Self::LetsGo { .. } => "free",
            Self::LosesRank { .. } => "rank",
            Self::SpeedLimit(_) => "speed",
            Self::AccelerationLimit(_) => "acceleration",
            Self::AccelerationExceeded(_) => "acceleration-exceeded",
            Self::Corrected(_) => "corrected",
            Self::Halved(_) => "halved",
            Self::Cautious(_) => "cautious",
            Self::StandsStill => "still",
            Self::GoesOutside(_) => "outside",
            Self::NoMode => "no-mode",
            Self::OutOfPivots => "pivots",
        }
    }

    /// The word and what it is about: `hold:obstacle_a`, `speed:q3` (joints counted from 1).
    pub fn code<'a>(&'a self, stack: &'a Stack) -> impl fmt::Display + 'a {
        Code {
            reason: self,
            stack,
        }
    }

    /// A sentence.
    pub fn in_words<'a>(&'a self, stack: &'a Stack) -> impl fmt::Display + 'a {
        Words {
            reason: self,
            stack,
        }
    }
}

struct Code<'a> {
    reason: &'a Reason,
    stack: &'a Stack,
}

impl fmt::Display for Code<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.reason.word())?;
        if let Some(task) = self.reason.task() {
            write!(f, ":{}", self.stack[task].name())?;
        }
        if let Some(joint) = self.reason.joint() {
            write!(f, ":q{}", joint + 1)?;
        }
        Ok(())
    }
}

struct Words<'a> {
    reason: &'a Reason,
    stack: &'a Stack,
}

impl Words<'_> {
    /// A number with the unit of its task.
    fn amount(&self, task: TaskId, amount: f64) -> impl fmt::Display {
        let unit = self.stack[task].task().unit();
        Amount {
            amount,
            unit: if unit == "-" { "" } else { unit },
        }
    }
}

/// Six significant digits: what people read.
struct Amount {
    amount: f64,
    unit: &'static str,
}

impl fmt::Display for Amount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.amount != 0.0 && self.amount.abs() < 1e-3 {
            write!(f, "{:.3e}", self.amount)?;
        } else {
            write!(f, "{:.6}", self.amount)?;
        }
        if self.unit.is_empty() {
            Ok(())
        } else {
            write!(f, " {}", self.unit)
        }
    }
}

impl fmt::Display for Words<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self
            .reason
            .task()
            .map_or("", |task| self.stack[task].name());
        match *self.reason {
            Reason::Holds {
                task,
                is_upper,
                crossing,
                ..
            } => {
                let side = if is_upper { "greatest" } else { "least" };
                if crossing > 0.0 {
                    let crossing = self.amount(task, crossing);
                    write!(f, "`{name}` is held at its {side} value: let go, it would be {crossing} further out at the end of the period")
                } else {
                    write!(f, "`{name}` is held at its {side} value, from which nothing moves it away")
                }
            }
            Reason::HoldsInside { task, inside } => {
                let inside = self.amount(task, inside);
                write!(f, "`{name}` is frozen {inside} inside its set: the rule found that this stops another set from being left")
            }
            Reason::LetsGo { task, inward } if inward > 0.0 => {
                let inward = self.amount(task, inward);
                write!(f, "`{name}` is let go: it moves inward by itself at {inward}/s")
            }
            Reason::LetsGo { .. } => {
                write!(f, "`{name}` is let go: what else is held keeps it")
            }
            Reason::LosesRank { directions, .. } => {
                let s = if directions == 1 { "" } else { "s" };
                write!(f, "`{name}` has lost, or is about to lose, {directions} direction{s} of its task, to a singularity or to what stands above it; there it is damped")
            }
            Reason::SpeedLimit(Shortened { joint, factor }) => {
                write!(f, "the whole velocity is shortened to {:.1} % for the speed limit of joint {}", 100.0 * factor, joint + 1)
            }
            Reason::AccelerationLimit(Shortened { joint, factor }) => {
                write!(f, "a change of velocity is shortened to {:.1} % for the acceleration limit of joint {}", 100.0 * factor, joint + 1)
            }
            Reason::AccelerationExceeded(Exceeded { joint, times }) => {
                write!(f, "joint {} accelerates at {times:.2} times its limit, because a set could not be kept otherwise", joint + 1)
            }
            Reason::Corrected(times) => {
                write!(f, "the velocity was corrected {times} time{} so that the next sample is inside every set", if times == 1 { "" } else { "s" })
            }
            Reason::Halved(times) => {
                write!(f, "the velocity was halved {times} time{}, because corrections alone did not land inside every set", if times == 1 { "" } else { "s" })
            }
            Reason::Cautious(share) => write!(
                f,
                "the velocity is shortened to {:.3} %, because a tick before had to stand still",
                100.0 * share
            ),
            Reason::StandsStill => f.write_str(
                "the arm stands still for this period: no velocity was found that lands inside every set",
            ),
            Reason::GoesOutside(Outside { task, by }) => {
                let by = self.amount(task, by);
                write!(f, "`{name}` will be outside by {by} at the end of the period: no velocity within the limits keeps every set")
            }
            Reason::NoMode => {
                f.write_str("the exclusions leave no mode that keeps every set: the arm stands still")
            }
            Reason::OutOfPivots => f.write_str(
                "the quadratic programs of this tick were cut off at their bound on pivots",
            ),
        }
    }
}
