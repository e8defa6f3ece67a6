//! What a person can change of a material, value by value.

use lightbench_assets::{Material, MaterialId, Reflection, TextureId};
use lightbench_world::glam::Vec3;

use super::super::Who;
use super::naming;
use crate::scene::Scene;

/// One thing that a material says of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SurfaceField {
    /// [`Material::base_color`].
    Color,
    /// [`Material::base_color_texture`].
    Texture,
    /// [`Material::normal_texture`].
    Normals,
    /// [`Material::specular`].
    Specular,
    /// [`Material::reflection`], with all parameters of the model.
    Reflection,
    /// [`Material::emissive`].
    Emissive,
    /// [`Material::opacity`].
    Opacity,
    /// [`Material::alpha_cutoff`].
    Cutoff,
    /// [`Material::two_sided`].
    TwoSided,
}

/// What a [`SurfaceField`] holds.
#[derive(Clone, Debug, PartialEq)]
pub enum SurfaceValue {
    /// Linear Rec. 709.
    Color(Vec3),
    /// A texture, or none.
    Picture(Picture),
    /// A reflection model with its parameters.
    Reflection(Reflection),
    /// A share of 0 to 1.
    Share(f32),
    /// A share of 0 to 1 where it is in use.
    Cutoff(Option<f32>),
    /// On or off.
    Switch(bool),
}

/// A texture, in terms that hold over loads.
#[derive(Clone, Debug, PartialEq)]
pub enum Picture {
    /// No texture.
    None,
    /// The texture that a call makes, as in `picture("wall.png")`.
    Made(String),
    /// One of the scene's that no call with plain values makes.
    Known(Who),
}

impl SurfaceField {
    /// All, in the order of an editor.
    pub const ALL: [Self; 9] = [
        Self::Color,
        Self::Texture,
        Self::Normals,
        Self::Specular,
        Self::Reflection,
        Self::Emissive,
        Self::Opacity,
        Self::Cutoff,
        Self::TwoSided,
    ];

