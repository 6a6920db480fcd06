//! The figures of a run: the panels of the paper's Figure 4, and its Figure 5, as SVG and PNG, from a run
//! folder.
//!
//! [`write_all`] is what `conik plot DIR` does. A panel is a [`Picture`](svg::Picture): `path`, `mode`,
//! `sets`, `errors`, `joints`, `figure4` with those of the paper, `arm` and `figure5` where the robot is
//! known, and `cycles` of a robot. Colour stands for one thing everywhere, the mode. The same run gives the
//! same bytes. How a page is made of them is [`report`](crate::report).

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
pub mod figure5;
mod floor;
mod frame;
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
pub mod png;
mod posed;
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

pub use png::{PaintError, Painter, Resolution};
pub use run::{Run, RunError};

/// Width of a panel that stands alone [px].
const WIDTH: f64 = 760.0;

/// What is made of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Whether each figure is an SVG file.
    pub svg: bool,
    /// How large each figure is as a PNG file, if it is one.
    pub png: Option<Resolution>,
    /// The times at which the arm is shown [s]; without any, telling ones.
    pub at_s: Vec<f64>,
}

impl Default for Wanted {
    /// Each figure as SVG, and as PNG with two pixels for one.
    fn default() -> Self {
        Self {
            svg: true,
            png: Some(Resolution::Scale(2.0)),
            at_s: Vec::new(),
        }
    }
}

/// Draws the figures of the run in the folder `dir` into it and returns their paths.
pub fn write_all(dir: &Path, wanted: &Wanted) -> Result<Vec<PathBuf>, FigureError> {
    let run = Run::load(dir)?;
    check_times(&run, &wanted.at_s)?;
    let at_s = &wanted.at_s[..];
    let pictures = [
        ("path", path::panel(&run, 620.0, 560.0)),
        ("mode", mode::panel(&run, WIDTH)),
        ("sets", sets::panel(&run, WIDTH)),
        ("errors", errors::panel(&run, WIDTH)),
        ("joints", joints::panel(&run, WIDTH)),
        ("figure4", figure4::picture(&run)),
    ];
    let arm = arm::panel(&run, at_s, 680.0, 600.0).map(|picture| ("arm", picture));
    let figure5 = figure5::picture(&run, at_s).map(|picture| ("figure5", picture));
    if arm.is_none() && !at_s.is_empty() {
        return Err(FigureError::NoArm);
    }
    let cycles = cycles::panel(&run, WIDTH).map(|picture| ("cycles", picture));
    let pictures = pictures.into_iter().chain(arm).chain(figure5).chain(cycles);
    let painter = Painter::default();
    let mut written = Vec::new();
    let mut write = |name: &str, bytes: &[u8]| {
        let path = dir.join(name);
        match fs::write(&path, bytes) {
            Ok(()) => {
                written.push(path);
                Ok(())
            }
            Err(source) => Err(FigureError::Write { path, source }),
        }
    };
    for (name, picture) in pictures {
        let svg = picture.to_file();
        if wanted.svg {
            write(&format!("{name}.svg"), svg.as_bytes())?;
        }
        if let Some(resolution) = wanted.png {
            let name = format!("{name}.png");
            let bytes = painter.paint(&svg, resolution).map_err(|source| {
                let path = dir.join(&name);
                FigureError::Paint { path, source }
            })?;
            write(&name, &bytes)?;
        }
    }
    Ok(written)
}

fn check_times(run: &Run, at_s: &[f64]) -> Result<(), FigureError> {
    let times = run.log().time_s();
    let (Some(&begin_s), Some(&end_s)) = (times.first(), times.last()) else {
        return Ok(());
    };
    if at_s.len() > figure5::MOST {
        return Err(FigureError::ManyTimes { count: at_s.len() });
    }
    // As good as any row's, and never a NaN.
    let is_outside = |t_s: &&f64| !(begin_s - 1e-9..=end_s + 1e-9).contains(*t_s);
    match at_s.iter().find(is_outside) {
        Some(&t_s) => Err(FigureError::Outside {
            t_s,
            begin_s,
            end_s,
        }),
        None => Ok(()),
    }
}

/// Why the figures of a run could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The run folder cannot be read.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The arm was to be shown at a time outside the run.
    #[error("at {t_s} s there was no arm: the run went from {begin_s} s to {end_s} s")]
    Outside {
        /// The time [s].
        t_s: f64,
        /// That of the first row [s].
        begin_s: f64,
        /// That of the last row [s].
        end_s: f64,
    },
    /// The arm was to be shown at so many times that nothing would be seen.
    #[error(
        "{count} times are too many for one picture; give at most {}",
        figure5::MOST
    )]
    ManyTimes {
        /// How many.
        count: usize,
    },
    /// The arm was to be shown, and nobody knows what it looks like.
    #[error(
        "the arm cannot be shown: the robot of this run is not known, or its log does not have its joints"
    )]
    NoArm,
    /// A picture cannot be painted.
    #[error("{}: cannot be painted", path.display())]
    Paint {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        source: PaintError,
    },
    /// A picture cannot be written.
    #[error("{}: cannot be written", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: io::Error,
    },
}
