//! GPU pipelines that were built before.
//!
//! A driver compiles a pipeline when it is first drawn with, which takes far longer than all the
//! rest of a reload. So a pass whose shaders and state did not change keeps its pipeline object.

use std::collections::HashMap;

use crate::gpu_pipelines::{ComputePipeline, DrawPipeline};

/// What a pipeline is made of; equal keys make equal pipelines.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct PipelineKey {
    /// Fingerprint of the shader with the vertex stage, or of the compute shader.
    pub vertex: u64,
    /// Fingerprint of the shader with the fragment stage.
    pub fragment: Option<u64>,
    /// Attachments, fixed-function state and layout, in words.
    pub state: String,
}

/// How many compilations a pipeline survives without being used. Bounds the memory of a long
/// session of edits, and is enough to go back to what was there a moment ago.
const SURVIVES: u64 = 16;

/// Pipelines of one kind by what they are made of, each with the compilation that last used it.
type Kept<P> = HashMap<PipelineKey, (P, u64)>;

/// Pipelines by what they are made of.
#[derive(Default)]
pub(super) struct PipelineCache {
    render: Kept<DrawPipeline>,
    compute: Kept<ComputePipeline>,
    compilation: u64,
}

impl PipelineCache {
    /// Begins a compilation, and forgets what many of them did not use.
    pub fn begin(&mut self) {
        self.compilation += 1;
        let oldest = self.compilation.saturating_sub(SURVIVES);
        self.render.retain(|_, (_, used)| *used >= oldest);
        self.compute.retain(|_, (_, used)| *used >= oldest);
    }

    /// The render pipeline of that key.
    pub fn get(&mut self, key: &PipelineKey) -> Option<DrawPipeline> {
        take(&mut self.render, key, self.compilation)
    }

    /// Keeps a render pipeline.
    pub fn insert(&mut self, key: PipelineKey, pipeline: &DrawPipeline) {
        self.render
            .insert(key, (pipeline.clone(), self.compilation));
    }

    /// The compute pipeline of that key.
    pub fn get_compute(&mut self, key: &PipelineKey) -> Option<ComputePipeline> {
        take(&mut self.compute, key, self.compilation)
    }

    /// Keeps a compute pipeline.
    pub fn insert_compute(&mut self, key: PipelineKey, pipeline: &ComputePipeline) {
        self.compute
            .insert(key, (pipeline.clone(), self.compilation));
    }
}

fn take<P: Clone>(kept: &mut Kept<P>, key: &PipelineKey, compilation: u64) -> Option<P> {
    let (pipeline, used) = kept.get_mut(key)?;
    *used = compilation;
    Some(pipeline.clone())
}
