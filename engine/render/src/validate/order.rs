//! Nothing is read or kept that no earlier pass wrote.

use std::collections::BTreeSet;

use super::{Checker, FormatSupport};
use crate::description::{Blend, Load, PassDesc, PassKind};
use crate::life;
use crate::problem::{Place, nearest};

impl<S: FormatSupport> Checker<'_, S> {
    pub(super) fn order(&mut self) {
        let desc = self.desc;
        let mut written: BTreeSet<&str> = BTreeSet::new();
        // Buffers keep their contents from frame to frame, and history targets are for that.
        written.extend(desc.buffers.iter().map(|buffer| buffer.name.as_str()));
        written.extend(desc.passes.iter().filter_map(|pass| match &pass.kind {
            PassKind::History { to, .. } => Some(to.target.as_str()),
            _ => None,
        }));
        // What a misspelt name was meant to write has its mistake already.
        let targets = || desc.targets.iter().map(|target| target.name.as_str());
        let misspelt = desc
            .passes
            .iter()
            .flat_map(life::writes)
            .filter(|name| desc.target(name).is_none() && desc.buffer(name).is_none());
        let meant: BTreeSet<&str> = misspelt
            .filter_map(|name| nearest(name, targets()))
            .collect();
        for pass in &desc.passes {
            for (name, at, verb) in wanted(pass) {
                let fresh = !written.contains(name) && !meant.contains(name);
                if desc.target(name).is_some() && fresh && self.unwritten.insert(name) {
                    let later = desc.passes.iter().find(|other| {
                        other.name != pass.name && life::writes(other).any(|w| w == name)
                    });
                    let hint = match later {
                        _ if verb == "draws over" => "add .clear(0, 0, 0, 0) after it".to_owned(),
                        Some(later) => format!(
                            "`{}` writes it, but comes later: move it before `{}`",
                            later.name, pass.name
                        ),
                        None if verb == "tests against" => "add .clear(0.0) after it".to_owned(),
                        None => "no pass writes it: add one before".to_owned(),
                    };
                    self.report(
                        at,
                        format!("`{}` {verb} `{name}`, which nobody wrote yet", pass.name),
                        hint,
                    );
                }
            }
            written.extend(life::writes(pass));
        }
    }
}

/// What must have been written before a pass.
fn wanted(pass: &PassDesc) -> Vec<(&str, &Place, &str)> {
    let mut wanted: Vec<(&str, &Place, &str)> = pass
        .reads
        .iter()
        .map(|read| (read.target.as_str(), &read.at, "reads"))
        .collect();
    match &pass.kind {
        PassKind::Copy { from, .. } | PassKind::History { from, .. } => {
            wanted.push((&from.target, &from.at, "copies"));
        }
        PassKind::Resolve { from, .. } => wanted.push((&from.target, &from.at, "resolves")),
        PassKind::Mips { target, .. } => wanted.push((&target.target, &target.at, "shrinks")),
        _ => {}
    }
    for color in &pass.colors {
        if color.load == Load::Keep && !covers(pass) && pass.kind != PassKind::Clear {
            wanted.push((&color.target, &color.at, "draws over"));
        }
    }
    if let Some(depth) = &pass.depth
        && depth.load == Load::Keep
        && pass.kind != PassKind::Clear
    {
        wanted.push((&depth.target, &depth.at, "tests against"));
    }
    wanted
}

/// Whether the pass writes every pixel of its colour targets, so that nothing old is kept.
fn covers(pass: &PassDesc) -> bool {
    pass.kind == PassKind::Fullscreen
        && pass.depth.is_none()
        && pass
            .colors
            .iter()
            .all(|color| color.blend == Blend::Replace)
}
