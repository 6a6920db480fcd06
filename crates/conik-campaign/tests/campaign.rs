//! Campaigns: the same bytes whatever the workers, what was interrupted goes on, failures have their classes.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use conik_campaign::class::Class;
use conik_campaign::flown::row;
use conik_campaign::folder::{Folder, FolderError, SHARD};
use conik_campaign::plan::{Plan, PlanError, Starts, Varied};
use conik_campaign::tally::Kept;
use conik_campaign::work::Progress;
use conik_sim::scenario::{Border, Scenario};

const EXAMPLE: &str = include_str!("../../../scenarios/paper/example2.toml");

/// An empty folder for a test.
fn empty(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    folder
}

/// Example 2, for a short time.
fn scenario(duration_s: f64) -> Scenario {
    let mut scenario = Scenario::from_toml(EXAMPLE).expect("it is right");
    scenario.control.duration_s = duration_s;
    scenario
}

fn plan(runs: u64, duration_s: f64) -> Plan {
    let varied = Varied {
        obstacles_m: 0.02,
        targets_m: 0.05,
        rates_hz: vec![50.0, 125.0],
        servo_lag_s: Some([0.03, 0.1]),
        ..Varied::default()
    };
    Plan::new(scenario(duration_s), runs, 7, varied).expect("it makes sense")
}

fn bytes(folder: &Folder, jobs: usize) -> Vec<u8> {
    assert!(folder.work(jobs, &Progress::default()).unwrap());
    folder.finish().unwrap();
    fs::read(folder.file("runs.parquet")).unwrap()
}

#[test]
fn bytes_are_the_same_whatever_the_number_of_workers() {
    let plan = plan(2 * SHARD + 10, 0.2);
    let tables = [("one", 1), ("three", 3)].map(|(name, jobs)| {
        let folder = Folder::open(&empty(name), &plan).unwrap();
        let bytes = bytes(&folder, jobs);
        assert!(folder.is_finished());
        let left = fs::read_dir(folder.file("")).unwrap().flatten();
        let parquet = left.filter(|file| file.path().extension().is_some_and(|it| it == "parquet"));
        assert_eq!(parquet.count(), 1);
        bytes
    });
    assert!(tables[0].len() > 10_000);
    assert_eq!(tables[0], tables[1]);
}

#[test]
fn campaign_that_was_stopped_goes_on_to_the_same_end() {
    let plan = plan(2 * SHARD, 0.2);
    let whole = bytes(&Folder::open(&empty("whole"), &plan).unwrap(), 1);
    let path = empty("stopped");
    let folder = Folder::open(&path, &plan).unwrap();
    folder
        .keep(1, &plan.shard(1, || true).unwrap().unwrap())
        .unwrap();
    let progress = Progress::default();
    progress.stop.store(true, Ordering::Relaxed);
    assert!(!folder.work(1, &progress).unwrap());
    // What was being written when the power went off.
    fs::write(path.join("shards/000000.1.part"), "{\"run\":0,").unwrap();
    let again = Folder::open(&path, &plan).unwrap();
    assert_eq!(again.missing(), [0]);
    assert_eq!(bytes(&again, 2), whole);
}

#[test]
fn folder_of_another_campaign_is_refused() {
    let path = empty("other");
    Folder::open(&path, &plan(10, 0.2)).unwrap();
    let other = Folder::open(&path, &plan(11, 0.2)).unwrap_err();
    let is_told = matches!(&other, FolderError::Other { what, .. } if *what == "number of runs");
    assert!(is_told, "{other}");
    fs::write(path.join("plan.json"), "nothing").unwrap();
    let broken = Folder::open(&path, &plan(10, 0.2)).unwrap_err();
    assert!(matches!(broken, FolderError::Broken { .. }), "{broken}");
}

#[test]
fn shard_that_lost_a_row_is_found() {
    let plan = plan(10, 0.2);
    let folder = Folder::open(&empty("lost"), &plan).unwrap();
    let lines = plan.shard(0, || true).unwrap().unwrap();
    let (kept, _) = lines.trim_end().rsplit_once('\n').unwrap();
    folder.keep(0, kept).unwrap();
    let error = folder.finish().unwrap_err();
    assert!(error.to_string().contains("run 9 is missing"), "{error}");
}

#[test]
fn plans_that_make_no_sense_are_refused() {
    let plan = |varied: Varied, runs| Plan::new(scenario(1.0), runs, 1, varied);
    let same = Varied {
        starts: Starts::Same,
        ..Varied::default()
    };
    assert_eq!(plan(same.clone(), 2), Err(PlanError::NothingVaries));
    assert!(plan(same, 1).is_ok());
    assert_eq!(plan(Varied::default(), 0), Err(PlanError::NoRuns));
    for bad in [f64::NAN, -1.0, f64::INFINITY] {
        let mut all = [(); 5].map(|()| Varied::default());
        all[0].targets_m = bad;
        all[1].obstacles_m = bad;
        all[2].starts = Starts::Near(bad);
        all[3].rates_hz = vec![125.0, bad];
        all[4].servo_lag_s = Some([0.1, bad]);
        for varied in all {
            let refused = plan(varied.clone(), 10);
            assert!(
                matches!(refused, Err(PlanError::BadNumber { .. })),
                "{varied:?}"
            );
        }
    }
}

