//! What those who watch a run may do.

use serde::Serialize;

use super::session::Arm;

/// Something that may be done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Act {
    Pause,
    Step,
    Restart,
    Speed,
    Change,
}

/// What may be done, and why not all of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Allowed {
    pub(super) acts: Vec<Act>,
    pub(super) refusal: Option<String>,
}

impl Allowed {
    /// With that arm, in a run that has ended or not.
    pub(super) fn with(arm: Arm, has_ended: bool) -> Self {
        if has_ended {
            return Self {
                acts: Vec::new(),
                refusal: Some("the run has ended".to_owned()),
            };
        }
        match arm {
            Arm::Simulated { .. } => Self {
                acts: vec![Act::Pause, Act::Step, Act::Restart, Act::Speed, Act::Change],
                refusal: None,
            },
            Arm::Outside { may_edit: true } => Self {
                acts: vec![Act::Pause, Act::Speed, Act::Change],
                refusal: Some(
                    "this arm is outside of the program: single steps and restarts are for \
                     simulated arms"
                        .to_owned(),
                ),
            },
            Arm::Outside { may_edit: false } => Self {
                acts: Vec::new(),
                refusal: Some(
                    "this may be a real arm: nothing can be changed from here, unless `conik run` \
                     is given --allow-edit"
                        .to_owned(),
                ),
            },
        }
    }

    /// An error in words where something may not be done.
    pub(super) fn check(&self, act: Act) -> Result<(), String> {
        if self.acts.contains(&act) {
            return Ok(());
        }
        Err(self.refusal.clone().unwrap_or_default())
    }
}
