//! Which arm the controller says it has, and whether it takes programs from afar. RTDE does not tell;
//! the dashboard does.

use super::config::UrConfig;
use super::dashboard::Dashboard;
use super::fault;
use crate::model::ArmFacts;
use conik_sim::arm::ArmError;
use conik_sim::scenario::{Choice, UrModel, UrSeries};

/// What the dashboard says of the controller.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Identity {
    /// The arm's model in the controller's words (`UR5`); `None` where it does not know the
    /// question (before 3.12 and 5.6).
    pub model: Option<String>,
    /// Whether it is in remote control; `None` where it does not know the question (CB3, and
    /// e-Series before 5.6).
    pub in_remote_control: Option<bool>,
}

impl Identity {
    /// Asks the dashboard.
    pub(super) fn ask(config: &UrConfig) -> Result<Self, ArmError> {
        let mut dashboard = Dashboard::connect(config)?;
        let model = dashboard.ask("get robot model")?;
        let is_model = model.to_ascii_uppercase().starts_with("UR");
        Ok(Self {
            model: is_model.then_some(model),
            in_remote_control: remote_control(&mut dashboard)?,
        })
    }

    /// Why this is not the arm to drive, or may not be driven from here.
    pub(super) fn check(&self, config: &UrConfig) -> Result<(), ArmError> {
        if self.in_remote_control == Some(false) {
            return Err(local_control());
        }
        let Some(name) = &self.model else {
            return Ok(());
        };
        let found = UrModel::in_name(name);
        for (wanted, whose) in [
            (config.model, "the scenario's [ur] asks for"),
            (config.robot, "the scenario's robot is"),
        ] {
            if let Some(wanted) = wanted
                && found != Some(wanted)
            {
                let detail = format!(
                    "the arm at {} is a {name}, {whose} a {}: is it the right arm?",
                    config.host,
                    wanted.name().to_ascii_uppercase()
                );
                return Err(ArmError::new(fault::WRONG_ARM, detail));
            }
        }
        Ok(())
    }

    /// Checks what the dashboard says. `say` hears what could not be checked: a controller whose
    /// dashboard does not answer can be driven all the same.
    pub(super) fn ask_and_check(
        config: &UrConfig,
        say: &mut dyn FnMut(&str),
    ) -> Result<Self, ArmError> {
        let identity = match Self::ask(config) {
            Ok(identity) => identity,
            Err(fault) => {
                say(&not_asked(&fault));
                return Ok(Self::default());
            }
        };
        identity.check(config)?;
        if let (None, Some(wanted)) = (&identity.model, config.model.or(config.robot)) {
            say(&format!(
                "the controller at {} does not say which arm it has: make sure that it is a {}",
                config.host,
                wanted.name().to_ascii_uppercase()
            ));
        }
        Ok(identity)
    }

    /// What is known of the arm: of the one that the controller names or else of the one that it is
    /// said to be.
    pub(super) fn arm(&self, config: &UrConfig, series: UrSeries) -> Option<&'static ArmFacts> {
        let named = self.model.as_deref().and_then(UrModel::in_name);
        ArmFacts::of(named.or(config.model).or(config.robot)?, series)
    }
}

/// What to say where the dashboard gave no answer.
pub fn not_asked(fault: &ArmError) -> String {
    format!(
        "the dashboard does not answer, so neither the arm's model nor remote control was checked \
         ({})",
        fault.detail
    )
}

/// An e-Series takes orders from afar in remote control only; a CB3 does not know the question.
pub(super) fn remote_control(dashboard: &mut Dashboard) -> Result<Option<bool>, ArmError> {
    let answer = dashboard.ask("is in remote control")?;
    Ok(match answer.to_ascii_lowercase().as_str() {
        "true" => Some(true),
        "false" => Some(false),
        _ => None,
    })
}

pub(super) fn local_control() -> ArmError {
    let detail = "the controller is in local control: switch it to remote control at the pendant";
    ArmError::new(fault::NOT_REMOTE, detail)
}
