//! Joins what a pass declares with what its shader asks for.

use crate::description::{ParameterKind, PassDesc, PipelineDesc};
use crate::gpu::Gpu;
use crate::problem::{Place, Problem, suggestion};
use crate::reflection::{BindingKind, FRAGMENT_ENTRY, Reflection, SampleKind};
use crate::shader::{Shader, place_of};

/// The samplers that a shader gets by declaring a `sampler` of that name in group 1.
const SAMPLERS: [&str; 2] = ["linear_sampler", "nearest_sampler"];

/// Where the resource of one binding of group 1 comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// The target of that name.
    Target {
        /// The target.
        target: String,
        /// What it holds.
        kind: SampleKind,
    },
    /// The sampler that filters between texels.
    LinearSampler,
    /// The sampler that takes the nearest texel.
    NearestSampler,
}

/// The layout of group 1, or none where the shader reads no target.
pub fn target_layout(
    gpu: &Gpu,
    sources: &[(u32, Source)],
    desc: &PipelineDesc,
) -> Option<wgpu::BindGroupLayout> {
    let features = gpu.device.features();
    let filters = sources
        .iter()
        .any(|(_, source)| *source == Source::LinearSampler);
    let entries: Vec<_> = sources
        .iter()
        .map(|(binding, source)| wgpu::BindGroupLayoutEntry {
            binding: *binding,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: match source {
                Source::Target { target, kind } => wgpu::BindingType::Texture {
                    sample_type: match kind {
                        SampleKind::Depth => wgpu::TextureSampleType::Depth,
                        SampleKind::Uint => wgpu::TextureSampleType::Uint,
                        SampleKind::Sint => wgpu::TextureSampleType::Sint,
                        SampleKind::Float => {
                            let format = desc.target(target).map(|target| target.format.0);
                            let native =
                                format.and_then(|format| format.sample_type(None, Some(features)));
                            let filterable =
                                native == Some(wgpu::TextureSampleType::Float { filterable: true });
                            wgpu::TextureSampleType::Float {
                                filterable: filters && filterable,
                            }
                        }
                    },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
                Source::LinearSampler => {
                    wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)
                }
                Source::NearestSampler => {
                    wgpu::BindingType::Sampler(wgpu::SamplerBindingType::NonFiltering)
                }
            },
            count: None,
        })
        .collect();
    (!entries.is_empty()).then(|| {
        gpu.device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("targets"),
                entries: &entries,
            })
    })
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
    let mut problems = Vec::new();
    let mut sources = Vec::new();
    for binding in &reflection.bindings {
        let at = declaration(shader, &binding.name);
        match &binding.kind {
            BindingKind::Texture(kind) => {
                match pass.reads.iter().find(|read| read.variable == binding.name) {
                    Some(read) => {
                        let Some(target) = desc.target(&read.target) else {
                            continue;
                        };
                        let holds = SampleKind::of_format(target.format.0);
                        if holds == *kind {
                            sources.push((
                                binding.binding,
                                Source::Target {
                                    target: read.target.clone(),
                                    kind: holds,
                                },
                            ));
                        } else {
                            problems.push(
                                Problem::new(
                                    at,
                                    format!(
                                        "`{}` is {}, but the target `{}` is {}",
                                        binding.name,
                                        kind.texture_type(),
                                        target.name,
                                        target.format
                                    ),
                                )
                                .with_source(&shader.text)
                                .with_hint(format!("declare it as {}", holds.texture_type())),
                            );
                        }
                    }
                    None => {
                        let names = pass.reads.iter().map(|read| read.variable.as_str());
                        let hint = suggestion(&binding.name, names).unwrap_or_else(|| {
                            format!("add .reads(\"{}\") to the pass", binding.name)
                        });
                        problems.push(
                            Problem::new(
                                at,
                                format!(
                                    "the pass `{}` gives the shader no `{}`",
                                    pass.name, binding.name
                                ),
                            )
                            .with_source(&shader.text)
                            .with_hint(hint),
                        );
                    }
                }
            }
            BindingKind::Sampler => match binding.name.as_str() {
                "linear_sampler" => sources.push((binding.binding, Source::LinearSampler)),
                "nearest_sampler" => sources.push((binding.binding, Source::NearestSampler)),
                name => problems.push(
                    Problem::new(at, format!("there is no sampler `{name}`"))
                        .with_source(&shader.text)
                        .with_hint(suggestion(name, SAMPLERS).unwrap_or_else(|| {
                            format!("the samplers are: {}", SAMPLERS.join(", "))
                        })),
                ),
            },
            BindingKind::Unsupported(what) => problems.push(
                Problem::new(
                    at,
                    format!(
                        "`{}` is a {what}; group 1 holds 2D textures and samplers",
                        binding.name
                    ),
                )
                .with_source(&shader.text),
            ),
        }
    }
    for read in &pass.reads {
        if !reflection
            .bindings
            .iter()
            .any(|binding| binding.name == read.variable)
        {
            let names = reflection
                .bindings
                .iter()
                .map(|binding| binding.name.as_str());
            let hint = suggestion(&read.variable, names).unwrap_or_else(|| {
                "drop .reads, or declare the variable in group 1 of the shader".to_owned()
            });
            problems.push(
                Problem::new(
                    read.at.clone(),
                    format!("`{}` never reads `{}`", shader.path, read.variable),
                )
                .with_hint(hint),
            );
        }
    }
    outputs(desc, pass, shader, reflection, &mut problems);
    parameters(desc, shader, reflection, &mut problems);
    if problems.is_empty() {
        Ok(sources)
    } else {
        Err(problems)
    }
}

