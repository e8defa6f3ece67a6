//! Pictures as plain arrays of pixels, in the two spaces that metrics know.

use std::io::{BufRead, Cursor, Seek};
use std::path::Path;

use image::{DynamicImage, ImageDecoder, ImageReader, Limits};

use crate::LabError;

/// The largest width or height that a picture file may claim. A damaged header
/// must not make the program reserve gigabytes.
const MAX_FILE_SIDE: u32 = 16_384;
/// The most bytes that a decoder may allocate for one picture.
const MAX_FILE_BYTES: u64 = 2 << 30;

/// A picture as a display shows it: 8-bit sRGB with alpha, rows from top to bottom.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LdrImage {
    /// Width in pixels, at least 1.
    pub width: u32,
    /// Height in pixels, at least 1.
    pub height: u32,
    /// `width · height` pixels of R, G, B (sRGB transfer function) and A.
    pub pixels: Vec<[u8; 4]>,
}

/// A picture in linear Rec. 709 RGB before any tone curve, rows from top to bottom.
#[derive(Clone, Debug, PartialEq)]
pub struct HdrImage {
    /// Width in pixels, at least 1.
    pub width: u32,
    /// Height in pixels, at least 1.
    pub height: u32,
    /// `width · height` pixels of linear R, G, B and A. Values may be negative,
    /// infinite or NaN; the metrics say how they treat those.
    pub pixels: Vec<[f32; 4]>,
}

impl LdrImage {
    /// Wraps an array of pixels.
    ///
    /// # Errors
    /// [`LabError::PixelCount`] if the array does not fill the size or the size is zero.
    pub fn new(width: u32, height: u32, pixels: Vec<[u8; 4]>) -> Result<Self, LabError> {
        check_count(width, height, pixels.len())?;
        Ok(Self {
            width,
            height,
            pixels,
        })
    }

    /// Calls `pixel(x, y)` for each pixel, row by row.
    pub fn from_fn(width: u32, height: u32, mut pixel: impl FnMut(u32, u32) -> [u8; 4]) -> Self {
        let (width, height) = (width.max(1), height.max(1));
        let pixels = (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .map(|(x, y)| pixel(x, y))
            .collect();
        Self {
            width,
            height,
            pixels,
        }
    }

    /// The picture as a PNG file in memory.
    ///
    /// # Errors
    /// [`LabError::Encode`] if the encoder fails.
    pub fn to_png(&self) -> Result<Vec<u8>, LabError> {
        use image::codecs::png::{CompressionType, FilterType, PngEncoder};
        check_count(self.width, self.height, self.pixels.len())?;
        let mut bytes = Vec::new();
        // Opaque pictures are stored without alpha: a quarter less to compress.
        let opaque = self.pixels.iter().all(|p| p[3] == 255);
        let (samples, colour): (Vec<u8>, _) = if opaque {
            let rgb = self
                .pixels
                .iter()
                .flat_map(|p| [p[0], p[1], p[2]])
                .collect();
            (rgb, image::ExtendedColorType::Rgb8)
        } else {
            (
                self.pixels.as_flattened().to_vec(),
                image::ExtendedColorType::Rgba8,
            )
        };
        let encoder = PngEncoder::new_with_quality(
            &mut bytes,
            CompressionType::Default,
            FilterType::Adaptive,
        );
        image::ImageEncoder::write_image(encoder, &samples, self.width, self.height, colour)
            .map_err(|error| LabError::Encode {
                format: "PNG",
                reason: error.to_string(),
            })?;
        Ok(bytes)
    }
}

impl HdrImage {
    /// Wraps an array of pixels.
    ///
    /// # Errors
    /// [`LabError::PixelCount`] if the array does not fill the size or the size is zero.
    pub fn new(width: u32, height: u32, pixels: Vec<[f32; 4]>) -> Result<Self, LabError> {
        check_count(width, height, pixels.len())?;
        Ok(Self {
            width,
            height,
            pixels,
        })
    }

