//! Colours: those of Okabe and Ito, which people with any kind of colour vision tell apart.

/// Lines, text and everything in no set: nearly black.
pub const INK: &str = "#1f2328";
/// Axis labels and remarks.
pub const SOFT: &str = "#57606a";
/// Grids.
pub const GRID: &str = "#e4e7eb";
/// Frames and ticks.
pub const FRAME: &str = "#8c959f";
/// Limits and their forbidden side.
pub const LIMIT: &str = "#57606a";
/// Faults.
pub const ALARM: &str = "#b3261e";

/// The axes of a frame: x, y and z.
pub const AXES: [&str; 3] = ["#d1242f", "#1a7f37", "#0550ae"];
/// The same in the paper's Figure 5.
pub const AXES_OF_PAPER: [&str; 3] = [AXES[1], AXES[2], AXES[0]];

/// The yellow of Okabe and Ito is left out: on white it is too faint for a line.
const OKABE_ITO: [&str; 6] = [
    "#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00", "#56B4E9",
];
/// What comes after the colours that can be told apart.
const FURTHER: &str = "#8a8a8a";
const DASHES: [&str; 4] = ["", "5 2.5", "1.5 2", "7 2 1.5 2"];

/// Colour of the `nth` mode with an active set.
pub fn mode(nth: usize) -> &'static str {
    OKABE_ITO.get(nth).copied().unwrap_or(FURTHER)
}

/// Colour and dashes of the `nth` of many lines in one chart.
pub fn line(nth: usize) -> (&'static str, &'static str) {
    let colours = OKABE_ITO.len() + 2;
    let colour = match nth % colours {
        6 => INK,
        7 => FURTHER,
        other => OKABE_ITO[other],
    };
    (colour, DASHES[nth / colours % DASHES.len()])
}
