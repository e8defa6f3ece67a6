//! The textures and buffers behind a pipeline's targets and buffers.

use crate::description::{BufferDesc, PipelineDesc, Shape, Slice, TargetDesc};
use crate::gpu::Gpu;
use crate::life::Lives;

/// One target's texture.
#[derive(Clone, Debug)]
pub struct Target {
    /// The target's name.
    pub name: String,
    /// The texture.
    pub texture: wgpu::Texture,
    /// A view of all of it.
    pub view: wgpu::TextureView,
    /// A view of depth alone for depth-stencil formats, which is what shaders read.
    pub sampled: wgpu::TextureView,
    /// What it is made of.
    pub shape: Shape,
    /// The first target with the same texture, if this one shares it: their lives don't overlap.
    pub shares: Option<String>,
}

impl Target {
    /// Bytes of all texels, samples, layers and mip levels.
    pub fn bytes(&self) -> u64 {
        texture_bytes(&self.texture)
    }

    /// Bytes of one mip level, all its layers and samples.
    pub fn mip_bytes(&self, mip: u32) -> u64 {
        let size = self.texture.size();
        u64::from((size.width >> mip).max(1))
            * u64::from((size.height >> mip).max(1))
            * u64::from(self.layers_of_mip(mip))
            * u64::from(self.texture.sample_count())
            * u64::from(crate::Format(self.texture.format()).bytes_per_texel())
    }

    /// Bytes of one layer of one mip level, all its samples.
    pub fn slice_bytes(&self, slice: Slice) -> u64 {
        self.mip_bytes(slice.mip) / u64::from(self.layers_of_mip(slice.mip))
    }

    /// Layers of a mip level; a volume has fewer slices in smaller levels.
    pub fn layers_of_mip(&self, mip: u32) -> u32 {
        let layers = self.texture.depth_or_array_layers();
        match self.texture.dimension() {
            wgpu::TextureDimension::D3 => (layers >> mip).max(1),
            _ => layers,
        }
    }

    /// Width and height of a mip level in texels.
    pub fn mip_size(&self, mip: u32) -> (u32, u32) {
        let size = self.texture.size();
        ((size.width >> mip).max(1), (size.height >> mip).max(1))
    }

    /// A view to draw to.
    pub fn attachment(&self, slice: Slice) -> wgpu::TextureView {
        let volume = self.texture.dimension() == wgpu::TextureDimension::D3;
        self.texture.create_view(&wgpu::TextureViewDescriptor {
            label: Some(&self.name),
            dimension: Some(if volume {
                wgpu::TextureViewDimension::D3
            } else {
                wgpu::TextureViewDimension::D2
            }),
            base_mip_level: slice.mip,
            mip_level_count: Some(1),
            base_array_layer: if volume { 0 } else { slice.layer },
            array_layer_count: Some(1),
            ..Default::default()
        })
    }

    /// A view for a shader to read: all of it, or one mip level, or one layer.
    pub fn readable(
        &self,
        dimension: wgpu::TextureViewDimension,
        mip: Option<u32>,
        layer: Option<u32>,
    ) -> wgpu::TextureView {
        self.texture.create_view(&wgpu::TextureViewDescriptor {
            label: Some(&self.name),
            dimension: Some(dimension),
            aspect: if self.texture.format().has_depth_aspect() {
                wgpu::TextureAspect::DepthOnly
            } else {
                wgpu::TextureAspect::All
            },
            base_mip_level: mip.unwrap_or(0),
            mip_level_count: mip.map(|_| 1),
            base_array_layer: layer.unwrap_or(0),
            array_layer_count: layer.map(|_| 1),
            ..Default::default()
        })
    }
}

/// Bytes of all texels, samples, layers and mip levels of a texture.
pub fn texture_bytes(texture: &wgpu::Texture) -> u64 {
    let size = texture.size();
    let volume = texture.dimension() == wgpu::TextureDimension::D3;
    let texel = u64::from(crate::Format(texture.format()).bytes_per_texel());
    (0..texture.mip_level_count())
        .map(|mip| {
            let side = |length: u32| u64::from((length >> mip).max(1));
            let depth = if volume {
                side(size.depth_or_array_layers)
            } else {
                u64::from(size.depth_or_array_layers)
            };
            side(size.width) * side(size.height) * depth
        })
        .sum::<u64>()
        * u64::from(texture.sample_count())
        * texel
}

/// One buffer of a pipeline.
#[derive(Clone, Debug)]
pub struct PipelineBuffer {
    /// The buffer's name.
    pub name: String,
    /// The buffer.
    pub buffer: wgpu::Buffer,
}

/// All targets and buffers of a pipeline at one output size.
#[derive(Clone, Debug)]
pub struct Targets {
    /// Output size, pixels.
    pub size: (u32, u32),
    /// Lights that the buffers have room for.
    pub lights: u32,
    /// In the order of the description.
    pub targets: Vec<Target>,
    /// In the order of the description.
    pub buffers: Vec<PipelineBuffer>,
    /// Bytes that targets would take beyond this if none shared its texture.
    pub saved_bytes: u64,
}

