//! What a pipeline is: targets, buffers and passes as plain data.
//!
//! A pipeline file builds a [`PipelineDesc`], one call per target, pass and binding, so that each
//! part knows the line that declared it. Nothing here touches the GPU: `validate` checks
//! a description, `Compiler` turns it into something that draws.

mod attachment;
mod blend;
mod parameter;
mod pass;
mod resource;
mod shadow;

pub use attachment::{
    ColorAttachment, Compare, DepthAttachment, Load, Stencil, StencilClear, StencilOperation,
};
pub use blend::{Blend, BlendFactor, BlendOperation, BlendPart, ColorMask};
pub use parameter::{Parameter, ParameterKind, ParameterValue};
pub use pass::{
    Amount, Define, Dispatch, DrawList, DrawOrder, Faces, Geometry, LightStencil, Lights,
    MAX_LAYERS, ObjectLights, PassDesc, PassKind, Read, Reduction, Repeat, ShaderDesc, Update,
};
pub use resource::{BufferDesc, BufferSize, Mips, Shape, Slice, TargetDesc, TargetSize};
pub use shadow::{GivenView, Lens, Shadow, ShadowLights, ShadowViews};

use lightbench_assets::{ReflectionModel, ReflectionModels};

use crate::problem::Place;

/// A name that somebody wrote, with where it was written.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// The name.
    pub name: String,
    /// Where it was written.
    pub at: Place,
}

/// A number that the GPU counts into a buffer and the program reads back, as "lights that did not
/// fit into their list".
#[derive(Clone, Debug, PartialEq)]
pub struct Counter {
    /// Name, unique in the pipeline.
    pub name: String,
    /// Where it was declared.
    pub at: Place,
    /// What it counts, for people.
    pub description: String,
    /// The buffer that holds it.
    pub buffer: String,
    /// Which 32-bit word of the buffer.
    pub word: u32,
}

/// Something that a pipeline can do or can't, and how or why: "transparency", "sorted, drawn
/// forward afterwards".
#[derive(Clone, Debug, PartialEq)]
pub struct Ability {
    /// What it is about, as in `msaa`.
    pub name: String,
    /// Where it was declared.
    pub at: Place,
    /// Whether the pipeline can do it.
    pub supported: bool,
    /// By which means; or why not.
    pub text: String,
}

impl Ability {
    /// The name of the reflection model that it is about: `ggx` in `brdf_ggx`.
    pub fn reflection_model(&self) -> Option<&str> {
        self.name.strip_prefix("brdf_")
    }
}

/// A whole pipeline.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PipelineDesc {
    /// Short name: the file's name without its extension, as in `deferred_shading`.
    pub name: String,
    /// The file that declared it.
    pub file: Place,
    /// Paths of that file and of all that it imports.
    pub scripts: Vec<String>,
    /// Title for people, as in "Deferred shading".
    pub title: String,
    /// One or two sentences: what it trades and when to choose it.
    pub description: String,
    /// What can be set from outside, in the order of declaration.
    pub parameters: Vec<Parameter>,
    /// The textures that passes write.
    pub targets: Vec<TargetDesc>,
    /// The buffers that passes write.
    pub buffers: Vec<BufferDesc>,
    /// The passes, in the order in which they run.
    pub passes: Vec<PassDesc>,
    /// Numbers to read back.
    pub counters: Vec<Counter>,
    /// What it can do and what not.
    pub abilities: Vec<Ability>,
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

    /// The buffer of that name.
    pub fn buffer(&self, name: &str) -> Option<&BufferDesc> {
        self.buffers.iter().find(|buffer| buffer.name == name)
    }

    /// The parameter of that name.
    pub fn parameter(&self, name: &str) -> Option<&Parameter> {
        self.parameters
            .iter()
            .find(|parameter| parameter.name == name)
    }

    /// What the pipeline says of an ability.
    pub fn ability(&self, name: &str) -> Option<&Ability> {
        self.abilities.iter().find(|ability| ability.name == name)
    }

    /// The reflection models that the pipeline says it carries, by abilities such as `brdf_ggx`.
    /// Those that it says nothing of it does not carry, since its buffers may have no room for them.
    pub fn reflection_models(&self) -> ReflectionModels {
        let supported = self.abilities.iter().filter(|ability| ability.supported);
        let names = supported.filter_map(Ability::reflection_model);
        names
            .filter_map(ReflectionModel::from_name)
            .fold(ReflectionModels::default(), ReflectionModels::with)
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
