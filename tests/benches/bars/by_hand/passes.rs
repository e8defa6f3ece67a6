//! Building render and compute pipelines, and the passes that both pipelines end with.

use lightbench::render::description::Define;

use super::ground::{Bound, Ground};

/// A pipeline with what it reads.
pub struct Draw {
    pub pipeline: wgpu::RenderPipeline,
    pub reads: Option<Bound>,
}

/// What tells one render pipeline from another.
pub struct State<'a> {
    /// The vertex stage, its defines, and its vertex buffers.
    pub vertex: (&'a str, &'a [&'a str], Streams),
    /// The fragment stage, if there is one: that of the description's pass of this name.
    pub fragment: Option<&'a str>,
    pub cull: Option<wgpu::Face>,
    /// The test, and whether depth is written.
    pub depth: Option<(wgpu::CompareFunction, bool)>,
    /// Colour targets by name.
    pub colors: &'a [String],
    pub blend: Option<wgpu::BlendState>,
    /// A group 2, for parameters.
    pub parameters: Option<&'a wgpu::BindGroupLayout>,
}

/// Vertex buffers.
#[derive(Clone, Copy, PartialEq)]
pub enum Streams {
    None,
    Positions,
    All,
}

const POSITIONS: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: 12,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3],
};
const ATTRIBUTES: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: 36,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![1 => Float32x3, 2 => Float32x2, 3 => Float32x4],
};

/// Source and destination added up.
pub const ADD: wgpu::BlendState = {
    let one = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Add,
    };
    wgpu::BlendState {
        color: one,
        alpha: one,
    }
};

