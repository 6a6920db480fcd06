//! Packages cut out of a byte stream, however the network has segmented it.

use super::WireError;

/// Bytes of a header: a 16-bit size, header included, and the type.
pub const HEADER_SIZE: usize = 3;

/// The largest contents that a 16-bit size leaves room for.
pub const MAX_PAYLOAD: usize = u16::MAX as usize - HEADER_SIZE;

/// One package, its contents not yet read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// The type byte.
    pub kind: u8,
    /// The bytes after the header.
    pub payload: Vec<u8>,
}

impl Frame {
    /// The package as it goes over the wire.
    pub fn to_bytes(&self) -> Result<Vec<u8>, WireError> {
        let size = HEADER_SIZE + self.payload.len();
        let header = u16::try_from(size).map_err(|_| WireError::Oversize {
            size,
            limit: HEADER_SIZE + MAX_PAYLOAD,
        })?;
        let mut bytes = Vec::with_capacity(size);
        bytes.extend_from_slice(&header.to_be_bytes());
        bytes.push(self.kind);
        bytes.extend_from_slice(&self.payload);
        Ok(bytes)
    }
}

/// Collects bytes in any portions and gives them back as whole packages.
///
/// Never holds more than one incomplete package and what was pushed after it.
#[derive(Clone, Debug, Default)]
pub struct FrameReader {
    bytes: Vec<u8>,
    /// Bytes at the front that were already given out.
    taken: usize,
}

impl FrameReader {
    /// A reader at the start of a stream.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds bytes as they came in.
    pub fn push(&mut self, bytes: &[u8]) {
        self.bytes.drain(..self.taken);
        self.taken = 0;
        self.bytes.extend_from_slice(bytes);
    }

    /// The next whole package, if there is one.
    ///
    /// A framing error is final: the place where the next package starts is unknown, so every
    /// later call reports the same.
    pub fn next_frame(&mut self) -> Result<Option<Frame>, WireError> {
        let waiting = &self.bytes[self.taken..];
        let &[high, low, kind, ref rest @ ..] = waiting else {
            // Two bytes may already tell that framing is lost; no need to wait for the third.
            if let &[high, low] = waiting {
                check_size(u16::from_be_bytes([high, low]))?;
            }
            return Ok(None);
        };
        let size = check_size(u16::from_be_bytes([high, low]))?;
        let Some(payload) = rest.get(..size - HEADER_SIZE) else {
            return Ok(None);
        };
        let payload = payload.to_vec();
        self.taken += size;
        Ok(Some(Frame { kind, payload }))
    }
}

fn check_size(size: u16) -> Result<usize, WireError> {
    if usize::from(size) < HEADER_SIZE {
        return Err(WireError::Framing(size));
    }
    Ok(usize::from(size))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(kind: u8, payload: &[u8]) -> Frame {
        Frame {
            kind,
            payload: payload.to_vec(),
        }
    }

    #[test]
    fn packages_come_out_whole_however_the_bytes_come_in() {
        let frames = [
            frame(b'V', &[0, 2]),
            frame(b'S', &[]),
            frame(b'U', &[7; 300]),
        ];
        let stream: Vec<u8> = frames
            .iter()
            .flat_map(|frame| frame.to_bytes().unwrap())
            .collect();
        for portion in [1, 2, 3, 5, 64, stream.len()] {
            let mut reader = FrameReader::new();
            let mut seen = Vec::new();
            for bytes in stream.chunks(portion) {
                reader.push(bytes);
                while let Some(frame) = reader.next_frame().unwrap() {
                    seen.push(frame);
                }
            }
            assert_eq!(seen, frames, "in portions of {portion}");
        }
    }

    #[test]
    fn a_size_below_the_header_is_lost_framing_for_good() {
        let mut reader = FrameReader::new();
        reader.push(&[0, 2]);
        assert_eq!(reader.next_frame(), Err(WireError::Framing(2)));
        reader.push(&frame(b'S', &[1]).to_bytes().unwrap());
        assert_eq!(reader.next_frame(), Err(WireError::Framing(2)));
    }

    #[test]
    fn the_largest_package_fits_and_one_byte_more_is_refused() {
        let largest = frame(b'U', &vec![1; MAX_PAYLOAD]);
        let mut reader = FrameReader::new();
        reader.push(&largest.to_bytes().unwrap());
        assert_eq!(reader.next_frame().unwrap(), Some(largest));
        let error = frame(b'U', &vec![1; MAX_PAYLOAD + 1])
            .to_bytes()
            .unwrap_err();
        assert_eq!(
            error,
            WireError::Oversize {
                size: 65536,
                limit: 65535
            }
        );
    }
}
