//! How assets were made, in the words of scripts: what scene files keep of them.

use std::collections::{BTreeSet, HashMap};

use lightbench_assets::{Material, MeshId, Reflection, TextureId};
use lightbench_world::glam::Vec3;

use super::faces::Corners;
use super::overlays::{spell_point, spell_single};
use crate::api::{Arguments, spell_text};

/// The calls that made each mesh and each texture. Materials are their own numbers.
#[derive(Clone, Debug, Default)]
pub(super) struct Recipes {
    pub(super) meshes: HashMap<MeshId, MeshRecipe>,
    pub(super) textures: HashMap<TextureId, String>,
    /// Textures that are the normals that belong to a call's colours, or a picture taken as such.
    pub(super) normals: BTreeSet<TextureId>,
}

impl Recipes {
    /// The first texture that the same calls have made, of colours or of normals.
    pub(super) fn texture(&self, calls: &str, normals: bool) -> Option<TextureId> {
        // A model's picture is what it is taken for.
        let either = calls.starts_with("model_texture(");
        let same = self.textures.iter().filter(|(id, known)| {
            *known == calls && (either || self.normals.contains(id) == normals)
        });
        same.map(|(id, _)| *id).min()
    }
}

/// The calls that made a mesh.
#[derive(Clone, Debug)]
pub(super) enum MeshRecipe {
    /// As a script would write them.
    Calls(String),
    /// A call with so many numbers that it is spelled only when it is written, and calls behind it.
    Faces(Corners, String),
}

impl MeshRecipe {
    /// The calls as a script would write them.
    pub(super) fn spelled(&self) -> String {
        match self {
            Self::Calls(calls) => calls.clone(),
            Self::Faces(corners, calls) => format!("{}{calls}", corners.spelled()),
        }
    }

    /// With one more call behind it.
    pub(super) fn then(self, call: &Arguments) -> Option<Self> {
        let call = call.spelled()?;
        Some(match self {
            Self::Calls(calls) => Self::Calls(format!("{calls}.{call}")),
            Self::Faces(corners, calls) => Self::Faces(corners, format!("{calls}.{call}")),
        })
    }
}

/// A recipe with one more call behind it.
pub(super) fn then(recipe: Option<String>, call: &Arguments) -> Option<String> {
    Some(format!("{}.{}", recipe?, call.spelled()?))
}

/// The calls that make a material. `texture` gives those that make a texture.
pub(super) fn material(
    material: &Material,
    texture: impl Fn(TextureId) -> Option<String>,
) -> Option<String> {
    let Material {
        name,
        base_color,
        base_color_texture,
        specular,
        reflection,
        emissive,
        normal_texture,
        alpha_cutoff,
        opacity,
        two_sided,
    } = material;
    let mut recipe = format!(
        "material({}).{}",
        spell_text(name),
        call("color", *base_color),
    );
    if *specular == Vec3::splat(specular.x) {
        recipe += &format!(".specular({})", spell_single(specular.x));
    } else {
        recipe += &format!(".{}", call("specular", *specular));
    }
    recipe += &match *reflection {
        Reflection::BlinnPhong { power } => format!(".power({})", spell_single(power)),
        Reflection::Phong { power } => format!(".phong({})", spell_single(power)),
        Reflection::Beckmann { roughness } => format!(".beckmann({})", spell_single(roughness)),
        Reflection::Ggx { roughness } => format!(".ggx({})", spell_single(roughness)),
        Reflection::Ward { along, across } => {
            format!(".ward({}, {})", spell_single(along), spell_single(across))
        }
    };
    if *emissive != Vec3::ZERO {
        recipe += &format!(".{}", call("emissive", *emissive));
    }
    for (call, id) in [("texture", base_color_texture), ("normals", normal_texture)] {
        if let Some(id) = id {
            recipe += &format!(".{call}({})", texture(*id)?);
        }
    }
    if let Some(cutoff) = alpha_cutoff {
        recipe += &format!(".cutoff({})", spell_single(*cutoff));
    }
    if *opacity < 1.0 {
        recipe += &format!(".opacity({})", spell_single(*opacity));
    }
    if *two_sided {
        recipe += ".two_sided()";
    }
    Some(recipe)
}

/// A call with three numbers of 32 bits.
fn call(name: &str, numbers: Vec3) -> String {
    format!("{name}({})", spell_point(numbers))
}
