//! The dashboard: one line in, one line out, worded as clients match it.

use super::config::Series;
use super::controller::{Controller, Safety};
use super::faults;
use super::power::Power;
use super::world::World;

/// What it says first.
pub(super) const GREETING: &str = "Connected: Universal Robots Dashboard Server\n";

/// What it says last.
pub(super) const FAREWELL: &str = "Disconnected";

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
    if let Some(name) = lower.strip_prefix("load ") {
        // Programs live in the pendant; any name will do, and none of them moves the arm.
        let name = words[words.len() - name.len()..].to_owned();
        world.controller.loaded.clone_from(&name);
        return format!("Loading program: {name}");
    }
    state(&world.controller, &lower)
        .or_else(|| command(&mut world.controller, &lower))
        .unwrap_or_else(|| format!("could not understand: '{words}'"))
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
        .map_or(controller.loaded.as_str(), |running| running.name());
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
        "get serial number" => "20240000001".to_owned(),
        "get robot model" => "UR5".to_owned(),
        "get operational mode" => "NONE".to_owned(),
        _ => return None,
    })
}

/// Commands and their answers.
fn command(controller: &mut Controller, line: &str) -> Option<String> {
    let refused = || Some(format!("Failed to execute: {line}"));
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
            if !controller.paused || controller.why_not_ready().is_some() {
                return refused();
            }
            controller.paused = false;
            "Starting program"
        }
        "pause" => {
            if controller.running.is_none() {
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
