//! The GPU pipelines that show targets, one for each kind of texture.

use crate::gpu::Gpu;
use crate::reflection::{SampleKind, VERTEX_ENTRY};
use crate::targets::Target;

/// The picture's format: its values are coded as sRGB already.
pub(super) const PICTURE: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// A way to show one kind of target.
pub(super) struct Display {
    layout: wgpu::BindGroupLayout,
    pub(super) pipeline: wgpu::RenderPipeline,
}

/// The binding of a kind's target in the shader.
fn binding(kind: SampleKind) -> u32 {
    match kind {
        SampleKind::Float => 1,
        SampleKind::Uint | SampleKind::Sint => 2,
        SampleKind::Depth => 3,
    }
}

/// Builds the way to show one kind of target.
pub(super) fn display(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    kind: SampleKind,
    entry: &str,
) -> Display {
    let sample_type = match kind {
        SampleKind::Float => wgpu::TextureSampleType::Float { filterable: false },
        SampleKind::Uint => wgpu::TextureSampleType::Uint,
        SampleKind::Sint => wgpu::TextureSampleType::Sint,
        SampleKind::Depth => wgpu::TextureSampleType::Depth,
    };
    let layout_entry = |binding, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty,
        count: None,
    };
    let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("inspect"),
        entries: &[
            layout_entry(
                0,
                wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
            ),
            layout_entry(
                binding(kind),
                wgpu::BindingType::Texture {
                    sample_type,
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
            ),
        ],
    });
    let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("inspect"),
        bind_group_layouts: &[Some(&layout)],
        immediate_size: 0,
    });
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("inspect"),
        layout: Some(&pipeline_layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(VERTEX_ENTRY),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(PICTURE.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    Display { layout, pipeline }
}

/// Binds a target for its display.
pub(super) fn bind(
    gpu: &Gpu,
    uniforms: &wgpu::Buffer,
    display: &Display,
    kind: SampleKind,
    target: &Target,
) -> wgpu::BindGroup {
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("inspect"),
        layout: &display.layout,
        entries: &[
            wgpu::BindGroupEntry {
                binding: 0,
                resource: uniforms.as_entire_binding(),
            },
            wgpu::BindGroupEntry {
                binding: binding(kind),
                resource: wgpu::BindingResource::TextureView(&target.sampled),
            },
        ],
    })
}
