//! What plots are drawn with, as SVG: a sheet, strokes, marks, whiskers and text.

use super::style::Style;
use crate::report::html::writer::Writer;

/// A white sheet of a width and height, with what is drawn on it.
pub(super) fn sheet([width, height]: [f64; 2], content: impl FnOnce(&mut Writer)) -> String {
    let (width, height) = (number(width), number(height));
    let view = format!("0 0 {width} {height}");
    let attributes = [
        ("xmlns", "http://www.w3.org/2000/svg"),
        ("viewBox", view.as_str()),
        ("width", &width),
        ("height", &height),
        (
            "font-family",
            "Helvetica, Arial, Liberation Sans, sans-serif",
        ),
        ("fill", "#1a1a1a"),
    ];
    let mut w = Writer::default();
    w.element("svg", &attributes, |w| {
        let whole = [("width", "100%"), ("height", "100%"), ("fill", "#ffffff")];
        w.element("rect", &whole, |_| {});
        content(w);
    });
    w.finish()
}

/// A line in a curve's colour and dashes.
pub(super) fn stroke(w: &mut Writer, path: &str, style: Style) {
    let attributes = [
        ("d", path),
        ("fill", "none"),
        ("stroke", style.colour),
        ("stroke-width", "2"),
        ("stroke-dasharray", style.dashes),
    ];
    // Without dashes there is no such attribute.
    let count = attributes.len() - usize::from(style.dashes.is_empty());
    w.element("path", &attributes[..count], |_| {});
}

/// An interval, from and to, at a place along the other axis.
pub(super) fn whisker(w: &mut Writer, at: f64, [low, high]: [f64; 2], style: Style) {
    let left = at - 3.0;
    let path = format!("M{at:.1} {low:.1}V{high:.1}m-3 0h6M{left:.1} {low:.1}h6");
    line(w, &path, style.colour, 1.2);
}

pub(super) fn mark(w: &mut Writer, [x, y]: [f64; 2], style: Style) {
    let place = format!("translate({x:.1} {y:.1})");
    let attributes = [
        ("d", style.shape),
        ("transform", &place),
        ("fill", style.fill),
        ("stroke", style.colour),
        ("stroke-width", "1.6"),
    ];
    w.element("path", &attributes, |_| {});
}

pub(super) fn line(w: &mut Writer, path: &str, colour: &str, width: f64) {
    let width = number(width);
    let attributes = [
        ("d", path),
        ("fill", "none"),
        ("stroke", colour),
        ("stroke-width", &width),
    ];
    w.element("path", &attributes, |_| {});
}

pub(super) fn text(w: &mut Writer, [x, y]: [f64; 2], size: u32, anchor: &str, text: &str) {
    let (x, y, size) = (number(x), number(y), size.to_string());
    let attributes = [
        ("x", x.as_str()),
        ("y", &y),
        ("font-size", &size),
        ("text-anchor", anchor),
    ];
    w.leaf("text", &attributes, text);
}

/// A coordinate with one decimal at most.
pub(super) fn number(value: f64) -> String {
    ((value * 10.0).round() / 10.0).to_string()
}

/// A tick without binary rounding.
pub(super) fn plain(value: f64) -> String {
    ((value * 1e9).round() / 1e9).to_string()
}
