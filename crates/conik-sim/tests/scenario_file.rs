//! Scenario files as a whole: the examples read as written, defaults hold, files that are none are
//! refused, and what is written reads back the same.

use std::fs;
use std::path::{Path, PathBuf};

use conik_sim::scenario::{
    Border, Choice, Control, Damping, DampingRule, GoalConfig, LoadError, MAX_FILE_BYTES, ModeRule,
    Motion, Recursion, Scenario, TaskKind, template,
};
use proptest::prelude::*;

fn scenarios() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios")
}

fn example(number: usize) -> PathBuf {
    scenarios().join(format!("paper/example{number}.toml"))
}

/// A file that is removed when the test ends.
struct TemporaryFile(PathBuf);

impl TemporaryFile {
    fn new(name: &str, content: &[u8]) -> Self {
        let path = std::env::temp_dir().join(format!("conik-{}-{name}", std::process::id()));
        fs::write(&path, content).expect("the directory for temporary files is writable");
        Self(path)
    }
}

impl Drop for TemporaryFile {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

#[test]
fn the_papers_second_example_reads_as_written() {
    let scenario = Scenario::load(example(2)).expect("it is right");
    assert_eq!(scenario.robot.name(), "ur5-paper");
    assert_eq!(scenario.robot.q0_rad[0], (-48.0_f64).to_radians());
    assert_eq!(scenario.control.mode_rule, ModeRule::Paper);
    assert_eq!(scenario.control.exclusive, [["obstacle_a", "obstacle_b"]]);
    let names: Vec<_> = scenario
        .tasks
        .iter()
        .map(|task| task.name.as_str())
        .collect();
    assert_eq!(names, ["obstacle_a", "obstacle_b", "view", "position"]);
    let view = &scenario.tasks[2];
    assert_eq!(
        view.kind,
        TaskKind::FieldOfView {
            direction: [1.0, 0.0, 0.0]
        }
    );
    assert_eq!(
        view.goal,
        GoalConfig::Set {
            min: None,
            max: Some(0.2622),
            recovery_per_s: None,
            gain_per_s: None
        }
    );
    assert_eq!(
        scenario.tasks[3].goal,
        GoalConfig::Waypoints {
            waypoints_m: vec![[0.486, -0.066, -0.250], [0.320, 0.370, -0.250]],
            waypoints_quaternion_wxyz: vec![],
            acceptance_m: Some(0.02),
            acceptance_rad: None,
            gain_per_s: 0.3,
        }
    );
}

#[test]
fn the_template_is_a_scenario() {
    let scenario = Scenario::from_toml(template()).expect("the template is right");
    assert_eq!(scenario.tasks.len(), 3);
}

/// The least that a scenario can say, and then some tasks.
fn with_tasks(tasks: &str) -> String {
    format!("[robot]\nmodel = \"ur5-paper\"\nq0_rad = [0, 0.5, 1, 0, 0, 0]\n{tasks}")
}

#[test]
fn what_the_file_leaves_out_has_defaults() {
    let task = "[[task]]\nname = \"j\"\ntype = \"joint\"\njoint = 1\nmin = 0\n";
    let control = Scenario::from_toml(&with_tasks(task))
        .expect("it is right")
        .control;
    let expected = Control {
        rate_hz: 125.0,
        duration_s: 60.0,
        mode_rule: ModeRule::Cone,
        border: Border::Land,
        recursion: Recursion::SicilianoSlotine,
        exclusive: vec![],
    };
    assert_eq!(control, expected);
    let text = format!("{}[control]\nrate_hz = 500\n", with_tasks(task));
    let control = Scenario::from_toml(&text).expect("it is right").control;
    assert_eq!(
        control,
        Control {
            rate_hz: 500.0,
            ..expected
        }
    );
}

/// Reads `key = name` for every name of a setting: the value of that name, also in JSON.
fn assert_names_are_read<T: Choice + std::fmt::Debug + serde::Serialize>(
    key: &str,
    value: impl Fn(&Control) -> T,
) {
    assert!(T::ALL.len() >= 2, "a choice");
    let task = "[[task]]\nname = \"j\"\ntype = \"joint\"\njoint = 1\nmin = 0\n";
    for (expected, _) in T::ALL {
        let name = expected.name();
        let text = with_tasks(&format!("[control]\n{key} = {name:?}\n{task}"));
        let scenario = Scenario::from_toml(&text).expect("a name of the setting");
        assert_eq!(value(&scenario.control), *expected);
        assert_eq!(Scenario::from_toml(&scenario.to_toml()), Ok(scenario));
        assert_eq!(serde_json::json!(expected), serde_json::json!(name));
    }
}

#[test]
fn every_value_of_the_settings_is_read_by_its_name() {
    assert_names_are_read("mode_rule", |control| control.mode_rule);
    assert_names_are_read("border", |control| control.border);
    assert_names_are_read("recursion", |control| control.recursion);
}

#[test]
fn there_is_more_than_one_right_way_to_write_a_value() {
    let kinds = |task: &str| {
        let task = format!("[[task]]\nname = \"t\"\n{task}");
        let scenario = Scenario::from_toml(&with_tasks(&task)).expect("it is right");
        let task = &scenario.tasks[0];
        (task.kind.clone(), task.goal.clone())
    };
    let elbow = kinds("type = \"joint\"\njoint = \"elbow_joint\"\nmax = 1");
    assert_eq!(elbow, kinds("type = \"joint\"\njoint = 3\nmax = 1.0"));
    assert_eq!(elbow, kinds("type = \"joint\"\njoint = 3.0\nmax = 0x1"));
    let view = kinds("type = \"field_of_view\"\ndirection = [0, 0, 7]\nmax = 0.2");
    assert_eq!(
        view,
        kinds("type = \"field_of_view\"\ndirection = [0, 0, 1e-250]\nmax = 2e-1")
    );
    let target = kinds("type = \"position\"\ntarget_m = [1, 2, 3]\ngain_per_s = 1").1;
    assert_eq!(
        target,
        GoalConfig::Desired {
            desired: vec![1.0, 2.0, 3.0],
            gain_per_s: 1.0
        }
    );
}

#[test]
fn limits_motion_and_recovery_read_as_written_and_back() {
    let written = "[robot]\nmodel = \"ur5-paper\"\nq0_rad = [0, 0.5, 1, 0, 0, 0]\n\
        position_limits_deg = [[-90, 90], [], [-180, 180], [], [], []]\n\
        speed_limits_deg_per_s = 180\n\
        acceleration_limits_rad_per_s2 = [1, 2, 3, 4, 5, 6]\n\
        [[task]]\nname = \"d\"\ntype = \"distance\"\npoint_m = [1, 2, 3]\n\
        velocity_m_per_s = [0, -0.2, 0]\nmoves_until_s = 4\nmin = 0.1\nrecovery_per_s = 0.05\n";
    let scenario = Scenario::from_toml(written).expect("it is right");
    let half_turn = std::f64::consts::PI;
    let limits = &scenario.robot.limits;
    let pairs = limits.position_limits_rad.as_ref().expect("given");
    assert_eq!(pairs[0], Some([-half_turn / 2.0, half_turn / 2.0]));
    assert_eq!((pairs[1], pairs[2]), (None, Some([-half_turn, half_turn])));
    assert_eq!(limits.speed_limits_rad_per_s, Some(vec![half_turn; 6]));
    let accelerations = limits.acceleration_limits_rad_per_s2.as_deref();
    assert_eq!(accelerations, Some(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0][..]));
    let motion = Motion {
        velocity_m_per_s: Some([0.0, -0.2, 0.0]),
        moves_until_s: Some(4.0),
        ..Motion::default()
    };
    let kind = TaskKind::Distance {
        point_m: [1.0, 2.0, 3.0],
    };
    assert_eq!(scenario.tasks[0].kind, kind);
    assert_eq!(scenario.tasks[0].motion, motion);
    let GoalConfig::Set { recovery_per_s, .. } = scenario.tasks[0].goal else {
        panic!("a set");
    };
    assert_eq!(recovery_per_s, Some(0.05));
    assert_eq!(
        Scenario::from_toml(&scenario.to_toml()).as_ref(),
        Ok(&scenario)
    );
    let json = serde_json::to_string(&scenario).expect("it can be written");
    let read: Scenario = serde_json::from_str(&json).expect("it can be read");
    assert_eq!(read, scenario);
    let earlier = fs::read_to_string(example(1)).expect("the example is there");
    let earlier = Scenario::from_toml(&earlier).expect("it is right");
    let json = serde_json::to_string(&earlier).expect("it can be written");
    assert!(
        !json.contains("limits") && !json.contains("velocity"),
        "{json}"
    );
    assert_eq!(
        serde_json::from_str::<Scenario>(&json).expect("read"),
        earlier
    );
}

