//! Passes: what they draw, with which shader, from what, into what.

use super::{ColorAttachment, DepthAttachment, Shadow, ShadowViews, Slice};
use crate::problem::Place;

/// A target or buffer that a pass's shader reads.
#[derive(Clone, Debug, PartialEq)]
pub struct Read {
    /// The name of the target or buffer.
    pub target: String,
    /// The shader's variable; the target's name unless the pipeline says otherwise.
    pub variable: String,
    /// Where it was named.
    pub at: Place,
    /// One mip level alone.
    pub mip: Option<u32>,
    /// One layer alone, as a 2D texture.
    pub layer: Option<u32>,
}

impl Read {
    /// All of a target, under its own name.
    pub fn new(target: impl Into<String>, at: Place) -> Self {
        let target = target.into();
        Self {
            variable: target.clone(),
            target,
            at,
            mip: None,
            layer: None,
        }
    }
}

/// A buffer or storage texture that a pass's shader writes wherever it likes.
#[derive(Clone, Debug, PartialEq)]
pub struct Update {
    /// The name of the target or buffer.
    pub target: String,
    /// The shader's variable; the target's name unless the pipeline says otherwise.
    pub variable: String,
    /// Where it was named.
    pub at: Place,
    /// Which mip level of a texture; and its layer, where `one_layer`.
    pub slice: Slice,
    /// Only that layer, as a 2D texture.
    pub one_layer: bool,
}

/// The value of a define: `#ifdef NAME` is true, and `#{NAME}` stands for the value.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Define {
    /// The name.
    pub name: String,
    /// A whole number, or none for a define that is only there.
    pub value: Option<i32>,
}

impl Define {
    /// A define that is only there.
    pub fn flag(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            value: None,
        }
    }
}

/// A shader file and the defines that choose its variant.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaderDesc {
    /// Path from the project's root, as in `shaders/output.wgsl`.
    pub path: String,
    /// Where it was named.
    pub at: Place,
    /// Defines, in the order of declaration.
    pub defines: Vec<Define>,
}

/// Which objects a geometry pass draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DrawList {
    /// Everything visible that hides what is behind it.
    #[default]
    Opaque,
    /// Everything visible that lets light through: materials with an opacity below 1.
    Transparent,
    /// Everything visible.
    All,
    /// Everything that hides what is behind it, whether the camera sees it or not.
    Casters,
}

impl DrawList {
    /// The names used in pipeline files.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("opaque", Self::Opaque),
        ("transparent", Self::Transparent),
        ("all", Self::All),
        ("casters", Self::Casters),
    ];
}

/// In which order a geometry pass draws its objects.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DrawOrder {
    /// By pipeline variant and mesh, so that equal meshes share an instanced draw.
    #[default]
    State,
    /// Nearest first, so that hidden fragments fail the depth test early.
    FrontToBack,
    /// Farthest first, as blending needs it.
    BackToFront,
}

impl DrawOrder {
    /// The names used in pipeline files.
    pub const NAMES: [(&'static str, Self); 3] = [
        ("state", Self::State),
        ("front_to_back", Self::FrontToBack),
        ("back_to_front", Self::BackToFront),
    ];
}

/// Which lights each object's list (`object_lights` in the shader) holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ObjectLights {
    /// All of the scene.
    #[default]
    All,
    /// Those whose range reaches the object's bounds, and those without a range.
    Gathered,
    /// Ambient lights only: the first pass of a multi-pass pipeline.
    Ambient,
    /// None.
    Nothing,
}

impl ObjectLights {
    /// The names used in pipeline files.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("all", Self::All),
        ("gathered", Self::Gathered),
        ("ambient", Self::Ambient),
        ("nothing", Self::Nothing),
    ];
}

/// Draws the pass's objects again for each group of lights other than ambient ones; an object is
/// drawn for a group only if a light of the group reaches its bounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Repeat {
    /// Lights in a group, at least 1.
    pub lights: u32,
    /// Limit each group to the rectangle of the screen that its lights can reach.
    pub scissor: bool,
    /// Limit each group to the pixels inside its lights' volumes, by stencil. Needs a
    /// depth target with stencil, and one light a group.
    pub stencil: bool,
}

/// Which faces a geometry pass draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Faces {
    /// Front faces, and both of two-sided materials.
    #[default]
    Material,
    /// Front faces only.
    Front,
    /// Back faces only.
    Back,
    /// Both.
    Both,
}

