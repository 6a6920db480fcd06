//! A part of a run in which the scenario stays as it is: what is run, and who looks on.

use conik::{ActiveSet, Monitor, Reason, StackError, Step, TaskId};

use super::glide::{Away, GlideSpeed};
use crate::announced::Announcements;
use crate::columns::Columns;
use crate::experiment::{Experiment, ExperimentError};
use crate::scenario::Scenario;

/// What is run from one change of the scenario to the next. Everything that tells of it, records and
/// monitors, numbers tasks as the first stretch of the run did.
#[derive(Debug)]
pub struct Stretch {
    pub(crate) experiment: Experiment,
    pub(crate) monitor: Monitor,
    pub(crate) announcements: Announcements,
    columns: Columns,
    /// Of each task its number in the run's first stack; and the other way round.
    first: Vec<TaskId>,
    now: Vec<TaskId>,
    is_reordered: bool,
    /// Room for what `take_over` finds out about each task.
    before: Vec<TaskId>,
    is_new: Vec<bool>,
    kept: Vec<Option<TaskId>>,
}

/// Something on its way to where the scenario has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gliding {
    /// The task, by its number in the first stack.
    pub task: TaskId,
    /// How far it is from there.
    pub away: Away,
}

/// Why a scenario cannot follow another one in the same run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StretchError {
    /// It cannot be run at all.
    #[error(transparent)]
    Experiment(#[from] ExperimentError),
    /// There would be other tasks.
    #[error("while a run goes on, tasks can be neither added nor taken away (`{0}`)")]
    OtherTasks(String),
    /// A task would be of another kind.
    #[error(
        "while a run goes on, task `{0}` stays a set, or an equality task, of as many components"
    )]
    OtherKind(String),
    /// Another robot, start or rate.
    #[error("while a run goes on, robot, start and rate stay what they are")]
    OtherRobot,
}

impl Stretch {
    /// The first one of a run. If it may change, the experiment is [`Experiment::changeable`].
    pub fn first(experiment: Experiment) -> Self {
        let stack = experiment.controller.stack();
        let first: Vec<TaskId> = stack.iter().map(|(id, _)| id).collect();
        Self::new(experiment, first.clone(), first)
    }

    /// One of the same run by another scenario; `first` is that by which it began. `speeds`: names of tasks,
    /// and how fast they glide to where this scenario has them.
    pub fn next(
        first: &Scenario,
        scenario: &Scenario,
        speeds: &[(String, GlideSpeed)],
    ) -> Result<Self, StretchError> {
        let begun = Experiment::new(first)?;
        let mut experiment = Experiment::changeable(scenario)?;
        for mover in &mut experiment.movers {
            let name = experiment.controller.stack()[mover.task].name();
            let own = speeds.iter().find(|(task, _)| task == name);
            mover.glide_speed = own.map(|(_, speed)| *speed);
        }
        let (was, stack) = (begun.controller.stack(), experiment.controller.stack());
        if begun.q0 != experiment.q0
            || begun.period_s() != experiment.period_s()
            || first.robot != scenario.robot
        {
            return Err(StretchError::OtherRobot);
        }
        let found = |(_, level): (TaskId, &conik::Level)| {
            let name = level.name();
            was.find(name)
                .ok_or_else(|| StretchError::OtherTasks(name.to_owned()))
        };
        let numbers: Vec<TaskId> = stack.iter().map(found).collect::<Result<_, _>>()?;
        let found = |(_, level): (TaskId, &conik::Level)| {
            let name = level.name();
            stack
                .find(name)
                .ok_or_else(|| StretchError::OtherTasks(name.to_owned()))
        };
        let now: Vec<TaskId> = was.iter().map(found).collect::<Result<_, _>>()?;
        for ((_, level), then) in was.iter().zip(&now) {
            let level_now = &stack[*then];
            let is_alike = level.interval().is_some() == level_now.interval().is_some()
                && level.task().dimension() == level_now.task().dimension();
            if !is_alike {
                return Err(StretchError::OtherKind(level.name().to_owned()));
            }
        }
        Ok(Self::new(experiment, numbers, now))
    }

