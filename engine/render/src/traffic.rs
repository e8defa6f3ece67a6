//! The byte model: what a pass moves between its shaders and its targets.
//!
//! It counts what the declared formats and sizes imply, as if there were no caches and no
//! compression. All samples of a texel count.
//!
//! | what | read | written |
//! | --- | --- | --- |
//! | a target that the shader reads | one texel a covered pixel | |
//! | a buffer that the shader reads or updates | all of it once | all of it once |
//! | a colour target | a texel a covered pixel where it blends | a texel a covered pixel |
//! | a depth target | a texel a covered pixel, unless it is cleared in the pass or the shader reads it | the same, where it is written |
//! | `copy`, `history`, `resolve` | one target | the other |
//! | `mips` | all levels but the last | all levels but the first |
//! | `clear` | | all |
//!
//! How often the picture is covered depends on the kind of pass: `fullscreen` passes cover it once.
//! `geometry` passes count as once too, since overdraw depends on the order of the objects;
//! repeated for groups of lights, once a group or, with scissor, the sum of the rectangles. `lights`
//! passes cover the sum over the lights of the share of the picture inside the light's bounding
//! rectangle. `shadow` passes cover one layer a view. Samples that are dropped at the end of their
//! pass are not written; what they resolve to is. Vertices, textures and the engine's buffers are left
//! out.
//!
//! Apart from these stand stencil (a byte a sample: one for each test, one for each write), what a
//! tile-based GPU moves for the attachments (it loads what a pass keeps and stores what outlasts it,
//! however often fragments touch them), and overdraw (fragments beyond the covered pixels, times what
//! each moves), which needs a driver that counts fragments.
//!
//! For formulas of whole pipelines see Engel 2009, "The Light Pre-Pass Renderer", ShaderX7, and
//! Olsson and Assarsson 2011, "Tiled Shading", Journal of Graphics, GPU and Game Tools 15(4).

use crate::Format;
use crate::description::{
    Blend, Compare, DepthAttachment, LightStencil, Load, PassDesc, PassKind, Read, Slice,
    StencilClear,
};
use crate::targets::{Target, Targets};

/// Bytes that a pass moves, by the model of this module.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Traffic {
    /// Bytes read.
    pub read: u64,
    /// Bytes written.
    pub written: u64,
    /// Bytes of stencil tested and written.
    pub stencil: u64,
    /// Bytes that a tile-based GPU loads before the pass.
    pub loaded: u64,
    /// Bytes that a tile-based GPU stores after the pass.
    pub stored: u64,
    /// Pixels that the pass covers, each as often as it does.
    pub pixels: u64,
    /// Bytes that each fragment moves to and from the attachments.
    pub fragment_bytes: u64,
}

impl Traffic {
    /// Bytes of the fragments that the model leaves out, where a driver counted them all.
    pub fn overdraw(&self, fragments: u64) -> u64 {
        fragments.saturating_sub(self.pixels) * self.fragment_bytes
    }
}

/// What a pass moves. `coverage` says how often it covers what it draws to.
pub fn traffic(pass: &PassDesc, targets: &Targets, coverage: f64) -> Traffic {
    match &pass.kind {
        PassKind::Copy { from, to } | PassKind::History { from, to } => {
            let bytes = part(from, targets).min(part(to, targets));
            Traffic {
                read: bytes,
                written: bytes,
                ..Traffic::default()
            }
        }
        PassKind::Resolve { from, to } => Traffic {
            read: part(from, targets),
            written: part(to, targets),
            ..Traffic::default()
        },
        PassKind::Mips { target, .. } => mips(&target.target, targets),
        PassKind::Clear => clear(pass, targets),
        _ => shading(pass, targets, coverage),
    }
}

fn mips(name: &str, targets: &Targets) -> Traffic {
    let Some(target) = targets.get(name) else {
        return Traffic::default();
    };
    let last = target.texture.mip_level_count().saturating_sub(1);
    Traffic {
        read: target.bytes() - target.mip_bytes(last),
        written: target.bytes() - target.mip_bytes(0),
        ..Traffic::default()
    }
}

fn clear(pass: &PassDesc, targets: &Targets) -> Traffic {
    let names = pass.colors.iter().map(|color| &color.target);
    let names = names.chain(pass.updates.iter().map(|update| &update.target));
    let mut traffic = Traffic {
        written: names.map(|name| whole(name, targets)).sum(),
        ..Traffic::default()
    };
    if let Some(depth) = &pass.depth
        && let Some(target) = targets.get(&depth.target)
    {
        if depth.load != Load::Keep {
            traffic.written += depth_share(target, target.bytes());
        }
        if depth
            .stencil
            .as_ref()
            .is_some_and(|s| s.load != StencilClear::Keep)
        {
            traffic.stencil += stencil_share(target, target.bytes());
        }
    }
    traffic
}

