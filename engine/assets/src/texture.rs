//! Pictures with all their mip levels.

use glam::Vec4;
use half::f16;
use thiserror::Error;

use crate::color::{decode_srgb8, encode_srgb8, encode_unorm8};
use crate::mips::{encode_level, mip_chain};

/// The largest width or height, in pixels: what every WebGPU device offers.
pub const MAX_TEXTURE_SIZE: u32 = 8192;

/// Index of a texture in [`Assets`](crate::Assets).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TextureId(pub u32);

impl TextureId {
    /// The black and magenta checker that stands for a picture that could not
    /// be loaded.
    pub const PLACEHOLDER: Self = Self(0);
}

/// What the bytes of a texture mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextureFormat {
    /// Four bytes; red, green and blue sRGB-encoded, alpha linear. Colours.
    Rgba8Srgb,
    /// Four bytes, all linear. Normal maps and other data.
    Rgba8Linear,
    /// Four half floats, linear, little-endian. High dynamic range.
    Rgba16Float,
}

impl TextureFormat {
    /// Bytes of one pixel.
    #[must_use]
    pub fn bytes_per_pixel(self) -> usize {
        match self {
            Self::Rgba8Srgb | Self::Rgba8Linear => 4,
            Self::Rgba16Float => 8,
        }
    }

    /// The linear value of one pixel's bytes.
    pub(crate) fn decode(self, bytes: &[u8]) -> Vec4 {
        match self {
            Self::Rgba8Srgb => Vec4::new(
                decode_srgb8(bytes[0]),
                decode_srgb8(bytes[1]),
                decode_srgb8(bytes[2]),
                f32::from(bytes[3]) / 255.0,
            ),
            Self::Rgba8Linear => {
                Vec4::from_array([0, 1, 2, 3].map(|i| f32::from(bytes[i]) / 255.0))
            }
            Self::Rgba16Float => Vec4::from_array(
                [0, 2, 4, 6].map(|i| f16::from_le_bytes([bytes[i], bytes[i + 1]]).to_f32()),
            ),
        }
    }

    /// Writes one linear pixel, clamped to what the format holds. A value that
    /// is no number becomes 0.
    pub(crate) fn encode(self, pixel: Vec4, bytes: &mut [u8]) {
        match self {
            Self::Rgba8Srgb => bytes.copy_from_slice(&[
                encode_srgb8(pixel.x),
                encode_srgb8(pixel.y),
                encode_srgb8(pixel.z),
                encode_unorm8(pixel.w),
            ]),
            Self::Rgba8Linear => bytes.copy_from_slice(&pixel.to_array().map(encode_unorm8)),
            Self::Rgba16Float => {
                let limit = f16::MAX.to_f32();
                for (bytes, value) in bytes.chunks_exact_mut(2).zip(pixel.to_array()) {
                    let value = if value.is_nan() {
                        0.0
                    } else {
                        value.clamp(-limit, limit)
                    };
                    bytes.copy_from_slice(&f16::from_f32(value).to_le_bytes());
                }
            }
        }
    }
}

/// Why a picture is no texture.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum TextureError {
    /// Zero or more than [`MAX_TEXTURE_SIZE`] pixels a side.
    #[error(
        "picture `{name}` is {width} x {height} pixels; each side must have 1 to {MAX_TEXTURE_SIZE}"
    )]
    Size {
        /// The picture.
        name: String,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// The data does not fill the picture.
    #[error("picture `{name}` needs {expected} {unit} and has {found}")]
    Length {
        /// The picture.
        name: String,
        /// What is counted.
        unit: &'static str,
        /// How many the size and format ask for.
        expected: usize,
        /// How many came.
        found: usize,
    },
}

/// A picture and its mip levels, down to one pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Name in the scene. Need not be unique.
    pub name: String,
    /// Pixels across, level 0.
    pub width: u32,
    /// Pixels down, level 0.
    pub height: u32,
    /// What the bytes mean.
    pub format: TextureFormat,
    /// Level by level, rows from the top, without padding. Level `n` has
    /// `max(1, width >> n)` by `max(1, height >> n)` pixels.
    pub mips: Vec<Vec<u8>>,
}

