//! What was decided, and what there is to say about it: told when it changes.

use std::io::Write;

use conik_sim::log::LogRows;
use conik_sim::scenario::GoalConfig;
use conik_sim::summary::{ChangeMade, Outcome};

use super::channels::{Channels, Topic};
use super::error::ExportError;
use super::primitive;
use super::protobuf::Message;
use super::source::{Source, place};

/// `foxglove.Log.Level`.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Level {
    Info = 2,
    Warning = 3,
    Error = 4,
}

/// Words of `why` that a person should know of.
const ALARMING: [&str; 4] = ["outside", "still", "no-mode", "acceleration-exceeded"];

/// Tells decisions and events.
#[derive(Debug)]
pub struct Events {
    decisions: Topic,
    log: Topic,
    /// Column of the waypoint in use.
    waypoint: Option<usize>,
    waypoints: usize,
    /// What people changed and since when [ns], the first one last.
    changes: Vec<(u64, String)>,
    last: Option<Decision>,
    /// Time of the last row, and of the last decision that was told [ns].
    now: u64,
    told: u64,
    message: Message,
}

/// What was decided in a row; numbers into the lists of the log.
#[derive(Clone, Debug, PartialEq)]
struct Decision {
    mode: Option<u64>,
    active: u32,
    why: Option<u32>,
    waypoint: u64,
    /// `conik.Decision`.
    bytes: Message,
}

impl Events {
    /// For the topics of decisions and of lines for people.
    pub fn new(source: &Source, rows: &LogRows, decisions: Topic, log: Topic) -> Self {
        let goals = source.tasks.iter().map(|task| &task.config.goal);
        Self {
            decisions,
            log,
            waypoint: place(rows, "waypoint"),
            waypoints: goals.filter_map(GoalConfig::waypoint_count).sum(),
            changes: changes(&source.summary.changes),
            last: None,
            now: 0,
            told: 0,
            message: Message::default(),
        }
    }

    /// Tells what is otherwise in this row than in the last.
    pub fn tell<W: Write>(
        &mut self,
        rows: &LogRows,
        nanoseconds: u64,
        channels: &mut Channels<W>,
    ) -> Result<(), ExportError> {
        self.now = nanoseconds;
        while let Some((_, line)) = self.changes.pop_if(|(since, _)| *since <= nanoseconds) {
            self.say(Level::Info, &line, nanoseconds, channels)?;
        }
        let row = rows.row();
        let waypoint = self.waypoint.map_or(0.0, |at| row.numbers[at]);
        // Whole as the log has it.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let waypoint = waypoint as u64;
        let is_same = self.last.as_ref().is_some_and(|last| {
            let now = (row.mode, row.active, row.why, waypoint);
            (last.mode, last.active, last.why, last.waypoint) == now
        });
        if is_same {
            return Ok(());
        }
        let active = &rows.active_sets()[row.active as usize];
        let why = row.why.map_or(&[][..], |id| &rows.codes()[id as usize]);
        let mut bytes = Message::default();
        if let Some(mode) = row.mode {
            bytes.whole(1, mode);
        }
        bytes.text(2, &active.join("+"));
        bytes.whole(3, active.len() as u64);
        bytes.whole(4, waypoint);
        bytes.text(5, &why.join("+"));
        channels.write(&mut self.decisions, nanoseconds, &bytes)?;
        self.told = nanoseconds;

        let last = self.last.replace(Decision {
            mode: row.mode,
            active: row.active,
            why: row.why,
            waypoint,
            bytes,
        });
        let has_mode_changed = last.as_ref().is_none_or(|it| it.active != row.active);
        let is_alarming = |code: &&String| {
            let word = code.split(':').next().unwrap_or_default();
            ALARMING.contains(&word)
        };
        let known = last.as_ref().and_then(|last| last.why);
        let known = known.map_or(&[][..], |id| &rows.codes()[id as usize]);
        let alarms = why.iter().filter(is_alarming);
        let alarms: Vec<&String> = alarms.filter(|code| !known.contains(code)).collect();
        if has_mode_changed {
            let line = mode_line(row.mode, active, why);
            self.say(Level::Info, &line, nanoseconds, channels)?;
        }
        for code in alarms {
            self.say(Level::Warning, code, nanoseconds, channels)?;
        }
        if let Some(last) = last.filter(|last| last.waypoint != waypoint) {
            let line = format!(
                "waypoint {} reached, {} of {} is next",
                last.waypoint + 1,
                waypoint + 1,
                self.waypoints
            );
            self.say(Level::Info, &line, nanoseconds, channels)?;
        }
        Ok(())
    }

