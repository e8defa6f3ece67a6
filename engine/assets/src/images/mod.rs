//! Reading and writing of pictures: PNG, JPEG, TGA, BMP, HDR and EXR.
//!
//! A picture of high dynamic range (HDR, EXR) holds linear values; all others
//! hold 8 or 16 bits a channel, sRGB-encoded where they are colours.

mod read;
mod write;

use thiserror::Error;

use crate::files::FileError;

pub use read::{
    Purpose, decode_picture, decode_texture, load_texture, load_textures, read_picture,
    shared_texture,
};
pub use write::{encode_exr, encode_png, save_exr, save_png};

/// A picture as its file holds it, rows from the top, four values a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// The values.
    pub pixels: Pixels,
}

/// The values of a [`Picture`]: red, green, blue and alpha of each pixel.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// 8 bits a channel, colours sRGB-encoded. Files with 16 bits are rounded.
    Rgba8(Vec<u8>),
    /// Linear floats.
    RgbaF32(Vec<f32>),
}

impl Picture {
    /// All values as linear floats: sRGB is decoded, floats stay as they are.
    #[must_use]
    pub fn to_linear(&self) -> Vec<f32> {
        match &self.pixels {
            Pixels::RgbaF32(values) => values.clone(),
            Pixels::Rgba8(bytes) => {
                let linear = |(channel, &byte): (usize, &u8)| match channel % 4 {
                    3 => f32::from(byte) / 255.0,
                    _ => crate::color::decode_srgb8(byte),
                };
                bytes.iter().enumerate().map(linear).collect()
            }
        }
    }
}

/// Why a picture can't be read or written.
#[derive(Debug, Error)]
pub enum ImageError {
    /// The file itself.
    #[error(transparent)]
    File(#[from] FileError),
    /// What is in it.
    #[error("{path}: {problem}")]
    Content {
        /// The picture.
        path: String,
        /// What is wrong, and the way out.
        problem: String,
    },
}

impl ImageError {
    fn content(path: &str, problem: impl Into<String>) -> Self {
        Self::Content {
            path: path.to_owned(),
            problem: problem.into(),
        }
    }
}

#[cfg(test)]
mod tests;
