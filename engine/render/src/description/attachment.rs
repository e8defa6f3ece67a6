//! The colour and depth targets of a pass.

use super::{Blend, ColorMask, Named, Slice};
use crate::problem::Place;

/// What an attachment holds when its pass begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Load {
    /// What earlier passes left.
    Keep,
    /// A constant: r, g, b, a for colour; the first value for depth.
    Clear([f64; 4]),
}

/// One colour target of a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorAttachment {
    /// The target's name.
    pub target: String,
    /// Where it was named.
    pub at: Place,
    /// Which mip level and layer.
    pub slice: Slice,
    /// What it holds at the beginning.
    pub load: Load,
    /// Whether what the pass wrote is kept; dropping it saves bandwidth where only the resolved
    /// samples are wanted.
    pub store: bool,
    /// How fragments combine with it.
    pub blend: Blend,
    /// Which channels are written.
    pub mask: ColorMask,
    /// The target of one sample that takes the mean of this one's samples at the end of the pass.
    pub resolve: Option<Named>,
}

impl ColorAttachment {
    /// All of a target, kept, replaced and stored.
    pub fn new(target: impl Into<String>, at: Place) -> Self {
        Self {
            target: target.into(),
            at,
            slice: Slice::default(),
            load: Load::Keep,
            store: true,
            blend: Blend::Replace,
            mask: ColorMask::ALL,
            resolve: None,
        }
    }
}

/// A relation between a fragment's value and the stored one. Depth is reversed: 1 near, 0 far.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Compare {
    /// Never true.
    Never,
    /// Nearer than, or as near as, what is there: `>=` under reversed depth.
    Nearer,
    /// Nearer than what is there: `>`.
    StrictlyNearer,
    /// As far as, or farther than, what is there: `<=`.
    Farther,
    /// Farther than what is there: `<`.
    StrictlyFarther,
    /// Exactly what is there: after a depth pre-pass.
    Equal,
    /// Anything but what is there.
    NotEqual,
    /// No test.
    Always,
}

impl Compare {
    /// The names used in pipeline files for depth.
    pub const DEPTH_NAMES: [(&'static str, Self); 8] = [
        ("nearer", Self::Nearer),
        ("strictly_nearer", Self::StrictlyNearer),
        ("farther", Self::Farther),
        ("strictly_farther", Self::StrictlyFarther),
        ("equal", Self::Equal),
        ("not_equal", Self::NotEqual),
        ("always", Self::Always),
        ("never", Self::Never),
    ];

    /// The names used in pipeline files for stencil: the reference compared with what is there.
    pub const STENCIL_NAMES: [(&'static str, Self); 8] = [
        ("greater_equal", Self::Nearer),
        ("greater", Self::StrictlyNearer),
        ("less_equal", Self::Farther),
        ("less", Self::StrictlyFarther),
        ("equal", Self::Equal),
        ("not_equal", Self::NotEqual),
        ("always", Self::Always),
        ("never", Self::Never),
    ];
}

/// What happens to a stencil value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StencilOperation {
    /// It stays.
    Keep,
    /// It becomes 0.
    Zero,
    /// It becomes the reference.
    Replace,
    /// Its bits are turned round.
    Invert,
    /// One more, at most 255.
    Increment,
    /// One less, at least 0.
    Decrement,
    /// One more; 0 follows 255.
    IncrementWrap,
    /// One less; 255 follows 0.
    DecrementWrap,
}

impl StencilOperation {
    /// The names used in pipeline files.
    pub const NAMES: [(&'static str, Self); 8] = [
        ("keep", Self::Keep),
        ("zero", Self::Zero),
        ("replace", Self::Replace),
        ("invert", Self::Invert),
        ("increment", Self::Increment),
        ("decrement", Self::Decrement),
        ("increment_wrap", Self::IncrementWrap),
        ("decrement_wrap", Self::DecrementWrap),
    ];
}

/// What the stencil buffer holds when its pass begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StencilClear {
    /// What earlier passes left.
    Keep,
    /// A constant, 0 to 255.
    To(u8),
}

/// How a pass tests and writes stencil, the same for front and back faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Stencil {
    /// Where it was declared.
    pub at: Place,
    /// What it holds at the beginning.
    pub load: StencilClear,
    /// The test of the reference against the stored value.
    pub compare: Compare,
    /// 0 to 255.
    pub reference: u8,
    /// Where the stencil test fails.
    pub fail: StencilOperation,
    /// Where the stencil test passes and the depth test fails.
    pub depth_fail: StencilOperation,
    /// Where both pass.
    pub pass: StencilOperation,
    /// Bits that are compared.
    pub read_mask: u8,
    /// Bits that are written.
    pub write_mask: u8,
}

impl Stencil {
    /// No test and no change.
    pub fn new(at: Place) -> Self {
        Self {
            at,
            load: StencilClear::Keep,
            compare: Compare::Always,
            reference: 0,
            fail: StencilOperation::Keep,
            depth_fail: StencilOperation::Keep,
            pass: StencilOperation::Keep,
            read_mask: 0xff,
            write_mask: 0xff,
        }
    }

    /// Whether it can change anything.
    pub fn writes(&self) -> bool {
        let keeps = [self.fail, self.depth_fail, self.pass]
            .iter()
            .all(|operation| *operation == StencilOperation::Keep);
        self.load != StencilClear::Keep || (!keeps && self.write_mask != 0)
    }
}

/// The depth target of a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthAttachment {
    /// The target's name.
    pub target: String,
    /// Where it was named.
    pub at: Place,
    /// Which layer; depth targets have no mips.
    pub slice: Slice,
    /// What it holds at the beginning. The far plane is 0.
    pub load: Load,
    /// Whether what the pass wrote is kept.
    pub store: bool,
    /// The test. A `lights` pass chooses its own by light.
    pub compare: Compare,
    /// Whether fragments write their depth.
    pub write: bool,
    /// Offset of depth in units of its resolution and per unit of slope, towards the camera if
    /// positive; for shadow maps and decals.
    pub bias: (i32, f32),
    /// The stencil buffer in the same target. A `lights` pass with a stencil technique uses its own.
    pub stencil: Option<Stencil>,
}

impl DepthAttachment {
    /// A target that nearer fragments pass and write.
    pub fn new(target: impl Into<String>, at: Place) -> Self {
        Self {
            target: target.into(),
            at,
            slice: Slice::default(),
            load: Load::Keep,
            store: true,
            compare: Compare::Nearer,
            write: true,
            bias: (0, 0.0),
            stencil: None,
        }
    }
}
