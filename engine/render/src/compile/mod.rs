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

use crate::binding::{Reflected, Source, bind, check_shader, target_layout};
use crate::compiled_pass::CompiledPass;
use crate::description::{Define, PassDesc, PassKind, PipelineDesc, ShaderDesc};
use crate::fallback::settle_formats;
use crate::fragment_counts::{COUNT_FRAGMENTS, count_fragments};
use crate::gpu::Gpu;
use crate::gpu_pipelines::PassPipelines;
use crate::layout::SceneLayout;
use crate::parameters::ParameterBlock;
use crate::pipeline::Pipeline;
use crate::problem::{Place, Problem, Problems, nearest};
use crate::reflection::{ParameterMember, Reflection, reflect};
use crate::shader::{MODULES, Shader, ShaderComposer};
use crate::validate::validate;
use crate::variant::{REFLECTION_MODELS, Variants};
use cache::PipelineCache;

/// The vertex stages that passes use whose shader brings none.
const GEOMETRY_VERTEX: &str = "shaders/vertex/geometry.wgsl";
pub(crate) const FULLSCREEN_VERTEX: &str = "shaders/vertex/fullscreen.wgsl";
const LIGHT_VERTEX: &str = "shaders/vertex/light_volume.wgsl";
/// The define that lets it cover the screen, for lights without bounds.
const FULL_SCREEN: &str = "FULL_SCREEN";

/// A composed shader on the device.
struct LoadedShader {
    shader: Shader,
    reflection: Reflection,
    module: wgpu::ShaderModule,
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
            None => self
                .composer
                .insert(ShaderComposer::new(files, self.gpu.capabilities())?),
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
        let reflection = reflect(&shader);
        check_shader(&reflection, &self.gpu.device.limits())?;
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
                Problem::new(Place::file(path), refusal(&error))
                    .with_hint("another way to write the same may work")
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
        let pass = &shadow::with_shader(pass);
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
        loaded.is_some_and(|loaded| loaded.shader.mentions(REFLECTION_MODELS))
    }

    /// Finds what the variables of a pass's shader stand for. All variants of it that the pass may
    /// draw with share one layout, which has what any of them asks for.
    fn bind(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        shader: &ShaderDesc,
    ) -> Result<Bound, Vec<Problem>> {
        let mut variants: Vec<&[&'static str]> = match pass.kind {
            PassKind::Geometry(_) | PassKind::Shadow(_) => vec![&[], &["ALPHA_TEST"]],
            _ => vec![&[]],
        };
        self.load(files, &shader.path, &[], &shader.defines)
            .map_err(|problem| vec![problem])?;
        if self.variants.has_other_models() && self.has_other_models(desc, pass) {
            variants.push(&[REFLECTION_MODELS]);
        }
        let mut all: Option<Reflection> = None;
        for variant in &variants {
            let loaded = self
                .load(files, &shader.path, variant, &shader.defines)
                .map_err(|problem| vec![problem])?;
            match &mut all {
                None => all = Some(loaded.reflection.clone()),
                Some(all) => all
                    .add_variant(&loaded.reflection)
                    .map_err(|place| vec![other_variant(place)])?,
            }
        }
        let mut all = all.unwrap_or_default();
        let mut sources = Vec::new();
        let gpu = self.gpu.clone();
        for variant in &variants {
            let loaded = self
                .load(files, &shader.path, variant, &shader.defines)
                .map_err(|problem| vec![problem])?;
            // Each has entry points of its own, for textures that any may filter.
            let own = loaded.reflection.entry_points.iter();
            let shared = std::mem::take(&mut all.entry_points);
            all.entry_points = own
                .map(|entry| {
                    let mut entry = entry.clone();
                    let same = shared.iter().filter(|other| other.stage == entry.stage);
                    entry.samples.extend(same.flat_map(|other| &other.samples));
                    entry
                })
                .collect();
            sources = bind(desc, pass, &loaded.shader, &all, &gpu)?;
        }
        Ok((sources, all.parameters))
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

/// The variant for materials with holes binds something where the one for all others binds another.
fn other_variant(place: Place) -> Problem {
    Problem::new(
        place,
        "this shader asks for one thing with ALPHA_TEST and for another without",
    )
    .with_hint(
        "what only one of them needs takes a binding of its own; group 2 is the same for both",
    )
}

/// A refusal of the device that nobody foresaw. Its words are for those who mend the program.
fn refusal(error: &str) -> String {
    tracing::error!("{error}");
    "the device refuses this, and the program can't tell why".to_owned()
}
