//! The step of Example 2 that the benchmark takes as its floor does the controller's work: without
//! that, a comparison of their times would say nothing.

#[path = "../benches/hand/mod.rs"]
#[allow(dead_code, reason = "the benchmark uses the rest")]
mod hand;
mod paper;

use conik::{ModeOrder, Settings};
use paper::Example;

#[test]
fn hand_written_step_agrees_with_the_controller_over_a_whole_run() {
    for start in [paper::thesis(), paper::fitted()] {
        let mut example = Example::new(2, start, Settings::of_the_paper());
        let order = ModeOrder::new(example.controller.stack());
        for k in 0..7500 {
            let q: [f64; 6] = std::array::from_fn(|i| example.q[i]);
            let step = example.tick().clone();
            let (velocity, mode) = hand::step(&q, example.waypoints.target().to_array());
            assert_eq!(order.number(&step.active), Some(mode as u64), "tick {k}");
            for (qd, by_hand) in step.qd.iter().zip(velocity) {
                assert!(
                    (qd - by_hand).abs() <= 1e-9,
                    "tick {k}: {qd} instead of {by_hand}"
                );
            }
        }
    }
}
