//! A compiled pipeline: what [`crate::compile::Compiler`] builds and [`crate::record`] runs.

use crate::binding::Source;
use crate::compile::DrawPipeline;
use crate::description::PipelineDesc;
use crate::gpu::Gpu;
use crate::reflection::{ParameterMember, SampleKind};
use crate::targets::Targets;

/// The GPU pipelines of a pass.
#[derive(Debug)]
pub enum PassPipelines {
    /// By [`crate::variant::Variant::index`].
    Geometry(Vec<DrawPipeline>),
    /// By case.
    Lights(LightPipelines),
    /// One triangle.
    Fullscreen(wgpu::RenderPipeline),
}

/// The three ways in which a light's volume is drawn.
#[derive(Debug)]
pub struct LightPipelines {
    /// Back faces, lighting what is nearer: works with the camera inside.
    pub back: DrawPipeline,
    /// Front faces, lighting what is farther: works where the far plane cuts the volume.
    pub front: DrawPipeline,
    /// Every pixel: for lights without a volume, and where neither of the two works.
    pub screen: DrawPipeline,
}

/// The uniform buffer behind a shader's `parameters`.
#[derive(Debug)]
pub struct ParameterBlock {
    /// The layout of group 2.
    pub layout: wgpu::BindGroupLayout,
    /// Group 2.
    pub group: wgpu::BindGroup,
    buffer: wgpu::Buffer,
    members: Vec<ParameterMember>,
    bytes: Vec<u8>,
    uploaded: bool,
}

impl ParameterBlock {
    /// A block of `size` bytes.
    pub fn new(gpu: &Gpu, members: Vec<ParameterMember>, size: u32) -> Self {
        let layout = gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("parameters"),
                entries: &[wgpu::BindGroupLayoutEntry {
                    binding: 0,
                    visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                    ty: wgpu::BindingType::Buffer {
                        ty: wgpu::BufferBindingType::Uniform,
                        has_dynamic_offset: false,
                        min_binding_size: None,
                    },
                    count: None,
                }],
            });
        let size = size.next_multiple_of(16);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("parameters"),
            size: u64::from(size),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("parameters"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: buffer.as_entire_binding(),
            }],
        });
        Self {
            layout,
            group,
            buffer,
            members,
            bytes: vec![0; size as usize],
            uploaded: false,
        }
    }

    /// Writes the values in force, if they differ from those on the device.
    pub fn upload(&mut self, gpu: &Gpu, desc: &PipelineDesc) {
        let mut changed = !self.uploaded;
        for member in &self.members {
            let Some(parameter) = desc.parameter(&member.name) else {
                continue;
            };
            let value = parameter.shader_value();
            let bytes = match member.kind {
                Some(SampleKind::Float) => (value as f32).to_le_bytes(),
                _ => (value as u32).to_le_bytes(),
            };
            let at = member.offset as usize;
            if let Some(place) = self.bytes.get_mut(at..at + 4)
                && *place != bytes
            {
                place.copy_from_slice(&bytes);
                changed = true;
            }
        }
        if changed {
            gpu.queue.write_buffer(&self.buffer, 0, &self.bytes);
            self.uploaded = true;
        }
    }
}

/// A pass, ready to draw.
#[derive(Debug)]
pub struct CompiledPass {
    /// Its GPU pipelines.
    pub pipelines: PassPipelines,
    /// What group 1 holds.
    pub sources: Vec<(u32, Source)>,
    /// The layout of group 1.
    pub target_layout: Option<wgpu::BindGroupLayout>,
    /// Group 1, for the current targets.
    pub target_group: Option<wgpu::BindGroup>,
    /// Group 2.
    pub parameters: Option<ParameterBlock>,
}

impl CompiledPass {
    /// A pass without targets bound yet.
    pub fn new(
        pipelines: PassPipelines,
        sources: Vec<(u32, Source)>,
        target_layout: Option<wgpu::BindGroupLayout>,
        parameters: Option<ParameterBlock>,
    ) -> Self {
        Self {
            pipelines,
            sources,
            target_layout,
            target_group: None,
            parameters,
        }
    }

    /// Binds the targets that the pass reads.
    fn bind_targets(&mut self, gpu: &Gpu, targets: &Targets) {
        let Some(layout) = &self.target_layout else {
            return;
        };
        let sampler = |filter| {
            gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("targets"),
                mag_filter: filter,
                min_filter: filter,
                ..Default::default()
            })
        };
        let linear = sampler(wgpu::FilterMode::Linear);
        let nearest = sampler(wgpu::FilterMode::Nearest);
        let entries: Vec<_> = self
            .sources
            .iter()
            .filter_map(|(binding, source)| {
                let resource = match source {
                    Source::Target { target, .. } => {
                        wgpu::BindingResource::TextureView(&targets.get(target)?.sampled)
                    }
                    Source::LinearSampler => wgpu::BindingResource::Sampler(&linear),
                    Source::NearestSampler => wgpu::BindingResource::Sampler(&nearest),
                };
                Some(wgpu::BindGroupEntry {
                    binding: *binding,
                    resource,
                })
            })
            .collect();
        self.target_group = Some(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("targets"),
            layout,
            entries: &entries,
        }));
    }
}

/// A pipeline that can draw.
#[derive(Debug)]
pub struct Pipeline {
    /// What it was compiled from, with the parameter values in force.
    pub desc: PipelineDesc,
    /// In the order of the description.
    pub(crate) passes: Vec<CompiledPass>,
    targets: Option<Targets>,
}

impl Pipeline {
    pub(crate) fn new(desc: PipelineDesc, passes: Vec<CompiledPass>) -> Self {
        Self {
            desc,
            passes,
            targets: None,
        }
    }

    /// The targets of the last frame.
    pub fn targets(&self) -> Option<&Targets> {
        self.targets.as_ref()
    }

    /// Whether some pass wants the lights gathered object by object.
    pub fn gathers_lights(&self) -> bool {
        self.desc.passes.iter().any(|pass| {
            matches!(
                pass.kind,
                crate::description::PassKind::Geometry {
                    gather_lights: true,
                    ..
                }
            )
        })
    }

    /// Takes over parameter values from a description of the same structure.
    ///
    /// Returns false, and changes nothing, if the structure differs: then it must be compiled.
    pub fn adopt_values(&mut self, desc: &PipelineDesc) -> bool {
        let same = self.desc.same_structure(desc);
        if same {
            self.desc.clone_from(desc);
        }
        same
    }

    /// Makes targets, bindings and parameters ready for a frame of that size.
    pub(crate) fn prepare(&mut self, gpu: &Gpu, size: (u32, u32)) -> &Targets {
        if self
            .targets
            .as_ref()
            .is_none_or(|targets| targets.size != size)
        {
            let targets = Targets::new(gpu, &self.desc, size);
            for pass in &mut self.passes {
                pass.bind_targets(gpu, &targets);
            }
            self.targets = Some(targets);
        }
        for pass in &mut self.passes {
            if let Some(parameters) = &mut pass.parameters {
                parameters.upload(gpu, &self.desc);
            }
        }
        self.targets
            .get_or_insert_with(|| Targets::new(gpu, &self.desc, size))
    }
}
