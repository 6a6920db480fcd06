//! The paper's examples against trajectories that an independent program computed from the paper's
//! equations alone: joint angles to 1e-9 rad over 60 s, mode changes to the sample.

mod paper;

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use conik::{ModeOrder, Settings};
use paper::Example;

/// Largest allowed difference of a joint angle [rad].
const TOLERANCE: f64 = 1e-9;

/// One run of an independent program.
#[derive(Default)]
struct Reference {
    /// (time [s], joint angles [rad])
    samples: Vec<(f64, [f64; 6])>,
    /// (time [s], mode as the paper numbers it)
    modes: Vec<(f64, u64)>,
}

/// Runs an example and holds every sample and every mode change against the reference.
fn assert_agrees(number: u8, q0: [f64; 6], reference: &Reference) {
    let mut example = Example::new(number, q0, Settings::of_the_paper());
    let order = ModeOrder::new(example.controller.stack());
    let mut samples = reference.samples.iter().peekable();
    let mut modes = Vec::new();
    for k in 0..=7500 {
        let (t, q) = (f64::from(k) / 125.0, example.q);
        let active = example.tick().active;
        let mode = order.number(&active).expect("few modes");
        if modes.last().is_none_or(|&(_, last)| last != mode) {
            modes.push((t, mode));
        }
        if let Some((_, expected)) = samples.next_if(|(at, _)| (at - t).abs() < 1e-6) {
            for (joint, (q, expected)) in q.iter().zip(expected).enumerate() {
                assert!(
                    (q - expected).abs() <= TOLERANCE,
                    "example {number}, {t} s, joint {joint}: {q} instead of {expected}"
                );
            }
        }
    }
    assert!(samples.peek().is_none(), "every sample was compared");
    assert_eq!(modes.len(), reference.modes.len(), "{modes:?}");
    for ((t, mode), (expected_t, expected_mode)) in modes.iter().zip(&reference.modes) {
        assert_eq!(mode, expected_mode);
        assert!(
            (t - expected_t).abs() < 1e-6,
            "mode {mode} from {t} instead of {expected_t} s"
        );
    }
}

fn start(name: &str) -> [f64; 6] {
    match name {
        "thesis" => paper::thesis(),
        "fitted" => paper::fitted(),
        other => panic!("unknown start {other}"),
    }
}

/// Lines `example,start,q,t,q1..q6` and `example,start,mode,t,number`.
fn fixture() -> HashMap<(u8, String), Reference> {
    let mut runs: HashMap<(u8, String), Reference> = HashMap::new();
    for line in include_str!("fixtures/paper_reference.csv").lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let number = |i: usize| -> f64 { fields[i].parse().expect("a number") };
        let run = runs
            .entry((fields[0].parse().expect("1 to 3"), fields[1].to_owned()))
            .or_default();
        match fields[2] {
            "q" => run
                .samples
                .push((number(3), std::array::from_fn(|i| number(4 + i)))),
            _ => run
                .modes
                .push((number(3), fields[4].parse().expect("a mode"))),
        }
    }
    runs
}

#[test]
fn committed_samples_agree_in_all_examples_from_both_starts() {
    let runs = fixture();
    assert_eq!(runs.len(), 6);
    for ((number, name), reference) in &runs {
        assert!(reference.samples.len() > 10);
        assert_agrees(*number, start(name), reference);
    }
}

/// A folder of `exampleN_START.csv` files, each with the columns of `README.md` there, where the
/// environment variable `CONIK_REFERENCE` names one.
#[test]
fn a_whole_reference_folder_agrees_where_one_is_named() {
    let Some(folder) = std::env::var_os("CONIK_REFERENCE") else {
        eprintln!("CONIK_REFERENCE is not set: only the committed fixture is compared");
        return;
    };
    let mut runs = fixture();
    for ((number, name), committed) in &mut runs {
        let path = Path::new(&folder).join(format!("example{number}_{name}.csv"));
        let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let reference = Reference {
            samples: read_samples(&text),
            modes: std::mem::take(&mut committed.modes),
        };
        assert_eq!(reference.samples.len(), 301, "{}", path.display());
        assert_agrees(*number, start(name), &reference);
    }
}

fn read_samples(text: &str) -> Vec<(f64, [f64; 6])> {
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let first = header
        .iter()
        .position(|&name| name == "q1")
        .expect("joint columns");
    lines
        .map(|line| {
            let fields: Vec<f64> = line
                .split(',')
                .map(|f| f.parse().expect("a number"))
                .collect();
            (fields[0], std::array::from_fn(|i| fields[first + i]))
        })
        .collect()
}
