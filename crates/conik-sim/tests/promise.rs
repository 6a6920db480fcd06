//! What border `land` promises, and what the summary tells of the landings.

use std::sync::atomic::AtomicBool;

use conik_sim::arm::{ArmError, IdealArm};
use conik_sim::experiment::Experiment;
use conik_sim::monitors::{Sighting, Verdict};
use conik_sim::record::Record;
use conik_sim::run::run;
use conik_sim::scenario::{
    Border, Damping, Frames, GoalConfig, ModeRule, Motion, Recursion, Scenario, TaskConfig,
    TaskKind,
};
use conik_sim::summarise::Summariser;
use conik_sim::summary::{ChangeMade, Outcome, Property, Settings, Summary};

/// The paper's Example 2 under the default rules.
fn example2() -> Scenario {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../scenarios/paper/example2.toml"
    );
    let mut scenario = Scenario::load(path).expect("a sound scenario");
    scenario.control.mode_rule = ModeRule::Cone;
    scenario.control.border = Border::Land;
    scenario.control.recursion = Recursion::SicilianoSlotine;
    scenario
}

/// Runs a scenario on the ideal arm.
fn run_of(scenario: Scenario) -> (Vec<Record>, Summary) {
    let experiment = Experiment::new(&scenario).expect("a sound scenario");
    let mut summariser = Summariser::new(experiment.controller.stack(), 2);
    let units = experiment
        .controller
        .stack()
        .iter()
        .map(|(_, level)| (level.name().to_owned(), level.task().unit().to_owned()))
        .collect();
    let mut arm = IdealArm::at(experiment.q0);
    let mut records = vec![];
    let ended = run(
        experiment,
        &mut arm,
        &mut |record: Record| -> Result<(), ArmError> {
            summariser.take(&record);
            records.push(record);
            Ok(())
        },
        &AtomicBool::new(false),
    );
    let settings = Settings {
        robot: "ideal".to_owned(),
        scenario,
        joint_names: vec![],
        units,
    };
    (records, summariser.finish(&ended, settings, "0"))
}

/// A dip of the view that high-priority sets must not take.
fn dip(worst: f64) -> Property {
    Property {
        holds: worst <= 1e-6,
        worst,
        at_s: Some(13.504),
        task: Some("view".to_owned()),
    }
}

#[test]
fn broken_property_is_a_fault_with_border_land_and_none_with_freeze() {
    let (_, sound) = run_of(example2());
    assert_eq!(sound.faults(), [""; 0]);
    for break_it in [
        |summary: &mut Summary| summary.properties.inside_stays = dip(0.0021),
        |summary: &mut Summary| summary.properties.outside_never_worse = dip(0.0021),
        |summary: &mut Summary| summary.properties.entered_stays = dip(0.0021),
    ] {
        let mut summary = sound.clone();
        break_it(&mut summary);
        let faults = summary.faults();
        assert_eq!(faults.len(), 1, "{faults:?}");
        for part in [
            "promise-broken",
            "`view`",
            "2.100e-3",
            "at 13.504 s",
            "`land`",
        ] {
            assert!(faults[0].contains(part), "{part} is not in {faults:?}");
        }
        summary.settings.scenario.control.border = Border::Freeze;
        assert_eq!(summary.faults(), [""; 0]);
    }
}

#[test]
fn sample_outside_is_a_fault_that_says_whether_it_was_announced() {
    let (_, mut summary) = run_of(example2());
    let seen = |worst| Sighting {
        verdict: Verdict::Seen,
        ticks: 1,
        for_s: 0.008,
        worst,
        at_s: Some(2.0),
        task: Some("obstacle_a".to_owned()),
    };
    summary.properties.inside_stays = dip(0.0021);
    summary.monitors.as_mut().expect("watched").went_outside = seen(0.0021);
    let announced = summary.faults();
    assert_eq!(announced.len(), 1, "{announced:?}");
    assert!(announced[0].contains("the tick before had announced"));
    summary.properties.inside_stays = dip(0.0);
    // Within the tolerance of the properties, but nobody had said so.
    summary.monitors.as_mut().expect("watched").unannounced = seen(1e-9);
    let unannounced = summary.faults();
    assert_eq!(unannounced.len(), 1, "{unannounced:?}");
    for part in ["`obstacle_a`", "1.000e-9 m", "had said nothing", "at 2 s"] {
        assert!(unannounced[0].contains(part), "{part}: {unannounced:?}");
    }
    summary.settings.scenario.control.border = Border::Freeze;
    assert_eq!(summary.faults(), [""; 0]);
}

