//! Pictures of error maps.

use rayon::prelude::*;

use crate::colormap::ColorMap;
use crate::metrics::Plane;
use crate::picture::LdrImage;

/// Space between map and legend, and around the legend, in pixels.
const GAP: u32 = 8;
/// Height of the legend's bar in pixels.
const BAR_HEIGHT: u32 = 10;

/// Paints a map of values in 0 to 1, one pixel a value, without a legend. `scale` is the value that
/// gets the last colour; greater ones get it too.
pub fn heat_map(map: &Plane, colors: ColorMap, scale: f32) -> LdrImage {
    let pixels = map
        .values
        .par_iter()
        .map(|&v| {
            let [r, g, b] = colors.color(v / scale);
            [r, g, b, 255]
        })
        .collect();
    LdrImage {
        width: map.width as u32,
        height: map.height as u32,
        pixels,
    }
}

/// The scale that shows the most of maps whose largest value is `largest`, among few round ones, so
/// that two reports mostly have the same.
pub fn round_scale(largest: f32) -> f32 {
    let scales = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5];
    scales
        .into_iter()
        .find(|scale| largest <= *scale)
        .unwrap_or(1.0)
}

/// Paints a map with a legend below it: a bar from 0 at the left to `scale` at the right with a tick at
/// each tenth, and numbers at the ends and in the middle. For files that are looked at alone. Maps
/// narrower than 64 pixels get no legend: it could not be read.
pub fn heat_map_with_legend(map: &Plane, colors: ColorMap, scale: f32) -> LdrImage {
    let plain = heat_map(map, colors, scale);
    if plain.width < 64 {
        return plain;
    }
    let legend_height = GAP + BAR_HEIGHT + 4 + DIGIT_HEIGHT + GAP;
    let (width, height) = (plain.width, plain.height + legend_height);
    let mut pixels = plain.pixels;
    pixels.resize((width * height) as usize, [255; 4]);
    let mut canvas = LdrImage {
        width,
        height,
        pixels,
    };
    let (left, right) = (GAP, width - GAP - 1);
    let top = plain.height + GAP;
    for x in left..=right {
        let value = (x - left) as f32 / (right - left) as f32;
        let [r, g, b] = colors.color(value);
        for y in top..top + BAR_HEIGHT {
            canvas.pixels[(y * width + x) as usize] = [r, g, b, 255];
        }
    }
    for tenth in 0..=10 {
        let x = left + (right - left) * tenth / 10;
        for y in top + BAR_HEIGHT..top + BAR_HEIGHT + 3 {
            canvas.pixels[(y * width + x) as usize] = INK;
        }
    }
    let baseline = top + BAR_HEIGHT + 4;
    let (half, whole) = (short(scale / 2.0), short(scale));
    write_number(&mut canvas, left, baseline, "0");
    let middle = (left + right) / 2 - text_width(&half) / 2;
    write_number(&mut canvas, middle, baseline, &half);
    let last = right + 1 - text_width(&whole);
    write_number(&mut canvas, last, baseline, &whole);
    canvas
}

const INK: [u8; 4] = [0, 0, 0, 255];
const DIGIT_WIDTH: u32 = 3;
const DIGIT_HEIGHT: u32 = 5;

/// A number in few characters.
fn short(number: f32) -> String {
    let text = format!("{number:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Three by five dots for the characters of numbers, one row a number, high bit left.
fn glyph(character: char) -> [u8; DIGIT_HEIGHT as usize] {
    match character {
        '0' => [0b111, 0b101, 0b101, 0b101, 0b111],
        '1' => [0b010, 0b110, 0b010, 0b010, 0b111],
        '2' => [0b111, 0b001, 0b111, 0b100, 0b111],
        '3' => [0b111, 0b001, 0b111, 0b001, 0b111],
        '4' => [0b101, 0b101, 0b111, 0b001, 0b001],
        '5' => [0b111, 0b100, 0b111, 0b001, 0b111],
        '6' => [0b111, 0b100, 0b111, 0b101, 0b111],
        '7' => [0b111, 0b001, 0b010, 0b010, 0b010],
        '8' => [0b111, 0b101, 0b111, 0b101, 0b111],
        '9' => [0b111, 0b101, 0b111, 0b001, 0b111],
        _ => [0b000, 0b000, 0b000, 0b000, 0b010],
    }
}

fn text_width(text: &str) -> u32 {
    text.len() as u32 * (DIGIT_WIDTH + 1) - 1
}

fn write_number(canvas: &mut LdrImage, left: u32, top: u32, text: &str) {
    for (place, character) in text.chars().enumerate() {
        let x0 = left + place as u32 * (DIGIT_WIDTH + 1);
        for (row, bits) in glyph(character).into_iter().enumerate() {
            for column in 0..DIGIT_WIDTH {
                if bits >> (DIGIT_WIDTH - 1 - column) & 1 == 1 {
                    let index = (top + row as u32) * canvas.width + x0 + column;
                    canvas.pixels[index as usize] = INK;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_is_round_and_holds_the_largest_value() {
        assert_eq!(round_scale(0.0), 0.01);
        assert_eq!(round_scale(0.036), 0.05);
        assert_eq!(round_scale(0.05), 0.05);
        assert_eq!(round_scale(0.51), 1.0);
        let map = Plane {
            width: 1,
            height: 1,
            values: vec![0.05],
        };
        let scaled = heat_map(&map, ColorMap::Magma, 0.05);
        assert_eq!(scaled.pixels[0][..3], ColorMap::Magma.color(1.0));
    }

    #[test]
    fn legend_runs_from_the_first_to_the_last_colour() {
        let map = Plane::from_index(100, 20, |i| (i % 100) as f32 / 99.0);
        let image = heat_map_with_legend(&map, ColorMap::Viridis, 1.0);
        assert_eq!(
            (image.width, image.pixels.len()),
            (100, (100 * image.height) as usize)
        );
        let at = |x: u32, y: u32| image.pixels[(y * 100 + x) as usize];
        assert_eq!(at(0, 0), at(GAP, 20 + GAP));
        assert_eq!(at(99, 0), at(91, 20 + GAP));
        assert_eq!(at(0, 21), [255; 4]);
        assert_eq!(
            &image.pixels[..2000],
            &heat_map(&map, ColorMap::Viridis, 1.0).pixels[..]
        );
    }

    #[test]
    fn the_legend_says_the_scale() {
        assert_eq!(
            (short(0.5), short(12.0)),
            ("0.5".to_owned(), "12".to_owned())
        );
        let map = Plane::from_index(80, 1, |i| i as f32);
        let ink = |scale: f32| {
            let image = heat_map_with_legend(&map, ColorMap::Viridis, scale);
            image.pixels.iter().filter(|pixel| **pixel == INK).count()
        };
        // 0, 4 and 8 against 0, 0.5 and 1: dots of the glyphs counted by hand; the ticks are equal.
        let ticks = 11 * 3;
        assert_eq!(ink(8.0), ticks + 12 + 9 + 13);
        assert_eq!(ink(1.0), ticks + 12 + (12 + 1 + 11) + 8);
    }

    #[test]
    fn small_maps_have_no_legend() {
        let map = Plane::from_index(1, 1, |_| 0.0);
        assert_eq!(
            heat_map_with_legend(&map, ColorMap::Magma, 1.0).pixels,
            [[0, 0, 4, 255]]
        );
    }
}
