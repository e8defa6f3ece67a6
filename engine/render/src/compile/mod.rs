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
mod state;

use std::collections::HashMap;

use lightbench_assets::files::Files;

use crate::binding::{Reflected, Source, bind, check_shader, target_layout};
use crate::description::{Define, PassDesc, PassKind, PipelineDesc, ShaderDesc};
use crate::fallback::settle_formats;
use crate::gpu::Gpu;
use crate::layout::SceneLayout;
use crate::parameters::ParameterBlock;
use crate::pipeline::{CompiledPass, PassPipelines, Pipeline};
use crate::problem::{Problem, Problems, nearest};
use crate::reflection::{ParameterMember, Reflection, reflect};
use crate::shader::{Shader, ShaderComposer};
use crate::validate::validate;
use cache::PipelineCache;

pub use state::DrawPipeline;

/// The vertex stages that passes use whose shader brings none.
const GEOMETRY_VERTEX: &str = "shaders/vertex/geometry.wgsl";
const FULLSCREEN_VERTEX: &str = "shaders/vertex/fullscreen.wgsl";
const LIGHT_VERTEX: &str = "shaders/vertex/light_volume.wgsl";

/// A composed shader on the device.
struct LoadedShader {
    shader: Shader,
    reflection: Reflection,
    module: wgpu::ShaderModule,
    /// Differs where the text of the shader, of a module or a define differs.
    fingerprint: u64,
}

impl LoadedShader {
    fn reflected(&self) -> Reflected<'_> {
        (&self.shader, &self.reflection)
    }
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
        }
    }

    /// Forgets shaders that depend on a changed file: that shader, or all after a module changed.
    pub fn forget(&mut self, changed: &str) {
        if changed.starts_with("shaders/lib/") {
            self.composer = None;
            self.shaders.clear();
        } else {
            self.shaders.retain(|(path, ..), _| path != changed);
        }
    }

    /// Builds a pipeline.
    ///
    /// # Errors
    /// All mistakes of the description; else the first mistake of each shader.
    pub fn compile(&mut self, files: &Files, desc: &PipelineDesc) -> Result<Pipeline, Problems> {
        let declared = desc;
        let mut desc = declared.clone();
        let notes = settle_formats(&mut desc, &self.gpu);
        let desc = &desc;
        let mut problems = Vec::new();
        let mut passes = Vec::new();
        if let Err(found) = validate(desc, &self.gpu) {
            problems = found.0;
            problems.extend(self.shader_problems(files, desc));
        } else {
            self.built.begin();
            for pass in &desc.passes {
                match self.pass(files, desc, pass) {
                    Ok(compiled) => passes.push(compiled),
                    Err(found) => problems.extend(found),
                }
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
            Ok(Pipeline::new(declared.clone(), desc.clone(), notes, passes))
        } else {
            Err(Problems(problems).with_sources(files))
        }
    }

    /// The first mistake of each shader by itself, for a description that has mistakes too.
    fn shader_problems(&mut self, files: &Files, desc: &PipelineDesc) -> Vec<Problem> {
        let shaders = desc.passes.iter().filter_map(|pass| pass.shader.as_ref());
        shaders
            .filter_map(|shader| {
                let known = shader_file(files, shader);
                let loaded = known.and_then(|()| {
                    self.load(files, &shader.path, &[], &shader.defines)
                        .map(|_| ())
                });
                loaded.err()
            })
            .collect()
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
        Ok(&self.shaders[&key])
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
            None => self
                .composer
                .insert(ShaderComposer::new(files, self.gpu.capabilities())?),
        };
        let defines: Vec<Define> = variant
            .iter()
            .map(|name| Define::flag(*name))
            .chain(defines.iter().cloned())
            .collect();
        let shader = composer.compose(files, path, &defines)?;
        let reflection = reflect(&shader);
        check_shader(&reflection, &self.gpu.device.limits())?;
        let fingerprint = composer.fingerprint(&shader.text, &defines);
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
                Problem::new(crate::Place::file(path), refusal(&error))
                    .with_hint("another way to write the same may work")
            })?;
        Ok(LoadedShader {
            shader,
            reflection,
            module,
            fingerprint,
        })
    }

    fn pass(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
    ) -> Result<CompiledPass, Vec<Problem>> {
        let one = |problem: Problem| vec![problem];
        let mut sources = Vec::new();
        let mut parameters = None;
        if let Some(shader) = &pass.shader {
            shader_file(files, shader).map_err(one)?;
            (sources, parameters) = self.bind(files, desc, pass, shader)?;
        }

        let target_layout = self
            .gpu
            .guarded(|| target_layout(&self.gpu, &sources, desc, pass))
            .map_err(|error| one(Problem::new(pass.at.clone(), refusal(&error))))?;
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
        let pipelines = match &pass.kind {
            PassKind::Geometry(geometry) => self.geometry(files, desc, pass, geometry, &layout),
            PassKind::Lights(lights) => self.lights(files, desc, pass, lights, &layout),
            PassKind::Fullscreen => self.fullscreen(files, desc, pass, &layout),
            PassKind::Compute(_) => self.compute(files, pass, &layout),
            PassKind::Mips { target, reduction } => {
                self.mips(files, desc, pass, &target.target, *reduction)
            }
            PassKind::Clear
            | PassKind::Copy { .. }
            | PassKind::Resolve { .. }
            | PassKind::History { .. } => Ok(PassPipelines::None),
        }
        .map_err(one)?;
        Ok(CompiledPass::new(
            pipelines,
            sources,
            target_layout,
            parameters,
        ))
    }

    /// Finds what the variables of a pass's shader stand for, in all variants of it that the pass
    /// may draw with.
    fn bind(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        shader: &ShaderDesc,
    ) -> Result<Bound, Vec<Problem>> {
        let variants: &[&[&'static str]] = match pass.kind {
            PassKind::Geometry(_) => &[&[], &["ALPHA_TEST"]],
            _ => &[&[]],
        };
        let mut first: Option<Bound> = None;
        for variant in variants {
            let gpu = self.gpu.clone();
            let loaded = self
                .load(files, &shader.path, variant, &shader.defines)
                .map_err(|problem| vec![problem])?;
            let (shader, reflection) = (&loaded.shader, &loaded.reflection);
            let sources = bind(desc, pass, shader, reflection, &gpu)?;
            let bound = (sources, reflection.parameters.clone());
            match &first {
                None => first = Some(bound),
                Some(first) if *first == bound => {}
                Some(_) => return Err(vec![other_variant(pass, reflection)]),
            }
        }
        Ok(first.unwrap_or_default())
    }
}

