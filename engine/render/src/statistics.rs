//! What a frame cost: draws, triangles, time, bytes.
//!
//! Bytes are modelled, not measured: see [`traffic`].

use crate::description::{Blend, Load, PassDesc, PassKind, Read, Slice};
use crate::pipeline::Pipeline;
use crate::scene::ReplacedModels;
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
    /// Materials that are drawn with another reflection model than they ask for, since the pipeline
    /// does not carry theirs.
    pub replaced_models: ReplacedModels,
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
/// - Reading a target costs one texel a pixel; reading a buffer costs all of it once. Blending and
///   keeping read the old value. A depth test reads depth; depth that is cleared in the same pass is
///   not read. All samples of a texel count.
/// - Clearing writes once. Samples that are dropped at the end of their pass are not written, and
///   what they resolve to is.
/// - `compute` passes read what they read and write what they update, each once.
/// - `copy`, `history` and `resolve` read one target and write the other; `mips` read all levels but
///   the last and write all but the first; `clear` writes all.
/// - Vertices, textures and the engine's buffers are left out.
pub fn traffic(pass: &PassDesc, targets: &Targets, coverage: f64) -> Traffic {
    let share = match pass.kind {
        PassKind::Lights(_) => coverage,
        _ => 1.0,
    };
    let scaled = |bytes: u64| (bytes as f64 * share).round() as u64;
    let mut traffic = Traffic::default();
    match &pass.kind {
        PassKind::Copy { from, to } | PassKind::History { from, to } => {
            let bytes = read_bytes(from, targets).min(read_bytes(to, targets));
            return Traffic {
                read: bytes,
                written: bytes,
            };
        }
        PassKind::Resolve { from, to } => {
            return Traffic {
                read: read_bytes(from, targets),
                written: read_bytes(to, targets),
            };
        }
        PassKind::Mips { target, .. } => {
            let Some(target) = targets.get(&target.target) else {
                return traffic;
            };
            let last = target.texture.mip_level_count().saturating_sub(1);
            return Traffic {
                read: target.bytes() - target.mip_bytes(last),
                written: target.bytes() - target.mip_bytes(0),
            };
        }
        PassKind::Clear => {
            let names = pass.colors.iter().map(|color| &color.target);
            let names = names.chain(pass.depth.iter().map(|depth| &depth.target));
            let names = names.chain(pass.updates.iter().map(|update| &update.target));
            traffic.written = names.map(|name| whole_bytes(name, targets)).sum();
            return traffic;
        }
        _ => {}
    }
    for read in &pass.reads {
        // Depth-stencil formats hold more than the depth that shaders read, but travel whole.
        traffic.read += scaled(read_bytes(read, targets));
    }
    for update in &pass.updates {
        let bytes = match targets.get(&update.target) {
            Some(target) if update.one_layer => target.slice_bytes(update.slice),
            Some(target) => target.mip_bytes(update.slice.mip),
            None => whole_bytes(&update.target, targets),
        };
        traffic.written += scaled(bytes);
    }
    for color in &pass.colors {
        let Some(target) = targets.get(&color.target) else {
            continue;
        };
        let size = target.slice_bytes(color.slice);
        if color.store {
            traffic.written += scaled(size);
        }
        if color.blend != Blend::Replace {
            traffic.read += scaled(size);
        }
        if matches!(color.load, Load::Clear(_)) && share != 1.0 {
            traffic.written += size;
        }
        if let Some(resolve) = &color.resolve {
            traffic.written += whole_bytes(&resolve.name, targets);
        }
    }
    if let Some(depth) = &pass.depth
        && let Some(target) = targets.get(&depth.target)
    {
        let size = target.slice_bytes(depth.slice);
        if matches!(depth.load, Load::Keep)
            && !pass.reads.iter().any(|read| read.target == depth.target)
        {
            traffic.read += scaled(size);
        }
        if depth.write && depth.store {
            traffic.written += scaled(size);
        }
    }
    traffic
}

/// Bytes of the part of a target or buffer that is read.
fn read_bytes(read: &Read, targets: &Targets) -> u64 {
    match (targets.get(&read.target), read.mip, read.layer) {
        (None, ..) => whole_bytes(&read.target, targets),
        (Some(target), mip, Some(layer)) => target.slice_bytes(Slice {
            mip: mip.unwrap_or(0),
            layer,
        }),
        (Some(target), Some(mip), None) => target.mip_bytes(mip),
        (Some(target), None, None) => target.bytes(),
    }
}

/// Bytes of all of a target or buffer.
fn whole_bytes(name: &str, targets: &Targets) -> u64 {
    match targets.get(name) {
        Some(target) => target.bytes(),
        None => targets.buffer(name).map_or(0, |buffer| buffer.size()),
    }
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
