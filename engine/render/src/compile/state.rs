//! The fixed-function state of GPU pipelines, from the words of a description.

use crate::description::{Blend, DepthCompare};
use crate::reflection::Reflection;

/// A render pipeline, and whether it reads the second vertex stream.
#[derive(Clone, Debug)]
pub struct DrawPipeline {
    /// The pipeline.
    pub pipeline: wgpu::RenderPipeline,
    /// Whether normals, texture coordinates and tangents must be bound.
    pub attributes: bool,
}

/// What differs between the pipelines of one pass.
pub(super) struct State {
    pub fragment_defines: &'static [&'static str],
    pub vertex_path: &'static str,
    pub vertex_defines: &'static [&'static str],
    /// Whether the pass's shader may bring its own vertex stage.
    pub own_vertex: bool,
    pub cull: Option<wgpu::Face>,
    pub front: wgpu::FrontFace,
    pub depth_compare: Option<wgpu::CompareFunction>,
}

/// The vertex buffers that a vertex stage needs.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum VertexStreams {
    None,
    Positions,
    All,
}

const POSITIONS: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: 12,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3],
};

const ATTRIBUTES: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: 36,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![1 => Float32x3, 2 => Float32x2, 3 => Float32x4],
};

impl VertexStreams {
    pub fn of(reflection: &Reflection) -> Self {
        match reflection.vertex_inputs.last() {
            None => Self::None,
            Some(0) => Self::Positions,
            Some(_) => Self::All,
        }
    }

    pub fn layouts(self) -> &'static [Option<wgpu::VertexBufferLayout<'static>>] {
        match self {
            Self::None => &[],
            Self::Positions => &[Some(POSITIONS)],
            Self::All => &[Some(POSITIONS), Some(ATTRIBUTES)],
        }
    }
}

pub(super) fn compare(test: DepthCompare) -> wgpu::CompareFunction {
    match test {
        DepthCompare::Nearer => wgpu::CompareFunction::GreaterEqual,
        DepthCompare::Equal => wgpu::CompareFunction::Equal,
        DepthCompare::Always => wgpu::CompareFunction::Always,
    }
}

pub(super) fn blend(blend: Blend) -> Option<wgpu::BlendState> {
    let one = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Add,
    };
    match blend {
        Blend::Replace => None,
        Blend::Add => Some(wgpu::BlendState {
            color: one,
            alpha: one,
        }),
        Blend::Over => Some(wgpu::BlendState::ALPHA_BLENDING),
    }
}
