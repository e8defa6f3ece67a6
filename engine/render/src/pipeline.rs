//! A compiled pipeline: what [`crate::compile::Compiler`] builds and [`crate::record`] runs.

use std::collections::BTreeSet;

use lightbench_assets::ReflectionModels;

use crate::binding::{EngineBuffer, Source};
use crate::compiled_pass::CompiledPass;
use crate::description::{Amount, Dispatch, Lights, PassKind, PipelineDesc};
use crate::engine_buffers::EngineBuffers;
use crate::frame::{ListKey, ShadowKey};
use crate::gpu::Gpu;
use crate::life::Lives;
use crate::queries::Measured;
use crate::scene::ReplacedModels;
use crate::series::{Continuity, FIRST_SERIES, Resting};
use crate::targets::Targets;
use crate::variant::Variants;

/// Where a value is in a list, to which it is added if it is not there.
fn position<T: PartialEq>(list: &mut Vec<T>, value: T) -> usize {
    let known = list.iter().position(|other| *other == value);
    known.unwrap_or_else(|| {
        list.push(value);
        list.len() - 1
    })
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
    /// The variants of meshes that it can draw.
    variants: Variants,
    /// Paths of everything that it was made from: scripts, shaders, modules.
    files: BTreeSet<String>,
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
    /// The views that its shadow passes draw, each once.
    pub(crate) shadow_lists: Vec<ShadowKey>,
    lives: Lives,
    share_textures: bool,
    /// What it keeps of the series that it draws: the first one, but for the time of a frame.
    series: Continuity,
    /// The same of the others, in their order.
    resting: Vec<Resting>,
    /// The pass that ends a frame, if not the last one.
    last_pass: Option<usize>,
}

impl Pipeline {
    pub(crate) fn new(
        declared: PipelineDesc,
        desc: PipelineDesc,
        notes: Vec<String>,
        mut passes: Vec<CompiledPass>,
        variants: Variants,
        files: BTreeSet<String>,
    ) -> Self {
        let (mut lists, mut light_lists) = (Vec::new(), Vec::new());
        let mut shadow_lists = Vec::new();
        for (pass, compiled) in desc.passes.iter().zip(&mut passes) {
            compiled.list = match &pass.kind {
                PassKind::Lights(lights) => Some(position(&mut light_lists, lights.clone())),
                PassKind::Shadow(_) => {
                    let key = ShadowKey::of(&desc, pass);
                    key.map(|key| position(&mut shadow_lists, key))
                }
                _ => ListKey::of(pass).map(|key| position(&mut lists, key)),
            };
        }
        Self {
            lives: Lives::of(&desc),
            models: desc.reflection_models(),
            told_models: ReplacedModels::default(),
            series: Continuity::new(desc.buffers.len()),
            resting: Vec::new(),
            desc,
            declared,
            notes,
            variants,
            files,
            passes,
            lists,
            light_lists,
            shadow_lists,
            share_textures: true,
            last_pass: None,
        }
    }

    /// The targets of the last frame.
    pub fn targets(&self) -> Option<&Targets> {
        self.series.targets.as_ref()
    }

    /// The targets of the last frame of a series: see [`crate::series`].
    pub fn targets_of(&self, series: usize) -> Option<&Targets> {
        match series.checked_sub(1) {
            None => self.targets(),
            Some(other) => self.resting.get(other)?.continuity.targets.as_ref(),
        }
    }

    /// Begins to draw another series than the first; once more ends it.
    pub(crate) fn swap_series(&mut self, series: usize) {
        let Some(other) = series.checked_sub(1) else {
            return;
        };
        let (buffers, passes) = (self.desc.buffers.len(), self.passes.len());
        while self.resting.len() <= other {
            self.resting.push(Resting::new(buffers, passes));
        }
        self.resting[other].swap(&mut self.series, &mut self.passes);
    }

    /// The variants of meshes that it can draw.
    pub fn variants(&self) -> Variants {
        self.variants
    }

    /// Paths of everything that it was made from: scripts, shaders and the modules that they
    /// import.
    pub fn files(&self) -> &BTreeSet<String> {
        &self.files
    }

    /// The buffers of the engine that its shaders bind.
    pub fn engine_buffers(&self) -> impl Iterator<Item = EngineBuffer> + '_ {
        let sources = self.passes.iter().flat_map(|pass| &pass.sources);
        sources.filter_map(|(_, source)| match source {
            Source::Engine(which) => Some(*which),
            _ => None,
        })
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
            self.series.targets = None;
            for resting in &mut self.resting {
                resting.continuity.targets = None;
            }
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
        self.series.history_frames
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
    /// did: then the frame should be drawn again. All that was measured must be of the first series.
    pub fn grow(&mut self, measured: &[Measured]) -> bool {
        self.grow_in(FIRST_SERIES, measured)
    }

