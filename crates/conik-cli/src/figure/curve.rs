//! What is done to a curve before it is drawn: a long one keeps of each stretch the least and the
//! greatest value only, and parts are cut out of it.

use super::svg::Point;

/// At most `2 * buckets + 2` points of the curve: first, last, and of each of `buckets` stretches of
/// equally many rows the minimum and the maximum, in their order. A value that is not finite
/// leaves a gap.
pub fn decimate(x: &[f64], y: &[f64], buckets: usize) -> Vec<Point> {
    let rows = x.len().min(y.len());
    if rows <= 2 * buckets.max(1) + 2 {
        return x.iter().copied().zip(y.iter().copied()).collect();
    }
    let at = |row: usize| (x[row], y[row]);
    let mut points = vec![at(0)];
    let inner = rows - 2;
    for bucket in 0..buckets {
        let from = 1 + bucket * inner / buckets;
        let to = 1 + (bucket + 1) * inner / buckets;
        let finite = (from..to).filter(|&row| y[row].is_finite());
        let least = finite.clone().min_by(|&a, &b| y[a].total_cmp(&y[b]));
        let greatest = finite.max_by(|&a, &b| y[a].total_cmp(&y[b]));
        match (least, greatest) {
            (Some(least), Some(greatest)) if least == greatest => points.push(at(least)),
            (Some(least), Some(greatest)) => {
                points.push(at(least.min(greatest)));
                points.push(at(least.max(greatest)));
            }
            _ => points.push((x[from], f64::NAN)),
        }
    }
    points.push(at(rows - 1));
    points
}

/// The rows of a curve in space worth drawing: of each of `buckets` stretches those in which a
/// coordinate is least or greatest, besides the first and the last.
pub fn decimate_in_space(coordinates: [&[f64]; 3], buckets: usize) -> Vec<usize> {
    let rows = coordinates.map(<[f64]>::len).into_iter().min().unwrap_or(0);
    if rows <= 6 * buckets.max(1) + 2 {
        return (0..rows).collect();
    }
    let mut kept = vec![0, rows - 1];
    for bucket in 0..buckets {
        let (from, to) = (bucket * rows / buckets, (bucket + 1) * rows / buckets);
        for values in coordinates {
            let finite = (from..to).filter(|&row| values[row].is_finite());
            let least = finite
                .clone()
                .min_by(|&a, &b| values[a].total_cmp(&values[b]));
            kept.extend(least);
            kept.extend(finite.max_by(|&a, &b| values[a].total_cmp(&values[b])));
        }
    }
    kept.sort_unstable();
    kept.dedup();
    kept
}

/// The part of a curve between two times, cut where it meets them.
pub fn within(points: &[Point], from: f64, to: f64) -> Vec<Point> {
    let mut part = Vec::new();
    for pair in points.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        if b.0 < from || a.0 > to {
            continue;
        }
        let cut = |t: f64| (t, a.1 + (b.1 - a.1) * (t - a.0) / (b.0 - a.0));
        if a.0 < from && from < b.0 {
            part.push(cut(from));
        } else if a.0 >= from {
            part.push(a);
        }
        if a.0 < to && to < b.0 {
            part.push(cut(to));
        }
    }
    part.extend(points.last().filter(|last| (from..=to).contains(&last.0)));
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extremes_survive_wherever_they_are() {
        let rows = 100_000;
        let x: Vec<f64> = (0..rows).map(f64::from).collect();
        for spike in [1_usize, 17, 4_999, 50_000, 99_998] {
            let mut y: Vec<f64> = x.iter().map(|t| (t * 1e-3).sin()).collect();
            y[spike] = 7.0;
            y[(spike + 31_337) % 100_000] = -7.0;
            let points = decimate(&x, &y, 999);
            assert!(points.len() <= 2000);
            assert!(points.contains(&(x[spike], 7.0)), "maximum at row {spike}");
            assert!(points.iter().any(|point| point.1 == -7.0), "minimum");
            assert!(points.is_sorted_by(|a, b| a.0 < b.0), "in order of time");
            assert_eq!((points[0].0, points[points.len() - 1].0), (0.0, x[99_999]));
        }
    }

    #[test]
    fn short_curves_are_left_alone_and_gaps_stay_gaps() {
        assert_eq!(decimate(&[1.0], &[2.0], 10), [(1.0, 2.0)]);
        assert_eq!(decimate(&[], &[], 10), []);
        let x: Vec<f64> = (0..1000).map(f64::from).collect();
        let mut y = vec![1.0; 1000];
        y[400..600].fill(f64::NAN);
        let points = decimate(&x, &y, 20);
        assert!(
            points
                .iter()
                .any(|p| p.1.is_nan() && (400.0..600.0).contains(&p.0))
        );
        assert!(points.iter().filter(|p| p.1 == 1.0).count() > 10);
    }

    #[test]
    fn a_path_keeps_its_corners() {
        let rows = 50_000;
        let mut x = vec![0.0; rows];
        x[12_345] = -1.0;
        let line: Vec<f64> = (0..50_000).map(f64::from).collect();
        let kept = decimate_in_space([&x, &line, &line], 200);
        assert!(kept.len() <= 1202 && kept.contains(&12_345));
        assert!(kept.contains(&0) && kept.contains(&(rows - 1)));
    }

    #[test]
    fn a_part_of_a_curve_ends_where_it_is_cut() {
        let curve = [(0.0, 0.0), (2.0, 2.0), (4.0, 0.0)];
        assert_eq!(
            within(&curve, 1.0, 3.0),
            [(1.0, 1.0), (2.0, 2.0), (3.0, 1.0)]
        );
        assert_eq!(within(&curve, 0.5, 1.5), [(0.5, 0.5), (1.5, 1.5)]);
        assert_eq!(within(&curve, 0.0, 4.0), curve);
        assert_eq!(within(&curve, 5.0, 6.0), []);
    }
}