impl Texture {
    /// A texture from the bytes of its first level.
    ///
    /// The other levels are averages in linear light. In
    /// [`TextureFormat::Rgba8Srgb`] each colour counts as much as its alpha,
    /// so that what lies hidden under transparent pixels does not bleed out.
    ///
    /// # Errors
    /// A size out of range, or data of the wrong length.
    pub fn new(
        name: impl Into<String>,
        width: u32,
        height: u32,
        format: TextureFormat,
        pixels: Vec<u8>,
    ) -> Result<Self, TextureError> {
        let name = name.into();
        let count = checked_pixel_count(&name, width, height)?;
        let expected = count * format.bytes_per_pixel();
        if pixels.len() != expected {
            return Err(TextureError::Length {
                name,
                unit: "bytes",
                expected,
                found: pixels.len(),
            });
        }
        let mips = mip_chain(width as usize, height as usize, format, pixels);
        Ok(Self {
            name,
            width,
            height,
            format,
            mips,
        })
    }

    /// A texture from linear pixels, rows from the top.
    ///
    /// # Errors
    /// As [`Texture::new`].
    pub fn from_linear(
        name: impl Into<String>,
        width: u32,
        height: u32,
        format: TextureFormat,
        pixels: &[Vec4],
    ) -> Result<Self, TextureError> {
        let name = name.into();
        let expected = checked_pixel_count(&name, width, height)?;
        if pixels.len() != expected {
            return Err(TextureError::Length {
                name,
                unit: "pixels",
                expected,
                found: pixels.len(),
            });
        }
        Self::new(
            name,
            width,
            height,
            format,
            encode_level(width as usize, format, expected, |at| pixels[at]),
        )
    }

    /// Black and magenta squares: "this picture is missing".
    #[must_use]
    pub fn placeholder() -> Self {
        const SIZE: u32 = 64;
        const SQUARE: u32 = 8;
        let format = TextureFormat::Rgba8Srgb;
        let pixels = (0..SIZE * SIZE)
            .flat_map(|i| {
                let odd = (i % SIZE / SQUARE + i / SIZE / SQUARE) % 2 == 1;
                if odd {
                    [0, 0, 0, 255]
                } else {
                    [255, 0, 255, 255]
                }
            })
            .collect();
        Self {
            name: "placeholder".to_owned(),
            width: SIZE,
            height: SIZE,
            format,
            mips: mip_chain(SIZE as usize, SIZE as usize, format, pixels),
        }
    }

    /// Width and height of a level, in pixels.
    #[must_use]
    pub fn level_size(&self, level: usize) -> (u32, u32) {
        let shift = u32::try_from(level).unwrap_or(u32::MAX);
        let side = |size: u32| size.checked_shr(shift).unwrap_or(0).max(1);
        (side(self.width), side(self.height))
    }

    /// The linear value of a pixel, or `None` outside the texture.
    #[must_use]
    pub fn pixel(&self, level: usize, x: u32, y: u32) -> Option<Vec4> {
        let (width, height) = self.level_size(level);
        if x >= width || y >= height {
            return None;
        }
        let size = self.format.bytes_per_pixel();
        let at = (y as usize * width as usize + x as usize) * size;
        Some(
            self.format
                .decode(self.mips.get(level)?.get(at..at + size)?),
        )
    }

    /// Bytes of all levels together.
    #[must_use]
    pub fn byte_count(&self) -> usize {
        self.mips.iter().map(Vec::len).sum()
    }
}

