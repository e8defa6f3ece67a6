//! GPU pipelines that were built before.
//!
//! A driver compiles a pipeline when it is first drawn with, which takes far longer than all the
//! rest of a reload. So a pass whose shaders and state did not change keeps its pipeline object.

use std::collections::HashMap;

/// What a pipeline is made of; equal keys make equal pipelines.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct PipelineKey {
    /// Fingerprint of the shader with the vertex stage.
    pub vertex: u64,
    /// Fingerprint of the shader with the fragment stage.
    pub fragment: Option<u64>,
    /// Attachments, fixed-function state and layout, in words.
    pub state: String,
}

/// How many compilations a pipeline survives without being used. Bounds the memory of a long
/// session of edits, and is enough to go back to what was there a moment ago.
const SURVIVES: u64 = 16;

/// Pipelines by what they are made of.
#[derive(Default)]
pub(super) struct PipelineCache {
    pipelines: HashMap<PipelineKey, (wgpu::RenderPipeline, u64)>,
    compilation: u64,
}

impl PipelineCache {
    /// Begins a compilation, and forgets what many of them did not use.
    pub fn begin(&mut self) {
        self.compilation += 1;
        let oldest = self.compilation.saturating_sub(SURVIVES);
        self.pipelines.retain(|_, (_, used)| *used >= oldest);
    }

    /// The pipeline of that key.
    pub fn get(&mut self, key: &PipelineKey) -> Option<wgpu::RenderPipeline> {
        let (pipeline, used) = self.pipelines.get_mut(key)?;
        *used = self.compilation;
        Some(pipeline.clone())
    }

    /// Keeps a pipeline.
    pub fn insert(&mut self, key: PipelineKey, pipeline: &wgpu::RenderPipeline) {
        self.pipelines
            .insert(key, (pipeline.clone(), self.compilation));
    }
}
