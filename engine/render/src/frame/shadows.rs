//! The views of `shadow` passes, and the casters that each of them sees.

use glam::{Mat4, Vec3, Vec4};
use lightbench_world::culling::{Frustum, Spheres, cull_spheres};
use lightbench_world::{MeshRenderer, WorldBounds};

use super::objects::{Objects, is_transparent};
use super::{Frame, MeshDraw, ViewVolume};
use crate::description::{
    DrawList, DrawOrder, GivenView, Lens, PassDesc, PassKind, PipelineDesc, Shadow, ShadowLights,
    ShadowViews, TargetSize,
};
use crate::gpu_data::{FrameData, LightData, ShadowViewData};
use crate::volumes::{DIRECTIONAL, POINT, SPOT};

/// What tells one list of shadow views from another.
#[derive(Clone, Debug, PartialEq)]
pub struct ShadowKey {
    /// From where.
    pub shadow: Shadow,
    /// Layers that there are for views.
    pub layers: u32,
    /// Width and height of a layer.
    pub size: TargetSize,
}

impl ShadowKey {
    /// What a pass of a pipeline draws; `None` for passes of other kinds.
    pub fn of(desc: &PipelineDesc, pass: &PassDesc) -> Option<Self> {
        let PassKind::Shadow(shadow) = &pass.kind else {
            return None;
        };
        let target = desc.target(&pass.depth.as_ref()?.target)?;
        Some(Self {
            shadow: shadow.clone(),
            layers: target.shape.layers(),
            size: target.size,
        })
    }
}

/// What a `shadow` pass draws.
#[derive(Clone, Debug, Default)]
pub struct ShadowList {
    /// Instanced draw calls.
    pub draws: Vec<MeshDraw>,
    /// One for each layer, in order.
    pub views: Vec<ViewDraws>,
    /// Lights that no layer was left for.
    pub unplaced: u32,
}

/// What is drawn into one layer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ViewDraws {
    /// Which of the frame's shadow views: its place in [`Frame::views`].
    pub view: u32,
    /// Which of the list's draw calls.
    pub draws: std::ops::Range<usize>,
}

/// A spot light's view is at most this wide, since wider ones have no flat picture; the rim of the
/// widest cones has no shadow.
const WIDEST: f32 = 170.0 * std::f32::consts::PI / 180.0;

/// "This light has no shadow view."
pub const NO_VIEW: u32 = u32::MAX;

/// How a view looks at the world.
#[derive(Clone, Copy)]
struct Eye {
    view: Mat4,
    projection: Mat4,
    position: Vec3,
    near: f32,
    far: f32,
    /// Whether left and right are swapped, so that triangles wind the other way.
    mirrored: bool,
    light: Option<u32>,
}

impl Frame {
    /// Fills one list of shadow views.
    pub(super) fn shadow_views(&mut self, index: usize, key: &ShadowKey, objects: &Objects<'_>) {
        let mut list = std::mem::take(&mut self.shadow_lists[index]);
        list.draws.clear();
        list.views.clear();
        list.unplaced = 0;
        let room = |list: &ShadowList, wanted: u32| list.views.len() as u32 + wanted <= key.layers;
        let lights = match &key.shadow.views {
            ShadowViews::Lights(lights) => *lights,
            ShadowViews::Given(views) => {
                for view in views {
                    if room(&list, 1) {
                        self.shadow_view(&mut list, &given(view), key, objects);
                    } else {
                        list.unplaced += 1;
                    }
                }
                self.shadow_lists[index] = list;
                return;
            }
        };
        let casters = casters_box(objects);
        for (light_index, light) in objects.lights.iter().enumerate() {
            if !is_wanted(lights, light, objects.view) {
                continue;
            }
            if !room(&list, lights.layers()) {
                list.unplaced += 1;
                continue;
            }
            let near = key.shadow.near;
            let light_index = light_index as u32;
            match (lights, casters) {
                (ShadowLights::Spot, _) => {
                    self.shadow_view(&mut list, &spot(light, light_index, near), key, objects);
                }
                (ShadowLights::Point, _) => {
                    for side in 0..6 {
                        let eye = cube_side(light, light_index, near, side);
                        self.shadow_view(&mut list, &eye, key, objects);
                    }
                }
                (_, Some(casters)) => {
                    let eye = directional(light, light_index, casters);
                    self.shadow_view(&mut list, &eye, key, objects);
                }
                // Nothing casts a shadow.
                (_, None) => {}
            }
        }
        self.shadow_lists[index] = list;
    }

