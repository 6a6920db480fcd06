//! Panel: positions and velocities of the joints over time.

use super::axis::{Axis, range};
use super::chart::{Chart, LABEL, Layout};
use super::curve::decimate;
use super::ink::{Lettering, Stroke};
use super::lettering;
use super::palette;
use super::quantity;
use super::run::Run;
use super::svg::{Marks, Picture};

/// Room for a line of the legend [px].
const LEGEND_LINE: f64 = 18.0;

/// Joint positions beside joint velocities, and whose curve is whose.
pub fn panel(run: &Run, width: f64) -> Picture {
    let layout = Layout::alone(width / 2.0, 230.0);
    let positions = chart(
        run,
        &run.log().numbered("q", "_rad"),
        "joint positions",
        &format!("position [{}]", run.joint_unit("")),
        layout,
    );
    let velocities = chart(
        run,
        &run.log().numbered("qd", "_rad_s"),
        "joint velocities",
        &format!("velocity [{}]", run.joint_unit("/s")),
        layout,
    );
    let mut marks = Marks::default();
    marks.place((0.0, 0.0), &positions);
    marks.place((layout.width, 0.0), &velocities);
    let height = legend(run, &mut marks, layout.height + 14.0, width);
    Picture {
        width,
        height,
        title: "Joint positions and joint velocities over time".to_owned(),
        marks,
    }
}

/// The curves of one quantity of every joint.
pub fn chart(run: &Run, joints: &[&[f64]], title: &str, label: &str, layout: Layout) -> Picture {
    let ranges = joints.iter().map(|values| range(values.iter().copied()));
    let (low, high) = range(ranges.flat_map(|(low, high)| [low, high]));
    let mut chart = Chart::new(layout, title, label, run, Axis::around(low, high, 5));
    for (nth, values) in joints.iter().enumerate() {
        let (colour, dashes) = palette::line(nth);
        let points = decimate(run.log().time_s(), values, chart.resolution());
        let places = chart.places(&points);
        chart
            .marks
            .polyline(&places, Stroke::dashed(colour, 1.5, dashes));
        if let [at] = places[..] {
            chart.dot(at);
        }
    }
    chart.finish(&format!("{title} over time"))
}

/// Draws the legend from `top` on and returns where it ends.
fn legend(run: &Run, marks: &mut Marks, top: f64, width: f64) -> f64 {
    let (mut x, mut y) = (58.0, top);
    for nth in 0..run.log().numbered("q", "_rad").len() {
        let name = lettering::shorten(&quantity::joint_name(run, nth + 1), LABEL, 150.0);
        let needed = 24.0 + lettering::width(&name, LABEL) + 16.0;
        if x + needed > width && x > 58.0 {
            x = 58.0;
            y += LEGEND_LINE;
        }
        let (colour, dashes) = palette::line(nth);
        marks.polyline(
            &[(x, y), (x + 20.0, y)],
            Stroke::dashed(colour, 2.0, dashes),
        );
        marks.text(
            (x + 25.0, y + 4.0),
            &name,
            Lettering::new(LABEL, palette::INK),
        );
        x += needed;
    }
    y + LEGEND_LINE
}
