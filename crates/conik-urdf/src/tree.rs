//! The tree of links as seen from the base, and the way from there to the tools.

use std::collections::VecDeque;

use crate::Options;
use crate::description::Description;
use crate::error::{Place, UrdfError, listed, quoted};

/// The order in which links follow from one another.
#[derive(Debug)]
pub(crate) struct Tree {
    /// Place of the base among the links.
    pub(crate) base: usize,
    /// Place of the first tool.
    pub(crate) tool: usize,
    /// Every link but the base: first those on the ways to the tools, one way after the other, then the
    /// rest; each after the one that it follows from.
    pub(crate) steps: Vec<Step>,
    /// How many of the steps are on the ways.
    pub(crate) on_way: usize,
}

/// From one link over a joint to the next.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    pub(crate) from: usize,
    pub(crate) to: usize,
    pub(crate) joint: usize,
    /// From the joint's parent to its child; else the other way round.
    pub(crate) is_forward: bool,
}

impl Tree {
    /// Checks that the links are a tree, and walks through it from the base.
    pub(crate) fn new(description: &Description, options: &Options) -> Result<Self, UrdfError> {
        let root = root(description)?;
        let find = |name: &str, place: Place| {
            let found = description.links.iter().position(|link| link.name == name);
            found.ok_or_else(|| UrdfError {
                place,
                what: format!("there is no link {}", quoted(name)),
                help: format!("the links are {}", listed(names(description))),
            })
        };
        let base = match &options.base {
            Some(name) => find(name, Place::Base)?,
            None => root,
        };
        let walk = walk(description, base);
        let mut tools = Vec::new();
        for name in &options.tools {
            let tool = find(name, Place::Tools)?;
            if tool == base {
                return Err(UrdfError {
                    place: Place::Tools,
                    what: format!("{} is the base", quoted(name)),
                    help: "name a link that joints move, or another base".to_owned(),
                });
            }
            tools.push(tool);
        }
        if tools.is_empty() {
            tools.push(only_end(description, base, &walk)?);
        }
        let mut came_by: Vec<Option<Step>> = vec![None; description.links.len()];
        for step in &walk {
            came_by[step.to] = Some(*step);
        }
        let mut is_taken = vec![false; description.links.len()];
        let mut steps: Vec<Step> = Vec::new();
        for &tool in &tools {
            let known = steps.len();
            let mut link = tool;
            while let Some(step) = came_by[link].filter(|_| !is_taken[link]) {
                is_taken[link] = true;
                steps.push(step);
                link = step.from;
            }
            steps[known..].reverse();
        }
        let on_way = steps.len();
        steps.extend(walk.into_iter().filter(|step| !is_taken[step.to]));
        Ok(Self {
            base,
            tool: tools[0],
            steps,
            on_way,
        })
    }
}

fn names<'a>(description: &'a Description) -> impl Iterator<Item = &'a str> {
    description.links.iter().map(|link| link.name)
}

/// The link that is no joint's child, once it is known that all others hang on it.
fn root(description: &Description) -> Result<usize, UrdfError> {
    let Description { links, joints, .. } = description;
    let mut hangs_by: Vec<Option<usize>> = vec![None; links.len()];
    for (i, joint) in joints.iter().enumerate() {
        if let Some(earlier) = hangs_by[joint.child].replace(i) {
            return Err(joint.element.error(
                format!(
                    "link {} has two parents: it is also the child of joint {} in line {}",
                    quoted(links[joint.child].name),
                    quoted(joints[earlier].name),
                    joints[earlier].element.place().0
                ),
                "URDF describes trees: remove one of the joints, or give it a link of its own",
            ));
        }
    }
    let mut roots = (0..links.len()).filter(|link| hangs_by[*link].is_none());
    let root = roots.next();
    if let (Some(first), Some(second)) = (root, roots.next()) {
        return Err(links[second].element.error(
            format!(
                "no joint carries it, and none carries {} in line {} either",
                quoted(links[first].name),
                links[first].element.place().0
            ),
            "all links but one must be the child of a joint: add one, for example of type \"fixed\"",
        ));
    }
    // With one parent each and one root, what does not hang on the root hangs in a circle.
    let mut hangs = vec![false; links.len()];
    if let Some(root) = root {
        hangs[root] = true;
        for step in walk(description, root) {
            hangs[step.to] = true;
        }
    }
    match (root, hangs.iter().position(|hangs| !hangs)) {
        (Some(root), None) => Ok(root),
        (_, loose) => Err(circle(description, &hangs_by, loose.unwrap_or(0))),
    }
}

/// The error about a circle above a link that hangs on no root.
fn circle(description: &Description, hangs_by: &[Option<usize>], loose: usize) -> UrdfError {
    // After as many steps up as there are links, one is within the circle.
    let mut link = loose;
    let mut joint = None;
    for _ in 0..=hangs_by.len() {
        joint = hangs_by[link];
        link = joint.map_or(link, |joint| description.joints[joint].parent);
    }
    let element = joint.map_or(description.robot, |joint| description.joints[joint].element);
    element.error(
        format!(
            "the joints go round in a circle by link {}",
            quoted(description.links[link].name)
        ),
        "URDF describes trees: every link must hang on the root",
    )
}

/// Every link but the base, each after the one that it follows from, the nearest first.
fn walk(description: &Description, base: usize) -> Vec<Step> {
    let mut ways: Vec<Vec<Step>> = vec![Vec::new(); description.links.len()];
    for (i, joint) in description.joints.iter().enumerate() {
        let forth = Step {
            from: joint.parent,
            to: joint.child,
            joint: i,
            is_forward: true,
        };
        let back = Step {
            from: joint.child,
            to: joint.parent,
            joint: i,
            is_forward: false,
        };
        ways[joint.parent].push(forth);
        ways[joint.child].push(back);
    }
    let mut is_known = vec![false; description.links.len()];
    is_known[base] = true;
    let mut steps = Vec::new();
    let mut waiting = VecDeque::from([base]);
    while let Some(link) = waiting.pop_front() {
        for step in &ways[link] {
            if !is_known[step.to] {
                is_known[step.to] = true;
                steps.push(*step);
                waiting.push_back(step.to);
            }
        }
    }
    steps
}

/// The only link, seen from the base, from which none follows.
fn only_end(description: &Description, base: usize, walk: &[Step]) -> Result<usize, UrdfError> {
    let mut is_end = vec![true; description.links.len()];
    is_end[base] = false;
    for step in walk {
        is_end[step.from] = false;
    }
    let ends: Vec<usize> = (0..is_end.len()).filter(|link| is_end[*link]).collect();
    match ends[..] {
        [end] => Ok(end),
        [] => Err(description
            .robot
            .error("there is no joint", "a robot needs links that joints move")),
        _ => Err(UrdfError {
            place: Place::Tools,
            what: format!("the tree has {} ends", ends.len()),
            help: format!(
                "name the link that is the tool; the ends are {}",
                listed(ends.iter().map(|end| description.links[*end].name))
            ),
        }),
    }
}
