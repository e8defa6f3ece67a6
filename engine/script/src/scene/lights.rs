//! Lights.

use lightbench_world::glam::Vec3;
use lightbench_world::{Light, LightKind, Transform};

use super::data::Stage;
use super::entities::{getter, maker, method, setter, start};
use crate::api::{Api, Arguments, Mistake};
use crate::color::Color;

const POINT: &str = "Makes a light that shines from a point in all directions. Its intensity is in \
                     W/sr: what it lays on a surface 1 m away that faces it, in W/m².";
const SPOT: &str = "Makes a light that shines from a point into a cone. Its intensity is in W/sr.";
const DIRECTIONAL: &str = "Makes a light from infinitely far away, as the sun's. Its intensity is \
                           in W/m² on a surface that faces it.";
const AMBIENT: &str = "Makes a light from everywhere alike. Its intensity is in W/(m² sr).";

/// The height from which lights that were not turned shine down on the origin.
const HEIGHT: Vec3 = Vec3::new(0.0, 3.0, 0.0);

pub(super) fn register(api: &mut Api, stage: &Stage) {
    for (name, about, kind) in [
        ("point_light", POINT, LightKind::Point),
        ("spot_light", SPOT, LightKind::Spot),
        ("directional_light", DIRECTIONAL, LightKind::Directional),
        ("ambient_light", AMBIENT, LightKind::Ambient),
    ] {
        maker(api, stage, name, about, move |data, entity| {
            let transform = match kind {
                LightKind::Ambient => Transform::default(),
                _ => Transform::looking_at(HEIGHT, Vec3::ZERO, Vec3::Y),
            };
            start(data, entity, transform)?;
            data.insert(
                entity,
                Light {
                    kind,
                    ..Light::default()
                },
            )
        });
    }
    for form in ["color(red, green, blue)", "color(color)"] {
        method(
            api,
            stage,
            form,
            "The colour of a light.",
            |data, entity, a| {
                let color = a.color(0)?.as_vec3();
                let mut light: Light = data.get(entity, "light")?;
                light.color = color;
                data.insert(entity, light)
            },
        );
    }
    getter(
        api,
        stage,
        "color",
        "The colour of a light.",
        |data, entity| {
            let light: Light = data.get(entity, "light")?;
            Ok(Color(light.color.as_dvec3()))
        },
    );
    setter(api, stage, "color", |data, entity, a| {
        let color = a.color(0)?.as_vec3();
        let mut light: Light = data.get(entity, "light")?;
        light.color = color;
        data.insert(entity, light)
    });
    number(
        api,
        stage,
        "intensity",
        "strength",
        "The strength of a light: W/sr for points and spots, W/m² for directional and W/(m² sr) \
         for ambient lights.",
        &ALL,
        |a| a.number_in(0, 0.0, 1e9),
        |light| &mut light.intensity,
        |shown| shown,
    );
    number(
        api,
        stage,
        "range",
        "metres",
        "The distance at which a point or spot light has faded to nothing.",
        &BOUNDED,
        |a| a.number_in(0, 1e-3, 1e6),
        |light| &mut light.range,
        |shown| shown,
    );
    number(
        api,
        stage,
        "inner",
        "degrees",
        "The full angle of the cone in which a spot light is at full strength.",
        &[LightKind::Spot],
        |a| a.number_in(0, 0.0, 360.0).map(f64::to_radians),
        |light| &mut light.inner_angle,
        f64::to_degrees,
    );
    number(
        api,
        stage,
        "outer",
        "degrees",
        "The full angle of the cone outside which a spot light is dark.",
        &[LightKind::Spot],
        |a| a.number_in(0, 0.0, 360.0).map(f64::to_radians),
        |light| &mut light.outer_angle,
        f64::to_degrees,
    );
}

const ALL: [LightKind; 4] = [
    LightKind::Point,
    LightKind::Spot,
    LightKind::Directional,
    LightKind::Ambient,
];
const BOUNDED: [LightKind; 2] = [LightKind::Point, LightKind::Spot];

/// Registers a number of a light as method and property.
#[allow(clippy::too_many_arguments)] // One table row per number of a light.
fn number(
    api: &mut Api,
    stage: &Stage,
    name: &'static str,
    argument: &str,
    about: &'static str,
    kinds: &'static [LightKind],
    read: fn(&Arguments) -> Result<f64, Mistake>,
    field: fn(&mut Light) -> &mut f32,
    show: fn(f64) -> f64,
) {
    let change = move |data: &mut super::data::Data, entity, a: &Arguments| {
        let value = read(a)? as f32;
        let mut light: Light = data.get(entity, "light")?;
        if !kinds.contains(&light.kind) {
            return Err(Mistake::new(format!(
                "{} is {}, which has no `{name}`",
                data.called(entity),
                called(light.kind)
            )));
        }
        *field(&mut light) = value;
        data.insert(entity, light)
    };
    method(api, stage, &format!("{name}({argument})"), about, change);
    getter(api, stage, name, about, move |data, entity| {
        let mut light: Light = data.get(entity, "light")?;
        Ok(show(f64::from(*field(&mut light))))
    });
    setter(api, stage, name, change);
}

fn called(kind: LightKind) -> &'static str {
    match kind {
        LightKind::Point => "a point light",
        LightKind::Spot => "a spot light",
        LightKind::Directional => "a directional light",
        LightKind::Ambient => "an ambient light",
    }
}
