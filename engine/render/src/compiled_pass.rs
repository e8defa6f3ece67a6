//! A pass with its GPU pipelines, and what is bound for the targets of one size.

use crate::attachments::Attachments;
use crate::binding::Source;
use crate::description::{Amount, Dispatch, PassDesc, PassKind};
use crate::engine_buffers::EngineBuffers;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::gpu_pipelines::{ComputePipeline, PassPipelines};
use crate::parameters::ParameterBlock;
use crate::targets::Targets;

/// A pass, ready to draw.
#[derive(Debug)]
pub struct CompiledPass {
    /// Its GPU pipelines.
    pub pipelines: PassPipelines,
    /// The same for frames with reflection models beside the default one, where the pass lights
    /// surfaces that another pass has drawn. Geometry passes choose by material instead: see
    /// [`crate::variant::Variant`].
    pub for_other_models: Option<PassPipelines>,
    /// What group 1 holds.
    pub sources: Vec<(u32, Source)>,
    /// The layout of group 1.
    pub target_layout: Option<wgpu::BindGroupLayout>,
    /// Group 2.
    pub parameters: Option<ParameterBlock>,
    /// What depends on the current targets.
    pub bound: Bound,
    /// Which of the frame's lists of objects or lights the pass draws.
    pub list: Option<usize>,
}

/// What of a pass depends on the targets.
#[derive(Debug)]
pub struct Bound {
    /// Group 1.
    pub target_group: Option<wgpu::BindGroup>,
    /// Views of what the pass draws to.
    pub attachments: Attachments,
    /// Workgroups of a compute pass along x, y and z.
    pub workgroups: [u32; 3],
    /// For each level of a `mips` pass but the first: the view to draw to and the group to read from.
    pub levels: Vec<(wgpu::TextureView, wgpu::BindGroup)>,
}

impl Default for Bound {
    fn default() -> Self {
        Self {
            target_group: None,
            attachments: Attachments::default(),
            workgroups: [1; 3],
            levels: Vec::new(),
        }
    }
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
            for_other_models: None,
            sources,
            target_layout,
            parameters,
            bound: Bound::default(),
            list: None,
        }
    }

    /// Its GPU pipelines for a frame.
    pub fn pipelines(&self, frame: &Frame) -> &PassPipelines {
        match &self.for_other_models {
            Some(pipelines) if frame.variants.has_other_models() => pipelines,
            _ => &self.pipelines,
        }
    }

    /// Binds what the pass reads and writes.
    pub(crate) fn bind(
        &mut self,
        gpu: &Gpu,
        desc: &PassDesc,
        targets: &Targets,
        engine: EngineBuffers<'_>,
    ) {
        self.bound.attachments = Attachments::new(desc, targets);
        self.bound.workgroups = workgroups(desc, &self.pipelines, targets);
        self.bind_levels(gpu, desc, targets);
        let Some(layout) = &self.target_layout else {
            return;
        };
        // Views must live until the group is made.
        let views: Vec<_> = self
            .sources
            .iter()
            .map(|(_, source)| view(source, targets))
            .collect();
        let samplers = Samplers::new(gpu);
        let entries: Vec<_> = self
            .sources
            .iter()
            .zip(&views)
            .filter_map(|((binding, source), view)| {
                let resource = match source {
                    Source::Target { .. } | Source::StorageTexture { .. } => {
                        wgpu::BindingResource::TextureView(view.as_ref()?)
                    }
                    Source::Buffer { buffer, .. } => targets.buffer(buffer)?.as_entire_binding(),
                    Source::Engine(which) => engine.get(*which).as_entire_binding(),
                    Source::LinearSampler => wgpu::BindingResource::Sampler(&samplers.linear),
                    Source::NearestSampler => wgpu::BindingResource::Sampler(&samplers.nearest),
                    Source::DepthSampler => wgpu::BindingResource::Sampler(&samplers.depth),
                };
                Some(wgpu::BindGroupEntry {
                    binding: *binding,
                    resource,
                })
            })
            .collect();
        self.bound.target_group = Some(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("targets"),
            layout,
            entries: &entries,
        }));
    }

    /// The views and groups of a `mips` pass.
    fn bind_levels(&mut self, gpu: &Gpu, desc: &PassDesc, targets: &Targets) {
        let levels = &mut self.bound.levels;
        levels.clear();
        let (PassPipelines::Mips { layout, .. }, PassKind::Mips { target, .. }) =
            (&self.pipelines, &desc.kind)
        else {
            return;
        };
        let Some(target) = targets.get(&target.target) else {
            return;
        };
        for layer in 0..target.shape.layers() {
            for mip in 1..target.texture.mip_level_count() {
                let larger =
                    target.readable(wgpu::TextureViewDimension::D2, Some(mip - 1), Some(layer));
                let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some("mips"),
                    layout,
                    entries: &[wgpu::BindGroupEntry {
                        binding: 0,
                        resource: wgpu::BindingResource::TextureView(&larger),
                    }],
                });
                let slice = crate::description::Slice { mip, layer };
                levels.push((target.attachment(slice), group));
            }
        }
    }
}