#[test]
fn damping_reads_as_written_and_back() {
    let read = |written: &str| {
        let tasks = format!(
            "[[task]]\nname = \"p\"\ntype = \"position\"\ntarget_m = [1, 2, 3]\ngain_per_s = 1\n{written}\n\
             [[task]]\nname = \"low\"\ntype = \"joint\"\njoint = 1\nmin = 0\ngain_per_s = 1\n{written}\n"
        );
        let scenario = Scenario::from_toml(&with_tasks(&tasks)).expect("it is right");
        let again = Scenario::from_toml(&scenario.to_toml());
        assert_eq!(again.as_ref(), Ok(&scenario), "{written}");
        let json = serde_json::to_string(&scenario).expect("it can be written");
        let again: Scenario = serde_json::from_str(&json).expect("it can be read");
        assert_eq!(again, scenario, "{json}");
        let [of_equality, of_set] = [0, 1].map(|task| scenario.tasks[task].damping);
        assert_eq!(of_equality, of_set, "{written}");
        (of_equality, json)
    };
    let (absent, json) = read("");
    assert_eq!(absent, Damping::Rule(DampingRule::Automatic));
    assert!(!json.contains("damping"), "{json}");
    for (rule, _) in DampingRule::ALL {
        let (damping, _) = read(&format!("damping = {:?}", rule.name()));
        assert_eq!(damping, Damping::Rule(*rule));
        assert_eq!(
            serde_json::json!(damping),
            serde_json::json!(rule.name()),
            "in JSON as in the file"
        );
    }
    for (written, lambda) in [("0", 0.0), ("0.05", 0.05), ("3", 3.0), ("1e6", 1e6)] {
        let (damping, _) = read(&format!("damping = {written}"));
        assert_eq!(damping, Damping::Fixed(lambda));
    }
}

