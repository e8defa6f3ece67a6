//! The textures behind a pipeline's targets.

use crate::description::{PipelineDesc, TargetDesc};
use crate::gpu::Gpu;

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
}

impl Target {
    /// Bytes of all texels.
    pub fn bytes(&self) -> u64 {
        let size = self.texture.size();
        u64::from(size.width)
            * u64::from(size.height)
            * u64::from(crate::Format(self.texture.format()).bytes_per_texel())
    }
}

/// All targets of a pipeline at one output size.
#[derive(Clone, Debug)]
pub struct Targets {
    /// Output size, pixels.
    pub size: (u32, u32),
    /// In the order of the description.
    pub targets: Vec<Target>,
}

impl Targets {
    /// Allocates the textures for an output of `size`.
    pub fn new(gpu: &Gpu, desc: &PipelineDesc, size: (u32, u32)) -> Self {
        let targets = desc
            .targets
            .iter()
            .map(|target| allocate(gpu, target, size))
            .collect();
        Self { size, targets }
    }

    /// The target of that name.
    pub fn get(&self, name: &str) -> Option<&Target> {
        self.targets.iter().find(|target| target.name == name)
    }

    /// Bytes of all targets.
    pub fn bytes(&self) -> u64 {
        self.targets.iter().map(Target::bytes).sum()
    }
}

fn allocate(gpu: &Gpu, desc: &TargetDesc, size: (u32, u32)) -> Target {
    let (width, height) = desc.size.resolve(size.0, size.1);
    let format = desc.format.0;
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(&desc.name),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC,
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
    }
}
