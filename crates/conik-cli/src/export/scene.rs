//! Regions on a topic: told when one of them lights up, goes out or moves.

use std::io::Write;

use super::channels::{Channels, Topic};
use super::error::ExportError;
use super::protobuf::Message;
use super::region::Region;
use super::types::SCENE_UPDATE;

/// Regions that are told together, whenever one of them changes.
pub struct Scene {
    topic: Option<Topic>,
    regions: Vec<Region>,
    /// Which were lit when they were told last; none before the first time.
    lit: Vec<bool>,
    /// Until when one of them moves [s].
    moves_until_s: f64,
    has_settled: bool,
}

impl Scene {
    /// A scene on a topic of that name; none where there is nothing to show.
    pub fn new<W: Write>(
        topic: &str,
        regions: Vec<Region>,
        channels: &mut Channels<W>,
    ) -> Result<Self, ExportError> {
        let topic = match regions[..] {
            [] => None,
            _ => Some(channels.topic(topic, &SCENE_UPDATE)?),
        };
        let until = regions.iter().map(Region::moves_until_s);
        Ok(Self {
            topic,
            moves_until_s: until.fold(0.0, f64::max),
            regions,
            lit: Vec::new(),
            has_settled: false,
        })
    }

    /// Whether something is otherwise than it was told.
    pub fn is_due(&mut self, t_s: f64, active: &[String]) -> bool {
        let was_moving = !self.has_settled;
        self.has_settled = t_s >= self.moves_until_s;
        let lit = self.regions.iter().map(|region| region.is_lit(active));
        let is_same = self.lit.iter().copied().eq(lit);
        self.topic.is_some() && (was_moving || !is_same)
    }

    /// Tells of all of them, so that the topic's last message is enough.
    pub fn tell<W: Write>(
        &mut self,
        nanoseconds: u64,
        active: &[String],
        plate_m: f64,
        message: &mut Message,
        channels: &mut Channels<W>,
    ) -> Result<(), ExportError> {
        let Some(topic) = &mut self.topic else {
            return Ok(());
        };
        message.clear();
        for region in &self.regions {
            region.show(nanoseconds, active, plate_m, message);
        }
        let lit = self.regions.iter().map(|region| region.is_lit(active));
        self.lit = lit.collect();
        channels.write(topic, nanoseconds, message)
    }
}
