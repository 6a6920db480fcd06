//! `conik export`: a run in the formats of other programs.

use std::fs::{self, File};
use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use conik_cli::export::{ExportError, Exported, Source, Watch, recording, table};

use crate::arguments::{ExportArguments, ExportFormat};
use crate::failure::{Failure, with_causes};
use crate::progress::Share;

/// Where `--out -` leads.
const PIPE: &str = "-";

/// Exit status of a command that Ctrl-C stopped.
const INTERRUPTED: u8 = 130;

/// Writes the files.
pub fn export(arguments: &ExportArguments) -> Result<ExitCode, Failure> {
    let dir = &arguments.dir;
    if dir.is_file() {
        return Err(Failure::input(format!(
            "{} is a file; give the folder that `conik run` wrote for it",
            dir.display()
        )));
    }
    let formats = formats(arguments)?;
    let stop = super::run::stop_on_ctrl_c()?;
    let source = Source::open(dir).map_err(|error| Failure::input(with_causes(&error)))?;
    for format in formats {
        let out = match &arguments.out {
            Some(out) => out.clone(),
            None => dir.join(format!("{}.{}", source.name, format.extension())),
        };
        let share = Share::new(format.extension(), arguments.quiet);
        let done = write(&source, format, &out, &mut |done| {
            share.show(done);
            !stop.load(Ordering::Relaxed)
        });
        share.finish();
        match done {
            Ok(exported) => report(arguments, &out, exported)?,
            Err(ExportError::Stopped) if stopped(&stop) => return Ok(ExitCode::from(INTERRUPTED)),
            // The pipe's other end has what it wanted.
            Err(ExportError::Write(error))
                if out == Path::new(PIPE) && error.kind() == io::ErrorKind::BrokenPipe => {}
            Err(ExportError::Write(error)) => {
                return Err(Failure::input(format!(
                    "cannot write {}: {error}",
                    out.display()
                )));
            }
            Err(error) => return Err(Failure::input(with_causes(&error))),
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn stopped(stop: &AtomicBool) -> bool {
    stop.load(Ordering::Relaxed)
}

/// The formats asked for: those of `--format`, else that of the name after `--out`, else every one.
fn formats(arguments: &ExportArguments) -> Result<Vec<ExportFormat>, Failure> {
    let mut formats = arguments.format.clone();
    formats.sort_unstable();
    formats.dedup();
    let Some(out) = &arguments.out else {
        return Ok(match formats[..] {
            [] => ExportFormat::ALL.to_vec(),
            _ => formats,
        });
    };
    if formats.is_empty() {
        let named = |format: &ExportFormat| out.extension() == Some(format.extension().as_ref());
        formats.extend(ExportFormat::ALL.into_iter().find(named));
    }
    match formats[..] {
        [_] => {}
        [] => {
            return Err(Failure::input(format!(
                "--out {}: in which format? Give --format, or a name that ends in .mcap or .parquet",
                out.display()
            )));
        }
        _ => {
            return Err(Failure::input(
                "--out names one file; give one --format, or leave out --out",
            ));
        }
    }
    if out == Path::new(PIPE) && io::stdout().is_terminal() {
        return Err(Failure::input(
            "--out -: standard output is a terminal, which cannot show the file; lead it into a file or a program",
        ));
    }
    if out.is_dir() {
        return Err(Failure::input(format!(
            "--out {}: this is a folder; give the name of a file",
            out.display()
        )));
    }
    Ok(formats)
}

/// Writes one file in one go: whoever is stopped meanwhile leaves the one before.
fn write(
    source: &Source,
    format: ExportFormat,
    out: &Path,
    watch: Watch,
) -> Result<Exported, ExportError> {
    if out == Path::new(PIPE) {
        let mut pipe = BufWriter::with_capacity(1 << 16, io::stdout());
        let exported = write_to(source, format, &mut pipe, watch)?;
        pipe.flush()?;
        return Ok(exported);
    }
    if fs::metadata(out).is_ok_and(|there| !there.is_file()) {
        // A device has no name that another file could take.
        let mut device = BufWriter::with_capacity(1 << 16, File::options().write(true).open(out)?);
        let exported = write_to(source, format, &mut device, watch)?;
        device.flush()?;
        return Ok(exported);
    }
    let mut name = out.as_os_str().to_owned();
    name.push(".part");
    let part = PathBuf::from(name);
    let mut file = BufWriter::with_capacity(1 << 16, File::create(&part)?);
    let exported = write_to(source, format, &mut file, watch).and_then(|exported| {
        file.flush()?;
        file.get_ref().sync_all()?;
        fs::rename(&part, out)?;
        Ok(exported)
    });
    if exported.is_err() {
        // What is left of it is of no use; if it cannot go either, that changes nothing.
        let _ = fs::remove_file(&part);
    }
    exported
}

fn write_to(
    source: &Source,
    format: ExportFormat,
    out: &mut (impl Write + Send),
    watch: Watch,
) -> Result<Exported, ExportError> {
    match format {
        ExportFormat::Mcap => recording::write(source, out, watch),
        ExportFormat::Parquet => table::write(source, out, watch),
    }
}

fn report(arguments: &ExportArguments, out: &Path, exported: Exported) -> Result<(), Failure> {
    if exported.is_truncated {
        super::warn("the last line of log.csv is cut off and was left out");
    }
    if !arguments.quiet && out != Path::new(PIPE) {
        super::print(&format!("{}\n", out.display()))?;
    }
    Ok(())
}
