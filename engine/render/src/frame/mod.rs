//! A frame: what the systems hand to the renderer.
//!
//! Flat arrays in the layout that the GPU reads, filled again each frame without allocation once
//! they have their size. Passes see the frame and never the world.

use glam::{Mat4, Vec3};
use lightbench_assets::Assets;
use lightbench_world::culling::{Frustum, Spheres, cull_spheres};
use lightbench_world::{MaterialId, MeshId, MeshRenderer, World, WorldBounds};

use crate::description::{DrawList, DrawOrder, Lights, ObjectLights, PassDesc, PassKind, Repeat};
use crate::gpu_data::{DrawnObject, FrameData, InstanceData, LightData, LightVolumeData};
use crate::variant::Variant;
use crate::view::View;
use crate::volumes::{self, VolumeDraw, VolumeKind};

/// The view as the choice of light volumes needs it.
#[derive(Clone, Debug)]
pub struct ViewVolume {
    /// World to view.
    pub view: Mat4,
    /// Camera position.
    pub position: Vec3,
    /// Unit vector along which the camera looks.
    pub forward: Vec3,
    /// What it shows.
    pub frustum: Frustum,
    /// Near plane, metres.
    pub near: f32,
    /// Far plane, metres.
    pub far: f32,
    /// Distance from the camera to a corner of the near plane.
    pub near_corner: f32,
    /// Focal length in half picture widths.
    pub focal_x: f32,
    /// Focal length in half picture heights.
    pub focal_y: f32,
}

/// One instanced draw call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshDraw {
    /// Which pipeline of the pass.
    pub variant: Variant,
    /// Which mesh.
    pub mesh: MeshId,
    /// Which entries of [`Frame::drawn`].
    pub objects: std::ops::Range<u32>,
}

/// Everything that one frame draws.
#[derive(Default)]
pub struct Frame {
    /// For the uniform buffer.
    pub data: FrameData,
    /// Objects in drawing order, of all lists.
    pub drawn: Vec<DrawnObject>,
    /// Lists of lights.
    pub object_lights: Vec<u32>,
    /// Light volumes in drawing order, of all lists.
    pub volumes: Vec<LightVolumeData>,
    /// What `geometry` passes draw, in the order of the request.
    pub lists: Vec<ObjectList>,
    /// What `lights` passes draw, in the order of the request.
    pub light_lists: Vec<LightList>,
    /// Objects that the camera sees.
    pub visible_objects: u32,
    /// Lights that the camera sees.
    pub visible_lights: u32,
    visible: Vec<u32>,
    order: Vec<(Variant, MeshId, u32)>,
    kinds: Vec<(VolumeKind, LightVolumeData)>,
}

/// What a `geometry` pass draws.
#[derive(Clone, Debug, Default)]
pub struct ObjectList {
    /// Instanced draw calls.
    pub draws: Vec<MeshDraw>,
}

/// What a `lights` pass draws.
#[derive(Clone, Debug, Default)]
pub struct LightList {
    /// Instanced draw calls.
    pub draws: Vec<VolumeDraw>,
    /// Sum over the drawn lights of the share of the picture that each covers at most.
    pub coverage: f64,
}

/// What tells one list of objects from another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ListKey {
    /// Which objects.
    pub list: DrawList,
    /// In which order.
    pub order: DrawOrder,
    /// With which lights.
    pub lights: ObjectLights,
    /// Once for each group of lights.
    pub repeat: Option<Repeat>,
}

impl ListKey {
    /// The list that a pass draws; `None` for passes that draw no objects.
    pub fn of(pass: &PassDesc) -> Option<Self> {
        match &pass.kind {
            PassKind::Geometry(geometry) => Some(Self {
                list: geometry.list,
                order: geometry.order,
                lights: geometry.lights,
                repeat: geometry.repeat,
            }),
            _ => None,
        }
    }
}

impl Default for FrameData {
    fn default() -> Self {
        bytemuck::Zeroable::zeroed()
    }
}

