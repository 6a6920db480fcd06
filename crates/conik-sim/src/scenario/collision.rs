//! Reading `[[shape]]`, `[[obstacle]]` and `[self_collision]`: what must not collide.

use std::ops::Range;

use conik::Robot;
use serde::{Deserialize, Serialize};

use super::control;
use super::geometry::{self, Geometry};
use super::key::Key;
use super::keys;
use super::mistake::{Mistakes, quoted};
use super::motion::{self, Motion};
use super::names;
use super::shape_keys::{
    DISTANCE_M, EXCLUDE, LINK, OBSTACLE, OBSTACLE_DISTANCE_M, OBSTACLE_KEYS, SELF_COLLISION,
    SELF_COLLISION_KEYS, SHAPE, SHAPE_KEYS,
};
use super::table::{Entry, Table, unknown_name};

/// What must not collide: the robot's shapes with obstacles, and with each other.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Collision {
    /// Shapes on the robot's links.
    #[serde(rename = "shape", default, skip_serializing_if = "Vec::is_empty")]
    pub shapes: Vec<LinkShape>,
    /// Shapes in the world.
    #[serde(rename = "obstacle", default, skip_serializing_if = "Vec::is_empty")]
    pub obstacles: Vec<Obstacle>,
    /// Whether the robot's shapes keep away from each other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub self_collision: Option<SelfCollision>,
}

/// A shape on a link of the robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LinkShape {
    /// Unique among shapes and obstacles; the link's, unless the file says otherwise.
    pub name: String,
    /// Name of the link.
    pub link: String,
    /// The shape, in the link's frame.
    #[serde(flatten)]
    pub geometry: Geometry,
}

/// A shape in the world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Obstacle {
    /// Unique among shapes and obstacles.
    pub name: String,
    /// The shape, in the world, where it is at t = 0 if it moves.
    #[serde(flatten)]
    pub geometry: Geometry,
    /// Least distance between it and the robot's shapes [m]; `None`: it keeps nothing away, and tasks may
    /// measure how far it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distance_m: Option<f64>,
    /// How it moves, if it does.
    #[serde(flatten)]
    pub motion: Motion,
}

/// How the robot's shapes keep away from each other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SelfCollision {
    /// Least distance between any two of them [m].
    pub distance_m: f64,
    /// Groups of shapes of which no two are kept apart.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub exclude: Vec<Vec<String>>,
}

/// Reads all three; `None` if anything in them is wrong. `of_urdf` reads the shapes that the robot's own
/// file gives the links, where the scenario gives none. `robot` is missing if it is unknown.
pub(super) fn read(
    file: &Table,
    of_urdf: impl FnOnce(&[LinkShape], &mut Mistakes) -> Option<Vec<LinkShape>>,
    robot: Option<&Robot>,
    found: &mut Mistakes,
) -> Option<Collision> {
    let mut taken = Vec::new();
    let shapes = each(file, &SHAPE, found, |table, found| {
        read_shape(table, robot, &mut taken, found)
    });
    let shapes = shapes.and_then(|mut shapes| {
        let further = of_urdf(&shapes, found)?;
        taken.extend(further.iter().map(|shape| shape.name.clone()));
        shapes.extend(further);
        Some(shapes)
    });
    let count = taken.len();
    let obstacles = each(file, &OBSTACLE, found, |table, found| {
        read_obstacle(table, &mut taken, found)
    });
    let shape_names = &taken[..count];
    let self_collision = match file.table(&SELF_COLLISION, found) {
        Entry::Absent(_) => Some(None),
        Entry::Wrong => None,
        Entry::Given(table) => read_self_collision(&table, shape_names, found).map(Some),
    };
    let collision = Collision {
        shapes: shapes?,
        obstacles: obstacles?,
        self_collision: self_collision?,
    };
    check_pairs(&collision, file, found).then_some(collision)
}

/// A scenario may have so many shapes, and so many obstacles. Every two of them are looked at, and of far
/// fewer can the distance be kept.
pub(super) const MOST: usize = 1000;

/// Reads every table of a list, all of them even if one is wrong.
fn each<T>(
    file: &Table,
    key: &'static Key,
    found: &mut Mistakes,
    mut read: impl FnMut(&Table, &mut Mistakes) -> Option<T>,
) -> Option<Vec<T>> {
    let tables = file.tables(key, found).or(Vec::new())?;
    if let Some(first) = tables.get(MOST) {
        let what = format!("{} are too many", tables.len());
        let help = format!("give at most {MOST}");
        found.add(first.header.clone(), key.name, what, help);
        return None;
    }
    let all: Vec<_> = tables.iter().map(|table| read(table, found)).collect();
    all.into_iter().collect()
}

fn read_shape(
    table: &Table,
    robot: Option<&Robot>,
    taken: &mut Vec<String>,
    found: &mut Mistakes,
) -> Option<LinkShape> {
    let geometry_type = geometry::read_type(table, found);
    refuse_unknown_keys(table, SHAPE_KEYS, geometry_type, found);
    let link = table.text(&LINK, found).required(table, found);
    let name = if table.has(&keys::NAME) {
        names::read(table, found).map(|name| (name.value, name.span))
    } else {
        link.map(|link| (name_of(link), table.header.clone()))
    };
    let name = name.and_then(|(name, span)| unique(name, span, table, taken, found));
    let link = link.and_then(|link| known_link(link, table, robot, found));
    let geometry = geometry_type.and_then(|it| geometry::read(table, it, found));
    Some(LinkShape {
        name: name?,
        link: link?.to_owned(),
        geometry: geometry?,
    })
}

