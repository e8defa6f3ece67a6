//! Lights and cameras over the picture, and how far the chosen ones reach.

use egui::emath::GuiRounding;
use egui::{Color32, Painter, Pos2, Stroke};
use lightbench::render::View;
use lightbench::script::Scene;
use lightbench::world::glam::Vec3;
use lightbench::world::{Camera, Entity, Light, LightKind, WorldMatrix};

use super::icon::{Icon, Icons, RADIUS};
use super::shapes::{circle, line};
use crate::ui::lens::Lens;
use crate::ui::workbench::selection::Selection;
use crate::ui::workbench::structure::is_locked;

/// Icons that are drawn; a scene may have a hundred thousand lights.
const MOST: usize = 2000;

/// How far the cone of a camera is drawn at most, metres.
const CAMERA_REACH: f32 = 3.0;

/// Where an entity is.
pub fn place_of(scene: &Scene, entity: Entity) -> Option<Vec3> {
    let matrix: WorldMatrix = scene.world.get(entity)?;
    Some(matrix.matrix.translation.into())
}

/// The entities that have icons, with their places on the screen.
fn all<'a>(scene: &'a Scene, lens: &'a Lens) -> impl Iterator<Item = (Entity, bool, Pos2)> + 'a {
    let lights = scene.world.columns::<Light>().entities().iter();
    let cameras = scene.world.columns::<Camera>().entities().iter();
    let both = lights
        .map(|light| (*light, true))
        .chain(cameras.map(|camera| (*camera, false)));
    both.filter_map(|(entity, is_light)| {
        let at = lens.point(place_of(scene, entity)?)?;
        lens.rect.contains(at).then_some((entity, is_light, at))
    })
    .take(MOST)
}

/// The icon under a place of the screen, of what is not locked.
pub fn icon_at(scene: &Scene, lens: &Lens, at: Pos2) -> Option<Entity> {
    all(scene, lens)
        .filter(|(entity, ..)| !is_locked(&scene.world, *entity))
        .map(|(entity, _, place)| (entity, place.distance(at)))
        .filter(|(_, distance)| *distance <= RADIUS + 2.0)
        .min_by(|(_, a), (_, b)| a.total_cmp(b))
        .map(|(entity, _)| entity)
}

/// Draws the icons.
pub fn show(painter: &Painter, lens: &Lens, scene: &Scene, selection: &Selection) {
    let ctx = painter.ctx();
    let mut lights = Icons::new(ctx, Icon::Light);
    let mut cameras = Icons::new(ctx, Icon::Camera);
    for (entity, is_light, at) in all(scene, lens) {
        let color = if selection.contains(entity) {
            Color32::from_rgb(255, 190, 80)
        } else {
            Color32::from_gray(235)
        };
        let icons = match is_light {
            true => &mut lights,
            false => &mut cameras,
        };
        icons.add(at.round_to_pixels(ctx.pixels_per_point()), color);
    }
    lights.draw(painter);
    cameras.draw(painter);
}

/// Draws how far a light shines, or what a camera sees.
pub fn reach(painter: &Painter, lens: &Lens, stroke: Stroke, scene: &Scene, entity: Entity) {
    if let Some(light) = scene.world.get::<Light>(entity) {
        light_reach(painter, lens, stroke, scene, entity, light);
    }
    if scene.world.has::<Camera>(entity) {
        camera_reach(painter, lens, stroke, scene, entity);
    }
}

fn light_reach(
    painter: &Painter,
    lens: &Lens,
    stroke: Stroke,
    scene: &Scene,
    entity: Entity,
    light: Light,
) {
    let Some(matrix) = scene.world.get::<WorldMatrix>(entity) else {
        return;
    };
    let at: Vec3 = matrix.matrix.translation.into();
    let z: Vec3 = matrix.matrix.matrix3.z_axis.into();
    let ahead = -z.normalize_or(Vec3::Z);
    match light.kind {
        LightKind::Point => {
            for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
                circle(painter, lens, stroke, at, axis, light.range);
            }
        }
        LightKind::Spot => {
            for angle in [light.inner_angle, light.outer_angle] {
                let (sin, cos) = (angle * 0.5).sin_cos();
                let center = at + ahead * (light.range * cos);
                circle(painter, lens, stroke, center, ahead, light.range * sin);
            }
            let (sin, cos) = (light.outer_angle * 0.5).sin_cos();
            let (u, v) = ahead.any_orthonormal_pair();
            for aside in [u, -u, v, -v] {
                let edge = at + (ahead * cos + aside * sin) * light.range;
                line(painter, lens, stroke, at, edge);
            }
        }
        LightKind::Directional => {
            let length = 60.0 * lens.metres_per_point(at);
            let tip = at + ahead * length;
            line(painter, lens, stroke, at, tip);
            let (u, v) = ahead.any_orthonormal_pair();
            for aside in [u, -u, v, -v] {
                let end = tip - (ahead - aside * 0.5) * (length * 0.2);
                line(painter, lens, stroke, tip, end);
            }
        }
        LightKind::Ambient => {}
    }
}

fn camera_reach(painter: &Painter, lens: &Lens, stroke: Stroke, scene: &Scene, entity: Entity) {
    let Some(view) = View::from_camera(&scene.world, entity) else {
        return;
    };
    let to_world = view.view.inverse();
    let aspect = lens.rect.aspect_ratio();
    let depth = view.far.min(CAMERA_REACH);
    let up = depth * (view.fov_y * 0.5).tan();
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let corners =
        corners.map(|(x, y)| to_world.transform_point3(Vec3::new(x * up * aspect, y * up, -depth)));
    for (index, corner) in corners.iter().enumerate() {
        line(painter, lens, stroke, view.position(), *corner);
        line(painter, lens, stroke, *corner, corners[(index + 1) % 4]);
    }
}