/// What group 1 of a pass holds, and the members and size of its parameters.
type Bound = (Vec<(u32, Source)>, Option<(Vec<ParameterMember>, u32)>);

/// The shader's file may be missing: that is a mistake in the pipeline, not in the shader.
fn shader_file(files: &Files, shader: &ShaderDesc) -> Result<(), Problem> {
    if files.exists(&shader.path) {
        return Ok(());
    }
    let known = files.list("shaders", "wgsl").unwrap_or_default();
    let known = || known.iter().map(|entry| entry.path.as_str());
    let path = shader.path.as_str();
    let name = |path: &'_ str| path.rsplit('/').next().unwrap_or(path).replace(".wgsl", "");
    // Files of one folder have long paths that are nearly the same: only their names are compared.
    let wanted = name(path);
    let names: Vec<String> = known().map(name).collect();
    let near = nearest(&wanted, names.iter().map(String::as_str));
    let near = near.and_then(|near| known().find(|path| name(path) == near));
    let hint = match near {
        Some(near) => format!("did you mean `{near}`?"),
        None => "write the file, or name one of `lightbench list files`".to_owned(),
    };
    Err(Problem::new(shader.at.clone(), format!("there is no shader `{path}`")).with_hint(hint))
}

/// The variant for materials with holes asks for other things than the one for all others.
fn other_variant(pass: &PassDesc, reflection: &Reflection) -> Problem {
    // What the first variant of the shader has in its place was given by the pass.
    let mut variables = reflection.variables.iter().filter(|v| v.group > 0);
    let known = |name: &String| {
        pass.reads.iter().any(|read| read.variable == *name)
            || pass.updates.iter().any(|update| update.variable == *name)
    };
    let found = variables.clone().find(|v| !known(&v.name));
    let found = found.or_else(|| variables.next());
    let place = found.map_or_else(|| pass.at.clone(), |variable| variable.at.clone());
    Problem::new(
        place,
        "this shader asks for one thing with ALPHA_TEST and for another without",
    )
    .with_hint("declare variables of groups 1 and 2 outside of `#ifdef ALPHA_TEST`")
}

/// A refusal of the device that nobody foresaw. Its words are for those who mend the program.
fn refusal(error: &str) -> String {
    tracing::error!("{error}");
    "the device refuses this, and the program can't tell why".to_owned()
}
