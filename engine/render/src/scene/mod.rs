//! The scene on the GPU: everything of group 0, uploaded only where it changed.

mod buckets;
mod buffer;
mod materials;
mod mesh_buffers;
mod meshes;
mod resample;
mod rows;
mod textures;

use lightbench_assets::{Assets, ReflectionModels};
use lightbench_world::World;

pub use buffer::RowBuffer;
pub use materials::ReplacedModels;
pub use mesh_buffers::MeshBuffers;
pub use meshes::{MeshPool, MeshRange, Shape};
pub use rows::light_data;

use crate::engine_buffers::EngineBuffers;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::gpu_data::{
    DrawnObject, FrameData, InstanceData, LightData, LightVolumeData, ShadowViewData,
};
use crate::layout::{FIRST_TEXTURE_BINDING, SAMPLER_BINDING, SceneLayout};
use materials::MaterialRows;
use rows::SceneRows;
use textures::TexturePool;

/// What has travelled to the device since the beginning.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Uploads {
    /// Meshes.
    pub meshes: u64,
    /// Textures, each with all its mip levels.
    pub textures: u64,
    /// Bytes of both.
    pub bytes: u64,
}

/// The buffers and textures that every pass reads.
pub struct Scene {
    gpu: Gpu,
    layout: SceneLayout,
    /// All meshes, and the unit shapes of light volumes.
    pub meshes: MeshPool,
    textures: TexturePool,
    rows: SceneRows,
    frame: wgpu::Buffer,
    materials: MaterialRows,
    instances: RowBuffer<InstanceData>,
    lights: RowBuffer<LightData>,
    drawn: RowBuffer<DrawnObject>,
    object_lights: RowBuffer<u32>,
    volumes: RowBuffer<LightVolumeData>,
    shadow_views: RowBuffer<ShadowViewData>,
    light_shadows: RowBuffer<u32>,
    /// How often the last two were replaced.
    shadow_buffers: u64,
    /// Frames for the uniform buffer, each at its offset.
    views: Vec<u8>,
    sampler: wgpu::Sampler,
    group: Option<wgpu::BindGroup>,
    assets_revision: Option<u64>,
    uploads: Uploads,
    warnings: Vec<String>,
}

