//! What a pipeline is: targets and passes as plain data.
//!
//! A pipeline file builds a [`PipelineDesc`], one call per target, pass and binding, so that each
//! part knows the line that declared it. Nothing here touches the GPU: `validate` checks
//! a description, `Compiler` turns it into something that draws.

use crate::format::Format;
use crate::problem::Place;

/// A name that somebody wrote, with where it was written.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// The name.
    pub name: String,
    /// Where it was written.
    pub at: Place,
}

/// A whole pipeline.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PipelineDesc {
    /// Short name: the file's name without its extension, as in `deferred_shading`.
    pub name: String,
    /// The file that declared it.
    pub file: Place,
    /// Title for people, as in "Deferred shading".
    pub title: String,
    /// One or two sentences: what it trades and when to choose it.
    pub description: String,
    /// What can be set from outside, in the order of declaration.
    pub parameters: Vec<Parameter>,
    /// The render targets.
    pub targets: Vec<TargetDesc>,
    /// The passes, in the order in which they run.
    pub passes: Vec<PassDesc>,
    /// The linear HDR target before exposure and tone curve, for EXR files and HDR metrics.
    pub hdr: Option<Named>,
    /// The display-ready target that the viewport and PNG files show.
    pub output: Option<Named>,
}

impl PipelineDesc {
    /// The target of that name.
    pub fn target(&self, name: &str) -> Option<&TargetDesc> {
        self.targets.iter().find(|target| target.name == name)
    }

    /// The parameter of that name.
    pub fn parameter(&self, name: &str) -> Option<&Parameter> {
        self.parameters
            .iter()
            .find(|parameter| parameter.name == name)
    }

    /// Whether two descriptions differ in nothing but the values of their parameters, so that
    /// what was compiled for one serves the other.
    pub fn same_structure(&self, other: &Self) -> bool {
        let strip = |desc: &Self| {
            let mut desc = desc.clone();
            for parameter in &mut desc.parameters {
                parameter.value = parameter.default.clone();
            }
            desc
        };
        strip(self) == strip(other)
    }
}

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum ParameterValue {
    /// A number, inside the declared range.
    Number(f64),
    /// A switch.
    Switch(bool),
    /// One of the declared choices, by name.
    Choice(String),
}

impl std::fmt::Display for ParameterValue {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Switch(on) => write!(f, "{}", if *on { "on" } else { "off" }),
            Self::Choice(choice) => write!(f, "{choice}"),
        }
    }
}

/// What kind of value a parameter takes.
#[derive(Clone, Debug, PartialEq)]
pub enum ParameterKind {
    /// A number in an inclusive range. Reaches shaders as `f32`.
    Number {
        /// Smallest value allowed.
        min: f64,
        /// Largest value allowed.
        max: f64,
    },
    /// On or off. Reaches shaders as `u32`, 0 or 1.
    Switch,
    /// One of several names. Reaches shaders as `u32`, the index in this list.
    Choice {
        /// The names, at least one.
        options: Vec<String>,
    },
}

/// Something that the command line, a script or the editor can set on a pipeline.
///
/// A shader sees it as the member of the same name of its `parameters` uniform.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name, as in `exposure`.
    pub name: String,
    /// Where it was declared.
    pub at: Place,
    /// What it does, in a sentence.
    pub description: String,
    /// Unit for people, as in "EV"; empty for none.
    pub unit: String,
    /// What values it takes.
    pub kind: ParameterKind,
    /// The value when nobody sets one.
    pub default: ParameterValue,
    /// The value in force.
    pub value: ParameterValue,
}

impl Parameter {
    /// Reads a value from text, as the command line gives it, and checks it against the kind.
    ///
    /// # Errors
    /// A sentence that says which values are accepted.
    pub fn parse(&self, text: &str) -> Result<ParameterValue, String> {
        let text = text.trim();
        match &self.kind {
            ParameterKind::Number { min, max } => match text.parse::<f64>() {
                Ok(number) if number >= *min && number <= *max => {
                    Ok(ParameterValue::Number(number))
                }
                _ => Err(format!(
                    "`{}` takes a number from {min} to {max}, not `{text}`",
                    self.name
                )),
            },
            ParameterKind::Switch => match text {
                "on" | "true" | "1" | "yes" => Ok(ParameterValue::Switch(true)),
                "off" | "false" | "0" | "no" => Ok(ParameterValue::Switch(false)),
                _ => Err(format!("`{}` takes `on` or `off`, not `{text}`", self.name)),
            },
            ParameterKind::Choice { options } => {
                if options.iter().any(|option| option == text) {
                    Ok(ParameterValue::Choice(text.to_owned()))
                } else {
                    let list = options
                        .iter()
                        .map(|o| format!("`{o}`"))
                        .collect::<Vec<_>>()
                        .join(", ");
                    Err(format!("`{}` takes one of {list}, not `{text}`", self.name))
                }
            }
        }
    }

    /// The number that shaders see: the number itself, 0 or 1, or the index of the choice.
    pub fn shader_value(&self) -> f64 {
        match (&self.value, &self.kind) {
            (ParameterValue::Number(number), _) => *number,
            (ParameterValue::Switch(on), _) => f64::from(u8::from(*on)),
            (ParameterValue::Choice(choice), ParameterKind::Choice { options }) => options
                .iter()
                .position(|option| option == choice)
                .unwrap_or(0)
                as f64,
            (ParameterValue::Choice(_), _) => 0.0,
        }
    }
}

/// How large a target is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TargetSize {
    /// A factor of the output's size, rounded to the nearest texel and at least 1 × 1.
    Relative(f32),
    /// A fixed size in texels.
    Absolute(u32, u32),
}

