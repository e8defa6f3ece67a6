//! The layout of group 0: the scene, bound once and the same for every pass.

use crate::gpu::Gpu;
use crate::gpu_data::{FrameData, TEXTURE_BUCKETS};

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
        use wgpu::ShaderStages as Stages;
        let entry = |binding, visibility, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty,
            count: None,
        };
        let storage = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: true },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        // Adapters bind as few as eight storage buffers to a stage, so each stage sees only those
        // that it needs: that leaves three to fragment stages and five to compute shaders.
        let buffers = [
            Stages::VERTEX_FRAGMENT | Stages::COMPUTE, // instances
            Stages::FRAGMENT | Stages::COMPUTE,        // materials
            Stages::FRAGMENT | Stages::COMPUTE,        // lights
            Stages::VERTEX_FRAGMENT,                   // drawn objects
            Stages::FRAGMENT,                          // lists of lights
            Stages::VERTEX,                            // light volumes
        ];
        let mut entries = vec![entry(
            0,
            Stages::VERTEX_FRAGMENT | Stages::COMPUTE,
            wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                // One frame for each view: the camera's comes first.
                has_dynamic_offset: true,
                min_binding_size: std::num::NonZeroU64::new(size_of::<FrameData>() as u64),
            },
        )];
        entries.extend(
            (1..)
                .zip(buffers)
                .map(|(at, stages)| entry(at, stages, storage)),
        );
        entries.push(entry(
            SAMPLER_BINDING,
            Stages::FRAGMENT | Stages::COMPUTE,
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        ));
        entries.extend((0..TEXTURE_BUCKETS as u32).map(|bucket| {
            entry(
                FIRST_TEXTURE_BINDING + bucket,
                Stages::FRAGMENT | Stages::COMPUTE,
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
