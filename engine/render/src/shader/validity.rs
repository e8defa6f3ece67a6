//! What makes a shader that reads well invalid all the same, said in words of WGSL.
//!
//! The library that checks shaders speaks of handles and of its own types. Here each of its
//! complaints that a WGSL text can cause becomes a sentence; what is left over says the least that is
//! true.

mod expressions;
mod functions;
mod stages;

use naga::AddressSpace;
use naga::common::wgsl::TypeContext as _;
use naga::valid::{
    Capabilities, ConstantError, Disalignment, GlobalVariableError, OverrideError, TypeError,
    ValidationError,
};

use super::conversion::how_to_convert;
use super::declarations::Listings;
use super::{short_types, undecorate};
use crate::problem::{Place, Problem};

/// What is known of the shader that is not valid.
pub(super) struct Context<'a> {
    /// The shader, if it could be composed at all.
    pub module: Option<&'a naga::Module>,
    pub listings: &'a Listings,
    /// Where the library saw it.
    pub place: Place,
}

/// What is wrong, the way out, and where, if that is known better than the library knows it.
struct Reason {
    message: String,
    hint: Option<String>,
    place: Option<Place>,
}

impl Reason {
    fn new(message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            hint: None,
            place: None,
        }
    }

    fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// Says how a value of one type becomes one of another, where there is a way.
    fn convert(mut self, from: &str, to: &str) -> Self {
        self.hint = how_to_convert(from, to);
        self
    }

    fn at(mut self, place: Place) -> Self {
        self.place = Some(place);
        self
    }
}

impl Context<'_> {
    /// Says what is wrong.
    pub fn explain(&self, error: &ValidationError) -> Problem {
        let reason = self.reason(error);
        let mut place = reason.place.filter(|place| place.line > 0);
        // What is missing in a function has no place of its own.
        if let ValidationError::Function { name, .. } | ValidationError::EntryPoint { name, .. } =
            error
            && place.is_none()
            && self.place.line == 0
        {
            place = Some(self.listings.function(name));
        }
        let mut problem = Problem::new(
            place.unwrap_or_else(|| self.place.clone()),
            short_types(&undecorate(&reason.message)),
        );
        problem.hint = reason.hint.map(|hint| short_types(&undecorate(&hint)));
        problem
    }

    fn reason(&self, error: &ValidationError) -> Reason {
        match error {
            ValidationError::Function { name, source, .. } => {
                let function = self.module.and_then(|module| {
                    module
                        .functions
                        .iter()
                        .find(|(_, f)| f.name.as_ref() == Some(name))
                });
                self.function(function.map(|(_, function)| function), name, source)
            }
            ValidationError::EntryPoint {
                stage,
                name,
                source,
            } => self.entry_point(*stage, name, source),
            ValidationError::GlobalVariable { name, source, .. } => {
                let place = self.listings.variable(name);
                self.global(name, source).at(place)
            }
            ValidationError::Type { name, source, .. } => {
                let place = self.listings.structure(name);
                self.ty(name, source).at(place)
            }
            ValidationError::Constant { name, source, .. } => Reason::new(match source {
                ConstantError::InitializerExprType => {
                    format!(
                        "the value of the constant `{name}` is not known before the shader runs"
                    )
                }
                ConstantError::InvalidType => {
                    format!("the value of the constant `{name}` has another type than it declares")
                }
                ConstantError::NonConstructibleType => {
                    format!("a constant can't have the type of `{name}`")
                }
            }),
            ValidationError::Override { name, source, .. } => {
                let place = self.listings.override_constant(name);
                Reason::new(match source {
                    OverrideError::DuplicateID => {
                        format!("the `@id` of `{name}` is that of another override constant")
                    }
                    OverrideError::TypeNotScalar => {
                        format!("the override constant `{name}` must be a number or a bool")
                    }
                    _ => format!("the override constant `{name}` has no valid value"),
                })
                .hint("the pipeline's .define gives values to shaders: write `const`")
                .at(place)
            }
            ValidationError::ArraySizeError { .. } => {
                Reason::new("an array needs at least one element")
            }
            ValidationError::ConstExpression { .. } => {
                Reason::new("this value can't be computed before the shader runs")
            }
            ValidationError::InvalidHandle(_)
            | ValidationError::Layouter(_)
            | ValidationError::Corrupted => {
                Reason::new("this shader uses a type that can't be laid out in memory")
            }
        }
    }

    /// The type of that handle, as WGSL writes it.
    fn type_name(&self, ty: naga::Handle<naga::Type>) -> Option<String> {
        let module = self.module?;
        Some(module.to_ctx().type_to_string(ty))
    }

    fn inner_name(&self, inner: &naga::TypeInner) -> Option<String> {
        let mut text = String::new();
        self.module?
            .to_ctx()
            .write_type_inner(inner, &mut text)
            .ok()?;
        Some(text)
    }

    fn global(&self, name: &str, error: &GlobalVariableError) -> Reason {
        use GlobalVariableError as E;
        let bound = self.module.and_then(|module| {
            let mut globals = module.global_variables.iter();
            let (_, global) = globals.find(|(_, global)| global.name.as_deref() == Some(name))?;
            Some(global.binding.is_some())
        });
        match error {
            E::InvalidBinding if bound == Some(true) => Reason::new(format!(
                "`{name}` belongs to the shader alone and takes no @group"
            ))
            .hint("drop @group and @binding, or make it `var<uniform>` or `var<storage>`"),
            E::InvalidBinding => Reason::new(format!(
                "`{name}` does not say where the pipeline binds it"
            ))
            .hint(format!(
                "write `@group(1) @binding({})` before it",
                self.free_binding(1)
            )),
            E::InvalidType(space) | E::InvalidUsage(space) => Reason::new(format!(
                "`{name}` has a type that {} can't hold",
                in_space(*space)
            )),
            E::MissingTypeFlags { .. } => Reason::new(format!(
                "`{name}` has a type that can't lie in memory like this"
            ))
            .hint(
                "buffers hold numbers, vectors, matrices, arrays and structures of them; \
                           only `var<storage>` may end in an array without a length; `bool` and \
                           textures can't be in a buffer",
            ),
            E::Alignment(_, _, Disalignment::NonHostShareable) => Reason::new(format!(
                "`{name}` holds a `bool`, which can't lie in memory"
            ))
            .hint("declare it as `u32`, 0 or 1; that is how a switch reaches shaders"),
            E::Alignment(..) => {
                Reason::new(format!("`{name}` is not laid out as a uniform must be")).hint(
                    "in a uniform, elements of arrays begin every 16 bytes: use `vec4f`, or \
                           `var<storage, read>`",
                )
            }
            E::InitializerExprType | E::InitializerType => {
                Reason::new(format!("the first value of `{name}` does not fit its type"))
            }
            E::InitializerNotAllowed(space) => Reason::new(format!(
                "{} can't begin with a value, as `{name}` does",
                in_space(*space)
            )),
            E::StorageAddressSpaceWriteOnlyNotSupported => {
                Reason::new(format!("`{name}` can't be written without being readable"))
                    .hint("write `var<storage, read_write>`")
            }
            E::UnsupportedCapability(wanted) => lacking(*wanted),
            E::CoherentNotSupported
            | E::VolatileNotSupported
            | E::InvalidMemoryDecorationsAddressSpace => {
                Reason::new(format!("`{name}` can't be `@coherent` or `@volatile` here"))
            }
            _ => Reason::new(format!(
                "the variable `{name}` is of a kind that pipelines don't have"
            )),
        }
    }

    fn ty(&self, name: &str, error: &TypeError) -> Reason {
        match error {
            TypeError::InvalidDynamicArray(member, _) => Reason::new(format!(
                "`{member}` of `{name}` is an array without a length"
            ))
            .hint("only the last member of a structure may be one"),
            TypeError::EmptyStruct => Reason::new(format!("the structure `{name}` has no members")),
            TypeError::MissingCapability(wanted) => lacking(*wanted),
            TypeError::InvalidAtomicWidth(..) => {
                Reason::new("atomics are `atomic<u32>` or `atomic<i32>`")
            }
            TypeError::UnsupportedImageType { .. } => {
                Reason::new("there is no such kind of texture")
            }
            TypeError::WidthError(_) => Reason::new("this adapter has no numbers of that size")
                .hint("numbers are `f32`, `i32` and `u32`"),
            _ if name.is_empty() => Reason::new("this type can't exist"),
            _ => Reason::new(format!("the type `{name}` can't exist")),
        }
    }
}

