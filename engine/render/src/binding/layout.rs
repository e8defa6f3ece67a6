//! The layout of group 1: what a pass reads and writes besides its attachments.

use super::Source;
use crate::description::{PassDesc, PassKind, PipelineDesc};
use crate::gpu::Gpu;
use crate::reflection::SampleKind;

/// The layout of group 1, or none where the shader reads nothing.
pub fn target_layout(
    gpu: &Gpu,
    sources: &[(u32, Source)],
    desc: &PipelineDesc,
    pass: &PassDesc,
) -> Option<wgpu::BindGroupLayout> {
    if sources.is_empty() {
        return None;
    }
    let compute = matches!(pass.kind, PassKind::Compute(_));
    let entries: Vec<_> = sources
        .iter()
        .map(|(binding, source)| wgpu::BindGroupLayoutEntry {
            binding: *binding,
            visibility: visibility(source, compute),
            ty: binding_type(source, desc),
            count: None,
        })
        .collect();
    Some(
        gpu.device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("targets"),
                entries: &entries,
            }),
    )
}

/// The stages of a pass that see a binding.
pub(super) fn visibility(source: &Source, compute: bool) -> wgpu::ShaderStages {
    match source {
        _ if compute => wgpu::ShaderStages::COMPUTE,
        // Vertex stages can't write on every adapter.
        Source::StorageTexture { .. } | Source::Buffer { writable: true, .. } => {
            wgpu::ShaderStages::FRAGMENT
        }
        _ => wgpu::ShaderStages::VERTEX_FRAGMENT,
    }
}

fn binding_type(source: &Source, desc: &PipelineDesc) -> wgpu::BindingType {
    match source {
        Source::Target {
            texture, filtered, ..
        } => wgpu::BindingType::Texture {
            sample_type: match texture.kind {
                SampleKind::Depth => wgpu::TextureSampleType::Depth,
                SampleKind::Uint => wgpu::TextureSampleType::Uint,
                SampleKind::Sint => wgpu::TextureSampleType::Sint,
                SampleKind::Float => wgpu::TextureSampleType::Float {
                    filterable: *filtered,
                },
            },
            view_dimension: texture.dimension,
            multisampled: texture.multisampled,
        },
        Source::StorageTexture {
            target,
            dimension,
            access,
            ..
        } => wgpu::BindingType::StorageTexture {
            access: *access,
            format: desc
                .target(target)
                .map_or(wgpu::TextureFormat::Rgba8Unorm, |target| target.format.0),
            view_dimension: *dimension,
        },
        Source::Buffer { writable, .. } => storage(!writable),
        Source::Engine(_) => storage(true),
        Source::LinearSampler => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        Source::NearestSampler => {
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::NonFiltering)
        }
        Source::DepthSampler => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison),
    }
}

fn storage(read_only: bool) -> wgpu::BindingType {
    wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Storage { read_only },
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}
