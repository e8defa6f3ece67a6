//! GPU pipelines of `geometry` passes.

use lightbench_assets::files::Files;

use super::state::{State, marking, stencil_mark, stencil_test};
use super::{Compiler, FULLSCREEN_VERTEX, GEOMETRY_VERTEX, LIGHT_VERTEX, PassLayout};
use crate::description::{Faces, Geometry, PassDesc, PipelineDesc};
use crate::gpu_pipelines::{GeometryPipelines, MaskPipelines, PassPipelines};
use crate::problem::Problem;
use crate::variant::Variant;

impl Compiler {
    /// One pipeline for each way in which the materials of the scene are drawn.
    pub(super) fn geometry(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        geometry: &Geometry,
        layout: &PassLayout,
    ) -> Result<PassPipelines, Problem> {
        let built = self.variants_of(files, desc, pass, geometry, layout)?;
        Ok(PassPipelines::Geometry(built))
    }

    pub(super) fn variants_of(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        geometry: &Geometry,
        layout: &PassLayout,
    ) -> Result<GeometryPipelines, Problem> {
        let other_models = self.has_other_models(desc, pass);
        let mut variants = Vec::with_capacity(Variant::COUNT);
        for variant in Variant::all() {
            if !self.variants.contains(variant) {
                variants.push(None);
                continue;
            }
            // Without outputs and without holes there is nothing for a fragment stage to do.
            let outputs = !pass.colors.is_empty() || !pass.updates.is_empty();
            let fragment = pass
                .shader
                .as_ref()
                .filter(|_| outputs || variant.alpha_test() || geometry.pull_vertices);
            let depth_only = fragment.is_none();
            let state = State {
                // Shaders that do not tell models apart have one pipeline for all.
                fragment_defines: if other_models {
                    variant.defines()
                } else {
                    variant.with_default_model().defines()
                },
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
            let state = match geometry.repeat {
                // Only what the light's volume marked is drawn.
                Some(repeat) if repeat.stencil => State {
                    stencil: stencil_test(wgpu::CompareFunction::Equal),
                    ..state
                },
                _ => state,
            };
            let built = self.build(files, desc, pass, fragment, layout, &state)?;
            variants.push(Some(built));
        }
        let mask = match geometry.repeat {
            Some(repeat) if repeat.stencil => Some(self.mask(files, desc, pass, layout)?),
            _ => None,
        };
        Ok(GeometryPipelines {
            variants,
            mask,
            pull_vertices: geometry.pull_vertices,
        })
    }

    /// What marks the pixels whose surface lies inside a light's volume.
    fn mask(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        layout: &PassLayout,
    ) -> Result<MaskPipelines, Problem> {
        use wgpu::{CompareFunction, Face, StencilOperation};
        // Depth is reversed, so "less" is farther.
        let mut faces = |cull, depth_compare, operation| {
            let state = State {
                stencil: stencil_mark(StencilOperation::Keep, operation),
                ..marking(cull, depth_compare, LIGHT_VERTEX)
            };
            self.marker(files, desc, pass, layout, &state)
        };
        let back = faces(
            Some(Face::Front),
            CompareFunction::LessEqual,
            StencilOperation::Replace,
        )?;
        let front = faces(
            Some(Face::Back),
            CompareFunction::Less,
            StencilOperation::Zero,
        )?;
        let screen = State {
            stencil: stencil_mark(StencilOperation::Keep, StencilOperation::Replace),
            ..marking(None, CompareFunction::Always, FULLSCREEN_VERTEX)
        };
        let screen = self.marker(files, desc, pass, layout, &screen)?;
        Ok(MaskPipelines {
            back,
            front,
            screen,
        })
    }
}