#[test]
fn a_set_without_an_equality_task_above_is_not_damped() {
    let mut scenario = Scenario::load(example(2)).expect("it is right");
    scenario.tasks[1].damping = Damping::Fixed(0.1);
    let errors = scenario
        .check()
        .expect_err("the task is a high-priority set");
    let keys: Vec<_> = errors.mistakes().iter().map(|m| m.key.as_str()).collect();
    assert_eq!(keys, ["task[2] \"obstacle_b\".damping"]);
}

#[test]
fn a_set_of_high_priority_needs_no_gain_and_a_gain_may_overshoot() {
    // At 125 Hz a gain of 249 1/s overshoots at every step, and still converges.
    let tasks = "[[task]]\nname = \"s\"\ntype = \"joint\"\njoint = 1\nmin = 0\nmax = 0\n\
                 [[task]]\nname = \"e\"\ntype = \"joint\"\njoint = 2\ndesired = 0\ngain_per_s = 249\n";
    assert!(Scenario::from_toml(&with_tasks(tasks)).is_ok());
}

#[test]
fn windows_line_ends_and_a_byte_order_mark_do_no_harm() {
    let text = fs::read_to_string(example(1)).expect("the example is there");
    let windows = format!("\u{feff}{}", text.replace('\n', "\r\n"));
    assert_eq!(Scenario::from_toml(&windows), Scenario::from_toml(&text));
    let wrong = windows.replace("rate_hz = 125", "rate_hz = 0");
    let errors = Scenario::from_toml(&wrong).expect_err("the rate is wrong");
    assert_eq!(
        (errors.mistakes()[0].line, errors.mistakes()[0].column),
        (9, 11)
    );
}

#[test]
fn messages_of_a_file_begin_with_its_path_line_and_column() {
    let file = TemporaryFile::new("bad.toml", b"[robot]\nmodle = 1\n");
    let error = Scenario::load(&file.0).expect_err("it is no scenario");
    let message = error.to_string();
    let begins = format!("{}:2:1: robot.modle: unknown key", file.0.display());
    assert!(
        message.lines().any(|line| line.starts_with(&begins)),
        "{message}"
    );
    assert!(matches!(error, LoadError::Mistakes { .. }));
}

