//! What a surface is made of.

use glam::Vec3;

use crate::TextureId;

/// A surface for the default model: Lambert diffuse and normalised
/// Blinn-Phong specular, which every lighting pipeline can carry exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name in the scene. Need not be unique.
    pub name: String,
    /// Diffuse reflectance, linear Rec. 709, each channel 0..1.
    pub base_color: Vec3,
    /// A picture that multiplies `base_color`.
    pub base_color_texture: Option<TextureId>,
    /// Reflectance at normal incidence, 0..1. Most non-metals are near 0.04.
    pub specular: f32,
    /// Blinn-Phong exponent, 1 (dull) to 1448 (near a mirror).
    pub power: f32,
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

    /// The range that [`Material::power`] may have: what eight bits hold as
    /// 2^(10.5 x) in the G-buffers of the pipelines.
    pub const POWER_RANGE: std::ops::RangeInclusive<f32> = 1.0..=1448.0;
}

impl Default for Material {
    /// A matt mid grey, as plastic.
    fn default() -> Self {
        Self {
            name: "default".to_owned(),
            base_color: Vec3::splat(0.5),
            base_color_texture: None,
            specular: 0.04,
            power: 32.0,
            emissive: Vec3::ZERO,
            normal_texture: None,
            alpha_cutoff: None,
            opacity: 1.0,
            two_sided: false,
        }
    }
}
