//! What a frame cost: draws, triangles, time, bytes.
//!
//! Bytes are modelled, not measured: see [`traffic`].

use crate::description::{Blend, Load, PassDesc, PassKind};
use crate::pipeline::Pipeline;
use crate::targets::Targets;

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
    /// Modelled bytes read from and written to targets.
    pub traffic: Traffic,
}

/// The cost of one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameStatistics {
    /// One entry a pass, in the order of the description.
    pub passes: Vec<PassStatistics>,
    /// What it took to copy changed rows and to extract the frame, as time of the calling thread.
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
    /// Bytes of scene rows that changed and were uploaded.
    pub uploaded_bytes: u64,
    /// Memory of all targets and buffers of the pipeline.
    pub target_bytes: u64,
    /// Memory that targets would take beyond that if none shared its texture with another.
    pub saved_bytes: u64,
}

/// Bytes that a pass moves between its shader and its targets.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Traffic {
    /// Bytes read: targets that the shader reads, depth that is tested, colours that are blended
    /// with or kept.
    pub read: u64,
    /// Bytes written to colours and depth.
    pub written: u64,
}

/// The byte model.
///
/// It counts what the declared formats and sizes imply, as if there were no caches and no
/// compression:
/// - `fullscreen` and `geometry` passes touch every pixel once; overdraw is left out, since it
///   depends on the order of the objects.
/// - `lights` passes touch the pixels that the lights cover: the sum over the lights of the share
///   of the picture inside the light's bounding rectangle (`coverage`).
/// - Reading a target costs one texel a pixel. Blending and keeping read the old value. A depth
///   test reads depth; depth that is cleared in the same pass is not read.
/// - Clearing writes once. Vertices, textures and buffers are left out.
pub fn traffic(pass: &PassDesc, targets: &Targets, coverage: f64) -> Traffic {
    let bytes = |name: &str| targets.get(name).map_or(0, |target| target.bytes());
    let share = if matches!(pass.kind, PassKind::Lights(_)) {
        coverage
    } else {
        1.0
    };
    let scaled = |bytes: u64| (bytes as f64 * share).round() as u64;
    let mut traffic = Traffic::default();
    for read in &pass.reads {
        // Depth-stencil formats hold more than the depth that shaders read, but travel whole.
        traffic.read += scaled(bytes(&read.target));
    }
    for color in &pass.colors {
        let size = bytes(&color.target);
        traffic.written += scaled(size);
        if color.blend != Blend::Replace {
            traffic.read += scaled(size);
        }
        if matches!(color.load, Load::Clear(_)) && share != 1.0 {
            traffic.written += size;
        }
    }
    if let Some(depth) = &pass.depth {
        let size = bytes(&depth.target);
        if matches!(depth.load, Load::Keep)
            && !pass.reads.iter().any(|read| read.target == depth.target)
        {
            traffic.read += scaled(size);
        }
        if depth.write {
            traffic.written += scaled(size);
        }
    }
    traffic
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
                bytes: target.bytes(),
            })
            .collect()
    }
}