/// Passes with a shader.
fn shading(pass: &PassDesc, targets: &Targets, coverage: f64) -> Traffic {
    let covered = |bytes: u64| (bytes as f64 * coverage).round() as u64;
    let mut traffic = Traffic::default();
    for read in &pass.reads {
        traffic.read += match targets.get(&read.target) {
            Some(_) => covered(part(read, targets)),
            None => whole(&read.target, targets),
        };
    }
    for update in &pass.updates {
        traffic.written += match targets.get(&update.target) {
            Some(target) if update.one_layer => covered(target.slice_bytes(update.slice)),
            Some(target) => covered(target.mip_bytes(update.slice.mip)),
            None => whole(&update.target, targets),
        };
    }
    for color in &pass.colors {
        let Some(target) = targets.get(&color.target) else {
            continue;
        };
        let size = target.slice_bytes(color.slice);
        let texels = texels(target, color.slice);
        traffic.pixels = traffic.pixels.max(covered(texels));
        traffic.fragment_bytes += size / texels.max(1);
        if color.store {
            traffic.written += covered(size);
            traffic.stored += size;
        }
        if color.blend != Blend::Replace {
            traffic.read += covered(size);
            traffic.fragment_bytes += size / texels.max(1);
        }
        match color.load {
            Load::Keep => traffic.loaded += size,
            // What is not covered is cleared all the same.
            Load::Clear(_) if coverage < 1.0 => traffic.written += size - covered(size),
            Load::Clear(_) => {}
        }
        if let Some(resolve) = &color.resolve {
            let mean = whole(&resolve.name, targets);
            traffic.written += mean;
            traffic.stored += mean;
        }
    }
    if let Some(depth) = &pass.depth
        && let Some(target) = targets.get(&depth.target)
    {
        attached_depth(pass, depth, target, coverage, &mut traffic);
    }
    traffic
}

fn attached_depth(
    pass: &PassDesc,
    depth: &DepthAttachment,
    target: &Target,
    coverage: f64,
    traffic: &mut Traffic,
) {
    let covered = |bytes: u64| (bytes as f64 * coverage).round() as u64;
    let texels = texels(target, depth.slice);
    let all = target.slice_bytes(depth.slice);
    let size = depth_share(target, all);
    let layers = match pass.kind {
        PassKind::Shadow(_) => coverage,
        _ => 1.0,
    };
    let whole = (size as f64 * layers).round() as u64;
    traffic.pixels = traffic.pixels.max(covered(texels));
    let kept = depth.load == Load::Keep;
    let tested = depth.compare != Compare::Always || matches!(pass.kind, PassKind::Lights(_));
    let shader_reads = pass.reads.iter().any(|read| read.target == depth.target);
    if kept && tested && !shader_reads {
        traffic.read += covered(size);
    }
    if tested {
        traffic.fragment_bytes += size / texels.max(1);
    }
    if kept {
        traffic.loaded += whole;
    }
    if depth.write {
        traffic.fragment_bytes += size / texels.max(1);
        if depth.store {
            traffic.written += covered(size);
            traffic.stored += whole;
        }
    }
    traffic.stencil += covered(stencil_share(target, all)) * stencil_accesses(pass, depth);
}

/// How often a covered sample of stencil is tested or written.
fn stencil_accesses(pass: &PassDesc, depth: &DepthAttachment) -> u64 {
    let marks = match &pass.kind {
        PassKind::Lights(lights) => lights.stencil != LightStencil::Off,
        PassKind::Geometry(geometry) => geometry.repeat.is_some_and(|repeat| repeat.stencil),
        _ => false,
    };
    if marks {
        // Marking writes, shading tests.
        return 2;
    }
    depth.stencil.as_ref().map_or(0, |stencil| {
        u64::from(stencil.compare != Compare::Always) + u64::from(stencil.writes())
    })
}

/// Texels of one layer of a mip level.
fn texels(target: &Target, slice: Slice) -> u64 {
    let (width, height) = target.mip_size(slice.mip);
    u64::from(width) * u64::from(height)
}

/// Of so many bytes of a target those that hold no stencil.
fn depth_share(target: &Target, bytes: u64) -> u64 {
    let format = Format(target.texture.format());
    bytes / u64::from(format.bytes_per_texel()) * u64::from(format.depth_bytes())
}

/// A byte for each sample in so many bytes of a target that has stencil.
fn stencil_share(target: &Target, bytes: u64) -> u64 {
    let format = Format(target.texture.format());
    if format.has_stencil() {
        bytes / u64::from(format.bytes_per_texel())
    } else {
        0
    }
}

/// Bytes of the part of a target or buffer that is read.
fn part(read: &Read, targets: &Targets) -> u64 {
    let Some(target) = targets.get(&read.target) else {
        return whole(&read.target, targets);
    };
    let bytes = match (read.mip, read.layer) {
        (mip, Some(layer)) => target.slice_bytes(Slice {
            mip: mip.unwrap_or(0),
            layer,
        }),
        (Some(mip), None) => target.mip_bytes(mip),
        (None, None) => target.bytes(),
    };
    depth_share(target, bytes)
}

/// Bytes of all of a target or buffer.
fn whole(name: &str, targets: &Targets) -> u64 {
    match targets.get(name) {
        Some(target) => target.bytes(),
        None => targets.buffer(name).map_or(0, |buffer| buffer.size()),
    }
}
