//! From a description to GPU pipelines.
//!
//! Everything is checked before anything is built, and everything is built before anything is
//! replaced: a pipeline that fails to compile leaves the one on screen alone.

mod cache;
mod state;

use std::collections::HashMap;

use lightbench_assets::files::Files;

use crate::binding::{bind, target_layout};
use crate::description::{PassDesc, PassKind, PipelineDesc, ShaderDesc};
use crate::gpu::Gpu;
use crate::layout::SceneLayout;
use crate::pipeline::{CompiledPass, LightPipelines, ParameterBlock, PassPipelines, Pipeline};
use crate::problem::{Problem, Problems};
use crate::reflection::{FRAGMENT_ENTRY, Reflection, VERTEX_ENTRY, reflect};
use crate::shader::{Shader, ShaderComposer};
use crate::validate::validate;
use crate::variant::Variant;
use cache::{PipelineCache, PipelineKey};
use state::{State, VertexStreams, blend, compare};

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
    shaders: HashMap<(String, Vec<&'static str>, Vec<String>), LoadedShader>,
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
            Ok(Pipeline::new(desc.clone(), passes))
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
        defines: &[String],
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
        defines: &[String],
    ) -> Result<LoadedShader, Problem> {
        let composer = match &mut self.composer {
            Some(composer) => composer,
            None => self.composer.insert(ShaderComposer::new(
                files,
                naga::valid::Capabilities::default(),
            )?),
        };
        let defines: Vec<&str> = variant
            .iter()
            .copied()
            .chain(defines.iter().map(String::as_str))
            .collect();
        let shader = composer.compose(files, path, &defines)?;
        let reflection = reflect(&shader.module);
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
                Problem::new(
                    crate::Place::file(path),
                    format!("the driver refuses the shader: {error}"),
                )
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
            sources = bind(desc, pass, &loaded.shader, &loaded.reflection)?;
            parameters = loaded.reflection.parameters.clone();
        }

        let target_layout = target_layout(&self.gpu, &sources, desc);
        let formats: Vec<_> = pass
            .reads
            .iter()
            .filter_map(|read| Some(desc.target(&read.target)?.format))
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
            PassKind::Geometry { .. } => self.geometry(files, desc, pass, &layout),
            PassKind::Lights { .. } => self.lights(files, desc, pass, &layout),
            PassKind::Fullscreen => self.fullscreen(files, desc, pass, &layout),
        }
        .map_err(one)?;
        Ok(CompiledPass::new(
            pipelines,
            sources,
            target_layout,
            parameters,
        ))
    }

    /// One pipeline for each way in which the materials of a scene can be drawn.
    fn geometry(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        layout: &PassLayout,
    ) -> Result<PassPipelines, Problem> {
        let mut variants = Vec::with_capacity(Variant::COUNT);
        for variant in Variant::all() {
            // Without colours and without holes there is nothing for a fragment stage to do.
            let fragment = pass
                .shader
                .as_ref()
                .filter(|_| !pass.colors.is_empty() || variant.alpha_test());
            let depth_only = fragment.is_none();
            let state = State {
                fragment_defines: variant.defines(),
                vertex_path: GEOMETRY_VERTEX,
                vertex_defines: if depth_only { &["POSITION_ONLY"] } else { &[] },
                own_vertex: true,
                cull: if variant.two_sided() {
                    None
                } else {
                    Some(wgpu::Face::Back)
                },
                front: if variant.mirrored() {
                    wgpu::FrontFace::Cw
                } else {
                    wgpu::FrontFace::Ccw
                },
                depth_compare: pass.depth.as_ref().map(|depth| compare(depth.compare)),
            };
            variants.push(self.build(files, desc, pass, fragment, layout, &state)?);
        }
        Ok(PassPipelines::Geometry(variants))
    }

    /// Back faces, front faces and the whole screen; which light takes which is decided per frame.
    fn lights(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        layout: &PassLayout,
    ) -> Result<PassPipelines, Problem> {
        let has_depth = pass.depth.is_some();
        let mut build = |cull, test, defines: &'static [&'static str]| {
            let state = State {
                fragment_defines: &[],
                vertex_path: LIGHT_VERTEX,
                vertex_defines: defines,
                own_vertex: false,
                cull,
                front: wgpu::FrontFace::Ccw,
                depth_compare: has_depth.then_some(test),
            };
            self.build(files, desc, pass, pass.shader.as_ref(), layout, &state)
        };
        use wgpu::CompareFunction::{Always, GreaterEqual, LessEqual};
        // Depth is reversed, so "less" is farther. A back face lights what lies in front of it.
        Ok(PassPipelines::Lights(LightPipelines {
            back: build(Some(wgpu::Face::Front), LessEqual, &[])?,
            front: build(Some(wgpu::Face::Back), GreaterEqual, &[])?,
            screen: build(None, Always, &["FULL_SCREEN"])?,
        }))
    }

    fn fullscreen(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        layout: &PassLayout,
    ) -> Result<PassPipelines, Problem> {
        let state = State {
            fragment_defines: &[],
            vertex_path: FULLSCREEN_VERTEX,
            vertex_defines: &[],
            own_vertex: true,
            cull: None,
            front: wgpu::FrontFace::Ccw,
            depth_compare: pass.depth.as_ref().map(|depth| compare(depth.compare)),
        };
        let built = self.build(files, desc, pass, pass.shader.as_ref(), layout, &state)?;
        Ok(PassPipelines::Fullscreen(built.pipeline))
    }

    fn build(
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
        let colors: Vec<_> = pass
            .colors
            .iter()
            .filter_map(|color| {
                let format = desc.target(&color.target)?.format.0;
                Some(Some(wgpu::ColorTargetState {
                    format,
                    blend: blend(color.blend),
                    write_mask: wgpu::ColorWrites::ALL,
                }))
            })
            .collect();
        let depth_stencil =
            pass.depth
                .as_ref()
                .zip(state.depth_compare)
                .and_then(|(depth, test)| {
                    Some(wgpu::DepthStencilState {
                        format: desc.target(&depth.target)?.format.0,
                        depth_write_enabled: Some(depth.write),
                        depth_compare: Some(test),
                        stencil: wgpu::StencilState::default(),
                        bias: wgpu::DepthBiasState::default(),
                    })
                });
        let key = PipelineKey {
            vertex: vertex.fingerprint,
            fragment: fragment.map(|fragment| fragment.fingerprint),
            state: format!(
                "{colors:?} {depth_stencil:?} {:?} {:?} {}",
                state.front, state.cull, layout.key
            ),
        };
        let attributes = streams == VertexStreams::All;
        if let Some(pipeline) = self.built.get(&key) {
            return Ok(DrawPipeline {
                pipeline,
                attributes,
            });
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
                ..Default::default()
            },
            depth_stencil,
            multisample: wgpu::MultisampleState::default(),
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
        self.built.insert(key, &pipeline);
        Ok(DrawPipeline {
            pipeline,
            attributes,
        })
    }
}