    /// Adds one view and what it sees.
    fn shadow_view(
        &mut self,
        list: &mut ShadowList,
        eye: &Eye,
        key: &ShadowKey,
        objects: &Objects<'_>,
    ) {
        let view_projection = eye.projection * eye.view;
        let layer = list.views.len() as u32;
        let at = self.views.len() as u32;
        let [width, height] = self.data.resolution;
        let (width, height) = key.size.resolve(width as u32, height as u32);
        self.views.push(FrameData {
            view: eye.view,
            projection: eye.projection,
            view_projection,
            inverse_view_projection: view_projection.inverse(),
            camera_position: eye.position,
            resolution: [width as f32, height as f32],
            near: eye.near,
            far: eye.far,
            previous_view_projection: view_projection,
            ..self.data
        });
        self.shadow_views.push(ShadowViewData {
            view_projection,
            light: eye.light.unwrap_or(NO_VIEW),
            layer,
            near: eye.near,
            far: eye.far,
        });
        if let Some(first) = eye.light.and_then(|light| {
            let views = self.light_shadows.get_mut(light as usize)?;
            (*views == NO_VIEW).then_some(views)
        }) {
            *first = at;
        }

        let bounds = objects.world.columns::<WorldBounds>();
        let b = bounds.slices();
        let spheres = Spheres {
            x: b.x,
            y: b.y,
            z: b.z,
            radius: b.radius,
        };
        let frustum = Frustum::from_view_projection(view_projection);
        let mut seen = std::mem::take(&mut self.seen);
        cull_spheres(&frustum, spheres, &mut seen);
        self.order.clear();
        for &row in &seen {
            self.take(DrawList::Casters, DrawOrder::State, row, objects);
        }
        self.seen = seen;
        self.order.sort_unstable();
        let first = list.draws.len();
        let mut order = std::mem::take(&mut self.order);
        for entry in &mut order {
            if eye.mirrored {
                entry.variant = entry.variant.turned();
            }
            self.draw(&mut list.draws, first, entry, (0, 0));
        }
        self.order = order;
        list.views.push(ViewDraws {
            view: at,
            draws: first..list.draws.len(),
        });
    }
}

/// Whether a light's views can reach anything that the camera sees.
fn is_wanted(lights: ShadowLights, light: &LightData, view: &ViewVolume) -> bool {
    let kind = match lights {
        ShadowLights::Spot => SPOT,
        ShadowLights::Point => POINT,
        ShadowLights::Directional => DIRECTIONAL,
    };
    let p = light.position;
    light.kind == kind
        && (kind == DIRECTIONAL
            || (light.range > 0.0 && view.frustum.intersects_sphere(p.x, p.y, p.z, light.range)))
}

/// Reversed depth: 1 at `near`, 0 at `far`.
fn perspective(angle: f32, near: f32, far: f32) -> Mat4 {
    crate::View {
        fov_y: angle,
        near,
        far,
        ..crate::View::default()
    }
    .projection(1.0)
}

/// Reversed depth of a box: 1 at distance `near`, 0 at `far`.
fn orthographic(width: f32, height: f32, near: f32, far: f32) -> Mat4 {
    let depth = far - near;
    Mat4::from_cols(
        Vec4::new(2.0 / width, 0.0, 0.0, 0.0),
        Vec4::new(0.0, 2.0 / height, 0.0, 0.0),
        Vec4::new(0.0, 0.0, 1.0 / depth, 0.0),
        Vec4::new(0.0, 0.0, far / depth, 1.0),
    )
}

/// World to view of an eye that looks along `forward`.
fn look(eye: Vec3, forward: Vec3) -> Mat4 {
    let forward = forward.try_normalize().unwrap_or(Vec3::NEG_Z);
    let up = if forward.y.abs() > 0.99 {
        Vec3::Z
    } else {
        Vec3::Y
    };
    glam::camera::rh::view::look_to_mat4(eye, forward, up)
}

fn given(view: &GivenView) -> Eye {
    let position = Vec3::from_array(view.eye);
    let (near, far) = (view.near, view.far);
    Eye {
        view: look(position, Vec3::from_array(view.target) - position),
        projection: match view.lens {
            Lens::Perspective(angle) => perspective(angle, near, far),
            Lens::Orthographic(side) => orthographic(side, side, near, far),
        },
        position,
        near,
        far,
        mirrored: false,
        light: None,
    }
}

fn spot(light: &LightData, index: u32, near: f32) -> Eye {
    let angle = crate::volumes::outer_angle(light).clamp(0.01, WIDEST);
    let far = light.range.max(near * 2.0);
    Eye {
        view: look(light.position, light.direction),
        projection: perspective(angle, near, far),
        position: light.position,
        near,
        far,
        mirrored: false,
        light: Some(index),
    }
}

/// One side of a cube map. Seen from inside, its columns and rows run as the cube's texture
/// coordinates do (WebGPU, "Texture sampling", cube faces), which mirrors the picture.
fn cube_side(light: &LightData, index: u32, near: f32, side: usize) -> Eye {
    let (x, y, z) = (Vec3::X, Vec3::Y, Vec3::Z);
    // Right, up and ahead of the picture in world space.
    let (right, up, ahead) = [
        (-z, y, x),
        (z, y, -x),
        (x, -z, y),
        (x, z, -y),
        (x, y, z),
        (-x, y, -z),
    ][side];
    let p = light.position;
    let far = light.range.max(near * 2.0);
    let row = |axis: Vec3| axis.extend(-axis.dot(p));
    let view = Mat4::from_cols(row(right), row(up), row(-ahead), Vec4::W).transpose();
    Eye {
        view,
        projection: perspective(std::f32::consts::FRAC_PI_2, near, far),
        position: p,
        near,
        far,
        mirrored: true,
        light: Some(index),
    }
}

