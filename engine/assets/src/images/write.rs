//! From pixels to files, whole or not at all.

use std::io::Cursor;
use std::path::Path;

use image::{ExtendedColorType, ImageEncoder};

use super::ImageError;
use crate::files::write_atomic;

/// Writes a PNG with 8 bits a channel: red, green, blue and alpha of each
/// pixel, rows from the top, colours sRGB-encoded.
///
/// # Errors
/// Data of the wrong length, a folder that can't be written, a full disk.
pub fn save_png(
    path: impl AsRef<Path>,
    width: u32,
    height: u32,
    rgba: &[u8],
) -> Result<(), ImageError> {
    let path = path.as_ref();
    let bytes = encode_png(&path.display().to_string(), width, height, rgba)?;
    Ok(write_atomic(path, &bytes)?)
}

/// Writes an EXR with 32-bit floats: red, green, blue and alpha of each pixel,
/// rows from the top, linear. Every bit is kept.
///
/// # Errors
/// As [`save_png`].
pub fn save_exr(
    path: impl AsRef<Path>,
    width: u32,
    height: u32,
    rgba: &[f32],
) -> Result<(), ImageError> {
    let path = path.as_ref();
    let bytes = encode_exr(&path.display().to_string(), width, height, rgba)?;
    Ok(write_atomic(path, &bytes)?)
}

/// The bytes that [`save_png`] writes; `path` is for messages.
///
/// # Errors
/// Data of the wrong length.
pub fn encode_png(path: &str, width: u32, height: u32, rgba: &[u8]) -> Result<Vec<u8>, ImageError> {
    check_length(path, width, height, rgba.len())?;
    let mut bytes = Vec::new();
    image::codecs::png::PngEncoder::new(&mut bytes)
        .write_image(rgba, width, height, ExtendedColorType::Rgba8)
        .map_err(|error| ImageError::content(path, error.to_string()))?;
    Ok(bytes)
}

/// The bytes that [`save_exr`] writes; `path` is for messages.
///
/// # Errors
/// Data of the wrong length.
pub fn encode_exr(
    path: &str,
    width: u32,
    height: u32,
    rgba: &[f32],
) -> Result<Vec<u8>, ImageError> {
    check_length(path, width, height, rgba.len())?;
    let raw: Vec<u8> = rgba.iter().flat_map(|value| value.to_ne_bytes()).collect();
    let mut bytes = Cursor::new(Vec::new());
    image::codecs::openexr::OpenExrEncoder::new(&mut bytes)
        .write_image(&raw, width, height, ExtendedColorType::Rgba32F)
        .map_err(|error| ImageError::content(path, error.to_string()))?;
    Ok(bytes.into_inner())
}

fn check_length(path: &str, width: u32, height: u32, found: usize) -> Result<(), ImageError> {
    let expected = width as usize * height as usize * 4;
    if expected == 0 || found != expected {
        return Err(ImageError::content(
            path,
            format!("a picture of {width} x {height} pixels can't be made of {found} values"),
        ));
    }
    Ok(())
}
