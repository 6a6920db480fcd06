//! `conik init`: a commented scenario to start from.

use std::fs::OpenOptions;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use crate::arguments::InitArguments;
use crate::failure::Failure;

/// Writes the template.
pub fn init(arguments: &InitArguments) -> Result<ExitCode, Failure> {
    let (path, template) = (&arguments.path, conik_sim::scenario::template());
    if path == Path::new("-") {
        return super::print(template);
    }
    write(path, template, arguments.force).map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => Failure::input(format!(
            "{} is there already; give another name, or --force to replace it",
            path.display()
        )),
        _ => Failure::input(format!("cannot write {}: {error}", path.display())),
    })?;
    super::print(&format!(
        "wrote {0}\nnow: conik check {0}, then conik run {0}\n",
        path.display()
    ))
}

fn write(path: &Path, text: &str, replace: bool) -> io::Result<()> {
    let mut options = OpenOptions::new();
    if replace {
        options.create(true).truncate(true);
    } else {
        options.create_new(true);
    }
    options.write(true).open(path)?.write_all(text.as_bytes())
}
