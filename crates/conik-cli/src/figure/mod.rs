//! The figures of a run: the panels of the paper's Figure 4, each as an SVG, from a run folder.
//!
//! [`write_all`] is what `conik plot DIR` does. A panel is a [`Picture`](svg::Picture): `path`,
//! `arm` where the robot is known, `mode`, `sets`, `errors`, `joints`, `cycles` of a robot, and `figure4` with those of the paper. Colour stands for one thing
//! everywhere, the mode. The same run gives the same bytes. How a page is made of them is
//! [`report`](crate::report).

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

pub mod arm;
mod arm_parts;
pub mod axis;
mod callouts;
pub mod camera;
pub mod chart;
mod cone;
pub mod curve;
pub mod cycles;
pub mod depth;
pub mod errors;
pub mod figure4;
mod floor;
mod grid;
pub mod ink;
pub mod joints;
pub mod lettering;
pub mod markup;
pub mod mode;
mod moments;
pub mod obstacles;
pub mod palette;
pub mod path;
pub mod placement;
pub mod quantity;
pub mod run;
pub mod scene;
pub mod sets;
pub mod shading;
pub mod solid;
pub mod stage;
pub mod svg;
pub mod viewpoint;
pub mod wall;

pub use run::{Run, RunError};

/// Width of a panel that stands alone [px].
const WIDTH: f64 = 760.0;

/// Draws the figures of the run in the folder `dir` into it and returns their paths.
pub fn write_all(dir: &Path) -> Result<Vec<PathBuf>, FigureError> {
    let run = Run::load(dir)?;
    let pictures = [
        ("path.svg", path::panel(&run, 620.0, 560.0)),
        ("mode.svg", mode::panel(&run, WIDTH)),
        ("sets.svg", sets::panel(&run, WIDTH)),
        ("errors.svg", errors::panel(&run, WIDTH)),
        ("joints.svg", joints::panel(&run, WIDTH)),
        ("figure4.svg", figure4::picture(&run)),
    ];
    let arm = arm::panel(&run, 680.0, 600.0).map(|picture| ("arm.svg", picture));
    let cycles = cycles::panel(&run, WIDTH).map(|picture| ("cycles.svg", picture));
    let mut written = Vec::new();
    for (name, picture) in pictures.into_iter().chain(arm).chain(cycles) {
        let path = dir.join(name);
        match fs::write(&path, picture.to_file()) {
            Ok(()) => written.push(path),
            Err(source) => return Err(FigureError::Write { path, source }),
        }
    }
    Ok(written)
}

/// Why the figures of a run could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The run folder cannot be read.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A picture cannot be written.
    #[error("{}: cannot be written", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: io::Error,
    },
}
