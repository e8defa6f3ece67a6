//! One render pipeline, from shaders and state.

use lightbench_assets::files::Files;

use super::cache::PipelineKey;
use super::state::{Channels, State, VertexStreams, blend};
use super::{Compiler, PassLayout};
use crate::description::{PassDesc, PipelineDesc, ShaderDesc};
use crate::gpu_pipelines::DrawPipeline;
use crate::problem::Problem;
use crate::reflection::{FRAGMENT_ENTRY, VERTEX_ENTRY};

impl Compiler {
    /// Builds a render pipeline of a pass, or takes it from the cache. Without `fragment` it has no
    /// fragment stage.
    pub(super) fn build(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        fragment: Option<&ShaderDesc>,
        layout: &PassLayout,
        state: &State,
    ) -> Result<DrawPipeline, Problem> {
        let mut own_vertex = false;
        if let Some(shader) = fragment {
            let loaded = self.load(files, &shader.path, state.fragment_defines, &shader.defines)?;
            own_vertex = loaded.reflection.has_vertex && state.own_vertex;
        }
        if !own_vertex {
            self.load(files, state.vertex_path, state.vertex_defines, &[])?;
        }
        let fragment = fragment.map(|shader| {
            &self.shaders[&(
                shader.path.clone(),
                state.fragment_defines.to_vec(),
                shader.defines.clone(),
            )]
        });
        let vertex = match fragment.filter(|_| own_vertex) {
            Some(own) => own,
            None => {
                &self.shaders[&(
                    state.vertex_path.to_owned(),
                    state.vertex_defines.to_vec(),
                    Vec::new(),
                )]
            }
        };

        let streams = VertexStreams::of(&vertex.reflection);
        let colors = color_states(desc, pass, state.channels);
        let depth_stencil = depth_state(desc, pass, state);
        let samples = samples(desc, pass);
        let key = PipelineKey {
            vertex: vertex.shader.fingerprint,
            fragment: fragment.map(|fragment| fragment.shader.fingerprint),
            state: format!(
                "{colors:?} {depth_stencil:?} {:?} {:?} {} {samples} {}",
                state.front, state.cull, state.unclipped_depth, layout.key
            ),
        };
        let attributes = streams == VertexStreams::All;
        if let Some(pipeline) = self.built.get(&key) {
            return Ok(pipeline);
        }
        let descriptor = wgpu::RenderPipelineDescriptor {
            label: Some(&pass.name),
            layout: Some(&layout.layout),
            vertex: wgpu::VertexState {
                module: &vertex.module,
                entry_point: Some(VERTEX_ENTRY),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: streams.layouts(),
            },
            primitive: wgpu::PrimitiveState {
                front_face: state.front,
                cull_mode: state.cull,
                unclipped_depth: state.unclipped_depth && self.gpu.clamps_depth(),
                ..Default::default()
            },
            depth_stencil,
            multisample: wgpu::MultisampleState {
                count: samples,
                ..Default::default()
            },
            fragment: fragment.map(|fragment| wgpu::FragmentState {
                module: &fragment.module,
                entry_point: Some(FRAGMENT_ENTRY),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &colors,
            }),
            multiview_mask: None,
            cache: None,
        };
        let pipeline = self
            .gpu
            .guarded(|| self.gpu.device.create_render_pipeline(&descriptor))
            .map_err(|error| {
                let at = pass.shader.as_ref().map_or(&pass.at, |shader| &shader.at);
                Problem::new(
                    at.clone(),
                    format!("the pass `{}` can't be built: {error}", pass.name),
                )
            })?;
        let pipeline = DrawPipeline::new(pipeline, attributes);
        self.built.insert(key, &pipeline);
        Ok(pipeline)
    }
}

fn color_states(
    desc: &PipelineDesc,
    pass: &PassDesc,
    channels: Channels,
) -> Vec<Option<wgpu::ColorTargetState>> {
    let state = |(index, color): (usize, &crate::description::ColorAttachment)| {
        let format = desc.target(&color.target)?.format.0;
        let mask = match channels {
            Channels::Declared => color.mask.0,
            Channels::Only { target, channel } if target as usize == index => 1 << channel,
            Channels::Only { .. } | Channels::Nothing => 0,
        };
        Some(Some(wgpu::ColorTargetState {
            format,
            blend: blend(color.blend),
            write_mask: wgpu::ColorWrites::from_bits_truncate(u32::from(mask)),
        }))
    };
    pass.colors.iter().enumerate().filter_map(state).collect()
}

fn depth_state(
    desc: &PipelineDesc,
    pass: &PassDesc,
    state: &State,
) -> Option<wgpu::DepthStencilState> {
    let depth = pass.depth.as_ref()?;
    Some(wgpu::DepthStencilState {
        format: desc.target(&depth.target)?.format.0,
        depth_write_enabled: Some(state.depth_write),
        depth_compare: Some(state.depth_compare),
        stencil: state.stencil.clone(),
        bias: wgpu::DepthBiasState {
            constant: depth.bias.0,
            slope_scale: depth.bias.1,
            clamp: 0.0,
        },
    })
}

/// Samples a texel of the pass's attachments; they all have the same number.
fn samples(desc: &PipelineDesc, pass: &PassDesc) -> u32 {
    let color = pass.colors.first().map(|color| &color.target);
    let depth = pass.depth.as_ref().map(|depth| &depth.target);
    color
        .or(depth)
        .and_then(|name| desc.target(name))
        .map_or(1, |target| target.samples)
}