    /// The same for what was measured of another series.
    pub fn grow_in(&mut self, series: usize, measured: &[Measured]) -> bool {
        if measured.is_empty() {
            return false;
        }
        self.swap_series(series);
        let grew = self.grow_present(measured);
        self.swap_series(series);
        grew
    }

    fn grow_present(&mut self, measured: &[Measured]) -> bool {
        let state = &mut self.series;
        let Some(targets) = &state.targets else {
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
                let own = measured.iter().filter(|m| m.frame >= state.run_began);
                let counts = own.filter_map(|m| m.counters.get(counter));
                counts.max().copied()
            });
            let has = targets.buffer(&buffer.name).map_or(0, |b| b.size() / 4);
            if let Some(wanted) = wanted.map(u64::from).filter(|wanted| *wanted > has) {
                // Half as much again, so that a scene that grows slowly does not do so each frame.
                state.grown[index] = wanted + wanted / 2;
                outgrown = true;
            }
        }
        state.outgrown |= outgrown;
        outgrown
    }

    /// Whether a buffer may turn out to be too small for a frame.
    pub fn may_outgrow(&self) -> bool {
        self.desc.buffers.iter().any(|b| b.grows_with.is_some())
    }

    /// Notes that a frame begins: its number in [`Measured::frame`] and what shaders see as
    /// `frame_index`. History lasts while frames follow each other; the same one may be drawn again.
    pub(crate) fn begin_frame(&mut self, serial: u32, index: u32) {
        let state = &mut self.series;
        let followed = state
            .last_frame
            .is_some_and(|last| last.wrapping_add(1) == index || last == index);
        if !followed {
            state.history_frames = 0;
            state.run_began = serial;
        } else if state.last_frame != Some(index) {
            state.history_frames = state.history_frames.saturating_add(1);
        }
        state.last_frame = Some(index);
    }

    /// Makes targets, bindings and parameters ready for a frame of that size and that number of
    /// lights.
    pub(crate) fn prepare(
        &mut self,
        gpu: &Gpu,
        engine: EngineBuffers<'_>,
        size: (u32, u32),
        lights: u32,
    ) -> &Targets {
        let depends_on_lights = self.depends_on_lights();
        let fits = |targets: &Targets| {
            targets.size == size && (lights <= targets.lights || !depends_on_lights)
        };
        if let Some(targets) = self.targets() {
            self.shrink(targets.size, size);
        }
        let fresh = self.series.targets.take().filter(fits);
        let same_engine = self.series.engine_revision == engine.revision;
        if fresh.is_none() {
            self.series.last_frame = None;
        }
        let outgrown = std::mem::take(&mut self.series.outgrown);
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
                .zip(&self.series.grown)
                .map(|(buffer, grown)| buffer.size.resolve(size, room).max(*grown))
                .collect();
            let lives = self.share_textures.then_some(&self.lives);
            Targets::new(gpu, &self.desc, lives, size, room, &words)
        });
        if outgrown {
            targets.grow_buffers(gpu, &self.desc, &self.series.grown);
        }
        if rebind {
            for (desc, pass) in self.desc.passes.iter().zip(&mut self.passes) {
                pass.bind(gpu, desc, &targets, engine);
            }
            self.series.engine_revision = engine.revision;
        }
        for pass in &mut self.passes {
            if let Some(parameters) = &mut pass.parameters {
                parameters.upload(gpu, &self.desc);
            }
        }
        self.series.targets.insert(targets)
    }

    /// What buffers have grown to for a larger picture, a smaller one does not need.
    fn shrink(&mut self, from: (u32, u32), to: (u32, u32)) {
        let pixels = |(width, height): (u32, u32)| u64::from(width) * u64::from(height);
        let (before, after) = (pixels(from), pixels(to));
        if after < before {
            for words in &mut self.series.grown {
                *words = (*words * after).div_ceil(before);
            }
        }
    }

    /// Gives back the memory of all targets and buffers, until the next frame that this pipeline
    /// draws. Its history is lost.
    pub fn release_targets(&mut self) {
        self.series.release();
        self.resting.iter_mut().for_each(Resting::release);
    }

    /// The same for one series alone.
    pub fn release_series(&mut self, series: usize) {
        match series.checked_sub(1) {
            None => self.series.release(),
            Some(other) => {
                if let Some(resting) = self.resting.get_mut(other) {
                    resting.release();
                }
            }
        }
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
