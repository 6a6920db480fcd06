//! The port that runs any program sent to it: cuts programs out of the bytes that come in.

use std::ops::Range;

/// The longest program taken; a real client's own is some 50 kB.
const MOST_BYTES: usize = 1 << 20;

/// Collects bytes and gives them back as programs. No byte is looked at twice, however small the
/// portions are.
#[derive(Debug, Default)]
pub(super) struct ScriptReader {
    bytes: Vec<u8>,
    /// Where the line begins that is looked at; whole lines before it belong to an open block.
    line: usize,
    /// No line ends between there and here.
    searched: usize,
}

/// A program longer than is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TooLong;

impl ScriptReader {
    /// Adds bytes as they came in.
    pub(super) fn push(&mut self, bytes: &[u8]) -> Result<(), TooLong> {
        self.bytes.extend_from_slice(bytes);
        if self.bytes.len() > MOST_BYTES {
            return Err(TooLong);
        }
        Ok(())
    }

    /// The next whole program: a `def` (or `sec`) up to the `end` at the margin, or a single line.
    pub(super) fn next_program(&mut self) -> Option<String> {
        while let Some(line) = self.next_line() {
            let end = line.end;
            let is_first = line.start == 0;
            let line = &self.bytes[line];
            let is_whole = if is_first {
                if line.trim_ascii().is_empty() {
                    self.take(end);
                    continue;
                }
                !(line.starts_with(b"def ") || line.starts_with(b"sec "))
            } else {
                line.trim_ascii_end() == b"end"
            };
            if is_whole {
                return Some(self.take(end));
            }
        }
        None
    }

    /// The next whole line, its line break included.
    fn next_line(&mut self) -> Option<Range<usize>> {
        let mut rest = self.bytes[self.searched..].iter();
        let Some(length) = rest.position(|byte| *byte == b'\n') else {
            self.searched = self.bytes.len();
            return None;
        };
        let start = self.line;
        self.searched += length + 1;
        self.line = self.searched;
        Some(start..self.line)
    }

    /// Takes the first `end` bytes out.
    fn take(&mut self, end: usize) -> String {
        (self.line, self.searched) = (0, 0);
        let text = String::from_utf8_lossy(&self.bytes[..end]).into_owned();
        self.bytes.drain(..end);
        text
    }
}

/// What a program calls itself, for the log.
pub(super) fn name_of(text: &str) -> String {
    let first = text.lines().next().unwrap_or_default().trim();
    let name = first
        .trim_start_matches("def ")
        .trim_start_matches("sec ")
        .trim_end_matches("():");
    name.chars().take(60).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn programs_come_out_whole_however_the_bytes_come_in() {
        let stream = "def a():\n  if (True):\n  end\nend\n\r\npopup(\"x\")\ndef b():\r\nend\r\n";
        for portion in [1, 2, 7, stream.len()] {
            let mut reader = ScriptReader::default();
            let mut programs = Vec::new();
            for bytes in stream.as_bytes().chunks(portion) {
                reader.push(bytes).unwrap();
                while let Some(program) = reader.next_program() {
                    programs.push(name_of(&program));
                }
            }
            assert_eq!(programs, ["a", "popup(\"x\")", "b"]);
        }
    }

    #[test]
    fn a_program_without_an_end_does_not_grow_for_ever() {
        let mut reader = ScriptReader::default();
        reader.push(b"def a():\n").unwrap();
        let line = vec![b'x'; 1 << 16];
        let grown = (0..32).try_for_each(|_| reader.push(&line));
        assert_eq!(grown, Err(TooLong));
        assert_eq!(reader.next_program(), None);
    }
}
