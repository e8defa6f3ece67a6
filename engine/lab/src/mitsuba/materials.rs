//! Materials: Lambert's reflection, textures, normal maps, holes and opacity.

use glam::{DVec3, Vec4};
use lightbench_assets::color::{encode_srgb8, encode_unorm8};
use lightbench_assets::images::{encode_exr, encode_png};
use lightbench_assets::{Material, MaterialId, ReflectionModel, Texture, TextureFormat, TextureId};

use super::{Export, is_black};
use crate::LabError;

/// The name by which shapes refer to a material.
pub fn id(material: MaterialId) -> String {
    format!("material-{}", material.0)
}

/// How many elements a material has around its innermost one.
type Depth = usize;

impl Export<'_> {
    /// Writes a material.
    pub(super) fn material(&mut self, number: MaterialId) -> Result<(), LabError> {
        let assets = self.assets;
        let Some(material) = assets.material(number) else {
            return Ok(());
        };
        let id = id(number);
        let texture = |id: Option<TextureId>| id.and_then(|id| assets.texture(id));
        let (color, normals) = (
            texture(material.base_color_texture),
            texture(material.normal_texture),
        );
        let mut depth: Depth = 0;
        self.mask(material, color.map(|texture| &**texture), &id, &mut depth)?;
        if material.two_sided {
            self.bsdf("twosided", &id, &mut depth);
        }
        if let Some(normals) = normals {
            self.bsdf("normalmap", &id, &mut depth);
            let file = self.picture(&format!("textures/{id}_normals"), normals, |pixel| pixel)?;
            self.bitmap("normalmap", &file, true);
        }
        self.bsdf("diffuse", &id, &mut depth);
        match color {
            Some(texture) => {
                let base = material.base_color.extend(1.0);
                let name = format!("textures/{id}");
                let file = self.picture(&name, texture, |pixel| (pixel * base).with_w(1.0))?;
                self.bitmap("reflectance", &file, false);
            }
            None => self
                .xml
                .color("reflectance", material.base_color.as_dvec3()),
        }
        for _ in 0..depth {
            self.xml.close();
        }
        self.highlights(material);
        Ok(())
    }

    /// Holes and opacity stand around everything else.
    fn mask(
        &mut self,
        material: &Material,
        color: Option<&Texture>,
        id: &str,
        depth: &mut Depth,
    ) -> Result<(), LabError> {
        let name = &material.name;
        if let (Some(cutoff), Some(texture)) = (material.alpha_cutoff, color) {
            self.leave_out(format!(
                "material `{name}`: the smooth outlines of its holes, which end at texels"
            ));
            self.bsdf("mask", id, depth);
            let hole =
                |pixel: Vec4| Vec4::splat(f32::from(u8::from(pixel.w >= cutoff))).with_w(1.0);
            let file = self.picture(&format!("textures/{id}_holes"), texture, hole)?;
            self.bitmap("opacity", &file, true);
        } else if material.is_transparent() {
            if color.is_some() {
                self.leave_out(format!("material `{name}`: the alpha of its texture"));
            }
            self.bsdf("mask", id, depth);
            self.xml.number("opacity", material.opacity.into());
        }
        Ok(())
    }

    /// Opens an element around what follows. The outermost has the name.
    fn bsdf(&mut self, kind: &str, id: &str, depth: &mut Depth) {
        if *depth == 0 {
            self.xml.open("bsdf", &[("type", kind), ("id", id)]);
        } else {
            self.xml.open("bsdf", &[("type", kind)]);
        }
        *depth += 1;
    }

    fn bitmap(&mut self, name: &str, file: &str, raw: bool) {
        self.xml
            .open("texture", &[("type", "bitmap"), ("name", name)]);
        self.xml.value("string", "filename", file);
        self.xml
            .value("boolean", "raw", if raw { "true" } else { "false" });
        self.xml.close();
    }

    /// Mitsuba has none of the models as they are here: its microfacets are dielectrics or metals.
    fn highlights(&mut self, material: &Material) {
        let model = material.reflection.model();
        let has_fresnel = matches!(model, ReflectionModel::Beckmann | ReflectionModel::Ggx);
        if !is_black(material.specular.as_dvec3()) || has_fresnel {
            self.leave_out(format!(
                "material `{}`: its highlights ({model})",
                material.name
            ));
        }
    }

    /// What makes a shape shine.
    pub(super) fn emission(&mut self, number: MaterialId) {
        let Some(material) = self.assets.material(number) else {
            return;
        };
        let radiance: DVec3 = material.emissive.as_dvec3();
        if is_black(radiance) {
            return;
        }
        if material.two_sided {
            let name = &material.name;
            self.left_out
                .insert(format!("material `{name}`: the light of its back"));
        }
        self.shines = true;
        self.xml.open("emitter", &[("type", "area")]);
        self.xml.color("radiance", radiance);
        self.xml.close();
    }

    /// Writes the finest level of a texture, changed point by point. Gives the file's name.
    fn picture(
        &mut self,
        name: &str,
        texture: &Texture,
        change: impl Fn(Vec4) -> Vec4,
    ) -> Result<String, LabError> {
        let (width, height) = (texture.width, texture.height);
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let pixels = places.map(|(x, y)| change(texture.pixel(0, x, y).unwrap_or_default()));
        let (name, bytes) = match texture.format {
            TextureFormat::Rgba16Float => {
                let values: Vec<f32> = pixels.flat_map(|pixel| pixel.to_array()).collect();
                let name = format!("{name}.exr");
                let bytes = encode_exr(&name, width, height, &values);
                (name, bytes)
            }
            format => {
                let code = |value| match format {
                    TextureFormat::Rgba8Srgb => encode_srgb8(value),
                    _ => encode_unorm8(value),
                };
                let values: Vec<u8> = pixels
                    .flat_map(|p| [code(p.x), code(p.y), code(p.z), encode_unorm8(p.w)])
                    .collect();
                let name = format!("{name}.png");
                let bytes = encode_png(&name, width, height, &values);
                (name, bytes)
            }
        };
        let bytes = bytes.map_err(|error| LabError::Encode {
            format: "picture",
            reason: error.to_string(),
        })?;
        self.write(&name, &bytes)
    }
}
