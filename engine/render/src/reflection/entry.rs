//! Entry points: what goes into each, what comes out of it, and what it uses.

use std::collections::BTreeSet;
use std::fmt;

use naga::proc::Layouter;
use naga::{
    AddressSpace, Binding, BuiltIn, Handle, Interpolation, Sampling, ShaderStage, TypeInner,
};

use super::{SampleKind, scalar_kind};
use crate::problem::Place;
use crate::shader::{Listings, Shader};

/// A number, or a vector of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NumberType {
    /// The kind of numbers.
    pub kind: SampleKind,
    /// How many: 1 to 4.
    pub components: u8,
}

impl fmt::Display for NumberType {
    /// As WGSL writes it: `vec3f`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (scalar, letter) = match self.kind {
            SampleKind::Float | SampleKind::Depth => ("f32", 'f'),
            SampleKind::Uint => ("u32", 'u'),
            SampleKind::Sint => ("i32", 'i'),
        };
        match self.components {
            1 => write!(f, "{scalar}"),
            count => write!(f, "vec{count}{letter}"),
        }
    }
}

/// Something that goes from stage to stage: an `@location`.
#[derive(Clone, Debug, PartialEq)]
pub struct Varying {
    /// Its number.
    pub location: u32,
    /// The name of the argument or member; none for a result.
    pub name: Option<String>,
    /// What it is.
    pub ty: NumberType,
    /// How it is interpolated between vertices.
    pub interpolation: Option<Interpolation>,
    /// Where in the pixel.
    pub sampling: Option<Sampling>,
    /// Where it is declared.
    pub at: Place,
}

impl Varying {
    /// How it is interpolated, as WGSL writes it.
    pub fn interpolated(&self) -> String {
        use naga::common::wgsl::ToWgsl as _;
        let how = self.interpolation.unwrap_or(Interpolation::Perspective);
        match self.sampling {
            None | Some(Sampling::Center) => format!("@interpolate({})", how.to_wgsl()),
            Some(sampling) => {
                format!("@interpolate({}, {})", how.to_wgsl(), sampling.to_wgsl())
            }
        }
    }
}

/// One entry point.
#[derive(Clone, Debug, PartialEq)]
pub struct EntryPoint {
    /// Its name.
    pub name: String,
    /// Its stage.
    pub stage: ShaderStage,
    /// Where it is declared.
    pub at: Place,
    /// Where its result is declared.
    pub result_at: Place,
    /// Where its workgroup size is declared.
    pub workgroup_at: Place,
    /// Its `@location` arguments.
    pub inputs: Vec<Varying>,
    /// Its `@location` results, by location.
    pub outputs: Vec<Varying>,
    /// Inputs between stages that builtin values take up.
    pub builtin_inputs: u32,
    /// Where `@builtin(frag_depth)` is, if it writes depth itself.
    pub writes_depth: Option<Place>,
    /// Invocations of a workgroup along each axis.
    pub workgroup_size: [u32; 3],
    /// Bytes of workgroup memory that it uses, directly or in functions that it calls.
    pub workgroup_bytes: u64,
    /// Group and binding of the variables that it uses.
    pub uses: BTreeSet<(u32, u32)>,
    /// Each texture that it samples, with the sampler: group and binding of both.
    pub samples: BTreeSet<[(u32, u32); 2]>,
}

