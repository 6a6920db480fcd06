//! "Did you mean ...?": the known name nearest to a mistyped one.

/// Longer names are no typing mistakes, and comparing them costs time in proportion.
const LONGEST: usize = 64;

/// The candidate that `name` was probably meant to be, if any is near enough.
pub(super) fn nearest<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    if name.is_empty() || name.len() > LONGEST {
        return None;
    }
    let name = name.to_lowercase();
    candidates
        .into_iter()
        .filter(|candidate| candidate.len() <= LONGEST)
        .map(|candidate| (distance(&name, &candidate.to_lowercase()), candidate))
        .filter(|((distance, _), candidate)| *distance <= (candidate.chars().count() / 3).max(1))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// How far two names are apart: first in kind, then in edits. A name without its unit (`rate` for
/// `rate_hz`), with another unit, or with its words joined otherwise (`fieldOfView`) is one step
/// away, however many letters that makes.
fn distance(name: &str, candidate: &str) -> (usize, usize) {
    let edits = strsim::damerau_levenshtein(name, candidate);
    let joined = |text: &str| text.replace(['_', '-', ' ', '.'], "");
    let begins_with = |stem: &str| {
        candidate
            .strip_prefix(stem)
            .is_some_and(|unit| unit.is_empty() || unit.starts_with('_'))
    };
    let other_unit = name
        .rsplit_once('_')
        .is_some_and(|(stem, _)| begins_with(stem));
    if joined(name) == joined(candidate) || begins_with(name) || other_unit {
        (1, edits)
    } else {
        (edits, edits)
    }
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn typing_mistakes_and_forgotten_units_find_the_key() {
        let keys = [
            "rate_hz",
            "duration_s",
            "mode_rule",
            "gain_per_s",
            "q0_deg",
            "q0_rad",
        ];
        for (typed, meant) in [
            ("rate", "rate_hz"),
            ("rate_Hz", "rate_hz"),
            ("rat_hz", "rate_hz"),
            ("duration_ms", "duration_s"),
            ("moderule", "mode_rule"),
            ("gain", "gain_per_s"),
            ("q0_radians", "q0_rad"),
        ] {
            assert_eq!(nearest(typed, keys), Some(meant), "{typed}");
        }
    }

    #[test]
    fn far_names_suggest_nothing() {
        assert_eq!(nearest("colour", ["rate_hz", "min"]), None);
        assert_eq!(nearest("", ["x"]), None);
        assert_eq!(nearest(&"a".repeat(100_000), ["a"]), None);
    }
}
