//! The fixed-function state of GPU pipelines, from the words of a description.

use crate::description::{
    Blend, BlendFactor, BlendOperation, BlendPart, Compare, DepthAttachment, Stencil,
    StencilOperation,
};
use crate::reflection::Reflection;

/// Which channels of the colour targets a pipeline writes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Channels {
    /// Those that the pass declares.
    Declared,
    /// One channel of one target: for arrays of lights.
    Only { target: u32, channel: u32 },
    /// None: for marking stencil.
    Nothing,
}

/// What differs between the pipelines of one pass.
#[derive(Clone)]
pub(super) struct State {
    pub fragment_defines: &'static [&'static str],
    pub vertex_path: &'static str,
    pub vertex_defines: &'static [&'static str],
    /// Whether the pass's shader may bring its own vertex stage.
    pub own_vertex: bool,
    pub cull: Option<wgpu::Face>,
    pub front: wgpu::FrontFace,
    /// The depth test; unused without a depth target.
    pub depth_compare: wgpu::CompareFunction,
    pub depth_write: bool,
    pub stencil: wgpu::StencilState,
    pub channels: Channels,
    /// Whether depth beyond the near and far plane is clamped instead of cut off, where the device
    /// can do it.
    pub unclipped_depth: bool,
}

impl State {
    /// The state that a pass declares, for a vertex stage.
    pub fn new(vertex_path: &'static str, depth: Option<&DepthAttachment>) -> Self {
        Self {
            fragment_defines: &[],
            vertex_path,
            vertex_defines: &[],
            own_vertex: true,
            cull: None,
            front: wgpu::FrontFace::Ccw,
            depth_compare: depth.map_or(wgpu::CompareFunction::Always, |d| compare(d.compare)),
            depth_write: depth.is_some_and(|d| d.write),
            stencil: depth
                .and_then(|d| d.stencil.as_ref())
                .map_or_else(wgpu::StencilState::default, stencil),
            channels: Channels::Declared,
            unclipped_depth: false,
        }
    }
}

/// Writes no colour and no depth.
pub(super) fn marking(
    cull: Option<wgpu::Face>,
    depth_compare: wgpu::CompareFunction,
    vertex_path: &'static str,
) -> State {
    State {
        own_vertex: false,
        cull,
        depth_compare,
        channels: Channels::Nothing,
        ..State::new(vertex_path, None)
    }
}

/// Compares with the reference, and changes nothing.
pub(super) fn stencil_test(compare: wgpu::CompareFunction) -> wgpu::StencilState {
    let face = wgpu::StencilFaceState {
        compare,
        ..wgpu::StencilFaceState::IGNORE
    };
    both(face)
}

/// Passes where something was counted, and sets the count to zero.
pub(super) fn take_counted() -> wgpu::StencilState {
    both(wgpu::StencilFaceState {
        compare: wgpu::CompareFunction::NotEqual,
        fail_op: wgpu::StencilOperation::Keep,
        depth_fail_op: wgpu::StencilOperation::Keep,
        pass_op: wgpu::StencilOperation::Zero,
    })
}

/// Tests nothing, and changes the value where the depth test fails or passes.
pub(super) fn stencil_mark(
    depth_fail: wgpu::StencilOperation,
    pass: wgpu::StencilOperation,
) -> wgpu::StencilState {
    both(wgpu::StencilFaceState {
        compare: wgpu::CompareFunction::Always,
        fail_op: wgpu::StencilOperation::Keep,
        depth_fail_op: depth_fail,
        pass_op: pass,
    })
}

