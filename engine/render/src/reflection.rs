//! What a composed shader asks for: entry points, variables, parameters.

mod entry;
mod variable;

use std::collections::BTreeSet;

use naga::{ScalarKind, ShaderStage};

use crate::description::{Shape, TargetDesc};
use crate::problem::Place;
use crate::shader::{Shader, undecorate};

pub use entry::{EntryPoint, NumberType, Varying};
pub use variable::{BindingKind, ParameterMember, Variable};

/// The kind of numbers in a texture or a fragment output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SampleKind {
    /// Floats and normalised integers.
    Float,
    /// Unsigned integers.
    Uint,
    /// Signed integers.
    Sint,
    /// Depth.
    Depth,
}

impl SampleKind {
    /// What a texture format holds when it is bound for reading.
    pub fn of_format(format: wgpu::TextureFormat) -> Self {
        if format.has_depth_aspect() {
            return Self::Depth;
        }
        match format.sample_type(None, None) {
            Some(wgpu::TextureSampleType::Uint) => Self::Uint,
            Some(wgpu::TextureSampleType::Sint) => Self::Sint,
            _ => Self::Float,
        }
    }

    /// In words, for messages.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Float => "floats",
            Self::Uint => "unsigned integers",
            Self::Sint => "signed integers",
            Self::Depth => "depth",
        }
    }
}

/// The type of a texture variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextureType {
    /// What its texels are.
    pub kind: SampleKind,
    /// How they are arranged.
    pub dimension: wgpu::TextureViewDimension,
    /// Whether each texel has several samples.
    pub multisampled: bool,
}

impl TextureType {
    /// The type by which a shader reads a target, or one of its layers.
    pub fn of_target(target: &TargetDesc, one_layer: bool) -> Self {
        Self {
            kind: SampleKind::of_format(target.format.0),
            dimension: match target.shape {
                _ if one_layer => wgpu::TextureViewDimension::D2,
                Shape::Flat => wgpu::TextureViewDimension::D2,
                Shape::Array(_) => wgpu::TextureViewDimension::D2Array,
                Shape::Cube => wgpu::TextureViewDimension::Cube,
                Shape::Volume(_) => wgpu::TextureViewDimension::D3,
            },
            multisampled: target.samples > 1,
        }
    }

    /// As WGSL writes it: `texture_2d<f32>`.
    pub fn in_wgsl(self) -> String {
        let arranged = match self.dimension {
            wgpu::TextureViewDimension::D1 => "1d",
            wgpu::TextureViewDimension::D2 => "2d",
            wgpu::TextureViewDimension::D2Array => "2d_array",
            wgpu::TextureViewDimension::Cube => "cube",
            wgpu::TextureViewDimension::CubeArray => "cube_array",
            wgpu::TextureViewDimension::D3 => "3d",
        };
        let samples = if self.multisampled {
            "multisampled_"
        } else {
            ""
        };
        match self.kind {
            SampleKind::Depth => format!("texture_depth_{samples}{arranged}"),
            SampleKind::Float => format!("texture_{samples}{arranged}<f32>"),
            SampleKind::Uint => format!("texture_{samples}{arranged}<u32>"),
            SampleKind::Sint => format!("texture_{samples}{arranged}<i32>"),
        }
    }
}

/// A constant that is given its value when a pipeline is built.
#[derive(Clone, Debug, PartialEq)]
pub struct OverrideConstant {
    /// Its name.
    pub name: String,
    /// Where it is declared.
    pub at: Place,
    /// Whether it has a value of its own.
    pub has_value: bool,
}

/// Everything that a pass must know of its shader.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reflection {
    /// Whether there is a `vertex_main`.
    pub has_vertex: bool,
    /// Whether there is a `fragment_main`.
    pub has_fragment: bool,
    /// The workgroup size of `compute_main`, if there is one.
    pub workgroup_size: Option<[u32; 3]>,
    /// Locations that `vertex_main` reads.
    pub vertex_inputs: BTreeSet<u32>,
    /// All entry points, whatever their names.
    pub entry_points: Vec<EntryPoint>,
    /// All variables that are bound, by group and binding.
    pub variables: Vec<Variable>,
    /// Members of `@group(2) @binding(0) var<uniform> parameters`, and the structure's size.
    pub parameters: Option<(Vec<ParameterMember>, u32)>,
    /// Override constants.
    pub overrides: Vec<OverrideConstant>,
}

