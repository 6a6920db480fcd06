//! One table of the page: columns where there is room, cells below each other on a phone.

use std::fmt::Write;

/// A section that is a table and a note.
pub fn section(title: &str, columns: &[(&str, bool)], body: &str, note: &str) -> String {
    let table = table(columns, body);
    format!("<section>\n<h2>{title}</h2>\n{table}{note}</section>\n")
}

/// Cells beside each other as columns; one with many has them below each other on a phone.
pub fn table(columns: &[(&str, bool)], body: &str) -> String {
    let is_wide = columns.len() > 3;
    let (class, body) = if is_wide {
        (" stacks", labelled(columns, body))
    } else {
        ("", body.to_owned())
    };
    let mut head = String::new();
    for &(name, is_number) in columns {
        let class = if is_number { " class=\"number\"" } else { "" };
        // Writing to a string cannot fail.
        let _ = write!(head, "<th scope=\"col\"{class}>{name}</th>");
    }
    format!(
        "<div class=\"table{class}\" tabindex=\"0\"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>\n\
         </table></div>\n"
    )
}

/// The rows, each cell with the name of its column, which stands beside it where there is no room for columns.
fn labelled(columns: &[(&str, bool)], body: &str) -> String {
    let row = |row: &str| {
        let mut names = columns.iter().map(|(name, _)| name);
        let mut cells = row.split_inclusive("<t");
        let mut labelled = cells.next().unwrap_or_default().to_owned();
        for cell in cells {
            // Text is escaped, so that this begins a cell, unless it begins the row.
            match (cell.get(..1), cell.starts_with('r')) {
                (Some(kind), false) => {
                    let name = names.next().unwrap_or(&"");
                    labelled += &format!("{kind} data-column=\"{name}\"{}", &cell[1..]);
                }
                _ => labelled += cell,
            }
        }
        labelled
    };
    body.split_inclusive("</tr>").map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_of_a_wide_table_know_their_columns() {
        let columns = [("a", false), ("b", true), ("c", true), ("d", true)];
        let row =
            "<tr><th scope=\"row\">x</th><td class=\"number\">1</td><td>2</td><td>t</td></tr>\n";
        let page = table(&columns, &row.repeat(2));
        for cell in [
            "<th data-column=\"a\" scope=\"row\">x</th>",
            "<td data-column=\"b\" class=\"number\">1</td>",
            "<td data-column=\"c\">2</td>",
            "<td data-column=\"d\">t</td></tr>",
        ] {
            assert_eq!(page.matches(cell).count(), 2, "{cell} in {page}");
        }
        let narrow = table(&columns[..3], row);
        assert!(narrow.contains(row) && !narrow.contains("stacks"));
    }
}
