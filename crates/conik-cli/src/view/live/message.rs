//! The messages of the protocol.

use conik_sim::live::{Change, Gliding};
use conik_sim::summary::Outcome;
use serde::{Deserialize, Serialize};

use super::allowed::Act;
use crate::view::{PROTOCOL, Scene, Ticks};

/// What a client asks.
#[derive(Debug, Deserialize)]
pub(super) struct Request {
    /// Repeated in the answer.
    pub(super) id: f64,
    #[serde(flatten)]
    pub(super) what: Asked,
}

/// What it asks for.
#[derive(Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(super) enum Asked {
    Pause,
    Resume,
    Step { ticks: u32 },
    Speed { factor: f64 },
    Restart,
    Reset,
    Save,
    Change { changes: Vec<Change> },
}

/// What a client is told.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(super) enum Told {
    Hello {
        protocol: u32,
        program: String,
    },
    State(State),
    Answer {
        id: f64,
        #[serde(skip_serializing_if = "Option::is_none")]
        revision: Option<u64>,
        #[serde(skip_serializing_if = "Option::is_none")]
        error: Option<String>,
    },
    Text {
        id: f64,
        name: String,
        toml: String,
    },
}

impl Told {
    pub(super) fn hello() -> Self {
        Self::Hello {
            protocol: PROTOCOL,
            program: concat!("conik ", env!("CARGO_PKG_VERSION")).to_owned(),
        }
    }
}

/// How the run stands.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct State {
    pub(super) running: Stage,
    pub(super) t_s: f64,
    pub(super) speed: f64,
    pub(super) allowed: Vec<Act>,
    pub(super) refusal: Option<String>,
    pub(super) step_time_us: Option<conik_sim::summary::StepTime>,
    pub(super) deadline_misses: u64,
    pub(super) outcome: Option<Outcome>,
    pub(super) viewers: usize,
    pub(super) revision: u64,
    pub(super) edited: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Stage {
    Waiting,
    Running,
    Paused,
    Ended,
}

/// The scene as it is now.
#[derive(Debug, Serialize)]
pub(super) struct LiveScene<'a> {
    #[serde(flatten)]
    pub(super) scene: &'a Scene,
    pub(super) name: &'a str,
    pub(super) revision: u64,
    pub(super) from_s: f64,
}

/// Rows of what happened.
#[derive(Debug, Serialize)]
pub(super) struct LiveTicks {
    #[serde(flatten)]
    pub(super) ticks: Ticks,
    pub(super) reset: bool,
    pub(super) gliding: Vec<Glide>,
}

/// Something on its way to where the scene has it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Glide {
    pub(super) name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    away_m: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    away_rad: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    away_min: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    away_max: Option<f64>,
}

impl Glide {
    pub(super) fn of(name: &str, gliding: &Gliding) -> Self {
        let away = &gliding.away;
        let vector = |it: conik::Vec3| (it.norm() > 0.0).then(|| it.to_array());
        let bound = |it: f64| (it != 0.0).then_some(it);
        Self {
            name: name.to_owned(),
            away_m: vector(away.point_m),
            away_rad: vector(away.turn_rad),
            away_min: bound(away.min),
            away_max: bound(away.max),
        }
    }
}

/// JSON of what has nothing that JSON does not have.
pub(super) fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default()
}
