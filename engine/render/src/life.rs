//! From which pass to which pass each target is needed, and which passes nobody needs.

use crate::description::{LightStencil, Load, PassDesc, PassKind, PipelineDesc, TargetDesc};

/// What a pipeline's passes need of its targets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lives {
    /// For each pass, whether the picture, a counter, a buffer or the next frame depends on it.
    pub needed: Vec<bool>,
    /// For each target, the first and last needed pass that uses it; `None` where none does.
    spans: Vec<Option<(usize, usize)>>,
    /// For each target, whether its content must outlast the frame.
    lasting: Vec<bool>,
}

impl Lives {
    /// Looks at all passes of a valid description.
    pub fn of(desc: &PipelineDesc) -> Self {
        let needed = needed(desc);
        let lasting = desc.targets.iter().map(|t| lasts(desc, t)).collect();
        let span = |target: &TargetDesc| {
            let uses = |(index, pass): (usize, &PassDesc)| {
                (needed[index] && touches(pass, &target.name)).then_some(index)
            };
            let mut passes = desc.passes.iter().enumerate().filter_map(uses);
            let first = passes.next()?;
            Some((first, passes.next_back().unwrap_or(first)))
        };
        let spans = desc.targets.iter().map(span).collect();
        Self {
            needed,
            spans,
            lasting,
        }
    }

    /// The passes that are dropped, by name.
    pub fn dropped<'a>(&'a self, desc: &'a PipelineDesc) -> impl Iterator<Item = &'a str> {
        let passes = desc.passes.iter().zip(&self.needed);
        passes
            .filter(|(_, needed)| !**needed)
            .map(|(pass, _)| pass.name.as_str())
    }

    /// The earlier target whose texture target `index` takes over: one of the same descriptor that
    /// is dead by then, and that no other target between them has taken.
    pub fn host(&self, desc: &PipelineDesc, index: usize) -> Option<usize> {
        // Follow the assignments of all earlier targets in order, so that each is made once.
        let mut owner: Vec<usize> = Vec::with_capacity(index + 1);
        for current in 0..=index {
            let host = (0..current)
                .filter(|&earlier| owner[earlier] == earlier)
                .find(|&earlier| self.can_share(desc, &owner, earlier, current));
            owner.push(host.unwrap_or(current));
        }
        owner.pop().filter(|&host| host != index)
    }

    /// Whether `target` fits into the texture of `host`, beside all that share it already.
    fn can_share(&self, desc: &PipelineDesc, owner: &[usize], host: usize, target: usize) -> bool {
        let alike = |a: &TargetDesc, b: &TargetDesc| {
            (a.format, a.size, a.shape, a.mips, a.samples)
                == (b.format, b.size, b.shape, b.mips, b.samples)
        };
        let Some((first, last)) = self.spans[target] else {
            return false;
        };
        !self.lasting[target]
            && alike(&desc.targets[host], &desc.targets[target])
            && begins_afresh(desc, first, &desc.targets[target].name)
            && owner.iter().enumerate().all(|(other, &owned)| {
                owned != host
                    || (!self.lasting[other]
                        && self.spans[other].is_some_and(|(from, to)| last < from || to < first))
            })
    }
}

/// Whether the first pass that uses a target leaves nothing of what the texture held before.
fn begins_afresh(desc: &PipelineDesc, first: usize, name: &str) -> bool {
    let pass = &desc.passes[first];
    let colors = pass.colors.iter().filter(|color| color.target == name);
    let mut loads = colors.map(|color| color.load).chain(
        pass.depth
            .iter()
            .filter(|d| d.target == name)
            .map(|d| d.load),
    );
    match loads.next() {
        Some(Load::Clear(_)) => true,
        Some(Load::Keep) => matches!(pass.kind, PassKind::Fullscreen),
        // A compute pass may leave texels out, a copy fills all.
        None => matches!(
            &pass.kind,
            PassKind::Copy { to, .. } | PassKind::Resolve { to, .. } if to.target == name
        ),
    }
}

fn lasts(desc: &PipelineDesc, target: &TargetDesc) -> bool {
    let shown = [&desc.hdr, &desc.output].into_iter().flatten();
    shown.into_iter().any(|named| named.name == target.name)
        || desc.passes.iter().any(
            |pass| matches!(&pass.kind, PassKind::History { to, .. } if to.target == target.name),
        )
}

/// Goes back from the results: a pass is needed if something that it writes is.
fn needed(desc: &PipelineDesc) -> Vec<bool> {
    let mut wanted: Vec<&str> = [&desc.hdr, &desc.output]
        .into_iter()
        .flatten()
        .map(|named| named.name.as_str())
        .collect();
    wanted.extend(desc.counters.iter().map(|counter| counter.buffer.as_str()));
    let mut needed = vec![false; desc.passes.len()];
    // A target that the next frame reads makes the frame a circle, so go round until nothing is
    // added.
    loop {
        let before = wanted.len();
        for (index, pass) in desc.passes.iter().enumerate().rev() {
            if needed[index] || !writes(pass).any(|name| wanted.contains(&name)) {
                continue;
            }
            needed[index] = true;
            for name in reads(pass).chain(writes(pass)) {
                if !wanted.contains(&name) {
                    wanted.push(name);
                }
            }
        }
        if wanted.len() == before {
            return needed;
        }
    }
}

/// The targets and buffers that a pass writes.
pub fn writes(pass: &PassDesc) -> impl Iterator<Item = &str> {
    let kind = match &pass.kind {
        PassKind::Copy { to, .. } | PassKind::Resolve { to, .. } | PassKind::History { to, .. } => {
            Some(to.target.as_str())
        }
        PassKind::Mips { target, .. } => Some(target.target.as_str()),
        _ => None,
    };
    let colors = pass.colors.iter();
    let marks = match &pass.kind {
        PassKind::Lights(lights) => lights.stencil != LightStencil::Off,
        PassKind::Geometry(geometry) => geometry.repeat.is_some_and(|repeat| repeat.stencil),
        _ => false,
    };
    let depth = pass.depth.iter().filter(move |depth| {
        marks || depth.write || depth.stencil.as_ref().is_some_and(|s| s.writes())
    });
    kind.into_iter()
        .chain(colors.clone().map(|color| color.target.as_str()))
        .chain(colors.filter_map(|color| color.resolve.as_ref().map(|r| r.name.as_str())))
        .chain(depth.map(|depth| depth.target.as_str()))
        .chain(pass.updates.iter().map(|update| update.target.as_str()))
}

/// The targets and buffers that a pass reads.
pub fn reads(pass: &PassDesc) -> impl Iterator<Item = &str> {
    use crate::description::{Amount, Dispatch};
    let kind = match &pass.kind {
        PassKind::Copy { from, .. }
        | PassKind::Resolve { from, .. }
        | PassKind::History { from, .. } => Some(from.target.as_str()),
        PassKind::Compute(Dispatch::Indirect { buffer, .. }) => Some(buffer.as_str()),
        PassKind::Compute(Dispatch::Threads(amount) | Dispatch::Groups(amount)) => match amount {
            Amount::Texels { target, .. } => Some(target.as_str()),
            _ => None,
        },
        _ => None,
    };
    kind.into_iter()
        .chain(pass.reads.iter().map(|read| read.target.as_str()))
        .chain(pass.depth.iter().map(|depth| depth.target.as_str()))
}

/// Whether a pass uses a target or buffer in any way.
pub fn touches(pass: &PassDesc, name: &str) -> bool {
    writes(pass).chain(reads(pass)).any(|used| used == name)
}
