//! Reading a direction: a vector of any length but zero, brought to length 1.

use super::key::Key;
use super::mistake::Mistakes;
use super::table::{Entry, Table};

impl Table<'_> {
    /// A vector that is not zero, brought to length 1.
    pub(super) fn direction(&self, key: &'static Key, found: &mut Mistakes) -> Entry<[f64; 3]> {
        self.entry(key, |value| {
            let vector = value.vector(&key.range(), found)?;
            let unit = normalised(vector);
            if unit.is_none() {
                found.add(
                    value.span(),
                    &*value.path,
                    "the zero vector has no direction",
                    format!("any other length will do: {}", key.write_example()),
                );
            }
            unit
        })
    }
}

/// The vector of length 1 in that direction; `None` for the zero vector.
///
/// A vector that has length 1 within rounding stays as it is, so that a scenario written and read
/// again is the same: scaling, norm and division leave an error below 8 half-units of the last
/// place, 8.9e-16.
pub(super) fn normalised<const N: usize>(vector: [f64; N]) -> Option<[f64; N]> {
    let norm = |v: [f64; N]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    if (norm(vector) - 1.0).abs() <= 1e-15 {
        return Some(vector);
    }
    // Squares of very great or very small numbers would leave the range of a double.
    let greatest = vector
        .iter()
        .fold(0.0, |greatest: f64, x| greatest.max(x.abs()));
    if greatest == 0.0 {
        return None;
    }
    let scaled = vector.map(|x| x / greatest);
    Some(scaled.map(|x| x / norm(scaled)))
}

#[cfg(test)]
mod tests {
    use super::normalised;

    #[test]
    fn a_normalised_vector_stays_as_it_is() {
        let mut x = 0.123;
        for _ in 0..10_000 {
            // Any sequence without a pattern will do: the logistic map in its chaotic range.
            let mut next = || {
                x = 3.99 * x * (1.0 - x);
                x - 0.5
            };
            let unit = normalised([next(), next(), next()]).expect("not zero");
            assert_eq!(normalised(unit), Some(unit));
        }
    }

    #[test]
    fn every_length_but_zero_has_a_direction() {
        assert_eq!(normalised([0.0, -0.0, 0.0]), None);
        for x in [1e-308, 1e-200, 0.3, 7.0, 1e200, f64::MAX] {
            assert_eq!(normalised([0.0, x, 0.0]), Some([0.0, 1.0, 0.0]), "{x}");
        }
    }
}
