//! From a description to GPU pipelines.
//!
//! Everything is checked before anything is built, and everything is built before anything is
//! replaced: a pipeline that fails to compile leaves the one on screen alone.

mod build;
mod cache;
mod compute;
mod fullscreen;
mod geometry;
mod lights;
mod mips;
mod shadow;
mod state;

use std::collections::{BTreeSet, HashMap};

use lightbench_assets::files::Files;

use crate::binding::{bind, target_layout};
use crate::compiled_pass::CompiledPass;
use crate::description::{Define, PassDesc, PassKind, PipelineDesc};
use crate::fallback::settle_formats;
use crate::fragment_counts::{COUNT_FRAGMENTS, count_fragments};
use crate::gpu::Gpu;
use crate::gpu_pipelines::PassPipelines;
use crate::layout::SceneLayout;
use crate::parameters::ParameterBlock;
use crate::pipeline::Pipeline;
use crate::problem::{Problem, Problems};
use crate::reflection::{Reflection, reflect};
use crate::shader::{MODULES, Shader, ShaderComposer};
use crate::validate::validate;
use crate::variant::{REFLECTION_MODELS, Variants};
use cache::PipelineCache;

/// The vertex stages that passes use whose shader brings none.
const GEOMETRY_VERTEX: &str = "shaders/vertex/geometry.wgsl";
const FULLSCREEN_VERTEX: &str = "shaders/vertex/fullscreen.wgsl";
const LIGHT_VERTEX: &str = "shaders/vertex/light_volume.wgsl";

/// A composed shader on the device.
struct LoadedShader {
    shader: Shader,
    reflection: Reflection,
    module: wgpu::ShaderModule,
}

/// A pipeline layout, and what tells it from others.
struct PassLayout {
    layout: wgpu::PipelineLayout,
    /// The formats that group 1 reads, and whether there is a group 2.
    key: String,
}

/// Compiles descriptions. Keeps composed modules until [`Compiler::forget`] is told that files
/// changed.
pub struct Compiler {
    gpu: Gpu,
    layout: SceneLayout,
    composer: Option<ShaderComposer>,
    shaders: HashMap<(String, Vec<&'static str>, Vec<Define>), LoadedShader>,
    /// Pipelines that were built, so that a save rebuilds only the passes that it touches, and
    /// going back to a text seen before rebuilds nothing.
    built: PipelineCache,
    /// The variants of meshes that the compilation at hand is for.
    variants: Variants,
    /// The shaders and modules that it has used.
    used: BTreeSet<String>,
}

impl Compiler {
    /// A compiler for one device.
    pub fn new(gpu: &Gpu, layout: &SceneLayout) -> Self {
        Self {
            gpu: gpu.clone(),
            layout: layout.clone(),
            composer: None,
            shaders: HashMap::new(),
            built: PipelineCache::default(),
            variants: Variants::ALL,
            used: BTreeSet::new(),
        }
    }

    /// Forgets shaders that depend on a changed file: that shader, or those that import the module.
    pub fn forget(&mut self, changed: &str) {
        if changed.starts_with(MODULES) {
            self.composer = None;
        }
        self.shaders.retain(|(path, ..), loaded| {
            path != changed && !loaded.shader.modules.iter().any(|module| module == changed)
        });
    }

    /// Builds a pipeline that can draw every mesh.
    ///
    /// # Errors
    /// All mistakes of the description; else the first mistake of each shader.
    pub fn compile(&mut self, files: &Files, desc: &PipelineDesc) -> Result<Pipeline, Problems> {
        self.compile_for(files, desc, Variants::ALL)
    }

