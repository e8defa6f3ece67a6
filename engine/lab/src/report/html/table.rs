//! Tables.

use super::writer::Writer;

/// How a column is set.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// Words.
    Text,
    /// Numbers, right-aligned with digits of one width.
    Number,
}

/// A heading and how its column is set.
pub struct Column {
    /// The heading.
    pub heading: String,
    /// How the column is set.
    pub align: Align,
}

/// A column of words.
pub fn words(heading: &str) -> Column {
    Column {
        heading: heading.into(),
        align: Align::Text,
    }
}

/// A column of numbers.
pub fn numbers(heading: &str) -> Column {
    Column {
        heading: heading.into(),
        align: Align::Number,
    }
}

/// Writes a table under its caption. The first cell of a row is its heading. Wide tables scroll on
/// a narrow screen, while the caption stays.
pub fn table(w: &mut Writer, caption: &str, columns: &[Column], rows: &[Vec<String>]) {
    table_with_total(w, caption, columns, rows, &[]);
}

/// Writes a table with a last row that sums up the others and stays last however they are sorted.
pub fn table_with_total(
    w: &mut Writer,
    caption: &str,
    columns: &[Column],
    rows: &[Vec<String>],
    total: &[String],
) {
    w.element("figure", &[("class", "data")], |w| {
        w.leaf("figcaption", &[("class", "above")], caption);
        // A region that scrolls must be reachable with the keyboard.
        let region = [
            ("class", "wide"),
            ("tabindex", "0"),
            ("role", "region"),
            ("aria-label", caption),
        ];
        w.element("div", &region, |w| {
            w.element("table", &[("aria-label", caption)], |w| {
                w.element("thead", &[], |w| head(w, columns));
                w.element("tbody", &[], |w| {
                    rows.iter().for_each(|row| body_row(w, columns, row))
                });
                if !total.is_empty() {
                    w.element("tfoot", &[], |w| body_row(w, columns, total));
                }
            });
        });
    });
}

fn class(column: Option<&Column>) -> &'static str {
    match column.map(|c| c.align) {
        Some(Align::Number) => "n",
        _ => "t",
    }
}

fn head(w: &mut Writer, columns: &[Column]) {
    w.element("tr", &[], |w| {
        for column in columns {
            let attributes = [("scope", "col"), ("class", class(Some(column)))];
            // The script makes buttons of the headings that sort the table.
            w.leaf("th", &attributes, &column.heading);
        }
    });
}

fn body_row(w: &mut Writer, columns: &[Column], row: &[String]) {
    w.element("tr", &[], |w| {
        for (i, cell) in row.iter().enumerate() {
            if i == 0 {
                w.leaf("th", &[("scope", "row")], cell);
            } else {
                w.leaf("td", &[("class", class(columns.get(i)))], cell);
            }
        }
    });
}

/// Writes pairs of a name and a value.
pub fn facts(w: &mut Writer, pairs: &[(&str, String)]) {
    w.element("dl", &[("class", "facts")], |w| {
        for (name, value) in pairs {
            w.leaf("dt", &[], name);
            w.leaf("dd", &[], value);
        }
    });
}
