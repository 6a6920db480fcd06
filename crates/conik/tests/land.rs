//! What rule `cone` and border `land` promise, on the paper's examples and on random scenes.
//!
//! Every value is recomputed by the second kinematics of the example `evidence`, stops are judged by its
//! second solver. `docs/evidence.md` has the same figures for thousands of scenes.

#[path = "../examples/evidence/chain.rs"]
mod chain;
#[allow(dead_code, reason = "the example runs all combinations")]
#[path = "../examples/evidence/combo.rs"]
mod combo;
#[path = "../examples/evidence/course.rs"]
mod course;
mod paper;
#[path = "../examples/evidence/random.rs"]
mod random;
#[allow(dead_code, reason = "the example prints more")]
#[path = "../examples/evidence/run.rs"]
mod run;
#[path = "../examples/evidence/scene.rs"]
mod scene;
#[path = "../examples/evidence/stationary.rs"]
mod stationary;

use combo::Combo;
use course::{Course, bench, course, deadlock};
use paper::{fitted, thesis};
use scene::Scene;

/// What two kinematics may differ by [task's unit].
const ROUNDING: f64 = 1e-12;

/// A start, with the times by which Example 2 is to reach its waypoints from there [s].
type Start = (&'static str, fn() -> [f64; 6], [f64; 2]);

const STARTS: [Start; 3] = [
    ("thesis", thesis, [12.0, 23.4]),
    ("fitted", fitted, [11.7, 23.1]),
    ("bench", bench, [12.3, 23.7]),
];

fn combo(recursion: &str) -> Combo {
    format!("cone/land/{recursion}").parse().expect("a name")
}

/// The three examples from both reference starts, at both rates, with both recursions.
fn each_run(mut judge: impl FnMut(u8, &str, &Course)) {
    for number in 1..=3 {
        for (start, q0, _) in &STARTS[..2] {
            for recursion in ["chiaverini", "siciliano-slotine"] {
                for rate_hz in [125.0, 500.0] {
                    let course = course(number, q0(), combo(recursion).settings(rate_hz), 60.0);
                    let name = format!("example {number}, {start}, {recursion}, {rate_hz} Hz");
                    judge(number, &name, &course);
                }
            }
        }
    }
}

#[test]
fn no_sample_leaves_a_set_that_was_entered_and_no_mode_flickers() {
    each_run(|number, name, course| {
        assert!(course.outside <= ROUNDING, "{name}: {}", course.outside);
        assert!(
            course.outside_view <= ROUNDING,
            "{name}: {}",
            course.outside_view
        );
        let changes = [4, 5, 5][usize::from(number) - 1];
        assert_eq!(course.mode_changes, changes, "{name}");
        assert_eq!(course.changes_at_rest, 0, "{name}");
    });
}

#[test]
fn waypoints_are_reached_as_fast_as_the_gain_allows() {
    for (start, q0, [first, second]) in STARTS {
        let settings = combo("siciliano-slotine").settings(125.0);
        let course = course(2, q0(), settings, 30.0);
        let [Some(a), Some(b)] = course.waypoints_s else {
            panic!("{start}: {:?}", course.waypoints_s);
        };
        assert!(a <= first && b <= second, "{start}: {a} and {b} s");
    }
}

#[test]
fn the_deadlock_of_the_papers_rule_is_none() {
    for number in 1..=3 {
        for (recursion, duration_s) in [("siciliano-slotine", 60.0), ("chiaverini", 80.0)] {
            let settings = combo(recursion).settings(125.0);
            let course = course(number, deadlock(), settings, duration_s);
            let last = course.waypoints_s[1];
            assert!(last.is_some(), "example {number}, {recursion}");
        }
    }
}

/// The error of a position task under gain Λ is |e₀| (1 − Λ T)ᵏ; where no set, limit or damping acts the
/// waypoint is reached when that falls below the circle of acceptance.
#[test]
fn where_nothing_acts_the_closed_loop_of_the_gain_alone_remains() {
    for (seed, rate_hz) in [(1_u64, 50.0), (2, 125.0), (3, 500.0), (4, 1000.0)] {
        let mut scene = Scene::random(seed, 0);
        scene.q0 = [0.3, -1.2, 1.4, -0.6, 1.0, 0.2];
        scene.high.truncate(0);
        scene.low.truncate(0);
        scene.posture = None;
        scene.rate_hz = rate_hz;
        scene.gain = 0.5;
        let start = chain::Chain::at(&scene.q0).tool();
        let target = [start[0] - 0.1, start[1] + 0.15, start[2] + 0.05];
        scene.waypoints = vec![target, target];
        let outcome = run::run(
            &scene,
            combo("siciliano-slotine").settings(rate_hz),
            |_, _, _| {},
        )
        .expect("sound");
        let distance = chain::norm(chain::minus(target, start));
        let ticks = (scene::ACCEPTANCE / distance).ln() / (1.0 - 0.5 / rate_hz).ln();
        let reached = outcome.waypoints_s[0].expect("nothing is in the way");
        assert!(
            reached <= 1.02 * ticks / rate_hz,
            "{reached} s at {rate_hz} Hz"
        );
    }
}

/// Random scenes: obstacles, bounds, view cones, sets of low priority, sets that start outside, targets
/// out of reach.
#[test]
fn random_scenes_keep_every_promise() {
    let mut stopped = 0;
    for index in 0..60 {
        let scene = Scene::random(77, index);
        let settings = combo("siciliano-slotine").settings(scene.rate_hz);
        let limit = std::f64::consts::PI;
        let outcome = run::run(&scene, settings, |tick, _, step| {
            for speed in step.qd.iter() {
                assert!(
                    speed.abs() <= limit * (1.0 + 1e-12),
                    "scene {index}, tick {tick}"
                );
            }
        })
        .expect("sound");
        assert!(!outcome.broke, "scene {index}");
        assert!(
            outcome.worst() <= ROUNDING,
            "scene {index}: {}",
            outcome.worst()
        );
        assert!(
            outcome.worsened <= 0.0,
            "scene {index}: {}",
            outcome.worsened
        );
        assert!(outcome.most_kinematics <= 9, "scene {index}");
        assert!(outcome.most_pivots <= 60, "scene {index}");
        assert!(
            !outcome.stopped_falsely(),
            "scene {index}: |e| could fall by {} m/rad",
            outcome.could_fall
        );
        assert!(
            outcome.mode_changes <= 30,
            "scene {index}: {}",
            outcome.mode_changes
        );
        assert_eq!(outcome.changes_at_rest, 0, "scene {index}");
        assert!(
            outcome.reversals <= 30,
            "scene {index}: {}",
            outcome.reversals
        );
        stopped += usize::from(outcome.stopped());
    }
    assert!(
        stopped > 10,
        "only {stopped} scenes tell anything about stops"
    );
}
