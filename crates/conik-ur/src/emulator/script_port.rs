//! The port that runs any program sent to it: cuts programs out of the bytes that come in.

/// The longest program taken; a real client's own is some 50 kB.
const MOST_BYTES: usize = 1 << 20;

/// Collects bytes and gives them back as programs.
#[derive(Debug, Default)]
pub(super) struct ScriptReader {
    bytes: Vec<u8>,
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
        loop {
            let first = self.line_end(0)?;
            let line = String::from_utf8_lossy(&self.bytes[..first]).into_owned();
            if line.trim().is_empty() {
                self.bytes.drain(..first);
                continue;
            }
            let is_block = line.starts_with("def ") || line.starts_with("sec ");
            let end = if is_block {
                self.block_end(first)?
            } else {
                first
            };
            let program = String::from_utf8_lossy(&self.bytes[..end]).into_owned();
            self.bytes.drain(..end);
            return Some(program);
        }
    }

    /// Where the line that holds `from` ends, its line break included.
    fn line_end(&self, from: usize) -> Option<usize> {
        let length = self.bytes[from..].iter().position(|byte| *byte == b'\n')?;
        Some(from + length + 1)
    }

    /// Where the block ends whose first line ends at `from`.
    fn block_end(&self, mut from: usize) -> Option<usize> {
        loop {
            let end = self.line_end(from)?;
            if self.bytes[from..end].trim_ascii_end() == b"end" {
                return Some(end);
            }
            from = end;
        }
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
