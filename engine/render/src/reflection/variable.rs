//! Variables that are bound: what each is, and the members of the parameters.

use naga::{AddressSpace, ImageClass, ImageDimension, StorageAccess, TypeInner};

use super::{SampleKind, TextureType, scalar_kind};
use crate::format::Format;
use crate::problem::Place;
use crate::shader::{Listings, undecorate};

/// What a bound variable is.
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
    /// A `var<uniform>`.
    Uniform,
    /// A sampler.
    Sampler {
        /// Whether it compares depth.
        comparison: bool,
    },
    /// Something that pipelines can't bind; its WGSL type in words.
    Unsupported(&'static str),
}

/// A variable with `@group` and `@binding`.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Where it is declared.
    pub at: Place,
    /// Its group.
    pub group: u32,
    /// Its binding number.
    pub binding: u32,
    /// What it is.
    pub kind: BindingKind,
    /// Bytes that a buffer needs at least, with one element of an array without a length.
    pub bytes: u64,
}

/// A member of the parameter structure.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterMember {
    /// The parameter's name.
    pub name: String,
    /// Where it is declared.
    pub at: Place,
    /// Byte offset.
    pub offset: u32,
    /// `f32` or `u32`; anything else is `None`.
    pub kind: Option<SampleKind>,
}

/// All variables that are bound.
pub(super) fn variables(module: &naga::Module, listings: &Listings) -> Vec<Variable> {
    let read = |(_, global): (_, &naga::GlobalVariable)| {
        let binding = global.binding?;
        let inner = &module.types[global.ty].inner;
        // Variables of imported modules have decorated names.
        let name = global.name.as_deref().unwrap_or_default();
        Some(Variable {
            name: undecorate(name),
            at: listings.variable(name),
            group: binding.group,
            binding: binding.binding,
            kind: binding_kind(inner, global.space),
            bytes: u64::from(inner.size(module.to_ctx())),
        })
    };
    module.global_variables.iter().filter_map(read).collect()
}

/// The members of the structure at group 2, binding 0, and its size.
pub(super) fn parameters(
    module: &naga::Module,
    listings: &Listings,
) -> Option<(Vec<ParameterMember>, u32)> {
    let mut globals = module.global_variables.iter();
    let (_, global) = globals.find(|(_, global)| {
        let binding = global.binding.as_ref();
        binding.is_some_and(|binding| (binding.group, binding.binding) == (2, 0))
    })?;
    let ty = &module.types[global.ty];
    let TypeInner::Struct { members, span } = &ty.inner else {
        return None;
    };
    let structure = ty.name.as_deref().unwrap_or_default();
    let members = members.iter().map(|member| {
        let name = member.name.clone().unwrap_or_default();
        ParameterMember {
            at: listings.member(structure, &name),
            offset: member.offset,
            kind: match &module.types[member.ty].inner {
                TypeInner::Scalar(scalar) if scalar.width == 4 => scalar_kind(scalar.kind),
                _ => None,
            },
            name,
        }
    });
    Some((members.collect(), *span))
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
        TypeInner::BindingArray { .. } => BindingKind::Unsupported("array of bindings"),
        _ => match space {
            AddressSpace::Storage { access } => BindingKind::Buffer {
                writable: access.contains(StorageAccess::STORE),
            },
            AddressSpace::Uniform => BindingKind::Uniform,
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
