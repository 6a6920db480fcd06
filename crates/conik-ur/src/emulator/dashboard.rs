//! The dashboard: one line in, one line out, worded as clients match it.

use super::config::Series;
use super::controller::{Controller, Safety};
use super::faults;
use super::power::Power;
use super::running::Running;
use super::world::World;

/// What it says first.
pub(super) const GREETING: &str = "Connected: Universal Robots Dashboard Server\n";

/// What it says last.
pub(super) const FAREWELL: &str = "Disconnected";

/// Orders without an effect whose answers repeat what they name.
const NAMED: [(&str, &str); 2] = [
    ("load installation ", "Loading installation"),
    ("setuserrole ", "Setting user role"),
];

/// The answer to one line.
pub(super) fn answer(world: &mut World, line: &str) -> String {
    let words = line.split_whitespace().collect::<Vec<_>>().join(" ");
    let lower = words.to_ascii_lowercase();
    if let Some(fault) = lower.strip_prefix("emulator ") {
        return match faults::parse(fault) {
            Ok(parsed) => {
                world.strike(parsed);
                format!("Emulator: {fault}")
            }
            Err(error) => format!("Emulator: {error}"),
        };
    }
    // Names keep their case.
    let rest = |order: &str| words.get(order.len()..).unwrap_or_default().to_owned();
    let controller = &mut world.controller;
    for (order, said) in NAMED {
        if lower.starts_with(order) {
            return format!("{said}: {}", rest(order));
        }
    }
    if lower.starts_with("load ") {
        return load(controller, rest("load "));
    }
    if lower.starts_with("set operational mode ") {
        let mode = rest("set operational mode ").to_ascii_uppercase();
        return format!("Operational mode {mode} is set");
    }
    state(controller, &lower)
        .or_else(|| command(controller, &lower))
        .unwrap_or_else(|| format!("could not understand: '{words}'"))
}

/// Programs live in the pendant: any name of one will do while none runs.
fn load(controller: &mut Controller, name: String) -> String {
    if !name.to_ascii_lowercase().ends_with(".urp") {
        return format!("File not found: {name}");
    }
    if controller.running.is_some() || is_in_local_control(controller) {
        return format!("Error while loading program: {name}");
    }
    let line = format!("Loading program: {name}");
    controller.note(&line);
    controller.loaded = name;
    line
}

/// An e-Series takes orders from afar in remote control only.
fn is_in_local_control(controller: &Controller) -> bool {
    controller.series == Series::E && !controller.remote_control
}

/// A program's name without its folder.
fn file_name(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}

/// Answers to questions.
fn state(controller: &Controller, line: &str) -> Option<String> {
    let mode = match controller.power {
        Power::Off => "POWER_OFF",
        Power::Idle => "IDLE",
        Power::Running => "RUNNING",
    };
    let safety = match controller.safety {
        Safety::Normal => "NORMAL",
        Safety::ProtectiveStop => "PROTECTIVE_STOP",
        Safety::EmergencyStop => "ROBOT_EMERGENCY_STOP",
    };
    let program = match (&controller.running, controller.paused) {
        (None, _) => "STOPPED",
        (Some(_), true) => "PAUSED",
        (Some(_), false) => "PLAYING",
    };
    let name = controller
        .running
        .as_ref()
        .map_or(file_name(&controller.loaded), Running::name);
    let name = if name.is_empty() { "<unnamed>" } else { name };
    Some(match line {
        "robotmode" => format!("Robotmode: {mode}"),
        "safetymode" => format!("Safetymode: {safety}"),
        "safetystatus" => format!("Safetystatus: {safety}"),
        "running" => format!("Program running: {}", program == "PLAYING"),
        "programstate" => format!("{program} {name}"),
        "get loaded program" if controller.loaded.is_empty() => "No program loaded".to_owned(),
        "get loaded program" => format!("Loaded program: {}", controller.loaded),
        "isprogramsaved" => format!("true {name}"),
        "polyscopeversion" => {
            let version = controller.series.version();
            format!("URSoftware {version} (Jan 01 2024)")
        }
        "version" => controller.series.version().to_string(),
        "is in remote control" => match controller.series {
            Series::E => controller.remote_control.to_string(),
            Series::Cb3 => return None,
        },
        "getuserrole" => "PROGRAMMER".to_owned(),
        "get serial number" => "20240000001".to_owned(),
        "get robot model" => controller.facts.model_name(),
        "get operational mode" => "NONE".to_owned(),
        _ => return None,
    })
}