impl TargetSize {
    /// The size in texels for an output of `width` × `height`.
    pub fn resolve(self, width: u32, height: u32) -> (u32, u32) {
        let scaled = |length: u32, factor: f32| ((length as f32 * factor).round() as u32).max(1);
        match self {
            Self::Relative(factor) => (scaled(width, factor), scaled(height, factor)),
            Self::Absolute(width, height) => (width.max(1), height.max(1)),
        }
    }
}

/// A texture that passes write and read.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetDesc {
    /// Name, as in `g_normal`; shaders read it by this name.
    pub name: String,
    /// Where it was declared.
    pub at: Place,
    /// Texel format.
    pub format: Format,
    /// Size.
    pub size: TargetSize,
}

/// What an attachment holds when its pass begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Load {
    /// What earlier passes left.
    Keep,
    /// A constant: r, g, b, a for colour; the first value for depth.
    Clear([f64; 4]),
}

/// How new values combine with those in a colour target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Blend {
    /// New values replace old ones.
    Replace,
    /// New values are added: light accumulation.
    Add,
    /// `source · α + destination · (1 − α)`.
    Over,
}

impl Blend {
    /// The names used in pipeline files.
    pub const NAMES: [(&'static str, Self); 3] = [
        ("replace", Self::Replace),
        ("add", Self::Add),
        ("over", Self::Over),
    ];
}

/// One colour target of a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorAttachment {
    /// The target's name.
    pub target: String,
    /// Where it was named.
    pub at: Place,
    /// What it holds at the beginning.
    pub load: Load,
    /// How fragments combine with it.
    pub blend: Blend,
}

/// Which relation lets a fragment pass the depth test. Depth is reversed: 1 near, 0 far.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DepthCompare {
    /// Nearer than, or as near as, what is there (`greater_equal` under reversed depth).
    Nearer,
    /// Exactly what is there: after a depth pre-pass.
    Equal,
    /// No test.
    Always,
}

impl DepthCompare {
    /// The names used in pipeline files.
    pub const NAMES: [(&'static str, Self); 3] = [
        ("nearer", Self::Nearer),
        ("equal", Self::Equal),
        ("always", Self::Always),
    ];
}

/// The depth target of a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthAttachment {
    /// The target's name.
    pub target: String,
    /// Where it was named.
    pub at: Place,
    /// What it holds at the beginning. The far plane is 0.
    pub load: Load,
    /// The test. A `lights` pass chooses its own by light.
    pub compare: DepthCompare,
    /// Whether fragments write their depth.
    pub write: bool,
}

/// A target that a pass's shader reads.
#[derive(Clone, Debug, PartialEq)]
pub struct Read {
    /// The target's name.
    pub target: String,
    /// The shader's variable; the target's name unless the pipeline says otherwise.
    pub variable: String,
    /// Where it was named.
    pub at: Place,
}

/// A shader file and the defines that choose its variant.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaderDesc {
    /// Path from the project's root, as in `shaders/output.wgsl`.
    pub path: String,
    /// Where it was named.
    pub at: Place,
    /// Defines for `#ifdef`, in the order of declaration.
    pub defines: Vec<String>,
}

/// Which objects a geometry pass draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DrawList {
    /// Everything visible that hides what is behind it.
    Opaque,
}

impl DrawList {
    /// The names used in pipeline files.
    pub const NAMES: [(&'static str, Self); 1] = [("opaque", Self::Opaque)];
}

/// What a pass draws.
#[derive(Clone, Debug, PartialEq)]
pub enum PassKind {
    /// The scene's meshes, instanced.
    Geometry {
        /// Which objects.
        list: DrawList,
        /// Whether the engine gathers, for each object, the lights that reach its bounds
        /// (`object_lights` in the shader); otherwise each object's list is all lights.
        gather_lights: bool,
    },
    /// The volume of each light: a sphere for points and wide spots, a cone for narrow spots, the
    /// whole screen for directional and ambient lights.
    Lights {
        /// Draw bounded volumes; when false every light covers the whole screen.
        volumes: bool,
    },
    /// One triangle over the whole target.
    Fullscreen,
}

impl PassKind {
    /// The name used in pipeline files and reports.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Geometry { .. } => "geometry",
            Self::Lights { .. } => "lights",
            Self::Fullscreen => "fullscreen",
        }
    }
}

/// One pass.
#[derive(Clone, Debug, PartialEq)]
pub struct PassDesc {
    /// Name, unique in the pipeline.
    pub name: String,
    /// Where it was declared.
    pub at: Place,
    /// What it draws.
    pub kind: PassKind,
    /// Its shader.
    pub shader: Option<ShaderDesc>,
    /// Targets that the shader reads.
    pub reads: Vec<Read>,
    /// Targets that it writes, in the order of the shader's outputs.
    pub colors: Vec<ColorAttachment>,
    /// Its depth target.
    pub depth: Option<DepthAttachment>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relative_sizes_round_and_never_vanish() {
        assert_eq!(TargetSize::Relative(0.5).resolve(637, 359), (319, 180));
        assert_eq!(TargetSize::Relative(0.5).resolve(1, 1), (1, 1));
        assert_eq!(TargetSize::Absolute(0, 7).resolve(9, 9), (1, 7));
    }

    #[test]
    fn parameters_say_what_they_accept() {
        let parameter = Parameter {
            name: "curve".into(),
            at: Place::default(),
            description: String::new(),
            unit: String::new(),
            kind: ParameterKind::Choice {
                options: vec!["hable".into(), "linear".into()],
            },
            default: ParameterValue::Choice("hable".into()),
            value: ParameterValue::Choice("linear".into()),
        };
        assert_eq!(parameter.shader_value(), 1.0);
        assert_eq!(
            parameter.parse("aces"),
            Err("`curve` takes one of `hable`, `linear`, not `aces`".into())
        );
    }
}
