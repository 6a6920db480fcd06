//! What would keep a reader of XML busy for minutes: it compares attributes of an element, and namespaces,
//! each with each.

/// Attributes that an element may have; those of descriptions have a handful.
const MOST_ATTRIBUTES: usize = 100;
/// Namespaces that a text may declare; descriptions declare a dozen.
const MOST_NAMESPACES: usize = 1000;

/// The byte at which there are too many, and of what: in well-formed texts, and in others at least no
/// sooner than there are.
pub(crate) fn too_many(text: &str) -> Option<(usize, String)> {
    let (mut at, mut namespaces) = (0, 0);
    while let Some(open) = text[at..].find('<') {
        let start = at + open;
        let rest = &text[start..];
        let skipped = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")]
            .into_iter()
            .find(|(begin, _)| rest.starts_with(begin));
        if let Some((_, end)) = skipped {
            at = start + rest.find(end).map_or(rest.len(), |found| found + end.len());
            continue;
        }
        let (length, attributes) = tag(rest);
        at = start + length;
        if attributes > MOST_ATTRIBUTES {
            let what =
                format!("the element has {attributes} attributes, {MOST_ATTRIBUTES} at most");
            return Some((start, what));
        }
        namespaces += rest[..length].matches("xmlns").count();
        if namespaces > MOST_NAMESPACES {
            let what = format!("more than {MOST_NAMESPACES} namespaces are declared");
            return Some((start, what));
        }
    }
    None
}

/// How long the tag is that the text begins with, at least 1, and how many attributes it has.
fn tag(text: &str) -> (usize, usize) {
    let (mut quote, mut attributes) = (None, 0);
    for (place, byte) in text.bytes().enumerate().skip(1) {
        match (quote, byte) {
            // Not even a value may have it: a quote is missing.
            (_, b'<') => return (place, attributes),
            (Some(open), _) if open == byte => quote = None,
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b'=') => attributes += 1,
            (None, b'>') => return (place + 1, attributes),
            _ => {}
        }
    }
    (text.len(), attributes)
}
