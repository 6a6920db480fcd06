//! Joints that follow others, which may follow others themselves.

use std::collections::HashMap;

use crate::description::Description;
use crate::element::GREATEST;
use crate::error::UrdfError;

/// What a joint's position follows from: multiplier · position of the leader + offset.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Following {
    /// Place among the joints of one that follows none; `None` if there is no such joint.
    pub(crate) leader: Option<usize>,
    pub(crate) multiplier: f64,
    pub(crate) offset: f64,
}

/// Of each joint, what it follows from: at last one that follows none, which may be itself.
pub(crate) fn resolve(description: &Description) -> Result<Vec<Following>, UrdfError> {
    let joints = &description.joints;
    let places: HashMap<&str, usize> = joints
        .iter()
        .enumerate()
        .map(|(i, joint)| (joint.name, i))
        .collect();
    let mut known: Vec<Option<Following>> = vec![None; joints.len()];
    let mut is_waiting = vec![false; joints.len()];
    for start in 0..joints.len() {
        // From the joint to one that is known or follows none, then back.
        let mut waiting = Vec::new();
        let mut place = start;
        let mut found = loop {
            if let Some(found) = known[place] {
                break found;
            }
            let Some(mimic) = &joints[place].mimic else {
                let itself = Following {
                    leader: Some(place),
                    multiplier: 1.0,
                    offset: 0.0,
                };
                known[place] = Some(itself);
                break itself;
            };
            if is_waiting[place] {
                return Err(mimic.element.error(
                    "the joints follow each other in a circle",
                    "one of them must follow none",
                ));
            }
            is_waiting[place] = true;
            waiting.push(place);
            match places.get(mimic.leader) {
                Some(leader) => place = *leader,
                None => {
                    break Following {
                        leader: None,
                        multiplier: 0.0,
                        offset: 0.0,
                    };
                }
            }
        };
        for place in waiting.into_iter().rev() {
            let Some(mimic) = &joints[place].mimic else {
                continue;
            };
            found = Following {
                leader: found.leader,
                multiplier: mimic.multiplier * found.multiplier,
                offset: mimic.multiplier * found.offset + mimic.offset,
            };
            if found.multiplier.abs() > GREATEST || found.offset.abs() > GREATEST {
                return Err(mimic.element.error(
                    "with those that it follows, its multiplier or its offset is out of range",
                    format!("allowed: from -{GREATEST} to {GREATEST}"),
                ));
            }
            known[place] = Some(found);
        }
    }
    Ok(known.into_iter().flatten().collect())
}
