//! The damping that a scenario states is that of the controller's levels.

use conik::Damping;
use conik_sim::experiment::Experiment;
use conik_sim::scenario::Scenario;

/// The arm stands nearly stretched and is to reach beyond; `{}` is for what is said of damping.
const STRETCHED: &str = r#"
[robot]
model = "ur5-paper"
q0_rad = [0.3, -0.9, 0.1, 0.2, -1.2, 0.2]
[[task]]
name = "above"
type = "coordinate"
axis = "z"
min = -2
[[task]]
name = "position"
type = "position"
target_m = [3, 0, 0]
gain_per_s = 0.01
{}
[[task]]
name = "low"
type = "joint"
joint = 1
min = 0
gain_per_s = 1
{}
"#;

fn experiment(said: &str) -> Experiment {
    let scenario = Scenario::from_toml(&STRETCHED.replace("{}", said)).expect("it is right");
    Experiment::new(&scenario).expect("it can be run")
}

#[test]
fn every_damping_reaches_the_levels_and_no_others() {
    for (said, expected) in [
        ("", Damping::Automatic),
        ("damping = \"automatic\"", Damping::Automatic),
        ("damping = \"none\"", Damping::None),
        ("damping = \"smallest\"", Damping::Smallest),
        ("damping = \"per-direction\"", Damping::PerDirection),
        ("damping = 0", Damping::Fixed(0.0)),
        ("damping = 0.25", Damping::Fixed(0.25)),
    ] {
        let experiment = experiment(said);
        let levels = experiment.controller.stack().iter();
        let dampings: Vec<_> = levels.map(|(_, level)| level.damping()).collect();
        assert_eq!(
            dampings,
            [Damping::Automatic, expected, expected],
            "{said:?}"
        );
    }
}

#[test]
fn the_stronger_the_damping_the_slower_the_first_tick() {
    let speed = |said: &str| {
        let Experiment {
            mut controller, q0, ..
        } = experiment(said);
        let step = controller.step(&q0).expect("it can start");
        step.qd.iter().map(|qd| qd * qd).sum::<f64>().sqrt()
    };
    let speeds = ["0", "0.1", "0.3", "1", "10"].map(|said| speed(&format!("damping = {said}")));
    assert!(speeds.is_sorted_by(|a, b| a > b), "{speeds:?}");
    let [none, per_direction] =
        ["none", "per-direction"].map(|said| speed(&format!("damping = {said:?}")));
    assert!(none > per_direction, "{none} {per_direction}");
}
