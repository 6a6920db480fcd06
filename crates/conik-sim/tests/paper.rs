//! The committed scenarios of the paper, run on the ideal arm: modes at the samples at which an
//! independent program has them.

use std::sync::atomic::AtomicBool;

use conik_sim::arm::IdealArm;
use conik_sim::experiment::Experiment;
use conik_sim::record::Record;
use conik_sim::run::run;
use conik_sim::scenario::Scenario;
use conik_sim::summary::Outcome;

/// Lines `example,start,mode,t,number` among others.
const REFERENCE: &str = include_str!("../../conik/tests/fixtures/paper_reference.csv");

fn expected_modes(example: usize) -> Vec<(f64, u64)> {
    let prefix = format!("{example},thesis,mode,");
    REFERENCE
        .lines()
        .filter_map(|line| line.strip_prefix(&prefix)?.split_once(','))
        .map(|(t_s, mode)| (t_s.parse().expect("a time"), mode.parse().expect("a mode")))
        .collect()
}

#[test]
fn scenarios_of_the_paper_change_modes_where_the_reference_does() {
    for example in 1..=3 {
        let path = format!(
            "{}/../../scenarios/paper/example{example}.toml",
            env!("CARGO_MANIFEST_DIR")
        );
        let scenario = Scenario::load(path).expect("a sound scenario");
        let experiment = Experiment::new(&scenario).expect("a sound scenario");
        let order = experiment.mode_order.clone();
        let mut arm = IdealArm::at(experiment.q0);
        let mut records: Vec<Record> = Vec::new();
        let ended = run(
            experiment,
            &mut arm,
            &mut |record: Record| {
                records.push(record);
                Ok(())
            },
            &AtomicBool::new(false),
        );
        assert_eq!(ended.outcome, Outcome::Completed);
        assert_eq!(records.len(), 7501);
        assert_eq!(records[7500].t_s, 60.0);
        let changes: Vec<(f64, u64)> = records
            .iter()
            .filter(|record| record.mode_changed)
            .map(|record| (record.t_s, order.number(&record.active).expect("few modes")))
            .collect();
        let expected = expected_modes(example);
        assert_eq!(changes.len(), expected.len(), "{changes:?}");
        for (found, expected) in changes.iter().zip(&expected) {
            assert!(
                (found.0 - expected.0).abs() < 1e-9,
                "{found:?} instead of {expected:?}"
            );
            assert_eq!(found.1, expected.1);
        }
    }
}