impl Scene {
    /// An empty scene on a device.
    pub fn new(gpu: &Gpu, layout: &SceneLayout) -> Self {
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("materials"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            // Software drivers pay for every extra sample; hardware hardly does.
            anisotropy_clamp: if gpu.summary.software { 1 } else { 8 },
            ..Default::default()
        });
        Self {
            gpu: gpu.clone(),
            layout: layout.clone(),
            meshes: MeshPool::new(gpu),
            textures: TexturePool::new(gpu),
            rows: SceneRows::default(),
            frame: frame_buffer(gpu, size_of::<FrameData>() as u64),
            materials: MaterialRows::new(RowBuffer::new(gpu, "materials")),
            instances: RowBuffer::new(gpu, "instances"),
            lights: RowBuffer::new(gpu, "lights"),
            drawn: RowBuffer::new(gpu, "drawn objects"),
            object_lights: RowBuffer::new(gpu, "object lights"),
            volumes: RowBuffer::new(gpu, "light volumes"),
            shadow_views: RowBuffer::new(gpu, "shadow views"),
            light_shadows: RowBuffer::new(gpu, "light shadows"),
            shadow_buffers: 0,
            views: Vec::new(),
            sampler,
            group: None,
            assets_revision: None,
            uploads: Uploads::default(),
            warnings: Vec::new(),
        }
    }

    /// Uploads meshes, textures and materials that are not on the device yet; materials with the
    /// reflection models that the pipeline carries, or the nearest to them. Warnings (a texture that had to be resampled) are
    /// kept for [`Scene::take_warnings`].
    ///
    /// # Errors
    /// A sentence that says which asset the device can't hold.
    pub fn sync_assets(
        &mut self,
        assets: &Assets,
        carried: ReflectionModels,
    ) -> Result<(), String> {
        if self.assets_revision != Some(assets.revision()) {
            self.meshes.sync(assets, &mut self.uploads)?;
            let (uploads, warnings) = (&mut self.uploads, &mut self.warnings);
            if self.textures.sync(assets, uploads, warnings) {
                self.group = None;
            }
            self.materials.forget();
            self.assets_revision = Some(assets.revision());
        }
        let textures = &self.textures;
        self.materials
            .sync(assets, carried, |texture| textures.slot(texture));
        Ok(())
    }

    /// How many materials are drawn with another reflection model than they ask for.
    pub fn replaced_models(&self) -> ReplacedModels {
        self.materials.replaced
    }

    /// Makes ready for a scene that takes another's place. What was uploaded stays as long as the
    /// new scene uses it too.
    pub fn reset(&mut self) {
        self.assets_revision = None;
        self.textures.warn_again();
        self.rows = SceneRows::default();
    }

    /// Copies the rows of instances and lights that changed since the last call.
    pub fn sync_world(&mut self, world: &World) {
        let (instances, lights) = (&mut self.instances, &mut self.lights);
        self.rows.sync(world, &self.meshes, instances, lights);
    }

    /// The lights, in the order of their rows.
    pub fn lights(&self) -> &[LightData] {
        self.lights.rows()
    }

    /// The instances, in the order of their rows.
    pub fn instances(&self) -> &[InstanceData] {
        self.instances.rows()
    }

    /// Uploads a frame and returns group 0.
    pub fn upload(&mut self, frame: &Frame) -> &wgpu::BindGroup {
        self.upload_frames(frame);
        self.drawn.replace_if_changed(&frame.drawn);
        self.object_lights.replace_if_changed(&frame.object_lights);
        self.volumes.replace_if_changed(&frame.volumes);
        let mut grown = false;
        for flush in [
            self.materials.rows.flush(&self.gpu),
            self.instances.flush(&self.gpu),
            self.lights.flush(&self.gpu),
            self.drawn.flush(&self.gpu),
            self.object_lights.flush(&self.gpu),
            self.volumes.flush(&self.gpu),
        ] {
            grown |= flush;
        }
        if grown {
            self.group = None;
        }
        let group = match self.group.take() {
            Some(group) => group,
            None => Self::bind(
                &self.gpu,
                &self.layout,
                self.buffers(),
                &self.textures,
                &self.sampler,
            ),
        };
        self.group.insert(group)
    }

    /// Bytes from one frame to the next in the uniform buffer.
    pub fn view_bytes(&self) -> u32 {
        let alignment = self.gpu.device.limits().min_uniform_buffer_offset_alignment;
        (size_of::<FrameData>() as u32).next_multiple_of(alignment)
    }

    /// Uploads what the camera sees as `frame`, and after it each shadow view.
    fn upload_frames(&mut self, frame: &Frame) {
        let step = self.view_bytes() as usize;
        self.views.clear();
        for (index, data) in std::iter::once(&frame.data).chain(&frame.views).enumerate() {
            self.views.resize(index * step, 0);
            self.views.extend_from_slice(bytemuck::bytes_of(data));
        }
        if (self.frame.size() as usize) < self.views.len() {
            let size = self.views.len().next_power_of_two();
            self.frame = frame_buffer(&self.gpu, size as u64);
            self.group = None;
        }
        self.gpu.queue.write_buffer(&self.frame, 0, &self.views);
    }

    /// Uploads the shadow views that shaders look up.
    pub fn upload_views(&mut self, frame: &Frame) {
        self.shadow_views.replace_if_changed(&frame.shadow_views);
        self.light_shadows.replace_if_changed(&frame.light_shadows);
        let views = self.shadow_views.flush(&self.gpu);
        if self.light_shadows.flush(&self.gpu) || views {
            self.shadow_buffers += 1;
        }
    }

    fn buffers(&self) -> [&wgpu::Buffer; 7] {
        [
            &self.frame,
            self.instances.buffer(),
            self.materials.rows.buffer(),
            self.lights.buffer(),
            self.drawn.buffer(),
            self.object_lights.buffer(),
            self.volumes.buffer(),
        ]
    }

    fn bind(
        gpu: &Gpu,
        layout: &SceneLayout,
        buffers: [&wgpu::Buffer; 7],
        textures: &TexturePool,
        sampler: &wgpu::Sampler,
    ) -> wgpu::BindGroup {
        let mut entries: Vec<_> = buffers
            .iter()
            .enumerate()
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding: binding as u32,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        // One view at a time; the pass chooses which by its offset.
        entries[0].resource = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: buffers[0],
            offset: 0,
            size: std::num::NonZeroU64::new(size_of::<FrameData>() as u64),
        });
        entries.push(wgpu::BindGroupEntry {
            binding: SAMPLER_BINDING,
            resource: wgpu::BindingResource::Sampler(sampler),
        });
        entries.extend(textures.views().iter().enumerate().map(|(bucket, view)| {
            wgpu::BindGroupEntry {
                binding: FIRST_TEXTURE_BINDING + bucket as u32,
                resource: wgpu::BindingResource::TextureView(view),
            }
        }));
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scene"),
            layout: &layout.group,
            entries: &entries,
        })
    }

    /// The buffers that passes may bind beside group 0.
    pub fn engine_buffers(&self) -> EngineBuffers<'_> {
        EngineBuffers {
            meshes: self.meshes.buffers(),
            shadow_views: self.shadow_views.buffer(),
            light_shadows: self.light_shadows.buffer(),
            // Each of the two numbers only grows.
            revision: self.meshes.revision() + self.shadow_buffers,
        }
    }

    /// Bytes of rows uploaded since the last call.
    pub fn take_uploaded_bytes(&mut self) -> u64 {
        self.materials.rows.take_uploaded()
            + self.instances.take_uploaded()
            + self.lights.take_uploaded()
            + self.drawn.take_uploaded()
            + self.object_lights.take_uploaded()
            + self.volumes.take_uploaded()
            + self.shadow_views.take_uploaded()
            + self.light_shadows.take_uploaded()
    }

    /// What has travelled to the device since the beginning.
    pub fn uploads(&self) -> Uploads {
        self.uploads
    }

    /// Keeps a warning for [`Scene::take_warnings`].
    pub fn warn(&mut self, warning: String) {
        self.warnings.push(warning);
    }

    /// What had to be changed to fit the device or the pipeline, once.
    pub fn take_warnings(&mut self) -> Vec<String> {
        std::mem::take(&mut self.warnings)
    }

    /// Bytes of textures and meshes on the device.
    pub fn asset_bytes(&self) -> u64 {
        self.meshes.bytes() + self.textures.bytes()
    }
}

fn frame_buffer(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("frame"),
        size,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}
