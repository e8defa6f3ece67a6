//! The GPU pipeline of a `mips` pass: each level is drawn from the one above.

use lightbench_assets::files::Files;

use super::cache::PipelineKey;
use super::{Compiler, FULLSCREEN_VERTEX, refusal};
use crate::binding::{check_vertices, link, links_mips};
use crate::description::{Define, PassDesc, PipelineDesc, Reduction};
use crate::gpu_pipelines::{DrawPipeline, PassPipelines};
use crate::problem::Problem;
use crate::reflection::{FRAGMENT_ENTRY, SampleKind, VERTEX_ENTRY};

const MIPS_SHADER: &str = "shaders/mips.wgsl";

impl Compiler {
    pub(super) fn mips(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        target: &str,
        reduction: Reduction,
    ) -> Result<PassPipelines, Problem> {
        let Some(target) = desc.target(target) else {
            return Ok(PassPipelines::None);
        };
        let kind = SampleKind::of_format(target.format.0);
        let defines = [
            Define::flag(match reduction {
                Reduction::Average => "AVERAGE",
                Reduction::Min => "MIN",
                Reduction::Max => "MAX",
            }),
            Define::flag(match kind {
                SampleKind::Uint => "UNSIGNED",
                SampleKind::Sint => "SIGNED",
                SampleKind::Float | SampleKind::Depth => "FLOAT",
            }),
        ];
        self.load(files, FULLSCREEN_VERTEX, &[], &[])?;
        self.load(files, MIPS_SHADER, &[], &defines)?;
        let vertex = &self.shaders[&(FULLSCREEN_VERTEX.to_owned(), Vec::new(), Vec::new())];
        let fragment = &self.shaders[&(MIPS_SHADER.to_owned(), Vec::new(), defines.to_vec())];
        links_mips(MIPS_SHADER, &fragment.reflection, kind)?;
        link(pass, vertex.reflected(), None)?;
        check_vertices(vertex.reflected(), false)?;
        let sample_type = match kind {
            SampleKind::Uint => wgpu::TextureSampleType::Uint,
            SampleKind::Sint => wgpu::TextureSampleType::Sint,
            _ => wgpu::TextureSampleType::Float { filterable: false },
        };
        let layout = self
            .gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("mips"),
                entries: &[wgpu::BindGroupLayoutEntry {
                    binding: 0,
                    visibility: wgpu::ShaderStages::FRAGMENT,
                    ty: wgpu::BindingType::Texture {
                        sample_type,
                        view_dimension: wgpu::TextureViewDimension::D2,
                        multisampled: false,
                    },
                    count: None,
                }],
            });
        let key = PipelineKey {
            vertex: vertex.shader.fingerprint,
            fragment: Some(fragment.shader.fingerprint),
            state: format!("mips {}", target.format),
        };
        if let Some(pipeline) = self.built.get(&key) {
            return Ok(PassPipelines::Mips { pipeline, layout });
        }
        let pipeline_layout =
            self.gpu
                .device
                .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                    label: Some("mips"),
                    bind_group_layouts: &[Some(&layout)],
                    immediate_size: 0,
                });
        let descriptor = wgpu::RenderPipelineDescriptor {
            label: Some(&pass.name),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &vertex.module,
                entry_point: Some(VERTEX_ENTRY),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &fragment.module,
                entry_point: Some(FRAGMENT_ENTRY),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(target.format.0.into())],
            }),
            multiview_mask: None,
            cache: None,
        };
        let pipeline = self
            .gpu
            .guarded(|| self.gpu.device.create_render_pipeline(&descriptor))
            .map_err(|error| Problem::new(pass.at.clone(), refusal(&error)))?;
        let pipeline = DrawPipeline::new(pipeline, false);
        self.built.insert(key, &pipeline);
        Ok(PassPipelines::Mips { pipeline, layout })
    }
}
