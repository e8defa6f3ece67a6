//! The pictures of a model, decoded in parallel.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::Warnings;
use super::materials::{Kind, Materials, Request};
use crate::files::Files;
use crate::images::{Picture, Pixels, decode_picture};
use crate::procedural_texture::normal_map_from_heights;
use crate::{Cancelled, Texture, TextureFormat, TextureId};

/// Loads what the materials ask for. A picture that can't be had gets one
/// warning; as base colour it is the placeholder, as normals it is left out.
/// The textures are numbered anew, without those.
pub(super) fn load(
    files: &Files,
    materials: &mut Materials,
    warnings: &mut Warnings,
    report: &(impl Fn(f32) -> Result<(), Cancelled> + Sync),
) -> Result<Vec<Arc<Texture>>, Cancelled> {
    let mut paths: BTreeSet<&str> = BTreeSet::new();
    for request in &materials.requests {
        paths.insert(&request.path);
        if let Kind::Color { mask: Some(mask) } = &request.kind {
            paths.insert(mask);
        }
    }
    let paths: Vec<&str> = paths.into_iter().collect();
    let done = AtomicUsize::new(0);
    let decoded: Vec<Result<Picture, String>> = paths
        .par_iter()
        .map(|path| {
            let share = done.fetch_add(1, Ordering::Relaxed) as f32 / paths.len() as f32;
            report(share)?;
            Ok(decode(files, path))
        })
        .collect::<Result<_, Cancelled>>()?;

    for (path, picture) in paths.iter().zip(&decoded) {
        if let Err(problem) = picture {
            warnings.add_in(&files.display(path), None, problem);
        }
    }
    let picture = |path: &str| {
        let at = paths.binary_search(&path).ok()?;
        decoded[at].as_ref().ok()
    };
    let made: Vec<Option<Texture>> = materials
        .requests
        .par_iter()
        .map(|request| make(request, picture))
        .collect();

    let mut textures = Vec::new();
    let numbers: Vec<Option<TextureId>> = made
        .into_iter()
        .map(|texture| {
            textures.push(Arc::new(texture?));
            Some(TextureId(textures.len() as u32))
        })
        .collect();
    let renumber = |id: TextureId| match id {
        TextureId::PLACEHOLDER => None,
        TextureId(number) => numbers[number as usize - 1],
    };
    for material in &mut materials.materials {
        let base = material.base_color_texture;
        material.base_color_texture = base.map(|id| renumber(id).unwrap_or(TextureId::PLACEHOLDER));
        material.normal_texture = material.normal_texture.and_then(renumber);
    }
    Ok(textures)
}

/// A picture, or what is wrong with it, without its path.
fn decode(files: &Files, path: &str) -> Result<Picture, String> {
    let bytes = files.read(path).map_err(|error| error.to_string())?;
    decode_picture(path, &bytes).map_err(|error| match error {
        crate::images::ImageError::Content { problem, .. } => problem,
        other => other.to_string(),
    })
}

fn make<'a>(request: &Request, picture: impl Fn(&str) -> Option<&'a Picture>) -> Option<Texture> {
    let found = picture(&request.path)?;
    let (width, height) = (found.width, found.height);
    let name = request.path.as_str();
    let texture = match &request.kind {
        Kind::Color { mask: None } => match &found.pixels {
            Pixels::Rgba8(bytes) => {
                Texture::new(name, width, height, TextureFormat::Rgba8Srgb, opaque(bytes))
            }
            Pixels::RgbaF32(values) => {
                let pixels: Vec<glam::Vec4> =
                    values.chunks_exact(4).map(glam::Vec4::from_slice).collect();
                Texture::from_linear(name, width, height, TextureFormat::Rgba16Float, &pixels)
            }
        },
        Kind::Color { mask: Some(mask) } => {
            let mut bytes = to_bytes(found);
            if let Some(mask) = picture(mask) {
                apply_mask(&mut bytes, width, height, mask);
            }
            Texture::new(name, width, height, TextureFormat::Rgba8Srgb, bytes)
        }
        Kind::Mask => {
            let mut bytes = vec![255; width as usize * height as usize * 4];
            apply_mask(&mut bytes, width, height, found);
            Texture::new(name, width, height, TextureFormat::Rgba8Srgb, bytes)
        }
        Kind::Normal { bump } => {
            let bytes = to_bytes(found);
            let grey = |pixel: &[u8]| pixel[0] == pixel[1] && pixel[1] == pixel[2];
            if bytes.chunks_exact(4).all(grey) {
                let heights: Vec<f32> = bytes
                    .chunks_exact(4)
                    .map(|pixel| f32::from(pixel[0]) / 255.0)
                    .collect();
                // Black to white is a hundredth of the picture's width high.
                let strength = 0.01 * bump * width as f32;
                Ok(normal_map_from_heights(
                    name, width, height, &heights, strength,
                ))
            } else {
                Texture::new(name, width, height, TextureFormat::Rgba8Linear, bytes)
            }
        }
    };
    texture.ok()
}

/// Without a mask the file's alpha has no meaning, and must not weigh colours
/// in the mip levels.
fn opaque(bytes: &[u8]) -> Vec<u8> {
    bytes
        .chunks_exact(4)
        .flat_map(|pixel| [pixel[0], pixel[1], pixel[2], 255])
        .collect()
}

fn to_bytes(picture: &Picture) -> Vec<u8> {
    match &picture.pixels {
        Pixels::Rgba8(bytes) => bytes.clone(),
        Pixels::RgbaF32(values) => values
            .chunks_exact(4)
            .flat_map(|pixel| {
                let [r, g, b] = [0, 1, 2].map(|i| crate::color::encode_srgb8(pixel[i]));
                [r, g, b, crate::color::encode_unorm8(pixel[3])]
            })
            .collect(),
    }
}

/// Puts a mask into the alpha: its own alpha where it has one, else its red.
/// The nearest pixel counts where the sizes differ.
fn apply_mask(bytes: &mut [u8], width: u32, height: u32, mask: &Picture) {
    let values = to_bytes(mask);
    let has_alpha = values.iter().skip(3).step_by(4).any(|&alpha| alpha < 255);
    let channel = if has_alpha { 3 } else { 0 };
    for (i, pixel) in bytes.chunks_exact_mut(4).enumerate() {
        let (x, y) = (i as u64 % u64::from(width), i as u64 / u64::from(width));
        let mask_x = x * u64::from(mask.width) / u64::from(width);
        let mask_y = y * u64::from(mask.height) / u64::from(height);
        let at = (mask_y * u64::from(mask.width) + mask_x) as usize * 4;
        pixel[3] = values[at + channel];
    }
}
