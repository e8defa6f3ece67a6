//! Materials.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use lightbench_assets::{Material as Surface, MaterialId};
use lightbench_world::glam::Vec3;

use super::data::{Data, Stage};
use super::textures::Pattern;
use crate::api::{Api, Arguments, Mistake, ScriptType};

/// A material, as scripts hold it.
#[derive(Clone, Debug)]
pub(super) struct Material {
    pub(super) id: MaterialId,
    /// Whether the script has chosen a colour. A textured material without one shows the texture's
    /// colours as they are.
    pub(super) colored: Arc<AtomicBool>,
    /// Whether it has been given a power apart from the call that chose its reflection model.
    pub(super) has_power: Arc<AtomicBool>,
}

impl ScriptType for Material {
    const NAME: &'static str = "material";
}

impl Material {
    /// The material of an id, which is the same however often it is asked for. Of one that no script
    /// made, the colour counts as chosen.
    pub(super) fn of(data: &mut Data, id: MaterialId) -> Self {
        let known = data.materials.entry(id).or_insert_with(|| Self {
            id,
            colored: Arc::new(AtomicBool::new(true)),
            has_power: Arc::default(),
        });
        known.clone()
    }
}

/// Registers a method of a material that gives the material back.
pub(super) fn method(
    api: &mut Api,
    stage: &Stage,
    form: &str,
    about: &'static str,
    change: impl Fn(&mut Data, &mut Surface, &Material, &Arguments) -> Result<(), Mistake>
    + Send
    + Sync
    + 'static,
) {
    let stage = stage.clone();
    api.method(form, about, move |material: Material, a| {
        let mut data = stage.lock();
        let Some(mut surface) = data.assets.material(material.id).cloned() else {
            return Err(Mistake::new("the material is of another scene"));
        };
        change(&mut data, &mut surface, &material, a)?;
        let replaced = data.assets.replace_material(material.id, surface);
        replaced.map_err(|error| Mistake::new(error.to_string()))?;
        Ok(material)
    });
}

pub(super) fn register(api: &mut Api, stage: &Stage) {
    api.object::<Material>();
    let made = stage.clone();
    api.function(
        "material(name)",
        "Makes a material: a matt mid grey, until its methods say more.",
        move |a| {
            let name = a.text(0)?;
            let mut data = made.lock();
            let id = data.assets.add_material(Surface {
                name,
                ..Surface::default()
            });
            let material = Material {
                id,
                colored: Arc::default(),
                has_power: Arc::default(),
            };
            data.materials.insert(id, material.clone());
            Ok(material)
        },
    );
    for form in ["color(red, green, blue)", "color(color)"] {
        method(
            api,
            stage,
            form,
            "The share of light that it scatters, each channel 0 to 1. Multiplies a texture.",
            |_, surface, material, a| {
                let color = a.color(0)?.as_vec3();
                if color.max_element() > 1.0 {
                    return Err(
                        Mistake::new("a surface can't scatter more light than it gets")
                            .with_hint("the channels of a material's colour are 0 to 1"),
                    );
                }
                surface.base_color = color;
                material.colored.store(true, Ordering::Relaxed);
                Ok(())
            },
        );
    }
    super::reflection::register(api, stage);
    method(
        api,
        stage,
        "opacity(share)",
        "The share of what lies behind that it hides, 0 to 1. Below 1 it is drawn after all that is \
         opaque.",
        |_, surface, _, a| {
            surface.opacity = a.number_in(0, 0.0, 1.0)? as f32;
            Ok(())
        },
    );
    for form in ["emissive(red, green, blue)", "emissive(color)"] {
        method(
            api,
            stage,
            form,
            "The light that it gives off, as radiance. It lights nothing else.",
            |_, surface, _, a| {
                surface.emissive = a.color(0)?.as_vec3();
                Ok(())
            },
        );
    }
    textures(api, stage);
    method(
        api,
        stage,
        "cutoff(alpha)",
        "Points whose texture has less alpha are holes, 0 to 1.",
        |_, surface, _, a| {
            surface.alpha_cutoff = Some(a.number_in(0, 0.0, 1.0)? as f32);
            Ok(())
        },
    );
    for form in ["two_sided()", "two_sided(on)"] {
        method(
            api,
            stage,
            form,
            "Whether the back is seen too, as that of cloth and leaves.",
            |_, surface, _, a| {
                surface.two_sided = a.len() == 0 || a.switch(0)?;
                Ok(())
            },
        );
    }
}

fn textures(api: &mut Api, stage: &Stage) {
    let show = |surface: &mut Surface, material: &Material| {
        if !material.colored.load(Ordering::Relaxed) {
            surface.base_color = Vec3::ONE;
        }
    };
    method(
        api,
        stage,
        "texture(texture)",
        "The texture of its colours.",
        move |data, surface, material, a| {
            let pattern: Pattern = a.object(0)?;
            surface.base_color_texture = Some(pattern.color(data)?);
            show(surface, material);
            Ok(())
        },
    );
    method(
        api,
        stage,
        "normals(texture)",
        "The texture of its bumps: the normals of a painted texture, or a picture of normals.",
        |data, surface, _, a| {
            let pattern: Pattern = a.object(0)?;
            surface.normal_texture = Some(pattern.normal(data)?);
            Ok(())
        },
    );
    method(
        api,
        stage,
        "surface(texture)",
        "The texture of its colours, with the bumps that belong to it if there are any.",
        move |data, surface, material, a| {
            let pattern: Pattern = a.object(0)?;
            surface.base_color_texture = Some(pattern.color(data)?);
            surface.normal_texture = pattern.own_normal(data)?;
            show(surface, material);
            Ok(())
        },
    );
}
