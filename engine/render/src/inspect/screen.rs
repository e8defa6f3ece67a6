//! Pictures that one draw call paints over the whole of a texture.

use std::borrow::Cow;

use lightbench_assets::files::Files;

use crate::compile::FULLSCREEN_VERTEX;
use crate::description::Define;
use crate::gpu::Gpu;
use crate::problem::{Place, Problem};
use crate::reflection::{FRAGMENT_ENTRY, VERTEX_ENTRY};
use crate::shader::ShaderComposer;

/// The format of the pictures: values are coded as sRGB already.
pub(super) const PICTURE: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Composes a shader, with defines.
pub(super) fn module(
    gpu: &Gpu,
    files: &Files,
    path: &str,
    defines: &[Define],
) -> Result<wgpu::ShaderModule, Problem> {
    let mut composer = ShaderComposer::new(files, gpu.capabilities())?;
    let shader = composer.compose(files, path, defines)?;
    let source = wgpu::ShaderSource::Naga(Cow::Owned(shader.module));
    let descriptor = wgpu::ShaderModuleDescriptor {
        label: Some(path),
        source,
    };
    gpu.guarded(|| gpu.device.create_shader_module(descriptor))
        .map_err(|error| Problem::new(Place::file(path), error))
}

/// A pipeline that runs a shader's fragments for each texel. `path` is where its mistakes are.
pub(super) fn pipeline(
    gpu: &Gpu,
    files: &Files,
    path: &str,
    fragment: &wgpu::ShaderModule,
    group: &wgpu::BindGroupLayout,
) -> Result<wgpu::RenderPipeline, Problem> {
    let vertex = module(gpu, files, FULLSCREEN_VERTEX, &[])?;
    let build = || {
        let layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(path),
                bind_group_layouts: &[Some(group)],
                immediate_size: 0,
            });
        gpu.device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(path),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &vertex,
                    entry_point: Some(VERTEX_ENTRY),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: fragment,
                    entry_point: Some(FRAGMENT_ENTRY),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &[Some(PICTURE.into())],
                }),
                multiview_mask: None,
                cache: None,
            })
    };
    gpu.guarded(build)
        .map_err(|error| Problem::new(Place::file(path), error))
}

/// Paints a whole picture.
pub(super) fn paint(
    encoder: &mut wgpu::CommandEncoder,
    picture: &wgpu::Texture,
    pipeline: &wgpu::RenderPipeline,
    group: &wgpu::BindGroup,
) {
    let view = picture.create_view(&wgpu::TextureViewDescriptor::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("inspect"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        })],
        ..Default::default()
    });
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, group, &[]);
    pass.draw(0..3, 0..1);
}

/// A texture for pictures of a size.
pub(super) fn canvas(gpu: &Gpu, size: wgpu::Extent3d) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("inspected picture"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: PICTURE,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}
