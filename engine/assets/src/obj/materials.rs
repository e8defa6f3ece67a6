//! From MTL parameters to materials, and the pictures that they need.

use glam::Vec3;

use super::Warnings;
use super::clean::Clean;
use super::mtl::{Entry, find, parse_map};
use crate::files::Files;
use crate::{Material, Reflection, TextureId};

/// Luminance of linear Rec. 709.
const LUMINANCE: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

/// The reflectance of glass with a refractive index of 1.8: hardly any material
/// that is no metal and no gem reflects more at normal incidence.
const MAX_DIELECTRIC: f32 = 0.08;

/// The roughness of a material that has `Pm` but no `Pr`: half way, as in the
/// programs that write such files.
const DEFAULT_ROUGHNESS: f32 = 0.5;

/// A picture to load, and what becomes of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Request {
    pub(super) path: String,
    pub(super) kind: Kind,
}

/// What a picture is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    /// Colours, with the mask in another or the same picture.
    Color { mask: Option<String> },
    /// White with a mask.
    Mask,
    /// Normals, or heights of the given strength if the picture is grey.
    Normal { bump: f32 },
}

/// The materials that an OBJ file uses.
pub(super) struct Materials {
    /// Those that are in a library, in the order of their use.
    pub(super) materials: Vec<Material>,
    /// For each name that the file uses, the number of its material from 1, or
    /// 0 for the default one.
    pub(super) numbers: Vec<u32>,
    /// The pictures that they need; texture n is request n − 1.
    pub(super) requests: Vec<Request>,
}

impl Materials {
    /// Looks up the materials that the file uses.
    pub(super) fn new(
        files: &Files,
        library: &[Entry],
        clean: &Clean,
        warnings: &mut Warnings,
    ) -> Self {
        let mut materials = Self {
            materials: Vec::new(),
            numbers: Vec::new(),
            requests: Vec::new(),
        };
        let names_library = !clean.libraries.is_empty();
        for (name, line) in &clean.materials {
            // The latest of a name counts.
            match library.iter().rfind(|entry| entry.material.name == *name) {
                Some(entry) => {
                    let material = materials.convert(files, entry, warnings);
                    materials.materials.push(material);
                    materials.numbers.push(materials.materials.len() as u32);
                }
                None => {
                    // Without any library one warning is enough, and of one that
                    // is not there its reader has warned.
                    if !library.is_empty() {
                        let message = format!(
                            "the material `{name}` is in no material file; it is drawn in the default one"
                        );
                        warnings.add(*line, &message);
                    } else if !names_library {
                        warnings.add(*line, "materials are used, but no material file is named");
                    }
                    materials.numbers.push(0);
                }
            }
        }
        materials
    }

    fn convert(&mut self, files: &Files, entry: &Entry, warnings: &mut Warnings) -> Material {
        let source = &entry.material;
        let default = Material::default();
        let color =
            |value: Option<[f32; 3]>, default: Vec3| value.map_or(default, Vec3::from_array);
        let base_color = color(source.diffuse, default.base_color).clamp(Vec3::ZERO, Vec3::ONE);
        let specular = match source.specular.map(Vec3::from_array) {
            // A metal scatters nothing, and may mirror in a colour.
            Some(specular) if base_color.max_element() <= 0.01 => {
                specular.clamp(Vec3::ZERO, Vec3::ONE)
            }
            Some(specular) => Vec3::splat(specular.dot(LUMINANCE).clamp(0.0, MAX_DIELECTRIC)),
            None => default.specular,
        };
        let (low, high) = Reflection::POWER_RANGE.into_inner();
        let mut material = Material {
            name: source.name.clone(),
            base_color,
            specular,
            emissive: color(source.emissive, Vec3::ZERO).max(Vec3::ZERO),
            ..default
        };
        if let Some(power) = source.shininess {
            material.reflection = Reflection::BlinnPhong {
                power: power.clamp(low, high),
            };
        }

        let mut look_up = |map_text: &str| {
            let map = parse_map(map_text);
            let found = find(files, &entry.library, map.path);
            if found.is_none() {
                let message = format!(
                    "the picture `{}` is not there; put it beside the model",
                    map.path
                );
                let line = entry.map_lines.get(map_text).copied();
                warnings.add_in(&files.display(&entry.library), line, &message);
            }
            (found, map.bump)
        };
        let mask = source
            .dissolve_texture
            .as_ref()
            .and_then(|map| look_up(map).0);
        if mask.is_some() {
            material.alpha_cutoff = Some(0.5);
            material.two_sided = true;
        }
        material.base_color_texture = match (&source.diffuse_texture, mask) {
            (Some(map), mask) => match look_up(map).0 {
                Some(path) => Some(self.request(path, Kind::Color { mask })),
                None => Some(TextureId::PLACEHOLDER),
            },
            (None, Some(mask)) => Some(self.request(mask, Kind::Mask)),
            (None, None) => None,
        };
        let normal = source
            .unknown_param
            .get("norm")
            .or(source.normal_texture.as_ref());
        if let Some((Some(path), bump)) = normal.map(|map| look_up(map)) {
            material.normal_texture = Some(self.request(path, Kind::Normal { bump }));
        }
        let of_pbr = |key: &str| source.unknown_param.get(key)?.trim().parse::<f32>().ok();
        let (roughness, metallic) = (of_pbr("pr"), of_pbr("pm"));
        if roughness.is_some() || metallic.is_some() {
            let metallic = metallic.unwrap_or(0.0);
            if metallic > 0.0 && material.base_color_texture.is_some() {
                let name = &source.name;
                let message = format!(
                    "highlights of the metal `{name}` have the colour of its `Kd`, without its texture"
                );
                warnings.add_in(&files.display(&entry.library), None, &message);
            }
            let roughness = roughness.unwrap_or(DEFAULT_ROUGHNESS);
            material.set_metallic_roughness(base_color, Vec3::ONE, metallic, roughness);
        }
        if material.alpha_cutoff.is_none() {
            material.opacity = source.dissolve.unwrap_or(1.0).clamp(0.0, 1.0);
        }
        material
    }

    /// The texture of a picture, the same for the same use.
    fn request(&mut self, path: String, kind: Kind) -> TextureId {
        let request = Request { path, kind };
        let known = self.requests.iter().position(|other| *other == request);
        let index = known.unwrap_or_else(|| {
            self.requests.push(request);
            self.requests.len() - 1
        });
        TextureId(index as u32 + 1)
    }
}
