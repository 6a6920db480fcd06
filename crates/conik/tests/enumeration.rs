//! Random scenes in closed loop against the plain second implementation in `oracle`, which goes
//! through all 2ⁿ modes with pseudoinverses by eigenvectors.

mod oracle;

use conik::{JointVec, ModeRule, Recursion, Settings};
use oracle::arm::Arm;
use oracle::enumeration;
use oracle::high_priority;
use oracle::scene::{Scene, any_arm, at_the_border, near_the_border, scene};
use proptest::prelude::*;

/// Largest difference of a joint velocity [rad/s].
const TOLERANCE: f64 = 1e-9;

/// The same for fitted levels, where the oracle solves normal equations whose least eigenvalue is l₀² = 1e-6.
const FITTED_TOLERANCE: f64 = 1e-7;

/// Nearer to a singularity than this, rounding alone moves the velocities by more than the tolerance.
const SINGULAR: f64 = 1e-2;

/// What is compared.
#[derive(Clone, Copy)]
struct Compared<'a> {
    rule: ModeRule,
    recursion: Recursion,
    exclusive: &'a [(usize, usize)],
    ticks: usize,
}

/// Follows the crate's own trajectory and compares every tick with the oracle at the same q.
fn assert_same(scene: &Scene, compared: Compared<'_>) -> Result<(), TestCaseError> {
    let settings = Settings {
        mode_rule: compared.rule,
        recursion: compared.recursion,
        ..Settings::of_the_paper()
    };
    let oracle = enumeration::Scene {
        arm: &scene.arm,
        tasks: &scene.tasks,
        exclusive: compared.exclusive,
        border: compared.rule == ModeRule::Border,
        recursion: compared.recursion,
        period: 1.0 / settings.rate_hz,
    };
    let mut controller = scene.controller_excluding(settings, compared.exclusive);
    let tolerance = match compared.recursion {
        Recursion::Chiaverini => TOLERANCE,
        _ => FITTED_TOLERANCE,
    };
    let mut q = JointVec::from_slice(&scene.q0).expect("few joints");
    for tick in 0..compared.ticks {
        let expected = oracle.step(&q);
        if expected.conditioning < SINGULAR {
            break;
        }
        let step = controller.step(&q).expect("finite configuration");
        prop_assert_eq!(step.no_mode, expected.active.is_none());
        let chosen = step
            .active
            .iter()
            .fold(0_u32, |bits, task| bits | 1 << task.index());
        let prescribed = expected.active.unwrap_or(0);
        prop_assert_eq!(chosen, prescribed, "tick {}, q {:?}", tick, q);
        for (a, b) in step.qd.iter().zip(expected.qd.iter()) {
            prop_assert!(
                (a - b).abs() <= tolerance * (1.0 + b.abs()),
                "tick {tick}: {:?} instead of {:?}",
                step.qd,
                expected.qd
            );
        }
        prop_assert!(step.modes_evaluated <= most_modes(scene, &oracle, &q));
        q = step.q_ref;
    }
    Ok(())
}

/// Σₖ C(h, k) 2ˡ, k = 0 … min(h, joints): h and l high- and low-priority sets may be active.
fn most_modes(scene: &Scene, oracle: &enumeration::Scene<'_>, q: &[f64]) -> usize {
    let first_equality = high_priority(&scene.tasks);
    let candidates: Vec<usize> = (0..scene.tasks.len())
        .filter(|&i| oracle.may_be_active(i, q))
        .collect();
    let high = candidates.iter().filter(|&&i| i < first_equality).count();
    let low = candidates.len() - high;
    let mut binomial = 1;
    let mut sum = 0;
    for k in 0..=high.min(scene.arm.dof()) {
        sum += binomial;
        binomial = binomial * (high - k) / (k + 1);
    }
    sum << low
}

fn ur5_scene(max_high: usize, max_lower: usize) -> impl Strategy<Value = Scene> {
    scene(Just(Arm::ur5()), near_the_border(), max_high, max_lower)
}

/// Pairs of sets of a scene that exclude each other: every two among those whose bit is set.
fn exclusive_group(scene: &Scene, members: u16) -> Vec<(usize, usize)> {
    let group: Vec<usize> = (0..scene.tasks.len())
        .filter(|&i| scene.tasks[i].bounds().is_some() && members & 1 << i != 0)
        .collect();
    let pairs = |a: usize| group.iter().filter(move |&&b| a < b).map(move |&b| (a, b));
    group.iter().flat_map(|&a| pairs(a)).collect()
}

fn recursion() -> impl Strategy<Value = Recursion> {
    prop_oneof![
        Just(Recursion::Chiaverini),
        Just(Recursion::SicilianoSlotine)
    ]
}

fn compared(rule: ModeRule, recursion: Recursion, ticks: usize) -> Compared<'static> {
    Compared {
        rule,
        recursion,
        exclusive: &[],
        ticks,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn paper_rule_equals_full_enumeration(scene in ur5_scene(5, 3)) {
        assert_same(&scene, compared(ModeRule::Paper, Recursion::Chiaverini, 25))?;
    }

    #[test]
    fn border_rule_equals_full_enumeration(scene in ur5_scene(5, 3)) {
        assert_same(&scene, compared(ModeRule::Border, Recursion::Chiaverini, 25))?;
    }

    #[test]
    fn fitted_levels_equal_full_enumeration(scene in ur5_scene(5, 3), border: bool) {
        let rule = if border { ModeRule::Border } else { ModeRule::Paper };
        assert_same(&scene, compared(rule, Recursion::SicilianoSlotine, 25))?;
    }

    /// More sets than joints, so that frozen rows must depend on each other.
    #[test]
    fn many_sets_equal_full_enumeration(scene in ur5_scene(8, 1)) {
        assert_same(&scene, compared(ModeRule::Paper, Recursion::Chiaverini, 6))?;
    }

    /// As many as full enumeration can bear, all as good as at their border.
    #[test]
    fn ten_sets_at_their_border_equal_full_enumeration(
        scene in scene(any_arm(), at_the_border(), 8, 2),
        recursion in recursion(),
    ) {
        assert_same(&scene, compared(ModeRule::Border, recursion, 4))?;
    }

    #[test]
    fn exclusive_groups_equal_full_enumeration(
        scene in ur5_scene(5, 3),
        members: u16,
        recursion in recursion(),
        border: bool,
    ) {
        let exclusive = exclusive_group(&scene, members);
        let rule = if border { ModeRule::Border } else { ModeRule::Paper };
        let compared = Compared { exclusive: &exclusive, ..compared(rule, recursion, 15) };
        assert_same(&scene, compared)?;
    }
}
