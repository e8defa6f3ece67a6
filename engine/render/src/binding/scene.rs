//! Group 0: the scene, which the engine binds as `shaders/lib/scene.wgsl` declares it.

use std::sync::OnceLock;

use lightbench_assets::files::Files;
use naga::{ArraySize, Handle, Module, ShaderStage, TypeInner};

use super::Binder;
use crate::layout::scene_entries;
use crate::problem::Problem;
use crate::reflection::Reflection;
use crate::shader::Shader;
use crate::validate::FormatSupport;

/// The file that declares the scene, and its name for imports.
const SCENE: &str = "shaders/lib/scene.wgsl";
const SCENE_MODULE: &str = "lightbench::scene";

impl<S: FormatSupport> Binder<'_, S> {
    /// Every variable of group 0 is one of the scene's.
    pub(super) fn scene(&mut self) {
        let problems = check_scene(self.shader, self.reflection);
        self.problems.extend(problems);
    }
}

/// Checks the variables of group 0: the engine fills them, so they are what it says, and each stage
/// sees only some.
pub(super) fn check_scene(shader: &Shader, reflection: &Reflection) -> Vec<Problem> {
    let mut problems = Vec::new();
    let entries = scene_entries();
    for variable in reflection.variables.iter().filter(|v| v.group == 0) {
        let name = &variable.name;
        let Some(entry) = entries.iter().find(|e| e.binding == variable.binding) else {
            problems.push(
                Problem::new(
                    variable.at.clone(),
                    format!(
                        "the scene has nothing at @group(0) @binding({})",
                        variable.binding
                    ),
                )
                .with_hint(format!(
                    "targets and buffers are in group 1; for the scene write `#import \
                     {SCENE_MODULE}`"
                )),
            );
            continue;
        };
        if let Some((own, difference)) = difference(&shader.module, variable.binding) {
            problems.push(
                Problem::new(
                    variable.at.clone(),
                    if *name == own {
                        format!("`{name}` is not as the engine fills it: {difference}")
                    } else {
                        format!("the engine binds `{own}` where `{name}` is, and there {difference}")
                    },
                )
                .with_hint(format!(
                    "write `#import {SCENE_MODULE}` and use `scene::{own}`; if {SCENE} was changed, \
                     undo that"
                )),
            );
            continue;
        }
        for stage in &reflection.entry_points {
            let bit = match stage.stage {
                ShaderStage::Vertex => wgpu::ShaderStages::VERTEX,
                ShaderStage::Fragment => wgpu::ShaderStages::FRAGMENT,
                _ => wgpu::ShaderStages::COMPUTE,
            };
            if stage.uses.contains(&(0, variable.binding)) && !entry.visibility.contains(bit) {
                problems.push(
                    Problem::new(
                        stage.at.clone(),
                        format!(
                            "`{}` uses `scene::{name}`, which its stage can't see",
                            stage.name
                        ),
                    )
                    .with_hint(format!(
                        "it is there in {}",
                        stages_in_words(entry.visibility)
                    )),
                );
            }
        }
    }
    problems
}

fn stages_in_words(stages: wgpu::ShaderStages) -> String {
    let words = [
        (wgpu::ShaderStages::VERTEX, "vertex stages"),
        (wgpu::ShaderStages::FRAGMENT, "fragment stages"),
        (wgpu::ShaderStages::COMPUTE, "compute shaders"),
    ];
    let seen = words.iter().filter(|(stage, _)| stages.contains(*stage));
    let seen: Vec<&str> = seen.map(|(_, word)| *word).collect();
    seen.join(" and ")
}

/// The scene as the program was built with it.
fn shipped() -> Option<&'static Module> {
    static SHIPPED: OnceLock<Option<Module>> = OnceLock::new();
    let parse = || {
        let text = Files::shipped().read_text(SCENE).ok()?;
        // It imports nothing; its own name is the composer's affair.
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        let text: Vec<&str> = lines.collect();
        naga::front::wgsl::parse_str(&text.join("\n")).ok()
    };
    SHIPPED.get_or_init(parse).as_ref()
}

/// In what a variable differs from the scene's at the same binding, and the name of that one.
fn difference(module: &Module, binding: u32) -> Option<(String, String)> {
    let shipped = shipped()?;
    let of = |module: &Module| {
        let mut globals = module.global_variables.iter();
        let found = globals.find(|(_, global)| {
            let bound = global.binding.as_ref();
            bound.is_some_and(|at| (at.group, at.binding) == (0, binding))
        });
        found.map(|(handle, _)| handle)
    };
    let own = &module.global_variables[of(module)?];
    let wanted = &shipped.global_variables[of(shipped)?];
    let name = wanted.name.clone().unwrap_or_default();
    if own.space != wanted.space {
        return Some((name, "the variable is of another kind".to_owned()));
    }
    let compared = Compared {
        own: module,
        wanted: shipped,
    };
    let difference = compared.types(own.ty, wanted.ty)?;
    Some((name, difference))
}

/// Two shaders whose types are compared by what lies where in memory, whatever it is called.
struct Compared<'a> {
    own: &'a Module,
    wanted: &'a Module,
}

impl Compared<'_> {
    fn types(&self, own: Handle<naga::Type>, wanted: Handle<naga::Type>) -> Option<String> {
        use naga::common::wgsl::TypeContext as _;
        let (a, b) = (&self.own.types[own], &self.wanted.types[wanted]);
        match (&a.inner, &b.inner) {
            (
                TypeInner::Struct { members, span },
                TypeInner::Struct {
                    members: wanted,
                    span: wanted_span,
                },
            ) => {
                for (member, wanted) in members.iter().zip(wanted) {
                    let name = wanted.name.as_deref().unwrap_or_default();
                    if member.offset != wanted.offset {
                        return Some(format!(
                            "`{name}` begins at byte {}, not {}",
                            wanted.offset, member.offset
                        ));
                    }
                    if let Some(inner) = self.types(member.ty, wanted.ty) {
                        return Some(format!("`{name}` is different: {inner}"));
                    }
                }
                if members.len() != wanted.len() || span != wanted_span {
                    return Some(format!(
                        "the structure has {} members in {wanted_span} bytes",
                        wanted.len()
                    ));
                }
                None
            }
            (
                TypeInner::Array { base, size, .. },
                TypeInner::Array {
                    base: wanted_base,
                    size: wanted_size,
                    ..
                },
            ) => match (size, wanted_size) {
                (ArraySize::Dynamic, ArraySize::Dynamic) => self.types(*base, *wanted_base),
                (size, wanted) if size == wanted => self.types(*base, *wanted_base),
                _ => Some("the array has no length".to_owned()),
            },
            (a, b) if a == b => None,
            _ => {
                let wanted = self.wanted.to_ctx().type_to_string(wanted);
                Some(format!("it is a `{}`", crate::shader::short_types(&wanted)))
            }
        }
    }
}