/// A box along the light around the casters.
fn directional(light: &LightData, index: u32, (low, high): (Vec3, Vec3)) -> Eye {
    let center = (low + high) * 0.5;
    let around = look(center, light.direction);
    let corners = (0..8).map(|corner| {
        let pick = |axis: usize| {
            if corner >> axis & 1 == 0 {
                low[axis]
            } else {
                high[axis]
            }
        };
        around
            .transform_point3(Vec3::new(pick(0), pick(1), pick(2)))
            .abs()
    });
    let half = corners.fold(Vec3::splat(1e-3), Vec3::max);
    // The eye stands at the side of the box from which the light comes.
    let position = center - light.direction * half.z;
    Eye {
        view: look(position, light.direction),
        projection: orthographic(2.0 * half.x, 2.0 * half.y, 0.0, 2.0 * half.z),
        position,
        near: 0.0,
        far: 2.0 * half.z,
        mirrored: false,
        light: Some(index),
    }
}

/// The box around everything that casts a shadow.
fn casters_box(objects: &Objects<'_>) -> Option<(Vec3, Vec3)> {
    let renderers = objects.world.columns::<MeshRenderer>();
    let r = renderers.slices();
    let bounds = objects.world.columns::<WorldBounds>();
    let b = bounds.slices();
    let mut found: Option<(Vec3, Vec3)> = None;
    for row in 0..renderers.len() {
        if !r.visible[row] || is_transparent(objects.assets, r.material[row]) {
            continue;
        }
        let center = Vec3::new(b.x[row], b.y[row], b.z[row]);
        let half = Vec3::new(b.half_x[row], b.half_y[row], b.half_z[row]);
        let (low, high) = found.unwrap_or((Vec3::INFINITY, Vec3::NEG_INFINITY));
        found = Some((low.min(center - half), high.max(center + half)));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn depth(eye: &Eye, point: Vec3) -> (f32, f32, f32) {
        let clip = eye.projection * eye.view * point.extend(1.0);
        (clip.x / clip.w, clip.y / clip.w, clip.z / clip.w)
    }

    fn light(kind: u32, position: Vec3, direction: Vec3, range: f32) -> LightData {
        LightData {
            kind,
            position,
            direction,
            range,
            ..bytemuck::Zeroable::zeroed()
        }
    }

    #[test]
    fn a_box_view_is_linear_in_depth() {
        let sun = light(DIRECTIONAL, Vec3::ZERO, Vec3::NEG_Y, 0.0);
        let eye = directional(
            &sun,
            0,
            (Vec3::new(-2.0, 0.0, -1.0), Vec3::new(2.0, 3.0, 1.0)),
        );
        assert!((depth(&eye, Vec3::new(0.0, 3.0, 0.0)).2 - 1.0).abs() < 1e-6);
        assert!((depth(&eye, Vec3::new(0.0, 1.5, 0.0)).2 - 0.5).abs() < 1e-6);
        assert!(depth(&eye, Vec3::ZERO).2.abs() < 1e-6);
        // Its corners are the corners of the picture.
        let (x, y, _) = depth(&eye, Vec3::new(2.0, 0.0, 1.0));
        assert!(
            (x.abs() - 1.0).abs() < 1e-5 && (y.abs() - 1.0).abs() < 1e-5,
            "{x} {y}"
        );
    }

    #[test]
    fn cube_sides_follow_the_texture_coordinates_of_cubes() {
        let lamp = light(POINT, Vec3::new(1.0, 2.0, 3.0), Vec3::NEG_Z, 10.0);
        // A direction, its side, and s and t there: the table of the Vulkan specification,
        // "Cube map face selection", with s = (s_c / |r| + 1) / 2.
        for (direction, side, s, t) in [
            (Vec3::new(1.0, 0.25, 0.5), 0, -0.5, -0.25),
            (Vec3::new(-1.0, 0.25, 0.5), 1, 0.5, -0.25),
            (Vec3::new(0.25, 1.0, 0.5), 2, 0.25, 0.5),
            (Vec3::new(0.25, -1.0, 0.5), 3, 0.25, -0.5),
            (Vec3::new(0.25, 0.5, 1.0), 4, 0.25, -0.5),
            (Vec3::new(0.25, 0.5, -1.0), 5, -0.25, -0.5),
        ] {
            let eye = cube_side(&lamp, 0, 0.1, side);
            let (x, y, z) = depth(&eye, lamp.position + direction * 2.0);
            // Rows run downwards, y upwards.
            assert!(
                (x - s).abs() < 1e-5 && (y + t).abs() < 1e-5,
                "side {side}: {x} {y}"
            );
            let expected = 0.1 * (10.0 - 2.0) / (2.0 * (10.0 - 0.1));
            assert!((z - expected).abs() < 1e-5, "side {side}: {z}");
            assert!(eye.view.determinant() < 0.0, "mirrored");
        }
    }
}
