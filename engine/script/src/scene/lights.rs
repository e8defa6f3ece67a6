//! Lights.

use lightbench_world::glam::{DVec3, Vec3};
use lightbench_world::{ClipVolume, Light, LightKind, Transform};

use super::data::{Data, Stage};
use super::entities::{getter, maker, method, setter, start};
use super::shapes;
use crate::api::{Api, Arguments, Mistake};
use crate::color::Color;

const POINT: &str = "Makes a light that shines from a point in all directions. Its intensity is in \
                     W/sr: what it lays on a surface 1 m away that faces it, in W/m². It begins at \
                     (0, 3, 0) with intensity 1 and range 10; it is turned downward, and hands its \
                     rotation down to what is put below it.";
const SPOT: &str = "Makes a light that shines from a point into a cone. Its intensity is in W/sr. It begins at \
                    (0, 3, 0), shining down, with intensity 1, range 10 and cones of 30° and 45°.";
const DIRECTIONAL: &str = "Makes a light from infinitely far away, as the sun's. Its intensity is \
                           in W/m² on a surface that faces it. It begins at (0, 3, 0), shining down, \
                           with intensity 1.";
const AMBIENT: &str = "Makes a light from everywhere alike. Its intensity is in W/(m² sr), 1 unless \
                       told. It is drawn as the sky, too.";

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
    for form in ["clip_volume(mesh)", "clip_volume(mesh, offset)"] {
        method(
            api,
            stage,
            form,
            "Confines a light to the inside of a closed mesh, so that it does not shine through \
             walls. The mesh lies where the light is, moved by `offset` metres along the light's own \
             axes. Pipelines that draw lights as volumes with stencil can do it.",
            |data, entity, a| {
                let _: Light = data.get(entity, "light")?;
                let mesh = shapes::mesh_argument(data, a, 0)?;
                let offset = match a.len() {
                    2 => a.object::<DVec3>(1)?.as_vec3(),
                    _ => Vec3::ZERO,
                };
                let volume = ClipVolume {
                    mesh,
                    offset,
                    ..ClipVolume::default()
                };
                data.insert(entity, volume)
            },
        );
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
    for number in NUMBERS {
        register_number(api, stage, number);
    }
}

/// A number of a light, which scripts see as a method and as a property.
#[derive(Clone, Copy)]
struct Number {
    name: &'static str,
    form: &'static str,
    about: &'static str,
    /// Which lights have it.
    kinds: &'static [LightKind],
    range: (f64, f64),
    /// What one unit of the script is in the light.
    unit: f64,
    field: fn(&mut Light) -> &mut f32,
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;

const NUMBERS: [Number; 4] = [
    Number {
        name: "intensity",
        form: "intensity(strength)",
        about: "The strength of a light: W/sr for points and spots, W/m² for directional and \
                W/(m² sr) for ambient lights.",
        kinds: &[
            LightKind::Point,
            LightKind::Spot,
            LightKind::Directional,
            LightKind::Ambient,
        ],
        range: (0.0, 1e9),
        unit: 1.0,
        field: |light| &mut light.intensity,
    },
    Number {
        name: "range",
        form: "range(metres)",
        about: "The distance at which a point or spot light has faded to nothing.",
        kinds: &[LightKind::Point, LightKind::Spot],
        range: (1e-3, 1e6),
        unit: 1.0,
        field: |light| &mut light.range,
    },
    Number {
        name: "inner",
        form: "inner(degrees)",
        about: "The full angle of the cone in which a spot light is at full strength.",
        kinds: &[LightKind::Spot],
        range: (0.0, 360.0),
        unit: DEGREE,
        field: |light| &mut light.inner_angle,
    },
    Number {
        name: "outer",
        form: "outer(degrees)",
        about: "The full angle of the cone outside which a spot light is dark.",
        kinds: &[LightKind::Spot],
        range: (0.0, 360.0),
        unit: DEGREE,
        field: |light| &mut light.outer_angle,
    },
];

fn register_number(api: &mut Api, stage: &Stage, number: Number) {
    let change = move |data: &mut Data, entity, a: &Arguments| {
        let value = a.number_in(0, number.range.0, number.range.1)?;
        let mut light: Light = data.get(entity, "light")?;
        if !number.kinds.contains(&light.kind) {
            return Err(Mistake::new(format!(
                "{} is {}, which has no `{}`",
                data.called(entity),
                called(light.kind),
                number.name
            )));
        }
        *(number.field)(&mut light) = (value * number.unit) as f32;
        data.insert(entity, light)
    };
    method(api, stage, number.form, number.about, change);
    getter(
        api,
        stage,
        number.name,
        number.about,
        move |data, entity| {
            let mut light: Light = data.get(entity, "light")?;
            Ok(f64::from(*(number.field)(&mut light)) / number.unit)
        },
    );
    setter(api, stage, number.name, change);
}

fn called(kind: LightKind) -> &'static str {
    match kind {
        LightKind::Point => "a point light",
        LightKind::Spot => "a spot light",
        LightKind::Directional => "a directional light",
        LightKind::Ambient => "an ambient light",
    }
}
