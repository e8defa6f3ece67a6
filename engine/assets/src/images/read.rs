//! From files to pictures and textures.

use std::io::Cursor;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::Vec4;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use rayon::prelude::*;

use super::{ImageError, Picture, Pixels};
use crate::cache::Reuse;
use crate::files::Files;
use crate::{Cancelled, Digest, MAX_TEXTURE_SIZE, Progress, Shared, Texture, TextureFormat};

/// The most memory that decoding may take, in bytes: a picture of the greatest
/// size with four floats a pixel, and as much again.
const MAX_DECODING_BYTES: u64 = 32 * (MAX_TEXTURE_SIZE as u64) * (MAX_TEXTURE_SIZE as u64);

/// What a texture is for, which decides how its bytes are understood.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Purpose {
    /// Colours, sRGB-encoded in the file.
    Color,
    /// Normals, masks and other data, taken as they are.
    Data,
}

/// Makes a texture of an encoded picture. Pictures of high dynamic range become
/// [`TextureFormat::Rgba16Float`], where values over 65,504 are clamped; all
/// others 8 bits a channel. `path` gives the texture its name, and tells the
/// format where the content does not (TGA).
///
/// # Errors
/// Content that is no picture, a damaged one, or one with more than
/// [`MAX_TEXTURE_SIZE`] pixels a side, which is refused before it is decoded.
pub fn decode_texture(path: &str, bytes: &[u8], purpose: Purpose) -> Result<Texture, ImageError> {
    let picture = decode_picture(path, bytes)?;
    let (width, height) = (picture.width, picture.height);
    let texture = match (picture.pixels, purpose) {
        (Pixels::Rgba8(bytes), Purpose::Color) => {
            Texture::new(path, width, height, TextureFormat::Rgba8Srgb, bytes)
        }
        (Pixels::Rgba8(bytes), Purpose::Data) => {
            Texture::new(path, width, height, TextureFormat::Rgba8Linear, bytes)
        }
        (Pixels::RgbaF32(values), _) => {
            let pixels: Vec<Vec4> = values.chunks_exact(4).map(Vec4::from_slice).collect();
            Texture::from_linear(path, width, height, TextureFormat::Rgba16Float, &pixels)
        }
    };
    texture.map_err(|error| ImageError::content(path, error.to_string()))
}

/// As [`decode_texture`], unless an earlier load has made the texture of the same bytes.
///
/// # Errors
/// As [`decode_texture`].
pub fn shared_texture(
    reuse: &Reuse,
    path: &str,
    bytes: &[u8],
    purpose: Purpose,
) -> Result<Shared<Texture>, ImageError> {
    reuse.try_get("picture", &(path, Digest::of(bytes), purpose), || {
        decode_texture(path, bytes, purpose).map(Shared::shared)
    })
}

/// Reads a picture of a file store as a texture.
///
/// # Errors
/// As [`decode_texture`], and a file that can't be read.
pub fn load_texture(files: &Files, path: &str, purpose: Purpose) -> Result<Texture, ImageError> {
    let bytes = files.read(path)?;
    let mut texture = decode_texture(&files.display(path), &bytes, purpose)?;
    texture.name = path.to_owned();
    Ok(texture)
}

/// Reads several pictures, in parallel, and reports the share that is done.
/// The results are in the order of the paths.
///
/// # Errors
/// The work was asked to stop.
pub fn load_textures(
    files: &Files,
    paths: &[(&str, Purpose)],
    progress: &Progress,
) -> Result<Vec<Result<Texture, ImageError>>, Cancelled> {
    let done = AtomicUsize::new(0);
    let load = |&(path, purpose): &(&str, Purpose)| {
        progress.report(done.load(Ordering::Relaxed) as f32 / paths.len() as f32)?;
        let texture = load_texture(files, path, purpose);
        done.fetch_add(1, Ordering::Relaxed);
        Ok(texture)
    };
    let textures = paths
        .par_iter()
        .map(load)
        .collect::<Result<_, Cancelled>>()?;
    progress.report(1.0)?;
    Ok(textures)
}

/// Reads a picture from any place on the disk, as for a comparison.
///
/// # Errors
/// As [`decode_texture`], and a file that can't be read.
pub fn read_picture(path: impl AsRef<Path>) -> Result<Picture, ImageError> {
    let path = path.as_ref();
    let bytes = crate::files::read_path(path)?;
    decode_picture(&path.display().to_string(), &bytes)
}

