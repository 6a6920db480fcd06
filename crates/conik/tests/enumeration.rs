//! Random scenes in closed loop against the plain second implementation in `oracle`, which goes
//! through all 2ⁿ modes with pseudoinverses by eigenvectors.

mod oracle;

use conik::{JointVec, ModeRule, Recursion, Settings};
use oracle::arm::Arm;
use oracle::scene::{Scene, any_arm, at_the_border, near_the_border, scene};
use oracle::{Goal, Measure, Task, enumeration};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

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

/// 1 + Σₖ C(n, k), k = 0 … min(n, joints): n sets may be active.
fn most_modes(scene: &Scene, oracle: &enumeration::Scene<'_>, q: &[f64]) -> usize {
    let n = (0..scene.tasks.len())
        .filter(|&i| oracle.may_be_active(i, q))
        .count();
    1 + subsets(n, scene.arm.dof())
}

/// Σₖ C(n, k), k = 0 … min(n, most).
fn subsets(n: usize, most: usize) -> usize {
    let mut binomial = 1;
    let mut sum = 0;
    for k in 0..=n.min(most) {
        sum += binomial;
        binomial = binomial * (n - k) / (k + 1);
    }
    sum
}

fn ur5_scene(max_high: usize, max_lower: usize) -> impl Strategy<Value = Scene> {
    scene(Just(Arm::ur5()), near_the_border(), max_high, max_lower)
}

/// Up to two sets, an equality task, then many sets of few measures, so that many rows depend on those
/// above; now and then an equality task stands between them.
fn crowded_below() -> impl Strategy<Value = Scene> {
    let measure = prop_oneof![
        4 => (0..4_usize).prop_map(Measure::Joint),
        1 => (0..3_usize).prop_map(Measure::Coordinate),
    ];
    let equality = prop_oneof![
        3 => (0..4_usize).prop_map(Measure::Joint),
        1 => (0..3_usize).prop_map(Measure::Coordinate),
    ];
    let row = (measure, at_the_border(), any::<bool>(), 0.2..2.0_f64);
    let high = prop::collection::vec(row.clone(), 0..=2);
    let low = prop::collection::vec(row, 3..=6);
    let between = prop::option::weighted(0.3, 0..6_usize);
    let pull = -2.0..2.0_f64;
    (
        scene(any_arm(), near_the_border(), 0, 0),
        high,
        low,
        (equality.clone(), equality),
        between,
        pull,
    )
        .prop_map(|(scene, high, low, equalities, between, pull)| {
            let Scene { arm, q0, .. } = scene;
            let joints = arm.dof();
            let on_arm = |measure| match measure {
                Measure::Joint(i) => Measure::Joint(i % joints),
                other => other,
            };
            let value = |measure| arm.measure(measure, &q0).0[0];
            let set = |&(measure, margin, is_upper, gain): &(Measure, f64, bool, f64)| {
                let measure = on_arm(measure);
                let goal = if is_upper {
                    Goal::Set(f64::NEG_INFINITY, value(measure) + margin)
                } else {
                    Goal::Set(value(measure) - margin, f64::INFINITY)
                };
                Task {
                    measure,
                    goal,
                    gain,
                }
            };
            let equality = |measure| {
                let measure = on_arm(measure);
                let goal = Goal::Equality(vec![value(measure) + pull]);
                Task {
                    measure,
                    goal,
                    gain: 1.0,
                }
            };
            let mut tasks: Vec<Task> = high.iter().map(set).collect();
            tasks.push(equality(equalities.0));
            let first_low = tasks.len();
            tasks.extend(low.iter().map(set));
            if let Some(place) = between {
                tasks.insert((first_low + place).min(tasks.len()), equality(equalities.1));
            }
            Scene { arm, q0, tasks }
        })
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

/// Always the same scenes: a few in ten thousand are so degenerate that rounding decides, which no
/// oracle foresees.
fn config() -> ProptestConfig {
    ProptestConfig {
        rng_seed: RngSeed::Fixed(11),
        ..ProptestConfig::with_cases(200)
    }
}

proptest! {
    #![proptest_config(config())]

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

    /// Several low-priority sets on one joint, or below an equality task of the same: their rows depend
    /// on each other.
    #[test]
    fn dependent_low_priority_sets_equal_full_enumeration(
        scene in crowded_below(),
        recursion in recursion(),
        border: bool,
        exclusive in prop_oneof![2 => Just(0), 1 => any::<u16>()],
    ) {
        let exclusive = exclusive_group(&scene, exclusive);
        let rule = if border { ModeRule::Border } else { ModeRule::Paper };
        let compared = Compared { exclusive: &exclusive, ..compared(rule, recursion, 4) };
        assert_same(&scene, compared)?;
    }
}