/// "a uniform", for messages.
fn in_space(space: AddressSpace) -> &'static str {
    match space {
        AddressSpace::Uniform => "a uniform",
        AddressSpace::Storage { .. } => "a storage buffer",
        AddressSpace::WorkGroup => "workgroup memory",
        AddressSpace::Handle => "a variable of a texture or sampler",
        _ => "a variable of this kind",
    }
}

/// An optional part of WGSL that the device does not have.
fn lacking(wanted: Capabilities) -> Reason {
    let what = [
        (Capabilities::FLOAT64, "numbers of 64 bits"),
        (Capabilities::SHADER_FLOAT16, "numbers of 16 bits (`f16`)"),
        (Capabilities::SHADER_INT64, "whole numbers of 64 bits"),
        (Capabilities::PRIMITIVE_INDEX, "`@builtin(primitive_index)`"),
        (Capabilities::MULTISAMPLED_SHADING, "shading by sample"),
        (Capabilities::CLIP_DISTANCES, "clip distances"),
        (Capabilities::SUBGROUP, "operations of subgroups"),
        (Capabilities::TEXTURE_ATOMIC, "atomics on textures"),
        (Capabilities::SHADER_FLOAT32_ATOMIC, "atomics on `f32`"),
        (
            Capabilities::DUAL_SOURCE_BLENDING,
            "blending with two sources",
        ),
        (Capabilities::IMMEDIATES, "immediate data"),
        (Capabilities::RAY_QUERY, "ray queries"),
        (Capabilities::CUBE_ARRAY_TEXTURES, "arrays of cube textures"),
        (
            Capabilities::STORAGE_TEXTURE_16BIT_NORM_FORMATS,
            "storage textures of that format",
        ),
    ];
    let found = what
        .iter()
        .find(|(capability, _)| wanted.contains(*capability));
    let what = found.map_or("this part of WGSL", |(_, what)| *what);
    Reason::new(format!("shaders on this device can't use {what}"))
}
