//! Waypoints of poses and orientations, and of other frames than the tool, are visited in order.

use std::sync::atomic::AtomicBool;

use conik::{Kinematics, Pose, PoseWaypoints};
use conik_sim::arm::IdealArm;
use conik_sim::experiment::Experiment;
use conik_sim::record::Record;
use conik_sim::run;
use conik_sim::scenario::Scenario;

fn records(task: &str) -> (Experiment, Vec<Record>) {
    let text = format!(
        "[robot]\nmodel = \"ur5-paper\"\nq0_deg = [-48, -118, -98, -60, 75, 10]\n\
         [control]\nduration_s = 20\n[[task]]\nname = \"it\"\n{task}\n"
    );
    let scenario = Scenario::from_toml(&text).unwrap_or_else(|errors| panic!("{text}\n{errors}"));
    let experiment = Experiment::new(&scenario).expect("sound");
    let mut arm = IdealArm::at(experiment.q0);
    let mut records = Vec::new();
    let mut sink = |record: Record| {
        records.push(record);
        Ok(())
    };
    let ended = run::run(experiment, &mut arm, &mut sink, &AtomicBool::new(false));
    (ended.experiment, records)
}

/// For each waypoint the tick that reached it and what was to go and to turn then and a tick earlier.
fn arrivals(
    experiment: &Experiment,
    records: &[Record],
    pose: impl Fn(&Kinematics) -> Pose,
    places: &[Pose],
) -> Vec<(usize, [(f64, f64); 2])> {
    let mut kinematics = Kinematics::new(&experiment.robot);
    let mut to_go = |tick: usize, nth: usize| {
        kinematics.update(&records[tick].q);
        PoseWaypoints::to_go(&places[nth], &pose(&kinematics))
    };
    let reached = records.iter().enumerate();
    let reached = reached.filter_map(|(tick, record)| Some((tick, record.reached?)));
    let reached: Vec<_> = reached.collect();
    let order: Vec<usize> = reached.iter().map(|(_, nth)| *nth).collect();
    assert_eq!(
        order,
        (0..places.len()).collect::<Vec<_>>(),
        "all, in order"
    );
    let at = reached.into_iter();
    at.map(|(tick, nth)| (tick, [to_go(tick, nth), to_go(tick - 1, nth)]))
        .collect()
}

fn place(point: [f64; 3], rpy_deg: [f64; 3]) -> Pose {
    Pose {
        origin: point.into(),
        ..Pose::from_rpy(rpy_deg.map(f64::to_radians))
    }
}

fn tool(kinematics: &Kinematics) -> Pose {
    *kinematics.world_from(conik::Frame::Tool)
}

const GAIN: &str = "gain_per_s = 2";

#[test]
fn poses_are_reached_when_place_and_turn_are_both_met() {
    let (experiment, records) = records(&format!(
        "type = \"pose\"\n{GAIN}\nacceptance_m = 0.01\nacceptance_deg = 3\n\
         waypoints_m = [[0.3, -0.3, 0.3], [0.3, -0.3, 0.3], [0.35, -0.2, 0.25]]\n\
         waypoints_rpy_deg = [[150, 10, 20], [150, 10, 60], [150, 10, 60]]"
    ));
    let places = [
        place([0.3, -0.3, 0.3], [150.0, 10.0, 20.0]),
        place([0.3, -0.3, 0.3], [150.0, 10.0, 60.0]),
        place([0.35, -0.2, 0.25], [150.0, 10.0, 60.0]),
    ];
    let angle = 3_f64.to_radians();
    let arrivals = arrivals(&experiment, &records, tool, &places);
    for (tick, [now, before]) in &arrivals {
        let is_met = |(distance, turn): &(f64, f64)| *distance < 0.01 && *turn < angle;
        assert!(is_met(now) && !is_met(before), "{tick}: {now:?} {before:?}");
    }
    let (turned, [_, before]) = arrivals[1];
    assert!(
        before.0 < 0.01 && before.1 > angle,
        "only turned: {before:?}"
    );
    let (moved, [_, before]) = arrivals[2];
    assert!(
        before.0 > 0.01 && before.1 < angle,
        "only moved: {before:?}"
    );
    assert_eq!(records[turned - 1].waypoint, 1);
    assert_eq!((records[turned].waypoint, records[moved].waypoint), (2, 2));
    let last = records.last().expect("a run");
    assert!(last.task_values[0] < 1e-9, "{}", last.task_values[0]);
}

#[test]
fn orientations_alone_are_visited_wherever_the_tool_is() {
    let (experiment, records) = records(&format!(
        "type = \"orientation\"\n{GAIN}\nacceptance_rad = 0.05\n\
         waypoints_rpy_deg = [[150, 10, 20], [150, -10, 60]]"
    ));
    let places = [[150.0, 10.0, 20.0], [150.0, -10.0, 60.0]].map(|rpy| place([0.0; 3], rpy));
    for (tick, [now, before]) in arrivals(&experiment, &records, tool, &places) {
        assert!(
            now.1 < 0.05 && before.1 >= 0.05,
            "{tick}: {now:?} {before:?}"
        );
    }
    assert!(records.last().expect("a run").task_values[0] < 1e-9);
}

#[test]
fn waypoints_are_visited_by_the_frame_that_is_measured_as_it_is_seen() {
    let (experiment, records) = records(&format!(
        "type = \"position\"\nframe = \"link_5\"\nrelative_to = \"link_1\"\n{GAIN}\nacceptance_m = 0.01\n\
         waypoints_m = [[0.3, 0.3, 0.11], [0.2, 0.4, 0.11]]"
    ));
    let link = |name: &str| experiment.robot.frame(name).expect("a link");
    let (wrist, shoulder) = (link("link_5"), link("link_1"));
    let seen = |kinematics: &Kinematics| {
        kinematics.world_from(shoulder).inverse() * *kinematics.world_from(wrist)
    };
    let places = [[0.3, 0.3, 0.11], [0.2, 0.4, 0.11]].map(|point| place(point, [0.0; 3]));
    for (tick, [now, before]) in arrivals(&experiment, &records, seen, &places) {
        assert!(
            now.0 < 0.01 && before.0 >= 0.01,
            "{tick}: {now:?} {before:?}"
        );
    }
}