/// The tool of Example 2 stays where it is, and a ball of 0.1 m crosses its place at `speed` [m/s].
fn crossing(speed: f64) -> Scenario {
    let mut scenario = example2();
    let experiment = Experiment::new(&scenario).expect("a sound scenario");
    let mut kinematics = conik::Kinematics::new(&experiment.robot);
    kinematics.update(&experiment.q0);
    let tool = kinematics.world_from(conik::Frame::Tool).origin.to_array();
    scenario.tasks.truncate(1);
    scenario.tasks.push(TaskConfig {
        name: "position".to_owned(),
        kind: TaskKind::Position,
        goal: GoalConfig::Desired {
            desired: tool.to_vec(),
            gain_per_s: 1.0,
        },
        frames: Frames::default(),
        motion: Motion::default(),
        damping: Damping::default(),
    });
    let mut start = tool;
    start[1] -= 0.3;
    scenario.tasks[0].kind = TaskKind::Distance { point_m: start };
    scenario.tasks[0].motion = Motion {
        velocity_m_per_s: Some([0.0, speed, 0.0]),
        ..Motion::default()
    };
    scenario.tasks[0].goal = GoalConfig::Set {
        min: Some(0.1),
        max: None,
        recovery_per_s: None,
        gain_per_s: None,
    };
    scenario.control.exclusive.clear();
    scenario.control.duration_s = 0.6 / speed;
    scenario
}

#[test]
fn ball_that_moves_is_avoided_where_the_arm_is_fast_enough_and_else_announced() {
    let (records, slow) = run_of(crossing(0.2));
    assert_eq!(slow.faults(), [""; 0]);
    let closest = |records: &[Record]| {
        let values = records.iter().map(|record| record.task_values[0]);
        values.fold(f64::INFINITY, f64::min)
    };
    assert!((0.1..0.1 + 1e-3).contains(&closest(&records)), "it came");
    let seen = slow.monitors.expect("watched");
    assert_eq!(seen.went_outside.verdict, Verdict::Never);

    let (records, fast) = run_of(crossing(20.0));
    assert!(closest(&records) < 0.09, "no arm is so fast");
    let seen = fast.monitors.as_ref().expect("watched");
    assert_eq!(seen.went_outside.verdict, Verdict::Seen);
    assert_eq!(seen.unannounced.verdict, Verdict::Never);
    assert!(seen.joints.iter().any(|joint| joint.speed_limited_s > 0.0));
    let faults = fast.faults();
    assert!(
        faults[0].contains("the tick before had announced"),
        "{faults:?}"
    );
}

/// The tool starts 0.05 m inside a ball that is at rest.
#[test]
fn set_that_starts_outside_is_entered_at_the_speed_of_recovery() {
    let mut scenario = crossing(0.2);
    let TaskKind::Distance { point_m } = &mut scenario.tasks[0].kind else {
        panic!("a ball");
    };
    point_m[1] += 0.25;
    scenario.tasks[0].motion = Motion::default();
    scenario.control.duration_s = 2.0;
    let entered = |recovery: Option<f64>| {
        let mut scenario = scenario.clone();
        if let GoalConfig::Set { recovery_per_s, .. } = &mut scenario.tasks[0].goal {
            *recovery_per_s = recovery;
        }
        let (_, summary) = run_of(scenario);
        assert_eq!(summary.faults(), [""; 0]);
        summary.tasks["obstacle_a"].entered_set_s
    };
    assert_eq!(entered(None), None, "nothing drives it in");
    let at_s = entered(Some(0.05)).expect("it is driven in");
    assert!((at_s - 1.0).abs() < 0.05, "0.05 m at 0.05 m/s: {at_s} s");
}

#[test]
fn summary_counts_how_often_each_set_was_held() {
    let (records, summary) = run_of(example2());
    let task = conik::Stack::find;
    let experiment = Experiment::new(&example2()).expect("a sound scenario");
    let view = task(experiment.controller.stack(), "view").expect("there");
    let mut times = 0;
    let mut was = false;
    let mut crossing: f64 = 0.0;
    for record in &records {
        let is = record.active.contains(view);
        times += u64::from(is && !was);
        was = is;
        for reason in &record.reasons {
            if let conik::Reason::Holds {
                task, crossing: by, ..
            } = *reason
                && task == view
            {
                crossing = crossing.max(by);
            }
        }
    }
    let result = &summary.tasks["view"];
    assert!(times > 0 && crossing > 0.0, "the run shows something");
    assert_eq!(result.held_times, Some(times));
    assert_eq!(result.largest_crossing, Some(crossing));
    assert_eq!(summary.tasks["position"].held_times, None);
}

