//! Where in a picture the error lies, so that a report can say it in words.

use serde::{Deserialize, Serialize};

use super::colour::luma;
use super::plane::Plane;
use crate::picture::LdrImage;

/// Difference of luma between neighbours that makes an edge of the reference.
const EDGE_CONTRAST: f32 = 0.1;
/// Pixels on each side of an edge that still belong to it: the blur of FLIP at a normal viewing
/// distance moves most of an error by no more than this.
const EDGE_REACH: usize = 2;

/// How the error of a map is spread over the picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorLocation {
    /// Share of the pixels that lie within two pixels of an edge of the reference, 0 to 1.
    pub edge_area: f64,
    /// Share of the sum of the map on those pixels, 0 to 1; 0 without any error.
    pub edge_error: f64,
    /// Share of the sum of the map in each third by third of the picture, row by row from the
    /// top left; all 0 without any error.
    pub thirds: [[f64; 3]; 3],
}

impl ErrorLocation {
    /// Locates the error of a map over its reference, which have the same size.
    pub fn of(map: &Plane, reference: &LdrImage) -> Self {
        let near_edge = near_edges(reference);
        let (mut area, mut on_edges, mut total) = (0_u64, 0.0, 0.0);
        let mut thirds = [[0.0; 3]; 3];
        for (y, row) in map.values.chunks(map.width).enumerate() {
            for (x, &value) in row.iter().enumerate() {
                let value = f64::from(value);
                total += value;
                thirds[3 * y / map.height][3 * x / map.width] += value;
                if near_edge[y * map.width + x] {
                    area += 1;
                    on_edges += value;
                }
            }
        }
        let share = |part: f64| if total > 0.0 { part / total } else { 0.0 };
        Self {
            edge_area: area as f64 / map.values.len() as f64,
            edge_error: share(on_edges),
            thirds: thirds.map(|row| row.map(share)),
        }
    }
}

/// Marks the pixels within [`EDGE_REACH`] of an edge.
fn near_edges(image: &LdrImage) -> Vec<bool> {
    let (width, height) = (image.width as usize, image.height as usize);
    let at = |x: usize, y: usize| luma(image.pixels[y * width + x]);
    let mut near = vec![false; width * height];
    for y in 0..height {
        for x in 0..width {
            let here = at(x, y);
            let right = at((x + 1).min(width - 1), y);
            let below = at(x, (y + 1).min(height - 1));
            if (right - here).abs().max((below - here).abs()) > EDGE_CONTRAST {
                for row in y.saturating_sub(EDGE_REACH)..=(y + EDGE_REACH).min(height - 1) {
                    let from = row * width + x.saturating_sub(EDGE_REACH);
                    let to = row * width + (x + EDGE_REACH).min(width - 1);
                    near[from..=to].fill(true);
                }
            }
        }
    }
    near
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_on_an_edge_is_found_there() {
        let split = LdrImage::from_fn(30, 30, |x, _| if x < 15 { [0; 4] } else { [255; 4] });
        let on_edge = Plane::from_index(30, 30, |i| if i % 30 == 14 { 1.0 } else { 0.0 });
        let found = ErrorLocation::of(&on_edge, &split);
        assert_eq!(found.edge_error, 1.0);
        // Columns 12 to 16 are near the edge that column 14 carries.
        assert!((found.edge_area - 5.0 / 30.0).abs() < 1e-12);
        assert!((found.thirds[0][1] - 1.0 / 3.0).abs() < 1e-6);
        let corner = Plane::from_index(30, 30, |i| if i == 899 { 0.5 } else { 0.0 });
        let found = ErrorLocation::of(&corner, &split);
        assert_eq!((found.edge_error, found.thirds[2][2]), (0.0, 1.0));
        let none = Plane::from_index(1, 1, |_| 0.0);
        let one = LdrImage::from_fn(1, 1, |_, _| [7; 4]);
        assert_eq!(ErrorLocation::of(&none, &one).thirds, [[0.0; 3]; 3]);
    }
}