#[test]
fn what_is_no_text_file_is_refused_with_its_path() {
    let noise: Vec<u8> = (0..10_000_000_u32)
        .map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8)
        .collect();
    let long = TemporaryFile::new("long.toml", &noise);
    let binary = TemporaryFile::new("binary.toml", b"title = \"x\"\nmodel = \xff\xfe");
    let missing = scenarios().join("nothing.toml");
    for (path, says) in [
        (long.0.as_path(), "is longer than 4000000 bytes"),
        (&binary.0, ":2:9: is not UTF-8"),
        (&missing, "cannot be read"),
        (&scenarios(), "is a directory"),
    ] {
        let message = Scenario::load(path)
            .expect_err("it is no scenario")
            .to_string();
        assert!(
            message.starts_with(&path.display().to_string()),
            "{message}"
        );
        assert!(message.contains(says), "{message}");
        assert!(message.len() < 1_000, "{message}");
    }
}

#[test]
fn long_and_deep_texts_give_short_messages() {
    let name = "n".repeat(MAX_FILE_BYTES);
    for text in [
        "a = [".repeat(500_000),
        "[".repeat(1_000_000),
        format!("a{}", ".a".repeat(1_000_000)),
        "[[task]]\n".repeat(400_000),
        (0..300_000)
            .map(|i| format!("k{i} = 1\n"))
            .collect::<Vec<_>>()
            .concat(),
        format!("{name} = 1"),
        with_tasks(&format!(
            "[[task]]\nname = \"{name}\"\ntype = \"{name}\"\n{name} = 1\n"
        )),
        "\0".repeat(1_000_000),
    ] {
        let errors = Scenario::from_toml(&text).expect_err("it is no scenario");
        let length = errors.to_string().len();
        assert!(length < 30_000, "{length} bytes for {:?}", &text[..20]);
    }
}

#[test]
fn a_changed_scenario_can_be_checked_again() {
    let mut scenario = Scenario::load(example(3)).expect("it is right");
    assert_eq!(scenario.check(), Ok(()));
    scenario.control.rate_hz = 0.1;
    scenario.robot.q0_rad[1] = f64::NAN;
    let errors = scenario.check().expect_err("it has become wrong");
    let keys: Vec<_> = errors.mistakes().iter().map(|m| m.key.as_str()).collect();
    assert_eq!(keys, ["robot.q0_rad[2]", "control.rate_hz"]);
}

/// A text with one random change: bytes cut out, put in, doubled or overwritten.
fn mutated(text: &str, changes: &[(usize, usize, String)]) -> String {
    let mut chars: Vec<char> = text.chars().collect();
    for (at, length, new) in changes {
        let at = at % (chars.len() + 1);
        let end = (at + length).min(chars.len());
        chars.splice(at..end, new.chars());
    }
    chars.into_iter().collect()
}

fn any_change() -> impl Strategy<Value = (usize, usize, String)> {
    let pieces = prop_oneof![
        Just(String::new()),
        Just("\0".to_owned()),
        Just("nan".to_owned()),
        Just("[[task]]\n".to_owned()),
        Just("[control]\n".to_owned()),
        Just("\"".to_owned()),
        Just("]".to_owned()),
        Just("-1e999".to_owned()),
        Just("ü€🦀".to_owned()),
        "[a-z0-9_.=\"\\[\\]{}, \n-]{0,6}",
        any::<char>().prop_map(String::from),
    ];
    (any::<usize>(), 0..20_usize, pieces)
}

