//! What the command `conik` shows of a run: its figures, its report and its page.
pub mod export;
pub mod figure;
pub mod report;
pub mod tui;
pub mod view;
