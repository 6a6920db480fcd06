//! Writes `log.csv`.

use std::fs::{File, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use conik::{ActiveSet, ModeOrder, Reason, Stack};

use crate::columns::Columns;
use crate::record::Record;

/// Rows after which what is buffered goes to the file, so that a killed run leaves its log.
const ROWS_BETWEEN_FLUSHES: u64 = 128;

/// Writes the rows of `log.csv` as they come. As long as it lives, no other can write the same file.
#[derive(Debug)]
pub struct LogWriter {
    path: PathBuf,
    file: BufWriter<File>,
    head: Head,
    rows: u64,
}

/// What the rows need to know of the experiment.
#[derive(Debug)]
struct Head {
    mode_order: ModeOrder,
    task_names: Vec<String>,
    columns: Vec<String>,
    /// The active set of the last row, as it is printed: modes change seldom, their numbers are
    /// not free.
    last_mode: Option<(ActiveSet, String)>,
}

/// A log that could not be written.
#[derive(Debug, thiserror::Error)]
pub enum LogWriteError {
    /// The file cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Another writer has the file.
    #[error("another run is writing to {}", folder.display())]
    Busy {
        /// The folder in which the log is.
        folder: PathBuf,
    },
}

impl LogWriter {
    /// Begins a log at `path`; whatever was there is replaced, unless another run is writing it.
    pub fn create(path: &Path, stack: &Stack) -> Result<Self, LogWriteError> {
        let io = |source| LogWriteError::Io {
            path: path.to_owned(),
            source,
        };
        let file = File::options()
            .write(true)
            .create(true)
            .truncate(false) // not before the lock
            .open(path)
            .map_err(io)?;
        // A device has neither a length nor one owner.
        if file.metadata().map_err(io)?.is_file() {
            lock(&file, path)?;
            file.set_len(0).map_err(io)?;
        }
        Ok(Self {
            path: path.to_owned(),
            file: BufWriter::with_capacity(1 << 16, file),
            head: Head {
                mode_order: ModeOrder::new(stack),
                task_names: stack
                    .iter()
                    .map(|(_, level)| level.name().to_owned())
                    .collect(),
                columns: Columns::new(stack).names(stack),
                last_mode: None,
            },
            rows: 0,
        })
    }

    /// Adds one row.
    pub fn write(&mut self, record: &Record) -> Result<(), LogWriteError> {
        self.try_write(record).map_err(|source| self.error(source))
    }

    /// Brings everything to the file.
    pub fn finish(&mut self) -> Result<(), LogWriteError> {
        self.file
            .flush()
            .and_then(|()| self.file.get_ref().sync_all())
            .map_err(|source| self.error(source))
    }

    fn error(&self, source: io::Error) -> LogWriteError {
        LogWriteError::Io {
            path: self.path.clone(),
            source,
        }
    }

    fn try_write(&mut self, record: &Record) -> io::Result<()> {
        if self.rows == 0 {
            self.head.write_header(&mut self.file, record)?;
        }
        self.head.write_row(&mut self.file, record)?;
        self.rows += 1;
        if self.rows.is_multiple_of(ROWS_BETWEEN_FLUSHES) {
            self.file.flush()?;
        }
        Ok(())
    }
}

/// Takes the file for this writer alone. Where the file system knows no locks, nothing is taken.
fn lock(file: &File, path: &Path) -> Result<(), LogWriteError> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(LogWriteError::Busy {
            folder: path.parent().unwrap_or(path).to_owned(),
        }),
        Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
    }
}

impl Head {
    fn write_header(&self, out: &mut impl Write, first: &Record) -> io::Result<()> {
        write!(out, "t_s,mode,active,waypoint")?;
        for column in &self.columns {
            write!(out, ",{column}")?;
        }
        write!(out, ",tool_x_m,tool_y_m,tool_z_m")?;
        let measured = first.q_measured.map(|_| ("q", "_measured_rad"));
        let groups = [("q", "_rad"), ("qd", "_rad_s"), ("qdd", "_rad_s2")];
        for (name, unit) in groups.into_iter().chain(measured) {
            for joint in 1..=first.q.len() {
                write!(out, ",{name}{joint}{unit}")?;
            }
        }
        writeln!(out, ",why")
    }

    fn write_row(&mut self, out: &mut impl Write, record: &Record) -> io::Result<()> {
        let mode = match self.last_mode.take() {
            Some((active, printed)) if active == record.active => printed,
            _ => self.print_mode(&record.active),
        };
        write!(out, "{:?},{mode},{}", record.t_s, record.waypoint)?;
        self.last_mode = Some((record.active, mode));
        // `{:?}` is the shortest form that reads back as the same number.
        for value in record.task_values.iter().chain(&record.tool.to_array()) {
            write!(out, ",{value:?}")?;
        }
        for joints in [
            Some(record.q),
            Some(record.qd),
            Some(record.qdd),
            record.q_measured,
        ] {
            for value in joints.iter().flat_map(|joints| joints.iter()) {
                write!(out, ",{value:?}")?;
            }
        }
        for (nth, reason) in record.reasons.iter().enumerate() {
            out.write_all(if nth == 0 { b"," } else { b"+" })?;
            self.write_code(out, reason)?;
        }
        let end = if record.reasons.is_empty() {
            ",\n"
        } else {
            "\n"
        };
        out.write_all(end.as_bytes())
    }

    /// What [`Reason::code`] is, without the stack, which the controller has.
    fn write_code(&self, out: &mut impl Write, reason: &Reason) -> io::Result<()> {
        out.write_all(reason.word().as_bytes())?;
        if let Some(task) = reason.task() {
            write!(out, ":{}", self.task_names[task.index()])?;
        }
        if let Some(joint) = reason.joint() {
            write!(out, ":q{}", joint + 1)?;
        }
        Ok(())
    }

    /// `number,names`.
    fn print_mode(&self, active: &ActiveSet) -> String {
        let number = self
            .mode_order
            .number(active)
            .map_or(String::new(), |n| n.to_string());
        let names: Vec<&str> = active
            .iter()
            .map(|task| self.task_names[task.index()].as_str())
            .collect();
        format!("{number},{}", names.join("+"))
    }
}
