//! What the text of the program says: whom it calls, how its frames are built, how it servoes.
//!
//! Nothing depends on where a line stands: constants are found by their names, the sockets by the
//! calls that open them, so that versions of the library that differ elsewhere are read too.

use super::calls::{Call, Purpose};
use crate::registers::JOINTS;
use std::collections::BTreeMap;
use std::net::IpAddr;

/// The name of the socket that the setpoints come on; the program is known by it.
const REVERSE: &str = "\"reverse_socket\"";

/// Lookahead [s] and gain that `servoj` takes.
const LOOKAHEADS_S: std::ops::RangeInclusive<f64> = 0.03..=0.2;
const GAINS: std::ops::RangeInclusive<f64> = 100.0..=2000.0;

/// The longest frame taken, in numbers of 32 bits.
const LONGEST_FRAME: usize = 64;

/// The program's own parameters.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Parameters {
    /// The sockets, in the order in which they are opened.
    pub(super) calls: Vec<Call>,
    /// What a joint's number is divided by [1/rad].
    pub(super) per_radian: f64,
    pub(super) lookahead_s: f64,
    pub(super) gain: f64,
    /// Numbers in a frame of setpoints: the time-out first, the joints after it, the mode last.
    pub(super) frame: usize,
    /// Numbers in a frame of the command socket, the command first.
    pub(super) command_frame: usize,
    /// What the first number of a frame of setpoints counts [s].
    pub(super) timeout_unit_s: f64,
    /// A setpoint that needs more is ignored [rad/s]; old versions take any.
    pub(super) ignored_speed: f64,
    pub(super) stop_deceleration: f64,
    pub(super) stopped: i32,
    pub(super) idle: i32,
    pub(super) servoj: i32,
    /// What is said on the trajectory socket when a trajectory failed.
    pub(super) trajectory_failure: i32,
    /// Modes and commands by their numbers.
    pub(super) modes: BTreeMap<i32, String>,
    pub(super) commands: BTreeMap<i32, String>,
}

/// Reads a text; `None` if it is another program, an error if it lacks what is needed.
pub(super) fn read(text: &str) -> Option<Result<Parameters, String>> {
    text.contains(REVERSE).then(|| parameters(text))
}

fn parameters(text: &str) -> Result<Parameters, String> {
    let mut calls = Vec::new();
    for (name, purpose) in [
        (REVERSE, Purpose::Setpoints),
        ("\"trajectory_socket\"", Purpose::Trajectory),
        ("\"script_command_socket\"", Purpose::Commands),
    ] {
        let places = text.match_indices(name);
        let call = places.filter_map(|(at, _)| Some((at, address(&text[..at])?)));
        if let Some((at, (host, port))) = call.into_iter().next() {
            let host: IpAddr = host
                .parse()
                .map_err(|_| format!("it calls '{host}', and only addresses are dialled here"))?;
            let call = Call {
                purpose,
                host,
                port,
            };
            calls.push((at, call));
        }
    }
    calls.sort_by_key(|(at, _)| *at);
    let calls: Vec<Call> = calls.into_iter().map(|(_, call)| call).collect();
    if !calls.iter().any(|call| call.purpose == Purpose::Setpoints) {
        return Err("it opens no socket for its setpoints".to_owned());
    }
    let constants = constants(text);
    let modes: BTreeMap<i32, String> = constants
        .iter()
        .filter(|(name, _)| name.starts_with("MODE_"))
        .map(|(name, number)| (*number, (*name).to_owned()))
        .collect();
    let mode = |name: &str| {
        let number = constants.get(name).copied();
        number.ok_or_else(|| format!("it does not say what {name} is"))
    };
    let within = |name: &str, value: Option<f64>, range: std::ops::RangeInclusive<f64>| match value
    {
        Some(value) if range.contains(&value) => Ok(value),
        Some(value) => Err(format!(
            "its {name} is {value}; it must be from {} to {}",
            range.start(),
            range.end()
        )),
        None => Err(format!("it does not say what its {name} is")),
    };
    let frame = constant(text, "REVERSE_INTERFACE_DATA_DIMENSION").unwrap_or(8.0);
    let command_frame = constant(text, "SCRIPT_COMMAND_DATA_DIMENSION").unwrap_or(1.0);
    // Old versions count missing frames of 20 ms; newer ones give the time-out in milliseconds.
    let counts_frames = text.contains("keepalive = params_mult[1]");
    Ok(Parameters {
        per_radian: within(
            "MULT_jointstate",
            constant(text, "MULT_jointstate"),
            1.0..=1e9,
        )?,
        lookahead_s: within("lookahead_time", argument(text, "lookahead_time"), LOOKAHEADS_S)?,
        gain: within("gain", argument(text, "gain"), GAINS)?,
        frame: length(frame, JOINTS + 2)?,
        command_frame: length(command_frame, 1)?,
        timeout_unit_s: if counts_frames { 0.02 } else { 0.001 },
        ignored_speed: constant(text, "JOINT_IGNORE_SPEED").unwrap_or(f64::INFINITY),
        stop_deceleration: within(
            "STOPJ_ACCELERATION",
            constant(text, "STOPJ_ACCELERATION").or(Some(4.0)),
            0.1..=100.0,
        )?,
        stopped: mode("MODE_STOPPED")?,
        idle: mode("MODE_IDLE")?,
        servoj: mode("MODE_SERVOJ")?,
        #[allow(clippy::cast_possible_truncation)] // Saturates.
        trajectory_failure: constant(text, "TRAJECTORY_RESULT_FAILURE").unwrap_or(2.0) as i32,
        commands: commands(text, &constants),
        modes,
        calls,
    })
}