/// What a frame is made for.
#[derive(Clone, Copy, Debug)]
pub struct FrameRequest<'a> {
    /// The camera.
    pub view: View,
    /// Output size, pixels.
    pub size: (u32, u32),
    /// Seconds since the scene began.
    pub time: f32,
    /// Frames since the renderer began.
    pub index: u32,
    /// The lists of objects that passes draw.
    pub lists: &'a [ListKey],
    /// The lists of lights that passes draw.
    pub light_lists: &'a [Lights],
}

impl Frame {
    /// Fills the frame. The world's matrices and bounds must be up to date, and `lights` and
    /// `instances` in the order of their components' rows.
    pub fn extract(
        &mut self,
        world: &World,
        assets: &Assets,
        instances: &[InstanceData],
        lights: &[LightData],
        request: &FrameRequest<'_>,
    ) {
        let volume = self.camera(request, lights.len());
        self.data.sky = sky(lights);
        self.drawn.clear();
        self.object_lights.clear();
        self.lists
            .resize_with(request.lists.len(), Default::default);
        self.find_visible(world, &volume);
        for (index, key) in request.lists.iter().enumerate() {
            self.objects(index, key, world, assets, instances, lights);
        }
        self.volumes.clear();
        self.light_lists
            .resize_with(request.light_lists.len(), Default::default);
        for (index, key) in request.light_lists.iter().enumerate() {
            self.light_volumes(index, key, lights, &volume);
        }
    }

    fn camera(&mut self, request: &FrameRequest<'_>, light_count: usize) -> ViewVolume {
        let View {
            view, near, far, ..
        } = request.view;
        let (width, height) = (request.size.0.max(1) as f32, request.size.1.max(1) as f32);
        let projection = request.view.projection(width / height);
        let view_projection = projection * view;
        let to_world = view.inverse();
        self.data = FrameData {
            view,
            projection,
            view_projection,
            // In double precision: positions are reconstructed through it, and in single precision
            // a far plane a thousand times the near one costs them a tenth of a millimetre.
            inverse_view_projection: (projection.as_dmat4() * view.as_dmat4())
                .inverse()
                .as_mat4(),
            camera_position: to_world.w_axis.truncate(),
            time: request.time,
            resolution: [width, height],
            near,
            far,
            light_count: light_count as u32,
            frame_index: request.index,
            history_frames: 0,
            padding: 0,
            sky: Vec3::ZERO,
            reserved: 0,
            previous_view_projection: if request.index == 0 {
                view_projection
            } else {
                self.data.view_projection
            },
        };
        let (focal_x, focal_y) = (projection.x_axis.x, projection.y_axis.y);
        ViewVolume {
            view,
            position: self.data.camera_position,
            forward: -to_world.z_axis.truncate(),
            frustum: Frustum::from_view_projection(view_projection),
            near,
            far,
            near_corner: near * Vec3::new(1.0 / focal_x, 1.0 / focal_y, 1.0).length(),
            focal_x,
            focal_y,
        }
    }

    /// Finds the objects that the camera sees.
    fn find_visible(&mut self, world: &World, volume: &ViewVolume) {
        let bounds = world.columns::<WorldBounds>();
        let b = bounds.slices();
        let spheres = Spheres {
            x: b.x,
            y: b.y,
            z: b.z,
            radius: b.radius,
        };
        cull_spheres(&volume.frustum, spheres, &mut self.visible);
    }

    /// Sorts by pipeline variant and mesh, and groups into instanced draws.
    fn objects(
        &mut self,
        index: usize,
        key: &ListKey,
        world: &World,
        assets: &Assets,
        instances: &[InstanceData],
        lights: &[LightData],
    ) {
        let renderers = world.columns::<MeshRenderer>();
        let r = renderers.slices();
        self.order.clear();
        for &row in &self.visible {
            let index = row as usize;
            if !r.visible[index] {
                continue;
            }
            let (two_sided, alpha_test) = material_traits(assets, r.material[index]);
            let variant = Variant::new(two_sided, alpha_test, is_mirrored(&instances[index]));
            self.order.push((variant, r.mesh[index], row));
        }
        self.order.sort_unstable();

        let first = self.drawn.len();
        let draws = &mut self.lists[index].draws;
        draws.clear();
        for &(variant, mesh, row) in &self.order {
            let at = self.drawn.len() as u32;
            self.drawn.push(DrawnObject {
                instance: row,
                first_light: 0,
                light_count: 0,
                reserved: 0,
            });
            match draws.last_mut() {
                Some(draw) if draw.variant == variant && draw.mesh == mesh => {
                    draw.objects.end = at + 1
                }
                _ => draws.push(MeshDraw {
                    variant,
                    mesh,
                    objects: at..at + 1,
                }),
            }
        }
        self.visible_objects = self.drawn.len() as u32;
        self.light_lists_of(world, lights, first, key);
    }