fn checked_pixel_count(name: &str, width: u32, height: u32) -> Result<usize, TextureError> {
    let allowed = 1..=MAX_TEXTURE_SIZE;
    if allowed.contains(&width) && allowed.contains(&height) {
        Ok(width as usize * height as usize)
    } else {
        Err(TextureError::Size {
            name: name.to_owned(),
            width,
            height,
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn mean(texture: &Texture, level: usize) -> Vec4 {
        let (width, height) = texture.level_size(level);
        let mut sum = glam::DVec4::ZERO;
        for y in 0..height {
            for x in 0..width {
                sum += texture.pixel(level, x, y).unwrap().as_dvec4();
            }
        }
        (sum / f64::from(width * height)).as_vec4()
    }

    /// Bytes that look random, without a generator.
    fn bytes(count: usize) -> Vec<u8> {
        (0..count as u32)
            .map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8)
            .collect()
    }

    #[test]
    fn a_black_and_white_checker_averages_to_188() {
        let pixels = (0..64)
            .flat_map(|i| {
                if (i % 8 + i / 8) % 2 == 0 {
                    [255; 4]
                } else {
                    [0, 0, 0, 255]
                }
            })
            .collect();
        let texture = Texture::new("", 8, 8, TextureFormat::Rgba8Srgb, pixels).unwrap();
        for level in 1..4 {
            assert!(
                texture.mips[level]
                    .chunks(4)
                    .all(|pixel| pixel == [188, 188, 188, 255])
            );
        }
        let linear = Texture {
            format: TextureFormat::Rgba8Linear,
            ..texture.clone()
        };
        let linear = Texture::new("", 8, 8, linear.format, linear.mips[0].clone()).unwrap();
        assert_eq!(linear.mips[3], [128, 128, 128, 255]);
    }

    #[test]
    fn the_mean_is_kept_in_linear_light_at_all_sizes() {
        for (width, height) in [(64, 64), (37, 53), (1, 19), (640, 3), (5, 1), (127, 128)] {
            for format in [TextureFormat::Rgba8Srgb, TextureFormat::Rgba8Linear] {
                let mut pixels = bytes((width * height * 4) as usize);
                pixels
                    .iter_mut()
                    .skip(3)
                    .step_by(4)
                    .for_each(|alpha| *alpha = 255);
                let texture = Texture::new("", width, height, format, pixels).unwrap();
                let last = texture.mips.len() - 1;
                assert_eq!(texture.level_size(last), (1, 1));
                let expected = mean(&texture, 0);
                // One pixel of eight bits: half a step, at most 0.0046 of sRGB.
                let difference = (mean(&texture, last) - expected).abs().max_element();
                assert!(difference < 0.0047, "{width} x {height}: {difference}");
            }
        }
    }

    #[test]
    fn half_floats_keep_the_mean_and_clamp() {
        let pixels: Vec<Vec4> = (0..33 * 17)
            .map(|i| Vec4::new(i as f32, 1000.0, 0.25, 1.0))
            .collect();
        let format = TextureFormat::Rgba16Float;
        let texture = Texture::from_linear("", 33, 17, format, &pixels).unwrap();
        let last = texture.pixel(texture.mips.len() - 1, 0, 0).unwrap();
        assert!(
            (last - Vec4::new(280.0, 1000.0, 0.25, 1.0))
                .abs()
                .max_element()
                < 0.13
        );

        let wild = [Vec4::new(1e9, -1e9, f32::NAN, f32::INFINITY)];
        let texture = Texture::from_linear("", 1, 1, format, &wild).unwrap();
        let expected = Vec4::new(65504.0, -65504.0, 0.0, 65504.0);
        assert_eq!(texture.pixel(0, 0, 0).unwrap(), expected);
    }

    #[test]
    fn hidden_colours_do_not_bleed() {
        let pixels = [
            [255, 0, 0, 255],
            [0, 255, 0, 0],
            [0, 255, 0, 0],
            [255, 0, 0, 255],
        ]
        .concat();
        let texture = Texture::new("", 2, 2, TextureFormat::Rgba8Srgb, pixels).unwrap();
        assert_eq!(texture.mips[1], [255, 1, 0, 128]);
        let clear = [0, 255, 0, 0].repeat(4);
        let texture = Texture::new("", 2, 2, TextureFormat::Rgba8Srgb, clear).unwrap();
        assert_eq!(texture.mips[1], [0, 255, 0, 0]);
    }

    #[test]
    fn wrong_sizes_are_refused() {
        let make = |width, height, length| {
            Texture::new(
                "wood",
                width,
                height,
                TextureFormat::Rgba8Srgb,
                vec![0; length],
            )
        };
        assert!(matches!(make(0, 4, 0), Err(TextureError::Size { .. })));
        assert!(matches!(
            make(60_000, 60_000, 4),
            Err(TextureError::Size { .. })
        ));
        let message = make(2, 2, 15).unwrap_err().to_string();
        assert_eq!(message, "picture `wood` needs 16 bytes and has 15");
        assert_eq!(Texture::placeholder().pixel(0, 64, 0), None);
        assert_eq!(Texture::placeholder().pixel(9, 0, 0), None);
    }
}
