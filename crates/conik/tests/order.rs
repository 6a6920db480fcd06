//! Rule `cone` does not depend on the order in which the high-priority sets are listed.

mod oracle;

use std::collections::BTreeSet;

use conik::{Border, JointVec, ModeRule, Recursion, Settings, TaskId};
use oracle::scene::{Scene, any_arm, near_the_border, scene};
use oracle::{Measure, Task, high_priority};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Largest difference of a joint velocity between two orders along one run, relative to 1 rad/s or the
/// fastest joint. Rounding, 1e-16, is magnified by no more than 1 / l₀² = 1e6.
const TOLERANCE: f64 = 1e-9;
/// The same with several levels: each magnifies what the one above leaves.
const LEVELS_TOLERANCE: f64 = 1e-7;
const TICKS: usize = 400;

/// The scene with its high-priority sets in another order, and where each task stood before.
fn reordered(scene: &Scene, keys: &[u32]) -> (Scene, Vec<usize>) {
    let mut order: Vec<usize> = (0..scene.tasks.len()).collect();
    order[..high_priority(&scene.tasks)].sort_by_key(|&i| keys[i % keys.len()]);
    let tasks = order.iter().map(|&i| scene.tasks[i].clone()).collect();
    let other = Scene {
        tasks,
        ..scene.clone()
    };
    (other, order)
}

/// Sets of one and the same measure have one and the same row, and either may be the one that is active.
fn has_twins(tasks: &[Task]) -> bool {
    let mut seen = BTreeSet::new();
    tasks.iter().any(|task| match task.measure {
        Measure::Coordinate(k) => !seen.insert((0, k)),
        Measure::Joint(i) => !seen.insert((1, i)),
        _ => false,
    })
}

fn assert_same(scene: &Scene, keys: &[u32], settings: Settings) -> Result<(), TestCaseError> {
    let is_single = scene.tasks.len() == high_priority(&scene.tasks) + 1;
    let tolerance = if is_single {
        TOLERANCE
    } else {
        LEVELS_TOLERANCE
    };
    let (other, order) = reordered(scene, keys);
    let mut controllers = [scene.controller(settings), other.controller(settings)];
    let mut q = JointVec::from_slice(&scene.q0).expect("few joints");
    for tick in 0..TICKS {
        let [first, second] = &mut controllers;
        let first = first.step(&q).expect("finite").clone();
        let second = second.step(&q).expect("finite").clone();
        let scale = 1.0 + first.qd.largest().expect("a joint").1;
        q = first.q_ref;
        for (a, b) in first.qd.iter().zip(second.qd.iter()) {
            prop_assert!(
                (a - b).abs() <= tolerance * scale,
                "tick {tick}: {:?} or {:?}",
                first.qd,
                second.qd
            );
        }
        let names: BTreeSet<usize> = first.active.iter().map(TaskId::index).collect();
        let others: BTreeSet<usize> = second.active.iter().map(|id| order[id.index()]).collect();
        prop_assert_eq!(names, others, "tick {}", tick);
    }
    Ok(())
}

fn settings(land: bool, fit: bool, rate_hz: f64) -> Settings {
    Settings {
        mode_rule: ModeRule::Cone,
        border: if land { Border::Land } else { Border::Freeze },
        recursion: if fit {
            Recursion::SicilianoSlotine
        } else {
            Recursion::Chiaverini
        },
        ..Settings::at_rate(rate_hz)
    }
}

fn rate_hz() -> impl Strategy<Value = f64> {
    prop_oneof![Just(50.0), Just(125.0), Just(500.0)]
}

fn config() -> ProptestConfig {
    ProptestConfig {
        rng_seed: RngSeed::Fixed(6),
        failure_persistence: None,
        ..ProptestConfig::with_cases(150)
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn the_order_of_sets_changes_nothing(
        scene in scene(any_arm(), near_the_border(), 6, 0),
        keys in prop::collection::vec(any::<u32>(), 6),
        land: bool,
        fit: bool,
        rate in rate_hz(),
    ) {
        prop_assume!(!has_twins(&scene.tasks[..high_priority(&scene.tasks)]));
        assert_same(&scene, &keys, settings(land, fit, rate))?;
    }

    #[test]
    fn nor_does_it_above_many_levels(
        scene in scene(any_arm(), near_the_border(), 6, 2),
        keys in prop::collection::vec(any::<u32>(), 6),
        land: bool,
        fit: bool,
        rate in rate_hz(),
    ) {
        prop_assume!(!has_twins(&scene.tasks[..high_priority(&scene.tasks)]));
        assert_same(&scene, &keys, settings(land, fit, rate))?;
    }
}