    /// Gives each object from `first` on its list of lights, in the order of light indices.
    fn light_lists_of(&mut self, world: &World, lights: &[LightData], first: usize, key: &ListKey) {
        let start = self.object_lights.len() as u32;
        if key.lights != ObjectLights::Gathered {
            self.object_lights.extend(0..lights.len() as u32);
            for object in &mut self.drawn[first..] {
                object.first_light = start;
                object.light_count = lights.len() as u32;
            }
            return;
        }
        let bounds = world.columns::<WorldBounds>();
        let b = bounds.slices();
        for object in &mut self.drawn[first..] {
            let row = object.instance as usize;
            let center = Vec3::new(b.x[row], b.y[row], b.z[row]);
            let half = Vec3::new(b.half_x[row], b.half_y[row], b.half_z[row]);
            object.first_light = self.object_lights.len() as u32;
            for (index, light) in lights.iter().enumerate() {
                // Distance from the light to the box, by clamping (Arvo 1990, Graphics Gems).
                let outside = ((light.position - center).abs() - half).max(Vec3::ZERO);
                if !volumes::is_bounded(light)
                    || outside.length_squared() < light.range * light.range
                {
                    self.object_lights.push(index as u32);
                }
            }
            object.light_count = self.object_lights.len() as u32 - object.first_light;
        }
    }

    /// Chooses how each light is drawn, and groups equal choices into instanced draws.
    fn light_volumes(
        &mut self,
        index: usize,
        key: &Lights,
        lights: &[LightData],
        view: &ViewVolume,
    ) {
        self.kinds.clear();
        let list = &mut self.light_lists[index];
        list.coverage = 0.0;
        for (index, light) in lights.iter().enumerate() {
            if let Some(found) = volumes::volume(light, index as u32, view, key.volumes) {
                list.coverage += if key.volumes {
                    volumes::coverage(light, view)
                } else {
                    1.0
                };
                self.kinds.push(found);
            }
        }
        self.visible_lights = self.kinds.len() as u32;
        // Equal kinds stay in the order of light indices, so that sums do too.
        self.kinds
            .sort_unstable_by_key(|(kind, data)| (*kind, data.light));
        list.draws.clear();
        for (kind, data) in &self.kinds {
            let at = self.volumes.len() as u32;
            self.volumes.push(*data);
            match list.draws.last_mut() {
                Some(draw) if draw.kind == *kind => draw.volumes.end = at + 1,
                _ => list.draws.push(VolumeDraw {
                    kind: *kind,
                    volumes: at..at + 1,
                }),
            }
        }
    }
}

/// The radiance that all ambient lights together send from everywhere.
fn sky(lights: &[LightData]) -> Vec3 {
    let ambient = lights.iter().filter(|light| light.kind == volumes::AMBIENT);
    ambient.map(|light| light.intensity).sum()
}

fn material_traits(assets: &Assets, id: MaterialId) -> (bool, bool) {
    assets.material(id).map_or((false, false), |material| {
        (material.two_sided, material.alpha_cutoff.is_some())
    })
}

/// Whether the world matrix turns the winding of triangles round.
fn is_mirrored(instance: &InstanceData) -> bool {
    let [x, y, z] = instance
        .world_rows
        .map(|row| Vec3::new(row[0], row[1], row[2]));
    x.dot(y.cross(z)) < 0.0
}