/// Numbers in a frame, at least so many.
fn length(value: f64, least: usize) -> Result<usize, String> {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Saturates.
    let length = value as usize;
    if (least..=LONGEST_FRAME).contains(&length) {
        Ok(length)
    } else {
        Err(format!(
            "a frame of {value} numbers; there must be {least} to {LONGEST_FRAME}"
        ))
    }
}

/// The host and the port that stand before the name of a socket: `"host", port, `.
fn address(before: &str) -> Option<(&str, u16)> {
    let before = before.trim_end().strip_suffix(',')?.trim_end();
    let rest = before.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let port: u16 = before[rest.len()..].parse().ok()?;
    let rest = rest.trim_end().strip_suffix(',')?.trim_end();
    let (_, host) = rest.strip_suffix('"')?.rsplit_once('"')?;
    (port != 0).then_some((host, port))
}

/// The number that a name is set to, wherever that stands.
fn constant(text: &str, name: &str) -> Option<f64> {
    text.lines().find_map(|line| {
        let (left, right) = line.split_once('=')?;
        let left = left.trim().trim_start_matches("global ").trim();
        let right = right.split('#').next().unwrap_or_default().trim();
        (left == name).then(|| right.parse().ok()).flatten()
    })
}

/// The number that an argument of this name is given.
fn argument(text: &str, name: &str) -> Option<f64> {
    let (_, after) = text.split_once(&format!("{name}="))?;
    let end = after.find(|letter: char| !letter.is_ascii_digit() && !".+-eE".contains(letter));
    after[..end.unwrap_or(after.len())].parse().ok()
}

/// Names that are set to a whole number.
fn constants(text: &str) -> BTreeMap<&str, i32> {
    let constants = text.lines().filter_map(|line| {
        let (name, value) = line.split_once('=')?;
        let value = value.split('#').next().unwrap_or_default().trim();
        Some((name.trim(), value.parse().ok()?))
    });
    constants.collect()
}

