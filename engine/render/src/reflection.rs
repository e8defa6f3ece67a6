//! What a composed shader asks for: bindings, parameters, vertex inputs and fragment outputs.

use std::collections::BTreeSet;

use naga::{
    AddressSpace, Binding, ImageClass, ImageDimension, ScalarKind, ShaderStage, StorageAccess,
    TypeInner,
};

use crate::description::{Shape, TargetDesc};
use crate::format::Format;
use crate::shader::undecorate;

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

/// What a variable of group 1 is.
#[derive(Clone, Debug, PartialEq)]
pub enum BindingKind {
    /// A texture that is read.
    Texture(TextureType),
    /// A texture that is written, or read, without filtering.
    StorageTexture {
        /// How its texels are arranged.
        dimension: wgpu::TextureViewDimension,
        /// The format that the shader declares.
        format: Option<Format>,
        /// Read, write or both.
        access: wgpu::StorageTextureAccess,
    },
    /// A `var<storage>`.
    Buffer {
        /// Whether it is `read_write`.
        writable: bool,
    },
    /// A sampler.
    Sampler {
        /// Whether it compares depth.
        comparison: bool,
    },
    /// Something that passes can't bind; its WGSL type in words.
    Unsupported(&'static str),
}

/// A variable of group 1.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetBinding {
    /// The variable's name.
    pub name: String,
    /// Its binding number.
    pub binding: u32,
    /// What it is.
    pub kind: BindingKind,
    /// Byte offset of its declaration in the composed text, if known.
    pub span: Option<usize>,
}

/// A member of the parameter structure.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterMember {
    /// The parameter's name.
    pub name: String,
    /// Byte offset.
    pub offset: u32,
    /// `f32` or `u32`; anything else is `None`.
    pub kind: Option<SampleKind>,
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
    /// Names of all entry points, for suggestions.
    pub entry_points: Vec<String>,
    /// Locations that the vertex stage hands on, and those that the fragment stage takes.
    pub varyings: (BTreeSet<u32>, BTreeSet<u32>),
    /// Locations that the vertex stage reads.
    pub vertex_inputs: BTreeSet<u32>,
    /// Location and kind of each fragment output, by location.
    pub outputs: Vec<(u32, SampleKind)>,
    /// Group 1.
    pub bindings: Vec<TargetBinding>,
    /// Members of `@group(2) @binding(0) var<uniform> parameters`, and the structure's size.
    pub parameters: Option<(Vec<ParameterMember>, u32)>,
}

impl Reflection {
    /// Adds the bindings that another variant of the same shader has beyond these.
    pub fn add_bindings(&mut self, variant: &Self) {
        for binding in &variant.bindings {
            if !self.bindings.iter().any(|b| b.binding == binding.binding) {
                self.bindings.push(binding.clone());
            }
        }
        self.bindings.sort_by_key(|binding| binding.binding);
    }
}

/// The entry points that every pass uses.
pub const VERTEX_ENTRY: &str = "vertex_main";
/// See [`VERTEX_ENTRY`].
pub const FRAGMENT_ENTRY: &str = "fragment_main";
/// See [`VERTEX_ENTRY`].
pub const COMPUTE_ENTRY: &str = "compute_main";

