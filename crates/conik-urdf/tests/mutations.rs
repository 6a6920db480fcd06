//! Whatever becomes of a description, it is read or refused: no panic, no hang. What is read is a robot
//! whose links are somewhere, and what is refused says where.

use conik::{Frame, Kinematics, Robot};
use conik_urdf::{Options, Place, UrdfError, read, shapes};
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

/// What stands where a value did: too great, too small, of another kind, somebody else's.
const VALUES: [&str; 22] = [
    "",
    " ",
    "0",
    "-0",
    "0 0 0",
    "1e6 -1e6 1e6",
    "1e-300 0 0",
    "1e6",
    "-1e300",
    "1e400",
    "-inf",
    "NaN",
    "1,2,3",
    "0x1p3",
    "${pi}",
    "fixed",
    "floating",
    "prismatic",
    "palm",
    "left",
    "chest",
    "\u{1f916}",
];

/// Values exchanged for others.
fn revalued(text: &str, changes: &[(usize, usize)]) -> String {
    let mut parts: Vec<&str> = text.split('"').collect();
    let values = parts.len() / 2;
    for &(place, value) in changes {
        parts[2 * (place % values) + 1] = VALUES[value % VALUES.len()];
    }
    parts.join("\"")
}

/// Elements left out, repeated and moved.
fn rearranged(text: &str, moves: &[(usize, usize, u8)]) -> String {
    let mut pieces: Vec<&str> = text.split_inclusive('>').collect();
    for &(from, to, kind) in moves {
        let from = from % pieces.len();
        let piece = pieces[from];
        if kind % 3 != 0 {
            pieces.insert(to % (pieces.len() + 1), piece);
        }
        if kind % 3 != 1 {
            pieces.remove(from);
        }
        if pieces.is_empty() {
            break;
        }
    }
    pieces.concat()
}

fn assert_is_somewhere(robot: &Robot) {
    let mut kinematics = Kinematics::new(robot);
    kinematics.update(&vec![0.7; robot.dof()]);
    for link in 0..robot.link_names().len() {
        let matrix = kinematics.world_from(Frame::Link(link)).to_matrix();
        assert!(matrix.iter().flatten().all(|entry| entry.is_finite()));
    }
    for joint in robot.joints() {
        let limits = joint.limits;
        assert!(limits.position.is_none_or(|(min, max)| min <= max));
        assert!(limits.speed.is_none_or(|most| most > 0.0));
        assert!(limits.acceleration.is_none_or(|most| most > 0.0));
    }
}

fn assert_says_where(text: &str, error: &UrdfError) {
    assert!(error.to_string().len() < 3000);
    assert!(!error.what.is_empty() && !error.help.is_empty());
    if let Place::Text { line, column, .. } = error.place {
        let lines = text.split('\n').count();
        assert!(
            (1..=lines).contains(&line),
            "line {line} of {lines}: {error}"
        );
        assert!(column >= 1, "{error}");
    }
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
                assert_is_somewhere(&described.robot);
                let lines = text.split('\n').count();
                assert!(described.notes.iter().all(|note| note.line <= lines));
            }
            Err(error) => assert_says_where(text, &error),
        }
    }
    // Whatever the joints are, shapes are read or refused too.
    if let Err(error) = shapes(text) {
        assert!(error.to_string().len() < 3000);
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
    fn other_values_are_read_or_refused(
        which in 0..TEXTS.len(),
        changes in prop::collection::vec((any::<usize>(), any::<usize>()), 1..5),
    ) {
        survives(&revalued(TEXTS[which], &changes));
    }

    #[test]
    fn rearranged_elements_are_read_or_refused(
        which in 0..TEXTS.len(),
        moves in prop::collection::vec((any::<usize>(), any::<usize>(), any::<u8>()), 1..6),
    ) {
        survives(&rearranged(TEXTS[which], &moves));
    }

    #[test]
    fn cut_texts_are_refused(which in 0..TEXTS.len(), at in any::<usize>()) {
        let text: String = TEXTS[which].chars().take(at % (TEXTS[which].len() - 12)).collect();
        prop_assert!(!survives(&text));
    }
}