fn view(source: &Source, targets: &Targets) -> Option<wgpu::TextureView> {
    match source {
        Source::Target {
            target,
            texture,
            mip,
            layer,
            ..
        } => Some(
            targets
                .get(target)?
                .readable(texture.dimension, *mip, *layer),
        ),
        Source::StorageTexture {
            target,
            dimension,
            slice,
            ..
        } => {
            let flat = *dimension == wgpu::TextureViewDimension::D2;
            let layer = flat.then_some(slice.layer);
            Some(
                targets
                    .get(target)?
                    .readable(*dimension, Some(slice.mip), layer),
            )
        }
        _ => None,
    }
}

struct Samplers {
    linear: wgpu::Sampler,
    nearest: wgpu::Sampler,
    depth: wgpu::Sampler,
}

impl Samplers {
    fn new(gpu: &Gpu) -> Self {
        let sampler = |filter, compare| {
            gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("targets"),
                mag_filter: filter,
                min_filter: filter,
                compare,
                ..Default::default()
            })
        };
        Self {
            linear: sampler(wgpu::FilterMode::Linear, None),
            nearest: sampler(wgpu::FilterMode::Nearest, None),
            depth: sampler(
                wgpu::FilterMode::Linear,
                Some(wgpu::CompareFunction::GreaterEqual),
            ),
        }
    }
}

/// Workgroups of a compute pass for the current targets.
fn workgroups(desc: &PassDesc, pipelines: &PassPipelines, targets: &Targets) -> [u32; 3] {
    let (PassKind::Compute(dispatch), PassPipelines::Compute(ComputePipeline { workgroup, .. })) =
        (&desc.kind, pipelines)
    else {
        return [1; 3];
    };
    let amount = |amount: &Amount| match amount {
        Amount::Texels { target, mip } => targets.get(target).map_or([1; 3], |target| {
            let (width, height) = target.mip_size(*mip);
            [width, height, target.shape.layers()]
        }),
        Amount::Tiles { tile, depth } => {
            let size = crate::description::TargetSize::Tiles(*tile);
            let (columns, rows) = size.resolve(targets.size.0, targets.size.1);
            [columns, rows, *depth]
        }
        Amount::Lights => [targets.lights, 1, 1],
        Amount::Fixed(x, y, z) => [*x, *y, *z],
    };
    match dispatch {
        Dispatch::Groups(groups) => amount(groups),
        Dispatch::Threads(threads) => {
            let threads = amount(threads);
            [0, 1, 2].map(|axis| threads[axis].div_ceil(workgroup[axis].max(1)))
        }
        Dispatch::Indirect { .. } => [1; 3],
    }
}
