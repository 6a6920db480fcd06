//! The built page.

/// One file with everything in it: style, script, picture of the tab.
pub const PAGE: &str = include_str!("../../../../viewer/dist/index.html");
