//! Watchdogs of a program on inputs: `rtde_set_watchdog`.

use super::fields::InputField;
use super::registers::Registers;
use crate::urscript::WatchdogAction;

/// The watchdogs of the running program, one an input.
#[derive(Debug, Default)]
pub(super) struct Watchdogs(Vec<Watchdog>);

#[derive(Debug)]
struct Watchdog {
    input: InputField,
    name: String,
    /// Control cycles that may pass without a write.
    allowed: f64,
    action: WatchdogAction,
}

/// What a watchdog asks for.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Bite {
    pub(super) action: WatchdogAction,
    /// The input that stayed away.
    pub(super) name: String,
}

impl Watchdogs {
    /// Sets the watchdog of an input; `false` if there is no such input.
    pub(super) fn set(&mut self, name: &str, allowed: f64, action: WatchdogAction) -> bool {
        let Some(input) = InputField::from_name(name) else {
            return false;
        };
        self.0.retain(|known| known.input != input);
        if action != WatchdogAction::Ignore {
            self.0.push(Watchdog {
                input,
                name: name.to_owned(),
                allowed,
                action,
            });
        }
        true
    }

    /// Takes all away, as the end of a program does.
    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    /// The first that has waited too long in this cycle. Who never wrote, or only long before the
    /// watchdog was set, has waited since then.
    pub(super) fn bite(&self, registers: &Registers, cycle: u64) -> Option<Bite> {
        let bites = |watchdog: &&Watchdog| {
            let silent = cycle.saturating_sub(registers.written_at(watchdog.input));
            silent as f64 > watchdog.allowed
        };
        self.0.iter().find(bites).map(|watchdog| Bite {
            action: watchdog.action,
            name: watchdog.name.clone(),
        })
    }
}
