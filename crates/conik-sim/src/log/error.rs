//! Why a log could not be read.

use std::io;
use std::path::PathBuf;

use super::rows::LONGEST_LINE;

/// Why a log could not be read.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The file cannot be opened or read.
    #[error("{}: cannot be read", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: io::Error,
    },
    /// A column that every log has is not there.
    #[error("{}:1: there is no column `{column}`; is this the log.csv of a run?", path.display())]
    MissingColumn {
        /// The file.
        path: PathBuf,
        /// The column's name.
        column: &'static str,
    },
    /// Two columns have the same name.
    #[error("{}:1: the column `{column}` is there twice", path.display())]
    RepeatedColumn {
        /// The file.
        path: PathBuf,
        /// The column's name.
        column: String,
    },
    /// A line is longer than that of any log.
    #[error(
        "{}:{line}: this line has more than {LONGEST_LINE} bytes; is this the log.csv of a run?",
        path.display()
    )]
    LongLine {
        /// The file.
        path: PathBuf,
        /// 1-based line.
        line: u64,
    },
    /// A row has more or fewer cells than the header.
    #[error("{}:{line}: {found} cells where the header has {expected}", path.display())]
    Width {
        /// The file.
        path: PathBuf,
        /// 1-based line.
        line: u64,
        /// Cells in the header.
        expected: usize,
        /// Cells in this line.
        found: usize,
    },
    /// A cell is not what its column holds.
    #[error("{}:{line}: column `{column}`: `{cell}` is not {expected}", path.display())]
    Cell {
        /// The file.
        path: PathBuf,
        /// 1-based line.
        line: u64,
        /// Name of the column.
        column: String,
        /// What stands there.
        cell: String,
        /// What should.
        expected: &'static str,
    },
}
