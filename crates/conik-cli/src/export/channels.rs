//! An MCAP file that is being written, and its topics.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::Write;

use mcap::records::{MessageHeader, Metadata};
use mcap::write::NoSeek;
use mcap::{Attachment, WriteOptions, Writer};

use super::VERSION;
use super::error::ExportError;
use super::protobuf::Message;
use super::schema::MessageType;

/// A file being written from its beginning to its end: it may be a pipe.
pub struct Channels<W: Write> {
    writer: Writer<NoSeek<W>>,
}

/// A topic, and how many messages it has.
#[derive(Debug)]
pub struct Topic {
    channel: u16,
    messages: u32,
}

impl<W: Write> Channels<W> {
    /// Begins a file.
    pub fn begin(out: W) -> Result<Self, ExportError> {
        let options = WriteOptions::new()
            .compression(None)
            .disable_seeking(true)
            .library(format!("conik {VERSION}"));
        Ok(Self {
            writer: options.create(NoSeek::new(out))?,
        })
    }

    /// Adds a topic of messages of that type.
    pub fn topic(&mut self, name: &str, of: &'static MessageType) -> Result<Topic, ExportError> {
        let schema = self
            .writer
            .add_schema(of.name, "protobuf", &of.descriptor())?;
        let facts = BTreeMap::new();
        let channel = self.writer.add_channel(schema, name, "protobuf", &facts)?;
        Ok(Topic {
            channel,
            messages: 0,
        })
    }

    /// Writes a message of a moment [ns].
    pub fn write(
        &mut self,
        topic: &mut Topic,
        nanoseconds: u64,
        message: &Message,
    ) -> Result<(), ExportError> {
        let header = MessageHeader {
            channel_id: topic.channel,
            sequence: topic.messages,
            log_time: nanoseconds,
            publish_time: nanoseconds,
        };
        topic.messages = topic.messages.wrapping_add(1);
        Ok(self
            .writer
            .write_to_known_channel(&header, message.bytes())?)
    }

    /// Adds what is known of the whole file.
    pub fn describe(
        &mut self,
        name: &str,
        metadata: BTreeMap<String, String>,
    ) -> Result<(), ExportError> {
        let name = name.to_owned();
        Ok(self.writer.write_metadata(&Metadata { name, metadata })?)
    }

    /// Adds another file.
    pub fn attach(&mut self, name: &str, media_type: &str, text: &str) -> Result<(), ExportError> {
        Ok(self.writer.attach(&Attachment {
            log_time: 0,
            create_time: 0,
            name: name.to_owned(),
            media_type: media_type.to_owned(),
            data: Cow::Borrowed(text.as_bytes()),
        })?)
    }

    /// Writes the index: without it, it is no whole file.
    pub fn finish(mut self) -> Result<(), ExportError> {
        self.writer.finish()?;
        Ok(())
    }
}
