//! The wire format of protocol buffers, as far as messages here need it.

/// A message being put together. Fields are written whatever their value, so that a zero is seen where
/// a field may be absent.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Message {
    bytes: Vec<u8>,
}

/// What follows a field's number.
enum Wire {
    Varint = 0,
    EightBytes = 1,
    Counted = 2,
    FourBytes = 5,
}

impl Message {
    /// The message so far.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Begins anew; what was allocated stays.
    pub fn clear(&mut self) {
        self.bytes.clear();
    }

    /// A field of type `double`.
    pub fn double(&mut self, field: u32, value: f64) {
        self.tag(field, Wire::EightBytes);
        self.bytes.extend(value.to_le_bytes());
    }

    /// A field of a type of whole numbers that are not negative, an enumeration or a truth value.
    pub fn whole(&mut self, field: u32, value: u64) {
        self.tag(field, Wire::Varint);
        self.varint(value);
    }

    /// A field of type `fixed32`.
    pub fn fixed32(&mut self, field: u32, value: u32) {
        self.tag(field, Wire::FourBytes);
        self.bytes.extend(value.to_le_bytes());
    }

    /// A field of type `string`.
    pub fn text(&mut self, field: u32, value: &str) {
        self.tag(field, Wire::Counted);
        self.varint(value.len() as u64);
        self.bytes.extend(value.as_bytes());
    }

    /// A field that is a message itself, which `fill` fills.
    pub fn message(&mut self, field: u32, fill: impl FnOnce(&mut Self)) {
        self.tag(field, Wire::Counted);
        let start = self.bytes.len();
        fill(self);
        // Its length stands before it, and is known only now.
        let end = self.bytes.len();
        self.varint((end - start) as u64);
        let count = self.bytes.len() - end;
        self.bytes[start..].rotate_right(count);
    }

    fn tag(&mut self, field: u32, wire: Wire) {
        self.varint(u64::from(field) << 3 | wire as u64);
    }

    /// Seven bits a byte, the lowest first; all but the last have the highest bit set.
    fn varint(&mut self, mut value: u64) {
        loop {
            let [lowest, ..] = value.to_le_bytes();
            value >>= 7;
            if value == 0 {
                self.bytes.push(lowest);
                break;
            }
            self.bytes.push(lowest | 0x80);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_written_as_the_format_has_them() {
        let mut message = Message::default();
        message.whole(1, 150);
        message.text(2, "testing");
        message.message(3, |inner| inner.whole(1, 150));
        message.double(16, 1.0);
        message.fixed32(6, 7);
        let expected = [
            &[0x08, 0x96, 0x01][..],
            &[0x12, 0x07],
            b"testing",
            &[0x1a, 0x03, 0x08, 0x96, 0x01],
            &[0x81, 0x01, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f],
            &[0x35, 7, 0, 0, 0],
        ];
        assert_eq!(message.bytes(), expected.concat());
    }

    #[test]
    fn long_messages_within_messages_keep_their_length() {
        let mut message = Message::default();
        let long = "x".repeat(300);
        message.message(1, |outer| outer.message(2, |inner| inner.text(3, &long)));
        let bytes = message.bytes();
        assert_eq!(
            bytes[..9],
            [0x0a, 0xb2, 0x02, 0x12, 0xaf, 0x02, 0x1a, 0xac, 0x02]
        );
        assert_eq!(&bytes[9..], long.as_bytes());
    }
}