#[test]
fn what_varies_leaves_the_rest_as_it_is() {
    let first = plan(100, 1.0);
    let mut fewer = first.clone();
    fewer.varied.servo_lag_s = None;
    for run in [0, 1, 99] {
        let (case, other) = (first.case(run).unwrap(), fewer.case(run).unwrap());
        assert_eq!(case.scenario, other.scenario);
        assert!(case.servo_lag_s.is_some() && other.servo_lag_s.is_none());
        case.scenario.check().expect("a case is a scenario");
        let next = first.case(run + 1).unwrap().scenario;
        assert_ne!(case.scenario.robot.q0_rad, next.robot.q0_rad);
        assert_ne!(case.scenario.tasks, next.tasks);
    }
}

/// The class of one run of a scenario, from its own start.
fn class_of(text: &str) -> Class {
    let head = "[robot]\nmodel = \"ur5-paper\"\nq0_deg = [-48, -158, -108, -90, -85, 0]\n";
    let scenario = Scenario::from_toml(&format!("{head}{text}"));
    let scenario = scenario.unwrap_or_else(|errors| panic!("{errors}"));
    let varied = Varied {
        starts: Starts::Same,
        ..Varied::default()
    };
    let plan = Plan::new(scenario, 1, 1, varied).expect("it makes sense");
    let row = row(&plan.case(0).unwrap()).unwrap();
    assert_eq!(row.outcome, "completed", "{row:?}");
    row.class
}

#[test]
fn failures_have_their_classes() {
    let goes = "[[task]]\nname = \"p\"\ntype = \"position\"\ngain_per_s = 1\ntarget_m =";
    let ball = "[[task]]\nname = \"ball\"\ntype = \"distance\"\nmin = 0.2\npoint_m =";
    assert_eq!(class_of(&format!("{goes} [0.4, 0.2, 0.1]")), Class::None);
    // Further away than the arm reaches.
    assert_eq!(
        class_of(&format!("{goes} [1.4, 0.2, 0.1]")),
        Class::Singularity
    );
    // In the middle of what is kept away from.
    let inside = format!("{ball} [0.4, 0.2, 0.1]\n{goes} [0.4, 0.2, 0.1]");
    assert_eq!(class_of(&inside), Class::LocalMinimum);
    let short = format!("[control]\nduration_s = 3\n{goes} [0.4, 0.2, 0.1]");
    assert_eq!(class_of(&short), Class::OnItsWay);
    let second = goes.replace("\"p\"", "\"second\"");
    let twice = format!("{goes} [0.4, 0.2, 0.1]\n{second} [0.3, 0.2, 0.1]");
    assert_eq!(class_of(&twice), Class::DependentTasks);
    let conflict = "[[task]]\nname = \"low\"\ntype = \"height\"\nmax = -0.5\n\
        [[task]]\nname = \"near\"\ntype = \"height\"\nmin = -0.3\n";
    let conflict = class_of(&format!("{conflict}{goes} [0.4, 0.2, 0.1]"));
    assert_eq!(conflict, Class::ConflictOfSets);
}

#[test]
fn paper_s_borders_are_left_between_samples_and_ours_are_not() {
    for (border, is_left) in [(Border::Freeze, true), (Border::Land, false)] {
        let mut plan = plan(60, 20.0);
        plan.varied = Varied::default();
        plan.scenario.control.border = border;
        let rows: Vec<_> = (0..60)
            .map(|run| row(&plan.case(run).unwrap()).unwrap())
            .collect();
        let left = rows.iter().filter(|row| row.class == Class::Freeze).count();
        assert_eq!(left > 0, is_left, "{left} of {border:?}");
        let broken = rows
            .iter()
            .filter(|row| (1..4).any(|nth| row.kept[nth] == Some(false)));
        assert_eq!(broken.count() > 0, is_left, "{border:?}");
    }
}

/// The paper's rule from three of a hundred thousand starts: a waypoint is reached in the last second; the wrist
/// turns at full speed from the first second to the last; the arm creeps while an obstacle far away is held.
#[test]
fn arm_that_does_not_rest_has_a_class_too() {
    let of = |example: &str, run| {
        let scenario = Scenario::from_toml(example).expect("it is right");
        let plan = Plan::new(scenario, 100_000, 1, Varied::default()).unwrap();
        let row = row(&plan.case(run).unwrap()).unwrap();
        (row.class, row.waypoints_reached)
    };
    let [first, third] = [
        include_str!("../../../scenarios/paper/example1.toml"),
        include_str!("../../../scenarios/paper/example3.toml"),
    ];
    assert_eq!(of(first, 38_694), (Class::OnItsWay, 1));
    assert_eq!(of(first, 53_700), (Class::SpeedLimit, 0));
    assert_eq!(of(third, 30), (Class::FrozenInside, 0));
}

#[test]
fn bound_is_wilson_s() {
    let of = |shown: u64, kept: u64| {
        let kept = Kept {
            shown,
            kept,
            ..Kept::default()
        };
        kept.bound()
    };
    // z² / (n + z²), z = 1.6449.
    assert!((of(300, 300) - 2.705_543_454 / 302.705_543_454).abs() < 1e-9);
    assert!((of(100, 90) - 0.1596).abs() < 2e-3, "{}", of(100, 90));
    assert!((of(0, 0) - 1.0).abs() < 1e-12);
}