    /// Calls `pixel(x, y)` for each pixel, row by row.
    pub fn from_fn(width: u32, height: u32, mut pixel: impl FnMut(u32, u32) -> [f32; 4]) -> Self {
        let (width, height) = (width.max(1), height.max(1));
        let pixels = (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .map(|(x, y)| pixel(x, y))
            .collect();
        Self {
            width,
            height,
            pixels,
        }
    }

    /// Whether R, G and B of a pixel are all finite.
    pub fn is_valid(pixel: &[f32; 4]) -> bool {
        pixel[..3].iter().all(|c| c.is_finite())
    }
}

/// A picture file in the space that its format implies.
#[derive(Clone, Debug, PartialEq)]
pub enum Picture {
    /// PNG, JPEG, TGA and BMP files: 8-bit sRGB. Files with 16 bits are rounded.
    Ldr(LdrImage),
    /// EXR and Radiance HDR files: linear values.
    Hdr(HdrImage),
}

impl Picture {
    /// Reads a picture file; the format is recognised by its content, not its name.
    ///
    /// # Errors
    /// [`LabError::PictureFile`] if the file can't be read, is no picture, is
    /// truncated, or claims more than 16,384 pixels on a side.
    pub fn open(path: &Path) -> Result<Self, LabError> {
        let fail = |reason: String| LabError::PictureFile {
            path: path.to_path_buf(),
            reason,
        };
        let reader = ImageReader::open(path).map_err(|error| fail(error.to_string()))?;
        Self::decode(reader).map_err(fail)
    }

    /// Reads the bytes of a picture file; `path` is for the message where they are none.
    ///
    /// # Errors
    /// As [`Picture::open`].
    pub fn read(path: &Path, bytes: &[u8]) -> Result<Self, LabError> {
        let fail = |reason: String| LabError::PictureFile {
            path: path.to_path_buf(),
            reason,
        };
        Self::decode(ImageReader::new(Cursor::new(bytes))).map_err(fail)
    }

    fn decode(reader: ImageReader<impl BufRead + Seek>) -> Result<Self, String> {
        let mut reader = reader
            .with_guessed_format()
            .map_err(|error| error.to_string())?;
        let mut limits = Limits::default();
        limits.max_image_width = Some(MAX_FILE_SIDE);
        limits.max_image_height = Some(MAX_FILE_SIDE);
        limits.max_alloc = Some(MAX_FILE_BYTES);
        reader.limits(limits);
        let decoder = reader.into_decoder().map_err(|error| error.to_string())?;
        let (width, height) = decoder.dimensions();
        if width.max(height) > MAX_FILE_SIDE {
            return Err(format!(
                "it claims {width} × {height} pixels; at most {MAX_FILE_SIDE} on a side are read"
            ));
        }
        let image = DynamicImage::from_decoder(decoder).map_err(|error| error.to_string())?;
        Self::from_dynamic(image).map_err(|error| error.to_string())
    }

    fn from_dynamic(image: DynamicImage) -> Result<Self, LabError> {
        let (width, height) = (image.width(), image.height());
        match image {
            DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
                let raw = image.into_rgba32f().into_raw();
                let pixels = raw.as_chunks::<4>().0.to_vec();
                HdrImage::new(width, height, pixels).map(Self::Hdr)
            }
            _ => {
                let raw = image.into_rgba8().into_raw();
                let pixels = raw.as_chunks::<4>().0.to_vec();
                LdrImage::new(width, height, pixels).map(Self::Ldr)
            }
        }
    }

    /// The space of the values in words, as error messages and reports use it.
    pub fn range(&self) -> &'static str {
        match self {
            Self::Ldr(_) => "8-bit sRGB",
            Self::Hdr(_) => "linear HDR",
        }
    }
}

fn check_count(width: u32, height: u32, found: usize) -> Result<(), LabError> {
    let expected = u64::from(width) * u64::from(height);
    let found = found as u64;
    if expected == 0 || expected != found {
        return Err(LabError::PixelCount {
            width,
            height,
            expected,
            found,
        });
    }
    Ok(())
}

