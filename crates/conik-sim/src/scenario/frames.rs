//! Which frame of the robot a task measures, and which other one sees it.

use serde::{Deserialize, Serialize};

use super::key::Key;
use super::keys;
use super::mistake::Mistakes;
use super::robots::RobotFacts;
use super::table::{Entry, Table, unknown_name};
use super::write::text;

/// `frame` and `relative_to` of a task.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Frames {
    /// Name of the link that is measured; `None`: the tool.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<String>,
    /// Name of the link in whose axes points, directions and values are; `None`: the world.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relative_to: Option<String>,
}

impl Frames {
    /// Whether it is the tool in the world.
    pub fn is_tool_in_world(&self) -> bool {
        *self == Self::default()
    }

    /// "tool", "link_3", "tool in link_3"
    pub fn described(&self) -> String {
        let frame = self.frame.as_deref().unwrap_or("tool");
        match &self.relative_to {
            Some(other) => format!("{frame} in {other}"),
            None => frame.to_owned(),
        }
    }

    /// The keys and values, as they stand in the file.
    pub(super) fn written(&self) -> impl Iterator<Item = (&'static str, String)> + use<> {
        let line = |key: &Key, link: &Option<String>| Some((key.name, text(link.as_ref()?)));
        let frame = line(&keys::FRAME, &self.frame);
        frame
            .into_iter()
            .chain(line(&keys::RELATIVE_TO, &self.relative_to))
    }
}

/// Reads both, each of which may be left out.
pub(super) fn read(
    table: &Table,
    robot: Option<&RobotFacts>,
    found: &mut Mistakes,
) -> Option<Frames> {
    let frame = table.link(&keys::FRAME, robot, found).map(Some).or(None);
    let relative_to = table
        .link(&keys::RELATIVE_TO, robot, found)
        .map(Some)
        .or(None);
    Some(Frames {
        frame: frame?,
        relative_to: relative_to?,
    })
}

impl Table<'_> {
    /// Name of a link of the robot, if that is known.
    pub(super) fn link(
        &self,
        key: &'static Key,
        robot: Option<&RobotFacts>,
        found: &mut Mistakes,
    ) -> Entry<String> {
        self.entry(key, |value| {
            let name = value.text(found)?;
            // The links of an unknown robot are unknown too; that is noted already.
            let links = &robot?.link_names;
            if links.iter().any(|link| link == name) {
                return Some(name.to_owned());
            }
            let (what, help) = unknown_name(name, links.iter().map(String::as_str));
            let what = what.replace("unknown name", "the robot has no link");
            let help = match (key.name, name) {
                ("frame", "tool") => {
                    "leave `frame` out: what is measured is the tool then".to_owned()
                }
                ("relative_to", "world") => {
                    "leave `relative_to` out: what is measured is seen from the world then"
                        .to_owned()
                }
                _ => help,
            };
            found.add(value.span(), &*value.path, what, help);
            None
        })
    }
}