impl Targets {
    /// Allocates the textures and buffers for an output of `size`. Targets share a texture where
    /// `lives` allows it. `words` are the sizes of the buffers.
    pub fn new(
        gpu: &Gpu,
        desc: &PipelineDesc,
        lives: Option<&Lives>,
        size: (u32, u32),
        lights: u32,
        words: &[u64],
    ) -> Self {
        let mut targets: Vec<Target> = Vec::with_capacity(desc.targets.len());
        let mut saved_bytes = 0;
        for (index, target) in desc.targets.iter().enumerate() {
            let host = lives.and_then(|lives| lives.host(desc, index));
            let shared = host.and_then(|host| {
                let host = targets.get(host)?;
                Some(Target {
                    name: target.name.clone(),
                    shares: Some(host.name.clone()),
                    ..host.clone()
                })
            });
            match shared {
                Some(shared) => {
                    saved_bytes += shared.bytes();
                    targets.push(shared);
                }
                None => targets.push(allocate(gpu, target, size)),
            }
        }
        let buffers = desc.buffers.iter().zip(words);
        let buffers = buffers
            .map(|(buffer, words)| allocate_buffer(gpu, buffer, *words))
            .collect();
        Self {
            size,
            lights,
            targets,
            buffers,
            saved_bytes,
        }
    }

    /// Makes the buffers larger that have fewer words than they need; their contents are lost.
    pub fn grow_buffers(&mut self, gpu: &Gpu, desc: &PipelineDesc, words: &[u64]) {
        let buffers = self.buffers.iter_mut().zip(&desc.buffers).zip(words);
        for ((buffer, desc), words) in buffers {
            if buffer.buffer.size() < words * 4 {
                *buffer = allocate_buffer(gpu, desc, *words);
            }
        }
    }

    /// The target of that name.
    pub fn get(&self, name: &str) -> Option<&Target> {
        self.targets.iter().find(|target| target.name == name)
    }

    /// The buffer of that name.
    pub fn buffer(&self, name: &str) -> Option<&wgpu::Buffer> {
        let found = self.buffers.iter().find(|buffer| buffer.name == name);
        found.map(|buffer| &buffer.buffer)
    }

    /// Bytes of all textures and buffers.
    pub fn bytes(&self) -> u64 {
        let textures = self.targets.iter().filter(|target| target.shares.is_none());
        let buffers = self.buffers.iter().map(|buffer| buffer.buffer.size());
        textures.map(Target::bytes).sum::<u64>() + buffers.sum::<u64>()
    }
}

fn allocate(gpu: &Gpu, desc: &TargetDesc, size: (u32, u32)) -> Target {
    let (width, height) = desc.size.resolve(size.0, size.1);
    let format = desc.format.0;
    let layers = desc.shape.layers();
    let volume = matches!(desc.shape, Shape::Volume(_));
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(&desc.name),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: layers,
        },
        mip_level_count: desc
            .mips
            .resolve(width, height, if volume { layers } else { 1 }),
        sample_count: desc.samples,
        dimension: if volume {
            wgpu::TextureDimension::D3
        } else {
            wgpu::TextureDimension::D2
        },
        format,
        usage: usages(gpu, desc),
        // The editor shows 8-bit outputs through a view that undoes their sRGB coding.
        view_formats: if format == wgpu::TextureFormat::Rgba8Unorm {
            &[wgpu::TextureFormat::Rgba8UnormSrgb]
        } else {
            &[]
        },
    });
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let sampled = texture.create_view(&wgpu::TextureViewDescriptor {
        aspect: if format.has_depth_aspect() {
            wgpu::TextureAspect::DepthOnly
        } else {
            wgpu::TextureAspect::All
        },
        ..Default::default()
    });
    Target {
        name: desc.name.clone(),
        texture,
        view,
        sampled,
        shape: desc.shape,
        shares: None,
    }
}

/// Everything that passes may do with a target, as far as the adapter can do it with the format.
fn usages(gpu: &Gpu, desc: &TargetDesc) -> wgpu::TextureUsages {
    use wgpu::TextureUsages as Usage;
    let mut wanted = Usage::RENDER_ATTACHMENT | Usage::TEXTURE_BINDING | Usage::COPY_SRC;
    if desc.samples == 1 {
        wanted |= Usage::COPY_DST | Usage::STORAGE_BINDING;
    }
    let features = gpu.format_features(desc.format.0);
    let allowed = features.map_or(Usage::TEXTURE_BINDING, |features| features.allowed_usages);
    (wanted & allowed) | Usage::TEXTURE_BINDING
}

fn allocate_buffer(gpu: &Gpu, desc: &BufferDesc, words: u64) -> PipelineBuffer {
    PipelineBuffer {
        name: desc.name.clone(),
        buffer: gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(&desc.name),
            size: words * 4,
            usage: wgpu::BufferUsages::STORAGE
                | wgpu::BufferUsages::INDIRECT
                | wgpu::BufferUsages::COPY_SRC
                | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        }),
    }
}
