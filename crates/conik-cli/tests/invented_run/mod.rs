//! Run folders made up for the tests: a tool on a circle, sets of which every third becomes active.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;
use std::time::Duration;

use conik_sim::cycle_times::{CycleSummary, CycleTimes};
use conik_sim::monitors::{JointMonitor, Monitors, Sighting, Verdict};
use conik_sim::scenario::{
    Border, Control, Damping, Frames, GoalConfig, LimitsConfig, ModeRule, Motion, PlacesConfig,
    Recursion, RobotConfig, RobotSource, Scenario, TaskConfig, TaskKind,
};
use conik_sim::summary::{
    FORMAT, ModeChange, Outcome, Properties, Property, Settings, StepTime, StepWork, Summary,
    TaskSummary, Tracking,
};

/// What the invented run is like.
// A list of yes and no is what a table of cases needs.
#[allow(clippy::struct_excessive_bools)]
#[derive(Clone)]
pub struct Invention {
    pub title: String,
    pub rows: u32,
    pub sets: usize,
    pub set_name: String,
    pub joints: usize,
    pub waypoints: usize,
    pub has_equality: bool,
    pub has_view: bool,
    pub mode_numbers: bool,
    pub flickers: bool,
    pub constant: bool,
    pub broken_values: bool,
    pub outcome: Outcome,
}

impl Default for Invention {
    fn default() -> Self {
        Self {
            title: "An invented run".into(),
            rows: 500,
            sets: 2,
            set_name: "obstacle".into(),
            joints: 6,
            waypoints: 2,
            has_equality: true,
            has_view: true,
            mode_numbers: true,
            flickers: false,
            constant: false,
            broken_values: false,
            outcome: Outcome::Completed,
        }
    }
}

impl Invention {
    /// Writes the run folder, a new one for each `name`.
    pub fn write(&self, name: &str) -> PathBuf {
        let dir = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
        fs::create_dir_all(&dir).unwrap();
        fs::write(dir.join("log.csv"), self.log()).unwrap();
        let summary = serde_json::to_string_pretty(&self.summary()).unwrap();
        fs::write(dir.join("summary.json"), summary).unwrap();
        dir
    }

    fn set_names(&self) -> Vec<String> {
        (0..self.sets)
            .map(|n| format!("{}_{n}", self.set_name))
            .collect()
    }

    fn active_at(&self, row: u32) -> Vec<String> {
        let phase = if self.flickers {
            row % 2
        } else {
            row * 5 / self.rows.max(1)
        };
        let names = self.set_names();
        let active =
            (0..self.sets).filter(|n| n % 3 == 0 && phase % 2 == 1 || n % 7 == 1 && phase == 3);
        active.map(|n| names[n].clone()).collect()
    }

    fn log(&self) -> String {
        let sets = self.set_names();
        let mut header = "t_s,mode,active,waypoint".to_owned();
        for name in sets
            .iter()
            .map(String::as_str)
            .chain(self.has_view.then_some("view"))
        {
            let _ = write!(header, ",{name}");
        }
        if self.has_equality {
            header.push_str(",position_error");
        }
        header.push_str(",tool_x_m,tool_y_m,tool_z_m");
        for (stem, unit) in [("q", "_rad"), ("qd", "_rad_s"), ("qdd", "_rad_s2")] {
            for joint in 1..=self.joints {
                let _ = write!(header, ",{stem}{joint}{unit}");
            }
        }
        let mut log = header + "\n";
        for row in 0..self.rows {
            let t = if self.constant {
                0.0
            } else {
                f64::from(row) * 0.008
            };
            let active = self.active_at(row);
            let mode = if self.mode_numbers {
                (active.len() + 1).to_string()
            } else {
                String::new()
            };
            let _ = write!(
                log,
                "{},{mode},{},0",
                f64::from(row) * 0.008,
                active.join("+")
            );
            for n in 0..self.sets {
                let value = if self.broken_values {
                    f64::NAN
                } else {
                    0.3 + 0.15 * (t + n as f64).cos()
                };
                let _ = write!(log, ",{value}");
            }
            if self.has_view {
                let _ = write!(log, ",{}", (-t).exp());
            }
            if self.has_equality {
                let _ = write!(
                    log,
                    ",{}",
                    if self.broken_values {
                        f64::INFINITY
                    } else {
                        0.5 * (-3.0 * t).exp()
                    }
                );
            }
            let z = if self.broken_values { f64::NAN } else { -0.2 };
            let _ = write!(log, ",{},{},{z}", 0.5 + 0.1 * t.cos(), 0.3 * t.sin());
            for joint in 0..3 * self.joints {
                let _ = write!(log, ",{}", (t + joint as f64).sin());
            }
            log.push('\n');
        }
        log
    }

