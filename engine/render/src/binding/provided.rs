//! What a shader gets in group 1 by declaring it, without a word of the pipeline.

use super::Source;

/// The samplers, each under the name of its variable.
pub(super) const SAMPLERS: [(&str, Source); 3] = [
    ("linear_sampler", Source::LinearSampler),
    ("nearest_sampler", Source::NearestSampler),
    ("depth_sampler", Source::DepthSampler),
];

/// The buffers of the engine, each under the name of its variable. They are not in group 0 since few
/// passes need them and adapters bind few buffers.
pub(super) const ENGINE_BUFFERS: [(&str, EngineBuffer); 6] = [
    ("mesh_positions", EngineBuffer::MeshPositions),
    ("mesh_attributes", EngineBuffer::MeshAttributes),
    ("mesh_groups", EngineBuffer::MeshGroups),
    ("mesh_indices", EngineBuffer::MeshIndices),
    ("shadow_views", EngineBuffer::ShadowViews),
    ("light_shadows", EngineBuffer::LightShadows),
];

/// A buffer that the engine fills.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EngineBuffer {
    /// Three floats a vertex, all meshes one after the other.
    MeshPositions,
    /// Normal, texture coordinates and tangent of each vertex: nine floats.
    MeshAttributes,
    /// The smooth group of each vertex, in a byte: four vertices a word, the first in the lowest
    /// bits. A mesh of more than 256 groups gives some of them the same number.
    MeshGroups,
    /// Indices of all meshes.
    MeshIndices,
    /// The views of all `shadow` passes: see `shaders/lib/shadow.wgsl`.
    ShadowViews,
    /// Of each light the first of its shadow views.
    LightShadows,
}

impl EngineBuffer {
    /// For messages.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::MeshPositions => "vertex positions",
            Self::MeshAttributes => "normals, texture coordinates and tangents",
            Self::MeshGroups => "smooth groups",
            Self::MeshIndices => "indices",
            Self::ShadowViews => "shadow views",
            Self::LightShadows => "numbers of shadow views",
        }
    }

    /// The type of its elements in WGSL, and what it holds.
    fn described(self) -> (&'static str, &'static str) {
        match self {
            Self::MeshPositions => (
                "f32",
                "the vertices of all meshes: x, y and z of each, in the space of its mesh",
            ),
            Self::MeshAttributes => (
                "f32",
                "nine numbers a vertex: normal, texture coordinates, tangent",
            ),
            Self::MeshGroups => (
                "u32",
                "the smooth group of each vertex, in a byte: four vertices a word",
            ),
            Self::MeshIndices => (
                "u32",
                "three a triangle, counted from its mesh's first vertex",
            ),
            Self::ShadowViews => (
                "shadow::ShadowView",
                "the views of all `shadow` passes of the frame",
            ),
            Self::LightShadows => (
                "u32",
                "of each light the first of its shadow views, or `shadow::NO_VIEW`",
            ),
        }
    }
}

/// One thing that a shader gets by declaring it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Provided {
    /// The name of the variable.
    pub name: &'static str,
    /// The declaration in WGSL, from `var` on, without its end.
    pub declaration: String,
    /// What it does or holds, in words.
    pub about: &'static str,
}

/// All samplers, then all buffers of the engine.
pub fn provided() -> impl Iterator<Item = Provided> {
    let samplers = SAMPLERS.into_iter().map(|(name, source)| {
        let (kind, about) = match source {
            Source::DepthSampler => (
                "sampler_comparison",
                "compares depth: 1 where the reference is as near as what is there",
            ),
            Source::NearestSampler => ("sampler", "takes the nearest texel"),
            _ => ("sampler", "filters between texels and mip levels"),
        };
        Provided {
            name,
            declaration: format!("var {name}: {kind}"),
            about,
        }
    });
    let buffers = ENGINE_BUFFERS.into_iter().map(|(name, buffer)| {
        let (element, about) = buffer.described();
        Provided {
            name,
            declaration: format!("var<storage, read> {name}: array<{element}>"),
            about,
        }
    });
    samplers.chain(buffers)
}
