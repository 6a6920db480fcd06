//! From where the scene is looked at: where most of it is seen.

use conik::Shape;

use super::camera::{Camera, Vector, difference};
use super::scene::Scene;
use super::solid;

/// What should be seen.
#[derive(Debug)]
pub struct Viewpoint<'a> {
    /// The scene; its path should be long on paper, and obstacles hide none of it.
    pub scene: &'a Scene,
    /// Figures that should be spread out on paper.
    pub figures: &'a [Vec<Vector>],
    /// Those of them that obstacles should not hide.
    pub last: Vec<Vec<Vector>>,
    /// What else hides the path.
    pub screens: &'a [Shape],
}

impl Viewpoint<'_> {
    /// Azimuth and elevation [degrees] as of [`Camera::at`].
    pub fn best_deg(&self) -> (f64, f64) {
        // Away from right angles to the axes, where an axis would be seen as a point.
        let azimuths = [30.0, 60.0, 120.0, 150.0, -150.0, -120.0, -60.0, -30.0];
        // From higher up the floor is more of a map and heights are lost: only for more path.
        let elevations = if self.figures.is_empty() {
            [28.0, 38.0, 48.0]
        } else {
            [18.0, 26.0, 36.0]
        };
        let mut best = (f64::NEG_INFINITY, (azimuths[0], elevations[0]));
        let views = elevations.map(|elevation| azimuths.map(|azimuth| (azimuth, elevation)));
        for view in views.into_iter().flatten() {
            let seen = self.seen(&Camera::at(view.0, view.1));
            // A few hundredths more are no reason to look from elsewhere.
            if seen > 1.03 * best.0.max(0.0) + 1e-9 {
                best = (seen, view);
            }
        }
        best.1
    }

    /// How much is seen, of the path and of the figures.
    fn seen(&self, camera: &Camera) -> f64 {
        // Axes of the base across the path or an obstacle make both hard to read.
        let clear = if self.base_is_aside(camera) {
            1.0
        } else {
            0.75
        };
        // So does a wall in front of everything.
        let walls = self.scene.around.walls.iter();
        let in_front = walls.filter(|wall| wall.normal.dot(camera.toward()) < 0.0);
        let clear = clear * 0.8_f64.powi(i32::try_from(in_front.count()).unwrap_or(9));
        let path = self.path_seen(camera);
        if self.figures.is_empty() {
            return clear * path;
        }
        let spread = |figure: &Vec<Vector>| {
            let lengths = figure
                .windows(2)
                .map(|pair| lengths(camera, pair[0], pair[1]));
            let (on_paper, whole) =
                lengths.fold((0.0, 1e-9), |sum, it| (sum.0 + it.0, sum.1 + it.1));
            on_paper / whole
        };
        // An arm reads best from the side that it works on.
        let clear = if self.works_in_front(camera) {
            clear
        } else {
            0.92 * clear
        };
        let spread: f64 = self.figures.iter().map(spread).sum();
        clear * (path + 1.5 * spread / self.figures.len() as f64 + 1.5 * self.unhidden(camera))
    }

    /// Whether the middle of the path is nearer than the base, where the figures end.
    fn works_in_front(&self, camera: &Camera) -> bool {
        let base = self.figures.iter().find_map(|line| line.last());
        let points = self.scene.path.iter().flat_map(|piece| &piece.points);
        let (count, sum) = points.fold((0.0, 0.0), |(count, sum), &point| {
            (count + 1.0, sum + camera.nearness(point))
        });
        base.is_none_or(|&base| sum >= count * camera.nearness(base))
    }

    /// The part of the last figures that no obstacle hides.
    fn unhidden(&self, camera: &Camera) -> f64 {
        let (mut seen, mut whole) = (0.0, 1e-9);
        for pair in self.last.iter().flat_map(|line| line.windows(2)) {
            let length = lengths(camera, pair[0], pair[1]).1;
            for part in [0.1, 0.3, 0.5, 0.7, 0.9] {
                let point = [0, 1, 2].map(|k| pair[0][k] + part * (pair[1][k] - pair[0][k]));
                let mut standing = self.scene.standing();
                whole += length;
                if !standing.any(|it| solid::hides(&it.shape, camera, point)) {
                    seen += length;
                }
            }
        }
        seen / whole
    }

    /// Whether the base is in the background, and no obstacle in front of it.
    fn base_is_aside(&self, camera: &Camera) -> bool {
        let scene = self.scene;
        if !scene.shows_base || !self.figures.is_empty() {
            return true;
        }
        let middle = [0, 1, 2].map(|k| f64::midpoint(scene.low[k], scene.high[k]));
        let hidden = scene.standing().any(|it| {
            let tip = [0.0, 0.0, 0.2 * (scene.high[0] - scene.low[0])];
            [[0.0; 3], tip]
                .iter()
                .any(|&point| solid::hides(&it.shape, camera, point))
        });
        !hidden && camera.nearness(middle) > camera.nearness([0.0, 0.0, middle[2]])
    }

    /// The part of the path that is seen, foreshortened as it is.
    fn path_seen(&self, camera: &Camera) -> f64 {
        let standing = self.scene.standing().map(|obstacle| &obstacle.shape);
        let screens: Vec<&Shape> = standing.chain(self.screens).collect();
        let (mut seen, mut whole) = (0.0, 1e-9);
        for piece in &self.scene.path {
            // Every fourth point will do.
            for pair in piece.points.chunks(4) {
                let (Some(&from), Some(&to)) = (pair.first(), pair.last()) else {
                    continue;
                };
                let (on_paper, length) = lengths(camera, from, to);
                whole += length;
                if !screens.iter().any(|shape| solid::hides(shape, camera, to)) {
                    seen += on_paper;
                }
            }
        }
        seen / whole
    }
}

/// The length of a line on paper, and in space [m].
fn lengths(camera: &Camera, from: Vector, to: Vector) -> (f64, f64) {
    let away = difference(from, to);
    let (right, up) = camera.project(away);
    (
        right.hypot(up),
        right.hypot(up).hypot(camera.nearness(away)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::obstacles::Surroundings;
    use crate::figure::scene::Piece;
    use conik::Cuboid;
    use conik::{Pose, Vec3};

    #[test]
    fn the_path_is_looked_at_past_what_would_hide_it() {
        let points = (0..=20).map(|k| [0.0, 0.05 * f64::from(k), 0.0]).collect();
        let scene = Scene {
            path: vec![Piece { mode: 0, points }],
            around: Surroundings::default(),
            targets: Vec::new(),
            shows_base: false,
            origin: "base",
            low: [-1.0; 3],
            high: [1.0; 3],
            step: 0.2,
        };
        for side in [-1.0, 1.0] {
            let screen = Pose::at(Vec3::new(0.3 * side, 0.5, 0.0));
            let screen = Cuboid::new(screen, [0.02, 4.0, 4.0]).into();
            let viewpoint = Viewpoint {
                scene: &scene,
                figures: &[],
                last: Vec::new(),
                screens: &[screen],
            };
            let (azimuth, elevation) = viewpoint.best_deg();
            let toward = Camera::at(azimuth, elevation).toward();
            assert!(
                toward.x * side < 0.0,
                "from {azimuth}, the screen on side {side}"
            );
        }
    }
}
