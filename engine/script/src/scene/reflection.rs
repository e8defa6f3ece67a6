//! The reflection model of a material, and its parameters.

use std::ops::RangeInclusive;
use std::sync::atomic::Ordering;

use lightbench_assets::{Reflection, ReflectionModel};
use lightbench_world::glam::Vec3;

use super::data::Stage;
use super::materials::method;
use crate::api::{Api, Arguments, Mistake};

pub(super) fn register(api: &mut Api, stage: &Stage) {
    for form in ["specular(reflectance)", "specular(red, green, blue)"] {
        method(
            api,
            stage,
            form,
            "The share of light that it mirrors head-on, 0 to 1: a number, near 0.04 for most \
             non-metals, or a color for metals.",
            |_, surface, _, a| {
                surface.specular = specular(a)?;
                Ok(())
            },
        );
    }
    power_and_roughness(api, stage);
    models(api, stage);
}

/// A number for all channels, or a colour.
fn specular(a: &Arguments) -> Result<Vec3, Mistake> {
    if a.is_number(0) && a.len() == 1 {
        return Ok(Vec3::splat(a.number_in(0, 0.0, 1.0)? as f32));
    }
    let color = a.color(0)?.as_vec3();
    if color.max_element() > 1.0 {
        return Err(
            Mistake::new("a surface can't mirror more light than it gets")
                .with_hint("the channels of a material's specular color are 0 to 1"),
        );
    }
    Ok(color)
}

fn power_and_roughness(api: &mut Api, stage: &Stage) {
    method(
        api,
        stage,
        "power(exponent)",
        "How sharp the highlights of blinn_phong and phong are: 1 (dull) to 1448 (near a mirror).",
        |_, surface, material, a| {
            let exponent = power(a, 0)?;
            match &mut surface.reflection {
                Reflection::BlinnPhong { power } | Reflection::Phong { power } => *power = exponent,
                other => return Err(takes_no("power", other.model())),
            }
            material.has_power.store(true, Ordering::Relaxed);
            Ok(())
        },
    );
    method(
        api,
        stage,
        "roughness(roughness)",
        "How dull the highlights of beckmann and ggx are: 0.0263 (near a mirror) to 1 (dull).",
        |_, surface, _, a| {
            let width = roughness(a, 0)?;
            match &mut surface.reflection {
                Reflection::Beckmann { roughness } | Reflection::Ggx { roughness } => {
                    *roughness = width;
                }
                other => return Err(takes_no("roughness", other.model())),
            }
            Ok(())
        },
    );
}

/// The calls that choose a model, each with all of its parameters.
fn models(api: &mut Api, stage: &Stage) {
    type Make = fn(&Arguments) -> Result<Reflection, Mistake>;
    let forms: [(&str, &str, Make); 5] = [
        (
            "blinn_phong(power)",
            "Gives it the default reflection model, normalised Blinn-Phong. `power` is 1 (dull) to \
             1448 (near a mirror).",
            |a| power(a, 0).map(|power| Reflection::BlinnPhong { power }),
        ),
        (
            "phong(power)",
            "Gives it normalised Phong reflection. `power` is 1 to 1448; a quarter of Blinn-Phong's \
             looks about as sharp.",
            |a| power(a, 0).map(|power| Reflection::Phong { power }),
        ),
        (
            "beckmann(roughness)",
            "Gives it Cook-Torrance reflection with Beckmann's distribution. `roughness` is the \
             root-mean-square slope of its facets, 0.0263 (near a mirror) to 1 (dull).",
            |a| roughness(a, 0).map(|roughness| Reflection::Beckmann { roughness }),
        ),
        (
            "ggx(roughness)",
            "Gives it Cook-Torrance reflection with the GGX distribution. `roughness` is its width, \
             0.0263 (near a mirror) to 1 (dull): the square of glTF's.",
            |a| roughness(a, 0).map(|roughness| Reflection::Ggx { roughness }),
        ),
        (
            "ward(along, across)",
            "Gives it Ward's reflection, as of brushed metal: roughness along the texture's u and \
             across it, each 0.0263 (near a mirror) to 1 (dull).",
            |a| {
                Ok(Reflection::Ward {
                    along: roughness(a, 0)?,
                    across: roughness(a, 1)?,
                })
            },
        ),
    ];
    for (form, about, make) in forms {
        method(api, stage, form, about, move |_, surface, material, a| {
            let reflection = make(a)?;
            let model = reflection.model();
            let takes_power = matches!(model, ReflectionModel::BlinnPhong | ReflectionModel::Phong);
            if !takes_power && material.has_power.load(Ordering::Relaxed) {
                return Err(takes_no("power", model).with_hint("leave out .power"));
            }
            surface.reflection = reflection;
            // Its parameters are those of this call alone.
            material.has_power.store(false, Ordering::Relaxed);
            Ok(())
        });
    }
}

/// What a model does not take, and what it takes instead.
fn takes_no(parameter: &str, model: ReflectionModel) -> Mistake {
    let takes = match model {
        ReflectionModel::BlinnPhong | ReflectionModel::Phong => "`power`",
        ReflectionModel::Beckmann | ReflectionModel::Ggx => "`roughness`",
        ReflectionModel::Ward => "a roughness `along` the tangent and one `across` it",
    };
    let call = match model {
        ReflectionModel::BlinnPhong => ".power(32)",
        ReflectionModel::Phong => ".phong(32)",
        ReflectionModel::Beckmann => ".beckmann(0.25)",
        ReflectionModel::Ggx => ".ggx(0.25)",
        ReflectionModel::Ward => ".ward(0.4, 0.1)",
    };
    Mistake::new(format!(
        "a `{model}` material takes {takes}, not `{parameter}`"
    ))
    .with_hint(format!("it is written as in `{call}`"))
}

fn power(a: &Arguments, index: usize) -> Result<f32, Mistake> {
    in_range(a, index, Reflection::POWER_RANGE)
}

fn roughness(a: &Arguments, index: usize) -> Result<f32, Mistake> {
    in_range(a, index, Reflection::ROUGHNESS_RANGE)
}

/// A number in a range of single precision, whose ends count as they are written: `0.0263` is not
/// quite the same number in double precision.
fn in_range(a: &Arguments, index: usize, range: RangeInclusive<f32>) -> Result<f32, Mistake> {
    let number = a.number(index)? as f32;
    if range.contains(&number) {
        return Ok(number);
    }
    let written = |end: &f32| end.to_string().parse().unwrap_or(f64::from(*end));
    a.number_in(index, written(range.start()), written(range.end()))
        .map(|number| number as f32)
}