/// Decodes a picture.
///
/// # Errors
/// As [`decode_texture`].
pub fn decode_picture(path: &str, bytes: &[u8]) -> Result<Picture, ImageError> {
    if bytes.is_empty() {
        return Err(ImageError::content(
            path,
            "the file is empty; save or copy it again",
        ));
    }
    let format = image::guess_format(bytes).ok().or_else(|| {
        // A TGA file does not begin with a mark of its own.
        let format = ImageFormat::from_path(path).ok();
        format.filter(|&format| format == ImageFormat::Tga)
    });
    let Some(format) = format.filter(ImageFormat::reading_enabled) else {
        return Err(ImageError::content(
            path,
            "this is no picture in a known format; save it as PNG, JPEG, TGA, BMP, HDR or EXR",
        ));
    };
    if format == ImageFormat::OpenExr {
        check_exr_windows(path, bytes)?;
    }
    let image = decode(bytes, format).map_err(|error| describe(path, &error))?;
    Ok(to_picture(image))
}

fn decode(bytes: &[u8], format: ImageFormat) -> image::ImageResult<DynamicImage> {
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_TEXTURE_SIZE);
    limits.max_image_height = Some(MAX_TEXTURE_SIZE);
    limits.max_alloc = Some(MAX_DECODING_BYTES);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits.clone());
    let mut decoder = reader.into_decoder()?;
    // Some formats leave the limits to whoever allocates.
    let (width, height) = decoder.dimensions();
    limits.check_dimensions(width, height)?;
    limits.reserve(decoder.total_bytes())?;
    decoder.set_limits(limits)?;
    DynamicImage::from_decoder(decoder)
}

fn to_picture(image: DynamicImage) -> Picture {
    let (width, height) = (image.width(), image.height());
    let pixels = match image {
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            Pixels::RgbaF32(image.into_rgba32f().into_raw())
        }
        other => Pixels::Rgba8(other.into_rgba8().into_raw()),
    };
    Picture {
        width,
        height,
        pixels,
    }
}

/// The decoder for EXR reserves memory for what a header claims before anyone
/// can ask for the size, so the size is looked up first: the two windows are
/// attributes of 16 bytes with fixed names and types (OpenEXR, "File Layout").
fn check_exr_windows(path: &str, bytes: &[u8]) -> Result<(), ImageError> {
    for name in [
        b"dataWindow\0box2i\0\x10\0\0\0".as_slice(),
        b"displayWindow\0box2i\0\x10\0\0\0",
    ] {
        for at in find_all(bytes, name) {
            let Some(window) = bytes.get(at + name.len()..at + name.len() + 16) else {
                break;
            };
            let value = |i: usize| {
                let bytes = [window[i], window[i + 1], window[i + 2], window[i + 3]];
                i64::from(i32::from_le_bytes(bytes))
            };
            let (width, height) = (value(8) - value(0) + 1, value(12) - value(4) + 1);
            let allowed = 1..=i64::from(MAX_TEXTURE_SIZE);
            if !allowed.contains(&width) || !allowed.contains(&height) {
                return Err(ImageError::content(path, size_message()));
            }
        }
    }
    Ok(())
}

/// Where a needle begins in the first part of a file, which holds its header.
fn find_all<'a>(bytes: &'a [u8], needle: &'a [u8]) -> impl Iterator<Item = usize> + 'a {
    let header = &bytes[..bytes.len().min(1 << 16)];
    let starts = header.windows(needle.len()).enumerate();
    starts
        .filter(move |(_, window)| *window == needle)
        .map(|(at, _)| at)
}

fn size_message() -> String {
    format!("the picture has more than {MAX_TEXTURE_SIZE} pixels a side; make it smaller")
}

fn describe(path: &str, error: &image::ImageError) -> ImageError {
    let problem = match error {
        image::ImageError::Limits(_) => size_message(),
        image::ImageError::Unsupported(error) => {
            format!("this kind of picture can't be read ({error}); save it as an ordinary PNG")
        }
        image::ImageError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            "the file ends before the picture does; save or copy it again".to_owned()
        }
        other => {
            let cause = other.to_string().replace('\n', " ");
            format!("the picture is damaged ({cause}); save or copy it again")
        }
    };
    ImageError::content(path, problem)
}
