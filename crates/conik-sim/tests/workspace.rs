//! A workspace is read as the sets that it consists of, and keeps the frame inside to its corners.

use conik_sim::experiment::Experiment;
use conik_sim::scenario::{Axis, GoalConfig, Scenario, TaskKind};

fn text(tasks: &str) -> String {
    format!(
        "[robot]\nmodel = \"ur5-paper\"\nq0_deg = [-48, -118, -98, -60, 75, 10]\n\
         [control]\nduration_s = 10\n{tasks}"
    )
}

fn read(tasks: &str) -> Scenario {
    Scenario::from_toml(&text(tasks)).unwrap_or_else(|errors| panic!("{tasks}\n{errors}"))
}

const BOX: &str = "[[task]]\nname = \"cell\"\ntype = \"workspace\"\nmin_m = [0.1, -0.4, 0.15]\n\
                   max_m = [0.4, -0.1, 0.4]\nrelative_to = \"link_1\"\nrecovery_per_s = 0.1\n";

#[test]
fn a_box_is_a_set_of_each_coordinate_and_a_sphere_one_of_the_distance() {
    let scenario = read(BOX);
    let limits = [(0.1, 0.4), (-0.4, -0.1), (0.15, 0.4)];
    let axes = [
        (Axis::X, "cell/x"),
        (Axis::Y, "cell/y"),
        (Axis::Z, "cell/z"),
    ];
    assert_eq!(scenario.tasks.len(), 3);
    for ((task, (axis, name)), (min, max)) in scenario.tasks.iter().zip(axes).zip(limits) {
        assert_eq!(
            (&*task.name, &task.kind),
            (name, &TaskKind::Coordinate { axis })
        );
        let goal = GoalConfig::Set {
            min: Some(min),
            max: Some(max),
            recovery_per_s: Some(0.1),
            gain_per_s: None,
        };
        assert_eq!(task.goal, goal);
        assert_eq!(task.frames.relative_to.as_deref(), Some("link_1"));
    }
    assert_eq!(Scenario::from_toml(&scenario.to_toml()), Ok(scenario));

    let sphere = read(
        "[[task]]\nname = \"ball\"\ntype = \"workspace\"\ncenter_m = [0, 0, 0.1]\nradius_m = 0.7\n\
         frame = \"link_5\"\n",
    );
    let point_m = [0.0, 0.0, 0.1];
    assert_eq!(sphere.tasks[0].name, "ball");
    assert_eq!(sphere.tasks[0].kind, TaskKind::Distance { point_m });
    let GoalConfig::Set { min, max, .. } = sphere.tasks[0].goal else {
        panic!("a set");
    };
    assert_eq!((min, max), (None, Some(0.7)));
}

#[test]
fn a_target_outside_is_approached_to_the_corner() {
    let mut scenario = read(
        "[[task]]\nname = \"cell\"\ntype = \"workspace\"\nmin_m = [0.1, -0.6, 0.05]\n\
         max_m = [0.4, -0.2, 0.4]\n[[task]]\nname = \"position\"\ntype = \"position\"\n\
         target_m = [0.45, -0.15, 0.3]\ngain_per_s = 2\n",
    );
    scenario.robot.q0_rad = vec![-0.9, -2.0, -1.9, -0.9, 1.4, 0.1];
    let mut experiment = Experiment::new(&scenario).expect("sound");
    let stack = experiment.controller.stack();
    let sets = ["cell/x", "cell/y", "cell/z"].map(|name| stack.find(name).expect("a set"));
    let limits = [0.1..=0.4, -0.6..=-0.2, 0.05..=0.4];
    let mut q = experiment.q0;
    let mut values = [0.0; 3];
    for _ in 0..=experiment.last_tick {
        let step = experiment.controller.step(&q).expect("finite");
        values = sets.map(|set| step.value(set)[0]);
        for (value, limits) in values.iter().zip(&limits) {
            assert!(limits.contains(value), "{values:?}");
        }
        q = step.q_ref;
    }
    for (value, nearest) in values.iter().zip([0.4, -0.2, 0.3]) {
        assert!((value - nearest).abs() < 1e-6, "{values:?}");
    }
}

#[test]
fn names_of_the_sets_are_taken_and_known_and_mistakes_are_told_once() {
    let named = |name: &str| format!("[[task]]\nname = \"{name}\"\ntype = \"height\"\nmin = -1\n");
    let told = |tasks: &str| {
        let errors = Scenario::from_toml(&text(tasks)).expect_err(tasks);
        assert_eq!(errors.mistakes().len(), 1, "{errors}");
        errors.to_string()
    };
    let clash = told(&(BOX.to_owned() + &named("cell/y")));
    assert!(clash.contains("has this name already"), "{clash}");
    read(&(BOX.to_owned() + &named("other")).replace("cell\"", "box\""));
    let position = "[[task]]\nname = \"position\"\ntype = \"position\"\ntarget_m = [0, 0, 1]\ngain_per_s = 1\n";
    let low = told(&(position.to_owned() + &BOX.replace("recovery_per_s = 0.1\n", "")));
    assert!(low.contains("has low priority and needs a gain"), "{low}");
    let groups = "exclusive = [[\"cell/x\", \"other\"]]\n";
    read(&(groups.to_owned() + BOX + &named("other")));
    let groups = "exclusive = [[\"cell\", \"other\"]]\n";
    let unknown = told(&(groups.to_owned() + BOX + &named("other")));
    assert!(unknown.contains("did you mean \"cell/"), "{unknown}");
}
