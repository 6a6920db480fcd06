//! Whatever becomes of a description, it is read or refused: no panic, no hang.

use conik_urdf::{Options, read};
use proptest::prelude::*;

const TEXTS: [&str; 4] = [
    include_str!("fixtures/six_axes.urdf"),
    include_str!("fixtures/gripper.urdf"),
    include_str!("fixtures/torso.urdf"),
    include_str!("fixtures/gantry.urdf"),
];

/// What is put into texts: what belongs there, elsewhere, and what belongs nowhere.
const PIECES: [&str; 24] = [
    "0",
    "-1",
    "1e308",
    "nan",
    "1e-320",
    "\"",
    "<",
    ">",
    "/",
    "&",
    "&#0;",
    "palm",
    "left",
    "x",
    "floating",
    "fixed",
    "revolute",
    "<mimic joint=\"left\"/>",
    "<link name=\"a\"/>",
    "</joint>",
    "<!--",
    "]]>",
    "\u{feff}",
    "ü",
];

fn lengthened(text: &str, places: &[(usize, usize, usize)]) -> String {
    let mut text: Vec<char> = text.chars().collect();
    for &(at, cut, piece) in places {
        let at = at % (text.len() + 1);
        let end = (at + cut).min(text.len());
        text.splice(at..end, PIECES[piece % PIECES.len()].chars());
    }
    text.into_iter().collect()
}

/// Words of a text exchanged: still XML, mostly, but of another tree.
fn exchanged(text: &str, pairs: &[(usize, usize)]) -> String {
    let mut parts: Vec<&str> = text.split('"').collect();
    let values = parts.len() / 2;
    for &(one, other) in pairs {
        parts.swap(2 * (one % values) + 1, 2 * (other % values) + 1);
    }
    parts.join("\"")
}

fn survives(text: &str) -> bool {
    let names = ["", "palm", "left_hand", "flange", "nozzle"];
    let ways = names
        .iter()
        .flat_map(|base| names.iter().map(move |tool| (base, tool)));
    let mut is_read = false;
    for (base, tool) in ways {
        let named = |name: &str| (!name.is_empty()).then(|| name.to_owned());
        let options = Options {
            base: named(base),
            tools: named(tool).into_iter().collect(),
        };
        match read(text, &options) {
            Ok(described) => {
                is_read = true;
                assert!(described.robot.dof() > 0);
                assert_eq!(described.efforts.len(), described.robot.dof());
            }
            Err(error) => assert!(error.to_string().len() < 3000),
        }
    }
    is_read
}

#[test]
fn unspoilt_texts_are_read() {
    assert!(TEXTS.iter().all(|text| survives(text)));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn spoilt_texts_are_read_or_refused(
        which in 0..TEXTS.len(),
        places in prop::collection::vec((any::<usize>(), 0_usize..12, any::<usize>()), 1..6),
    ) {
        survives(&lengthened(TEXTS[which], &places));
    }

    #[test]
    fn exchanged_values_are_read_or_refused(
        which in 0..TEXTS.len(),
        pairs in prop::collection::vec((any::<usize>(), any::<usize>()), 1..8),
    ) {
        survives(&exchanged(TEXTS[which], &pairs));
    }

    #[test]
    fn cut_texts_are_refused(which in 0..TEXTS.len(), at in any::<usize>()) {
        let text: String = TEXTS[which].chars().take(at % (TEXTS[which].len() - 12)).collect();
        prop_assert!(!survives(&text));
    }
}
