//! Textures as the material sampler filters them: repeated, and linear between texels and levels.

use std::sync::Arc;

use glam::{DVec2, DVec4};
use lightbench_assets::Texture;

/// What part of a texture a lookup means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Footprint {
    /// A point: the finest level. Many rays together make the mean.
    Point,
    /// A pixel, by the change of the texture coordinates to the next pixel on the right and to the one
    /// below.
    Pixel(DVec2, DVec2),
}

/// The linear value of a texture.
pub fn sample(texture: &Arc<Texture>, uv: DVec2, footprint: Footprint) -> DVec4 {
    let Footprint::Pixel(right, below) = footprint else {
        return bilinear(texture, 0, uv);
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
    let value = bilinear(texture, finer, uv);
    if share == 0.0 {
        return value;
    }
    value.lerp(bilinear(texture, (finer + 1).min(last), uv), share)
}

fn bilinear(texture: &Texture, level: usize, uv: DVec2) -> DVec4 {
    let (width, height) = texture.level_size(level);
    let (left, right, s) = neighbours(uv.x, width);
    let (top, bottom, t) = neighbours(uv.y, height);
    let texel = |x, y| texture.pixel(level, x, y).unwrap_or_default();
    let upper = texel(left, top).lerp(texel(right, top), s);
    let lower = texel(left, bottom).lerp(texel(right, bottom), s);
    upper.lerp(lower, t).as_dvec4()
}

/// The two texels along an axis between whose middles a coordinate lies, and the share of the second.
fn neighbours(coordinate: f64, size: u32) -> (u32, u32, f32) {
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
    use glam::Vec4;
    use lightbench_assets::TextureFormat;

    fn texture(width: u32, height: u32) -> Arc<Texture> {
        let value = |i: u32| Vec4::new((i % width) as f32, (i / width) as f32, 0.25, 1.0);
        let pixels: Vec<Vec4> = (0..width * height).map(value).collect();
        let format = TextureFormat::Rgba16Float;
        Arc::new(Texture::from_linear("", width, height, format, &pixels).unwrap())
    }

    fn at(texture: &Arc<Texture>, u: f64, v: f64) -> DVec4 {
        sample(texture, DVec2::new(u, v), Footprint::Point)
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
            sample(
                &texture,
                DVec2::splat(0.3),
                Footprint::Pixel(step, DVec2::ZERO),
            )
        };
        assert_eq!(wide(8.0), DVec4::new(3.5, 3.5, 0.25, 1.0));
        assert_eq!(wide(1000.0), wide(8.0));
        assert_eq!(wide(0.0), at(&texture, 0.3, 0.3));
        let between = wide(4.0 * 0.5_f64.sqrt());
        assert!((between - (wide(2.0) + wide(4.0)) * 0.5).length() < 1e-6);
    }
}
