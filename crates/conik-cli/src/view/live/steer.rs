//! Does what clients ask of a run.

use conik_sim::live::{Change, GlideSpeed, Helm, Stretch};
use conik_sim::scenario::Scenario;
use conik_sim::summary::ChangeMade;

use super::allowed::{Act, Allowed};
use super::message::{Asked, Request, Told, json};
use super::session::{Arm, Live, Session};
use crate::view::Scene;

/// Ticks that may be asked for at once.
const MOST_TICKS: u32 = 1000;

/// The fastest that a simulated run may go.
const FASTEST: f64 = 10.0;

impl Live {
    /// Does what a client asks; the answer.
    pub(super) fn answer(&self, text: &str) -> String {
        let asked = serde_json::from_str::<Request>(text);
        let Request { id, what } = match asked {
            Ok(request) => request,
            Err(error) => {
                let id = serde_json::from_str::<serde_json::Value>(text);
                let id = id.ok().and_then(|it| it["id"].as_f64());
                return json(&Told::Answer {
                    id: id.unwrap_or(-1.0),
                    revision: None,
                    error: Some(format!("not a message of the protocol: {error}")),
                });
            }
        };
        if let Asked::Save = what {
            return json(&Told::Text {
                id,
                name: format!("{}-edited.toml", self.name),
                toml: self.session().present.to_toml(),
            });
        }
        let done = self.act(what);
        json(&Told::Answer {
            id,
            revision: done.as_ref().ok().copied(),
            error: done.err(),
        })
    }

    /// The number of the newest change, after it was done.
    fn act(&self, what: Asked) -> Result<u64, String> {
        let (has_ended, revision) = {
            let session = self.session();
            (session.outcome.is_some(), session.revision)
        };
        let allowed = Allowed::with(self.arm, has_ended);
        let helm = &self.helm;
        match what {
            Asked::Pause => {
                allowed.check(Act::Pause)?;
                helm.pause();
            }
            Asked::Resume => {
                allowed.check(Act::Pause)?;
                helm.resume();
            }
            Asked::Step { ticks } => {
                allowed.check(Act::Step)?;
                if !(1..=MOST_TICKS).contains(&ticks) {
                    return Err(format!("`ticks` must be 1 to {MOST_TICKS}, not {ticks}"));
                }
                helm.step(ticks);
            }
            Asked::Speed { factor } => {
                allowed.check(Act::Speed)?;
                let fastest = self.fastest();
                if !(factor >= Helm::LEAST_SPEED && factor <= fastest) {
                    let least = Helm::LEAST_SPEED;
                    return Err(format!(
                        "`factor` must be {least} to {fastest} with this arm, not {factor}"
                    ));
                }
                helm.set_speed(factor);
            }
            Asked::Restart => {
                allowed.check(Act::Restart)?;
                helm.restart();
            }
            Asked::Reset => {
                allowed.check(Act::Change)?;
                let known = Known::of(&self.session());
                let original = self.session().original.clone();
                return self.go_by(&known, original, &[], ChangeMade::all_taken_back());
            }
            Asked::Change { changes } => {
                allowed.check(Act::Change)?;
                return self.change(changes);
            }
            // Answered by others.
            Asked::Save => {}
        }
        Ok(revision)
    }

    /// The greatest speed at which the run may go.
    fn fastest(&self) -> f64 {
        match self.arm {
            Arm::Simulated { has_clock: false } => FASTEST,
            _ => 1.0,
        }
    }

    fn change(&self, changes: Vec<Change>) -> Result<u64, String> {
        let known = Known::of(&self.session());
        let changed = known.present.changed(&changes, known.t_s);
        let (scenario, speeds) = changed.map_err(|error| error.to_string())?;
        self.go_by(&known, scenario, &speeds, ChangeMade::of(changes))
    }

    /// Lets the run go by another scenario; the number of that change. What takes long is done while
    /// nobody else waits for the session.
    fn go_by(
        &self,
        known: &Known,
        scenario: Scenario,
        speeds: &[(String, GlideSpeed)],
        made: ChangeMade,
    ) -> Result<u64, String> {
        let stretch = Stretch::next(&known.first, &scenario, speeds);
        let stretch = Box::new(stretch.map_err(|error| error.to_string())?);
        let scene = Scene::live(&scenario, &self.arm_name, true);
        let scene = scene.map_err(|error| error.to_string())?;
        let session = &mut *self.session();
        if (session.revision, session.restarts) != (known.revision, known.restarts) {
            return Err("the run was begun anew meanwhile: ask again".to_owned());
        }
        session.scene = scene;
        session.revision += 1;
        session.from_s = session.t_s;
        self.helm.hand_over(stretch, session.revision);
        session.present = scenario;
        session.made.push((session.revision, made));
        self.send(&session.scene_message(&self.name, false));
        Ok(session.revision)
    }
}

/// What a change starts from.
struct Known {
    first: Scenario,
    present: Scenario,
    t_s: f64,
    revision: u64,
    restarts: u64,
}

impl Known {
    fn of(session: &Session) -> Self {
        Self {
            first: session.first.clone(),
            present: session.present.clone(),
            t_s: session.t_s,
            revision: session.revision,
            restarts: session.restarts,
        }
    }
}
