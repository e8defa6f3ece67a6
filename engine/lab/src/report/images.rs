//! The pictures of a report as PNG files in memory, and in what form a page holds them.

use half::f16;
use rayon::prelude::*;

use super::model::{Comparison, PipelineResult};
use crate::{HdrImage, LabError, LdrImage};

/// The PNG files of one pipeline.
#[derive(Default)]
pub(super) struct Encoded {
    /// The picture.
    pub picture: Option<Vec<u8>>,
    /// The picture less the reference's, where the page holds that instead.
    pub delta: Option<Vec<u8>>,
    /// The FLIP heat map.
    pub heat_map: Option<Vec<u8>>,
    /// The views, in their order.
    pub views: Vec<Option<Vec<u8>>>,
    /// The picture in linear light, as [`halves`] lays it out.
    pub linear: Option<Vec<u8>>,
    /// What of this the page holds.
    pub held: Held,
}

/// What a page holds of a pipeline's pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Held {
    /// In what form it holds the picture.
    pub picture: Form,
    /// Whether it holds the heat map.
    pub heat_map: bool,
    /// Whether it holds the views.
    pub views: bool,
    /// Whether it holds the picture in linear light.
    pub linear: bool,
}

/// In what form a page holds a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Form {
    /// Not at all.
    #[default]
    Absent,
    /// As it is.
    Whole,
    /// As the difference to the reference's picture.
    Delta,
}

/// Bytes of PNG files that a page holds at most; as base 64 a third more, which with the text stays
/// below 25 MB.
const PAGE: usize = 16_000_000;
/// Bytes up to which the pictures of all points stay whole, so that they show without the script.
const PLAIN: usize = 8_000_000;

/// Encodes the pictures of all pipelines of all points, in their order, and decides what a page
/// holds.
pub(super) fn encode(points: &[&Comparison]) -> Result<Vec<Vec<Encoded>>, LabError> {
    let mut encoded: Vec<Vec<Encoded>> = points
        .par_iter()
        .map(|c| c.pipelines.par_iter().map(files).collect())
        .collect::<Result<_, LabError>>()?;
    let pictures = encoded.iter().flatten().filter_map(|e| e.picture.as_ref());
    if pictures.map(Vec::len).sum::<usize>() > PLAIN {
        // Those of the first point show, and print, without the script in any case.
        for (c, encoded) in points.iter().zip(&mut encoded).skip(1) {
            deltas(c, encoded)?;
        }
    }
    hold(points, &mut encoded, PAGE);
    Ok(encoded)
}

fn files(p: &PipelineResult) -> Result<Encoded, LabError> {
    let png = |image: &Option<LdrImage>| image.as_ref().map(LdrImage::to_png).transpose();
    Ok(Encoded {
        picture: png(&p.picture)?,
        heat_map: png(&p.heat_map)?,
        views: p
            .views
            .iter()
            .map(|view| png(&view.picture))
            .collect::<Result<_, _>>()?,
        linear: p
            .linear
            .as_ref()
            .map(|image| halves(image).to_png())
            .transpose()?,
        ..Encoded::default()
    })
}

/// The pipeline whose picture the others are held as differences to: the reference, or where that is
/// no pipeline the first with a picture.
pub(super) fn base(c: &Comparison) -> Option<&PipelineResult> {
    let reference = c.reference_result().filter(|p| p.picture.is_some());
    reference.or_else(|| c.pipelines.iter().find(|p| p.picture.is_some()))
}

/// Encodes each opaque picture's difference to the reference, where that is the smaller file.
fn deltas(c: &Comparison, encoded: &mut [Encoded]) -> Result<(), LabError> {
    let Some((base, reference)) = base(c).and_then(|p| Some((p, p.picture.as_ref()?))) else {
        return Ok(());
    };
    let opaque = |image: &LdrImage| image.pixels.iter().all(|p| p[3] == 255);
    if !opaque(reference) {
        return Ok(());
    }
    c.pipelines
        .par_iter()
        .zip(encoded)
        .filter(|(p, _)| p.name != base.name)
        .try_for_each(|(p, encoded)| {
            let Some(picture) = p.picture.as_ref().filter(|image| opaque(image)) else {
                return Ok(());
            };
            if (picture.width, picture.height) != (reference.width, reference.height) {
                return Ok(());
            }
            let png = difference(reference, picture).to_png()?;
            let whole = encoded.picture.as_ref().map_or(0, Vec::len);
            encoded.delta = (png.len() < whole).then_some(png);
            Ok(())
        })
}