    /// Builds a pipeline for those variants of meshes that a scene has. Others can be added later:
    /// what was built before is kept.
    ///
    /// # Errors
    /// As [`Compiler::compile`].
    pub fn compile_for(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        variants: Variants,
    ) -> Result<Pipeline, Problems> {
        self.variants = variants;
        self.used.clear();
        let declared = desc;
        let mut desc = declared.clone();
        let notes = settle_formats(&mut desc, &self.gpu);
        let desc = &desc;
        validate(desc, &self.gpu)?;
        self.built.begin();
        let mut problems = Vec::new();
        let mut passes = Vec::new();
        for pass in &desc.passes {
            match self.pass(files, desc, pass) {
                Ok(compiled) => passes.push(compiled),
                Err(found) => problems.extend(found),
            }
        }
        // Passes that share a shader share its mistakes.
        let mut seen = Vec::new();
        problems.retain(|problem| {
            !seen.contains(problem) && {
                seen.push(problem.clone());
                true
            }
        });
        if problems.is_empty() {
            let mut files = std::mem::take(&mut self.used);
            files.extend(desc.scripts.iter().cloned());
            Ok(Pipeline::new(
                declared.clone(),
                desc.clone(),
                notes,
                passes,
                variants,
                files,
            ))
        } else {
            Err(Problems(problems))
        }
    }

    /// Composes a shader unless it is known already.
    fn load(
        &mut self,
        files: &Files,
        path: &str,
        variant: &[&'static str],
        defines: &[Define],
    ) -> Result<&LoadedShader, Problem> {
        let key = (path.to_owned(), variant.to_vec(), defines.to_vec());
        if !self.shaders.contains_key(&key) {
            let loaded = self.compose(files, path, variant, defines)?;
            self.shaders.insert(key.clone(), loaded);
        }
        let loaded = &self.shaders[&key];
        self.used.insert(loaded.shader.path.clone());
        self.used.extend(loaded.shader.modules.iter().cloned());
        Ok(loaded)
    }

    fn compose(
        &mut self,
        files: &Files,
        path: &str,
        variant: &[&'static str],
        defines: &[Define],
    ) -> Result<LoadedShader, Problem> {
        let composer = match &mut self.composer {
            Some(composer) => composer,
            None => self.composer.insert(ShaderComposer::new(
                files,
                naga::valid::Capabilities::default(),
            )?),
        };
        let defines: Vec<Define> = variant
            .iter()
            .map(|name| Define::flag(*name))
            .chain(defines.iter().cloned())
            .collect();
        let mut shader = composer.compose(files, path, &defines)?;
        if defines.iter().any(|define| define.name == COUNT_FRAGMENTS) {
            count_fragments(&mut shader.module);
        }
        let reflection = reflect(&shader.module);
        let source = wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(shader.module.clone()));
        let module = self
            .gpu
            .guarded(|| {
                self.gpu
                    .device
                    .create_shader_module(wgpu::ShaderModuleDescriptor {
                        label: Some(path),
                        source,
                    })
            })
            .map_err(|error| {
                Problem::new(
                    crate::Place::file(path),
                    format!("the driver refuses the shader: {error}"),
                )
            })?;
        Ok(LoadedShader {
            shader,
            reflection,
            module,
        })
    }

    fn pass(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
    ) -> Result<CompiledPass, Vec<Problem>> {
        let one = |problem: Problem| vec![problem];
        // The shader's file may be missing: that is a mistake in the pipeline, not in the shader.
        let shader = pass.shader.as_ref();
        if let Some(shader) = shader
            && !files.exists(&shader.path)
        {
            let known = files.list("shaders", "wgsl").unwrap_or_default();
            let mut problem = Problem::new(
                shader.at.clone(),
                format!("there is no shader `{}`", shader.path),
            );
            problem.hint = crate::problem::suggestion(
                &shader.path,
                known.iter().map(|entry| entry.path.as_str()),
            );
            return Err(one(problem));
        }

        let mut sources = Vec::new();
        let mut parameters = None;
        if let Some(shader) = shader {
            let loaded = self
                .load(files, &shader.path, &[], &shader.defines)
                .map_err(one)?;
            let mut reflection = loaded.reflection.clone();
            // Alpha-tested materials may ask for more.
            if matches!(pass.kind, PassKind::Geometry(_)) {
                let tested = self
                    .load(files, &shader.path, &["ALPHA_TEST"], &shader.defines)
                    .map_err(one)?;
                reflection.add_bindings(&tested.reflection);
            }
            // So may surfaces with other reflection models.
            if self.variants.has_other_models() && self.has_other_models(desc, pass) {
                let others = self
                    .load(files, &shader.path, &[REFLECTION_MODELS], &shader.defines)
                    .map_err(one)?;
                reflection.add_bindings(&others.reflection);
            }
            let loaded = &self.shaders[&(shader.path.clone(), Vec::new(), shader.defines.clone())];
            sources = bind(desc, pass, &loaded.shader, &reflection)?;
            parameters = reflection.parameters;
        }

        let target_layout = target_layout(&self.gpu, &sources, desc, pass);
        let formats: Vec<_> = pass
            .reads
            .iter()
            .map(|read| &read.target)
            .chain(pass.updates.iter().map(|update| &update.target))
            .filter_map(|name| Some(desc.target(name)?.format))
            .collect();
        let key = format!("{sources:?} {formats:?} {}", parameters.is_some());
        let parameters =
            parameters.map(|(members, size)| ParameterBlock::new(&self.gpu, members, size));
        let layout = self
            .gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(&pass.name),
                bind_group_layouts: &[
                    Some(&self.layout.group),
                    target_layout.as_ref(),
                    parameters.as_ref().map(|parameters| &parameters.layout),
                ],
                immediate_size: 0,
            });
        let layout = PassLayout { layout, key };
        let pipelines = self.pipelines(files, desc, pass, &layout).map_err(one)?;
        let mut compiled = CompiledPass::new(pipelines, sources, target_layout, parameters);
        let lights = matches!(
            pass.kind,
            PassKind::Lights(_) | PassKind::Fullscreen | PassKind::Compute(_)
        );
        if lights && self.variants.has_other_models() && self.has_other_models(desc, pass) {
            let mut pass = pass.clone();
            if let Some(shader) = &mut pass.shader {
                shader.defines.push(Define::flag(REFLECTION_MODELS));
            }
            let pipelines = self.pipelines(files, desc, &pass, &layout).map_err(one)?;
            compiled.for_other_models = Some(pipelines);
        }
        Ok(compiled)
    }

