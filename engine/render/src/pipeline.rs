//! A compiled pipeline: what [`crate::compile::Compiler`] builds and [`crate::record`] runs.

use lightbench_assets::ReflectionModels;

use crate::attachments::Attachments;
use crate::binding::{EngineBuffer, Source};
use crate::compile::DrawPipeline;
use crate::description::{Amount, Dispatch, Lights, PassDesc, PassKind, PipelineDesc};
use crate::frame::ListKey;
use crate::gpu::Gpu;
use crate::life::Lives;
use crate::parameters::ParameterBlock;
use crate::queries::Measured;
use crate::scene::ReplacedModels;
use crate::targets::Targets;

/// The GPU pipelines of a pass.
#[derive(Debug)]
pub enum PassPipelines {
    /// The pass needs none: it clears, copies or resolves.
    None,
    /// Meshes.
    Geometry(GeometryPipelines),
    /// Light volumes.
    Lights(LightsPipelines),
    /// One triangle.
    Fullscreen(wgpu::RenderPipeline),
    /// A dispatch.
    Compute {
        /// The pipeline.
        pipeline: wgpu::ComputePipeline,
        /// Its workgroup size.
        workgroup: [u32; 3],
    },
    /// One triangle a mip level.
    Mips {
        /// The pipeline.
        pipeline: wgpu::RenderPipeline,
        /// Layout of the group that holds the larger level.
        layout: wgpu::BindGroupLayout,
        /// For each level but the first: the view to draw to and the group to read from.
        levels: Vec<(wgpu::TextureView, wgpu::BindGroup)>,
    },
}

/// How a `lights` pass draws.
#[derive(Debug)]
pub struct LightsPipelines {
    /// For each array of lights; one where there are no arrays.
    pub arrays: Vec<LightPipelines>,
    /// With a stencil technique: what marks the pixels of a volume, and what wipes all marks.
    pub stencil: Option<(DrawPipeline, DrawPipeline)>,
}

/// The ways in which a light's volume is drawn.
#[derive(Debug)]
pub struct LightPipelines {
    /// Back faces, lighting what is nearer: works with the camera inside.
    pub back: DrawPipeline,
    /// Front faces, lighting what is farther: works where the far plane cuts the volume.
    pub front: DrawPipeline,
    /// Every pixel: for lights without a volume, and where neither of the two works.
    pub screen: DrawPipeline,
    /// Pixels that are marked in stencil, or with the inverse scheme those that are not.
    pub marked: Option<DrawPipeline>,
}

/// How a `geometry` pass draws.
#[derive(Debug)]
pub struct GeometryPipelines {
    /// By [`crate::variant::Variant::index`].
    pub variants: Vec<DrawPipeline>,
    /// With stencil masks: what marks the pixels inside a light's volume.
    pub mask: Option<MaskPipelines>,
}

/// Marks the pixels whose surface lies inside a volume, in two steps.
#[derive(Debug)]
pub struct MaskPipelines {
    /// Back faces behind the scene mark.
    pub back: DrawPipeline,
    /// Front faces behind the scene take the mark away.
    pub front: DrawPipeline,
    /// The whole screen: marks all, or with the reference 0 wipes all marks.
    pub screen: DrawPipeline,
}

/// Buffers of the engine that passes may bind.
#[derive(Clone, Copy, Debug)]
pub struct EngineBuffers<'a> {
    /// Vertex positions of all meshes.
    pub mesh_positions: &'a wgpu::Buffer,
    /// The rest of the vertices.
    pub mesh_attributes: &'a wgpu::Buffer,
    /// Indices of all meshes.
    pub mesh_indices: &'a wgpu::Buffer,
    /// Differs where one of the buffers is another than before.
    pub revision: u64,
}

impl EngineBuffers<'_> {
    fn get(&self, which: EngineBuffer) -> &wgpu::Buffer {
        match which {
            EngineBuffer::MeshPositions => self.mesh_positions,
            EngineBuffer::MeshAttributes => self.mesh_attributes,
            EngineBuffer::MeshIndices => self.mesh_indices,
        }
    }
}