    fn new(mut experiment: Experiment, first: Vec<TaskId>, now: Vec<TaskId>) -> Self {
        experiment.controller.measure_on_demand();
        let stack = experiment.controller.stack();
        let count = stack.len();
        Self {
            monitor: Monitor::new(stack),
            announcements: Announcements::new(stack),
            columns: Columns::in_order(stack, &now),
            is_reordered: !first.is_sorted_by_key(|task| task.index()),
            before: first.clone(),
            is_new: vec![false; count],
            kept: vec![None; count],
            first,
            now,
            experiment,
        }
    }

    /// Goes on at `t_s` [s] where `before` was. Does not allocate.
    pub(crate) fn take_over(&mut self, before: &Self, t_s: f64) -> Result<(), StackError> {
        let controller = &mut self.experiment.controller;
        controller.take_over(&before.experiment.controller);
        let (stack, stack_before) = (controller.stack(), before.experiment.controller.stack());
        for (id, _) in stack.iter() {
            let index = id.index();
            let then = before.now[self.first[index].index()];
            self.before[index] = then;
            // Only what has high priority is held against where it was.
            self.is_new[index] = stack.is_high_priority(id) != stack_before.is_high_priority(then);
        }
        for mover in &mut self.experiment.movers {
            let index = mover.task.index();
            let then = self.before[index];
            // They stand in the order of their tasks.
            let movers = &before.experiment.movers;
            let found = movers.binary_search_by_key(&then.index(), |old| old.task.index());
            if let Some(old) = found.ok().and_then(|place| movers.get(place)) {
                self.is_new[index] |= !mover.glide_from(old, t_s);
            }
        }
        for (index, kept) in self.kept.iter_mut().enumerate() {
            *kept = (!self.is_new[index]).then_some(self.before[index]);
        }
        let is_new = &self.is_new;
        self.monitor
            .take_over(&before.monitor, &self.before, |id| is_new[id.index()]);
        self.announcements
            .take_over(&before.announcements, &self.kept, controller.stack());
        self.experiment.from_here = before.experiment.from_here;
        self.experiment.last_tick = before.experiment.last_tick;
        if let (Some(visits), Some(old)) =
            (&mut self.experiment.waypoints, &before.experiment.waypoints)
        {
            visits.take_over(old, &mut controller.setpoints())?;
        }
        Ok(())
    }

    /// Is handed over in the place of one that was never run: what glides there has the speed asked for then.
    pub(crate) fn skip(&mut self, skipped: &Self) {
        let stack = self.experiment.controller.stack();
        let skipped_stack = skipped.experiment.controller.stack();
        for mover in &mut self.experiment.movers {
            let name = stack[mover.task].name();
            let mut movers = skipped.experiment.movers.iter();
            let same = movers.find(|other| skipped_stack[other.task].name() == name);
            mover.glide_speed = mover.glide_speed.or(same.and_then(|it| it.glide_speed));
        }
    }

    /// What it runs.
    pub fn experiment(&self) -> &Experiment {
        &self.experiment
    }

    /// Values and errors of a tick, in the order of the first stack.
    pub(crate) fn values(&self, step: &Step) -> Vec<f64> {
        self.columns.values(step)
    }

    /// The active sets, as the first stack numbers them.
    pub(crate) fn active(&self, step: &Step) -> ActiveSet {
        if !self.is_reordered {
            return step.active;
        }
        let mut active = ActiveSet::EMPTY;
        for task in step.active.iter() {
            active.insert(self.first[task.index()]);
        }
        active
    }

    /// The reasons of a tick, as the first stack numbers tasks.
    pub(crate) fn reasons(&self, step: &Step) -> Vec<Reason> {
        let reasons = step.reasons().iter();
        reasons
            .map(|reason| reason.renumbered(|task| self.first[task.index()]))
            .collect()
    }

    /// What is on its way.
    pub(crate) fn gliding(&self) -> Vec<Gliding> {
        let movers = self.experiment.movers.iter();
        let gliding = movers.filter(|mover| !mover.away().is_none());
        gliding
            .map(|mover| Gliding {
                task: self.first[mover.task.index()],
                away: *mover.away(),
            })
            .collect()
    }
}