/// Any right scenario: a random one of every kind of task and goal.
fn any_scenario() -> impl Strategy<Value = Scenario> {
    let number = || prop_oneof![-1e6..1e6, -1.0..1.0, Just(0.0), Just(-0.0), Just(5e-324)];
    let gain = || 1e-3..20.0;
    let goal = prop_oneof![
        (0.0..2.0, gain()).prop_map(|(x, g)| format!("desired = {x:?}\ngain_per_s = {g:?}\n")),
        (0.0..1.0, 1.0..2.0, gain())
            .prop_map(|(a, b, g)| format!("min = {a:?}\nmax = {b:?}\ngain_per_s = {g:?}\n")),
        (0.0..2.0, gain()).prop_map(|(a, g)| format!("max = {a:?}\ngain_per_s = {g:?}\n")),
    ];
    let vector = [number(), number(), number()].prop_filter("not zero", |v| *v != [0.0; 3]);
    let measured = (0..4, vector.clone(), 1..=6).prop_map(|(which, v, joint)| match which {
        0 => "type = \"coordinate\"\naxis = \"y\"\n".to_owned(),
        1 => format!("type = \"distance\"\npoint_m = {v:?}\n"),
        2 => format!("type = \"field_of_view\"\ndirection = {v:?}\n"),
        _ => format!("type = \"joint\"\njoint = {joint}\n"),
    });
    let damping = prop_oneof![
        Just(String::new()),
        prop::sample::select(DampingRule::ALL)
            .prop_map(|(rule, _)| format!("damping = {:?}\n", rule.name())),
        (0.0..1e6).prop_map(|lambda| format!("damping = {lambda:?}\n")),
    ];
    let scalar = (measured, goal).prop_map(|(measured, goal)| measured + &goal);
    let position = (vector, gain(), damping).prop_map(|(v, g, d)| {
        format!("type = \"position\"\ntarget_m = {v:?}\ngain_per_s = {g:?}\n{d}")
    });
    let task = prop_oneof![4 => scalar, 1 => position];
    let tasks = prop::collection::vec(task, 1..8);
    let title = prop::option::of(any::<String>());
    (tasks, 50.0..1000.0, 0.02..1e3, title).prop_map(|(tasks, rate, duration, title)| {
        let control = format!("[control]\nrate_hz = {rate:?}\nduration_s = {duration:?}\n");
        let named = |(i, task)| format!("[[task]]\nname = \"a/b-{i}\"\n{task}");
        let tasks: Vec<_> = tasks.iter().enumerate().map(named).collect();
        let text = control + &tasks.concat();
        let mut scenario = Scenario::from_toml(&with_tasks(&text)).expect("it is right");
        scenario.title = title;
        scenario
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(500) })]

    #[test]
    fn no_change_of_an_example_makes_the_reader_panic(
        number in 0..4_usize,
        changes in prop::collection::vec(any_change(), 1..6),
    ) {
        let text = match number {
            0 => template().to_owned(),
            number => fs::read_to_string(example(number)).expect("the example is there"),
        };
        let text = mutated(&text, &changes);
        match Scenario::from_toml(&text) {
            Ok(scenario) => prop_assert_eq!(scenario.check(), Ok(())),
            Err(errors) => {
                prop_assert!(!errors.mistakes().is_empty());
                for mistake in errors.mistakes() {
                    prop_assert!(text.get(mistake.span.clone()).is_some(), "{:?}", mistake);
                    prop_assert!(mistake.line >= 1 && mistake.column >= 1);
                    prop_assert!(mistake.line <= text.split('\n').count());
                    prop_assert!(!mistake.what.is_empty() && !mistake.help.is_empty());
                    prop_assert!(!mistake.what.contains("cannot be read"), "{:?}", mistake);
                }
            }
        }
    }

    #[test]
    fn any_text_is_read_or_refused(text in any::<String>()) {
        prop_assert!(Scenario::from_toml(&text).is_err());
    }

    #[test]
    fn a_written_scenario_reads_back_the_same(scenario in any_scenario()) {
        let text = scenario.to_toml();
        let again = Scenario::from_toml(&text);
        prop_assert_eq!(again.as_ref(), Ok(&scenario), "{}", text);
    }

    #[test]
    fn a_scenario_in_json_reads_back_the_same(scenario in any_scenario()) {
        let json = serde_json::to_string(&scenario).expect("a scenario can be written");
        let again: Scenario = serde_json::from_str(&json).expect("and read");
        prop_assert_eq!(again, scenario);
    }
}

#[test]
fn the_examples_written_again_read_back_the_same() {
    for number in 1..=3 {
        let scenario = Scenario::load(example(number)).expect("it is right");
        assert_eq!(Scenario::from_toml(&scenario.to_toml()), Ok(scenario));
    }
}
