//! What is wrong with an entry point: what comes in, what goes out, and what its stage can't do.

use naga::ShaderStage;
use naga::common::wgsl::TryToWgsl;
use naga::valid::{EntryPointError, GlobalUse, VaryingError};

use super::{Context, Reason, lacking};
use crate::problem::Place;

/// What fragments alone do: they look at their neighbours, or end without a result.
const NEIGHBOURS: [&str; 13] = [
    "textureSample",
    "textureSampleBias",
    "textureSampleCompare",
    "dpdx",
    "dpdy",
    "fwidth",
    "dpdxCoarse",
    "dpdyCoarse",
    "fwidthCoarse",
    "dpdxFine",
    "dpdyFine",
    "fwidthFine",
    "discard",
];

/// What compute shaders alone do: their invocations wait for one another.
const BARRIERS: [&str; 4] = [
    "workgroupBarrier",
    "storageBarrier",
    "textureBarrier",
    "workgroupUniformLoad",
];

impl Context<'_> {
    pub(super) fn entry_point(
        &self,
        stage: ShaderStage,
        name: &str,
        error: &EntryPointError,
    ) -> Reason {
        use EntryPointError as E;
        let place = self.listings.function(name);
        let variable = |handle: naga::Handle<naga::GlobalVariable>| {
            let global = self.module?.global_variables.try_get(handle).ok()?;
            global.name.clone()
        };
        match error {
            E::Function(error) => {
                let entry = self
                    .module
                    .and_then(|module| module.entry_points.iter().find(|entry| entry.name == name));
                self.function(entry.map(|entry| &entry.function), name, error)
            }
            E::Conflict => Reason::new(format!("there are two entry points `{name}`")).at(place),
            E::MissingVertexOutputPosition => Reason::new(format!(
                "`{name}` does not say where the vertex is"
            ))
            .hint("a vertex stage returns `@builtin(position) vec4f`, alone or in a structure")
            .at(place),
            E::OutOfRangeWorkgroupSize | E::UnexpectedWorkgroupSize => {
                Reason::new("a workgroup has at least 1 invocation along each axis")
                    .hint("as in `@workgroup_size(8, 8)`")
                    .at(self.listings.workgroup_size(name))
            }
            E::ForbiddenStageOperations => self.forbidden(stage, name).unwrap_or_else(|| {
                Reason::new(format!("`{name}` does something that its stage can't do")).at(place)
            }),
            E::InvalidGlobalUsage(handle, usage) => {
                let named = variable(*handle);
                let named = named.as_deref().unwrap_or("a variable");
                let place = self.listings.variable(named);
                if usage.contains(GlobalUse::WRITE) {
                    Reason::new(format!("`{name}` writes `{named}`, which it can only read"))
                        .hint(format!(
                            "declare it `var<storage, read_write> {named}` and let the pass say \
                             .updates(\"{named}\")"
                        ))
                        .at(place)
                } else {
                    Reason::new(format!(
                        "`{name}` uses `{named}` in a way that it does not allow"
                    ))
                    .at(place)
                }
            }
            E::BindingCollision(handle) => self.collision(*handle),
            E::Argument(index, error) => {
                let function = self.module.and_then(|module| {
                    let mut entries = module.entry_points.iter();
                    Some(&entries.find(|entry| entry.name == name)?.function)
                });
                let argument = function.and_then(|f| f.arguments.get(*index as usize));
                let label = argument.and_then(|argument| argument.name.as_deref());
                let place = label.map(|label| self.listings.argument(name, label));
                self.varying(error, argument.map(|argument| argument.ty), place)
            }
            E::Result(error) => {
                let mut entries = self.module.iter().flat_map(|module| &module.entry_points);
                let entry = entries.find(|entry| entry.name == name);
                let result = entry.and_then(|entry| entry.function.result.as_ref());
                let place = self.listings.result(name);
                self.varying(error, result.map(|result| result.ty), Some(place))
            }
            E::UnsupportedCapability(wanted) => lacking(*wanted).at(place),
            _ => Reason::new(format!("`{name}` is of a stage that pipelines don't have"))
                .hint("the stages are @vertex, @fragment and @compute")
                .at(place),
        }
    }

    /// Two variables with one binding.
    fn collision(&self, handle: naga::Handle<naga::GlobalVariable>) -> Reason {
        let global = self
            .module
            .and_then(|module| module.global_variables.try_get(handle).ok());
        let binding = global.and_then(|global| global.binding);
        let (Some(module), Some(global), Some(binding)) = (self.module, global, binding) else {
            return Reason::new("two variables have one @group and @binding");
        };
        let mut others = module.global_variables.iter();
        let other = others.find(|(other, variable)| {
            *other != handle && variable.binding.as_ref() == Some(&binding)
        });
        let name = global.name.as_deref().unwrap_or_default();
        let other = other.and_then(|(_, variable)| variable.name.as_deref());
        Reason::new(format!(
            "`{name}` has @group({}) @binding({}), as `{}` has",
            binding.group,
            binding.binding,
            other.unwrap_or("another variable")
        ))
        .hint(format!(
            "the next free number is {}",
            self.free_binding(binding.group)
        ))
        .at(self.listings.variable(name))
    }

    /// The first number of a group that no variable has.
    pub(super) fn free_binding(&self, group: u32) -> u32 {
        let bindings = self
            .module
            .iter()
            .flat_map(|module| module.global_variables.iter());
        let taken: Vec<u32> = bindings
            .filter_map(|(_, global)| global.binding.as_ref())
            .filter(|binding| binding.group == group)
            .map(|binding| binding.binding)
            .collect();
        (0..)
            .find(|number| !taken.contains(number))
            .unwrap_or_default()
    }

    /// An argument or result of an entry point, or a member of one.
    fn varying(
        &self,
        error: &VaryingError,
        ty: Option<naga::Handle<naga::Type>>,
        place: Option<Place>,
    ) -> Reason {
        use VaryingError as E;
        let builtin = |builtin: naga::BuiltIn| {
            builtin
                .try_to_wgsl()
                .map_or_else(|| "…".to_owned(), str::to_owned)
        };
        // Where a structure is meant, its members are looked through for the one at fault.
        let member = |fits: &dyn Fn(&naga::StructMember) -> bool| {
            let module = self.module?;
            let ty = &module.types[ty?];
            let naga::TypeInner::Struct { members, .. } = &ty.inner else {
                return None;
            };
            let member = members.iter().find(|member| fits(member))?;
            let place = self
                .listings
                .member(ty.name.as_deref()?, member.name.as_deref()?);
            Some(place).filter(|place| place.line > 0)
        };
        let has_builtin = |wanted: naga::BuiltIn| {
            member(
                &|member| matches!(&member.binding, Some(naga::Binding::BuiltIn(found)) if *found == wanted),
            )
        };
        let (reason, better) = match error {
            E::NotIOShareableType(_) | E::InvalidType(_) => (
                Reason::new("this type can't go from stage to stage")
                    .hint("only numbers and vectors of numbers can"),
                None,
            ),
            E::InvalidInterpolationForInteger | E::MissingInterpolation => (
                Reason::new("whole numbers can't be interpolated between vertices")
                    .hint("write `@interpolate(flat)` beside `@location`, in both stages"),
                member(&|member| {
                    let integer = self.module.is_some_and(|module| {
                        let scalar = module.types[member.ty].inner.scalar_kind();
                        matches!(
                            scalar,
                            Some(naga::ScalarKind::Uint | naga::ScalarKind::Sint)
                        )
                    });
                    let flat = matches!(
                        &member.binding,
                        Some(naga::Binding::Location {
                            interpolation: Some(naga::Interpolation::Flat),
                            ..
                        })
                    );
                    integer && !flat && member.binding.is_some()
                }),
            ),
            E::InvalidBuiltInStage(found) => (
                Reason::new(format!(
                    "`@builtin({})` does not exist here",
                    builtin(*found)
                ))
                .hint(format!("it is {}", home_of(*found))),
                has_builtin(*found),
            ),
            E::InvalidBuiltInType(found, inner) => (
                Reason::new(format!(
                    "`@builtin({})` is a {}, not a `{}`",
                    builtin(*found),
                    type_of(*found),
                    self.inner_name(inner).unwrap_or_default()
                )),
                has_builtin(*found),
            ),
            E::MissingBinding => (
                Reason::new(
                    "an entry point says where each argument comes from and its result goes",
                )
                .hint("write `@location(0)` or `@builtin(…)` before it"),
                None,
            ),
            E::MemberMissingBinding(index) => (
                Reason::new("an entry point says of each member where it comes from or goes")
                    .hint("write `@location(0)` or `@builtin(…)` before it"),
                self.member_at(ty, *index),
            ),
            E::BindingCollision { location } => (
                Reason::new(format!("there are two `@location({location})`"))
                    .hint("give each a number of its own"),
                None,
            ),
            E::DuplicateBuiltIn(found) => (
                Reason::new(format!("`@builtin({})` is there twice", builtin(*found))),
                None,
            ),
            E::UnsupportedCapability(wanted) => (lacking(*wanted), None),
            E::InvalidInterpolationSamplingCombination { .. }
            | E::InvalidInterpolationInStage(..) => (
                Reason::new("these words of `@interpolate` don't go together")
                    .hint("as in `@interpolate(flat)` or `@interpolate(linear, center)`"),
                None,
            ),
            _ => (Reason::new("this can't go from stage to stage"), None),
        };
        match better.or(place) {
            Some(place) => reason.at(place),
            None => reason,
        }
    }

    fn member_at(&self, ty: Option<naga::Handle<naga::Type>>, index: u32) -> Option<Place> {
        let module = self.module?;
        let ty = &module.types[ty?];
        let naga::TypeInner::Struct { members, .. } = &ty.inner else {
            return None;
        };
        let member = members.get(index as usize)?;
        Some(
            self.listings
                .member(ty.name.as_deref()?, member.name.as_deref()?),
        )
    }

    /// A call that a stage can't make; the library says not where it is.
    fn forbidden(&self, stage: ShaderStage, name: &str) -> Option<Reason> {
        let words: &[&str] = match stage {
            ShaderStage::Fragment => &BARRIERS,
            ShaderStage::Compute => &NEIGHBOURS,
            _ => &[NEIGHBOURS.as_slice(), &BARRIERS].concat(),
        };
        let reached = self.listings.reached(name);
        let (place, word) = reached.iter().find_map(|(listing, body)| {
            let found = body.iter().find(|token| words.contains(&token.text))?;
            let place = Place::new(listing.path.as_str(), found.line, found.column);
            Some((place, found.text))
        })?;
        let stage = match stage {
            ShaderStage::Vertex => "a vertex stage",
            ShaderStage::Fragment => "a fragment stage",
            _ => "a compute shader",
        };
        let hint = match word {
            "discard" => "only a fragment can be discarded: use `return`",
            "textureSample" => {
                "it has no neighbouring pixels to choose a mip level from: write \
                 `textureSampleLevel(texture, sampler, uv, 0.0)`"
            }
            "textureSampleBias" => {
                "it has no neighbouring pixels to choose a mip level from: write \
                 `textureSampleLevel`, which takes the level"
            }
            "textureSampleCompare" => {
                "write `textureSampleCompareLevel`, which needs no neighbouring pixels"
            }
            word if BARRIERS.contains(&word) => "only a compute shader's workgroup has barriers",
            _ => "it has no neighbouring pixels to compare with",
        };
        let message = format!("`{word}` can't be used in {stage}, as `{name}` is");
        Some(Reason::new(message).hint(hint).at(place))
    }
}

/// What a builtin value is, as WGSL writes it.
fn type_of(builtin: naga::BuiltIn) -> &'static str {
    use naga::BuiltIn as B;
    match builtin {
        B::Position { .. } => "`vec4f`",
        B::FrontFacing => "`bool`",
        B::FragDepth => "`f32`",
        B::GlobalInvocationId | B::LocalInvocationId | B::WorkGroupId | B::NumWorkGroups => {
            "`vec3u`"
        }
        _ => "`u32`",
    }
}

/// Where a builtin value is known.
fn home_of(builtin: naga::BuiltIn) -> &'static str {
    use naga::BuiltIn as B;
    match builtin {
        B::VertexIndex | B::InstanceIndex => "an argument of vertex stages",
        B::Position { .. } => "a result of vertex stages and an argument of fragment stages",
        B::FragDepth => "a result of fragment stages",
        B::FrontFacing | B::SampleIndex | B::SampleMask => "an argument of fragment stages",
        _ => "an argument of compute shaders",
    }
}