/// Reads a module.
pub fn reflect(module: &naga::Module) -> Reflection {
    let mut reflection = Reflection::default();
    for entry in &module.entry_points {
        reflection.entry_points.push(entry.name.clone());
        match entry.stage {
            ShaderStage::Vertex if entry.name == VERTEX_ENTRY => {
                reflection.has_vertex = true;
                for argument in &entry.function.arguments {
                    locations(
                        module,
                        argument.ty,
                        argument.binding.as_ref(),
                        &mut |location, _| {
                            reflection.vertex_inputs.insert(location);
                        },
                    );
                }
                if let Some(result) = &entry.function.result {
                    let binding = result.binding.as_ref();
                    locations(module, result.ty, binding, &mut |location, _| {
                        reflection.varyings.0.insert(location);
                    });
                }
            }
            ShaderStage::Fragment if entry.name == FRAGMENT_ENTRY => {
                reflection.has_fragment = true;
                for argument in &entry.function.arguments {
                    let binding = argument.binding.as_ref();
                    locations(module, argument.ty, binding, &mut |location, _| {
                        reflection.varyings.1.insert(location);
                    });
                }
                if let Some(result) = &entry.function.result {
                    locations(
                        module,
                        result.ty,
                        result.binding.as_ref(),
                        &mut |location, kind| {
                            reflection.outputs.push((location, kind));
                        },
                    );
                }
                reflection.outputs.sort_by_key(|(location, _)| *location);
            }
            ShaderStage::Compute if entry.name == COMPUTE_ENTRY => {
                reflection.workgroup_size = Some(entry.workgroup_size);
            }
            _ => {}
        }
    }
    for (handle, global) in module.global_variables.iter() {
        let Some(binding) = &global.binding else {
            continue;
        };
        // Variables of imported modules have decorated names.
        let name = undecorate(global.name.as_deref().unwrap_or_default());
        let inner = &module.types[global.ty].inner;
        match (binding.group, binding.binding) {
            (1, number) => reflection.bindings.push(TargetBinding {
                name,
                binding: number,
                kind: binding_kind(inner, global.space),
                span: module
                    .global_variables
                    .get_span(handle)
                    .to_range()
                    .map(|range| range.start),
            }),
            (2, 0) => {
                if let TypeInner::Struct { members, span } = inner {
                    let members = members.iter().map(|member| ParameterMember {
                        name: member.name.clone().unwrap_or_default(),
                        offset: member.offset,
                        kind: match &module.types[member.ty].inner {
                            TypeInner::Scalar(scalar) if scalar.width == 4 => {
                                scalar_kind(scalar.kind)
                            }
                            _ => None,
                        },
                    });
                    reflection.parameters = Some((members.collect(), *span));
                }
            }
            _ => {}
        }
    }
    reflection.bindings.sort_by_key(|binding| binding.binding);
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

fn binding_kind(inner: &TypeInner, space: AddressSpace) -> BindingKind {
    match inner {
        TypeInner::Image {
            dim,
            arrayed,
            class,
        } => image_kind(*dim, *arrayed, *class),
        TypeInner::Sampler { comparison } => BindingKind::Sampler {
            comparison: *comparison,
        },
        _ => match space {
            AddressSpace::Storage { access } => BindingKind::Buffer {
                writable: access.contains(StorageAccess::STORE),
            },
            AddressSpace::Uniform => BindingKind::Unsupported("uniform buffer"),
            _ => BindingKind::Unsupported("variable of another kind"),
        },
    }
}

fn image_kind(dimension: ImageDimension, arrayed: bool, class: ImageClass) -> BindingKind {
    let dimension = match (dimension, arrayed) {
        (ImageDimension::D2, false) => wgpu::TextureViewDimension::D2,
        (ImageDimension::D2, true) => wgpu::TextureViewDimension::D2Array,
        (ImageDimension::Cube, false) => wgpu::TextureViewDimension::Cube,
        (ImageDimension::D3, _) => wgpu::TextureViewDimension::D3,
        (ImageDimension::D1, _) => return BindingKind::Unsupported("1D texture"),
        (ImageDimension::Cube, true) => return BindingKind::Unsupported("cube array"),
    };
    let texture = |kind, multisampled| {
        BindingKind::Texture(TextureType {
            kind,
            dimension,
            multisampled,
        })
    };
    match class {
        ImageClass::Sampled { kind, multi } => scalar_kind(kind).map_or(
            BindingKind::Unsupported("texture of another kind"),
            |kind| texture(kind, multi),
        ),
        ImageClass::Depth { multi } => texture(SampleKind::Depth, multi),
        ImageClass::Storage { format, access } => BindingKind::StorageTexture {
            dimension,
            // naga and wgpu give formats the same names.
            format: Format::from_rust_name(&format!("{format:?}")),
            access: match (
                access.contains(StorageAccess::LOAD),
                access.contains(StorageAccess::STORE),
            ) {
                (true, false) => wgpu::StorageTextureAccess::ReadOnly,
                (true, true) => wgpu::StorageTextureAccess::ReadWrite,
                _ => wgpu::StorageTextureAccess::WriteOnly,
            },
        },
        _ => BindingKind::Unsupported("texture of another kind"),
    }
}

/// Calls `found` for every `@location` of a type, looking into structures.
fn locations(
    module: &naga::Module,
    ty: naga::Handle<naga::Type>,
    binding: Option<&Binding>,
    found: &mut impl FnMut(u32, SampleKind),
) {
    if let Some(Binding::Location { location, .. }) = binding {
        let kind = match &module.types[ty].inner {
            TypeInner::Scalar(scalar) | TypeInner::Vector { scalar, .. } => {
                scalar_kind(scalar.kind)
            }
            _ => None,
        };
        found(*location, kind.unwrap_or(SampleKind::Float));
    } else if let TypeInner::Struct { members, .. } = &module.types[ty].inner {
        for member in members {
            locations(module, member.ty, member.binding.as_ref(), found);
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn finds_bindings_parameters_inputs_and_outputs() {
        let module = naga::front::wgsl::parse_str(
            "struct Parameters { exposure: f32, curve: u32 }
             struct Out { @location(1) b: vec2u, @location(0) a: vec4f }
             @group(1) @binding(3) var g_normal: texture_2d<u32>;
             @group(1) @binding(0) var depth: texture_depth_2d;
             @group(2) @binding(0) var<uniform> parameters: Parameters;
             @vertex fn vertex_main(@location(2) uv: vec2f) -> @builtin(position) vec4f { return vec4f(uv, 0, 1); }
             @fragment fn fragment_main() -> Out { return Out(vec2u(0), vec4f(parameters.exposure)); }",
        )
        .unwrap();
        let found = reflect(&module);
        assert_eq!(found.vertex_inputs, BTreeSet::from([2]));
        assert_eq!(
            found.outputs,
            [(0, SampleKind::Float), (1, SampleKind::Uint)]
        );
        let flat = |kind| {
            BindingKind::Texture(TextureType {
                kind,
                dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            })
        };
        let bindings: Vec<_> = found
            .bindings
            .iter()
            .map(|b| (b.name.as_str(), b.binding, &b.kind))
            .collect();
        assert_eq!(
            bindings,
            [
                ("depth", 0, &flat(SampleKind::Depth)),
                ("g_normal", 3, &flat(SampleKind::Uint)),
            ]
        );
        // What another variant asks for beside them comes in its place.
        let variant = naga::front::wgsl::parse_str(
            "@group(1) @binding(2) var<storage, read> mesh_groups: array<u32>;
             @group(1) @binding(3) var g_normal: texture_2d<u32>;",
        );
        let mut both = found.clone();
        both.add_bindings(&reflect(&variant.unwrap()));
        let numbers: Vec<u32> = both.bindings.iter().map(|b| b.binding).collect();
        assert_eq!(numbers, [0, 2, 3]);
        let (members, size) = found.parameters.unwrap();
        assert_eq!(
            (members[1].name.as_str(), members[1].offset, size),
            ("curve", 4, 8)
        );
    }
}
