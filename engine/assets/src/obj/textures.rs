//! The pictures of a model, decoded in parallel.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::Warnings;
use super::materials::{Kind, Materials, Request};
use crate::cache::{Kept, Key, Reuse};
use crate::files::Files;
use crate::images::{Picture, Pixels, decode_picture};
use crate::procedural_texture::normal_map_from_heights;
use crate::{Cancelled, Digest, Shared, Texture, TextureFormat, TextureId};

/// What came of a request.
#[derive(Clone, Default)]
struct Made {
    texture: Option<Shared<Texture>>,
    /// What is wrong with the picture or its mask, by path.
    problems: Vec<(String, String)>,
}

impl Kept for Made {
    fn bytes(&self) -> usize {
        self.texture.as_ref().map_or(0, Kept::bytes)
    }
}

/// The bytes of a picture and their digest, or what is wrong, without its path.
type Content = Result<(Vec<u8>, Digest), String>;

/// Loads what the materials ask for. A picture that can't be had gets one
/// warning; as base colour it is the placeholder, as normals it is left out.
/// The textures are numbered anew, without those.
pub(super) fn load(
    files: &Files,
    reuse: &Reuse,
    materials: &mut Materials,
    warnings: &mut Warnings,
    report: &(impl Fn(f32) -> Result<(), Cancelled> + Sync),
) -> Result<Vec<Shared<Texture>>, Cancelled> {
    let contents: BTreeMap<&str, Content> = paths(&materials.requests)
        .into_par_iter()
        .map(|path| {
            report(0.0)?;
            Ok((path, read(files, path)))
        })
        .collect::<Result<_, Cancelled>>()?;
    let made = make_all(reuse, &materials.requests, &contents, report)?;

    let mut problems: BTreeMap<&str, &str> = BTreeMap::new();
    for (path, problem) in made.iter().flat_map(|made| &made.problems) {
        problems.insert(path, problem);
    }
    for (path, problem) in problems {
        warnings.add_in(&files.display(path), None, problem);
    }
    let mut textures = Vec::new();
    let numbers: Vec<Option<TextureId>> = made
        .into_iter()
        .map(|made| {
            textures.push(made.texture?);
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

/// All pictures that requests name, each once, in order.
fn paths<'a>(requests: impl IntoIterator<Item = &'a Request>) -> Vec<&'a str> {
    let mut paths: Vec<&str> = requests.into_iter().flat_map(named).collect();
    paths.sort_unstable();
    paths.dedup();
    paths
}

/// The pictures that a request names.
fn named(request: &Request) -> impl Iterator<Item = &str> {
    let mask = match &request.kind {
        Kind::Color { mask } => mask.as_deref(),
        Kind::Mask | Kind::Normal { .. } => None,
    };
    std::iter::once(request.path.as_str()).chain(mask)
}

fn read(files: &Files, path: &str) -> Content {
    let bytes = files.read(path).map_err(|error| error.to_string())?;
    let digest = Digest::of(&bytes);
    Ok((bytes, digest))
}

fn content<'a>(
    contents: &'a BTreeMap<&str, Content>,
    path: &str,
) -> Result<&'a (Vec<u8>, Digest), String> {
    let content = contents.get(path).ok_or("it was not read")?;
    content.as_ref().map_err(String::clone)
}

/// What comes of each request. A picture is decoded if a request needs it that was not made before,
/// once for all such requests.
fn make_all(
    reuse: &Reuse,
    requests: &[Request],
    contents: &BTreeMap<&str, Content>,
    report: &(impl Fn(f32) -> Result<(), Cancelled> + Sync),
) -> Result<Vec<Made>, Cancelled> {
    let key = |request: &Request| {
        // A file that can't be read is as good as its message.
        let digest = |path| content(contents, path).map(|(_, digest)| *digest);
        let digests: Vec<_> = named(request).map(digest).collect();
        Key::new("picture of an obj", &(request, digests))
    };
    let keys: Vec<Key> = requests.iter().map(key).collect();
    let known: Vec<Option<Made>> = keys.iter().map(|key| reuse.find(key)).collect();

    let unknown = requests.iter().zip(&known);
    let unknown = unknown.filter_map(|(request, known)| known.is_none().then_some(request));
    let wanted = paths(unknown);
    let done = AtomicUsize::new(0);
    let decoded: BTreeMap<&str, Result<Picture, String>> = wanted
        .par_iter()
        .map(|path| {
            report(done.fetch_add(1, Ordering::Relaxed) as f32 / wanted.len() as f32)?;
            Ok((*path, decode(path, contents)))
        })
        .collect::<Result<_, Cancelled>>()?;
    let made = known.into_par_iter().zip(keys).zip(requests);
    let made = made.map(|((known, key), request)| {
        known.unwrap_or_else(|| reuse.keep(key, make_one(request, &decoded)))
    });
    Ok(made.collect())
}

fn decode(path: &str, contents: &BTreeMap<&str, Content>) -> Result<Picture, String> {
    let (bytes, _) = content(contents, path)?;
    decode_picture(path, bytes).map_err(|error| match error {
        crate::images::ImageError::Content { problem, .. } => problem,
        other => other.to_string(),
    })
}

fn make_one(request: &Request, decoded: &BTreeMap<&str, Result<Picture, String>>) -> Made {
    let problem = |path: &str| {
        let problem = decoded.get(path)?.as_ref().err()?;
        Some((path.to_owned(), problem.clone()))
    };
    let picture = |path: &str| decoded.get(path)?.as_ref().ok();
    Made {
        texture: make(request, picture).map(Shared::shared),
        problems: named(request).filter_map(problem).collect(),
    }
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
