//! MCAP: the run told again as messages, a topic for each thing that happens.

use std::collections::BTreeMap;
use std::io::Write;

use conik::Vec3;
use conik_sim::scenario::Scenario;
use conik_sim::summary::{Outcome, Summary};

use super::arm::Arm;
use super::channels::Channels;
use super::error::ExportError;
use super::frames::{FrameTree, WORLD};
use super::path::Path;
use super::primitive::{self, Colour, colour};
use super::protobuf::Message;
use super::source::{Source, Watch, place};
use super::teller::Teller;
use super::types::{FRAME_TRANSFORMS, SCENE_UPDATE};
use super::{Exported, VERSION};
use crate::figure::palette;

/// Rows between two looks at whether to go on.
const ROWS_BETWEEN_LOOKS: u64 = 4096;

/// Share of the work that it is to look for the tool's path.
const FIRST_LOOK: f64 = 0.1;

/// Writes the recording.
pub fn write<W: Write>(source: &Source, out: W, watch: Watch) -> Result<Exported, ExportError> {
    let mut channels = Channels::begin(out)?;
    describe(source, &mut channels)?;
    let arm = Arm::of(&source.robot);
    let frames = FrameTree::of(&source.robot);
    let path = path(source, &mut |share| watch(FIRST_LOOK * share))?;
    write_still(&arm, &frames, &path, &mut channels)?;
    let mut rows = source.rows(|_| true)?;
    let mut teller = Teller::new(source, &arm, &frames, &rows, &mut channels)?;
    let mut count = 0;
    while rows.advance()? {
        teller.tell(&rows, &mut channels)?;
        count += 1;
        if count % ROWS_BETWEEN_LOOKS == 0
            && !watch(FIRST_LOOK + (1.0 - FIRST_LOOK) * source.share(&rows))
        {
            return Err(ExportError::Stopped);
        }
    }
    teller.end(&mut channels)?;
    channels.finish()?;
    Ok(Exported {
        rows: count,
        is_truncated: rows.is_truncated(),
    })
}

/// What was run, and how it ended.
fn describe<W: Write>(source: &Source, channels: &mut Channels<W>) -> Result<(), ExportError> {
    let summary = &source.summary;
    let scenario = &summary.settings.scenario;
    let toml = scenario.to_toml();
    channels.describe("conik", facts(source, scenario, summary))?;
    let scenario_text = BTreeMap::from([("toml".to_owned(), toml.clone())]);
    channels.describe("scenario", scenario_text)?;
    channels.attach("scenario.toml", "application/toml", &toml)?;
    channels.attach("summary.json", "application/json", &source.summary_text)
}

fn facts(source: &Source, scenario: &Scenario, summary: &Summary) -> BTreeMap<String, String> {
    let control = &scenario.control;
    // As the scenario file has them.
    let word = |value: serde_json::Result<serde_json::Value>| match value {
        Ok(serde_json::Value::String(word)) => word,
        Ok(other) => other.to_string(),
        Err(_) => String::new(),
    };
    let outcome = match &summary.outcome {
        Outcome::Running => "cut off".to_owned(),
        Outcome::Completed => "completed".to_owned(),
        Outcome::Interrupted => "interrupted".to_owned(),
        Outcome::Fault { name, detail } => format!("fault: {name}: {detail}"),
    };
    let facts = [
        ("version", VERSION.to_owned()),
        ("run", source.name.clone()),
        ("title", scenario.title.clone().unwrap_or_default()),
        ("robot", source.robot.name().to_owned()),
        ("arm", summary.settings.robot.clone()),
        ("rate_hz", control.rate_hz.to_string()),
        ("duration_s", control.duration_s.to_string()),
        ("mode_rule", word(serde_json::to_value(control.mode_rule))),
        ("border", word(serde_json::to_value(control.border))),
        ("recursion", word(serde_json::to_value(control.recursion))),
        ("outcome", outcome),
    ];
    facts
        .into_iter()
        .map(|(name, value)| (name.to_owned(), value))
        .collect()
}

/// The way of the tool, in the colours of the modes.
fn path(source: &Source, watch: Watch) -> Result<Vec<(Vec3, Colour)>, ExportError> {
    const TOOL: [&str; 3] = ["tool_x_m", "tool_y_m", "tool_z_m"];
    let mut rows = source.rows(|name| TOOL.contains(&name))?;
    let tool = TOOL.map(|column| place(&rows, column));
    let mut path = Path::default();
    let mut count = 0;
    while rows.advance()? {
        let row = rows.row();
        let at = tool.map(|place| place.map_or(f64::NAN, |at| row.numbers[at]));
        path.add(at.into(), row.active);
        count += 1;
        if count % ROWS_BETWEEN_LOOKS == 0 && !watch(source.share(&rows)) {
            return Err(ExportError::Stopped);
        }
    }
    if count == 0 {
        return Err(source.no_rows());
    }
    let mut with_sets = 0;
    let colours: Vec<Colour> = rows
        .active_sets()
        .iter()
        .map(|names| {
            if names.is_empty() {
                return colour(palette::FRAME, 1.0);
            }
            with_sets += 1;
            colour(palette::mode(with_sets - 1), 1.0)
        })
        .collect();
    let points = path.points().into_iter();
    Ok(points
        .map(|(point, active)| (point, colours[active as usize]))
        .collect())
}

/// What stays as it is, each on a topic of its own: whoever jumps to a moment gets the last message of
/// every topic.
fn write_still<W: Write>(
    arm: &Arm,
    frames: &FrameTree,
    path: &[(Vec3, Colour)],
    channels: &mut Channels<W>,
) -> Result<(), ExportError> {
    let mut message = Message::default();
    for edge in frames.fixed() {
        primitive::transform(0, (&edge.parent, &edge.child), &edge.pose, &mut message);
    }
    let mut topic = channels.topic("/tf_static", &FRAME_TRANSFORMS)?;
    channels.write(&mut topic, 0, &message)?;

    message.clear();
    arm.show(frames, &mut message);
    let mut topic = channels.topic("/arm", &SCENE_UPDATE)?;
    channels.write(&mut topic, 0, &message)?;

    message.clear();
    primitive::entity(&mut message, (WORLD, "path"), 0, |entity| {
        primitive::line(entity, path, 2.0);
    });
    let mut topic = channels.topic("/path", &SCENE_UPDATE)?;
    channels.write(&mut topic, 0, &message)
}
