//! A base colour and its normal map side by side in memory.
//!
//! A path reads one point of both, anywhere in them, and mostly waits for memory. In blocks of 4 by 4
//! texels with both values beside each other, it waits for less than half as many lines of the cache.

use glam::{DVec2, DVec3, DVec4, Vec3, Vec4};
use lightbench_assets::TextureFormat;

use super::texture::{Filtered, neighbours};

/// Texels along each side of a block.
const BLOCK: u32 = 4;

/// The finest levels of both.
#[derive(Clone, Debug)]
pub struct Joined {
    width: u32,
    height: u32,
    blocks_across: u32,
    /// Red, green, blue and alpha of the colour, then the normal.
    texels: Vec<[u8; 8]>,
    /// The linear value of each byte of a colour, and of a normal.
    colors: [f32; 256],
    normals: [f32; 256],
}

impl Joined {
    /// None where the two differ in size or do not have eight bits.
    pub fn new(color: &Filtered, normals: &Filtered) -> Option<Self> {
        let (first, second) = (color.texture(), normals.texture());
        let (width, height) = (first.width, first.height);
        let alike = (second.width, second.height) == (width, height);
        let floats = |format| format == TextureFormat::Rgba16Float;
        if !alike || floats(first.format) || floats(second.format) {
            return None;
        }
        let (first, _) = first.mips.first()?.as_chunks::<4>();
        let (second, _) = second.mips.first()?.as_chunks::<4>();
        let blocks_across = width.div_ceil(BLOCK);
        let blocks_down = height.div_ceil(BLOCK);
        let count = (blocks_across * blocks_down * BLOCK * BLOCK) as usize;
        let mut joined = Self {
            width,
            height,
            blocks_across,
            texels: vec![[0; 8]; count],
            colors: *color.values(),
            normals: *normals.values(),
        };
        for y in 0..height {
            for x in 0..width {
                let from = y as usize * width as usize + x as usize;
                let [r, g, b, a] = *first.get(from)?;
                let [nx, ny, nz, _] = *second.get(from)?;
                let to = joined.place(x, y);
                joined.texels[to] = [r, g, b, a, nx, ny, nz, 0];
            }
        }
        Some(joined)
    }

    /// Colour and encoded normal at a place, bilinear.
    pub fn sample(&self, uv: DVec2) -> (DVec4, DVec3) {
        let (left, right, s) = neighbours(uv.x, self.width);
        let (top, bottom, t) = neighbours(uv.y, self.height);
        let (upper, upper_normal) = self.between(left, right, top, s);
        let (lower, lower_normal) = self.between(left, right, bottom, s);
        (
            upper.lerp(lower, t).as_dvec4(),
            upper_normal.lerp(lower_normal, t).as_dvec3(),
        )
    }

    fn between(&self, left: u32, right: u32, y: u32, share: f32) -> (Vec4, Vec3) {
        let (color, normal) = self.texel(left, y);
        let (other, other_normal) = self.texel(right, y);
        (color.lerp(other, share), normal.lerp(other_normal, share))
    }

    fn texel(&self, x: u32, y: u32) -> (Vec4, Vec3) {
        let [r, g, b, a, nx, ny, nz, _] = self.texels[self.place(x, y)];
        let color = |byte: u8| self.colors[usize::from(byte)];
        let normal = |byte: u8| self.normals[usize::from(byte)];
        (
            Vec4::new(color(r), color(g), color(b), f32::from(a) / 255.0),
            Vec3::new(normal(nx), normal(ny), normal(nz)),
        )
    }

    fn place(&self, x: u32, y: u32) -> usize {
        let block = y / BLOCK * self.blocks_across + x / BLOCK;
        (block * BLOCK * BLOCK + y % BLOCK * BLOCK + x % BLOCK) as usize
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use std::sync::Arc;

    use lightbench_assets::Texture;

    use super::*;
    use crate::tracer::texture::Footprint;

    fn texture(width: u32, height: u32, format: TextureFormat, seed: u32) -> Filtered {
        let bytes = (0..width * height * 4).map(|i| (i.wrapping_mul(seed) >> 9) as u8);
        let texture = Texture::new("", width, height, format, bytes.collect());
        Filtered::new(&Arc::new(texture.unwrap()))
    }

    #[test]
    fn both_values_are_those_of_the_textures_themselves() {
        use TextureFormat::{Rgba8Linear, Rgba8Srgb};
        for (width, height) in [(8, 8), (13, 5), (1, 3)] {
            let color = texture(width, height, Rgba8Srgb, 2_654_435_761);
            let normals = texture(width, height, Rgba8Linear, 40_503_001);
            let joined = Joined::new(&color, &normals).unwrap();
            for step in 0..200 {
                let uv = DVec2::new(f64::from(step) * 0.137, f64::from(step) * -0.291);
                let (found, normal) = joined.sample(uv);
                let expected = color.sample(uv, Footprint::Point);
                let encoded = normals.sample(uv, Footprint::Point).truncate();
                assert!((found - expected).length() < 1e-6, "{uv}");
                assert!((normal - encoded).length() < 1e-6, "{uv}");
            }
        }
        let other = texture(4, 8, Rgba8Linear, 1);
        assert!(Joined::new(&texture(8, 8, Rgba8Srgb, 1), &other).is_none());
    }
}
