//! Puts labels where they cover neither a curve nor each other.

use super::ink::Lettering;
use super::lettering;
use super::svg::Point;

/// A rectangle on the picture [px].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// Upper left corner.
    pub at: Point,
    /// Width and height.
    pub size: Point,
}

impl Area {
    /// What a text covers.
    pub fn of_text(at: Point, text: &str, lettering: &Lettering) -> Self {
        let width = lettering::width(text, lettering.size);
        let left = match lettering.anchor {
            "middle" => at.0 - width / 2.0,
            "end" => at.0 - width,
            _ => at.0,
        };
        Self {
            at: (left, at.1 - 0.8 * lettering.size),
            size: (width, 1.05 * lettering.size),
        }
    }

    fn holds(&self, point: Point) -> bool {
        (self.at.0 - 1.0..=self.at.0 + self.size.0 + 1.0).contains(&point.0)
            && (self.at.1 - 1.0..=self.at.1 + self.size.1 + 1.0).contains(&point.1)
    }

    fn overlap(&self, other: &Self) -> f64 {
        let along = |a: f64, a_size: f64, b: f64, b_size: f64| {
            ((a + a_size).min(b + b_size) - a.max(b)).max(0.0)
        };
        along(self.at.0, self.size.0, other.at.0, other.size.0)
            * along(self.at.1, self.size.1, other.at.1, other.size.1)
    }
}

/// What is on the picture already.
#[derive(Clone, Debug)]
pub struct Placement {
    page: Area,
    points: Vec<Point>,
    labels: Vec<Area>,
}

impl Placement {
    /// An empty picture on which labels may stand within `page`.
    pub fn within(page: Area) -> Self {
        Self {
            page,
            points: Vec::new(),
            labels: Vec::new(),
        }
    }

    /// A curve that labels should not cover.
    pub fn avoid_curve(&mut self, points: &[Point]) {
        for pair in points.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let length = (to.0 - from.0).hypot(to.1 - from.1);
            // NaN and endless lines are no obstacle.
            if length.is_nan() || length > 1e5 {
                continue;
            }
            let mut along = 0.0;
            while along <= length {
                let part = if length > 0.0 { along / length } else { 0.0 };
                self.points.push((
                    from.0 + part * (to.0 - from.0),
                    from.1 + part * (to.1 - from.1),
                ));
                along += 4.0;
            }
        }
    }

    /// A label that stands there already.
    pub fn avoid(&mut self, area: Area) {
        self.labels.push(area);
    }

    /// Takes the first of the `candidates` that covers nothing, or else the one that covers least;
    /// `None` if each would cover another label or leave the page.
    pub fn choose(&mut self, candidates: &[(Point, Lettering)], text: &str) -> Option<usize> {
        let areas: Vec<Area> = candidates
            .iter()
            .map(|(at, lettering)| Area::of_text(*at, text, lettering))
            .collect();
        let costs = areas.iter().map(|area| self.cost(area));
        let (best, cost) = costs.enumerate().min_by(|a, b| a.1.total_cmp(&b.1))?;
        if cost >= COVERS_A_LABEL {
            return None;
        }
        self.labels.push(areas[best]);
        Some(best)
    }

    fn cost(&self, area: &Area) -> f64 {
        let inside = area.overlap(&self.page) >= 0.995 * area.size.0 * area.size.1;
        let free = self.labels.iter().all(|label| label.overlap(area) < 1.0);
        if !inside || !free {
            return COVERS_A_LABEL;
        }
        let covered = self
            .points
            .iter()
            .filter(|&&point| area.holds(point))
            .count();
        (covered as f64).min(COVERS_A_LABEL - 1.0)
    }
}

const COVERS_A_LABEL: f64 = 1e6;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_avoid_curves_each_other_and_the_edge() {
        let page = Area {
            at: (0.0, 0.0),
            size: (200.0, 100.0),
        };
        let mut placement = Placement::within(page);
        placement.avoid_curve(&[(0.0, 20.0), (200.0, 20.0)]);
        let plain = Lettering::new(10.0, "black");
        let candidates = [
            ((-5.0, 50.0), plain),
            ((10.0, 24.0), plain),
            ((10.0, 60.0), plain),
        ];
        assert_eq!(
            placement.choose(&candidates, "label"),
            Some(2),
            "not off the page, not on the curve"
        );
        assert_eq!(
            placement.choose(&candidates, "label"),
            Some(1),
            "rather on the curve than on a label"
        );
        assert_eq!(placement.choose(&candidates, "label"), None);
    }
}