/// Both sizes must be equal and both arrays must fill them, so that metrics may index freely.
pub(crate) fn check_pair(
    reference: (u32, u32, usize),
    test: (u32, u32, usize),
) -> Result<(), LabError> {
    check_count(reference.0, reference.1, reference.2)?;
    check_count(test.0, test.1, test.2)?;
    if (reference.0, reference.1) != (test.0, test.1) {
        return Err(LabError::SizeMismatch {
            reference_width: reference.0,
            reference_height: reference.1,
            test_width: test.0,
            test_height: test.1,
        });
    }
    Ok(())
}

pub(crate) fn check_ldr(reference: &LdrImage, test: &LdrImage) -> Result<(), LabError> {
    check_pair(
        (reference.width, reference.height, reference.pixels.len()),
        (test.width, test.height, test.pixels.len()),
    )
}

pub(crate) fn check_hdr(reference: &HdrImage, test: &HdrImage) -> Result<(), LabError> {
    check_pair(
        (reference.width, reference.height, reference.pixels.len()),
        (test.width, test.height, test.pixels.len()),
    )
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn sizes_are_checked() {
        assert!(LdrImage::new(2, 2, vec![[0; 4]; 3]).is_err());
        assert!(HdrImage::new(0, 2, vec![]).is_err());
        let a = LdrImage::from_fn(2, 3, |_, _| [0; 4]);
        let b = LdrImage::from_fn(3, 2, |_, _| [0; 4]);
        let text = check_ldr(&a, &b).unwrap_err().to_string();
        assert!(text.contains("2 × 3") && text.contains("3 × 2"), "{text}");
    }

    #[test]
    fn png_round_trip_keeps_every_pixel() {
        let folder = tempfile::tempdir().unwrap();
        for alpha in [255, 77] {
            let a = LdrImage::from_fn(13, 7, |x, y| {
                [(x * 19) as u8, (y * 31) as u8, (x ^ y) as u8, alpha]
            });
            let path = folder.path().join("a.bin");
            std::fs::write(&path, a.to_png().unwrap()).unwrap();
            let bytes = std::fs::read(&path).unwrap();
            assert_eq!(
                Picture::read(&path, &bytes).unwrap(),
                Picture::Ldr(a.clone())
            );
            assert_eq!(Picture::open(&path).unwrap(), Picture::Ldr(a));
        }
    }

    #[test]
    fn damaged_files_are_errors_that_name_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let png = LdrImage::from_fn(64, 64, |x, y| [x as u8, y as u8, 0, 255])
            .to_png()
            .unwrap();
        // A header may claim any size: bytes 16..24 of a PNG are width and height, followed by a
        // checksum of the chunk at byte 29.
        let mut huge = png.clone();
        huge[16..20].copy_from_slice(&60_000_u32.to_be_bytes());
        huge[20..24].copy_from_slice(&60_000_u32.to_be_bytes());
        let sum = crc32(&huge[12..29]);
        huge[29..33].copy_from_slice(&sum.to_be_bytes());
        for (name, bytes) in [
            ("empty.png", Vec::new()),
            ("text.png", b"no picture at all".to_vec()),
            ("cut.png", png[..png.len() / 2].to_vec()),
            ("huge.png", huge),
        ] {
            let path = folder.path().join(name);
            std::fs::write(&path, bytes).unwrap();
            let text = Picture::open(&path).unwrap_err().to_string();
            assert!(text.contains(name), "{text}");
        }
        assert!(Picture::open(folder.path()).is_err());
    }

    fn crc32(bytes: &[u8]) -> u32 {
        !bytes.iter().fold(!0_u32, |crc, &byte| {
            (0..8).fold(crc ^ u32::from(byte), |c, _| {
                (c >> 1) ^ (0xEDB8_8320 & (c & 1).wrapping_neg())
            })
        })
    }
}