    fn tasks(&self) -> Vec<TaskConfig> {
        let mut tasks: Vec<TaskConfig> = (0..)
            .zip(self.set_names())
            .map(|(n, name)| TaskConfig {
                name,
                kind: TaskKind::Distance {
                    point_m: [0.4, -0.3 + 0.1 * f64::from(n), -0.3],
                },
                goal: GoalConfig::Set {
                    min: Some(0.17),
                    max: None,
                    recovery_per_s: None,
                    gain_per_s: None,
                },
                frames: Frames::default(),
                motion: Motion::default(),
                damping: Damping::default(),
            })
            .collect();
        if self.has_equality {
            let waypoints = (0..self.waypoints)
                .map(|n| [0.5, 0.1 * n as f64, -0.2])
                .collect();
            tasks.push(TaskConfig {
                name: "position".into(),
                kind: TaskKind::Position,
                goal: if self.waypoints > 0 {
                    GoalConfig::Waypoints {
                        waypoints_m: waypoints,
                        waypoints_quaternion_wxyz: Vec::new(),
                        acceptance_m: Some(0.02),
                        acceptance_rad: None,
                        gain_per_s: 0.3,
                    }
                } else {
                    GoalConfig::Desired {
                        desired: vec![0.5, 0.1, -0.2],
                        gain_per_s: 0.3,
                    }
                },
                frames: Frames::default(),
                motion: Motion::default(),
                damping: Damping::default(),
            });
        }
        if self.has_view {
            // First in the list, so that a figure that shows it last has moved it there.
            let view = TaskConfig {
                name: "view".into(),
                kind: TaskKind::FieldOfView {
                    direction: [1.0, 0.0, 0.0],
                },
                goal: GoalConfig::Set {
                    min: None,
                    max: Some(0.2622),
                    recovery_per_s: None,
                    gain_per_s: Some(1.0),
                },
                frames: Frames::default(),
                motion: Motion::default(),
                damping: Damping::default(),
            };
            tasks.insert(0, view);
        }
        tasks
    }

    /// The view was frozen inside for a while, and the first joint's speed limit bound.
    fn monitors(&self) -> Monitors {
        let sighting = |verdict| Sighting {
            verdict,
            ticks: 0,
            for_s: 0.0,
            worst: 0.0,
            at_s: None,
            task: None,
        };
        let never = sighting(Verdict::Never);
        let not_watched = sighting(Verdict::NotWatched);
        let inside = Sighting {
            verdict: Verdict::Seen,
            ticks: 125,
            for_s: 1.0,
            worst: 0.0123,
            at_s: Some(1.5),
            task: Some("view".into()),
        };
        let joint = |n| JointMonitor {
            joint: format!("joint_{n}"),
            position_limited_s: 0.0,
            speed_limited_s: if n == 1 { 0.72 } else { 0.0 },
            acceleration_limited_s: 0.0,
            acceleration_exceeded: never.clone(),
            fastest: 3.1,
            hardest: 40.0,
        };
        Monitors {
            rank_lost: never.clone(),
            frozen_moves: never.clone(),
            frozen_inside: inside,
            stuck: never.clone(),
            went_outside: not_watched.clone(),
            unannounced: not_watched.clone(),
            stood_still: not_watched,
            mode_changes: never.clone(),
            joints: (1..=self.joints).map(joint).collect(),
        }
    }

