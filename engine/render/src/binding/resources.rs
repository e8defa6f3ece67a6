//! Group 1: the targets, buffers and samplers that a shader asks for by name.

use wgpu::StorageTextureAccess as Access;

use super::limits::free_binding;
use super::provided::{ENGINE_BUFFERS, SAMPLERS};
use super::{Binder, Source};
use crate::description::{BufferDesc, Read, Update};
use crate::layout::SAMPLER_BINDING;
use crate::problem::{nearest, suggestion};
use crate::reflection::{BindingKind, SampleKind, TextureType, Variable};
use crate::validate::FormatSupport;

impl<S: FormatSupport> Binder<'_, S> {
    /// Where the resource of each binding comes from.
    pub(super) fn sources(&mut self) -> Vec<(u32, Source)> {
        let reflection = self.reflection;
        reflection
            .targets()
            .filter_map(|variable| Some((variable.binding, self.source(variable)?)))
            .collect()
    }

    fn source(&mut self, variable: &Variable) -> Option<Source> {
        match &variable.kind {
            BindingKind::Texture(texture) => self.texture(variable, *texture),
            BindingKind::StorageTexture {
                dimension,
                format,
                access,
            } => self.storage_texture(variable, *dimension, *format, *access),
            BindingKind::Buffer { writable } => self.buffer(variable, *writable),
            BindingKind::Sampler { comparison } => self.sampler(variable, *comparison),
            BindingKind::Uniform | BindingKind::Unsupported(_) => {
                let (what, hint) = match variable.kind {
                    BindingKind::Unsupported(what) => (
                        what,
                        "targets are texture_2d, texture_2d_array, texture_cube and texture_3d",
                    ),
                    _ => (
                        "uniform",
                        "numbers of the pipeline are members of `parameters`, in group 2",
                    ),
                };
                self.report(
                    &variable.at,
                    format!(
                        "`{}` is a {what}; group 1 holds textures, storage textures, storage \
                         buffers and samplers",
                        variable.name
                    ),
                    hint,
                );
                None
            }
        }
    }

    /// The `.reads` for a variable, or a report.
    fn read(&mut self, variable: &Variable) -> Option<&Read> {
        let pass = self.pass;
        let name = variable.name.as_str();
        let found = pass.reads.iter().find(|read| read.variable == name);
        if found.is_none() {
            if pass.updates.iter().any(|u| u.variable == name) {
                let declared = match &variable.kind {
                    BindingKind::Buffer { .. } => format!("`var<storage, read_write> {name}`"),
                    _ => "a storage texture, as in `texture_storage_2d<rgba16float, write>`"
                        .to_owned(),
                };
                self.report(
                    &variable.at,
                    format!(
                        "the shader only reads `{name}`, but the pass `{}` updates it",
                        pass.name
                    ),
                    format!("declare it as {declared}, or write .reads(\"{name}\") in the pass"),
                );
                return None;
            }
            let names = pass.reads.iter().map(|read| read.variable.as_str());
            // Buffers of the engine need no .reads.
            let is_buffer = matches!(variable.kind, BindingKind::Buffer { .. });
            let engine = ENGINE_BUFFERS.iter().filter(|_| is_buffer);
            let hint = suggestion(name, names.chain(engine.map(|(name, _)| *name)))
                .unwrap_or_else(|| format!("add .reads(\"{name}\") to the pass"));
            self.report(
                &variable.at,
                format!("the pass `{}` gives the shader no `{name}`", pass.name),
                hint,
            );
        }
        found
    }

    /// The `.updates` for a variable, or a report.
    fn update(&mut self, variable: &Variable) -> Option<&Update> {
        let pass = self.pass;
        let name = variable.name.as_str();
        let found = pass.updates.iter().find(|u| u.variable == name);
        if found.is_none() {
            let (message, hint) = if pass.reads.iter().any(|read| read.variable == name) {
                (
                    format!(
                        "the shader can write `{name}`, but the pass `{}` only reads it",
                        pass.name
                    ),
                    match variable.kind {
                        BindingKind::Buffer { .. } => format!(
                            "declare it `var<storage, read> {name}`, or write .updates(\"{name}\")"
                        ),
                        _ => format!(
                            "declare it as a texture, or write .updates(\"{name}\") in the pass"
                        ),
                    },
                )
            } else {
                let names = pass.updates.iter().map(|update| update.variable.as_str());
                (
                    format!("the pass `{}` gives the shader no `{name}`", pass.name),
                    suggestion(name, names)
                        .unwrap_or_else(|| format!("add .updates(\"{name}\") to the pass")),
                )
            };
            self.report(&variable.at, message, hint);
        }
        found
    }

    fn texture(&mut self, variable: &Variable, texture: TextureType) -> Option<Source> {
        let desc = self.desc;
        let name = variable.name.as_str();
        let read = self.read(variable)?.clone();
        let Some(target) = desc.target(&read.target) else {
            if desc.buffer(&read.target).is_some() {
                self.report(
                    &variable.at,
                    format!("`{name}` is a texture, but `{}` is a buffer", read.target),
                    format!("declare it as `var<storage, read> {name}: array<u32>`"),
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
                &variable.at,
                format!(
                    "`{name}` is {}, but the target `{}` is {}",
                    texture.in_wgsl(),
                    target.name,
                    target.in_words()
                ),
                format!("declare it as {}", wanted.in_wgsl()),
            );
            return None;
        }
        let filtered = texture.kind == SampleKind::Float && self.is_filtered(variable);
        if filtered && (depth_as_float || !self.support.filterable(target.format)) {
            let (why, hint) = if depth_as_float {
                (
                    "holds depth, which has no means between texels".to_owned(),
                    "use `nearest_sampler` or textureLoad",
                )
            } else {
                (
                    format!("is {}, which this adapter can't filter", target.format),
                    "use `nearest_sampler` or textureLoad, or choose `rgba16float`",
                )
            };
            self.report(
                &variable.at,
                format!(
                    "`{}` {why}, but the shader samples it with a filtering sampler",
                    target.name
                ),
                hint,
            );
            return None;
        }
        Some(Source::Target {
            target: read.target,
            texture,
            mip: read.mip,
            layer: read.layer,
            filtered,
        })
    }

    /// Whether the shader samples a texture with a sampler that takes means between texels.
    fn is_filtered(&self, texture: &Variable) -> bool {
        let pairs = self.reflection.entry_points.iter();
        pairs.flat_map(|entry| &entry.samples).any(|[of, with]| {
            *of == (texture.group, texture.binding)
                && match *with {
                    (0, binding) => binding == SAMPLER_BINDING,
                    (group, binding) => self
                        .reflection
                        .variable(group, binding)
                        .is_some_and(|sampler| sampler.name == "linear_sampler"),
                }
        })
    }

    fn storage_texture(
        &mut self,
        variable: &Variable,
        dimension: wgpu::TextureViewDimension,
        format: Option<crate::Format>,
        access: Access,
    ) -> Option<Source> {
        let desc = self.desc;
        let name = variable.name.as_str();
        let update = self.update(variable)?.clone();
        let Some(target) = desc.target(&update.target) else {
            if desc.buffer(&update.target).is_some() {
                self.report(
                    &variable.at,
                    format!(
                        "`{name}` is a storage texture, but `{}` is a buffer",
                        update.target
                    ),
                    format!("declare it as `var<storage, read_write> {name}: array<u32>`"),
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
        let in_wgsl = |access: &str| {
            let arranged = match wanted {
                wgpu::TextureViewDimension::D3 => "3d",
                wgpu::TextureViewDimension::D2Array => "2d_array",
                _ => "2d",
            };
            format!("texture_storage_{arranged}<{}, {access}>", target.format)
        };
        if dimension != wanted || format != Some(target.format) {
            self.report(
                &variable.at,
                format!(
                    "`{name}` does not fit the target `{}`, which is {}",
                    target.name,
                    target.in_words()
                ),
                format!("declare it as {}", in_wgsl(in_words(access))),
            );
            return None;
        }
        if !self.support.storable_as(target.format, access) {
            let others = [Access::WriteOnly, Access::ReadOnly];
            let possible = others
                .into_iter()
                .find(|access| self.support.storable_as(target.format, *access));
            let hint = match possible {
                Some(access) => format!("declare it as {}", in_wgsl(in_words(access))),
                None => "`rgba16float`, `rgba8unorm`, `r32float` and `r32uint` work everywhere"
                    .to_owned(),
            };
            self.report(
                &variable.at,
                format!(
                    "this adapter has no storage textures of {} with the access `{}`",
                    target.format,
                    in_words(access)
                ),
                hint,
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

    fn buffer(&mut self, variable: &Variable, writable: bool) -> Option<Source> {
        let desc = self.desc;
        let name = variable.name.as_str();
        if let Some((_, buffer)) = ENGINE_BUFFERS.iter().find(|(known, _)| *known == name) {
            if writable {
                self.report(
                    &variable.at,
                    format!("`{name}` belongs to the engine and can only be read"),
                    format!("declare it as `var<storage, read> {name}`"),
                );
                return None;
            }
            if variable.bytes > buffer.least_bytes() {
                self.report(
                    &variable.at,
                    format!("`{name}` has as many elements as the scene needs"),
                    format!("declare it as `{}`, without a length", buffer.in_wgsl()),
                );
                return None;
            }
            return Some(Source::Engine(*buffer));
        }
        let target = if writable {
            self.update(variable)?.target.clone()
        } else {
            self.read(variable)?.target.clone()
        };
        let Some(buffer) = desc.buffer(&target) else {
            if let Some(found) = desc.target(&target) {
                let right = if writable {
                    format!("texture_storage_2d<{}, write>", found.format)
                } else {
                    TextureType::of_target(found, false).in_wgsl()
                };
                self.report(
                    &variable.at,
                    format!("`{name}` is a buffer in the shader, but `{target}` is a target"),
                    format!("declare it as {right}"),
                );
            }
            return None;
        };
        self.room(variable, buffer);
        Some(Source::Buffer {
            buffer: target,
            writable,
        })
    }

    /// The buffer is never smaller than what the shader declares.
    fn room(&mut self, variable: &Variable, buffer: &BufferDesc) {
        let has = buffer.size.least_words() * 4;
        if variable.bytes > has {
            self.report(
                &variable.at,
                format!(
                    "`{}` takes {} bytes, but the buffer `{}` may have {has} only",
                    variable.name, variable.bytes, buffer.name
                ),
                format!(
                    "give the buffer {} words, or the variable fewer elements",
                    variable.bytes.div_ceil(4)
                ),
            );
        }
    }

    fn sampler(&mut self, variable: &Variable, comparison: bool) -> Option<Source> {
        let name = variable.name.as_str();
        let Some((_, source)) = SAMPLERS.iter().find(|(known, _)| *known == name) else {
            let names: Vec<String> = SAMPLERS
                .iter()
                .map(|(name, _)| format!("`{name}`"))
                .collect();
            let hint = format!("the samplers are {}", names.join(", "));
            self.report(&variable.at, format!("there is no sampler `{name}`"), hint);
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
                &variable.at,
                format!("`{name}` is a {wanted}"),
                format!("declare it as `var {name}: {wanted}`"),
            );
            return None;
        }
        Some(source.clone())
    }

    /// Every declared read and update is used by the shader.
    pub(super) fn unused(&mut self) {
        let (pass, reflection, path) = (self.pass, self.reflection, self.shader.path.as_str());
        let names = || reflection.targets().map(|variable| variable.name.as_str());
        // A misspelt variable was told of already, with the name that it means.
        let declared = || {
            pass.reads
                .iter()
                .map(|r| &r.variable)
                .chain(pass.updates.iter().map(|u| &u.variable))
        };
        let meant: Vec<&str> = names()
            .filter(|name| declared().all(|known| known != name))
            .filter_map(|name| nearest(name, declared().map(String::as_str)))
            .collect();
        let reads = pass.reads.iter().map(|r| (&r.variable, &r.at, "reads"));
        let updates = pass.updates.iter().map(|u| (&u.variable, &u.at, "updates"));
        for (variable, at, verb) in reads.chain(updates) {
            if names().any(|name| name == variable) || meant.contains(&variable.as_str()) {
                continue;
            }
            let mut others = reflection.variables.iter();
            if let Some(other) = others.find(|v| v.name == *variable && v.group != 1) {
                self.report(
                    &other.at,
                    format!(
                        "`{variable}` is in group {}, but the pass `{}` {verb} it",
                        other.group, pass.name
                    ),
                    format!("write `@group(1)`; {}", free_binding(reflection, 1)),
                );
                continue;
            }
            let hint = suggestion(variable, names()).unwrap_or_else(|| {
                format!("drop .{verb}, or declare the variable in group 1 of the shader")
            });
            self.report(at, format!("`{path}` never {verb} `{variable}`"), hint);
        }
    }
}

/// As WGSL writes it.
fn in_words(access: Access) -> &'static str {
    match access {
        Access::ReadOnly => "read",
        Access::ReadWrite => "read_write",
        Access::WriteOnly | Access::Atomic => "write",
    }
}
