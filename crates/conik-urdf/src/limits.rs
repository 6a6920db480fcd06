//! The `<limit>` of a joint: what it must not exceed, as far as controllers can know.

use conik::JointLimits;

use crate::element::{Element, GREATEST};
use crate::error::UrdfError;
use crate::note::Notes;

/// Limits and effort of a joint.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Limits {
    pub(crate) joint: JointLimits,
    /// [N·m or N].
    pub(crate) effort: Option<f64>,
}

/// Reads them. Only a joint that `has_ends` has position limits.
///
/// The specification demands `<limit>` of joints with ends, and takes a missing bound for 0. Files that
/// people have often leave out both bounds or the whole element and mean that there are none; a joint
/// that could not move at all would help nobody, so that is how they are read, with a note.
pub(crate) fn read(
    joint: &Element,
    name: &str,
    has_ends: bool,
    notes: &mut Notes,
) -> Result<Limits, UrdfError> {
    let Some(limit) = joint.child("limit")? else {
        if has_ends {
            notes.add(
                joint,
                name,
                "no `<limit>`, so no position or velocity limits",
            );
        }
        return Ok(Limits::default());
    };
    let position = if has_ends {
        positions(&limit, name, notes)?
    } else {
        if limit.attribute("lower").is_some() || limit.attribute("upper").is_some() {
            notes.add(
                &limit,
                name,
                "`lower` and `upper` are left out: a \"continuous\" joint has no ends",
            );
        }
        None
    };
    let effort = limit.any_number("effort")?.filter(|effort| *effort > 0.0);
    Ok(Limits {
        joint: JointLimits {
            position,
            speed: speed(&limit, name, notes)?,
            acceleration: acceleration(&limit, name, notes)?,
        },
        effort,
    })
}

fn positions(
    limit: &Element,
    name: &str,
    notes: &mut Notes,
) -> Result<Option<(f64, f64)>, UrdfError> {
    let (lower, upper) = (limit.any_number("lower")?, limit.any_number("upper")?);
    let (min, max) = match (lower, upper) {
        (None, None) => {
            notes.add(
                limit,
                name,
                "`<limit>` without `lower` and `upper`, so no position limits",
            );
            return Ok(None);
        }
        (Some(_), None) => {
            notes.add(limit, name, "`upper` is missing, which means 0");
            (lower, Some(0.0))
        }
        (None, Some(_)) => {
            notes.add(limit, name, "`lower` is missing, which means 0");
            (Some(0.0), upper)
        }
        both => both,
    };
    let (min, max) = (min.unwrap_or_default(), max.unwrap_or_default());
    if min > max {
        return Err(limit.error_at(
            "lower",
            format!("{min} is greater than `upper`, {max}"),
            "`lower` is the least position, `upper` the greatest",
        ));
    }
    if min == max {
        notes.add(
            limit,
            name,
            "`lower` and `upper` are equal: the joint cannot move",
        );
    }
    // Immense bounds are how some tools write "none".
    let bounded = |bound: f64, none: f64| if bound.abs() > GREATEST { none } else { bound };
    let (min, max) = (bounded(min, f64::NEG_INFINITY), bounded(max, f64::INFINITY));
    if min.is_infinite() || max.is_infinite() {
        notes.add(limit, name, "immense `lower` or `upper`, taken for none");
    }
    Ok((min.is_finite() || max.is_finite()).then_some((min, max)))
}

fn speed(limit: &Element, name: &str, notes: &mut Notes) -> Result<Option<f64>, UrdfError> {
    match limit.any_number("velocity")? {
        Some(speed) if speed > GREATEST => {
            notes.add(limit, name, "immense `velocity`, taken for no limit");
            Ok(None)
        }
        Some(speed) if speed > 0.0 => Ok(Some(speed)),
        Some(_) => {
            notes.add(
                limit,
                name,
                "`velocity` is not above 0, so no velocity limit",
            );
            Ok(None)
        }
        None => {
            notes.add(limit, name, "`velocity` is missing, so no velocity limit");
            Ok(None)
        }
    }
}

/// The lesser one of `acceleration` and `deceleration`, which URDF has since version 1.2: a controller that
/// may brake harder than it speeds up does not know before which it will do.
fn acceleration(limit: &Element, name: &str, notes: &mut Notes) -> Result<Option<f64>, UrdfError> {
    if limit.attribute("jerk").is_some() {
        notes.add(limit, name, "`jerk` is left out: no limit of it is kept");
    }
    let mut least: Option<f64> = None;
    for attribute in ["acceleration", "deceleration"] {
        match limit.any_number(attribute)? {
            Some(most) if most > GREATEST => {}
            Some(most) if most > 0.0 => least = Some(least.map_or(most, |least| least.min(most))),
            Some(_) => {
                let what = format!("`{attribute}` is not above 0, so no limit of it");
                notes.add(limit, name, what);
            }
            None => {}
        }
    }
    Ok(least)
}