/// Lets a paused program go on, or starts the one that is loaded.
fn play(controller: &mut Controller) -> bool {
    if controller.why_not_ready().is_some() {
        return false;
    }
    match &controller.running {
        Some(_) if controller.paused => {
            controller.paused = false;
            controller.note("program goes on");
            true
        }
        Some(_) => false,
        None if controller.loaded.is_empty() => false,
        None => {
            let name = file_name(&controller.loaded).to_owned();
            let line = format!("program {name} started; it moves nothing");
            controller.begin(Running::Pendant(name), &line);
            true
        }
    }
}

/// What only a controller in remote control does.
const ORDERS: [&str; 8] = [
    "power on",
    "power off",
    "brake release",
    "play",
    "pause",
    "stop",
    "unlock protective stop",
    "restart safety",
];

/// Commands and their answers.
fn command(controller: &mut Controller, line: &str) -> Option<String> {
    let refused = || Some(format!("Failed to execute: {line}"));
    if ORDERS.contains(&line) && is_in_local_control(controller) {
        return refused();
    }
    let said = match line {
        "power on" => {
            if !controller.power_on() {
                return refused();
            }
            "Powering on"
        }
        "power off" => {
            controller.power_off();
            "Powering off"
        }
        "brake release" => {
            if !controller.release_brakes() {
                return refused();
            }
            "Brake releasing"
        }
        "play" => {
            if !play(controller) {
                return refused();
            }
            "Starting program"
        }
        "pause" => {
            if controller.running.is_none() || controller.paused {
                return refused();
            }
            controller.paused = true;
            controller.note("program paused");
            "Pausing program"
        }
        "stop" => {
            if controller.running.is_some() {
                controller.end_program("program stopped at the dashboard");
            }
            "Stopped"
        }
        "unlock protective stop" => match controller.unlock_protective_stop() {
            Ok(()) => "Protective stop releasing",
            Err(left) => {
                return Some(format!(
                    "Cannot unlock protective stop until 5s after occurrence. Always inspect \
                     cause of protective stop before unlocking ({left:.1} s left)"
                ));
            }
        },
        "close popup" => "closing popup",
        "close safety popup" => "closing safety popup",
        "restart safety" => {
            controller.safety = Safety::Normal;
            controller.power_off();
            "Restarting safety"
        }
        "clear operational mode" => {
            "No longer controlling the operational mode. Current operational mode: 'NONE'."
        }
        _ if line.starts_with("popup ") => "showing popup",
        _ if line.starts_with("addtolog ") => "Added log message",
        _ if line.starts_with("savelog") => "Log saved to disk",
        "quit" => FAREWELL,
        "shutdown" => "Shutting down",
        _ => return None,
    };
    Some(said.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emulator::{EmulatorConfig, Pace};
    use conik::JointVec;

    fn world(series: Series, remote_control: bool) -> World {
        let config = EmulatorConfig {
            remote_control,
            ..EmulatorConfig::new(series, JointVec::zeros(6))
        };
        World::new(Controller::new(&config).unwrap())
    }

    /// Asks line by line; an answer that ends in `*` is only the beginning.
    fn check(world: &mut World, table: &[(&str, &str)]) {
        for (line, expected) in table {
            let said = answer(world, line);
            let fits = match expected.strip_suffix('*') {
                Some(beginning) => said.starts_with(beginning),
                None => said == *expected,
            };
            assert!(fits, "'{line}' is answered with '{said}', not '{expected}'");
        }
    }

    #[test]
    fn questions_are_answered_in_the_words_that_clients_match() {
        let mut world = world(Series::E, true);
        check(
            &mut world,
            &[
                ("running", "Program running: false"),
                ("robotmode", "Robotmode: RUNNING"),
                ("  SafetyMode ", "Safetymode: NORMAL"),
                ("safetystatus", "Safetystatus: NORMAL"),
                ("programState", "STOPPED <unnamed>"),
                ("get loaded program", "No program loaded"),
                ("isProgramSaved", "true <unnamed>"),
                ("PolyscopeVersion", "URSoftware 5.13.0.0 (*"),
                ("version", "5.13.0.0"),
                ("is in remote control", "true"),
                ("get serial number", "20*"),
                ("get robot model", "UR*"),
                ("get operational mode", "NONE"),
                ("getUserRole", "PROGRAMMER"),
                ("dance", "could not understand: 'dance'"),
                ("", "could not understand: ''"),
            ],
        );
    }

    #[test]
    fn orders_are_answered_in_the_words_that_clients_match() {
        let mut world = world(Series::E, true);
        check(
            &mut world,
            &[
                ("close popup", "closing popup"),
                ("close safety popup", "closing safety popup"),
                ("popup Hello", "showing popup"),
                ("addToLog Hello", "Added log message"),
                ("saveLog", "Log saved to disk"),
                (
                    "load installation A.installation",
                    "Loading installation: A.installation",
                ),
                ("setUserRole operator", "Setting user role: operator"),
                (
                    "set operational mode manual",
                    "Operational mode MANUAL is set",
                ),
                (
                    "clear operational mode",
                    "No longer controlling the operational mode.*",
                ),
                ("power off", "Powering off"),
                ("robotmode", "Robotmode: POWER_OFF"),
                ("power on", "Powering on"),
                ("robotmode", "Robotmode: IDLE"),
                ("brake release", "Brake releasing"),
                ("robotmode", "Robotmode: RUNNING"),
                ("shutdown", "Shutting down"),
                ("quit", "Disconnected"),
            ],
        );
    }

    #[test]
    fn a_loaded_program_is_played_paused_and_stopped() {
        let mut world = world(Series::Cb3, true);
        check(
            &mut world,
            &[
                ("play", "Failed to execute: play"),
                ("pause", "Failed to execute: pause"),
                ("stop", "Stopped"),
                ("load Wait", "File not found: Wait"),
                (
                    "load /programs/Wait.urp",
                    "Loading program: /programs/Wait.urp",
                ),
                ("get loaded program", "Loaded program: /programs/Wait.urp"),
                ("programState", "STOPPED Wait.urp"),
                ("isProgramSaved", "true Wait.urp"),
                ("play", "Starting program"),
                ("play", "Failed to execute: play"),
                ("programState", "PLAYING Wait.urp"),
                ("running", "Program running: true"),
                ("load other.urp", "Error while loading program: other.urp"),
                ("pause", "Pausing program"),
                ("pause", "Failed to execute: pause"),
                ("programState", "PAUSED Wait.urp"),
                ("running", "Program running: false"),
                ("play", "Starting program"),
                ("programState", "PLAYING Wait.urp"),
                ("stop", "Stopped"),
                ("programState", "STOPPED Wait.urp"),
                ("power off", "Powering off"),
                ("play", "Failed to execute: play"),
                ("is in remote control", "could not understand:*"),
            ],
        );
    }

    #[test]
    fn stops_are_named_and_lifted_when_they_may_be() {
        let mut world = world(Series::E, true);
        check(
            &mut world,
            &[
                ("load a.urp", "Loading program: a.urp"),
                ("play", "Starting program"),
                ("emulator protective stop", "Emulator: protective stop"),
                ("safetymode", "Safetymode: PROTECTIVE_STOP"),
                ("safetystatus", "Safetystatus: PROTECTIVE_STOP"),
                ("programState", "STOPPED a.urp"),
                ("play", "Failed to execute: play"),
                (
                    "unlock protective stop",
                    "Cannot unlock protective stop until 5s after occurrence.*",
                ),
            ],
        );
        for _ in 0..2501 {
            world.cycle(Pace::WallTime);
        }
        check(
            &mut world,
            &[
                ("unlock protective stop", "Protective stop releasing"),
                ("safetymode", "Safetymode: NORMAL"),
                ("programState", "STOPPED a.urp"),
                ("emulator emergency stop", "Emulator: emergency stop"),
                ("safetymode", "Safetymode: ROBOT_EMERGENCY_STOP"),
                ("power on", "Failed to execute: power on"),
                ("brake release", "Failed to execute: brake release"),
                ("restart safety", "Restarting safety"),
                ("safetymode", "Safetymode: NORMAL"),
                ("robotmode", "Robotmode: POWER_OFF"),
                ("emulator dance", "Emulator: unknown fault*"),
            ],
        );
    }

    #[test]
    fn in_local_control_orders_are_refused_and_questions_answered() {
        let mut world = world(Series::E, false);
        for order in ORDERS {
            let refusal = format!("Failed to execute: {order}");
            check(&mut world, &[(order, &refusal)]);
        }
        check(
            &mut world,
            &[
                ("is in remote control", "false"),
                ("robotmode", "Robotmode: RUNNING"),
                ("load a.urp", "Error while loading program: a.urp"),
            ],
        );
    }
}