/// What a shape of a link is called: the name of a link may have letters that none of a task has.
pub(super) fn name_of(link: &str) -> String {
    let allowed = |c: char| if names::is_name_character(c) { c } else { '_' };
    link.chars().map(allowed).collect()
}

fn read_obstacle(table: &Table, taken: &mut Vec<String>, found: &mut Mistakes) -> Option<Obstacle> {
    let geometry_type = geometry::read_type(table, found);
    refuse_unknown_keys(table, OBSTACLE_KEYS, geometry_type, found);
    let name = names::read(table, found)
        .and_then(|name| unique(name.value, name.span, table, taken, found));
    let distance_m = table.number(&OBSTACLE_DISTANCE_M, found);
    let distance_m = distance_m.map(Some).or(None);
    let motion = motion::read(table, keys::MOVES, found);
    let geometry = geometry_type.and_then(|it| geometry::read(table, it, found));
    Some(Obstacle {
        name: name?,
        geometry: geometry?,
        distance_m: distance_m?,
        motion: motion?,
    })
}

fn read_self_collision(
    table: &Table,
    shapes: &[String],
    found: &mut Mistakes,
) -> Option<SelfCollision> {
    table.refuse_unknown_keys(&SELF_COLLISION_KEYS.iter().copied(), |_| None, found);
    let distance_m = table.number(&DISTANCE_M, found).required(table, found);
    let groups = control::read_groups(table, &EXCLUDE, found)?;
    let mut is_right = true;
    for name in groups.iter().flat_map(|group| &group.value) {
        if !shapes.contains(&name.value) {
            let (what, help) = unknown_name(&name.value, shapes.iter().map(String::as_str));
            found.add(name.span.clone(), &*name.path, what, help);
            is_right = false;
        }
    }
    let names =
        |group: &control::Group| group.value.iter().map(|name| name.value.clone()).collect();
    Some(SelfCollision {
        distance_m: distance_m.filter(|_| is_right)?,
        exclude: groups.iter().map(names).collect(),
    })
}

fn refuse_unknown_keys(
    table: &Table,
    own: &'static [&'static Key],
    geometry_type: Option<&'static geometry::GeometryType>,
    found: &mut Mistakes,
) {
    // Of an unknown type every type's keys may be meant.
    let all = geometry::ALL.iter();
    let types = all.filter(|it| geometry_type.is_none_or(|known| known.name == it.name));
    let known = own
        .iter()
        .copied()
        .chain(types.flat_map(geometry::GeometryType::all_keys));
    table.refuse_unknown_keys(&known, |_| None, found);
}

fn unique(
    name: String,
    span: Range<usize>,
    table: &Table,
    taken: &mut Vec<String>,
    found: &mut Mistakes,
) -> Option<String> {
    if taken.contains(&name) {
        found.add(
            span,
            table.path_of(&keys::NAME),
            format!("a shape or obstacle has the name {} already", quoted(&name)),
            "give this one a `name` of its own",
        );
        return None;
    }
    taken.push(name.clone());
    Some(name)
}

fn known_link<'a>(
    link: &'a str,
    table: &Table,
    robot: Option<&Robot>,
    found: &mut Mistakes,
) -> Option<&'a str> {
    // The links of an unknown robot are unknown too; that is noted already.
    let robot = robot?;
    if robot.frame(link).is_none() {
        let names: Vec<&str> = robot.link_names().collect();
        let (what, help) = unknown_name(link, names.iter().copied());
        let what = what.replace("unknown name", "the robot has no link");
        found.add(table.span_of(&LINK), table.path_of(&LINK), what, help);
        return None;
    }
    Some(link)
}

/// Notes two shapes between which there is no distance, and what nothing on the robot can meet.
fn check_pairs(collision: &Collision, file: &Table, found: &mut Mistakes) -> bool {
    let mut refuse = |key: &'static Key, what: String, help: &str| {
        found.add(file.span_of(key), key.name, what, help);
        false
    };
    let keeps_away = |it: &&Obstacle| it.distance_m.is_some();
    let kept_away_from = || collision.obstacles.iter().filter(keeps_away);
    if collision.shapes.is_empty() {
        let shapes = "give the links shapes: write `[[shape]]` on a line of its own";
        if kept_away_from().next().is_some() {
            return refuse(
                &OBSTACLE,
                "no link has a shape that could meet it".into(),
                shapes,
            );
        }
        if collision.self_collision.is_some() {
            return refuse(&SELF_COLLISION, "no link has a shape".into(), shapes);
        }
    }
    for (i, shape) in collision.shapes.iter().enumerate() {
        let others = kept_away_from();
        let mut others: Vec<_> = others.map(|it| (&it.name, &it.geometry)).collect();
        if collision.self_collision.is_some() {
            let later = collision.shapes[i + 1..].iter();
            others.extend(later.map(|it| (&it.name, &it.geometry)));
        }
        for (name, geometry) in others {
            if let Err(reason) = shape.geometry.shape().check_pair(&geometry.shape()) {
                let pair = format!("{} and {}: {reason}", quoted(&shape.name), quoted(name));
                return refuse(&SHAPE, pair, "change the `type` of one of them");
            }
        }
    }
    true
}
