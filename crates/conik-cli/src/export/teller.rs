//! Tells the rows of a log as messages, one after the other.

use std::io::Write;

use conik::{Frame, Kinematics};
use conik_sim::log::LogRows;
use conik_sim::scenario::GoalConfig;

use super::arm::Arm;
use super::channels::{Channels, Topic};
use super::error::ExportError;
use super::events::Events;
use super::frames::{FrameTree, WORLD};
use super::primitive;
use super::protobuf::Message;
use super::region::Region;
use super::scene::Scene;
use super::source::{Source, SourceTask, place};
use super::types::{DECISION, FRAME_TRANSFORMS, JOINT_STATES, LOG, POSE_IN_FRAME, TASK};

/// Tells row after row.
pub struct Teller<'a> {
    source: &'a Source,
    frames: &'a FrameTree,
    kinematics: Kinematics,
    message: Message,
    q: Vec<f64>,
    /// Columns of positions, velocities and accelerations, and of what was measured.
    references: [Vec<usize>; 3],
    measured: Option<Vec<usize>>,
    transforms: Topic,
    joints: Topic,
    measured_joints: Option<Topic>,
    tool: Topic,
    tasks: Vec<TaskTopic<'a>>,
    still: Scene,
    moving: Scene,
    events: Events,
    plate_m: f64,
}

/// The topic of a task, and the columns of its value and its error.
struct TaskTopic<'a> {
    task: &'a SourceTask,
    topic: Topic,
    value: Option<usize>,
    error: Option<usize>,
}

impl<'a> Teller<'a> {
    /// Adds the topics of everything that happens.
    pub fn new<W: Write>(
        source: &'a Source,
        arm: &Arm,
        frames: &'a FrameTree,
        rows: &LogRows,
        channels: &mut Channels<W>,
    ) -> Result<Self, ExportError> {
        let columns = |stem, unit| source.joint_columns(rows, stem, unit);
        let references = [
            columns("q", "_rad")?,
            columns("qd", "_rad_s")?,
            columns("qdd", "_rad_s2")?,
        ];
        let measured = place(rows, "q1_measured_rad").map(|_| columns("q", "_measured_rad"));
        let measured = measured.transpose()?;
        let transforms = channels.topic("/tf", &FRAME_TRANSFORMS)?;
        let joints = channels.topic("/joint_states", &JOINT_STATES)?;
        let measured_joints = match measured {
            Some(_) => Some(channels.topic("/joint_states/measured", &JOINT_STATES)?),
            None => None,
        };
        let tool = channels.topic("/tool", &POSE_IN_FRAME)?;
        let mut tasks = Vec::new();
        for task in &source.tasks {
            tasks.push(TaskTopic {
                topic: channels.topic(&format!("/task/{}", task.config.name), &TASK)?,
                value: place(rows, &task.config.name),
                error: place(rows, &task.error_column()),
                task,
            });
        }
        let (moving, still) = Region::all(source, frames)
            .into_iter()
            .partition(Region::moves);
        let events = Events::new(
            source,
            rows,
            channels.topic("/decision", &DECISION)?,
            channels.topic("/log", &LOG)?,
        );
        Ok(Self {
            source,
            frames,
            kinematics: Kinematics::new(&source.robot),
            message: Message::default(),
            q: vec![0.0; source.robot.dof()],
            references,
            measured,
            transforms,
            joints,
            measured_joints,
            tool,
            tasks,
            still: Scene::new("/scene", still, channels)?,
            moving: Scene::new("/scene/moving", moving, channels)?,
            events,
            plate_m: 1.5 * arm.length,
        })
    }

    /// Tells the row at hand.
    pub fn tell<W: Write>(
        &mut self,
        rows: &LogRows,
        channels: &mut Channels<W>,
    ) -> Result<(), ExportError> {
        let row = rows.row();
        let t_s = row.numbers[place(rows, "t_s").unwrap_or_default()];
        let nanoseconds = primitive::nanoseconds(t_s);
        let active = &rows.active_sets()[row.active as usize];
        for (q, &column) in self.q.iter_mut().zip(&self.references[0]) {
            *q = row.numbers[column];
        }
        self.tell_frames(nanoseconds, channels)?;
        self.tell_joints(&row.numbers, nanoseconds, channels)?;
        for task in &mut self.tasks {
            self.message.clear();
            task.fill(&row.numbers, t_s, active, &mut self.message);
            channels.write(&mut task.topic, nanoseconds, &self.message)?;
        }
        for scene in [&mut self.still, &mut self.moving] {
            if scene.is_due(t_s, active) {
                let message = &mut self.message;
                scene.tell(nanoseconds, active, self.plate_m, message, channels)?;
            }
        }
        self.events.tell(rows, nanoseconds, channels)
    }

    fn tell_frames<W: Write>(
        &mut self,
        nanoseconds: u64,
        channels: &mut Channels<W>,
    ) -> Result<(), ExportError> {
        let message = &mut self.message;
        message.clear();
        self.frames.moved(&self.q, |parent, child, pose| {
            primitive::transform(nanoseconds, (parent, child), pose, message);
        });
        channels.write(&mut self.transforms, nanoseconds, message)?;
        self.kinematics.update(&self.q);
        message.clear();
        primitive::timestamp(1, nanoseconds, message);
        message.text(2, WORLD);
        primitive::pose(3, self.kinematics.world_from(Frame::Tool), message);
        channels.write(&mut self.tool, nanoseconds, message)
    }

    fn tell_joints<W: Write>(
        &mut self,
        numbers: &[f64],
        nanoseconds: u64,
        channels: &mut Channels<W>,
    ) -> Result<(), ExportError> {
        let names = || self.source.robot.joint_names();
        let message = &mut self.message;
        message.clear();
        primitive::timestamp(1, nanoseconds, message);
        for (joint, name) in names().enumerate() {
            message.message(2, |state| {
                state.text(1, name);
                for (field, columns) in (2..).zip(&self.references) {
                    state.double(field, numbers[columns[joint]]);
                }
            });
        }
        channels.write(&mut self.joints, nanoseconds, message)?;
        if let (Some(columns), Some(topic)) = (&self.measured, &mut self.measured_joints) {
            message.clear();
            primitive::timestamp(1, nanoseconds, message);
            for (name, &column) in names().zip(columns) {
                message.message(2, |state| {
                    state.text(1, name);
                    state.double(2, numbers[column]);
                });
            }
            channels.write(topic, nanoseconds, message)?;
        }
        Ok(())
    }

    /// Tells how it ended.
    pub fn end<W: Write>(mut self, channels: &mut Channels<W>) -> Result<(), ExportError> {
        self.events.end(&self.source.summary.outcome, channels)
    }
}

impl TaskTopic<'_> {
    /// `conik.Task`.
    fn fill(&self, numbers: &[f64], t_s: f64, active: &[String], message: &mut Message) {
        let config = &self.task.config;
        if let Some(column) = self.value {
            message.double(1, numbers[column]);
        }
        match &config.goal {
            GoalConfig::Desired { desired, .. } => {
                if let (Some(_), [desired]) = (self.value, &desired[..]) {
                    message.double(2, config.motion.value_at(*desired, t_s));
                }
            }
            GoalConfig::Set { min, max, .. } => {
                for (field, bound) in [(3, min), (4, max)] {
                    if let Some(bound) = *bound {
                        message.double(field, bound);
                    }
                }
                message.whole(6, u64::from(active.contains(&config.name)));
            }
            GoalConfig::Waypoints { .. } => {}
        }
        if let Some(column) = self.error {
            message.double(5, numbers[column]);
        }
    }
}
