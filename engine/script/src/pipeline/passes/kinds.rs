//! What `geometry` and `lights` passes draw.

use lightbench_render::description::{
    DrawList, DrawOrder, Faces, Geometry, LightStencil, Lights, MAX_LAYERS, ObjectLights, PassKind,
    Repeat,
};

use super::{Open, method, only_for};
use crate::api::{Api, Mistake};

pub(super) fn register(api: &mut Api) {
    api.section("What is drawn");
    geometry(api);
    repeat(api);
    lights(api);
}

fn geometry(api: &mut Api) {
    method(
        api,
        "draws(list)",
        "Which objects are drawn: `opaque` ones that are in view, `transparent` ones that are in view \
         (materials with an opacity below 1), `all` that are in view, or `casters`: what is opaque, \
         in view or not.",
        |open, arguments| {
            let list = arguments.choice(0, &DrawList::NAMES)?;
            of_geometry(open, "draws", |geometry| geometry.list = list)
        },
    );
    method(
        api,
        "order(order)",
        "In which order objects are drawn: `state` groups equal meshes into one draw call, \
         `front_to_back` hides early, `back_to_front` is what blending needs.",
        |open, arguments| {
            let order = arguments.choice(0, &DrawOrder::NAMES)?;
            of_geometry(open, "order", |geometry| geometry.order = order)
        },
    );
    method(
        api,
        "faces(faces)",
        "Which faces are drawn: `material` (back faces only of two-sided materials), `front`, `back` \
         or `both`.",
        |open, arguments| {
            let faces = arguments.choice(0, &Faces::NAMES)?;
            match &mut open.pass.kind {
                PassKind::Shadow(shadow) => {
                    shadow.faces = faces;
                    Ok(())
                }
                _ => of_geometry(open, "faces", |geometry| geometry.faces = faces),
            }
        },
    );
    method(
        api,
        "pull_vertices(on)",
        "Draws without vertex buffers: the shader's own vertex stage gets `vertex_index` 0, 1, 2, … \
         three for each triangle, and fetches the vertices with `lightbench::mesh`.",
        |open, arguments| {
            let on = arguments.switch(0)?;
            of_geometry(open, "pull_vertices", |geometry| {
                geometry.pull_vertices = on
            })
        },
    );
    method(
        api,
        "layers(count)",
        "Spreads the objects over so many layers, such that those that overlap on the screen are in \
         different ones as far as there are enough. Shaders find an object's layer, from 0, in \
         `scene::drawn_objects`. Default: `0`.",
        |open, arguments| {
            let layers = arguments.whole(0, 0, MAX_LAYERS as i64)? as u32;
            of_geometry(open, "layers", |geometry| geometry.layers = layers)
        },
    );
    method(
        api,
        "gather_lights(on)",
        "Whether each object's list holds only the lights that reach its bounds. Else it holds all \
         of the scene. The same as `.object_lights` with `gathered` or `all`.",
        |open, arguments| {
            let on = arguments.switch(0)?;
            of_geometry(open, "gather_lights", |geometry| {
                geometry.lights = if on {
                    ObjectLights::Gathered
                } else {
                    ObjectLights::All
                };
            })
        },
    );
    method(
        api,
        "object_lights(which)",
        "Which lights each object's list holds: `all` of the scene, `gathered` (those that reach its \
         bounds, and those without a range), only `ambient` ones, or `nothing`.",
        |open, arguments| {
            let lights = arguments.choice(0, &ObjectLights::NAMES)?;
            of_geometry(open, "object_lights", |geometry| geometry.lights = lights)
        },
    );
}