/// The same for front and back faces, on all bits.
fn both(face: wgpu::StencilFaceState) -> wgpu::StencilState {
    wgpu::StencilState {
        front: face,
        back: face,
        read_mask: 0xff,
        write_mask: 0xff,
    }
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

pub(super) fn compare(test: Compare) -> wgpu::CompareFunction {
    match test {
        Compare::Never => wgpu::CompareFunction::Never,
        Compare::Nearer => wgpu::CompareFunction::GreaterEqual,
        Compare::StrictlyNearer => wgpu::CompareFunction::Greater,
        Compare::Farther => wgpu::CompareFunction::LessEqual,
        Compare::StrictlyFarther => wgpu::CompareFunction::Less,
        Compare::Equal => wgpu::CompareFunction::Equal,
        Compare::NotEqual => wgpu::CompareFunction::NotEqual,
        Compare::Always => wgpu::CompareFunction::Always,
    }
}

/// The same for front and back faces.
pub(super) fn stencil(stencil: &Stencil) -> wgpu::StencilState {
    let face = wgpu::StencilFaceState {
        compare: compare(stencil.compare),
        fail_op: stencil_operation(stencil.fail),
        depth_fail_op: stencil_operation(stencil.depth_fail),
        pass_op: stencil_operation(stencil.pass),
    };
    wgpu::StencilState {
        front: face,
        back: face,
        read_mask: u32::from(stencil.read_mask),
        write_mask: u32::from(stencil.write_mask),
    }
}

fn stencil_operation(operation: StencilOperation) -> wgpu::StencilOperation {
    match operation {
        StencilOperation::Keep => wgpu::StencilOperation::Keep,
        StencilOperation::Zero => wgpu::StencilOperation::Zero,
        StencilOperation::Replace => wgpu::StencilOperation::Replace,
        StencilOperation::Invert => wgpu::StencilOperation::Invert,
        StencilOperation::Increment => wgpu::StencilOperation::IncrementClamp,
        StencilOperation::Decrement => wgpu::StencilOperation::DecrementClamp,
        StencilOperation::IncrementWrap => wgpu::StencilOperation::IncrementWrap,
        StencilOperation::DecrementWrap => wgpu::StencilOperation::DecrementWrap,
    }
}

pub(super) fn blend(blend: Blend) -> Option<wgpu::BlendState> {
    blend.parts().map(|(color, alpha)| wgpu::BlendState {
        color: component(color),
        alpha: component(alpha),
    })
}

fn component(part: BlendPart) -> wgpu::BlendComponent {
    wgpu::BlendComponent {
        src_factor: factor(part.source),
        dst_factor: factor(part.destination),
        operation: match part.operation {
            BlendOperation::Add => wgpu::BlendOperation::Add,
            BlendOperation::Subtract => wgpu::BlendOperation::Subtract,
            BlendOperation::ReverseSubtract => wgpu::BlendOperation::ReverseSubtract,
            BlendOperation::Min => wgpu::BlendOperation::Min,
            BlendOperation::Max => wgpu::BlendOperation::Max,
        },
    }
}

fn factor(factor: BlendFactor) -> wgpu::BlendFactor {
    match factor {
        BlendFactor::Zero => wgpu::BlendFactor::Zero,
        BlendFactor::One => wgpu::BlendFactor::One,
        BlendFactor::Source => wgpu::BlendFactor::Src,
        BlendFactor::OneMinusSource => wgpu::BlendFactor::OneMinusSrc,
        BlendFactor::SourceAlpha => wgpu::BlendFactor::SrcAlpha,
        BlendFactor::OneMinusSourceAlpha => wgpu::BlendFactor::OneMinusSrcAlpha,
        BlendFactor::Destination => wgpu::BlendFactor::Dst,
        BlendFactor::OneMinusDestination => wgpu::BlendFactor::OneMinusDst,
        BlendFactor::DestinationAlpha => wgpu::BlendFactor::DstAlpha,
        BlendFactor::OneMinusDestinationAlpha => wgpu::BlendFactor::OneMinusDstAlpha,
        BlendFactor::Constant => wgpu::BlendFactor::Constant,
        BlendFactor::OneMinusConstant => wgpu::BlendFactor::OneMinusConstant,
    }
}