impl Faces {
    /// The names used in pipeline files.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("material", Self::Material),
        ("front", Self::Front),
        ("back", Self::Back),
        ("both", Self::Both),
    ];
}

/// The most layers that a geometry pass can spread its objects over.
pub const MAX_LAYERS: usize = 16;

/// What a geometry pass draws.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Geometry {
    /// Which objects.
    pub list: DrawList,
    /// In which order.
    pub order: DrawOrder,
    /// Which lights their lists hold.
    pub lights: ObjectLights,
    /// Once for each group of lights, instead of once.
    pub repeat: Option<Repeat>,
    /// Which faces.
    pub faces: Faces,
    /// Draw without vertex and index buffers: the shader brings its own vertex stage, which gets as
    /// `vertex_index` 0, 1, 2, … up to three for each triangle, and fetches the vertex from the
    /// engine's buffers. So it knows which triangle a fragment belongs to.
    pub pull_vertices: bool,
    /// Spread the objects over that many layers, at most [`MAX_LAYERS`], such that those that
    /// overlap on the screen are in different ones as far as there are enough. Shaders find an
    /// object's layer, from 0, in `drawn_objects`. 0 chooses none.
    pub layers: u32,
}

/// How a `lights` pass finds the pixels inside a volume.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LightStencil {
    /// By one depth test against the volume's back or front faces; the shader's distance test does
    /// the rest.
    #[default]
    Off,
    /// Back faces behind the scene mark pixels, then front faces before it shade the marked ones
    /// (Hargreaves and Harris 2004, "6800 Leagues Under the Sea: Deferred Shading").
    TwoPass,
    /// Front faces behind the scene mark pixels, then back faces behind the scene shade those not
    /// marked: needs no special case for a camera inside.
    Inverse,
}

impl LightStencil {
    /// The names used in pipeline files.
    pub const NAMES: [(&'static str, Self); 3] = [
        ("off", Self::Off),
        ("two_pass", Self::TwoPass),
        ("inverse", Self::Inverse),
    ];
}

/// What a `lights` pass draws: the volume of each light, a sphere for points and wide spots, a cone
/// for narrow spots, the light's own clip volume where it has one, the whole screen for directional
/// and ambient lights.
#[derive(Clone, Debug, PartialEq)]
pub struct Lights {
    /// Draw bounded volumes; when false every light covers the whole screen.
    pub volumes: bool,
    /// Draw only what is inside: how.
    pub stencil: LightStencil,
    /// Lights whose angular diameter is below this share of the vertical field of view are drawn
    /// without stencil, since they cost more in state changes than they save.
    pub threshold: f32,
    /// Spread the lights over that many arrays of lights that do not overlap; array n writes
    /// channel n mod 4 of colour target n / 4 alone. 0 draws all lights to all channels.
    ///
    /// Lights do not overlap whose ranges have no point in common: the shader leaves out surfaces
    /// outside the light's range. With `any_depth` it is the rectangles around them on the screen
    /// that have none.
    pub arrays: u32,
    /// Leave out ambient and directional lights.
    pub bounded_only: bool,
    /// Ignore depth: cover every pixel through which the light can be seen at any depth.
    pub any_depth: bool,
}

impl Default for Lights {
    fn default() -> Self {
        Self {
            volumes: true,
            stencil: LightStencil::Off,
            threshold: 0.2,
            arrays: 0,
            bounded_only: false,
            any_depth: false,
        }
    }
}

/// How much a compute pass does.
#[derive(Clone, Debug, PartialEq)]
pub enum Amount {
    /// One for each texel of the target's mip level.
    Texels {
        /// The target.
        target: String,
        /// Its mip level.
        mip: u32,
    },
    /// One for each tile of that many by that many pixels of the output, and `depth` of them one
    /// behind the other.
    Tiles {
        /// Side of a tile, pixels.
        tile: u32,
        /// How many along z.
        depth: u32,
    },
    /// One for each light of the scene.
    Lights,
    /// That many along x, y and z.
    Fixed(u32, u32, u32),
}

/// How a compute pass is dispatched.
#[derive(Clone, Debug, PartialEq)]
pub enum Dispatch {
    /// So many invocations; the last workgroup may have some over.
    Threads(Amount),
    /// So many workgroups.
    Groups(Amount),
    /// Three words of a buffer say how many workgroups.
    Indirect {
        /// The buffer.
        buffer: String,
        /// The first of the words.
        word: u32,
    },
}

/// How four texels of a mip level make one of the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reduction {
    /// Their mean.
    Average,
    /// The smallest.
    Min,
    /// The largest.
    Max,
}