    /// In words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Color => "color",
            Self::Texture => "texture",
            Self::Normals => "normals",
            Self::Specular => "specular",
            Self::Reflection => "reflection",
            Self::Emissive => "emissive",
            Self::Opacity => "opacity",
            Self::Cutoff => "cutoff",
            Self::TwoSided => "two-sided",
        }
    }

    /// Gives one material what another one has in this field.
    pub(in super::super) fn copy(self, from: &Material, to: &mut Material) {
        match self {
            Self::Color => to.base_color = from.base_color,
            Self::Texture => to.base_color_texture = from.base_color_texture,
            Self::Normals => to.normal_texture = from.normal_texture,
            Self::Specular => to.specular = from.specular,
            Self::Reflection => to.reflection = from.reflection,
            Self::Emissive => to.emissive = from.emissive,
            Self::Opacity => to.opacity = from.opacity,
            Self::Cutoff => to.alpha_cutoff = from.alpha_cutoff,
            Self::TwoSided => to.two_sided = from.two_sided,
        }
    }

    /// Whether two materials have the same in this field.
    pub(in super::super) fn is_same(self, a: &Material, b: &Material) -> bool {
        match self {
            Self::Color => a.base_color == b.base_color,
            Self::Texture => a.base_color_texture == b.base_color_texture,
            Self::Normals => a.normal_texture == b.normal_texture,
            Self::Specular => a.specular == b.specular,
            Self::Reflection => a.reflection == b.reflection,
            Self::Emissive => a.emissive == b.emissive,
            Self::Opacity => a.opacity == b.opacity,
            Self::Cutoff => a.alpha_cutoff == b.alpha_cutoff,
            Self::TwoSided => a.two_sided == b.two_sided,
        }
    }

    /// Refuses what is no value of the field, as the functions of scripts do.
    pub(super) fn check(self, value: &SurfaceValue) -> Result<(), String> {
        let share = |number: f32| (0.0..=1.0).contains(&number);
        let fits = match (self, value) {
            (Self::Color | Self::Specular, SurfaceValue::Color(color)) => {
                if !color.to_array().into_iter().all(share) {
                    return Err(format!(
                        "the channels of a material's {} are 0 to 1: it can't give back more light \
                         than it gets",
                        self.name()
                    ));
                }
                true
            }
            (Self::Emissive, SurfaceValue::Color(color)) => {
                color.is_finite() && color.min_element() >= 0.0
            }
            (Self::Texture | Self::Normals, SurfaceValue::Picture(_)) => true,
            (Self::Reflection, SurfaceValue::Reflection(reflection)) => {
                let range = match reflection {
                    Reflection::BlinnPhong { .. } | Reflection::Phong { .. } => {
                        Reflection::POWER_RANGE
                    }
                    _ => Reflection::ROUGHNESS_RANGE,
                };
                if !reflection.lobe().iter().all(|part| range.contains(part)) {
                    return Err(format!(
                        "the parameters of {} are {} to {}",
                        reflection.model(),
                        range.start(),
                        range.end()
                    ));
                }
                true
            }
            (Self::Opacity, SurfaceValue::Share(number)) => share(*number),
            (Self::Cutoff, SurfaceValue::Cutoff(cutoff)) => cutoff.is_none_or(share),
            (Self::TwoSided, SurfaceValue::Switch(_)) => true,
            _ => false,
        };
        match fits {
            true => Ok(()),
            false => Err(format!("that is no value for {}", self.name())),
        }
    }

    /// Gives a material a value; `picture` is the texture where the value is one.
    pub(super) fn write(self, value: &SurfaceValue, picture: Option<TextureId>, to: &mut Material) {
        match (self, value) {
            (Self::Color, SurfaceValue::Color(color)) => to.base_color = *color,
            (Self::Specular, SurfaceValue::Color(color)) => to.specular = *color,
            (Self::Emissive, SurfaceValue::Color(color)) => to.emissive = *color,
            (Self::Texture, _) => to.base_color_texture = picture,
            (Self::Normals, _) => to.normal_texture = picture,
            (Self::Reflection, SurfaceValue::Reflection(reflection)) => {
                to.reflection = *reflection;
            }
            (Self::Opacity, SurfaceValue::Share(share)) => to.opacity = *share,
            (Self::Cutoff, SurfaceValue::Cutoff(cutoff)) => to.alpha_cutoff = *cutoff,
            (Self::TwoSided, SurfaceValue::Switch(on)) => to.two_sided = *on,
            // `check` has refused all others.
            _ => {}
        }
    }
}

impl Scene {
    /// What a material says of a surface; `None` for an id that belongs to no material.
    #[must_use]
    pub fn surface(&self, id: MaterialId, field: SurfaceField) -> Option<SurfaceValue> {
        self.assets
            .material(id)
            .map(|material| self.value_of(material, field))
    }

    pub(super) fn value_of(&self, material: &Material, field: SurfaceField) -> SurfaceValue {
        let picture = |id: Option<TextureId>| SurfaceValue::Picture(self.picture(id));
        match field {
            SurfaceField::Color => SurfaceValue::Color(material.base_color),
            SurfaceField::Texture => picture(material.base_color_texture),
            SurfaceField::Normals => picture(material.normal_texture),
            SurfaceField::Specular => SurfaceValue::Color(material.specular),
            SurfaceField::Reflection => SurfaceValue::Reflection(material.reflection),
            SurfaceField::Emissive => SurfaceValue::Color(material.emissive),
            SurfaceField::Opacity => SurfaceValue::Share(material.opacity),
            SurfaceField::Cutoff => SurfaceValue::Cutoff(material.alpha_cutoff),
            SurfaceField::TwoSided => SurfaceValue::Switch(material.two_sided),
        }
    }

    /// A texture of the scene, in terms that hold over loads.
    #[must_use]
    pub fn picture(&self, id: Option<TextureId>) -> Picture {
        let Some(id) = id else {
            return Picture::None;
        };
        let recipe = self.stage.lock().recipes.textures.get(&id).cloned();
        // The texture of a scene file is named by the file, and its own calls make it too.
        match recipe {
            Some(recipe) => Picture::Made(recipe),
            None => Picture::Known(naming::texture(&self.assets, id)),
        }
    }
}
