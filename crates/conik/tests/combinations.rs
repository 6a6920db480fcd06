//! Every rule with every border and recursion, in every example of the paper: none fails on the way, and
//! what is said of the active sets is finite.

mod paper;

use conik::{Border, ModeRule, Recursion, Settings};
use paper::Example;

#[test]
fn every_combination_of_rules_runs_every_example_to_its_end() {
    for number in 1..=3 {
        for start in [paper::thesis(), paper::fitted()] {
            for mode_rule in [ModeRule::Paper, ModeRule::Border, ModeRule::Cone] {
                for border in [Border::Freeze, Border::Land] {
                    for recursion in [Recursion::Chiaverini, Recursion::SicilianoSlotine] {
                        let settings = Settings {
                            mode_rule,
                            border,
                            recursion,
                            ..Settings::at_rate(125.0)
                        };
                        let mut example = Example::new(number, start, settings);
                        for _ in 0..7500 {
                            assert!(example.tick().qd.is_finite(), "{number}, {settings:?}");
                        }
                    }
                }
            }
        }
    }
}
