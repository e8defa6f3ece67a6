//! Textures as the material sampler filters them: repeated, and linear between texels and levels.

use std::sync::Arc;

use glam::{DVec2, DVec4, Vec4};
use half::f16;
use lightbench_assets::color::decode_srgb8;
use lightbench_assets::{Texture, TextureFormat};

/// What part of a texture a lookup means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Footprint {
    /// A point: the finest level. Many rays together make the mean.
    Point,
    /// A pixel, by the change of the texture coordinates to the next pixel on the right and to the one
    /// below.
    Pixel(DVec2, DVec2),
}

/// A texture with what its bytes stand for at hand.
#[derive(Clone, Debug)]
pub struct Filtered {
    texture: Arc<Texture>,
    /// The linear value of each byte of a colour.
    values: [f32; 256],
}

impl Filtered {
    /// A texture to be looked up many times.
    pub fn new(texture: &Arc<Texture>) -> Self {
        let linear = |byte: usize| byte as f32 / 255.0;
        Self {
            texture: texture.clone(),
            values: match texture.format {
                TextureFormat::Rgba8Srgb => std::array::from_fn(|byte| decode_srgb8(byte as u8)),
                TextureFormat::Rgba8Linear | TextureFormat::Rgba16Float => {
                    std::array::from_fn(linear)
                }
            },
        }
    }

    /// The texture itself.
    pub fn texture(&self) -> &Texture {
        &self.texture
    }

    /// The linear value of each byte of a colour.
    pub fn values(&self) -> &[f32; 256] {
        &self.values
    }

    /// The linear value at a place.
    pub fn sample(&self, uv: DVec2, footprint: Footprint) -> DVec4 {
        let texture = &self.texture;
        let Footprint::Pixel(right, below) = footprint else {
            return self.bilinear(0, uv);
        };
        let size = DVec2::new(texture.width.into(), texture.height.into());
        let longest = (right * size)
            .length_squared()
            .max((below * size).length_squared());
        let last = texture.mips.len().saturating_sub(1);
        // Without a change the logarithm is infinite, and the level the finest.
        let level = (0.5 * longest.log2()).clamp(0.0, last as f64);
        let finer = level as usize;
        let share = level - finer as f64;
        let value = self.bilinear(finer, uv);
        if share == 0.0 {
            return value;
        }
        value.lerp(self.bilinear((finer + 1).min(last), uv), share)
    }

    fn bilinear(&self, level: usize, uv: DVec2) -> DVec4 {
        let (width, height) = self.texture.level_size(level);
        let Some(bytes) = self.texture.mips.get(level) else {
            return DVec4::ZERO;
        };
        let (left, right, s) = neighbours(uv.x, width);
        let (top, bottom, t) = neighbours(uv.y, height);
        let texel = |x: u32, y: u32| self.texel(bytes, y as usize * width as usize + x as usize);
        let upper = texel(left, top).lerp(texel(right, top), s);
        let lower = texel(left, bottom).lerp(texel(right, bottom), s);
        upper.lerp(lower, t).as_dvec4()
    }

    /// The linear value of a texel of a level.
    fn texel(&self, bytes: &[u8], index: usize) -> Vec4 {
        match self.texture.format {
            TextureFormat::Rgba8Srgb | TextureFormat::Rgba8Linear => {
                let (texels, _) = bytes.as_chunks::<4>();
                let Some(&[red, green, blue, alpha]) = texels.get(index) else {
                    return Vec4::ZERO;
                };
                let value = |byte: u8| self.values[usize::from(byte)];
                let alpha = f32::from(alpha) / 255.0;
                Vec4::new(value(red), value(green), value(blue), alpha)
            }
            TextureFormat::Rgba16Float => {
                let (texels, _) = bytes.as_chunks::<8>();
                let Some(texel) = texels.get(index) else {
                    return Vec4::ZERO;
                };
                let value = |at: usize| f16::from_le_bytes([texel[at], texel[at + 1]]).to_f32();
                Vec4::from_array([0, 2, 4, 6].map(value))
            }
        }
    }
}

/// The two texels along an axis between whose middles a coordinate lies, and the share of the second.
pub fn neighbours(coordinate: f64, size: u32) -> (u32, u32, f32) {
    // A coordinate that is infinite or no number has no place.
    let coordinate = if coordinate.is_finite() {
        coordinate
    } else {
        0.0
    };
    let wrapped = coordinate - coordinate.floor();
    let place = wrapped * f64::from(size) - 0.5;
    let first = place.floor();
    let share = (place - first) as f32;
    let last = size - 1;
    match first < 0.0 {
        true => (last, 0, share),
        false => {
            let first = (first as u32).min(last);
            (first, if first == last { 0 } else { first + 1 }, share)
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn texture(width: u32, height: u32) -> Filtered {
        let value = |i: u32| Vec4::new((i % width) as f32, (i / width) as f32, 0.25, 1.0);
        let pixels: Vec<Vec4> = (0..width * height).map(value).collect();
        let format = TextureFormat::Rgba16Float;
        let texture = Texture::from_linear("", width, height, format, &pixels).unwrap();
        Filtered::new(&Arc::new(texture))
    }

    fn at(texture: &Filtered, u: f64, v: f64) -> DVec4 {
        texture.sample(DVec2::new(u, v), Footprint::Point)
    }

    #[test]
    fn middles_of_texels_are_exact_and_what_lies_between_is_linear() {
        let texture = texture(4, 2);
        assert_eq!(at(&texture, 0.375, 0.25), DVec4::new(1.0, 0.0, 0.25, 1.0));
        assert_eq!(at(&texture, 0.5, 0.5), DVec4::new(1.5, 0.5, 0.25, 1.0));
    }

    #[test]
    fn edges_meet_the_other_side_and_coordinates_repeat() {
        let texture = texture(4, 2);
        assert_eq!(
            at(&texture, 0.0, 0.25).x,
            1.5,
            "between texel 3 and texel 0"
        );
        assert_eq!(at(&texture, 1.0, 0.25).x, 1.5);
        assert_eq!(at(&texture, -2.625, 5.25), at(&texture, 0.375, 0.25));
        assert!(at(&texture, f64::NAN, 0.0).x.is_finite());
    }

    #[test]
    fn a_wide_footprint_sees_the_mean_and_one_between_two_levels_their_mixture() {
        let texture = texture(8, 8);
        let wide = |texels: f64| {
            let step = DVec2::new(texels / 8.0, 0.0);
            texture.sample(DVec2::splat(0.3), Footprint::Pixel(step, DVec2::ZERO))
        };
        assert_eq!(wide(8.0), DVec4::new(3.5, 3.5, 0.25, 1.0));
        assert_eq!(wide(1000.0), wide(8.0));
        assert_eq!(wide(0.0), at(&texture, 0.3, 0.3));
        let between = wide(4.0 * 0.5_f64.sqrt());
        assert!((between - (wide(2.0) + wide(4.0)) * 0.5).length() < 1e-6);
    }

    #[test]
    fn bytes_mean_what_the_texture_says() {
        for format in [TextureFormat::Rgba8Srgb, TextureFormat::Rgba8Linear] {
            let bytes = vec![0, 10, 128, 200, 255, 3, 77, 255];
            let texture = Arc::new(Texture::new("", 2, 1, format, bytes).unwrap());
            let filtered = Filtered::new(&texture);
            for x in 0..2 {
                let expected = texture.pixel(0, x, 0).unwrap();
                let found = at(&filtered, (f64::from(x) + 0.5) / 2.0, 0.5);
                assert!((found.as_vec4() - expected).abs().max_element() < 1e-6);
            }
        }
    }
}
