//! Materials of glTF files, and their pictures.

use std::collections::HashMap;

use ::gltf::material::AlphaMode;
use glam::Vec3;

use super::{Document, buffers};
use crate::cache::{Kept, Reuse};
use crate::files::Files;
use crate::images::{Picture, Pixels, Purpose, decode_picture, shared_texture};
use crate::obj::ModelError;
use crate::{Digest, Material, Progress, Shared, Texture, TextureId};

/// Reflectance at normal incidence of what is no metal (glTF 2.0, appendix B.3.1).
const DIELECTRIC: f32 = 0.04;

/// All materials, in the order of the file, and the textures that they use.
pub(super) fn load(
    document: &mut Document,
    files: &Files,
    reuse: &Reuse,
    path: &str,
    progress: &Progress,
) -> Result<(Vec<Material>, Vec<Shared<Texture>>), ModelError> {
    let gltf = document.gltf.clone();
    let mut pictures = Pictures {
        files,
        reuse,
        path,
        textures: Vec::new(),
        known: HashMap::new(),
    };
    let mut materials = Vec::new();
    for source in gltf.materials() {
        let done = materials.len() as f32 / gltf.materials().len() as f32;
        progress.report(0.3 + 0.4 * done)?;
        materials.push(material(document, &mut pictures, &source));
    }
    Ok((materials, pictures.textures))
}

fn material(
    document: &mut Document,
    pictures: &mut Pictures,
    source: &::gltf::Material,
) -> Material {
    let surface = source.pbr_metallic_roughness();
    let [red, green, blue, _] = surface.base_color_factor();
    let base = Vec3::new(red, green, blue).clamp(Vec3::ZERO, Vec3::ONE);
    let (mut metallic, mut roughness) = (surface.metallic_factor(), surface.roughness_factor());
    if let Some(info) = surface.metallic_roughness_texture() {
        document.warn("textures of metal and roughness count with their mean");
        if let Some([_, green, blue]) = pictures.mean(document, &info.texture()) {
            (metallic, roughness) = (metallic * blue, roughness * green);
        }
    }
    let metallic = metallic.clamp(0.0, 1.0);
    if source.alpha_mode() == AlphaMode::Blend {
        document.warn("transparency without a mask is drawn opaque");
    }
    if source.occlusion_texture().is_some() {
        document.warn("textures of occlusion are not used");
    }
    let emissive = match source.emissive_texture() {
        Some(_) => {
            document
                .warn("textures of emission are not supported; such a surface gives off nothing");
            Vec3::ZERO
        }
        None => {
            let strength = source.emissive_strength().unwrap_or(1.0);
            Vec3::from(source.emissive_factor()) * strength
        }
    };
    let base_color_texture = surface.base_color_texture().map(|info| {
        document.check_coordinates(info.tex_coord());
        // A picture that can't be had shows as the placeholder.
        let texture = pictures.texture(document, &info.texture(), Purpose::Color);
        texture.unwrap_or(TextureId::PLACEHOLDER)
    });
    let normal_texture = source.normal_texture().and_then(|info| {
        document.check_coordinates(info.tex_coord());
        if info.scale() != 1.0 {
            document.warn("the scale of normal textures is not used");
        }
        pictures.texture(document, &info.texture(), Purpose::Data)
    });
    // Rec. 709 luminance.
    let luminance = base.dot(Vec3::new(0.2126, 0.7152, 0.0722));
    let name = source.name().filter(|name| !name.is_empty());
    let number = source.index().unwrap_or_default();
    Material {
        name: name.map_or_else(|| format!("material {number}"), str::to_owned),
        base_color: base * (1.0 - metallic),
        base_color_texture,
        specular: DIELECTRIC + (luminance - DIELECTRIC) * metallic,
        power: exponent(roughness),
        emissive: if emissive.is_finite() {
            emissive.max(Vec3::ZERO)
        } else {
            Vec3::ZERO
        },
        normal_texture,
        alpha_cutoff: (source.alpha_mode() == AlphaMode::Mask)
            .then(|| source.alpha_cutoff().unwrap_or(0.5).clamp(0.0, 1.0)),
        opacity: if source.alpha_mode() == AlphaMode::Blend {
            source.pbr_metallic_roughness().base_color_factor()[3].clamp(0.0, 1.0)
        } else {
            1.0
        },
        two_sided: source.double_sided(),
    }
}

