//! A frame: what the systems hand to the renderer.
//!
//! Flat arrays in the layout that the GPU reads, filled again each frame without allocation once
//! they have their size. Passes see the frame and never the world.

mod clip_volumes;
mod layers;
mod lights;
mod object_lights;
mod objects;
mod reach;
mod shadows;

use glam::{Mat4, Vec3};
use lightbench_assets::{Assets, ReflectionModels};
use lightbench_world::culling::{Frustum, Spheres, cull_spheres};
use lightbench_world::{ClipVolume, Light, MeshId, World, WorldBounds};

use crate::description::{DrawList, DrawOrder, Lights, ObjectLights, PassDesc, PassKind, Repeat};
use crate::gpu_data::{
    DrawnObject, FrameData, InstanceData, LightData, LightVolumeData, ShadowViewData,
};
use crate::variant::{Variant, Variants};
use crate::view::View;
use crate::volumes::{self, Marking, VolumeDraw, VolumeKind};
use objects::Objects;
use reach::{Pairs, Reach};

pub use shadows::{NO_VIEW, ShadowKey, ShadowList, ViewDraws};

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

impl ViewVolume {
    /// Full vertical angle of view, radians.
    pub fn fov_y(&self) -> f32 {
        2.0 * (1.0 / self.focal_y).atan()
    }
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
    /// What `shadow` passes draw, in the order of the request.
    pub shadow_lists: Vec<ShadowList>,
    /// What shaders see as `frame` in each view of the `shadow` passes.
    pub views: Vec<FrameData>,
    /// The same views as shaders look them up.
    pub shadow_views: Vec<ShadowViewData>,
    /// Of each light the first of its views, or [`NO_VIEW`]; empty without `shadow` passes.
    pub light_shadows: Vec<u32>,
    /// Objects that the camera sees.
    pub visible_objects: u32,
    /// Lights that the camera sees.
    pub visible_lights: u32,
    /// The variants of all meshes in the lists.
    pub variants: Variants,
    /// Rows of the objects that the camera sees.
    visible: Vec<u32>,
    /// Rows of the objects that a shadow view sees.
    seen: Vec<u32>,
    order: Vec<objects::Entry>,
    /// Finds the lights of an object.
    reach: Reach,
    /// The lights of one object, and those of all that are drawn once for each group of lights.
    found: Vec<u32>,
    pairs: Pairs,
    kinds: Vec<Chosen>,
    /// Where the lists of all lights and of ambient ones begin and how long they are, once made.
    shared_lights: [Option<(u32, u32)>; 2],
    /// For each array of lights, what those in it take up.
    arrays: Vec<Vec<lights::Place>>,
    /// Objects and their rectangles, nearest first, while layers are chosen.
    layered: Vec<layers::Layered>,
}

/// What a `geometry` pass draws.
#[derive(Clone, Debug, Default)]
pub struct ObjectList {
    /// Instanced draw calls.
    pub draws: Vec<MeshDraw>,
    /// Once for each group of lights, in their order; a list that is not repeated has one.
    pub steps: Vec<Step>,
}

/// What a `geometry` pass draws for one group of lights.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Which of the list's draw calls.
    pub draws: std::ops::Range<usize>,
    /// The rectangle that the group can reach, as shares of the picture from the upper left corner:
    /// left, top, right, bottom.
    pub scissor: Option<[f32; 4]>,
    /// The volume to mark in stencil before.
    pub mark: Option<VolumeDraw>,
}

impl Step {
    /// The share of the picture that it may draw to.
    pub fn coverage(&self) -> f64 {
        self.scissor.map_or(1.0, |[left, top, right, bottom]| {
            f64::from((right - left).max(0.0)) * f64::from((bottom - top).max(0.0))
        })
    }
}

/// What a `lights` pass draws.
#[derive(Clone, Debug, Default)]
pub struct LightList {
    /// Draw calls: instanced, or one a light where stencil is marked.
    pub draws: Vec<VolumeDraw>,
    /// Sum over the drawn lights of the share of the picture that each covers at most.
    pub coverage: f64,
    /// Lights for which no array had room.
    pub unplaced: u32,
    /// Lights with a clip volume that shine beyond it here.
    pub unconfined: u32,
}

/// A light and how it is drawn.
#[derive(Clone, Copy, Debug)]
struct Chosen {
    array: u32,
    marking: Marking,
    kind: VolumeKind,
    data: LightVolumeData,
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
    /// Over how many layers; 0: none are chosen.
    pub layers: u32,
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
                layers: geometry.layers,
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
    /// The reflection models that the pipeline carries.
    pub models: ReflectionModels,
    /// World to clip in the frame before; the present one where there was none.
    pub previous: Option<Mat4>,
    /// The lists of objects that passes draw.
    pub lists: &'a [ListKey],
    /// The lists of lights that passes draw.
    pub light_lists: &'a [Lights],
    /// The views that `shadow` passes draw.
    pub shadow_lists: &'a [ShadowKey],
    /// Whether the device can clamp depth instead of cutting faces off.
    pub clamps_depth: bool,
}

impl Frame {
    /// The rows of the objects that the camera sees.
    pub fn visible_rows(&self) -> &[u32] {
        &self.visible
    }

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
        self.variants = Variants::default();
        self.object_lights.clear();
        self.lists
            .resize_with(request.lists.len(), Default::default);
        self.find_visible(world, &volume);
        self.shared_lights = [None; 2];
        self.volumes.clear();
        let objects = Objects {
            world,
            assets,
            instances,
            lights,
            models: request.models,
            view: &volume,
        };
        for (index, key) in request.lists.iter().enumerate() {
            self.objects(index, key, &objects);
        }
        self.light_lists
            .resize_with(request.light_lists.len(), Default::default);
        for (index, key) in request.light_lists.iter().enumerate() {
            self.light_volumes(index, key, &objects, request.clamps_depth);
        }
        self.views.clear();
        self.shadow_views.clear();
        self.light_shadows.clear();
        if !request.shadow_lists.is_empty() {
            self.light_shadows.resize(lights.len(), NO_VIEW);
        }
        self.shadow_lists
            .resize_with(request.shadow_lists.len(), Default::default);
        for (index, key) in request.shadow_lists.iter().enumerate() {
            self.shadow_views(index, key, &objects);
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
            previous_view_projection: request.previous.unwrap_or(view_projection),
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

    /// Lights with a clip volume that shine beyond it: those that a `lights` pass could not confine,
    /// or all where no pass draws lights as volumes.
    pub fn unconfined_lights(&self, world: &World) -> u32 {
        let lists = self.light_lists.iter();
        let most = lists.map(|list| list.unconfined).max();
        most.unwrap_or_else(|| {
            let volumes = world.columns::<ClipVolume>();
            let lights = world.columns::<Light>();
            let entities = volumes.entities().iter();
            entities
                .filter(|entity| lights.row_of(**entity).is_some())
                .count() as u32
        })
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
        self.visible_objects = 0;
    }
}

/// The radiance that all ambient lights together send from everywhere.
fn sky(lights: &[LightData]) -> Vec3 {
    let ambient = lights.iter().filter(|light| light.kind == volumes::AMBIENT);
    ambient.map(|light| light.intensity).sum()
}
