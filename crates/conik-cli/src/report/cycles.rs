//! How the cycles of a robot came and were answered.

use conik_sim::cycle_times::CycleSummary;

use super::scrolling_card;
use crate::figure::lettering::number;
use crate::figure::{Run, cycles};

/// The section of the page; nothing of a run on an arm without a clock of its own.
pub fn section(run: &Run) -> String {
    let (Some(summary), Some(panel)) = (&run.summary().cycles, cycles::panel(run, 860.0)) else {
        return String::new();
    };
    let CycleSummary {
        period_us,
        answer_us,
        missed,
        repeated,
    } = summary;
    let answers = answer_us.as_ref().map_or(String::new(), |answer| {
        format!(
            ", and the reference was written {} µs after its package (median; 999 of 1000 within \
             {} µs, the slowest {} µs)",
            number(answer.median, 3),
            number(answer.p999, 3),
            number(answer.max, 3),
        )
    });
    format!(
        "<section>\n<h2>Cycles of the arm</h2>\n<p>A package came every {} µs (median; 999 of \
         1000 within {} µs, the longest {} µs){answers}. {missed} cycles were missed, {repeated} \
         repeated.</p>\n{}</section>\n",
        number(period_us.median, 4),
        number(period_us.p999, 4),
        number(period_us.max, 4),
        scrolling_card(&panel),
    )
}
