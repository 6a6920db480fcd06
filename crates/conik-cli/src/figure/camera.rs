//! The view of the scene in three dimensions: an orthographic projection, as an engineer draws.

use conik::Vec3;

use super::svg::Point;

/// A point or direction in the base frame [m].
pub type Vector = [f64; 3];

/// Sum of products.
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// From `a` to `b`.
pub fn difference(a: Vector, b: Vector) -> Vector {
    [b[0] - a[0], b[1] - a[1], b[2] - a[2]]
}

/// Where the viewer stands; infinitely far away, so that parallels stay parallel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    right: Vector,
    up: Vector,
    toward: Vector,
}

impl Camera {
    /// A viewer in the direction of these angles [degrees]: from the x axis about z, and above the
    /// horizontal.
    pub fn at(azimuth_deg: f64, elevation_deg: f64) -> Self {
        let (sin_a, cos_a) = azimuth_deg.to_radians().sin_cos();
        let (sin_e, cos_e) = elevation_deg.to_radians().sin_cos();
        Self {
            right: [-sin_a, cos_a, 0.0],
            up: [-sin_e * cos_a, -sin_e * sin_a, cos_e],
            toward: [cos_e * cos_a, cos_e * sin_a, sin_e],
        }
    }

    /// The directions that appear as right and as up.
    pub fn frame(&self) -> [Vector; 2] {
        [self.right, self.up]
    }

    /// The direction to the viewer.
    pub fn toward(&self) -> Vec3 {
        self.toward.into()
    }

    /// How far right and how far up the point appears [m].
    pub fn project(&self, point: Vector) -> Point {
        (dot(self.right, point), dot(self.up, point))
    }

    /// How near to the viewer the point is [m], from an arbitrary zero.
    pub fn nearness(&self, point: Vector) -> f64 {
        dot(self.toward, point)
    }
}

/// A camera and the part of the picture that it fills.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The camera.
    pub camera: Camera,
    /// Size of a metre [px].
    pub scale: f64,
    origin: Point,
}

impl View {
    /// The view in which all `points` [m] lie between the corners `from` and `to` [px].
    pub fn fitting(camera: Camera, points: &[Vector], from: Point, to: Point) -> Self {
        let places: Vec<Point> = points.iter().map(|&point| camera.project(point)).collect();
        let (left, right) = super::axis::range(places.iter().map(|place| place.0));
        let (low, high) = super::axis::range(places.iter().map(|place| place.1));
        let across = (to.0 - from.0) / (right - left).max(1e-9);
        let upright = (to.1 - from.1) / (high - low).max(1e-9);
        let scale = across.min(upright).min(1e9);
        let origin = (
            f64::midpoint(from.0, to.0) - scale * f64::midpoint(left, right),
            f64::midpoint(from.1, to.1) + scale * f64::midpoint(low, high),
        );
        Self {
            camera,
            scale,
            origin,
        }
    }

    /// Where the point appears [px].
    pub fn place(&self, point: Vector) -> Point {
        let (right, up) = self.camera.project(point);
        (
            self.origin.0 + self.scale * right,
            self.origin.1 - self.scale * up,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn from_above_x_is_right_and_y_is_up() {
        let camera = Camera::at(-90.0, 90.0);
        let (right, up) = camera.project([2.0, 3.0, 4.0]);
        assert!((right - 2.0).abs() < 1e-12 && (up - 3.0).abs() < 1e-12);
        assert!((camera.nearness([2.0, 3.0, 4.0]) - 4.0).abs() < 1e-12);
    }

    #[test]
    fn everything_fits_the_picture() {
        let points = [[0.0, 0.0, 0.0], [0.5, -0.4, -0.3], [0.3, 0.6, 0.1]];
        let view = View::fitting(
            Camera::at(30.0, 25.0),
            &points,
            (10.0, 20.0),
            (210.0, 120.0),
        );
        for point in points {
            let (x, y) = view.place(point);
            assert!((9.99..=210.01).contains(&x) && (19.99..=120.01).contains(&y));
        }
    }
}
