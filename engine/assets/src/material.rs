//! What a surface is made of.

use glam::Vec3;

use crate::{Reflection, TextureId, clamped};

/// A surface: Lambert's diffuse reflection, and highlights after one of the
/// [reflection models](crate::reflection). The default one, normalised
/// Blinn-Phong, every lighting pipeline carries exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name in the scene. Need not be unique.
    pub name: String,
    /// Diffuse reflectance, linear Rec. 709, each channel 0..1.
    pub base_color: Vec3,
    /// A picture that multiplies `base_color`.
    pub base_color_texture: Option<TextureId>,
    /// Specular reflectance at normal incidence, linear Rec. 709, each channel
    /// 0..1. Most non-metals are grey and near 0.04; metals have a colour here
    /// and a black `base_color`.
    pub specular: Vec3,
    /// The reflection model, and how sharp highlights are in it.
    pub reflection: Reflection,
    /// Light given off, linear Rec. 709, in the unit of the scene's radiance.
    pub emissive: Vec3,
    /// Directions in tangent space, stored as 0.5 + 0.5 n; green is up the
    /// picture.
    pub normal_texture: Option<TextureId>,
    /// Where set, points whose base colour's alpha is below it are not there.
    pub alpha_cutoff: Option<f32>,
    /// The share of what lies behind that it hides, 0..1; below 1 it is drawn after all that is
    /// opaque. Where [`Material::alpha_cutoff`] is not set, the base colour's alpha multiplies it
    /// in materials whose opacity is below 1.
    pub opacity: f32,
    /// Whether the back is seen too, with its normal turned to the viewer.
    pub two_sided: bool,
}

impl Material {
    /// Whether it lets light through.
    pub fn is_transparent(&self) -> bool {
        self.opacity < 1.0
    }

    /// Reflectance at normal incidence of what is no metal (glTF 2.0, appendix
    /// B.3.1).
    pub const DIELECTRIC: f32 = 0.04;

    /// Sets colours and highlights from the parameters of glTF and of MTL files
    /// with `Pr` and `Pm`: the share `metallic` of the surface mirrors `base`
    /// and scatters nothing; the rest scatters `base` and mirrors as
    /// [`Material::DIELECTRIC`] does. Highlights are those of GGX, with the
    /// square of `roughness` as its α (glTF 2.0, appendix B.2).
    ///
    /// `texture` is the mean colour of the texture that multiplies `base`:
    /// scattered light takes its colour point by point, but highlights have one
    /// colour all over. Unlike glTF's own model this one does not take what is
    /// mirrored from what is scattered.
    pub fn set_metallic_roughness(
        &mut self,
        base: Vec3,
        texture: Vec3,
        metallic: f32,
        roughness: f32,
    ) {
        let base = base.clamp(Vec3::ZERO, Vec3::ONE);
        let metallic = clamped(metallic, 0.0, 1.0);
        let metal = (base * texture).clamp(Vec3::ZERO, Vec3::ONE);
        self.base_color = base * (1.0 - metallic);
        self.specular = Vec3::splat(Self::DIELECTRIC).lerp(metal, metallic);
        let (least, most) = Reflection::ROUGHNESS_RANGE.into_inner();
        self.reflection = Reflection::Ggx {
            roughness: clamped(roughness * roughness, least, most),
        };
    }
}

impl Default for Material {
    /// A matt mid grey, as plastic.
    fn default() -> Self {
        Self {
            name: "default".to_owned(),
            base_color: Vec3::splat(0.5),
            base_color_texture: None,
            specular: Vec3::splat(Self::DIELECTRIC),
            reflection: Reflection::default(),
            emissive: Vec3::ZERO,
            normal_texture: None,
            alpha_cutoff: None,
            opacity: 1.0,
            two_sided: false,
        }
    }
}