impl Reduction {
    /// The names used in pipeline files.
    pub const NAMES: [(&'static str, Self); 3] = [
        ("average", Self::Average),
        ("min", Self::Min),
        ("max", Self::Max),
    ];
}

/// What a pass does.
#[derive(Clone, Debug, PartialEq)]
pub enum PassKind {
    /// Draws the scene's meshes, instanced.
    Geometry(Geometry),
    /// Draws the volume of each light.
    Lights(Lights),
    /// Draws the depth of what casts shadows, from the views of lights or others.
    Shadow(Shadow),
    /// Draws one triangle over the whole target.
    Fullscreen,
    /// Runs a compute shader.
    Compute(Dispatch),
    /// Fills its targets with their clear values, and its buffers with zeros.
    Clear,
    /// Copies one target or buffer to another of the same kind and size.
    Copy {
        /// From.
        from: Read,
        /// To.
        to: Read,
    },
    /// Takes the mean of each texel's samples.
    Resolve {
        /// The target with several samples.
        from: Read,
        /// The one with one.
        to: Read,
    },
    /// Fills the smaller mip levels of a target from its largest.
    Mips {
        /// The target.
        target: Read,
        /// How.
        reduction: Reduction,
    },
    /// Keeps a target for the next frame, which reads it as another target. In the first frame,
    /// and after a change of size, that one holds zeros, and `frame.history_frames` is 0.
    History {
        /// What to keep.
        from: Read,
        /// Where the next frame finds it.
        to: Read,
    },
}

impl PassKind {
    /// The name used in pipeline files and reports.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Geometry(_) => "geometry",
            Self::Lights(_) => "lights",
            Self::Shadow(_) => "shadow",
            Self::Fullscreen => "fullscreen",
            Self::Compute(_) => "compute",
            Self::Clear => "clear",
            Self::Copy { .. } => "copy",
            Self::Resolve { .. } => "resolve",
            Self::Mips { .. } => "mips",
            Self::History { .. } => "history",
        }
    }

    /// Whether it draws through the rasteriser with a shader.
    pub fn rasterises(&self) -> bool {
        matches!(
            self,
            Self::Geometry(_) | Self::Lights(_) | Self::Shadow(_) | Self::Fullscreen
        )
    }
}

/// One pass.
#[derive(Clone, Debug, PartialEq)]
pub struct PassDesc {
    /// Name, unique in the pipeline.
    pub name: String,
    /// Where it was declared.
    pub at: Place,
    /// What it does.
    pub kind: PassKind,
    /// Its shader.
    pub shader: Option<ShaderDesc>,
    /// Targets and buffers that the shader reads.
    pub reads: Vec<Read>,
    /// Targets and buffers that the shader writes wherever it likes.
    pub updates: Vec<Update>,
    /// Targets that it draws to, in the order of the shader's outputs.
    pub colors: Vec<ColorAttachment>,
    /// Its depth target.
    pub depth: Option<DepthAttachment>,
    /// The constant of the blend factors `constant` and `one_minus_constant`.
    pub blend_constant: [f64; 4],
}

impl PassDesc {
    /// A pass without shader and attachments.
    pub fn new(name: impl Into<String>, at: Place, kind: PassKind) -> Self {
        Self {
            name: name.into(),
            at,
            kind,
            shader: None,
            reads: Vec::new(),
            updates: Vec::new(),
            colors: Vec::new(),
            depth: None,
            blend_constant: [0.0; 4],
        }
    }

    /// For passes that spread lights over arrays or layers, what [`unplaced_lights`] counts, for
    /// people.
    ///
    /// [`unplaced_lights`]: crate::PassStatistics::unplaced_lights
    pub fn unplaced_in_words(&self) -> Option<String> {
        match &self.kind {
            PassKind::Lights(lights) if lights.arrays > 0 => Some(format!(
                "Lights that no array of `{}` had room for",
                self.name
            )),
            PassKind::Shadow(shadow) => {
                let what = match shadow.views {
                    ShadowViews::Lights(_) => "Lights",
                    ShadowViews::Given(_) => "Views",
                };
                Some(format!("{what} that `{}` had no layer for", self.name))
            }
            _ => None,
        }
    }
}
