//! The way of the tool as one line, thinned as it comes.

use conik::Vec3;

/// Points of the line at most: what nobody can tell from more.
const MOST: usize = 10_000;

/// A path of which every so many rows are kept.
#[derive(Debug)]
pub struct Path {
    points: Vec<(Vec3, u32)>,
    last: Option<(Vec3, u32)>,
    every: usize,
    rows: usize,
}

impl Default for Path {
    fn default() -> Self {
        Self {
            points: Vec::new(),
            last: None,
            every: 1,
            rows: 0,
        }
    }
}

impl Path {
    /// Adds where the tool was in the next row, and the number of the sets that were active there.
    pub fn add(&mut self, tool: Vec3, active: u32) {
        if self.rows.is_multiple_of(self.every) && tool.is_finite() {
            self.points.push((tool, active));
        }
        self.last = tool.is_finite().then_some((tool, active));
        self.rows += 1;
        if self.points.len() > MOST {
            let mut nth = 0;
            self.points.retain(|_| {
                nth += 1;
                nth % 2 == 1
            });
            self.every *= 2;
        }
    }

    /// The points, the last row's among them.
    pub fn points(mut self) -> Vec<(Vec3, u32)> {
        if self.points.last() != self.last.as_ref() {
            self.points.extend(self.last);
        }
        self.points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along(rows: u32) -> Vec<(Vec3, u32)> {
        let mut path = Path::default();
        for row in 0..rows {
            path.add(Vec3::new(f64::from(row), 0.0, 0.0), 0);
        }
        path.points()
    }

    #[test]
    fn short_paths_are_whole_and_long_ones_evenly_thinned() {
        assert_eq!(along(7).len(), 7);
        let long = along(50_001);
        assert!(
            (MOST / 2..=MOST + 1).contains(&long.len()),
            "{}",
            long.len()
        );
        assert_eq!(long.last().unwrap().0.x, 50_000.0);
        let steps: Vec<f64> = long.windows(2).map(|two| two[1].0.x - two[0].0.x).collect();
        assert!(steps.iter().all(|step| *step == 8.0), "{steps:?}");
    }

    #[test]
    fn what_is_no_place_is_left_out() {
        let mut path = Path::default();
        path.add(Vec3::ZERO, 0);
        path.add(Vec3::new(f64::NAN, 0.0, 0.0), 1);
        assert_eq!(path.points(), [(Vec3::ZERO, 0)]);
    }
}