/// The constants that a received command is compared with, by their numbers.
fn commands(text: &str, constants: &BTreeMap<&str, i32>) -> BTreeMap<i32, String> {
    let compared = text.split("command == ").skip(1).filter_map(|after| {
        let end = after.find(|letter: char| !letter.is_ascii_alphanumeric() && letter != '_');
        let name = &after[..end.unwrap_or(after.len())];
        Some((*constants.get(name)?, name.to_owned()))
    });
    compared.collect()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// The same statements as in the library's program, in our own words and order.
    pub(in super::super) fn program(ports: [u16; 3]) -> String {
        let [trajectory, commands, reverse] = ports;
        format!(
            "def anyName():
\tMULT_jointstate = 1000000
\tSTOPJ_ACCELERATION = 4.0
\tMODE_STOPPED = -2 # ends
\tMODE_UNINITIALIZED = -1
\tMODE_IDLE = 0
\tMODE_SERVOJ = 1
\tMODE_FORWARD = 3
\tREVERSE_INTERFACE_DATA_DIMENSION = 8
\tSCRIPT_COMMAND_DATA_DIMENSION = 28
\tSET_PAYLOAD = 1
\tSTART_FORCE_MODE = 3
\tTRAJECTORY_RESULT_FAILURE = 2
\tJOINT_IGNORE_SPEED = 20.0
\tthread servoThread():
\t  servoj(q, t=steptime, lookahead_time=0.03, gain=2000)
\tend
\tthread script_commands():
\t  if command == SET_PAYLOAD:
\t  elif command == START_FORCE_MODE:
\t  end
\tend
\tsocket_send_int(1, \"trajectory_socket\")
\tretry(\"127.0.0.1\", {trajectory},
\t  \"trajectory_socket\")
\tretry(\"127.0.0.1\", {commands}, \"script_command_socket\")
\tsocket_open( \"127.0.0.1\" , {reverse} , \"reverse_socket\")
end
"
        )
    }

    fn parsed(text: &str) -> Result<Parameters, String> {
        read(text).unwrap()
    }

    #[test]
    fn the_sockets_are_called_in_the_order_of_the_text() {
        let parameters = parsed(&program([50003, 50004, 50001])).unwrap();
        let calls: Vec<_> = parameters
            .calls
            .iter()
            .map(|call| (call.purpose, call.port))
            .collect();
        let expected = [
            (Purpose::Trajectory, 50003),
            (Purpose::Commands, 50004),
            (Purpose::Setpoints, 50001),
        ];
        assert_eq!(calls, expected);
        assert_eq!((parameters.lookahead_s, parameters.gain), (0.03, 2000.0));
        assert_eq!(parameters.modes[&3], "MODE_FORWARD");
        assert_eq!(parameters.commands[&1], "SET_PAYLOAD");
        assert_eq!(parameters.commands.len(), 2);
    }

    #[test]
    fn old_versions_have_one_socket_and_count_missing_frames() {
        let text = "MULT_jointstate = 1000000\nMODE_STOPPED = -2\nMODE_IDLE = 0\nMODE_SERVOJ = 1\n\
                    servoj(q, t=steptime, lookahead_time=0.1, gain=300)\n\
                    socket_open(\"10.0.0.2\", 50001, \"reverse_socket\")\n\
                    keepalive = params_mult[1]\n";
        let parameters = parsed(text).unwrap();
        assert_eq!(parameters.calls.len(), 1);
        assert_eq!((parameters.frame, parameters.timeout_unit_s), (8, 0.02));
    }

    #[test]
    fn what_cannot_be_emulated_is_refused_by_name() {
        let good = program([1, 2, 3]);
        for (from, to, part) in [
            ("gain=2000", "gain=9", "its gain is 9"),
            ("lookahead_time=", "x=", "what its lookahead_time is"),
            ("MODE_IDLE = 0", "", "what MODE_IDLE is"),
            ("= 1000000", "= 0", "MULT_jointstate is 0"),
            ("DIMENSION = 8", "DIMENSION = 7", "a frame of 7 numbers"),
            ("127.0.0.1\" , 3", "host\" , 3", "it calls 'host'"),
            ("127.0.0.1\" , 3", "127.0.0.1\" , 0", "no socket"),
        ] {
            assert!(good.contains(from), "{from}");
            let error = parsed(&good.replace(from, to)).unwrap_err();
            assert!(error.contains(part), "{error}");
        }
        assert_eq!(read("def other():\nend\n"), None);
    }
}
