//! What a frame cost: draws, triangles, time, bytes.
//!
//! Bytes are modelled, not measured: see [`crate::traffic`].

use crate::pipeline::Pipeline;
use crate::scene::ReplacedModels;
use crate::traffic::Traffic;

/// The cost of one pass in one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassStatistics {
    /// Draw calls.
    pub draws: u32,
    /// Objects, light volumes or triangles drawn by those calls.
    pub instances: u32,
    /// Triangles sent to the rasteriser, before clipping and culling.
    pub triangles: u64,
    /// Compute dispatches.
    pub dispatches: u32,
    /// Workgroups of those dispatches; `None` where the GPU decides.
    pub workgroups: Option<u64>,
    /// Lights that no array of a `lights` pass had room for.
    pub unplaced_lights: u32,
    /// Whether the pass was left out, since nobody uses what it writes.
    pub dropped: bool,
    /// Time to record the pass on the CPU, milliseconds.
    pub cpu_ms: f64,
    /// Time on the GPU, milliseconds; `None` where the adapter has no timestamps, or the frame's
    /// queries have not come back yet.
    pub gpu_ms: Option<f64>,
    /// Vertices that vertex stages ran for; `None` where the adapter has no pipeline statistics.
    pub vertices: Option<u64>,
    /// Fragments shaded; `None` where the adapter has no pipeline statistics.
    pub fragments: Option<u64>,
    /// Modelled bytes that move between shaders and targets.
    pub traffic: Traffic,
}

impl PassStatistics {
    /// Modelled bytes of fragments beyond the covered pixels; `None` where the adapter does not count
    /// fragments, or the pass has none.
    pub fn overdraw(&self) -> Option<u64> {
        let fragments = self.fragments.filter(|_| self.traffic.pixels > 0)?;
        Some(self.traffic.overdraw(fragments))
    }
}

/// The cost of one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameStatistics {
    /// One entry a pass, in the order of the description.
    pub passes: Vec<PassStatistics>,
    /// What it took to copy changed rows, to extract the frame, and to upload, record and submit it, as
    /// time of the calling thread.
    pub systems: Vec<lightbench_world::SystemTime>,
    /// From the beginning of the first pass to the end of the last on the GPU, milliseconds.
    pub gpu_ms: Option<f64>,
    /// Systems: world matrices, bounds, culling, sorting, binning; milliseconds on the CPU.
    pub extract_ms: f64,
    /// Upload and recording of all passes; milliseconds on the CPU.
    pub record_ms: f64,
    /// Objects drawn.
    pub objects: u32,
    /// Lights drawn.
    pub lights: u32,
    /// Lights with a clip volume that shine beyond it, since no pass of the pipeline confines them.
    pub unconfined_lights: u32,
    /// Bytes of scene rows that changed and were uploaded.
    pub uploaded_bytes: u64,
    /// Memory of all targets and buffers of the pipeline.
    pub target_bytes: u64,
    /// Materials that are drawn with another reflection model than they ask for, since the pipeline
    /// does not carry theirs.
    pub replaced_models: ReplacedModels,
    /// Memory that targets would take beyond that if none shared its texture with another.
    pub saved_bytes: u64,
}

/// Memory of one target.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetMemory {
    /// The target's name.
    pub name: String,
    /// Its format.
    pub format: crate::Format,
    /// Its size in texels.
    pub size: (u32, u32),
    /// Samples a texel.
    pub samples: u32,
    /// Bytes of all its texels.
    pub bytes: u64,
}

impl Pipeline {
    /// The memory of each target at the size of the last frame; empty before the first.
    pub fn target_memory(&self) -> Vec<TargetMemory> {
        let targets = self.targets().map_or(&[][..], |targets| &targets.targets);
        targets
            .iter()
            .map(|target| TargetMemory {
                name: target.name.clone(),
                format: crate::Format(target.texture.format()),
                size: (target.texture.width(), target.texture.height()),
                samples: target.texture.sample_count(),
                bytes: target.bytes(),
            })
            .collect()
    }
}