/// Builds a render pipeline.
pub fn render_pipeline(ground: &mut Ground, state: &State<'_>) -> Draw {
    let (path, defines, streams) = state.vertex;
    let defines: Vec<Define> = defines.iter().map(|name| Define::flag(*name)).collect();
    let (vertex, _) = ground.shader(path, &defines, wgpu::ShaderStages::VERTEX);
    let stage = wgpu::ShaderStages::FRAGMENT;
    let fragment = state.fragment.map(|pass| ground.shader_of(pass, stage));
    let (fragment, reads) = fragment.map_or((None, None), |(module, reads)| (Some(module), reads));
    let layout = layout(ground, reads.as_ref(), state.parameters);
    let targets = state.colors.iter().map(|name| {
        Some(wgpu::ColorTargetState {
            format: ground.format(name),
            blend: state.blend,
            write_mask: wgpu::ColorWrites::ALL,
        })
    });
    let targets: Vec<_> = targets.collect();
    let pipeline = ground
        .gpu
        .device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: state.fragment,
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &vertex,
                entry_point: Some("vertex_main"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: match streams {
                    Streams::None => &[],
                    Streams::Positions => &[Some(POSITIONS)],
                    Streams::All => &[Some(POSITIONS), Some(ATTRIBUTES)],
                },
            },
            primitive: wgpu::PrimitiveState {
                cull_mode: state.cull,
                ..Default::default()
            },
            depth_stencil: state.depth.map(|(compare, write)| wgpu::DepthStencilState {
                format: ground.format("depth"),
                depth_write_enabled: Some(write),
                depth_compare: Some(compare),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: fragment.as_ref().map(|module| wgpu::FragmentState {
                module,
                entry_point: Some("fragment_main"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        });
    Draw { pipeline, reads }
}

/// Builds the compute pipeline of the description's pass of a name.
pub fn compute_pipeline(ground: &mut Ground, pass: &str) -> (wgpu::ComputePipeline, Bound) {
    let (module, bound) = ground.shader_of(pass, wgpu::ShaderStages::COMPUTE);
    let layout = layout(ground, bound.as_ref(), None);
    let pipeline = ground
        .gpu
        .device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(pass),
            layout: Some(&layout),
            module: &module,
            entry_point: Some("compute_main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
    (pipeline, bound.unwrap())
}

fn layout(
    ground: &Ground,
    reads: Option<&Bound>,
    parameters: Option<&wgpu::BindGroupLayout>,
) -> wgpu::PipelineLayout {
    let groups = [
        Some(&ground.scene_layout.group),
        reads.map(|reads| &reads.layout),
        parameters,
    ];
    ground
        .gpu
        .device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &groups,
            immediate_size: 0,
        })
}

/// Begins a render pass on views of colour, each cleared to zero or kept, and depth: cleared to zero,
/// or only tested.
pub fn begin<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    ground: &Ground,
    colors: &[(&wgpu::TextureView, bool)],
    depth: Option<(&wgpu::TextureView, bool)>,
) -> wgpu::RenderPass<'e> {
    let colors: Vec<_> = colors
        .iter()
        .map(|(view, clear)| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: match clear {
                        true => wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                        false => wgpu::LoadOp::Load,
                    },
                    store: wgpu::StoreOp::Store,
                },
            })
        })
        .collect();
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: None,
        color_attachments: &colors,
        depth_stencil_attachment: depth.map(|(view, clear)| {
            wgpu::RenderPassDepthStencilAttachment {
                view,
                depth_ops: clear.then_some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    pass.set_bind_group(0, &ground.scene_group, &[0]);
    pass
}

impl Draw {
    /// Sets the pipeline and what it reads.
    pub fn set(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        if let Some(reads) = &self.reads {
            pass.set_bind_group(1, &reads.group, &[]);
        }
    }

    /// Draws all opaque objects.
    pub fn objects(&self, ground: &Ground, streams: Streams, pass: &mut wgpu::RenderPass<'_>) {
        self.set(pass);
        let meshes = &ground.scene.meshes;
        meshes.bind(pass, streams == Streams::All);
        for draw in &ground.frame.lists[0].draws {
            let mesh = meshes.range(draw.mesh).unwrap();
            pass.draw_indexed(mesh.indices.clone(), mesh.base_vertex, draw.objects.clone());
        }
    }
}

/// Sky behind the objects, then exposure, tone curve and sRGB.
pub struct End {
    sky: Draw,
    output: Draw,
    parameters: wgpu::BindGroup,
    hdr: wgpu::TextureView,
    depth: wgpu::TextureView,
    shown: wgpu::TextureView,
}

impl End {
    pub fn new(ground: &mut Ground) -> Self {
        ground.texture("output");
        let device = ground.gpu.device.clone();
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        // Zeros: no exposure, and the first tone curve.
        let values = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 16,
            usage: wgpu::BufferUsages::UNIFORM,
            mapped_at_creation: false,
        });
        let parameters = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: values.as_entire_binding(),
            }],
        });
        let whole = ("shaders/vertex/fullscreen.wgsl", &[][..], Streams::None);
        let sky = render_pipeline(
            ground,
            &State {
                vertex: whole,
                fragment: Some("sky"),
                cull: None,
                depth: Some((wgpu::CompareFunction::GreaterEqual, false)),
                colors: &["hdr".to_owned()],
                blend: None,
                parameters: None,
            },
        );
        let output = render_pipeline(
            ground,
            &State {
                vertex: whole,
                fragment: Some("output"),
                cull: None,
                depth: None,
                colors: &["output".to_owned()],
                blend: None,
                parameters: Some(&layout),
            },
        );
        Self {
            sky,
            output,
            parameters,
            hdr: ground.view("hdr"),
            depth: ground.view("depth"),
            shown: ground.view("output"),
        }
    }

    pub fn record(&self, ground: &Ground, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = begin(
            encoder,
            ground,
            &[(&self.hdr, false)],
            Some((&self.depth, false)),
        );
        self.sky.set(&mut pass);
        pass.draw(0..3, 0..1);
        drop(pass);
        let mut pass = begin(encoder, ground, &[(&self.shown, false)], None);
        self.output.set(&mut pass);
        pass.set_bind_group(2, &self.parameters, &[]);
        pass.draw(0..3, 0..1);
    }
}
