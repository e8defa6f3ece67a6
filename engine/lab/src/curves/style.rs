//! How curves are told apart: by colour, by the shape of their marks, and by dashes.
//!
//! The colours are those of Okabe and Ito 2008, "Color Universal Design", which people with any kind
//! of colour blindness tell apart; their yellow is left out, since it can't be seen on white. No two
//! of the first fourteen curves share both colour and dashes, nor both shape and filling, so that a
//! print in grey can be read too.

/// Black, blue, vermilion, bluish green, reddish purple, orange, sky blue.
const COLOURS: [&str; 7] = [
    "#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
];

/// Outlines around the origin, some ten units wide.
const SHAPES: [&str; 7] = [
    "M-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0 -9 0z", // circle
    "M-4.2 -4.2h8.4v8.4h-8.4z",                      // square
    "M0 -5.6L5 3.8H-5z",                             // triangle
    "M0 -5.8L5.8 0L0 5.8L-5.8 0z",                   // diamond
    "M0 5.6L5 -3.8H-5z",                             // triangle that stands on a corner
    "M-1.6 -5.2h3.2v3.6h3.6v3.2h-3.6v3.6h-3.2v-3.6h-3.6v-3.2h3.6z", // cross
    "M-5.2 0L-2.6 -4.5H2.6L5.2 0L2.6 4.5H-2.6z",     // hexagon
];

/// The look of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    /// Of the line and its marks.
    pub colour: &'static str,
    /// Lengths of dashes and gaps; empty for an unbroken line.
    pub dashes: &'static str,
    /// The outline of a mark, as an SVG path around the origin.
    pub shape: &'static str,
    /// What fills a mark.
    pub fill: &'static str,
}

impl Style {
    /// The look of the n-th curve.
    pub fn of(index: usize) -> Self {
        let colour = COLOURS[index % 7];
        // The second seven pair their colours with other shapes.
        let second = index / 7 % 2 == 1;
        let shape = SHAPES[(index + if second { 3 } else { 0 }) % 7];
        Self {
            colour,
            dashes: if second { "7 3" } else { "" },
            shape,
            fill: if second { "#ffffff" } else { colour },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fourteen_curves_differ_in_colour_and_dashes_and_in_their_marks() {
        let styles: Vec<Style> = (0..14).map(Style::of).collect();
        for (index, a) in styles.iter().enumerate() {
            for b in &styles[..index] {
                assert_ne!((a.colour, a.dashes), (b.colour, b.dashes));
                assert_ne!((a.shape, a.dashes), (b.shape, b.dashes));
            }
        }
    }
}
