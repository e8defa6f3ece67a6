//! What the graph of a pipeline has: from the description to what the layout needs.

use lightbench::render::PipelineDesc;
use lightbench::render::description::PassDesc;
use lightbench::render::life::{reads, writes};

use super::layout::{Resource, Way};
use crate::ui::messages::say;

/// A target or a buffer of a pipeline.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Node {
    /// Its name.
    pub name: String,
    /// Its format, or that it is a buffer.
    pub about: String,
    /// Whether it is a target, which can be shown.
    pub is_target: bool,
    /// Who uses it.
    pub resource: Resource,
}

/// The targets and buffers that passes use: targets in the order of their declarations, then buffers.
pub fn nodes(desc: &PipelineDesc) -> Vec<Node> {
    let targets = desc.targets.iter().map(|target| {
        let format = target.format.name();
        (target.name.as_str(), format.to_owned(), true)
    });
    let buffers = desc.buffers.iter().map(|buffer| {
        (
            buffer.name.as_str(),
            say!("pass_graph.buffer_kind").to_owned(),
            false,
        )
    });
    targets
        .chain(buffers)
        .filter_map(|(name, about, is_target)| {
            let passes = desc.passes.iter().enumerate();
            let uses: Vec<(usize, Way)> = passes
                .filter_map(|(index, pass)| Some((index, way(pass, name)?)))
                .collect();
            (!uses.is_empty()).then(|| Node {
                name: name.to_owned(),
                about,
                is_target,
                resource: Resource { uses },
            })
        })
        .collect()
}

/// How a pass uses a target or buffer, if it does. A target that is drawn to and keeps what it holds is
/// written alone, unless the pass also tests or samples it.
fn way(pass: &PassDesc, name: &str) -> Option<Way> {
    let is = |used: &str| used == name;
    match (reads(pass).any(is), writes(pass).any(is)) {
        (true, true) => Some(Way::Both),
        (true, false) => Some(Way::Read),
        (false, true) => Some(Way::Write),
        (false, false) => None,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::ui::panels::pass_graph::layout::{Sizes, lay_out};
    use lightbench::assets::files::Files;
    use lightbench::script::{Settings, list_pipelines, load_pipeline};

    const SIZES: Sizes = Sizes {
        pass: [150.0, 90.0],
        gap: 30.0,
        lane: 30.0,
        label: 20.0,
    };

    #[test]
    fn reads_and_writes_of_deferred_shading_are_those_of_its_file() {
        let files = Files::shipped();
        let desc = load_pipeline(&files, "deferred_shading", &Settings::new()).unwrap();
        let nodes = nodes(&desc);
        let way_of = |node: &str, pass: &str| {
            let node = nodes.iter().find(|known| known.name == node).unwrap();
            let pass = desc.passes.iter().position(|known| known.name == pass);
            let uses = &node.resource.uses;
            let found = uses.iter().find(|(index, _)| Some(*index) == pass);
            found.map(|(_, way)| *way)
        };
        assert_eq!(way_of("g_albedo", "g_buffer"), Some(Way::Write));
        assert_eq!(way_of("g_albedo", "lights"), Some(Way::Read));
        assert_eq!(way_of("g_albedo", "output"), None);
        assert_eq!(way_of("hdr", "lights"), Some(Way::Write));
        assert_eq!(way_of("hdr", "output"), Some(Way::Read));
        assert_eq!(way_of("output", "output"), Some(Way::Write));
    }

    /// Every shipped pipeline gets a layout in which each use has its line.
    #[test]
    fn every_shipped_pipeline_is_laid_out() {
        let files = Files::shipped();
        for entry in list_pipelines(&files).unwrap() {
            let desc = load_pipeline(&files, &entry.name, &Settings::new()).unwrap();
            let nodes = nodes(&desc);
            let resources: Vec<_> = nodes.iter().map(|node| node.resource.clone()).collect();
            let widths = vec![80.0; nodes.len()];
            let layout = lay_out(desc.passes.len(), &resources, &widths, &SIZES);
            assert_eq!(layout.passes.len(), desc.passes.len());
            let lines: usize = layout.lanes.iter().map(|lane| lane.lines.len()).sum();
            let uses: usize = resources.iter().map(|resource| resource.uses.len()).sum();
            assert_eq!(lines, uses, "{}", entry.name);
        }
    }
}