    fn summary(&self) -> Summary {
        let tasks = self.tasks();
        let mut results = BTreeMap::new();
        for task in &tasks {
            let entered_set_s = match task.kind {
                TaskKind::FieldOfView { .. } => Some(1.344),
                _ => Some(0.0),
            };
            let result = TaskSummary {
                entered_set_s,
                worst_violation: Some(0.02),
                active_s: Some(1.0),
                ..TaskSummary::default()
            };
            results.insert(task.name.clone(), result);
        }
        let held = Property {
            holds: true,
            worst: 0.0,
            at_s: None,
            task: None,
        };
        let broken = Property {
            holds: false,
            worst: 0.0021,
            at_s: Some(1.5),
            task: Some("view".into()),
        };
        Summary {
            format: FORMAT,
            version: "0.1.0".into(),
            settings: Settings {
                robot: "ideal".into(),
                scenario: Scenario {
                    collision: conik_sim::scenario::Collision::default(),
                    title: Some(self.title.clone()),
                    robot: RobotConfig {
                        limits: LimitsConfig::default(),
                        source: RobotSource::Model {
                            model: "ur5-paper".into(),
                        },
                        places: PlacesConfig::default(),
                        q0_rad: vec![0.0; self.joints],
                    },
                    control: Control {
                        rate_hz: 125.0,
                        duration_s: 4.0,
                        mode_rule: ModeRule::Paper,
                        border: Border::Freeze,
                        recursion: Recursion::Chiaverini,
                        exclusive: Vec::new(),
                    },
                    ur: None,
                    tasks,
                },
                joint_names: (1..=self.joints).map(|n| format!("joint_{n}")).collect(),
                units: BTreeMap::new(),
            },
            outcome: self.outcome.clone(),
            ended_at_s: f64::from(self.rows.saturating_sub(1)) * 0.008,
            modes: vec![ModeChange {
                t_s: 0.0,
                mode: Some(1),
                active: self.active_at(0),
            }],
            tasks: results,
            waypoints_reached_s: (0..self.waypoints)
                .map(|n| (n < 3).then_some(0.8 + n as f64))
                .collect(),
            properties: Properties {
                equality_converges: held.clone(),
                inside_stays: broken,
                outside_never_worse: held.clone(),
                entered_stays: held.clone(),
                low_priority_excess: held,
            },
            final_q_rad: vec![0.0; self.joints],
            step_time_us: StepTime {
                median: 0.4,
                p99: 1.9,
                max: 17.0,
            },
            deadline_misses: 0,
            cycles: cycles(),
            tracking: Some(Tracking {
                max_rad: vec![3e-4; self.joints],
                rms_rad: vec![1e-4; self.joints],
                delay_s: Some(0.1042),
                delayed_max_rad: Some(vec![5e-5; self.joints]),
                delayed_rms_rad: Some(vec![2e-5; self.joints]),
            }),
            speed_limited_ticks: 0,
            no_mode_ticks: 0,
            landing: None,
            monitors: Some(self.monitors()),
            step_work_max: StepWork::default(),
            changes: Vec::new(),
        }
    }
}

/// Packages every 8 ms, one of them late.
fn cycles() -> Option<CycleSummary> {
    let mut times = CycleTimes::default();
    for cycle in 0..500 {
        let jitter = if cycle == 300 { 20_000 } else { cycle % 70 };
        times.came_after(Duration::from_micros(8000 + jitter));
        times.answered_after(Duration::from_micros(40 + jitter));
    }
    times.missed(2);
    times.summary()
}

/// Runs at the borders of what there is, by name.
// One table of cases.
#[allow(clippy::too_many_lines)]
pub fn strange_runs() -> Vec<(&'static str, Invention)> {
    let usual = Invention::default();
    vec![
        (
            "one row",
            Invention {
                rows: 1,
                ..usual.clone()
            },
        ),
        (
            "no sets",
            Invention {
                sets: 0,
                has_view: false,
                ..usual.clone()
            },
        ),
        (
            "no waypoints",
            Invention {
                waypoints: 0,
                ..usual.clone()
            },
        ),
        (
            "no equality task",
            Invention {
                has_equality: false,
                waypoints: 0,
                ..usual.clone()
            },
        ),
        (
            "no tasks at all",
            Invention {
                sets: 0,
                has_view: false,
                has_equality: false,
                waypoints: 0,
                ..usual.clone()
            },
        ),
        (
            "interrupted",
            Invention {
                outcome: Outcome::Interrupted,
                ..usual.clone()
            },
        ),
        (
            "fault",
            Invention {
                outcome: Outcome::Fault {
                    name: "link-lost".into(),
                    detail: "nothing heard for 0.5 s".into(),
                },
                ..usual.clone()
            },
        ),
        (
            "constant",
            Invention {
                constant: true,
                ..usual.clone()
            },
        ),
        (
            "not finite",
            Invention {
                broken_values: true,
                ..usual.clone()
            },
        ),
        (
            "no mode numbers",
            Invention {
                mode_numbers: false,
                ..usual.clone()
            },
        ),
        (
            "many sets",
            Invention {
                sets: 48,
                ..usual.clone()
            },
        ),
        (
            "many joints",
            Invention {
                joints: 32,
                ..usual.clone()
            },
        ),
        (
            "many waypoints",
            Invention {
                waypoints: 300,
                ..usual.clone()
            },
        ),
        (
            "long names",
            Invention {
                set_name: "an_obstacle_whose_name_is_much_longer_than_any_label_should_be".into(),
                title: "A title that goes on and on ".repeat(20),
                ..usual.clone()
            },
        ),
        (
            "flickering",
            Invention {
                flickers: true,
                rows: 20_000,
                ..usual
            },
        ),
    ]
}
