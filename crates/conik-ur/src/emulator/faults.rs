//! Faults that can be brought about: by a flag, or by `emulator FAULT` at the dashboard.

use super::config::{Fault, Injection};
use super::fields::InputField;

/// Every fault, as it is asked for.
pub const GRAMMAR: &str = "protective stop | emergency stop | program stop | pause | release | \
    restart clock | clock jump SECONDS | drop PROBABILITY | delay SECONDS | jitter SECONDS | \
    freeze SECONDS | reset | half-open | register in use NAME | bad packages COUNT | \
    one-byte on | one-byte off | after SECONDS FAULT";

/// The longest that a fault may be put off [s].
const LATEST_S: f64 = 86_400.0;

/// The fault that a line asks for.
pub fn parse(line: &str) -> Result<Fault, String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    match words.as_slice() {
        ["after", time, fault @ ..] => {
            let fault = Box::new(of_words(fault)?);
            Ok(Fault::After(number(time, LATEST_S)?, fault))
        }
        words => of_words(words),
    }
}

fn number(word: &str, most: f64) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(value) if (0.0..=most).contains(&value) => Ok(value),
        _ => Err(format!("'{word}' is not a number from 0 to {most}")),
    }
}

fn of_words(words: &[&str]) -> Result<Fault, String> {
    Ok(match words {
        ["protective", "stop"] => Fault::Event(Injection::ProtectiveStop),
        ["emergency", "stop"] => Fault::Event(Injection::EmergencyStop),
        ["program", "stop"] => Fault::Event(Injection::StopProgram),
        ["pause"] => Fault::Event(Injection::PauseProgram),
        ["release"] => Fault::Event(Injection::Release),
        ["restart", "clock"] => Fault::Event(Injection::RestartClock),
        ["clock", "jump", time] => Fault::ClockJump(number(time, 1e6)?),
        ["drop", probability] => Fault::Drop(number(probability, 1.0)?),
        ["delay", time] => Fault::Delay(number(time, 10.0)?),
        ["jitter", time] => Fault::Jitter(number(time, 10.0)?),
        ["freeze", time] => Fault::Freeze(number(time, 1e6)?),
        ["reset"] => Fault::Reset,
        ["half-open"] => Fault::HalfOpen,
        ["register", "in", "use", name] if InputField::from_name(name).is_none() => {
            return Err(format!(
                "there is no input '{name}'; there are input_int_register_0 to 47, for instance"
            ));
        }
        ["register", "in", "use", name] => Fault::RegisterInUse((*name).to_owned()),
        ["bad", "packages", count] => Fault::BadPackages(
            count
                .parse()
                .map_err(|_| format!("'{count}' is not a whole number"))?,
        ),
        ["one-byte", "on"] => Fault::OneByte(true),
        ["one-byte", "off"] => Fault::OneByte(false),
        _ => {
            let line = words.join(" ");
            return Err(format!("unknown fault '{line}'; there are: {GRAMMAR}"));
        }
    })
}

/// What happens to packages on their way out.
#[derive(Clone, Debug)]
pub(super) struct Network {
    pub(super) drop: f64,
    /// Cycles that each package waits, and the most that chance adds.
    pub(super) delay: u64,
    pub(super) jitter: u64,
    /// Nothing goes out before this cycle.
    pub(super) frozen_until: u64,
    pub(super) bad_packages: u32,
    random: u64,
}

impl Network {
    pub(super) fn good() -> Self {
        Self {
            drop: 0.0,
            delay: 0,
            jitter: 0,
            frozen_until: 0,
            bad_packages: 0,
            random: 0x9E37_79B9_7F4A_7C15,
        }
    }

    /// A number from 0 to 1, the same sequence in every run (Marsaglia's xorshift).
    fn chance(&mut self) -> f64 {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 7;
        self.random ^= self.random << 17;
        (self.random >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// When a package of this cycle goes out; `None` if it never does.
    pub(super) fn departure(&mut self, cycle: u64) -> Option<u64> {
        if cycle < self.frozen_until || self.chance() < self.drop {
            return None;
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // From 0 to the jitter.
        let added = (self.chance() * (self.jitter as f64 + 1.0)) as u64;
        Some(cycle + self.delay + added)
    }

    /// Spoils a package while bad ones are wanted: its last byte is missing.
    pub(super) fn spoil(&mut self, package: &mut Vec<u8>) {
        if self.bad_packages == 0 || package.len() < 4 {
            return;
        }
        self.bad_packages -= 1;
        package.pop();
        let size = u16::try_from(package.len())
            .unwrap_or(u16::MAX)
            .to_be_bytes();
        package[..2].copy_from_slice(&size);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fault_of_the_grammar_is_understood_and_no_other() {
        for line in GRAMMAR.split('|') {
            let line = line
                .replace("SECONDS", "0.5")
                .replace("PROBABILITY", "0.5")
                .replace("NAME", "input_int_register_0")
                .replace("COUNT", "3")
                .replace("FAULT", "emergency stop");
            assert!(parse(&line).is_ok(), "{line}");
        }
        for line in [
            "",
            "drop",
            "drop 2",
            "drop nan",
            "after 1",
            "after -1 reset",
            "after 1 after 1 reset",
            "delay -1",
            "bad packages x",
            "register in use output_int_register_0",
            "register in use input_int_register_48",
        ] {
            assert!(parse(line).is_err(), "{line}");
        }
    }

    #[test]
    fn packages_are_dropped_about_as_often_as_asked() {
        let mut network = Network {
            drop: 0.25,
            ..Network::good()
        };
        let sent = (0..4000).filter(|cycle| network.departure(*cycle).is_some());
        let sent = sent.count();
        assert!((2900..3100).contains(&sent), "{sent}");
    }

    #[test]
    fn packages_wait_for_the_delay_and_at_most_for_the_jitter_on_top() {
        let mut network = Network {
            delay: 3,
            jitter: 2,
            ..Network::good()
        };
        let mut waits: Vec<u64> = (0..1000)
            .filter_map(|cycle| network.departure(cycle).map(|departure| departure - cycle))
            .collect();
        waits.sort_unstable();
        waits.dedup();
        assert_eq!(waits, [3, 4, 5]);
    }
}
