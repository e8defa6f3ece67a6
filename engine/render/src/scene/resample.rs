//! Textures at another size, for scenes with more sizes than there are buckets.

use lightbench_assets::Texture;

/// A texture at another size: bilinear, from the level whose size is just above.
pub fn resample(texture: &Texture, width: u32, height: u32) -> Option<Texture> {
    let fits = |level: &usize| {
        let (w, h) = texture.level_size(*level);
        w >= width && h >= height
    };
    let level = (0..texture.mips.len()).rev().find(fits).unwrap_or(0);
    let (from_width, from_height) = texture.level_size(level);
    let texel = |x: i64, y: i64| {
        // Materials repeat, so the texel beyond the edge is the one on the other side.
        let x = x.rem_euclid(i64::from(from_width)) as u32;
        let y = y.rem_euclid(i64::from(from_height)) as u32;
        texture.pixel(level, x, y).unwrap_or_default()
    };
    let mut pixels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        for x in 0..width {
            let u = (x as f32 + 0.5) / width as f32 * from_width as f32 - 0.5;
            let v = (y as f32 + 0.5) / height as f32 * from_height as f32 - 0.5;
            let (left, top) = (u.floor(), v.floor());
            let (s, t) = (u - left, v - top);
            let (left, top) = (left as i64, top as i64);
            let upper = texel(left, top).lerp(texel(left + 1, top), s);
            let lower = texel(left, top + 1).lerp(texel(left + 1, top + 1), s);
            pixels.push(upper.lerp(lower, t));
        }
    }
    Texture::from_linear(
        texture.name.as_str(),
        width,
        height,
        texture.format,
        &pixels,
    )
    .ok()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use glam::Vec4;
    use lightbench_assets::TextureFormat;

    #[test]
    fn resampling_keeps_a_plain_colour_and_the_mean_of_a_ramp() {
        let pixels = [Vec4::new(0.5, 0.25, 1.0, 1.0); 15];
        let format = TextureFormat::Rgba16Float;
        let texture = Texture::from_linear("plain", 5, 3, format, &pixels).unwrap();
        let fitted = resample(&texture, 8, 8).unwrap();
        let pixel = fitted.pixel(0, 7, 3).unwrap();
        assert!((pixel - Vec4::new(0.5, 0.25, 1.0, 1.0)).length() < 1e-3);
    }
}
