//! How solids are drawn: lit from the upper left, translucent, with a clean outline.

use std::collections::BTreeSet;

use conik::{Shape, Vec3};

use super::camera::View;
use super::ink::Stroke;
use super::markup::Decimal;
use super::solid;
use super::svg::{Marks, Point};

/// Colour of what never was in the way.
pub const NEUTRAL: &str = "#8795a5";

/// How a solid is painted.
#[derive(Clone, Copy, Debug)]
pub struct Paint<'a> {
    /// Its colour, as `#rrggbb`.
    pub tint: &'a str,
    /// 1 for an opaque one.
    pub opacity: f64,
    /// Width of the outline [px].
    pub line: f64,
    /// Dashes of the outline.
    pub dashes: &'a str,
}

impl<'a> Paint<'a> {
    /// An obstacle.
    pub fn obstacle(tint: &'a str) -> Self {
        Self {
            tint,
            opacity: 0.78,
            line: 0.9,
            dashes: "",
        }
    }

    /// A part of the arm.
    pub fn part(tint: &'a str) -> Self {
        Self {
            tint,
            opacity: 1.0,
            line: 0.8,
            dashes: "",
        }
    }

    /// A shape on a link, which the link shines through.
    pub fn shell(tint: &'a str) -> Self {
        Self {
            tint,
            opacity: 0.22,
            line: 0.7,
            dashes: "",
        }
    }

    /// Where something that moves was at the start.
    pub fn past(tint: &'a str) -> Self {
        Self {
            tint,
            opacity: 0.2,
            line: 0.9,
            dashes: "4 3",
        }
    }
}

/// The gradients of these colours, which [`draw`] refers to.
pub fn definitions<'a>(tints: impl IntoIterator<Item = &'a str>) -> String {
    let mut defs = String::from("<defs>");
    let unique: BTreeSet<&str> = tints.into_iter().collect();
    for tint in unique {
        let id = &tint[1..];
        let (light, plain, dark) = (mix(tint, 0.86), mix(tint, 0.5), mix(tint, -0.12));
        defs += &format!(
            "<radialGradient id=\"ball-{id}\" cx=\"0.5\" cy=\"0.5\" r=\"0.5\" fx=\"0.33\" fy=\"0.28\">\
             <stop offset=\"0\" stop-color=\"{light}\"/><stop offset=\"0.55\" stop-color=\"{plain}\"/>\
             <stop offset=\"1\" stop-color=\"{dark}\"/></radialGradient>\
             <linearGradient id=\"tube-{id}\" x1=\"0\" y1=\"0\" x2=\"0\" y2=\"1\">\
             <stop offset=\"0\" stop-color=\"{plain}\"/><stop offset=\"0.3\" stop-color=\"{light}\"/>\
             <stop offset=\"0.65\" stop-color=\"{plain}\"/><stop offset=\"1\" stop-color=\"{dark}\"/>\
             </linearGradient>"
        );
    }
    defs + "</defs>"
}

/// A colour with that part of white in it, or of nearly black if negative.
pub fn mix(tint: &str, part: f64) -> String {
    let other = if part < 0.0 {
        [0x1f, 0x23, 0x28]
    } else {
        [0xff; 3]
    };
    let share = part.abs();
    let channel = |k: usize| {
        let digits = tint.get(2 * k + 1..2 * k + 3).unwrap_or("80");
        let own = u8::from_str_radix(digits, 16).unwrap_or(0x80);
        let mixed = f64::from(own) * (1.0 - share) + f64::from(other[k]) * share;
        // Between two bytes.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let byte = mixed.round() as u8;
        byte
    };
    format!("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2))
}

/// Draws a solid; a half-space has no end, and is not drawn here.
pub fn draw(view: &View, shape: &Shape, paint: Paint, marks: &mut Marks) {
    let edge = mix(paint.tint, -0.35);
    let outline = Stroke::dashed(&edge, paint.line, paint.dashes);
    let ball = format!("url(#ball-{})", &paint.tint[1..]);
    let at = |point: Vec3| view.place(point.to_array());
    match shape {
        Shape::Sphere(sphere) => {
            let (centre, radius) = (at(sphere.center()), view.scale * sphere.radius());
            marks.disc(centre, radius, &ball, paint.opacity, outline);
        }
        Shape::Capsule(capsule) => {
            let ends = capsule.ends().map(at);
            let radius = view.scale * capsule.radius();
            if length(ends) < 0.2 * radius {
                marks.disc(ends[0], radius, &ball, paint.opacity, outline);
            } else {
                tube(ends, (radius, radius), paint, outline, marks);
            }
        }
        Shape::Cylinder(cylinder) => {
            let ends = cylinder.ends();
            let axis = (ends[1] - ends[0]).normalized();
            let nearer = axis.dot(view.camera.toward());
            let radius = view.scale * cylinder.radius();
            let squashed = radius * nearer.abs().min(1.0);
            tube(ends.map(at), (squashed, radius), paint, outline, marks);
            let cap = at(ends[usize::from(nearer > 0.0)]);
            if squashed > 0.3 {
                let turn = upright(ends.map(at)).1;
                let fill = mix(paint.tint, 0.68);
                marks.ellipse(cap, (squashed, radius), turn, &fill, paint.opacity, outline);
            }
        }
        Shape::Cuboid(cuboid) => {
            let (pose, corners) = (cuboid.pose(), solid::corners(shape));
            let axes = [pose.x_axis, pose.y_axis, pose.z_axis];
            for face in 0..6_usize {
                let (axis, side) = (face / 2, face % 2);
                let normal = axes[axis] * if side == 1 { 1.0 } else { -1.0 };
                if normal.dot(view.camera.toward()) <= 1e-9 {
                    continue;
                }
                let (one, other) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
                let first = side << axis;
                let around = [first, first | one, first | one | other, first | other];
                let points = around.map(|corner| at(corners[corner]));
                let fill = mix(paint.tint, brightness(view, normal));
                marks.face(&points, &fill, paint.opacity, outline);
            }
        }
        Shape::HalfSpace(_) => {}
    }
}

/// How light a face is.
fn brightness(view: &View, normal: Vec3) -> f64 {
    let [right, up] = view.camera.frame().map(Vec3::from);
    let light = (up * 0.75 - right * 0.45 + view.camera.toward() * 0.5).normalized();
    0.42 + 0.4 * normal.dot(light)
}

fn length([from, to]: [Point; 2]) -> f64 {
    (to.0 - from.0).hypot(to.1 - from.1)
}

/// Where a tube begins and how it is turned [degrees], so that the light falls on its upper or left side.
fn upright([from, to]: [Point; 2]) -> (Point, f64) {
    let angle = (to.1 - from.1).atan2(to.0 - from.0).to_degrees();
    if (-135.0..=45.0).contains(&angle) {
        (from, angle)
    } else {
        (
            to,
            if angle > 0.0 {
                angle - 180.0
            } else {
                angle + 180.0
            },
        )
    }
}

/// A tube with rounded ends, whose half axes along it and across it are given.
fn tube(
    ends: [Point; 2],
    (along, across): (f64, f64),
    paint: Paint,
    outline: Stroke,
    marks: &mut Marks,
) {
    let (begin, turn) = upright(ends);
    let long = Decimal(length(ends));
    let (a, r) = (Decimal(along), Decimal(across));
    let path = format!("M0 -{r}H{long}A{a} {r} 0 0 1 {long} {r}H0A{a} {r} 0 0 1 0 -{r}Z");
    let fill = format!("url(#tube-{})", &paint.tint[1..]);
    marks.turned(&path, begin, turn, &fill, paint.opacity, outline);
}
