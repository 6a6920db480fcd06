//! From text to XML: what is no XML, no URDF, or not yet one.

use roxmltree::{Document, Error, Node, ParsingOptions};

use crate::element::Element;
use crate::error::{Place, UrdfError, quoted};
use crate::extent;

/// Elements, texts and comments that a description may have. The largest of public ones have a
/// hundredth of it.
const MOST_NODES: u32 = 500_000;

const ROBOT: &str = "a description is `<robot name=\"...\">` with its links and joints";
const EXPAND: &str = "expand it first: `xacro FILE.urdf.xacro > FILE.urdf` (or `ros2 run xacro xacro \
                      FILE.urdf.xacro > FILE.urdf`), then give that file";

/// Reads the text as XML.
pub(crate) fn parse(text: &str) -> Result<Document<'_>, UrdfError> {
    // A mark of the byte order, and blank lines before the declaration, are not XML; people have them.
    let body = text.trim_start_matches(|c: char| c == '\u{feff}' || c.is_whitespace());
    let lines_before = text[..text.len() - body.len()].matches('\n').count();
    if body.is_empty() {
        return Err(no_xml(1, 1, "the text is empty", ROBOT));
    }
    if lines_before > 0 && body.starts_with("<?xml") {
        return Err(no_xml(
            lines_before + 1,
            1,
            "there is something before the XML declaration",
            "`<?xml ...?>` must be the first thing in the text: delete the blank lines before it",
        ));
    }
    let options = ParsingOptions {
        nodes_limit: MOST_NODES,
        ..ParsingOptions::default()
    };
    // Places count from the beginning of the text, so what is before it must stay unless it cannot.
    let whole = text.trim_start_matches('\u{feff}');
    if let Some((byte, what)) = extent::too_many(whole) {
        let before = &whole[..byte];
        let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
        let line = before.matches('\n').count() + 1;
        return Err(no_xml(
            line,
            column,
            what,
            "is it a description of a robot?",
        ));
    }
    Document::parse_with_options(whole, options).map_err(|error| {
        let place = error.pos();
        let dtd = whole.find("<!DOCTYPE");
        let at_end = matches!(
            error,
            Error::UnclosedRootNode | Error::UnexpectedEndOfStream
        );
        let (line, column) = if at_end {
            (whole.trim_end().lines().count(), 1)
        } else if let (Error::DtdDetected, Some(dtd)) = (&error, dtd) {
            (whole[..dtd].matches('\n').count() + 1, 1)
        } else {
            (place.row as usize, place.col as usize)
        };
        let (what, help) = explained(&error);
        no_xml(line, column, what, help)
    })
}

fn no_xml(
    line: usize,
    column: usize,
    what: impl Into<String>,
    help: impl Into<String>,
) -> UrdfError {
    UrdfError {
        place: Place::Text {
            line,
            column,
            element: String::new(),
        },
        what: what.into(),
        help: help.into(),
    }
}

fn explained(error: &Error) -> (String, String) {
    let plain = |what: &str, help: &str| (what.to_owned(), help.to_owned());
    match error {
        Error::UnknownNamespace(prefix, _) if prefix == "xacro" => {
            plain("this is xacro, from which URDF is made", EXPAND)
        }
        Error::UnknownNamespace(prefix, _) => (
            format!("the prefix {} is not declared", quoted(prefix)),
            format!("declare it in `<robot xmlns:{prefix}=\"...\">`, or remove what has it"),
        ),
        Error::DtdDetected => plain(
            "the text has a document type declaration",
            "URDF has none: remove `<!DOCTYPE ...>`",
        ),
        Error::UnexpectedDeclaration(_) => plain(
            "there is something before the XML declaration",
            "`<?xml ...?>` must be the first thing in the text, and there only once",
        ),
        Error::NodesLimitReached => (
            format!("the text has more than {MOST_NODES} elements"),
            "is it a description of a robot?".to_owned(),
        ),
        Error::NoRootNode => plain("the text has no whole element", ROBOT),
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => plain(
            "the text ends within an element",
            "is the file complete? Every `<x>` needs its `</x>`",
        ),
        Error::UnexpectedCloseTag(expected, found, _) => (
            format!("`</{}>` ends what `<{}>` began", cut(found), cut(expected)),
            format!("write `</{}>` before it", cut(expected)),
        ),
        Error::DuplicatedAttribute(name, _) => (
            format!("the attribute `{}` is given twice", cut(name)),
            "state it once".to_owned(),
        ),
        Error::InvalidComment(_) => plain(
            "a comment is not well formed",
            "`--` must not stand within a comment: write `-` or `==`",
        ),
        // What the reader of XML says besides ends with the place.
        other => {
            let said = other.to_string();
            let said = said.split(" at ").next().unwrap_or_default().to_owned();
            (
                format!("this is no XML: {said}"),
                "a description is XML, with `<`, `&` and quotes written as XML demands".to_owned(),
            )
        }
    }
}

fn cut(name: &str) -> String {
    name.chars().take(48).filter(|c| !c.is_control()).collect()
}

/// The `<robot>` of a document, once it is known to be one and expanded.
pub(crate) fn robot<'d>(document: &'d Document<'d>) -> Result<Element<'d>, UrdfError> {
    let root = Element::new(document.root_element());
    let name = root.tag();
    if name != "robot" {
        let help = match name {
            "sdf" => "this is SDF, another format: convert it to URDF".to_owned(),
            "mujoco" => "this is MJCF, another format: convert it to URDF".to_owned(),
            _ => ROBOT.to_owned(),
        };
        return Err(root.error(format!("found `<{}>`, expected `<robot>`", cut(name)), help));
    }
    let of_xacro = document
        .descendants()
        .find(|node| node.is_element() && is_xacro(*node));
    match of_xacro {
        Some(node) => {
            Err(Element::new(node).error("this is xacro, from which URDF is made", EXPAND))
        }
        None => Ok(root),
    }
}

/// Whether something is still to be expanded here. Controllers and simulators have such texts of their own.
fn is_xacro(node: Node) -> bool {
    // Before prefixes were demanded of it, in the first years of ROS.
    let is_old = matches!(Element::new(node).written_tag(), "include" | "macro")
        && node.parent_element() == Some(node.document().root_element());
    let of_namespace = node
        .tag_name()
        .namespace()
        .is_some_and(|uri| uri.contains("xacro"));
    let is_read = matches!(
        node.tag_name().name(),
        "robot" | "link" | "joint" | "origin" | "axis" | "parent" | "child" | "limit" | "mimic"
    );
    let to_expand =
        |value: &str| value.contains("${") || value.contains("$(arg") || value.contains("$(eval");
    of_namespace
        || is_old
        || is_read
            && node
                .attributes()
                .any(|attribute| to_expand(attribute.value()))
}
