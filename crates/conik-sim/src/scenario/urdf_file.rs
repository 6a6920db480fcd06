//! Reading the file of a robot's description.

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

/// A description may be this long; the longest of public ones are a tenth of it.
const MAX_FILE_BYTES: usize = 8_000_000;

/// The text of a URDF file, or what stands in the way: it follows the path, as `:3:7: is not UTF-8 text`.
pub(super) fn read(path: &Path) -> Result<String, String> {
    let unreadable = |error: std::io::Error| format!(": cannot be read: {error}");
    if fs::metadata(path).map_err(unreadable)?.is_dir() {
        return Err(": is a directory".to_owned());
    }
    // The limit holds for devices and pipes too, whose length nobody knows beforehand.
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(unreadable)?;
    file.take(MAX_FILE_BYTES as u64 + 1)
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    if bytes.len() > MAX_FILE_BYTES {
        return Err(format!(": is longer than {MAX_FILE_BYTES} bytes"));
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = valid.split(|byte| *byte == b'\n').count();
        format!(":{line}: is not UTF-8 text from here on: save it as UTF-8")
    })
}
