//! Joins what a pass declares with what its shader asks for.

mod layout;
mod provided;
mod stages;

pub use layout::target_layout;
pub use provided::{EngineBuffer, Provided, provided};

use provided::{ENGINE_BUFFERS, SAMPLERS};

use crate::description::{PassDesc, PipelineDesc, Read, Slice, Update};
use crate::problem::{Place, Problem, suggestion};
use crate::reflection::{BindingKind, Reflection, SampleKind, TargetBinding, TextureType};
use crate::shader::{Shader, place_of};

/// Where the resource of one binding of group 1 comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// A target that is read.
    Target {
        /// The target.
        target: String,
        /// Its type in the shader.
        texture: TextureType,
        /// One mip level alone.
        mip: Option<u32>,
        /// One layer alone.
        layer: Option<u32>,
    },
    /// A target that is written without the rasteriser.
    StorageTexture {
        /// The target.
        target: String,
        /// How its texels are arranged.
        dimension: wgpu::TextureViewDimension,
        /// Write, or read and write.
        access: wgpu::StorageTextureAccess,
        /// Mip level and layer.
        slice: Slice,
    },
    /// A buffer of the pipeline.
    Buffer {
        /// The buffer.
        buffer: String,
        /// Whether the shader may write it.
        writable: bool,
    },
    /// A buffer of the engine.
    Engine(EngineBuffer),
    /// The sampler that filters between texels.
    LinearSampler,
    /// The sampler that takes the nearest texel.
    NearestSampler,
    /// The sampler that compares depth: 1 where the reference is as near as what is there.
    DepthSampler,
}

/// Checks the shader of a pass against its declaration and finds the source of each binding.
///
/// # Errors
/// Every mismatch, each at its place in the shader or the pipeline.
pub fn bind(
    desc: &PipelineDesc,
    pass: &PassDesc,
    shader: &Shader,
    reflection: &Reflection,
) -> Result<Vec<(u32, Source)>, Vec<Problem>> {
    let mut binder = Binder {
        desc,
        pass,
        shader,
        problems: Vec::new(),
    };
    let mut sources = Vec::new();
    for binding in &reflection.bindings {
        if let Some(source) = binder.source(binding) {
            sources.push((binding.binding, source));
        }
    }
    binder.unused(reflection);
    binder.stages(reflection);
    binder.parameters(reflection);
    if binder.problems.is_empty() {
        Ok(sources)
    } else {
        Err(binder.problems)
    }
}

struct Binder<'a> {
    desc: &'a PipelineDesc,
    pass: &'a PassDesc,
    shader: &'a Shader,
    problems: Vec<Problem>,
}

