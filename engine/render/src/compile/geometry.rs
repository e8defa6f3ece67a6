//! GPU pipelines of `geometry` passes.

use lightbench_assets::files::Files;

use super::state::State;
use super::{Compiler, GEOMETRY_VERTEX, PassLayout};
use crate::description::{Faces, Geometry, PassDesc, PipelineDesc};
use crate::pipeline::PassPipelines;
use crate::problem::Problem;
use crate::variant::Variant;

impl Compiler {
    /// One pipeline for each way in which the materials of a scene can be drawn.
    pub(super) fn geometry(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        geometry: &Geometry,
        layout: &PassLayout,
    ) -> Result<PassPipelines, Problem> {
        let mut variants = Vec::with_capacity(Variant::COUNT);
        for variant in Variant::all() {
            // Without outputs and without holes there is nothing for a fragment stage to do.
            let outputs = !pass.colors.is_empty() || !pass.updates.is_empty();
            let fragment = pass
                .shader
                .as_ref()
                .filter(|_| outputs || variant.alpha_test());
            let depth_only = fragment.is_none();
            let state = State {
                fragment_defines: variant.defines(),
                vertex_defines: if depth_only { &["POSITION_ONLY"] } else { &[] },
                cull: match geometry.faces {
                    Faces::Material if variant.two_sided() => None,
                    Faces::Material | Faces::Front => Some(wgpu::Face::Back),
                    Faces::Back => Some(wgpu::Face::Front),
                    Faces::Both => None,
                },
                front: if variant.mirrored() {
                    wgpu::FrontFace::Cw
                } else {
                    wgpu::FrontFace::Ccw
                },
                ..State::new(GEOMETRY_VERTEX, pass.depth.as_ref())
            };
            variants.push(self.build(files, desc, pass, fragment, layout, &state)?);
        }
        Ok(PassPipelines::Geometry(variants))
    }
}
