//! A target of a frame as a picture file.

use lightbench_assets::images::{ImageError, encode_exr, encode_png};
use lightbench_render::TargetImage;
pub use lightbench_render::inspect::Shown;

use crate::colormap::ColorMap;

/// The bytes of a picture file: of an EXR, where the path ends so, with the values as they are; else
/// of a PNG, with [`Shown::range`] from black to white, or in colours from viridis. One channel alone
/// is grey.
///
/// # Errors
/// A target without texels.
pub fn encode(path: &str, image: &TargetImage, shown: Shown) -> Result<Vec<u8>, ImageError> {
    let single = shown.channel.or((image.channels == 1).then_some(0));
    let picked = image.texels.iter().map(|texel| match single {
        Some(channel) => [texel[channel], texel[channel], texel[channel], 1.0],
        None => *texel,
    });
    if path.ends_with(".exr") {
        let pixels: Vec<f32> = picked.flatten().collect();
        return encode_exr(path, image.width, image.height, &pixels);
    }
    let [low, high] = shown.range;
    let share = |value: f32| ((value - low) / (high - low)).clamp(0.0, 1.0);
    let byte = |value: f32| (share(value) * 255.0).round() as u8;
    let pixels: Vec<u8> = picked
        .flat_map(|[r, g, b, _]| {
            let color = if shown.false_colour {
                ColorMap::Viridis.color(share(r))
            } else {
                [byte(r), byte(g), byte(b)]
            };
            [color[0], color[1], color[2], 255]
        })
        .collect();
    encode_png(path, image.width, image.height, &pixels)
}
