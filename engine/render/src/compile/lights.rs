//! GPU pipelines of `lights` passes.

use lightbench_assets::files::Files;
use wgpu::{CompareFunction, Face, StencilOperation};

use super::state::{Channels, State, marking, stencil_mark, stencil_test, take_counted};
use super::{Compiler, FULL_SCREEN, FULLSCREEN_VERTEX, LIGHT_VERTEX, PassLayout};
use crate::binding::shades;
use crate::description::{LightStencil, Lights, PassDesc, PipelineDesc, ShaderDesc};
use crate::gpu_pipelines::{
    DrawPipeline, LightPipelines, LightsPipelines, PassPipelines, StencilPipelines,
};
use crate::problem::Problem;

/// The fragment stage of pipelines that only mark stencil.
const MARK_SHADER: &str = "shaders/mark.wgsl";

impl Compiler {
    /// Back faces, front faces and the whole screen, for each array of lights; which light takes
    /// which is decided per frame.
    pub(super) fn lights(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        lights: &Lights,
        layout: &PassLayout,
    ) -> Result<PassPipelines, Problem> {
        let arrays = (0..lights.arrays.max(1))
            .map(|array| self.array(files, desc, pass, lights, layout, array))
            .collect::<Result<_, _>>()?;
        let stencil = match lights.stencil {
            LightStencil::Off => None,
            scheme => {
                let mark = self.marker(files, desc, pass, layout, &mark(scheme))?;
                let count = self.marker(files, desc, pass, layout, &count())?;
                let wipe = State {
                    stencil: stencil_mark(StencilOperation::Keep, StencilOperation::Replace),
                    ..marking(None, CompareFunction::Always, FULLSCREEN_VERTEX)
                };
                Some(StencilPipelines {
                    mark,
                    count,
                    wipe: self.marker(files, desc, pass, layout, &wipe)?,
                })
            }
        };
        Ok(PassPipelines::Lights(LightsPipelines { arrays, stencil }))
    }

    /// The pipelines of one array of lights.
    fn array(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        lights: &Lights,
        layout: &PassLayout,
        array: u32,
    ) -> Result<LightPipelines, Problem> {
        let channels = if lights.arrays == 0 {
            Channels::Declared
        } else {
            Channels::Only {
                target: array / 4,
                channel: array % 4,
            }
        };
        let mut build =
            |cull, test, vertex_defines: &'static [&'static str], stencil, unclipped| {
                let state = State {
                    unclipped_depth: unclipped,
                    own_vertex: false,
                    vertex_defines,
                    cull,
                    depth_compare: if lights.any_depth {
                        CompareFunction::Always
                    } else {
                        test
                    },
                    channels,
                    stencil,
                    ..State::new(LIGHT_VERTEX, pass.depth.as_ref())
                };
                self.build(files, desc, pass, pass.shader.as_ref(), layout, &state)
            };
        let declared = State::new(LIGHT_VERTEX, pass.depth.as_ref()).stencil;
        let mut plain = |cull, test, defines| build(cull, test, defines, declared.clone(), false);
        use CompareFunction::{Always, Equal, GreaterEqual, LessEqual, NotEqual};
        // Depth is reversed, so "less" is farther. A back face lights what lies in front of it.
        let back = plain(Some(Face::Front), LessEqual, &[])?;
        let front = plain(Some(Face::Back), GreaterEqual, &[])?;
        let screen = plain(None, Always, &[FULL_SCREEN])?;
        let marked = match lights.stencil {
            LightStencil::Off => None,
            LightStencil::TwoPass => {
                let test = stencil_test(Equal);
                Some(build(Some(Face::Back), GreaterEqual, &[], test, false)?)
            }
            LightStencil::Inverse => {
                let test = stencil_test(NotEqual);
                Some(build(Some(Face::Front), LessEqual, &[], test, false)?)
            }
        };
        // Back faces cover every pixel of a mesh from wherever it is seen.
        let counted = match lights.stencil {
            LightStencil::Off => None,
            _ => Some(build(Some(Face::Front), Always, &[], take_counted(), true)?),
        };
        Ok(LightPipelines {
            back,
            front,
            screen,
            marked,
            counted,
        })
    }

    /// A pipeline that writes no colour.
    pub(super) fn marker(
        &mut self,
        files: &Files,
        desc: &PipelineDesc,
        pass: &PassDesc,
        layout: &PassLayout,
        state: &State,
    ) -> Result<DrawPipeline, Problem> {
        let shader = ShaderDesc {
            path: MARK_SHADER.to_owned(),
            at: pass.at.clone(),
            defines: Vec::new(),
            define_places: Vec::new(),
        };
        let marks = self.load(files, MARK_SHADER, state.fragment_defines, &shader.defines)?;
        shades(MARK_SHADER, &marks.reflection)?;
        self.build(files, desc, pass, Some(&shader), layout, state)
    }
}

/// Counts faces that the scene hides: back faces up, front faces down. Depth is clamped, since the
/// count is wrong where the far plane cuts faces away.
fn count() -> State {
    let hidden = |depth_fail_op| wgpu::StencilFaceState {
        compare: CompareFunction::Always,
        fail_op: StencilOperation::Keep,
        depth_fail_op,
        pass_op: StencilOperation::Keep,
    };
    State {
        stencil: wgpu::StencilState {
            front: hidden(StencilOperation::DecrementWrap),
            back: hidden(StencilOperation::IncrementWrap),
            read_mask: 0xff,
            write_mask: 0xff,
        },
        unclipped_depth: true,
        ..marking(None, CompareFunction::GreaterEqual, LIGHT_VERTEX)
    }
}

/// How a scheme marks: see [`LightStencil`]. Depth is reversed, so "less" is farther.
fn mark(scheme: LightStencil) -> State {
    if scheme == LightStencil::Inverse {
        // Front faces that are hidden: the scene lies before the volume.
        return State {
            stencil: stencil_mark(StencilOperation::Replace, StencilOperation::Keep),
            ..marking(
                Some(Face::Back),
                CompareFunction::GreaterEqual,
                LIGHT_VERTEX,
            )
        };
    }
    // Back faces behind the scene: the scene does not lie behind the volume.
    State {
        stencil: stencil_mark(StencilOperation::Keep, StencilOperation::Replace),
        ..marking(Some(Face::Front), CompareFunction::LessEqual, LIGHT_VERTEX)
    }
}
