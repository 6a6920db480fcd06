//! In which order solids are painted, so that those in front cover those behind.

use conik::Shape;

use super::camera::Camera;
use super::solid;

/// A solid, and the figure that it is a part of.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    /// The shape.
    pub shape: Shape,
    /// The figure: parts of different figures are of different times, and are not sorted. `None`: it stands
    /// by itself, and is sorted among everything.
    pub figure: Option<usize>,
    /// Whether it is a translucent hull of parts of its figure: it is painted over all of them.
    pub is_hull: bool,
}

/// The solids from back to front. Those of one figure stay together where they can, and earlier figures
/// come first.
pub fn back_to_front(camera: &Camera, solids: &[Placed]) -> Vec<usize> {
    let count = solids.len();
    let mut in_front: Vec<Vec<usize>> = vec![Vec::new(); count];
    let mut behind = vec![0_usize; count];
    for (i, first) in solids.iter().enumerate() {
        for (j, second) in solids.iter().enumerate().skip(i + 1) {
            let same_time = match (first.figure, second.figure) {
                (Some(a), Some(b)) => a == b,
                _ => true,
            };
            if !same_time {
                continue;
            }
            let of_one_figure = first.figure.is_some() && first.figure == second.figure;
            let is_behind = if of_one_figure && first.is_hull != second.is_hull {
                Some(second.is_hull)
            } else {
                solid::is_behind(camera, &first.shape, &second.shape)
            };
            match is_behind {
                Some(true) => {
                    in_front[i].push(j);
                    behind[j] += 1;
                }
                Some(false) => {
                    in_front[j].push(i);
                    behind[i] += 1;
                }
                None => {}
            }
        }
    }
    let nearness: Vec<f64> = solids
        .iter()
        .map(|placed| camera.nearness(solid::middle(&placed.shape).to_array()))
        .collect();
    let mut left: Vec<usize> = (0..count).collect();
    let mut order: Vec<usize> = Vec::with_capacity(count);
    while !left.is_empty() {
        let last = order.last().and_then(|&last| solids[last].figure);
        // Solids that cover each other in a circle have no order; then the one with least behind it goes on.
        let rank = |&i: &usize| {
            let other = solids[i].figure.is_some() && solids[i].figure != last;
            (behind[i], other, solids[i].figure)
        };
        let best = left.iter().enumerate().min_by(|(_, a), (_, b)| {
            rank(a)
                .cmp(&rank(b))
                .then(nearness[**a].total_cmp(&nearness[**b]))
        });
        let Some((place, &next)) = best else { break };
        left.swap_remove(place);
        order.push(next);
        for &j in &in_front[next] {
            behind[j] = behind[j].saturating_sub(1);
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use conik::{Cuboid, Pose, Sphere, Vec3};

    #[test]
    fn what_stands_before_comes_after_and_figures_stay_together() {
        let camera = Camera::at(0.0, 20.0);
        let ball = |x: f64, z: f64, figure| Placed {
            shape: Sphere::new([x, 0.0, z], 0.1).into(),
            figure,
            is_hull: false,
        };
        let board = Placed {
            shape: Cuboid::new(Pose::at(Vec3::new(1.0, 0.0, 0.0)), [2.0, 1.0, 0.02]).into(),
            figure: None,
            is_hull: false,
        };
        let solids = [
            ball(0.3, 0.2, Some(1)),
            ball(1.0, -0.3, None),
            board,
            ball(0.2, 0.3, Some(0)),
            ball(0.5, 0.5, Some(1)),
        ];
        let order = back_to_front(&camera, &solids);
        let place = |solid: usize| order.iter().position(|&it| it == solid).unwrap();
        assert!(place(1) < place(2), "below the board, seen from above");
        assert!(place(2) < place(0), "on the board: {order:?}");
        assert_eq!(
            place(3) + 1,
            place(0).min(place(4)),
            "the earlier figure first"
        );
        assert_eq!(place(0).abs_diff(place(4)), 1, "a figure in one go");
    }
}
