//! Planes of which one side is forbidden: the piece within the scene, hatched.

use conik::Vec3;

use super::camera::View;
use super::ink::Stroke;
use super::obstacles::Wall;
use super::scene::Scene;
use super::shading::mix;
use super::solid::across;
use super::svg::{Marks, Point};

/// The corners of the piece of the plane within the scene, in order around it; none if it is outside.
pub fn piece(wall: &Wall, scene: &Scene) -> Vec<Vec3> {
    let (low, high) = (Vec3::from(scene.low), Vec3::from(scene.high));
    let middle = (low + high) * 0.5;
    let size = (high - low).norm();
    // The point of the plane next to the middle, and a square around it that reaches everywhere.
    let foot = middle - wall.normal * wall.normal.dot(middle - wall.point);
    let (a, b) = across(wall.normal);
    let (a, b) = (a * size, b * size);
    let mut corners = vec![foot + a + b, foot + b - a, foot - a - b, foot + a - b];
    for axis in 0..3 {
        let (low, high) = (scene.low[axis], scene.high[axis]);
        let slack = 1e-9 * size;
        corners = clip(&corners, |point| point.to_array()[axis] - low + slack);
        corners = clip(&corners, |point| high + slack - point.to_array()[axis]);
    }
    corners
}

/// What of a convex polygon lies where `inside` is not negative.
fn clip(corners: &[Vec3], inside: impl Fn(Vec3) -> f64) -> Vec<Vec3> {
    let mut kept = Vec::new();
    for (nth, &from) in corners.iter().enumerate() {
        let to = corners[(nth + 1) % corners.len()];
        let (at_from, at_to) = (inside(from), inside(to));
        if at_from >= 0.0 {
            kept.push(from);
        }
        if (at_from >= 0.0) != (at_to >= 0.0) {
            kept.push(from + (to - from) * (at_from / (at_from - at_to)));
        }
    }
    kept
}

/// Whether the viewer stands on the side that is allowed: then the plane is behind everything.
pub fn is_in_back(wall: &Wall, view: &View) -> bool {
    wall.normal.dot(view.camera.toward()) >= 0.0
}

/// Draws the piece within the scene. One that is in front of everything is hardly more than a frame.
pub fn draw(wall: &Wall, scene: &Scene, view: &View, marks: &mut Marks) {
    let corners = piece(wall, scene);
    if corners.len() < 3 {
        return;
    }
    let places: Vec<Point> = corners
        .iter()
        .map(|corner| view.place(corner.to_array()))
        .collect();
    let edge = mix(wall.tint, -0.2);
    let is_in_back = is_in_back(wall, view);
    let (fill, opacity) = (mix(wall.tint, 0.35), if is_in_back { 0.26 } else { 0.08 });
    let outline = if is_in_back {
        Stroke::solid(&edge, 0.9)
    } else {
        Stroke::dashed(&edge, 0.9, "5 3")
    };
    marks.face(&places, &fill, opacity, outline);
    let colour = mix(wall.tint, if is_in_back { 0.45 } else { 0.7 });
    for [from, to] in hatch(&places) {
        marks.line(from, to, Stroke::solid(&colour, 0.6));
    }
}

/// Lines across a convex polygon on paper, all one way.
fn hatch(corners: &[Point]) -> Vec<[Point; 2]> {
    const APART: f64 = 13.0;
    // Rising to the right, as in an engineer's drawing.
    let (sin, cos) = (-50_f64).to_radians().sin_cos();
    let across = |(x, y): Point| y * cos - x * sin;
    let least = corners
        .iter()
        .map(|&at| across(at))
        .fold(f64::INFINITY, f64::min);
    let most = corners
        .iter()
        .map(|&at| across(at))
        .fold(f64::NEG_INFINITY, f64::max);
    let mut lines = Vec::new();
    let mut level = (least / APART).ceil() * APART;
    while level < most && lines.len() < 200 {
        let mut ends: Vec<Point> = Vec::new();
        for (nth, &from) in corners.iter().enumerate() {
            let to = corners[(nth + 1) % corners.len()];
            let (a, b) = (across(from) - level, across(to) - level);
            if (a < 0.0) != (b < 0.0) {
                let part = a / (a - b);
                ends.push((
                    from.0 + part * (to.0 - from.0),
                    from.1 + part * (to.1 - from.1),
                ));
            }
        }
        if let [from, to] = ends[..] {
            lines.push([from, to]);
        }
        level += APART;
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clipped_square_keeps_what_is_inside() {
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        let square = square.map(|(x, y)| Vec3::new(x, y, 0.0));
        let kept = clip(&square, |point| 1.0 - point.x);
        assert_eq!(kept.len(), 4);
        assert!(kept.iter().all(|point| point.x <= 1.0));
        assert!(clip(&square, |point| -1.0 - point.x).is_empty());
        let corner = clip(&square, |point| point.x + point.y - 3.0);
        assert_eq!(corner.len(), 3);
    }

    #[test]
    fn hatching_stays_within_its_polygon() {
        let corners = [(0.0, 0.0), (100.0, 10.0), (80.0, 90.0), (10.0, 70.0)];
        let lines = hatch(&corners);
        assert!(lines.len() > 5, "{lines:?}");
        for (x, y) in lines.concat() {
            assert!((0.0..=100.0).contains(&x) && (0.0..=90.0).contains(&y));
        }
        assert!(hatch(&[(f64::NAN, 0.0), (1.0, 1.0), (2.0, 0.0)]).is_empty());
    }
}