/// The entry points that every pass uses.
pub const VERTEX_ENTRY: &str = "vertex_main";
/// See [`VERTEX_ENTRY`].
pub const FRAGMENT_ENTRY: &str = "fragment_main";
/// See [`VERTEX_ENTRY`].
pub const COMPUTE_ENTRY: &str = "compute_main";

impl Reflection {
    /// The entry point of that name and stage.
    pub fn entry(&self, name: &str, stage: ShaderStage) -> Option<&EntryPoint> {
        let mut entries = self.entry_points.iter();
        entries.find(|entry| entry.name == name && entry.stage == stage)
    }

    /// The variable at a group and binding.
    pub fn variable(&self, group: u32, binding: u32) -> Option<&Variable> {
        let mut variables = self.variables.iter();
        variables.find(|variable| (variable.group, variable.binding) == (group, binding))
    }

    /// Adds what another variant of the same shader asks for beyond this one.
    ///
    /// # Errors
    /// A variable of the other variant that is bound where this one binds something else.
    pub fn add_variant(&mut self, other: &Self) -> Result<(), Place> {
        for theirs in &other.variables {
            let at = (theirs.group, theirs.binding);
            let mut own = self.variables.iter_mut();
            match own.find(|own| (own.group, own.binding) == at) {
                None => self.variables.push(theirs.clone()),
                Some(own) if (&own.name, &own.kind) == (&theirs.name, &theirs.kind) => {
                    own.bytes = own.bytes.max(theirs.bytes);
                }
                Some(_) => return Err(theirs.at.clone()),
            }
        }
        self.variables
            .sort_by_key(|variable| (variable.group, variable.binding));
        match (&self.parameters, &other.parameters) {
            (None, theirs) => self.parameters = theirs.clone(),
            (Some((own, size)), Some((theirs, other_size))) => {
                let alike = |(own, theirs): (&ParameterMember, &ParameterMember)| {
                    (&own.name, own.offset, own.kind) == (&theirs.name, theirs.offset, theirs.kind)
                };
                let mut pairs = own.iter().zip(theirs);
                if own.len() != theirs.len() || size != other_size || !pairs.all(alike) {
                    let different = theirs.iter().zip(own).find(|(a, b)| !alike((b, a)));
                    let place = different.map(|(theirs, _)| theirs).or(theirs.last());
                    return Err(place.map(|member| member.at.clone()).unwrap_or_default());
                }
            }
            (Some(_), None) => {}
        }
        for theirs in &other.entry_points {
            let mut own = self.entry_points.iter_mut();
            if let Some(own) = own.find(|own| own.stage == theirs.stage) {
                own.samples.extend(&theirs.samples);
            }
        }
        Ok(())
    }

    /// What the pipeline provides: targets, buffers and samplers.
    pub fn targets(&self) -> impl Iterator<Item = &Variable> {
        self.variables.iter().filter(|variable| variable.group == 1)
    }
}

/// Looks through a shader.
pub fn reflect(shader: &Shader) -> Reflection {
    let Shader {
        module, listings, ..
    } = shader;
    let entry_points = entry::entry_points(shader);
    let mut variables = variable::variables(module, listings);
    variables.sort_by_key(|variable| (variable.group, variable.binding));
    let overrides = module.overrides.iter().map(|(_, constant)| {
        let name = constant.name.as_deref().unwrap_or_default();
        OverrideConstant {
            name: undecorate(name),
            at: listings.override_constant(name),
            has_value: constant.init.is_some(),
        }
    });
    let mut reflection = Reflection {
        entry_points,
        variables,
        parameters: variable::parameters(module, listings),
        overrides: overrides.collect(),
        ..Reflection::default()
    };
    reflection.has_fragment = reflection
        .entry(FRAGMENT_ENTRY, ShaderStage::Fragment)
        .is_some();
    let compute = reflection.entry(COMPUTE_ENTRY, ShaderStage::Compute);
    reflection.workgroup_size = compute.map(|entry| entry.workgroup_size);
    if let Some(vertex) = reflection.entry(VERTEX_ENTRY, ShaderStage::Vertex) {
        reflection.vertex_inputs = vertex.inputs.iter().map(|input| input.location).collect();
        reflection.has_vertex = true;
    }
    reflection
}

fn scalar_kind(kind: ScalarKind) -> Option<SampleKind> {
    match kind {
        ScalarKind::Float => Some(SampleKind::Float),
        ScalarKind::Uint => Some(SampleKind::Uint),
        ScalarKind::Sint => Some(SampleKind::Sint),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
