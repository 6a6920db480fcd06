//! Limits of joints that others follow: where the others reach theirs, the joint must stop too.

use conik::JointLimits;

use crate::description::Description;
use crate::note::Notes;
use crate::role::Role;
use crate::tree::Tree;

/// What is narrowed by less is only rounded otherwise [rad or m].
const ROUNDED: f64 = 1e-6;

const UNBOUNDED: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

const LEFT_OUT: &str =
    "its position limits are left out: no position of the joint that it follows keeps them";

/// The limits of each joint, narrowed so that those that follow it keep theirs too.
pub(crate) fn limits_with_followers(
    description: &Description,
    tree: &Tree,
    roles: &[Role],
    notes: &mut Notes,
) -> Vec<JointLimits> {
    let joints = &description.joints;
    let mut limits: Vec<JointLimits> = joints.iter().map(|joint| joint.limits.joint).collect();
    // The degrees of freedom are numbered along the way.
    let way = tree.steps[..tree.on_way].iter().map(|step| step.joint);
    let leaders: Vec<usize> = way
        .filter(|place| matches!(roles[*place], Role::Moves(_)))
        .collect();
    for (follower, role) in joints.iter().zip(roles) {
        let Role::Follows(_, mimic) = role else {
            continue;
        };
        if mimic.multiplier == 0.0 {
            let (min, max) = follower.limits.joint.position.unwrap_or(UNBOUNDED);
            if mimic.offset < min || mimic.offset > max {
                notes.add(&follower.element, follower.name, LEFT_OUT);
            }
            continue;
        }
        let leader = &mut limits[leaders[mimic.joint]];
        if let Some(own) = follower.limits.joint.position {
            let ends = [own.0, own.1].map(|end| (end - mimic.offset) / mimic.multiplier);
            let (min, max) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            let (least, most) = leader.position.unwrap_or(UNBOUNDED);
            let both = (least.max(min), most.min(max));
            if both.0 > both.1 {
                notes.add(&follower.element, follower.name, LEFT_OUT);
            } else {
                if both.0 - least > ROUNDED || most - both.1 > ROUNDED {
                    notes.add(
                        &follower.element,
                        follower.name,
                        "its position limits narrow those of the joint that it follows",
                    );
                }
                leader.position = Some(both);
            }
        }
        let lesser = |leader: Option<f64>, own: Option<f64>| {
            let own = own.map(|own| own / mimic.multiplier.abs());
            match (leader, own) {
                (Some(leader), Some(own)) => Some(leader.min(own)),
                (leader, own) => leader.or(own),
            }
        };
        let own = follower.limits.joint;
        leader.speed = lesser(leader.speed, own.speed);
        leader.acceleration = lesser(leader.acceleration, own.acceleration);
    }
    limits
}