/// A pass, ready to draw.
#[derive(Debug)]
pub struct CompiledPass {
    /// Its GPU pipelines.
    pub pipelines: PassPipelines,
    /// The same for scenes with reflection models beside the default one, where the pass lights
    /// surfaces that another pass has drawn. Geometry passes choose by material instead: see
    /// [`crate::variant::Variant`].
    pub for_other_models: Option<PassPipelines>,
    /// What group 1 holds.
    pub sources: Vec<(u32, Source)>,
    /// The layout of group 1.
    pub target_layout: Option<wgpu::BindGroupLayout>,
    /// Group 1, for the current targets.
    pub target_group: Option<wgpu::BindGroup>,
    /// Group 2.
    pub parameters: Option<ParameterBlock>,
    /// Views of what it draws to, for the current targets.
    pub attachments: Attachments,
    /// Workgroups of a compute pass along x, y and z.
    pub workgroups: [u32; 3],
    /// Which of the frame's lists of objects or lights the pass draws.
    pub list: Option<usize>,
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
            target_group: None,
            parameters,
            attachments: Attachments::default(),
            workgroups: [1; 3],
            list: None,
        }
    }

    /// Its GPU pipelines for a scene. `other_models` is whether it has reflection models beside the
    /// default one.
    pub fn pipelines(&self, other_models: bool) -> &PassPipelines {
        match &self.for_other_models {
            Some(pipelines) if other_models => pipelines,
            _ => &self.pipelines,
        }
    }

    /// Binds what the pass reads and writes.
    fn bind(&mut self, gpu: &Gpu, desc: &PassDesc, targets: &Targets, engine: EngineBuffers<'_>) {
        self.attachments = Attachments::new(desc, targets);
        self.workgroups = workgroups(desc, &self.pipelines, targets);
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
        self.target_group = Some(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("targets"),
            layout,
            entries: &entries,
        }));
    }

    /// The views and groups of a `mips` pass.
    fn bind_levels(&mut self, gpu: &Gpu, desc: &PassDesc, targets: &Targets) {
        let (PassPipelines::Mips { layout, levels, .. }, PassKind::Mips { target, .. }) =
            (&mut self.pipelines, &desc.kind)
        else {
            return;
        };
        levels.clear();
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

/// Where a value is in a list, to which it is added if it is not there.
fn position<T: PartialEq>(list: &mut Vec<T>, value: T) -> usize {
    let known = list.iter().position(|other| *other == value);
    known.unwrap_or_else(|| {
        list.push(value);
        list.len() - 1
    })
}

fn view(source: &Source, targets: &Targets) -> Option<wgpu::TextureView> {
    match source {
        Source::Target {
            target,
            texture,
            mip,
            layer,
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
    let (PassKind::Compute(dispatch), PassPipelines::Compute { workgroup, .. }) =
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

/// A pipeline that can draw.
#[derive(Debug)]
pub struct Pipeline {
    /// What it was compiled from, with the parameter values in force and the formats that the
    /// adapter can do.
    pub desc: PipelineDesc,
    /// The same as it was written.
    declared: PipelineDesc,
    /// Where another format took a target's place, in a sentence each.
    pub notes: Vec<String>,
    /// In the order of the description.
    pub(crate) passes: Vec<CompiledPass>,
    /// The lists of objects that its geometry passes need, each once.
    pub(crate) lists: Vec<ListKey>,
    /// The lists of lights that its lights passes need, each once.
    pub(crate) light_lists: Vec<Lights>,
    /// The reflection models that it carries.
    pub(crate) models: ReflectionModels,
    /// What was told of materials that are drawn with another model.
    pub(crate) told_models: ReplacedModels,
    lives: Lives,
    targets: Option<Targets>,
    engine_revision: u64,
    share_textures: bool,
    history_frames: u32,
    /// What shaders saw as `frame_index`.
    last_frame: Option<u32>,
    /// Words that each buffer must have at least, as counters said.
    grown: Vec<u64>,
    /// Whether a buffer is smaller than that.
    outgrown: bool,
    /// The first of the frames that it drew without another pipeline between.
    run_began: u32,
    /// The pass that ends a frame, if not the last one.
    last_pass: Option<usize>,
}

impl Pipeline {
    pub(crate) fn new(
        declared: PipelineDesc,
        desc: PipelineDesc,
        notes: Vec<String>,
        mut passes: Vec<CompiledPass>,
    ) -> Self {
        let (mut lists, mut light_lists) = (Vec::new(), Vec::new());
        for (pass, compiled) in desc.passes.iter().zip(&mut passes) {
            compiled.list = match &pass.kind {
                PassKind::Lights(lights) => Some(position(&mut light_lists, lights.clone())),
                _ => ListKey::of(pass).map(|key| position(&mut lists, key)),
            };
        }
        Self {
            lives: Lives::of(&desc),
            models: desc.reflection_models(),
            told_models: ReplacedModels::default(),
            grown: vec![0; desc.buffers.len()],
            desc,
            declared,
            notes,
            passes,
            lists,
            light_lists,
            targets: None,
            engine_revision: 0,
            share_textures: true,
            history_frames: 0,
            last_frame: None,
            outgrown: false,
            run_began: 0,
            last_pass: None,
        }
    }

    /// The targets of the last frame.
    pub fn targets(&self) -> Option<&Targets> {
        self.targets.as_ref()
    }

    /// Which passes run: the others' results reach neither the picture nor a counter.
    pub fn lives(&self) -> &Lives {
        &self.lives
    }

    /// Gives each target a texture of its own, so that all can be read after the frame; or lets
    /// targets share textures again, which is how a pipeline begins.
    pub fn keep_all_targets(&mut self, keep: bool) {
        if self.share_textures == keep {
            self.share_textures = !keep;
            self.targets = None;
        }
    }

    /// Ends each frame after that pass, counted from 0, so that targets can be read as it leaves
    /// them; or runs all passes again.
    pub fn stop_after(&mut self, pass: Option<usize>) {
        self.last_pass = pass;
    }

    /// Whether a pass runs, if nobody looks at its results: passes that nobody needs run only where
    /// all targets are kept.
    pub(crate) fn runs(&self, pass: usize) -> bool {
        let needed = self.lives.needed.get(pass).copied().unwrap_or(false);
        (needed || !self.share_textures) && self.last_pass.is_none_or(|last| pass <= last)
    }

    /// Frames whose results `history` targets hold; 0 in the first frame and after a change of
    /// size.
    pub fn history_frames(&self) -> u32 {
        self.history_frames
    }

    /// Takes over parameter values from a description of the same structure.
    ///
    /// Returns false, and changes nothing, if the structure differs: then it must be compiled.
    pub fn adopt_values(&mut self, desc: &PipelineDesc) -> bool {
        let same = self.declared.same_structure(desc);
        if same {
            self.desc.parameters.clone_from(&desc.parameters);
            self.declared.clone_from(desc);
        }
        same
    }

    /// Makes room where a counter asked for more words than its buffer has, and says whether it
    /// did: then the frame should be drawn again.
    pub fn grow(&mut self, measured: &[Measured]) -> bool {
        let Some(targets) = &self.targets else {
            return false;
        };
        let mut outgrown = false;
        for (index, buffer) in self.desc.buffers.iter().enumerate() {
            let Some(by) = &buffer.grows_with else {
                continue;
            };
            let counter = self.desc.counters.iter().position(|c| c.name == by.name);
            let wanted = counter.and_then(|counter| {
                // Results of frames that another pipeline drew count something else.
                let own = measured.iter().filter(|m| m.frame >= self.run_began);
                let counts = own.filter_map(|m| m.counters.get(counter));
                counts.max().copied()
            });
            let has = targets.buffer(&buffer.name).map_or(0, |b| b.size() / 4);
            if let Some(wanted) = wanted.map(u64::from).filter(|wanted| *wanted > has) {
                // Half as much again, so that a scene that grows slowly does not do so each frame.
                self.grown[index] = wanted + wanted / 2;
                outgrown = true;
            }
        }
        self.outgrown |= outgrown;
        outgrown
    }

    /// Whether a buffer may turn out to be too small for a frame.
    pub fn may_outgrow(&self) -> bool {
        self.desc.buffers.iter().any(|b| b.grows_with.is_some())
    }

    /// Makes targets, bindings and parameters ready for a frame of that size and that number of
    /// lights.
    pub(crate) fn prepare(
        &mut self,
        gpu: &Gpu,
        engine: EngineBuffers<'_>,
        size: (u32, u32),
        lights: u32,
        (serial, index): (u32, u32),
    ) -> &Targets {
        let depends_on_lights = self.depends_on_lights();
        let fits = |targets: &Targets| {
            targets.size == size && (lights <= targets.lights || !depends_on_lights)
        };
        let fresh = self.targets.take().filter(fits);
        let same_engine = self.engine_revision == engine.revision;
        // The same frame may be drawn again.
        let followed = self
            .last_frame
            .is_some_and(|last| last.wrapping_add(1) == index || last == index);
        if fresh.is_none() || !followed {
            self.history_frames = 0;
        } else if self.last_frame != Some(index) {
            self.history_frames = self.history_frames.saturating_add(1);
        }
        if !followed {
            self.run_began = serial;
        }
        self.last_frame = Some(index);
        let outgrown = std::mem::take(&mut self.outgrown);
        let rebind = fresh.is_none() || !same_engine || outgrown;
        let mut targets = fresh.unwrap_or_else(|| {
            let room = if depends_on_lights {
                lights.next_power_of_two()
            } else {
                lights
            };
            let words: Vec<u64> = self
                .desc
                .buffers
                .iter()
                .zip(&self.grown)
                .map(|(buffer, grown)| buffer.size.resolve(size, room).max(*grown))
                .collect();
            let lives = self.share_textures.then_some(&self.lives);
            Targets::new(gpu, &self.desc, lives, size, room, &words)
        });
        if outgrown {
            targets.grow_buffers(gpu, &self.desc, &self.grown);
        }
        if rebind {
            for (desc, pass) in self.desc.passes.iter().zip(&mut self.passes) {
                pass.bind(gpu, desc, &targets, engine);
            }
            self.engine_revision = engine.revision;
        }
        for pass in &mut self.passes {
            if let Some(parameters) = &mut pass.parameters {
                parameters.upload(gpu, &self.desc);
            }
        }
        self.targets.insert(targets)
    }

    /// Whether a buffer or a dispatch is sized by the number of lights.
    fn depends_on_lights(&self) -> bool {
        let buffers = self.desc.buffers.iter();
        buffers
            .map(|buffer| buffer.size)
            .any(|size| matches!(size, crate::description::BufferSize::PerLight(_)))
            || self.desc.passes.iter().any(|pass| {
                matches!(
                    pass.kind,
                    PassKind::Compute(
                        Dispatch::Threads(Amount::Lights) | Dispatch::Groups(Amount::Lights)
                    )
                )
            })
    }
}
