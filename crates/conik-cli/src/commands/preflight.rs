//! `conik preflight`: measures this computer and the link to a controller before anything moves.

use std::ops::RangeInclusive;
use std::process::ExitCode;
use std::thread;

use conik_ur::driver::UrConfig;
use conik_ur::driver::identity::not_asked;
use conik_ur::driver::preflight::{Preflight, Verdict, preflight as look};
use conik_ur::realtime::Realtime;
use conik_ur::timing::{Spread, Timing};

use crate::arguments::PreflightArguments;
use crate::failure::Failure;
use crate::layout::{table, wrapped};

/// Rates that some controller might run at [Hz].
const RATES_HZ: RangeInclusive<f64> = 1.0..=1000.0;

/// Looks at the controller for a while and says what it saw.
pub fn preflight(arguments: &PreflightArguments) -> Result<ExitCode, Failure> {
    let PreflightArguments {
        host,
        seconds,
        rate_hz,
        port_offset,
    } = arguments;
    if !(0.1..=86_400.0).contains(seconds) {
        return Err(Failure::input(format!(
            "--seconds {seconds}: from 0.1 to 86400"
        )));
    }
    if let Some(rate_hz) = rate_hz
        && !RATES_HZ.contains(rate_hz)
    {
        return Err(Failure::input(format!(
            "--rate-hz {rate_hz}: from {} to {} Hz",
            RATES_HZ.start(),
            RATES_HZ.end()
        )));
    }
    let mut config = UrConfig::new(host);
    config.check_host().map_err(Failure::input)?;
    config.offset_ports(*port_offset).map_err(Failure::input)?;
    let stop = super::run::stop_on_ctrl_c()?;
    // As the thread that drives an arm.
    let (realtime, found) = thread::scope(|scope| {
        let looker = scope.spawn(|| (Realtime::enter(), look(&config, *rate_hz, *seconds, &stop)));
        match looker.join() {
            Ok(found) => found,
            Err(panic) => std::panic::resume_unwind(panic),
        }
    });
    let found = found.map_err(Failure::run)?;
    super::print(&in_words(host, &realtime, &found))?;
    Ok(match found.verdict() {
        Verdict::Fit | Verdict::Doubtful => ExitCode::SUCCESS,
        Verdict::Unfit => ExitCode::FAILURE,
    })
}

fn in_words(host: &str, realtime: &Realtime, found: &Preflight) -> String {
    let Timing {
        packages,
        missed,
        passed_over,
        repeated,
        drift_ppm,
        ..
    } = &found.timing;
    let pose: Vec<String> = found.q.iter().map(|q| format!("{q:.4}")).collect();
    let ready = match &found.hindrance {
        None => "a run could start".to_owned(),
        Some(fault) => format!("no run could start: {fault}"),
    };
    let head = format!(
        "{host}: {}, software {}\n{}{}joints at {} rad\n{}",
        name(found),
        found.version,
        dashboard(found),
        wrapped("", &ready),
        pose.join(", "),
        wrapped("", &format!("this thread: {realtime}")),
    );
    let rows = [
        ["", "least", "median", "99 %", "99.9 %", "most"].map(str::to_owned),
        row("period [µs]", &found.timing.period_us),
        row("lateness [µs]", &found.timing.lateness_us),
    ];
    let counts = format!(
        "{packages} packages at {} Hz; {missed} cycles missed ({passed_over} came too late), \
         {repeated} repeated; clocks drift {drift_ppm:.1} ppm apart",
        found.rate_hz
    );
    format!(
        "{head}\n{}\n{}\n  {counts}\n\n{}",
        table(&rows),
        histogram(&found.timing),
        advice(found, realtime)
    )
}

/// `UR5 (CB3)`; without an answer from the dashboard `UR CB3`.
fn name(found: &Preflight) -> String {
    let model = found.identity.as_ref().ok();
    match model.and_then(|identity| identity.model.as_deref()) {
        Some(model) => format!("{model} ({})", found.series),
        None => format!("UR {}", found.series),
    }
}

/// What the dashboard says besides; nothing where a CB3 has nothing to say.
fn dashboard(found: &Preflight) -> String {
    match &found.identity {
        Ok(identity) => match identity.in_remote_control {
            Some(true) => "in remote control\n".to_owned(),
            Some(false) => "in local control\n".to_owned(),
            None => String::new(),
        },
        Err(fault) => wrapped("", &not_asked(fault)),
    }
}

fn row(name: &str, spread: &Spread) -> [String; 6] {
    let Spread {
        min,
        median,
        p99,
        p999,
        max,
    } = spread;
    let [min, median, p99, p999, max] = [min, median, p99, p999, max].map(|us| format!("{us:.0}"));
    [name.to_owned(), min, median, p99, p999, max]
}

/// How many packages were how late.
fn histogram(timing: &Timing) -> String {
    let bounds = Timing::BOUNDS_US;
    let names = bounds
        .iter()
        .map(|bound| format!("to {bound} µs"))
        .chain([format!("above {} µs", bounds[bounds.len() - 1])]);
    let rows: Vec<[String; 3]> = names
        .zip(timing.histogram)
        .filter(|(_, count)| *count > 0)
        .map(|(name, count)| {
            let share = 100.0 * count as f64 / timing.packages as f64;
            [name, count.to_string(), format!("{share:.2} %")]
        })
        .collect();
    table(&rows)
}

fn advice(found: &Preflight, realtime: &Realtime) -> String {
    let bridged_ms = 1e3 * f64::from(found.bridged_cycles) / found.rate_hz;
    let (verdict, try_this) = match found.verdict() {
        Verdict::Fit => {
            return "fit: every package came within its cycle.\n".to_owned();
        }
        Verdict::Doubtful => (
            format!(
                "doubtful: cycles would be bridged with the last velocity, up to {bridged_ms:.0} ms \
                 of them."
            ),
            "the arm would follow, less smoothly",
        ),
        Verdict::Unfit => (
            format!(
                "not fit: a package was more than {bridged_ms:.0} ms late, and the servo program \
                 would have stopped the arm."
            ),
            "a run at this rate would end",
        ),
    };
    let mut advice = wrapped("", &format!("{verdict} As it is, {try_this}. What helps:"));
    let mut add = |what: &str| advice += &wrapped("- ", what);
    if !realtime.is_granted() {
        add("allow real-time priority and locked memory, as said above");
    }
    if found.timing.lateness_us.median > 250.0 {
        add("a cable without a switch, no wireless link");
    }
    add(
        "a kernel with PREEMPT_RT, the processor's frequency fixed, no other load on this computer",
    );
    add(&format!("a lower rate: --rate-hz {}", found.rate_hz / 2.0));
    advice
}
