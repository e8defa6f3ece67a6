//! Joins what a pass declares with what its shader asks for.
//!
//! Everything that a device would refuse when a pipeline is built from them is found here, at its
//! place in the shader or the pipeline, by looking at the shader alone: [`check_shader`] before it
//! goes to the device, [`bind`] when it is known which pass runs it, [`link`] when it is known which
//! vertex stage comes before it.

mod layout;
mod limits;
mod link;
mod provided;
mod resources;
mod scene;
mod stages;

pub use layout::target_layout;
pub use limits::check_shader;
pub use link::{Reflected, check_vertices, link, links_mips, shades};
pub use provided::{EngineBuffer, Provided, provided};

use crate::description::{PassDesc, PipelineDesc, Slice};
use crate::problem::{Place, Problem, suggestion};
use crate::reflection::{Reflection, TextureType};
use crate::shader::Shader;
use crate::validate::FormatSupport;

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
        /// Whether the shader takes means between its texels.
        filtered: bool,
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
    support: &impl FormatSupport,
) -> Result<Vec<(u32, Source)>, Vec<Problem>> {
    let mut binder = Binder {
        desc,
        pass,
        shader,
        reflection,
        support,
        problems: Vec::new(),
    };
    if binder.is_alien() {
        // All else that does not fit would follow from that.
        binder.stages();
        return Err(binder.problems);
    }
    let sources = binder.sources();
    binder.unused();
    binder.defines();
    binder.stages();
    binder.scene();
    binder.parameters();
    if binder.problems.is_empty() {
        binder.counts(&sources);
        binder.dispatch();
    }
    if binder.problems.is_empty() {
        Ok(sources)
    } else {
        Err(binder.problems)
    }
}

struct Binder<'a, S> {
    desc: &'a PipelineDesc,
    pass: &'a PassDesc,
    shader: &'a Shader,
    reflection: &'a Reflection,
    support: &'a S,
    problems: Vec<Problem>,
}

impl<S: FormatSupport> Binder<'_, S> {
    fn report(&mut self, at: &Place, message: String, hint: impl Into<String>) {
        self.problems
            .push(Problem::new(at.clone(), message).with_hint(hint));
    }

    /// Every define of the pass is asked for by the shader or a module that it imports.
    fn defines(&mut self) {
        let Some(shader) = &self.pass.shader else {
            return;
        };
        let listings = self.shader.listings.all();
        let mentions: Vec<&str> = listings
            .flat_map(|listing| &listing.mentions)
            .map(String::as_str)
            .collect();
        for (index, define) in shader.defines.iter().enumerate() {
            let name = define.name.as_str();
            if mentions.contains(&name) {
                continue;
            }
            let hint = suggestion(name, mentions.iter().copied())
                .unwrap_or_else(|| "remove it, or write `#ifdef` in the shader".to_owned());
            let message = format!(
                "`{}` and what it imports never ask for the define `{name}`",
                shader.path
            );
            // What the program itself defines, for a heat map, is written nowhere.
            let Some(at) = shader.define_places.get(index) else {
                continue;
            };
            self.problems
                .push(Problem::new(at.clone(), message).with_hint(hint));
        }
    }
}
