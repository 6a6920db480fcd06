//! Where in the file something stands: the dotted path of a key and its bytes in the text.

use std::ops::Range;

/// A key's name as it must be written in TOML: bare if it can be.
fn written(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !name.is_empty() && name.chars().all(bare) && name.len() <= 64 {
        name.to_owned()
    } else {
        super::mistake::quoted(name)
    }
}

/// Path of a key in a table; the file itself has the empty path.
pub(super) fn join(table: &str, name: &str) -> String {
    if table.is_empty() {
        written(name)
    } else {
        format!("{table}.{}", written(name))
    }
}

/// Path of a member of a list, by its 0-based index: paths count from 1, as people do.
pub(super) fn member(list: &str, index: usize) -> String {
    format!("{list}[{}]", index + 1)
}

/// A value and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Placed<T> {
    pub(super) value: T,
    pub(super) span: Range<usize>,
    pub(super) path: String,
}