impl Binder<'_> {
    /// Reports a mistake at the declaration of a name in the shader.
    fn report(&mut self, name: &str, message: String, hint: impl Into<String>) {
        let problem = Problem::new(declaration(self.shader, name), message)
            .with_source(&self.shader.text)
            .with_hint(hint);
        self.problems.push(problem);
    }

    /// Where the resource of a binding comes from.
    fn source(&mut self, binding: &TargetBinding) -> Option<Source> {
        match &binding.kind {
            BindingKind::Texture(texture) => self.texture(&binding.name, *texture),
            BindingKind::StorageTexture {
                dimension,
                format,
                access,
            } => self.storage_texture(&binding.name, *dimension, *format, *access),
            BindingKind::Buffer { writable } => self.buffer(&binding.name, *writable),
            BindingKind::Sampler { comparison } => self.sampler(&binding.name, *comparison),
            BindingKind::Unsupported(what) => {
                self.report(
                    &binding.name,
                    format!(
                        "`{}` is a {what}; group 1 holds textures, storage textures, storage \
                         buffers and samplers",
                        binding.name
                    ),
                    "numbers of the pipeline are members of `parameters`, in group 2",
                );
                None
            }
        }
    }

    /// The `.reads` for a variable, or a report. `others` are names that need none.
    fn read(&mut self, variable: &str, others: &[&str]) -> Option<&Read> {
        let pass = self.pass;
        let found = pass.reads.iter().find(|read| read.variable == variable);
        if found.is_none() {
            if pass.updates.iter().any(|u| u.variable == variable) {
                self.report(
                    variable,
                    format!("the shader only reads `{variable}`, but the pass updates it"),
                    "declare it `var<storage, read_write>` or as a storage texture, or use .reads",
                );
                return None;
            }
            let names = pass.reads.iter().map(|read| read.variable.as_str());
            let hint = suggestion(variable, names.chain(others.iter().copied()))
                .unwrap_or_else(|| format!("add .reads(\"{variable}\") to the pass"));
            self.report(
                variable,
                format!("the pass `{}` gives the shader no `{variable}`", pass.name),
                hint,
            );
        }
        found
    }

    /// The `.updates` for a variable, or a report.
    fn update(&mut self, variable: &str) -> Option<&Update> {
        let pass = self.pass;
        let found = pass.updates.iter().find(|u| u.variable == variable);
        if found.is_none() {
            let message = if pass.reads.iter().any(|read| read.variable == variable) {
                format!("the shader writes `{variable}`, but the pass only reads it")
            } else {
                format!("the pass `{}` gives the shader no `{variable}`", pass.name)
            };
            let names = pass.updates.iter().map(|update| update.variable.as_str());
            let hint = suggestion(variable, names)
                .unwrap_or_else(|| format!("add .updates(\"{variable}\") to the pass"));
            self.report(variable, message, hint);
        }
        found
    }

    fn texture(&mut self, variable: &str, texture: TextureType) -> Option<Source> {
        let desc = self.desc;
        let read = self.read(variable, &[])?.clone();
        let Some(target) = desc.target(&read.target) else {
            if desc.buffer(&read.target).is_some() {
                self.report(
                    variable,
                    format!(
                        "`{variable}` is a texture, but `{}` is a buffer",
                        read.target
                    ),
                    format!("declare it as `var<storage, read> {variable}: array<u32>`"),
                );
            }
            return None;
        };
        let wanted = TextureType::of_target(target, read.layer.is_some());
        // A shader may load depth as floats.
        let depth_as_float = wanted.kind == SampleKind::Depth
            && texture
                == TextureType {
                    kind: SampleKind::Float,
                    ..wanted
                };
        // A cube may be read side by side.
        let sides = wanted.dimension == wgpu::TextureViewDimension::Cube
            && texture
                == TextureType {
                    dimension: wgpu::TextureViewDimension::D2Array,
                    ..wanted
                };
        if texture != wanted && !depth_as_float && !sides {
            self.report(
                variable,
                format!(
                    "`{variable}` is {}, but the target `{}` is {}",
                    texture.in_wgsl(),
                    target.name,
                    target.in_words()
                ),
                format!("declare it as {}", wanted.in_wgsl()),
            );
            return None;
        }
        Some(Source::Target {
            target: read.target,
            texture,
            mip: read.mip,
            layer: read.layer,
        })
    }

    fn storage_texture(
        &mut self,
        variable: &str,
        dimension: wgpu::TextureViewDimension,
        format: Option<crate::Format>,
        access: wgpu::StorageTextureAccess,
    ) -> Option<Source> {
        let desc = self.desc;
        let update = self.update(variable)?.clone();
        let Some(target) = desc.target(&update.target) else {
            if desc.buffer(&update.target).is_some() {
                self.report(
                    variable,
                    format!(
                        "`{variable}` is a storage texture, but `{}` is a buffer",
                        update.target
                    ),
                    format!("declare it as `var<storage, read_write> {variable}: array<u32>`"),
                );
            }
            return None;
        };
        let texture = TextureType::of_target(target, update.one_layer);
        let wanted = match texture.dimension {
            // Storage textures have no cubes.
            wgpu::TextureViewDimension::Cube => wgpu::TextureViewDimension::D2Array,
            dimension => dimension,
        };
        if dimension != wanted || format != Some(target.format) {
            let arranged = match wanted {
                wgpu::TextureViewDimension::D3 => "3d",
                wgpu::TextureViewDimension::D2Array => "2d_array",
                _ => "2d",
            };
            let right = format!("texture_storage_{arranged}<{}, write>", target.format);
            self.report(
                variable,
                format!(
                    "`{variable}` does not fit the target `{}`, which is {}",
                    target.name,
                    target.in_words()
                ),
                format!("declare it as {right}"),
            );
            return None;
        }
        Some(Source::StorageTexture {
            target: update.target,
            dimension,
            access,
            slice: update.slice,
        })
    }

    fn buffer(&mut self, variable: &str, writable: bool) -> Option<Source> {
        let desc = self.desc;
        if let Some((_, buffer)) = ENGINE_BUFFERS.iter().find(|(name, _)| *name == variable) {
            if writable {
                self.report(
                    variable,
                    format!("`{variable}` belongs to the engine and can only be read"),
                    format!("declare it as `var<storage, read> {variable}`"),
                );
                return None;
            }
            return Some(Source::Engine(*buffer));
        }
        let name = if writable {
            self.update(variable)?.target.clone()
        } else {
            let engine = ENGINE_BUFFERS.map(|(name, _)| name);
            self.read(variable, &engine)?.target.clone()
        };
        if desc.buffer(&name).is_none() {
            if let Some(target) = desc.target(&name) {
                let right = TextureType::of_target(target, false).in_wgsl();
                self.report(
                    variable,
                    format!("`{variable}` is a buffer in the shader, but `{name}` is a target"),
                    format!("declare it as {right}"),
                );
            }
            return None;
        }
        Some(Source::Buffer {
            buffer: name,
            writable,
        })
    }

    fn sampler(&mut self, name: &str, comparison: bool) -> Option<Source> {
        let names = || SAMPLERS.iter().map(|(name, _)| *name);
        let Some((_, source)) = SAMPLERS.iter().find(|(known, _)| *known == name) else {
            let hint = suggestion(name, names()).unwrap_or_else(|| {
                format!(
                    "the samplers are: {}",
                    names().collect::<Vec<_>>().join(", ")
                )
            });
            self.report(name, format!("there is no sampler `{name}`"), hint);
            return None;
        };
        let right = *source == Source::DepthSampler;
        if right != comparison {
            let wanted = if right {
                "sampler_comparison"
            } else {
                "sampler"
            };
            self.report(
                name,
                format!("`{name}` is a {wanted}"),
                format!("declare it as `var {name}: {wanted}`"),
            );
            return None;
        }
        Some(source.clone())
    }

    /// Every declared read and update is used by the shader.
    fn unused(&mut self, reflection: &Reflection) {
        let pass = self.pass;
        let names = || {
            reflection
                .bindings
                .iter()
                .map(|binding| binding.name.as_str())
        };
        let reads = pass.reads.iter().map(|r| (&r.variable, &r.at, "reads"));
        let updates = pass.updates.iter().map(|u| (&u.variable, &u.at, "updates"));
        for (variable, at, verb) in reads.chain(updates) {
            if names().any(|name| name == variable) {
                continue;
            }
            let hint = suggestion(variable, names()).unwrap_or_else(|| {
                format!("drop .{verb}, or declare the variable in group 1 of the shader")
            });
            self.problems.push(
                Problem::new(
                    at.clone(),
                    format!("`{}` never {verb} `{variable}`", self.shader.path),
                )
                .with_hint(hint),
            );
        }
    }
}

/// Where a name is declared in a shader: the line that first has it as a whole word outside a
/// comment.
fn declaration(shader: &Shader, name: &str) -> Place {
    let word = |c: char| c.is_alphanumeric() || c == '_';
    let mut line_start = 0;
    for line in shader.text.split_inclusive('\n') {
        let code = line.split("//").next().unwrap_or(line);
        for (at, _) in code.match_indices(name) {
            let before = code[..at].chars().next_back();
            let after = code[at + name.len()..].chars().next();
            if !before.is_some_and(word) && !after.is_some_and(word) {
                return place_of(&shader.path, &shader.text, line_start + at);
            }
        }
        line_start += line.len();
    }
    Place::file(shader.path.as_str())
}
