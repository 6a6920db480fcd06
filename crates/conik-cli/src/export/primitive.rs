//! What a scene is made of: entities and their primitives, as messages of Foxglove's types.

use conik::{Pose, Shape, Vec3};

use super::protobuf::Message;

/// Red, green, blue, opacity, each from 0 to 1.
pub type Colour = [f64; 4];

/// The colour `#rrggbb`, that opaque.
pub fn colour(code: &str, opacity: f64) -> Colour {
    let part = |at: usize| {
        let digits = code.get(at..at + 2).unwrap_or("80");
        f64::from(u8::from_str_radix(digits, 16).unwrap_or(0x80)) / 255.0
    };
    [part(1), part(3), part(5), opacity]
}

/// A time of the run in nanoseconds since its start.
pub fn nanoseconds(t_s: f64) -> u64 {
    // Runs begin at 0 and last for less than centuries.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let nanoseconds = (t_s * 1e9).round() as u64;
    nanoseconds
}

/// A time as `google.protobuf.Timestamp` has it.
pub fn timestamp(field: u32, nanoseconds: u64, to: &mut Message) {
    to.message(field, |time| {
        time.whole(1, nanoseconds / 1_000_000_000);
        time.whole(2, nanoseconds % 1_000_000_000);
    });
}

/// Three numbers: `foxglove.Vector3` or `foxglove.Point3`.
pub fn vector(field: u32, value: Vec3, to: &mut Message) {
    to.message(field, |vector| {
        for (number, part) in (1..).zip(value.to_array()) {
            vector.double(number, part);
        }
    });
}

/// `foxglove.Quaternion`.
pub fn orientation(field: u32, pose: &Pose, to: &mut Message) {
    let [w, x, y, z] = pose.to_quaternion_wxyz();
    to.message(field, |quaternion| {
        for (number, part) in (1..).zip([x, y, z, w]) {
            quaternion.double(number, part);
        }
    });
}

/// `foxglove.Pose`.
pub fn pose(field: u32, value: &Pose, to: &mut Message) {
    to.message(field, |pose| {
        vector(1, value.origin, pose);
        orientation(2, value, pose);
    });
}

/// `foxglove.FrameTransform` in `foxglove.FrameTransforms`.
pub fn transform(nanoseconds: u64, (parent, child): (&str, &str), pose: &Pose, to: &mut Message) {
    to.message(1, |transform| {
        timestamp(1, nanoseconds, transform);
        transform.text(2, parent);
        transform.text(3, child);
        vector(4, pose.origin, transform);
        orientation(5, pose, transform);
    });
}

/// `foxglove.Color`.
pub fn paint(field: u32, value: Colour, to: &mut Message) {
    to.message(field, |colour| {
        for (number, part) in (1..).zip(value) {
            colour.double(number, part);
        }
    });
}

/// Begins an entity of a `foxglove.SceneUpdate`, which stays until another one of its name comes, and
/// moves with its frame.
pub fn entity(
    update: &mut Message,
    (frame, id): (&str, &str),
    nanoseconds: u64,
    fill: impl FnOnce(&mut Message),
) {
    update.message(2, |entity| {
        timestamp(1, nanoseconds, entity);
        entity.text(2, frame);
        entity.text(3, id);
        entity.whole(5, 1);
        fill(entity);
    });
}

/// A shape in an entity. Of a half-space a thin plate is shown, whose edges are `plate_m` long [m].
pub fn shape(entity: &mut Message, shape: &Shape, colour: Colour, plate_m: f64) {
    match shape {
        Shape::Sphere(it) => sphere(entity, it.center(), it.radius(), colour),
        Shape::Cylinder(it) => cylinder(entity, it.ends(), it.radius(), colour),
        Shape::Capsule(it) => {
            let ends = it.ends();
            if (ends[1] - ends[0]).norm() > 0.0 {
                cylinder(entity, ends, it.radius(), colour);
            }
            for end in ends {
                sphere(entity, end, it.radius(), colour);
            }
        }
        Shape::Cuboid(it) => cube(entity, &it.pose(), it.size(), colour),
        Shape::HalfSpace(it) => {
            let thickness = 1e-3 * plate_m;
            let middle = it.point() - it.normal() * (0.5 * thickness);
            let size = Vec3::new(plate_m, plate_m, thickness);
            cube(entity, &upright(middle, it.normal()), size, colour);
        }
    }
}

/// A text that faces the reader, its letters `size_m` high [m].
pub fn text(entity: &mut Message, at: Vec3, words: &str, colour: Colour, size_m: f64) {
    entity.message(13, |text| {
        pose(1, &Pose::at(at), text);
        text.whole(2, 1);
        text.double(3, size_m);
        paint(5, colour, text);
        text.text(6, words);
    });
}

/// A line through points, each with its colour, as wide as `pixels` wherever one looks from.
pub fn line(entity: &mut Message, points: &[(Vec3, Colour)], pixels: f64) {
    entity.message(11, |line| {
        pose(2, &Pose::IDENTITY, line);
        line.double(3, pixels);
        line.whole(4, 1);
        for &(point, _) in points {
            vector(5, point, line);
        }
        for &(_, colour) in points {
            paint(7, colour, line);
        }
    });
}

fn sphere(entity: &mut Message, centre: Vec3, radius: f64, colour: Colour) {
    entity.message(9, |sphere| {
        pose(1, &Pose::at(centre), sphere);
        vector(2, Vec3::new(1.0, 1.0, 1.0) * (2.0 * radius), sphere);
        paint(3, colour, sphere);
    });
}

fn cylinder(entity: &mut Message, [from, to]: [Vec3; 2], radius: f64, colour: Colour) {
    let way = to - from;
    let size = Vec3::new(2.0 * radius, 2.0 * radius, way.norm());
    entity.message(10, |cylinder| {
        pose(1, &upright(from + way * 0.5, way.normalized()), cylinder);
        vector(2, size, cylinder);
        cylinder.double(3, 1.0);
        cylinder.double(4, 1.0);
        paint(5, colour, cylinder);
    });
}

fn cube(entity: &mut Message, at: &Pose, size: Vec3, colour: Colour) {
    entity.message(8, |cube| {
        pose(1, at, cube);
        vector(2, size, cube);
        paint(3, colour, cube);
    });
}

/// A frame whose z axis has that direction, of length 1; how it is turned about it does not show.
pub fn upright(origin: Vec3, z_axis: Vec3) -> Pose {
    let world = Pose::IDENTITY;
    // Any direction but nearly that of the axis itself.
    let beside = if z_axis.x.abs() < 0.7 {
        world.x_axis
    } else {
        world.y_axis
    };
    let y_axis = z_axis.cross(beside).normalized();
    Pose {
        x_axis: y_axis.cross(z_axis),
        y_axis,
        z_axis,
        origin,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn upright_frames_are_frames_with_that_axis() {
        for axis in [
            [0.0, 0.0, 1.0],
            [0.0, 0.0, -1.0],
            [1.0, 0.0, 0.0],
            [0.3, -0.8, 0.2],
        ] {
            let axis = Vec3::from(axis).normalized();
            let frame = upright(Vec3::ZERO, axis);
            assert!(frame.is_rigid(), "{frame:?}");
            assert_eq!(frame.z_axis, axis);
        }
    }

    #[test]
    fn colours_are_those_of_their_codes() {
        assert_eq!(colour("#ff0080", 0.5), [1.0, 0.0, 128.0 / 255.0, 0.5]);
    }
}