/// All entry points of a shader.
pub(super) fn entry_points(shader: &Shader) -> Vec<EntryPoint> {
    let Shader {
        module,
        info,
        listings,
        ..
    } = shader;
    let mut layouter = Layouter::default();
    let laid_out = layouter.update(module.to_ctx()).is_ok();
    let bound = |handle: Handle<naga::GlobalVariable>| {
        let binding = module.global_variables[handle].binding?;
        Some((binding.group, binding.binding))
    };
    let read = |(index, entry): (usize, &naga::EntryPoint)| {
        let uses = info.get_entry_point(index);
        let function = &entry.function;
        let mut reader = Reader {
            module,
            listings,
            entry: &entry.name,
            varyings: Vec::new(),
            builtins: Vec::new(),
        };
        for argument in &function.arguments {
            let name = argument.name.as_deref();
            let at =
                || name.map_or_else(Place::default, |name| listings.argument(&entry.name, name));
            reader.read(argument.ty, argument.binding.as_ref(), name, &at);
        }
        let inputs = std::mem::take(&mut reader.varyings);
        let builtin_inputs = reader.builtins.drain(..).map(|(b, _)| slots(b)).sum();
        if let Some(result) = &function.result {
            let at = || listings.result(&entry.name);
            reader.read(result.ty, result.binding.as_ref(), None, &at);
        }
        let mut outputs = reader.varyings;
        outputs.sort_by_key(|output| output.location);
        let mut builtins = reader.builtins.into_iter();
        let writes_depth = builtins.find(|(builtin, _)| *builtin == BuiltIn::FragDepth);
        let used = || {
            let globals = module.global_variables.iter();
            globals.filter(|(handle, _)| !uses[*handle].is_empty())
        };
        let shared = used().filter(|(_, global)| global.space == AddressSpace::WorkGroup);
        let bytes = |ty: Handle<naga::Type>| match laid_out {
            // WebGPU counts each variable in steps of 16 bytes.
            true => u64::from(layouter[ty].size).next_multiple_of(16),
            false => 0,
        };
        EntryPoint {
            name: entry.name.clone(),
            stage: entry.stage,
            at: listings.function(&entry.name),
            result_at: listings.result(&entry.name),
            workgroup_at: listings.workgroup_size(&entry.name),
            inputs,
            outputs,
            builtin_inputs,
            writes_depth: writes_depth.map(|(_, at)| at),
            workgroup_size: entry.workgroup_size,
            workgroup_bytes: shared.map(|(_, global)| bytes(global.ty)).sum(),
            uses: used().filter_map(|(handle, _)| bound(handle)).collect(),
            samples: uses
                .sampling_set
                .iter()
                .filter_map(|key| Some([bound(key.image)?, bound(key.sampler)?]))
                .collect(),
        }
    };
    module.entry_points.iter().enumerate().map(read).collect()
}

/// What a builtin value takes of the room between two stages, as WebGPU counts it.
fn slots(builtin: BuiltIn) -> u32 {
    match builtin {
        BuiltIn::FrontFacing
        | BuiltIn::SampleIndex
        | BuiltIn::SampleMask
        | BuiltIn::PrimitiveIndex
        | BuiltIn::SubgroupSize
        | BuiltIn::SubgroupInvocationId => 1,
        _ => 0,
    }
}

/// Collects what is in arguments and results, looking into structures.
struct Reader<'a> {
    module: &'a naga::Module,
    listings: &'a Listings,
    entry: &'a str,
    varyings: Vec<Varying>,
    builtins: Vec<(BuiltIn, Place)>,
}

impl Reader<'_> {
    fn read(
        &mut self,
        ty: Handle<naga::Type>,
        binding: Option<&Binding>,
        name: Option<&str>,
        at: &dyn Fn() -> Place,
    ) {
        let ty = &self.module.types[ty];
        match (binding, &ty.inner) {
            (
                Some(Binding::Location {
                    location,
                    interpolation,
                    sampling,
                    ..
                }),
                inner,
            ) => {
                let Some(number) = number_type(inner) else {
                    return;
                };
                let mut place = at();
                if place.line == 0 {
                    place = self.listings.function(self.entry);
                }
                self.varyings.push(Varying {
                    location: *location,
                    name: name.map(str::to_owned),
                    ty: number,
                    interpolation: *interpolation,
                    sampling: *sampling,
                    at: place,
                });
            }
            (Some(Binding::BuiltIn(builtin)), _) => self.builtins.push((*builtin, at())),
            (None, TypeInner::Struct { members, .. }) => {
                let structure = ty.name.as_deref().unwrap_or_default();
                for member in members {
                    let name = member.name.as_deref();
                    let listings = self.listings;
                    let at = || listings.member(structure, name.unwrap_or_default());
                    self.read(member.ty, member.binding.as_ref(), name, &at);
                }
            }
            (None, _) => {}
        }
    }
}

fn number_type(inner: &TypeInner) -> Option<NumberType> {
    let (scalar, components) = match inner {
        TypeInner::Scalar(scalar) => (scalar, 1),
        TypeInner::Vector { size, scalar } => (scalar, *size as u8),
        _ => return None,
    };
    Some(NumberType {
        kind: scalar_kind(scalar.kind)?,
        components,
    })
}
