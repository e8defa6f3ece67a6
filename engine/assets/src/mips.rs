//! Mip levels, made in linear light.

use glam::Vec4;

use crate::TextureFormat;
use crate::rows::for_each_row;

/// All levels from the first. Between levels the pixels stay floats, so that
/// rounding does not add up.
pub(crate) fn mip_chain(
    width: usize,
    height: usize,
    format: TextureFormat,
    first: Vec<u8>,
) -> Vec<Vec<u8>> {
    let size = format.bytes_per_pixel();
    let weigh = format == TextureFormat::Rgba8Srgb;
    let mut mips = Vec::with_capacity(width.max(height).ilog2() as usize + 1);
    let (mut width, mut height) = (width, height);
    let mut level: Vec<Vec4> = Vec::new();
    mips.push(first);
    while width > 1 || height > 1 {
        level = if mips.len() == 1 {
            let bytes = &mips[0];
            halve(width, height, |at| {
                let pixel = format.decode(&bytes[at * size..(at + 1) * size]);
                if weigh { weighed(pixel) } else { pixel }
            })
        } else {
            halve(width, height, |at| level[at])
        };
        (width, height) = ((width / 2).max(1), (height / 2).max(1));
        mips.push(encode_level(width, format, level.len(), |at| {
            if weigh {
                unweighed(level[at])
            } else {
                level[at]
            }
        }));
    }
    mips
}

/// A little weight for transparent pixels, which alone decide the colour where
/// all are transparent.
const LEAST_WEIGHT: f32 = 1.0 / 4096.0;

fn weighed(pixel: Vec4) -> Vec4 {
    (pixel * (pixel.w + LEAST_WEIGHT)).with_w(pixel.w)
}

fn unweighed(pixel: Vec4) -> Vec4 {
    (pixel / (pixel.w + LEAST_WEIGHT)).with_w(pixel.w)
}

/// The bytes of one level from its linear pixels.
pub(crate) fn encode_level(
    width: usize,
    format: TextureFormat,
    count: usize,
    pixel: impl Fn(usize) -> Vec4 + Sync,
) -> Vec<u8> {
    let size = format.bytes_per_pixel();
    let mut bytes = vec![0; count * size];
    for_each_row(&mut bytes, width * size, |y, row| {
        for (x, bytes) in row.chunks_exact_mut(size).enumerate() {
            format.encode(pixel(y * width + x), bytes);
        }
    });
    bytes
}

/// The next smaller level, by a box filter over exactly the area that each new
/// pixel covers.
fn halve(width: usize, height: usize, pixel: impl Fn(usize) -> Vec4 + Sync) -> Vec<Vec4> {
    let (new_width, new_height) = ((width / 2).max(1), (height / 2).max(1));
    let mut halved = vec![Vec4::ZERO; new_width * new_height];
    for_each_row(&mut halved, new_width, |new_y, row| {
        let (y, weights_y) = taps(new_y, height);
        for (new_x, out) in row.iter_mut().enumerate() {
            let (x, weights_x) = taps(new_x, width);
            for (dy, weight_y) in weights_y.into_iter().enumerate() {
                for (dx, weight_x) in weights_x.into_iter().enumerate() {
                    if weight_x * weight_y > 0.0 {
                        *out += pixel((y + dy) * width + x + dx) * (weight_x * weight_y);
                    }
                }
            }
        }
    });
    halved
}

/// First source pixel and the weights of up to three, for one new pixel along
/// one axis. An odd size 2n + 1 makes n pixels, each covering 2 + 1/n old ones
/// (Guthe and Heckbert, "Non-power-of-two mipmap creation", NVIDIA, 2005), so that
/// the mean stays the same at every size.
fn taps(new: usize, size: usize) -> (usize, [f32; 3]) {
    if size == 1 {
        return (0, [1.0, 0.0, 0.0]);
    }
    if size.is_multiple_of(2) {
        return (2 * new, [0.5, 0.5, 0.0]);
    }
    let half = (size / 2) as f32;
    let (all, new_f) = (size as f32, new as f32);
    (
        2 * new,
        [(half - new_f) / all, half / all, (new_f + 1.0) / all],
    )
}