#[test]
fn observations_and_what_is_within_tolerance_are_no_faults() {
    let (_, mut summary) = run_of(example2());
    summary.properties.equality_converges = dip(1.0);
    summary.properties.low_priority_excess = dip(1.0);
    summary.properties.entered_stays = dip(1e-6);
    assert_eq!(summary.faults(), [""; 0]);
}

#[test]
fn fault_that_ended_the_run_is_told_before_a_broken_promise() {
    let (_, mut summary) = run_of(example2());
    summary.outcome = Outcome::Fault {
        name: "tracking-lost".to_owned(),
        detail: "the arm fell behind".to_owned(),
    };
    summary.properties.entered_stays = dip(0.5);
    let faults = summary.faults();
    assert_eq!(faults[0], "tracking-lost: the arm fell behind");
    assert!(
        faults[1].starts_with("promise-broken: `view`"),
        "{faults:?}"
    );
    assert_eq!(faults.len(), 2);
}

#[test]
fn summary_adds_up_what_landing_took() {
    let (records, summary) = run_of(example2());
    let landing = summary.landing.expect("border land");
    let ticks = |which: fn(&Record) -> bool| records.iter().filter(|r| which(r)).count() as u64;
    assert_eq!(landing.corrected_ticks, ticks(|r| r.landed.corrections > 0));
    assert!(landing.corrected_ticks > 10, "the run shows something");
    assert_eq!(landing.stood_still_ticks, ticks(|r| r.landed.stood_still));
    let halvings: usize = records.iter().map(|r| r.landed.halvings).sum();
    assert_eq!(landing.halvings, halvings as u64);
    let work = summary.step_work_max;
    let most = |of: fn(&Record) -> usize| records.iter().map(of).max();
    assert_eq!(Some(work.landing_trials), most(|r| r.landed.kinematics));
    assert_eq!(Some(work.pivots), most(|r| r.pivots));
    assert!(work.landing_trials >= 2 && work.pivots >= 2);
    assert_eq!(work.modes, 0, "rule cone goes through no modes");
}

#[test]
fn paper_rules_land_nowhere_and_go_through_modes() {
    let mut scenario = example2();
    scenario.control.mode_rule = ModeRule::Paper;
    scenario.control.border = Border::Freeze;
    scenario.control.recursion = Recursion::Chiaverini;
    let (_, summary) = run_of(scenario);
    assert_eq!(summary.landing, None);
    let work = summary.step_work_max;
    assert_eq!((work.landing_trials, work.pivots), (0, 0));
    assert!(work.modes >= 2);
}

#[test]
fn summaries_of_earlier_builds_are_still_read() {
    let (_, summary) = run_of(example2());
    let mut json = serde_json::to_value(&summary).expect("a summary can be written");
    let fields = json.as_object_mut().expect("an object");
    assert!(fields.remove("landing").is_some() && fields.remove("step_work_max").is_some());
    assert!(fields.remove("monitors").is_some());
    for task in fields["tasks"].as_object_mut().expect("tasks").values_mut() {
        let task = task.as_object_mut().expect("an object");
        assert!(task.remove("held_times").is_some());
        assert!(task.remove("largest_crossing").is_some());
    }
    let read: Summary = serde_json::from_value(json).expect("an earlier summary");
    assert_eq!(read.landing, None);
    assert_eq!((read.monitors, read.tasks["view"].held_times), (None, None));
    assert_eq!(read.tasks["view"].max, summary.tasks["view"].max);
}

#[test]
fn whoever_changes_the_border_meanwhile_takes_the_promise_away() {
    let mut scenario = example2();
    scenario.control.duration_s = 0.1;
    let (_, mut summary) = run_of(scenario);
    summary.properties.inside_stays = dip(0.0021);
    let change = |text: &str| {
        let changes = serde_json::from_str(text).expect("a change");
        ChangeMade::of(vec![changes])
    };
    let gain = r#"{"task": "position", "key": "gain_per_s", "value": 0.5}"#;
    summary.changes = vec![change(gain)];
    assert_eq!(summary.faults().len(), 1, "other changes leave it as it is");
    let border = r#"{"control": "border", "value": "freeze"}"#;
    summary.changes.push(change(border));
    assert_eq!(summary.faults(), [""; 0]);
}
