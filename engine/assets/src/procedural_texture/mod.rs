//! Pictures from parameters: stone, brick, tiles, cloth, plaster and a checker.
//!
//! Every picture can be laid side by side without a seam, and the same
//! parameters always give the same bytes on one system (between systems, sines
//! may differ in their last bit). Colours are linear
//! Rec. 709. Sizes are in pixels a side, brought into the range from 1 to
//! [`MAX_TEXTURE_SIZE`]; counts are at least 1.
//!
//! What is built from pieces (bricks, tiles) comes as a [`Surface`], whose
//! normal map belongs to its colours.

mod cloth;
mod masonry;
mod noise;
mod stone;

use glam::{Vec2, Vec3, Vec4};

use crate::rows::for_each_row;
use crate::{MAX_TEXTURE_SIZE, Texture, TextureFormat};

pub use cloth::Weave;
pub use masonry::{Brick, Tiles};
pub use noise::Noise;
pub use stone::{Marble, Plaster, Stone};

/// Colours and the matching normal map.
#[derive(Clone, Debug)]
pub struct Surface {
    /// For [`Material::base_color_texture`](crate::Material).
    pub base_color: Texture,
    /// For [`Material::normal_texture`](crate::Material).
    pub normal: Texture,
}

/// Squares of two colours, `squares` (made even) along each side.
#[must_use]
pub fn checker(size: u32, squares: u32, colors: [Vec3; 2]) -> Texture {
    let squares = squares.clamp(1, size.max(1)).next_multiple_of(2);
    paint("checker", size, |at| {
        let cell = (at * squares as f32).as_uvec2();
        colors[(cell.x + cell.y) as usize % 2]
    })
}

/// Paints a square picture with a function of the place, 0 to 1 to the right
/// and down, that gives a linear colour.
pub fn paint(name: &str, size: u32, color: impl Fn(Vec2) -> Vec3 + Sync) -> Texture {
    let size = checked(size);
    let pixels = pixels(size, |at| color(at).extend(1.0));
    texture(name, TextureFormat::Rgba8Srgb, size, size, &pixels)
}

/// Makes a normal map from a function that gives the height at a place, in
/// units of the picture's side.
pub fn normal_map(name: &str, size: u32, height: impl Fn(Vec2) -> f32 + Sync) -> Texture {
    let size = checked(size);
    let heights = pixels(size, height);
    normal_map_from_heights(name, size, size, &heights, size as f32)
}

/// Makes a normal map from heights, rows from the top, that are multiplied by
/// `strength` to be in pixels. The picture repeats at its edges; green is up.
pub(crate) fn normal_map_from_heights(
    name: &str,
    width: u32,
    height: u32,
    heights: &[f32],
    strength: f32,
) -> Texture {
    let (columns, rows) = (width as usize, height as usize);
    let at = |x: usize, y: usize| heights[y % rows * columns + x % columns];
    let mut normals = vec![Vec4::ZERO; heights.len()];
    for_each_row(&mut normals, columns, |y, row| {
        for (x, normal) in row.iter_mut().enumerate() {
            // Central differences, around the edges of the picture.
            let to_right = at(x + 1, y) - at(x + columns - 1, y);
            let up = at(x, y + rows - 1) - at(x, y + 1);
            let slope = Vec2::new(to_right, up) * (0.5 * strength);
            let direction = Vec3::new(-slope.x, -slope.y, 1.0).normalize();
            *normal = (direction * 0.5 + 0.5).extend(1.0);
        }
    });
    texture(name, TextureFormat::Rgba8Linear, width, height, &normals)
}

fn checked(size: u32) -> u32 {
    size.clamp(1, MAX_TEXTURE_SIZE)
}

/// Evaluates a function at the middle of each pixel, rows in parallel.
fn pixels<T: Copy + Default + Send>(size: u32, value: impl Fn(Vec2) -> T + Sync) -> Vec<T> {
    let side = checked(size) as usize;
    let mut pixels = vec![T::default(); side * side];
    for_each_row(&mut pixels, side, |y, row| {
        for (x, pixel) in row.iter_mut().enumerate() {
            *pixel = value((Vec2::new(x as f32, y as f32) + 0.5) / side as f32);
        }
    });
    pixels
}

fn texture(name: &str, format: TextureFormat, width: u32, height: u32, pixels: &[Vec4]) -> Texture {
    // The size is in range and the count right, so that this can't fail.
    Texture::from_linear(name, width, height, format, pixels)
        .unwrap_or_else(|_| Texture::placeholder())
}

/// 0 below `from`, 1 above `to`, a smooth step between (in either order).
fn smooth(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests;