    /// Tells how it ended, and once more what was decided last: it held until then.
    pub fn end<W: Write>(
        &mut self,
        outcome: &Outcome,
        channels: &mut Channels<W>,
    ) -> Result<(), ExportError> {
        if let Some(last) = self.last.take()
            && self.told < self.now
        {
            channels.write(&mut self.decisions, self.now, &last.bytes)?;
        }
        let (level, line) = match outcome {
            Outcome::Completed => (Level::Info, "completed".to_owned()),
            Outcome::Interrupted => (Level::Warning, "interrupted".to_owned()),
            Outcome::Running => (
                Level::Warning,
                "cut off: nobody wrote how it ended".to_owned(),
            ),
            Outcome::Fault { name, detail } => (Level::Error, format!("fault: {name}: {detail}")),
        };
        self.say(level, &line, self.now, channels)
    }

    fn say<W: Write>(
        &mut self,
        level: Level,
        line: &str,
        nanoseconds: u64,
        channels: &mut Channels<W>,
    ) -> Result<(), ExportError> {
        let message = &mut self.message;
        message.clear();
        primitive::timestamp(1, nanoseconds, message);
        message.whole(2, level as u64);
        message.text(3, line);
        message.text(4, "conik");
        message.text(5, "");
        message.fixed32(6, 0);
        channels.write(&mut self.log, nanoseconds, message)
    }
}

/// A line for each change that came into force, the first one last.
fn changes(made: &[ChangeMade]) -> Vec<(u64, String)> {
    let in_force = made.iter().filter_map(|it| Some((it.t_s?, &it.changes)));
    let mut lines: Vec<(u64, String)> = in_force
        .map(|(t_s, changes)| {
            // Keys are text, and values those of a scenario: nothing that JSON does not have.
            let changed = serde_json::to_string(changes).unwrap_or_default();
            let line = match changes[..] {
                [] => "all changes were taken back".to_owned(),
                _ => format!("changed: {changed}"),
            };
            (primitive::nanoseconds(t_s), line)
        })
        .collect();
    lines.reverse();
    lines
}

/// "mode 2: obstacle + view (hold:obstacle)"
fn mode_line(mode: Option<u64>, active: &[String], why: &[String]) -> String {
    let number = mode.map_or("–".to_owned(), |number| number.to_string());
    let sets = match active {
        [] => "no set active".to_owned(),
        names => names.join(" + "),
    };
    match why {
        [] => format!("mode {number}: {sets}"),
        codes => format!("mode {number}: {sets} ({})", codes.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_told_in_their_order_once_they_are_in_force() {
        let text = r#"[
            {"t_s": 0.5, "changes": [{"control": "border", "value": "freeze"}]},
            {"t_s": 2.0, "changes": []},
            {"t_s": null, "changes": []}
        ]"#;
        let made: Vec<ChangeMade> = serde_json::from_str(text).unwrap();
        let mut lines = changes(&made);
        let (since, line) = lines.pop().unwrap();
        assert_eq!(since, 500_000_000);
        assert_eq!(line, r#"changed: [{"control":"border","value":"freeze"}]"#);
        let (since, line) = lines.pop().unwrap();
        assert_eq!(
            (since, line.as_str()),
            (2_000_000_000, "all changes were taken back")
        );
        assert!(lines.is_empty(), "not in force yet");
    }
}
