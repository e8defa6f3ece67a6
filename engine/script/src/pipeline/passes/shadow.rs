//! What `shadow` passes draw.

use lightbench_render::description::{
    Faces, GivenView, Lens, PassKind, Shadow, ShadowLights, ShadowViews,
};

use lightbench_world::glam::DVec3;

use super::{Open, method, only_for};
use crate::api::{Api, Arguments, Mistake};

pub(super) fn register(api: &mut Api) {
    method(
        api,
        "views(lights)",
        "From where a shadow pass looks: `spot`, `point` or `directional` for the views of those \
         lights that reach what the camera sees. Each view fills one layer of the depth target, a \
         point light six (the sides +x, -x, +y, -y, +z, -z of a cube). Lights beyond the last \
         layer have no shadow and are counted.",
        |open, arguments| {
            let lights = arguments.choice(0, &ShadowLights::NAMES)?;
            of_shadow(open, "views", |shadow, _| {
                shadow.views = ShadowViews::Lights(lights)
            })
        },
    );
    method(
        api,
        "view_from(eye, target, degrees, near, far)",
        "Adds a view in perspective to a shadow pass: from a point to another, `degrees` wide, from \
         `near` to `far` metres away. The next view fills the next layer.",
        |open, arguments| {
            given(open, arguments, "view_from", || {
                let angle = arguments.number_in(2, 1.0, 170.0)?.to_radians();
                Ok(Lens::Perspective(angle as f32))
            })
        },
    );
    method(
        api,
        "box_from(eye, target, side, near, far)",
        "Adds a view along parallel lines to a shadow pass: `side` metres wide and high, from `near` \
         to `far` metres away.",
        |open, arguments| {
            given(open, arguments, "box_from", || {
                let side = arguments.number_in(2, 1e-3, 1e6)?;
                Ok(Lens::Orthographic(side as f32))
            })
        },
    );
    method(
        api,
        "near(metres)",
        "Distance from a spot or point light at which its shadow begins, in metres. Default: \
         `0.05`.",
        |open, arguments| {
            let near = arguments.number_in(0, 1e-4, 1e3)? as f32;
            of_shadow(open, "near", |shadow, _| shadow.near = near)
        },
    );
}

/// A pass without views yet.
pub(super) fn new() -> Shadow {
    Shadow {
        views: ShadowViews::Given(Vec::new()),
        faces: Faces::default(),
        near: Shadow::NEAR,
    }
}

fn given(
    open: Open,
    arguments: &Arguments,
    method: &str,
    lens: impl FnOnce() -> Result<Lens, Mistake>,
) -> Result<(), Mistake> {
    let point = |index| Ok::<_, Mistake>(arguments.object::<DVec3>(index)?.as_vec3().to_array());
    let (eye, target) = (point(0)?, point(1)?);
    let lens = lens()?;
    if eye == target {
        return Err(Mistake::new(
            "a view can't look at the point from which it looks",
        ));
    }
    let (near, far) = (
        arguments.number_in(3, 1e-4, 1e6)?,
        arguments.number_in(4, 1e-4, 1e6)?,
    );
    if near >= far {
        return Err(Mistake::new(format!(
            "the near plane, {near}, lies not before the far one, {far}"
        )));
    }
    of_shadow(open, method, |shadow, at| {
        let view = GivenView {
            at,
            eye,
            target,
            lens,
            near: near as f32,
            far: far as f32,
        };
        match &mut shadow.views {
            ShadowViews::Given(views) => views.push(view),
            other => *other = ShadowViews::Given(vec![view]),
        }
    })
}

fn of_shadow(
    open: Open,
    method: &str,
    change: impl FnOnce(&mut Shadow, lightbench_render::Place),
) -> Result<(), Mistake> {
    match &mut open.pass.kind {
        PassKind::Shadow(shadow) => {
            change(shadow, open.at);
            Ok(())
        }
        other => Err(only_for(method, "shadow", other)),
    }
}
