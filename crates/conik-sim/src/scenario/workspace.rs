//! The type of task that keeps a frame inside a sphere or a box. It is no task of its own: a sphere is the
//! distance to its middle, a box one coordinate a side, each a set at that place in the list.

use super::config::{Axis, GoalConfig, TaskKind};
use super::keys;
use super::mistake::Mistakes;
use super::table::Table;
use super::task_types::{GoalShape, PLAIN, TaskType};
use super::value::shown;
use super::waypoints::first_of;

pub(super) const WORKSPACE: TaskType = TaskType {
    name: "workspace",
    about: "A sphere or a box that the frame stays inside: a set of its distance to the middle [m], or \
            one of each coordinate [m], named `NAME/x`, `NAME/y` and `NAME/z`",
    optional: &[&keys::CENTER_M, &keys::RADIUS_M, &keys::MIN_M, &keys::MAX_M],
    goal: GoalShape::Region,
    ..PLAIN
};

/// A set of which a workspace consists.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// What follows the workspace's name in its own.
    pub(super) suffix: &'static str,
    pub(super) kind: TaskKind,
    min: Option<f64>,
    max: f64,
}

impl Part {
    /// What is asked of it, with the speeds of the workspace.
    pub(super) fn goal(&self, of_workspace: &GoalConfig) -> GoalConfig {
        let mut goal = of_workspace.clone();
        if let GoalConfig::Set { min, max, .. } = &mut goal {
            (*min, *max) = (self.min, Some(self.max));
        }
        goal
    }
}

/// The sets; `None` if something of the region is wrong.
pub(super) fn read(table: &Table, found: &mut Mistakes) -> Option<Vec<Part>> {
    let of_sphere = first_of(table, &[&keys::CENTER_M, &keys::RADIUS_M]);
    let of_box = first_of(table, &[&keys::MIN_M, &keys::MAX_M]);
    match (of_sphere, of_box) {
        (Some(sphere), Some(cuboid)) => {
            found.add(
                table.span_of(cuboid),
                table.path_of(cuboid),
                format!(
                    "`{}` is of a sphere and `{}` of a box",
                    sphere.name, cuboid.name
                ),
                "give one of the two; a second task keeps inside the other",
            );
            None
        }
        (None, None) => {
            found.add(
                table.header.clone(),
                &*table.path,
                "this workspace has no shape",
                "give `center_m` and `radius_m` for a sphere, or `min_m` and `max_m` for a box",
            );
            None
        }
        (Some(_), None) => read_sphere(table, found),
        (None, Some(_)) => read_box(table, found),
    }
}

fn read_sphere(table: &Table, found: &mut Mistakes) -> Option<Vec<Part>> {
    let center = table.vector(&keys::CENTER_M, found);
    let center = center.required(table, found);
    let radius = table.number(&keys::RADIUS_M, found);
    let radius = radius.required(table, found);
    let (point_m, max) = (center?, radius?);
    Some(vec![Part {
        suffix: "",
        kind: TaskKind::Distance { point_m },
        min: None,
        max,
    }])
}

fn read_box(table: &Table, found: &mut Mistakes) -> Option<Vec<Part>> {
    let least = table.vector(&keys::MIN_M, found).required(table, found);
    let most = table.vector(&keys::MAX_M, found).required(table, found);
    let (least, most) = (least?, most?);
    if let Some(nth) = (0..3).find(|&nth| least[nth] > most[nth]) {
        found.add(
            table.span_of(&keys::MIN_M),
            table.path_of(&keys::MIN_M),
            format!(
                "{} in `min_m` is greater than {} in `max_m`: nothing is in this box",
                shown(least[nth]),
                shown(most[nth])
            ),
            "each number of `min_m` must be at most that of `max_m`",
        );
        return None;
    }
    let sides = [(Axis::X, "/x"), (Axis::Y, "/y"), (Axis::Z, "/z")];
    let parts = sides.into_iter().enumerate();
    let parts = parts.map(|(nth, (axis, suffix))| Part {
        suffix,
        kind: TaskKind::Coordinate { axis },
        min: Some(least[nth]),
        max: most[nth],
    });
    Some(parts.collect())
}
