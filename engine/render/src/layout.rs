//! The layout of group 0: the scene, bound once and the same for every pass.

use crate::gpu::Gpu;
use crate::gpu_data::TEXTURE_BUCKETS;

/// Binding of the material sampler; the storage buffers come before it.
pub const SAMPLER_BINDING: u32 = 7;
/// Binding of the first texture array.
pub const FIRST_TEXTURE_BINDING: u32 = 8;

/// The layout of the scene's bind group, as `shaders/lib/scene.wgsl` declares it.
#[derive(Clone, Debug)]
pub struct SceneLayout {
    /// The layout.
    pub group: wgpu::BindGroupLayout,
}

impl SceneLayout {
    /// Creates the layout on a device.
    pub fn new(gpu: &Gpu) -> Self {
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty,
            count: None,
        };
        let buffer = |ty| wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let storage = buffer(wgpu::BufferBindingType::Storage { read_only: true });

        let mut entries = vec![entry(0, buffer(wgpu::BufferBindingType::Uniform))];
        entries.extend((1..SAMPLER_BINDING).map(|binding| entry(binding, storage)));
        entries.push(entry(
            SAMPLER_BINDING,
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        ));
        entries.extend((0..TEXTURE_BUCKETS as u32).map(|bucket| {
            entry(
                FIRST_TEXTURE_BINDING + bucket,
                wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: true },
                    view_dimension: wgpu::TextureViewDimension::D2Array,
                    multisampled: false,
                },
            )
        }));
        let group = gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("scene"),
                entries: &entries,
            });
        Self { group }
    }
}