    fn pipelines(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        layout: &PassLayout,
    ) -> Result<PassPipelines, Problem> {
        match &pass.kind {
            PassKind::Geometry(geometry) => self.geometry(files, desc, pass, geometry, layout),
            PassKind::Lights(lights) => self.lights(files, desc, pass, lights, layout),
            PassKind::Shadow(shadow) => self.shadow(files, desc, pass, shadow, layout),
            PassKind::Fullscreen => self.fullscreen(files, desc, pass, layout),
            PassKind::Compute(_) => self.compute(files, pass, layout),
            PassKind::Mips { target, reduction } => {
                self.mips(files, desc, pass, &target.target, *reduction)
            }
            PassKind::Clear
            | PassKind::Copy { .. }
            | PassKind::Resolve { .. }
            | PassKind::History { .. } => Ok(PassPipelines::None),
        }
    }

    /// Whether the pass draws reflection models beside the default one, so that it needs GPU pipelines
    /// for them: the pipeline carries some, and the shader tells them apart.
    fn has_other_models(&self, desc: &PipelineDesc, pass: &PassDesc) -> bool {
        if !desc.reflection_models().has_others() {
            return false;
        }
        let loaded = pass.shader.as_ref().and_then(|shader| {
            let key = (shader.path.clone(), Vec::new(), shader.defines.clone());
            self.shaders.get(&key)
        });
        let composer = self.composer.as_ref();
        composer
            .zip(loaded)
            .is_some_and(|(composer, loaded)| composer.mentions(&loaded.shader, REFLECTION_MODELS))
    }
}