/// The fragment stage writes each colour target, with the kind of numbers that it holds.
fn outputs(
    desc: &PipelineDesc,
    pass: &PassDesc,
    shader: &Shader,
    reflection: &Reflection,
    problems: &mut Vec<Problem>,
) {
    let at = declaration(shader, FRAGMENT_ENTRY);
    if !reflection.has_fragment {
        problems.push(
            Problem::new(
                Place::file(shader.path.as_str()),
                format!("the shader has no `{FRAGMENT_ENTRY}`"),
            )
            .with_hint(format!("write `@fragment fn {FRAGMENT_ENTRY}(…)`")),
        );
        return;
    }
    for (index, color) in pass.colors.iter().enumerate() {
        let Some(target) = desc.target(&color.target) else {
            continue;
        };
        let wanted = SampleKind::of_format(target.format.0);
        match reflection
            .outputs
            .iter()
            .find(|(location, _)| *location as usize == index)
        {
            None => problems.push(
                Problem::new(
                    at.clone(),
                    format!(
                        "the shader has no output @location({index}) for `{}`",
                        target.name
                    ),
                )
                .with_source(&shader.text)
                .with_hint("outputs are numbered in the order of the pass's .writes"),
            ),
            Some((_, kind)) if *kind != wanted => problems.push(
                Problem::new(
                    at.clone(),
                    format!(
                        "@location({index}) is {kind:?}, but the target `{}` is {}",
                        target.name, target.format
                    ),
                )
                .with_source(&shader.text),
            ),
            Some(_) => {}
        }
    }
    for (location, _) in &reflection.outputs {
        if *location as usize >= pass.colors.len() {
            problems.push(
                Problem::new(
                    pass.at.clone(),
                    format!(
                        "`{}` writes @location({location}), but the pass has {} colour targets",
                        shader.path,
                        pass.colors.len()
                    ),
                )
                .with_hint("add a .writes to the pass, or remove the output"),
            );
        }
    }
}

/// Each member of the shader's `parameters` is a parameter of the pipeline, of the right type.
fn parameters(
    desc: &PipelineDesc,
    shader: &Shader,
    reflection: &Reflection,
    problems: &mut Vec<Problem>,
) {
    for member in reflection
        .parameters
        .iter()
        .flat_map(|(members, _)| members)
    {
        let at = declaration(shader, &member.name);
        let Some(parameter) = desc.parameter(&member.name) else {
            let names = desc
                .parameters
                .iter()
                .map(|parameter| parameter.name.as_str());
            let hint = suggestion(&member.name, names).unwrap_or_else(|| {
                format!("declare it: p.number(\"{}\", 1.0, 0.0, 10.0)", member.name)
            });
            problems.push(
                Problem::new(
                    at,
                    format!("the pipeline has no parameter `{}`", member.name),
                )
                .with_source(&shader.text)
                .with_hint(hint),
            );
            continue;
        };
        let (wanted, name) = match parameter.kind {
            ParameterKind::Number { .. } => (SampleKind::Float, "f32"),
            ParameterKind::Switch | ParameterKind::Choice { .. } => (SampleKind::Uint, "u32"),
        };
        if member.kind != Some(wanted) {
            problems.push(
                Problem::new(
                    at,
                    format!("the parameter `{}` reaches shaders as {name}", member.name),
                )
                .with_source(&shader.text)
                .with_hint(format!("declare it as `{}: {name}`", member.name)),
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
