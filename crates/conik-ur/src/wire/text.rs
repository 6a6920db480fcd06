//! Text messages: what a client or a controller wants people to read.

use super::WireError;
use super::contents::Contents;

/// How serious a text message is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TextLevel {
    /// 0.
    Exception,
    /// 1.
    Error,
    /// 2.
    Warning,
    /// 3 and, so that a new level loses no message, all above.
    Info,
}

/// A message for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextMessage {
    /// The message.
    pub text: String,
    /// Who says it.
    pub source: String,
    /// How serious it is.
    pub level: TextLevel,
}

impl TextMessage {
    /// A message, cut to the 255 bytes that its length has room for.
    pub fn new(level: TextLevel, source: &str, text: &str) -> Self {
        Self {
            text: cut(text).to_owned(),
            source: cut(source).to_owned(),
            level,
        }
    }

    /// The contents of a text package.
    pub(super) fn encode(&self) -> Result<Vec<u8>, WireError> {
        let mut bytes = Vec::with_capacity(3 + self.text.len() + self.source.len());
        for text in [&self.text, &self.source] {
            let size = u8::try_from(text.len()).map_err(|_| WireError::Oversize {
                size: text.len(),
                limit: usize::from(u8::MAX),
            })?;
            bytes.push(size);
            bytes.extend_from_slice(text.as_bytes());
        }
        bytes.push(match self.level {
            TextLevel::Exception => 0,
            TextLevel::Error => 1,
            TextLevel::Warning => 2,
            TextLevel::Info => 3,
        });
        Ok(bytes)
    }

    /// The message in the contents of a text package.
    pub(super) fn decode(mut contents: Contents<'_>) -> Result<Self, WireError> {
        let text = sized_text(&mut contents)?;
        let source = sized_text(&mut contents)?;
        let level = match contents.take::<1>("text")? {
            [0] => TextLevel::Exception,
            [1] => TextLevel::Error,
            [2] => TextLevel::Warning,
            _ => TextLevel::Info,
        };
        let message = Self {
            text,
            source,
            level,
        };
        contents.end("text", message)
    }
}

/// The longest front of `text` within 255 bytes that ends between two characters.
fn cut(text: &str) -> &str {
    let mut end = text.len().min(usize::from(u8::MAX));
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    &text[..end]
}

/// A text with its length in front. A message is for people: odd bytes must not lose it.
fn sized_text(contents: &mut Contents<'_>) -> Result<String, WireError> {
    let [size] = contents.take("text")?;
    let text = contents.take_slice("text", usize::from(size))?;
    Ok(String::from_utf8_lossy(text).into_owned())
}
