//! An element of the text: its attributes, its children, and errors that name it.

use roxmltree::{Attribute, Node};

use crate::error::{Place, UrdfError, quoted};

/// Numbers beyond it are no lengths or angles of a robot [m, rad].
pub(crate) const GREATEST: f64 = 1e6;

/// Names of links and joints stand in every table, log and picture.
const MOST_BYTES: usize = 200;

/// An element with its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Element<'d> {
    node: Node<'d, 'd>,
}

impl<'d> Element<'d> {
    pub(crate) fn new(node: Node<'d, 'd>) -> Self {
        Self { node }
    }

    pub(crate) fn tag(&self) -> &'d str {
        self.node.tag_name().name()
    }

    /// URDF's elements directly in it.
    pub(crate) fn children(&self) -> impl Iterator<Item = Self> + use<'d> {
        self.elements().filter(|element| !element.has_prefix())
    }

    /// Elements directly in it that have a prefix: `<drake:limit>` is no `<limit>`.
    pub(crate) fn others(&self) -> impl Iterator<Item = Self> + use<'d> {
        self.elements().filter(Self::has_prefix)
    }

    fn elements(&self) -> impl Iterator<Item = Self> + use<'d> {
        self.node.children().filter(Node::is_element).map(Self::new)
    }

    fn has_prefix(&self) -> bool {
        self.written_tag().contains(':')
    }

    /// The tag with its prefix.
    pub(crate) fn written_tag(&self) -> &'d str {
        let text = &self.node.document().input_text()[self.node.range()];
        let after = text.strip_prefix('<').unwrap_or_default();
        let end = after.find(|c: char| c.is_whitespace() || matches!(c, '/' | '>'));
        &after[..end.unwrap_or(after.len())]
    }

    /// Names of its attributes that have no prefix.
    pub(crate) fn attribute_names(&self) -> impl Iterator<Item = &'d str> + use<'d> {
        let attributes = self.node.attributes();
        attributes
            .filter(|attribute| attribute.namespace().is_none())
            .map(|attribute| attribute.name())
    }

    /// The only element directly in it of this tag, if there is one.
    pub(crate) fn child(&self, tag: &str) -> Result<Option<Self>, UrdfError> {
        let mut found = self.children().filter(|child| child.tag() == tag);
        let first = found.next();
        match found.next() {
            Some(second) => Err(second.error(
                format!("a second `<{tag}>`"),
                "state it once: remove one of them",
            )),
            None => Ok(first),
        }
    }

    /// The byte of the text at which it begins.
    pub(crate) fn start(&self) -> usize {
        self.node.range().start
    }

    /// Line and column, both from 1.
    pub(crate) fn place(&self) -> (usize, usize) {
        self.place_of(self.node.range().start)
    }

    fn place_of(&self, byte: usize) -> (usize, usize) {
        let place = self.node.document().text_pos_at(byte);
        (place.row as usize, place.col as usize)
    }

    /// The element as messages name it: `joint "elbow"`, `limit of joint "elbow"`.
    pub(crate) fn described(&self) -> String {
        let own = match self.node.attribute("name") {
            Some(name) => format!("{} {}", self.tag(), quoted(name)),
            None => self.tag().to_owned(),
        };
        // What has no name of its own is best found by that of the link or joint that it is in.
        let mut carriers = self.node.ancestors().skip(1).map(Self::new);
        let named = carriers.find_map(|it| Some((it.tag(), it.node.attribute("name")?)));
        match named {
            Some((carrier, name)) if carrier != "robot" => {
                format!("{own} of {carrier} {}", quoted(name))
            }
            _ => own,
        }
    }

    /// An error about the element.
    pub(crate) fn error(&self, what: impl Into<String>, help: impl Into<String>) -> UrdfError {
        let (line, column) = self.place();
        UrdfError {
            place: Place::Text {
                line,
                column,
                element: self.described(),
            },
            what: what.into(),
            help: help.into(),
        }
    }

    fn found(&self, name: &str) -> Option<Attribute<'d, 'd>> {
        self.node
            .attributes()
            .find(|attribute| attribute.name() == name && attribute.namespace().is_none())
    }

    /// An error about one of its attributes, or about the element if the attribute is not there.
    pub(crate) fn error_at(
        &self,
        name: &str,
        what: impl Into<String>,
        help: impl Into<String>,
    ) -> UrdfError {
        let byte = self.found(name).map(|attribute| attribute.range().start);
        let (line, column) = byte.map_or_else(|| self.place(), |byte| self.place_of(byte));
        UrdfError {
            place: Place::Text {
                line,
                column,
                element: format!("{}, attribute `{name}`", self.described()),
            },
            what: what.into(),
            help: help.into(),
        }
    }

    pub(crate) fn attribute(&self, name: &str) -> Option<&'d str> {
        // The reader keeps values as it needs; they live as long as the document.
        self.node.attribute(name)
    }

    /// An attribute that must be there and say something.
    pub(crate) fn required(&self, name: &str, example: &str) -> Result<&'d str, UrdfError> {
        match self.attribute(name) {
            Some(value) if value.len() > MOST_BYTES => Err(self.error_at(
                name,
                format!("{} is {} bytes long", quoted(value), value.len()),
                format!("names have at most {MOST_BYTES}"),
            )),
            Some(value) if !value.trim().is_empty() => Ok(value),
            Some(_) => Err(self.error_at(name, "is empty", format!("write {example}"))),
            None => Err(self.error_at(name, "missing", format!("write {example}"))),
        }
    }

    /// A number within reason, if the attribute is there.
    pub(crate) fn number(&self, name: &str) -> Result<Option<f64>, UrdfError> {
        let number = self.any_number(name)?;
        match number {
            Some(number) if number.abs() > GREATEST => Err(self.too_great(name, number)),
            number => Ok(number),
        }
    }

    /// A finite number, if the attribute is there.
    pub(crate) fn any_number(&self, name: &str) -> Result<Option<f64>, UrdfError> {
        let Some(text) = self.attribute(name) else {
            return Ok(None);
        };
        self.parsed(name, text.trim()).map(Some)
    }

    /// So many numbers within reason, if the attribute is there. `in_words` is how many, and `example`
    /// what would be right.
    pub(crate) fn numbers<const N: usize>(
        &self,
        name: &str,
        (in_words, example): (&str, &str),
    ) -> Result<Option<[f64; N]>, UrdfError> {
        let Some(text) = self.attribute(name) else {
            return Ok(None);
        };
        let mut numbers = [0.0; N];
        let mut count = 0;
        for word in text.split_whitespace() {
            let number = self.parsed(name, word)?;
            if number.abs() > GREATEST {
                return Err(self.too_great(name, number));
            }
            if let Some(place) = numbers.get_mut(count) {
                *place = number;
            }
            count += 1;
        }
        if count == N {
            return Ok(Some(numbers));
        }
        Err(self.error_at(
            name,
            format!("expected {in_words} numbers, found {count}"),
            format!("write them with blanks between: `{name}=\"{example}\"`"),
        ))
    }

    /// Three numbers within reason, if the attribute is there.
    pub(crate) fn three_numbers(&self, name: &str) -> Result<Option<[f64; 3]>, UrdfError> {
        self.numbers(name, ("three", "0 0 1"))
    }

    fn parsed(&self, name: &str, word: &str) -> Result<f64, UrdfError> {
        let number: f64 = word.parse().map_err(|_| {
            let help = if word.contains(',') {
                "write a decimal point, and blanks between numbers: `0.5 0 1`"
            } else {
                "write a number, as `0.5` or `1e-3`"
            };
            self.error_at(name, format!("{} is not a number", quoted(word)), help)
        })?;
        if number.is_finite() {
            return Ok(number);
        }
        Err(self.error_at(
            name,
            format!("{} is not a finite number", quoted(word)),
            "write a finite number",
        ))
    }

    fn too_great(&self, name: &str, number: f64) -> UrdfError {
        self.error_at(
            name,
            format!("{number:e} is out of range"),
            format!(
                "allowed: from -{GREATEST} to {GREATEST}; lengths are in metres, angles in radians"
            ),
        )
    }
}
