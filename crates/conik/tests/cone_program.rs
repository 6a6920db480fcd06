//! Rule `cone` against its definition, written down with dense matrices and solved by an interior-point
//! solver level by level.

mod oracle;

use conik::{Border, ModeRule, Recursion, Settings};
use oracle::cone;
use oracle::program::Failure;
use oracle::scene::{Scene, any_arm, at_the_border, scene};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Largest difference of a joint velocity, relative to 1 rad/s or the largest one. The weight of the
/// velocity itself, l₀² = 1e-6, magnifies what rounding leaves in the programs, 1e-13 or so.
const TOLERANCE: f64 = 1e-6;

/// Rows are kept to rounding.
const FEASIBLE: f64 = 1e-9;

fn settings(border: Border, recursion: Recursion, rate_hz: f64) -> Settings {
    Settings {
        mode_rule: ModeRule::Cone,
        border,
        recursion,
        ..Settings::at_rate(rate_hz)
    }
}

/// The first tick of a fresh controller, against the oracle. `false` if the two cannot be compared:
/// rounding decides, or the velocity was changed to land.
fn first_tick_agrees(scene: &Scene, settings: Settings) -> Result<bool, TestCaseError> {
    let expected = cone::Scene {
        arm: &scene.arm,
        tasks: &scene.tasks,
        recursion: settings.recursion,
        land: settings.border == Border::Land,
        period: 1.0 / settings.rate_hz,
    }
    .first_tick(&scene.q0);
    let expected = match expected {
        Ok(expected) => expected,
        Err(Failure::Undecided) => return Ok(false),
        Err(Failure::Infeasible) => unreachable!("standing still keeps every row"),
    };
    let mut controller = scene.controller(settings);
    let step = controller.step(&scene.q0).expect("finite");
    if expected.is_unclear || step.landed.corrections + step.landed.halvings > 0 {
        return Ok(false);
    }
    let scale = 1.0 + expected.qd.amax();
    for (a, b) in step.qd.iter().zip(expected.qd.iter()) {
        prop_assert!(
            (a - b).abs() <= TOLERANCE * scale,
            "{:?} instead of {:?}",
            step.qd,
            expected.qd.as_slice()
        );
    }
    let active = step
        .active
        .iter()
        .fold(0_u32, |bits, task| bits | 1 << task.index());
    prop_assert_eq!(active, expected.active.unwrap_or(active));
    for (row, bound) in expected.rows.row_iter().zip(&expected.bounds) {
        let rate: f64 = row.iter().zip(step.qd.iter()).map(|(a, v)| a * v).sum();
        prop_assert!(rate >= bound - FEASIBLE * scale, "{} below {}", rate, bound);
    }
    Ok(true)
}

const RATES: [f64; 3] = [50.0, 125.0, 1000.0];

fn assert_first_ticks(
    scene: &Scene,
    border: Border,
    recursion: Recursion,
    rate: usize,
) -> Result<(), TestCaseError> {
    let compared = first_tick_agrees(scene, settings(border, recursion, RATES[rate]))?;
    prop_assume!(compared);
    Ok(())
}

/// Always the same scenes: a few in a hundred thousand are so degenerate that rounding decides, which no
/// oracle foresees.
fn config() -> ProptestConfig {
    ProptestConfig {
        rng_seed: RngSeed::Fixed(3),
        max_global_rejects: 20_000,
        failure_persistence: None,
        ..ProptestConfig::with_cases(500)
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn frozen_fit(scene in scene(any_arm(), at_the_border(), 6, 0), rate in 0..3_usize) {
        assert_first_ticks(&scene, Border::Freeze, Recursion::SicilianoSlotine, rate)?;
    }

    #[test]
    fn frozen_projection(scene in scene(any_arm(), at_the_border(), 6, 0), rate in 0..3_usize) {
        assert_first_ticks(&scene, Border::Freeze, Recursion::Chiaverini, rate)?;
    }

    #[test]
    fn frozen_fit_of_levels(scene in scene(any_arm(), at_the_border(), 5, 3), rate in 0..3_usize) {
        assert_first_ticks(&scene, Border::Freeze, Recursion::SicilianoSlotine, rate)?;
    }

    #[test]
    fn frozen_projection_of_levels(scene in scene(any_arm(), at_the_border(), 5, 3), rate in 0..3_usize) {
        assert_first_ticks(&scene, Border::Freeze, Recursion::Chiaverini, rate)?;
    }

    #[test]
    fn landed_fit_of_levels(scene in scene(any_arm(), at_the_border(), 5, 3), rate in 0..3_usize) {
        assert_first_ticks(&scene, Border::Land, Recursion::SicilianoSlotine, rate)?;
    }

    #[test]
    fn landed_projection_of_levels(scene in scene(any_arm(), at_the_border(), 5, 3), rate in 0..3_usize) {
        assert_first_ticks(&scene, Border::Land, Recursion::Chiaverini, rate)?;
    }
}
