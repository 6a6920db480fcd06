//! The type of task that measures the distance of two shapes of the file.

use super::collision::Collision;
use super::config::TaskKind;
use super::key::Key;
use super::keys;
use super::mistake::{Mistakes, quoted};
use super::table::{Entry, Table, unknown_name};
use super::task_types::{PLAIN, TaskType};
use crate::named_shapes::NoPair;
use conik::Robot;

pub(super) const SHAPE_DISTANCE: TaskType = TaskType {
    name: "shape_distance",
    about: "Distance of two shapes [m], each a `[[shape]]` or an `[[obstacle]]` of the file; negative where \
            they overlap",
    keys: &[&keys::SHAPES],
    frames: &[],
    read: |table, _, found| {
        let shapes = table
            .two_names(&keys::SHAPES, found)
            .required(table, found)?;
        Some(TaskKind::ShapeDistance { shapes })
    },
    ..PLAIN
};

/// What shapes there are, and the robot whose links they are on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scene<'r> {
    pub(super) collision: &'r Collision,
    pub(super) robot: &'r Robot,
}

impl Table<'_> {
    /// Two names.
    fn two_names(&self, key: &'static Key, found: &mut Mistakes) -> Entry<[String; 2]> {
        self.entry(key, |value| {
            let members = value.members(key.holds.expected(), found)?;
            let names: Vec<_> = members.iter().map(|member| member.text(found)).collect();
            let names: Vec<String> = names
                .into_iter()
                .map(|name| name.map(str::to_owned))
                .collect::<Option<_>>()?;
            let count = names.len();
            let two = names.try_into().ok();
            if two.is_none() {
                let what = format!("expected two names, found {count}");
                found.add(value.span(), &*value.path, what, key.write_example());
            }
            two
        })
    }
}

/// Notes what is wrong with the shapes that a task names; what is asked of those of a wrong scene is
/// noted there already.
pub(super) fn check(
    table: &Table,
    kind: &TaskKind,
    scene: Option<Scene>,
    found: &mut Mistakes,
) -> bool {
    let (TaskKind::ShapeDistance { shapes }, Some(scene)) = (kind, scene) else {
        return true;
    };
    let moves_too = table.has(&keys::DESIRED_PER_S);
    let reason = match scene.collision.named_pair(shapes, scene.robot) {
        Ok((_, motion)) if moves_too && !motion.is_rest() => NoPair::BothMove,
        Ok(_) => return true,
        Err(reason) => reason,
    };
    let (mut span, mut path) = (table.span_of(&keys::SHAPES), table.path_of(&keys::SHAPES));
    let both = format!("{} and {}", quoted(&shapes[0]), quoted(&shapes[1]));
    let (what, help) = match reason {
        NoPair::Unknown(ref name) => {
            let members = table.value(&keys::SHAPES);
            let members = members.and_then(|value| value.members("", found));
            let member = members
                .into_iter()
                .flatten()
                .find(|member| member.toml.get_ref().as_str() == Some(name));
            if let Some(member) = member {
                (span, path) = (member.span(), member.path.clone());
            }
            let what = format!("there is no shape or obstacle {}", quoted(name));
            (what, meant_shape(name, scene.collision))
        }
        NoPair::Same => (reason.to_string(), "name two different shapes".to_owned()),
        NoPair::NeverMoves => (
            format!("{both}: {reason}"),
            "name a `[[shape]]` on a link that moves against the other".to_owned(),
        ),
        NoPair::BothMove => (
            reason.to_string(),
            format!(
                "remove `{}`, or let the obstacle rest",
                keys::DESIRED_PER_S.name
            ),
        ),
        NoPair::NoDistance(reason) => (
            format!("{both}: {reason}"),
            "change the `type` of one of them".to_owned(),
        ),
    };
    found.add(span, path, what, help);
    false
}

/// Which shape may be meant by a name that none has.
fn meant_shape(name: &str, collision: &Collision) -> String {
    let on_links = collision.shapes.iter().map(|shape| shape.name.as_str());
    let in_world = collision.obstacles.iter().map(|it| it.name.as_str());
    if collision.shapes.is_empty() && collision.obstacles.is_empty() {
        return "the file has neither: write `[[shape]]` on a line of its own".to_owned();
    }
    unknown_name(name, on_links.chain(in_world)).1
}