/// A picture less another, channel by channel, modulo 256.
fn difference(reference: &LdrImage, picture: &LdrImage) -> LdrImage {
    let pixels = reference.pixels.iter().zip(&picture.pixels);
    LdrImage {
        width: picture.width,
        height: picture.height,
        pixels: pixels
            .map(|(r, p)| {
                let less = |i: usize| p[i].wrapping_sub(r[i]);
                [less(0), less(1), less(2), 255]
            })
            .collect(),
    }
}

/// A linear picture as half floats in an 8-bit picture of twice the height: above the high bytes of
/// red, green and blue, below the low ones. A canvas gives such bytes back unchanged.
pub(super) fn halves(image: &HdrImage) -> LdrImage {
    let bytes = |half: usize| {
        image.pixels.iter().map(move |pixel| {
            let byte = |i: usize| f16::from_f32(pixel[i]).to_be_bytes()[half];
            [byte(0), byte(1), byte(2), 255]
        })
    };
    LdrImage {
        width: image.width,
        height: image.height * 2,
        pixels: bytes(0).chain(bytes(1)).collect(),
    }
}

/// Decides what fits into a page: first pictures, the references' before the others', then heat
/// maps, views, and pictures in linear light.
fn hold(points: &[&Comparison], encoded: &mut [Vec<Encoded>], mut budget: usize) {
    let mut take = |png: &Option<Vec<u8>>| {
        let fits = png.as_ref().is_some_and(|png| png.len() <= budget);
        if fits {
            budget -= png.as_ref().map_or(0, Vec::len);
        }
        fits
    };
    for others in [false, true] {
        for (c, encoded) in points.iter().zip(encoded.iter_mut()) {
            let base = base(c).map(|p| p.name.as_str());
            let pipelines = c.pipelines.iter().zip(encoded);
            for (_, e) in pipelines.filter(|(p, _)| (Some(p.name.as_str()) != base) == others) {
                e.held.picture = match &e.delta {
                    Some(_) if take(&e.delta) => Form::Delta,
                    None if take(&e.picture) => Form::Whole,
                    _ => Form::Absent,
                };
            }
        }
    }
    encoded
        .iter_mut()
        .flatten()
        .for_each(|e| e.held.heat_map = take(&e.heat_map));
    for e in encoded.iter_mut().flatten() {
        // Each is taken, whether or not one before it was.
        let taken = e.views.iter().filter(|view| take(view)).count();
        e.held.views = taken > 0 && taken == e.views.len();
    }
    for e in encoded.iter_mut() {
        e.iter_mut().for_each(|e| e.held.linear = take(&e.linear));
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::report::sample;

    #[test]
    fn a_difference_added_to_the_reference_is_the_picture() {
        let a = sample::picture(64, 36, 0.0, 0.5);
        let b = sample::picture(64, 36, 0.02, 0.9);
        let delta = difference(&a, &b);
        for ((r, d), p) in a.pixels.iter().zip(&delta.pixels).zip(&b.pixels) {
            for i in 0..3 {
                assert_eq!((u32::from(r[i]) + u32::from(d[i])) % 256, u32::from(p[i]));
            }
        }
    }

    #[test]
    fn halves_hold_the_bits_of_half_floats() {
        let image = HdrImage::from_fn(3, 2, |x, y| [x as f32 * 0.1, 60_000.0, -2.0, y as f32]);
        let bytes = halves(&image);
        assert_eq!((bytes.width, bytes.height), (3, 4));
        for (i, pixel) in image.pixels.iter().enumerate() {
            for (c, value) in pixel.iter().enumerate().take(3) {
                let bits = [bytes.pixels[i][c], bytes.pixels[6 + i][c]];
                assert_eq!(f16::from_be_bytes(bits), f16::from_f32(*value));
            }
        }
    }

    #[test]
    fn what_does_not_fit_is_left_out_and_the_reference_comes_first() {
        let c = sample::comparison();
        let mut encoded = encode(&[&c]).unwrap();
        assert!(encoded[0].iter().all(|e| e.held.picture == Form::Whole));
        let reference = encoded[0][0].picture.as_ref().unwrap().len();
        hold(&[&c], &mut encoded, reference);
        assert_eq!(encoded[0][0].held.picture, Form::Whole);
        assert_eq!(encoded[0][1].held, Held::default());
    }
}