fn repeat(api: &mut Api) {
    method(
        api,
        "repeat_for_lights(count)",
        "Draws the objects again for each group of that many lights, ambient ones left out; each \
         time only those that a light of the group reaches. Without it, objects are drawn once.",
        |open, arguments| {
            let lights = arguments.whole(0, 1, 1024)? as u32;
            of_geometry(open, "repeat_for_lights", |geometry| {
                geometry.repeat = Some(Repeat {
                    lights,
                    scissor: false,
                    stencil: false,
                });
            })
        },
    );
    method(
        api,
        "scissor(on)",
        "Limits each group of lights to its rectangle on the screen. Comes after \
         `.repeat_for_lights`.",
        |open, arguments| {
            let on = arguments.switch(0)?;
            of_repeat(open, "scissor", |repeat| repeat.scissor = on)
        },
    );
    method(
        api,
        "stencil_mask(on)",
        "Limits each light to the pixels inside its volume, by stencil. Comes after \
         `.repeat_for_lights`.",
        |open, arguments| {
            let on = arguments.switch(0)?;
            of_repeat(open, "stencil_mask", |repeat| repeat.stencil = on)
        },
    );
}

fn lights(api: &mut Api) {
    method(
        api,
        "volumes(on)",
        "Whether lights are drawn as volumes: a sphere for points and wide spots, a cone for spots up \
         to 120°. Else each covers the whole screen, as ambient and directional lights always do.",
        |open, arguments| {
            let on = arguments.switch(0)?;
            of_lights(open, "volumes", |lights| lights.volumes = on)
        },
    );
    method(
        api,
        "volume_stencil(scheme)",
        "How pixels inside a volume are found: `off` by one depth test against one side of it; by \
         marking stencil first, `two_pass` back faces behind the surface, then front faces before \
         it, `inverse` front faces behind the surface, which are then left out.",
        |open, arguments| {
            let stencil = arguments.choice(0, &LightStencil::NAMES)?;
            of_lights(open, "volume_stencil", |lights| lights.stencil = stencil)
        },
    );
    method(
        api,
        "threshold(share)",
        "Lights that look smaller than this share of the vertical field of view are drawn without \
         stencil, which would cost more than it saves. Default: `0.2`.",
        |open, arguments| {
            let share = arguments.number_in(0, 0.0, 10.0)? as f32;
            of_lights(open, "threshold", |lights| lights.threshold = share)
        },
    );
    method(
        api,
        "arrays(count)",
        "Spreads the lights over so many arrays of lights that do not overlap. Array n writes channel \
         n mod 4 of colour target n / 4 alone. With 0, all lights write all channels. Default: \
         `0`.",
        |open, arguments| {
            let arrays = arguments.whole(0, 0, 32)? as u32;
            of_lights(open, "arrays", |lights| lights.arrays = arrays)
        },
    );
    method(
        api,
        "bounded_only(on)",
        "Leaves out ambient and directional lights, which reach everything.",
        |open, arguments| {
            let on = arguments.switch(0)?;
            of_lights(open, "bounded_only", |lights| lights.bounded_only = on)
        },
    );
    method(
        api,
        "any_depth(on)",
        "Ignores depth: covers every pixel through which a light can be seen, for transparent objects \
         and multisampling.",
        |open, arguments| {
            let on = arguments.switch(0)?;
            of_lights(open, "any_depth", |lights| lights.any_depth = on)
        },
    );
}

fn of_geometry(
    open: Open,
    method: &str,
    change: impl FnOnce(&mut Geometry),
) -> Result<(), Mistake> {
    match &mut open.pass.kind {
        PassKind::Geometry(geometry) => {
            change(geometry);
            Ok(())
        }
        other => Err(only_for(method, "geometry", other)),
    }
}

fn of_repeat(open: Open, method: &str, change: impl FnOnce(&mut Repeat)) -> Result<(), Mistake> {
    match &mut open.pass.kind {
        PassKind::Geometry(Geometry {
            repeat: Some(repeat),
            ..
        }) => {
            change(repeat);
            Ok(())
        }
        PassKind::Geometry(_) => Err(Mistake::new(format!(
            "`.{method}` comes after `.repeat_for_lights`"
        ))),
        other => Err(only_for(method, "geometry", other)),
    }
}

fn of_lights(open: Open, method: &str, change: impl FnOnce(&mut Lights)) -> Result<(), Mistake> {
    match &mut open.pass.kind {
        PassKind::Lights(lights) => {
            change(lights);
            Ok(())
        }
        other => Err(only_for(method, "lights", other)),
    }
}