/// The Blinn-Phong exponent of a roughness: 2/α² − 2 with α = roughness² (Karis 2013).
pub(super) fn exponent(roughness: f32) -> f32 {
    let alpha = roughness.clamp(0.0, 1.0).powi(2);
    let (least, greatest) = Material::POWER_RANGE.into_inner();
    (2.0 / (alpha * alpha) - 2.0).clamp(least, greatest)
}

impl Document {
    fn check_coordinates(&mut self, set: u32) {
        if set != 0 {
            self.warn("only the first texture coordinates are used");
        }
    }
}

/// Pictures that were read, by image and purpose.
struct Pictures<'a> {
    files: &'a Files,
    reuse: &'a Reuse,
    path: &'a str,
    textures: Vec<Shared<Texture>>,
    known: HashMap<(usize, bool), Option<TextureId>>,
}

/// The mean of a picture.
#[derive(Clone, Copy)]
struct Mean([f32; 3]);

impl Kept for Mean {
    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

impl Pictures<'_> {
    /// The texture of an image; `None`, with a warning, for one that can't be had.
    fn texture(
        &mut self,
        document: &mut Document,
        texture: &::gltf::Texture,
        purpose: Purpose,
    ) -> Option<TextureId> {
        let image = image_number(document, texture)?;
        let key = (image, matches!(purpose, Purpose::Color));
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        let made = self.bytes(document, image).and_then(|(name, bytes)| {
            let texture = shared_texture(self.reuse, &name, &bytes, purpose);
            texture.map_err(|error| error.to_string())
        });
        let id = match made {
            Ok(texture) => {
                self.textures.push(texture);
                Some(TextureId(self.textures.len() as u32))
            }
            Err(error) => {
                document.warn(format!("image {image}: {error}"));
                None
            }
        };
        self.known.insert(key, id);
        id
    }

    /// The mean of red, green and blue, as they are stored.
    fn mean(&self, document: &mut Document, texture: &::gltf::Texture) -> Option<[f32; 3]> {
        let image = image_number(document, texture)?;
        let found = self.bytes(document, image).and_then(|(name, bytes)| {
            let made_of = (&name, Digest::of(&bytes));
            self.reuse.try_get("mean of a picture", &made_of, || {
                let picture = decode_picture(&name, &bytes).map_err(|error| error.to_string())?;
                Ok::<_, String>(Mean(mean(&picture)))
            })
        });
        match found {
            Ok(Mean(mean)) => Some(mean),
            Err(error) => {
                document.warn(format!("image {image}: {error}"));
                None
            }
        }
    }

    /// The name and the bytes of an image.
    fn bytes(&self, document: &Document, image: usize) -> Result<(String, Vec<u8>), String> {
        let root = document.gltf.as_json();
        let source = root.images.get(image).ok_or("there is no such image")?;
        if let Some(view) = &source.buffer_view {
            let view = document.gltf.views().nth(view.value());
            let view = view.ok_or("there is no such buffer view")?;
            let name = format!("{}#{image}", document.path);
            return Ok((name, document.view(&view)?.to_vec()));
        }
        let uri = source
            .uri
            .as_deref()
            .ok_or("it has neither a `uri` nor a buffer view")?;
        let name = match uri.starts_with("data:") {
            true => format!("{}#{image}", document.path),
            false => uri.to_owned(),
        };
        Ok((name, buffers::read(self.files, self.path, uri)?))
    }
}

fn image_number(document: &Document, texture: &::gltf::Texture) -> Option<usize> {
    let root = document.gltf.as_json();
    let source = root.textures.get(texture.index())?.source.value();
    (source < root.images.len()).then_some(source)
}

fn mean(picture: &Picture) -> [f32; 3] {
    let mut sums = [0.0_f64; 3];
    let mut add = |channel: usize, value: f64| {
        if let Some(sum) = sums.get_mut(channel) {
            *sum += value;
        }
    };
    match &picture.pixels {
        Pixels::Rgba8(bytes) => bytes
            .iter()
            .enumerate()
            .for_each(|(at, &byte)| add(at % 4, f64::from(byte) / 255.0)),
        Pixels::RgbaF32(values) => values
            .iter()
            .enumerate()
            .for_each(|(at, &value)| add(at % 4, f64::from(value))),
    }
    let count = f64::from(picture.width.max(1)) * f64::from(picture.height.max(1));
    sums.map(|sum| (sum / count) as f32)
}
