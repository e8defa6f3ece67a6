//! Cameras.

use lightbench_world::glam::Vec3;
use lightbench_world::{Camera, Entity, Transform};

use super::bounds::{Extent, extent, extent_of_all};
use super::data::{Data, Stage};
use super::entities::{getter, maker, method, setter, start};
use crate::api::{Api, Mistake};

/// Where a camera stands that was not placed: eye level, looking at the origin.
const START: Vec3 = Vec3::new(0.0, 1.6, 5.0);

pub(super) fn register(api: &mut Api, stage: &Stage) {
    maker(
        api,
        stage,
        "camera",
        "Makes a camera. The view is drawn from the first one. It begins at (0, 1.6, 5), looking at the origin, \
         with an angle of view of 60°, its near plane at 0.1 m and its far plane at 1000 m.",
        |data, entity| {
            start(
                data,
                entity,
                Transform::looking_at(START, Vec3::ZERO, Vec3::Y),
            )?;
            data.insert(entity, Camera::default())
        },
    );
    method(
        api,
        stage,
        "fov(degrees)",
        "The full vertical angle of view, 1 to 170 degrees.",
        |data, entity, a| {
            let angle = a.number_in(0, 1.0, 170.0)?.to_radians() as f32;
            change(data, entity, |camera| camera.fov_y = angle)
        },
    );
    getter(
        api,
        stage,
        "fov",
        "The full vertical angle of view in degrees.",
        |data, entity| {
            let camera: Camera = data.get(entity, "camera")?;
            Ok(f64::from(camera.fov_y).to_degrees())
        },
    );
    setter(api, stage, "fov", |data, entity, a| {
        let angle = a.number_in(0, 1.0, 170.0)?.to_radians() as f32;
        change(data, entity, |camera| camera.fov_y = angle)
    });
    method(
        api,
        stage,
        "near(metres)",
        "The distance of the near plane, in front of which nothing is drawn.",
        |data, entity, a| {
            let near = a.number_in(0, 1e-6, 1e6)? as f32;
            change(data, entity, |camera| camera.near = near)
        },
    );
    method(
        api,
        stage,
        "far(metres)",
        "The distance of the far plane, behind which nothing is drawn.",
        |data, entity, a| {
            let far = a.number_in(0, 1e-6, 1e9)? as f32;
            change(data, entity, |camera| camera.far = far)
        },
    );
    method(
        api,
        stage,
        "endless()",
        "Puts the far plane infinitely far away.",
        |data, entity, _| change(data, entity, |camera| camera.far = f32::INFINITY),
    );
    method(
        api,
        stage,
        "active(on)",
        "Whether the view may be drawn from this camera. The first active one wins.",
        |data, entity, a| {
            let on = a.switch(0)?;
            change(data, entity, |camera| camera.active = on)
        },
    );
    method(
        api,
        stage,
        "frame(entity)",
        "Moves the camera along its line of sight until the entity, with everything below it, \
         fills the view, and fits the near and far planes to it.",
        |data, entity, a| {
            let subject: Entity = a.object(0)?;
            data.check(subject)?;
            let extent = extent(&data.world, &data.assets, subject).ok_or_else(|| {
                Mistake::new(format!("{} has no mesh to frame", data.called(subject)))
            })?;
            frame(data, entity, extent)
        },
    );
}

/// Changes a camera, whose near plane stays before its far plane.
pub(super) fn change(
    data: &mut Data,
    entity: Entity,
    edit: impl FnOnce(&mut Camera),
) -> Result<(), Mistake> {
    let mut camera: Camera = data.get(entity, "camera")?;
    edit(&mut camera);
    if camera.near >= camera.far {
        // The order of the calls must not matter: a small far plane pulls the near one along.
        camera.near = camera.far * 1e-3;
    }
    data.insert(entity, camera)
}

fn frame(data: &mut Data, entity: Entity, extent: Extent) -> Result<(), Mistake> {
    let mut camera: Camera = data.get(entity, "camera")?;
    let transform = data.transform(entity)?;
    let back = transform.rotation * Vec3::Z;
    let radius = extent.radius().max(1e-6);
    // The sphere touches the upper and the lower edge of the view, with a tenth to spare.
    let distance = 1.1 * radius / (camera.fov_y * 0.5).sin();
    let center = extent.center();
    camera.near = (distance - radius * 2.0).max(distance * 1e-2);
    camera.far = (distance + radius) * 20.0;
    data.insert(entity, camera)?;
    data.aims.insert(entity, center);
    data.place(entity, |t| t.translation = center + back * distance)
}

/// A camera for a scene that made none: all meshes, seen from the front and above.
pub(super) fn add_default(data: &mut Data) -> Result<Entity, Mistake> {
    let entity = data.spawn("camera")?;
    let eye = Vec3::new(0.6, 0.5, 1.0);
    start(
        data,
        entity,
        Transform::looking_at(eye, Vec3::ZERO, Vec3::Y),
    )?;
    data.insert(entity, Camera::default())?;
    if let Some(extent) = extent_of_all(&data.world, &data.assets) {
        frame(data, entity, extent)?;
    }
    Ok(entity)
}
