//! Passes of a pipeline: how they begin, and the methods that they have in common.
//!
//! One file for each part of a pass: what it does ([`kinds`]), with which shader ([`shader`]),
//! from and into what ([`resources`], [`colors`], [`depth`]).

mod colors;
mod compute;
mod depth;
mod kinds;
mod resources;
mod shader;
mod shadow;
mod transfer;

use lightbench_render::Place;
use lightbench_render::description::{Amount, Dispatch, Geometry, Lights, PassDesc, PassKind};
use lightbench_render::problem::suggestion;

use super::builder::{Builder, Last, Pipeline, method as pipeline_method};
use crate::api::{Api, Arguments, Mistake, ScriptType};

/// A pass, as scripts hold it.
#[derive(Clone, Debug)]
struct Pass {
    pipeline: Pipeline,
    /// Which of the builder's passes: see [`Builder::pass`].
    id: usize,
}

impl ScriptType for Pass {
    const NAME: &'static str = "pass";
}

pub(super) fn register(api: &mut Api) {
    api.object::<Pass>();
    api.section("Passes");
    begin(
        api,
        "geometry(name)",
        "Adds a pass that draws the scene's meshes.",
        |_| Ok(PassKind::Geometry(Geometry::default())),
    );
    begin(
        api,
        "lights(name)",
        "Adds a pass that draws each light's volume: a sphere, a cone, or the whole screen.",
        |_| Ok(PassKind::Lights(Lights::default())),
    );
    begin(
        api,
        "shadow(name)",
        "Adds a pass that draws the depth of everything opaque as lights see it. Say which with \
         `.views` or `.view_from`.",
        |_| Ok(PassKind::Shadow(shadow::new())),
    );
    begin(
        api,
        "fullscreen(name)",
        "Adds a pass that draws one triangle over the whole target.",
        |_| Ok(PassKind::Fullscreen),
    );
    begin(
        api,
        "compute(name)",
        "Adds a pass that runs a compute shader, in one workgroup unless a method says otherwise.",
        |_| {
            let once = Dispatch::Groups(Amount::Fixed(1, 1, 1));
            Ok(PassKind::Compute(once))
        },
    );
    begin(
        api,
        "clear(name)",
        "Adds a pass that fills its targets, all mips and layers of them, with their `.clear` \
         values, and the buffers that it `.updates` with zeros.",
        |_| Ok(PassKind::Clear),
    );
    transfer::register(api);
    again(api);
    shader::register(api);
    kinds::register(api);
    shadow::register(api);
    compute::register(api);
    resources::register(api);
    colors::register(api);
    depth::register(api);
}

/// Registers a method of the pipeline that begins a pass. The first argument is its name.
fn begin(
    api: &mut Api,
    form: &str,
    about: &'static str,
    kind: impl Fn(&Arguments) -> Result<PassKind, Mistake> + Send + Sync + 'static,
) {
    api.method(form, about, move |pipeline: Pipeline, arguments| {
        let mut name = String::new();
        let mut found = PassKind::Clear;
        pipeline.note(arguments, |builder, _| {
            name = arguments.text(0)?;
            if name.trim().is_empty() {
                return Err(Mistake::new("a pass needs a name"));
            }
            if let Some(first) = builder.desc.passes.iter().find(|pass| pass.name == name) {
                return Err(Mistake::new(format!(
                    "there is a pass `{name}` already, in line {} of {}",
                    first.at.line, first.at.file
                )));
            }
            Ok(())
        });
        match kind(arguments) {
            Ok(kind) => found = kind,
            Err(mistake) => pipeline.note(arguments, |_, _| Err(mistake)),
        }
        // A pass with a wrong name is kept, so that its own mistakes are found too.
        let id = pipeline
            .lock()
            .add_pass(PassDesc::new(name, arguments.place(), found));
        Ok(Pass { pipeline, id })
    });
}

/// Registers the methods that change a pipeline which another file made.
fn again(api: &mut Api) {
    api.section("Changing another pipeline");
    api.method(
        "pass(name)",
        "Gives a pass that is there already, of a part or of a derived pipeline, to change it.",
        |pipeline: Pipeline, arguments| {
            let mut id = usize::MAX;
            pipeline.note(arguments, |builder, _| {
                id = builder.find_pass(&arguments.text(0)?)?;
                Ok(())
            });
            Ok(Pass { pipeline, id })
        },
    );
    pipeline_method(
        api,
        "remove_pass(name)",
        "Takes a pass out.",
        |builder, arguments, _| {
            let id = builder.find_pass(&arguments.text(0)?)?;
            builder.remove_pass(id);
            Ok(())
        },
    );
    pipeline_method(
        api,
        "remove_target(name)",
        "Takes a target out, so that another of that name can be declared.",
        |builder, arguments, _| {
            let name = arguments.text(0)?;
            let targets = &mut builder.desc.targets;
            let known = targets.iter().position(|target| target.name == name);
            let Some(index) = known else {
                let names = targets.iter().map(|target| target.name.as_str());
                let mistake = Mistake::new(format!("there is no target `{name}`"));
                return Err(match suggestion(&name, names) {
                    Some(hint) => mistake.with_hint(hint),
                    None => mistake,
                });
            };
            targets.remove(index);
            Ok(())
        },
    );
    pipeline_method(
        api,
        "insert_before(name)",
        "Says that the passes which follow in this file run before that pass. Without it they run \
         after all others.",
        |builder, arguments, _| {
            let id = builder.find_pass(&arguments.text(0)?)?;
            builder.insert_before = Some(id);
            Ok(())
        },
    );
    pipeline_method(
        api,
        "insert_last()",
        "Says that the passes which follow in this file run after all others again.",
        |builder, _, _| {
            builder.insert_before = None;
            Ok(())
        },
    );
}

/// One pass and what its last attachment was.
struct Open<'a> {
    pass: &'a mut PassDesc,
    last: &'a mut Last,
    at: Place,
}

/// Registers a method of a pass that gives the pass back.
fn method(
    api: &mut Api,
    form: &str,
    about: &'static str,
    body: impl Fn(Open, &Arguments) -> Result<(), Mistake> + Send + Sync + 'static,
) {
    api.method(form, about, move |pass: Pass, arguments| {
        pass.pipeline.note(arguments, |builder: &mut Builder, at| {
            // A pass that was not found or was removed has its mistake already.
            match builder.pass(pass.id) {
                Some((pass, last)) => body(Open { pass, last, at }, arguments),
                None => Ok(()),
            }
        });
        Ok(pass)
    });
}

/// Passes that move what targets hold name these when they begin, and take no others.
fn takes_targets(pass: &PassDesc) -> Result<(), Mistake> {
    let kind = &pass.kind;
    let moves = matches!(
        kind,
        PassKind::Copy { .. }
            | PassKind::Resolve { .. }
            | PassKind::Mips { .. }
            | PassKind::History { .. }
    );
    if moves {
        return Err(Mistake::new(format!(
            "a `{}` pass has no targets but those that it begins with",
            kind.name()
        )));
    }
    Ok(())
}

/// A `clear` pass takes no more from its targets' methods than what to fill them with.
fn draws(pass: &PassDesc, method: &str) -> Result<(), Mistake> {
    if pass.kind == PassKind::Clear {
        return Err(Mistake::new(format!(
            "a `clear` pass fills its targets and draws nothing, so `.{method}` has no meaning there"
        )));
    }
    Ok(())
}

fn only_for(method: &str, wanted: &str, found: &PassKind) -> Mistake {
    Mistake::new(format!(
        "`.{method}` belongs to a `{wanted}` pass, and this is a `{}` pass",
        found.name()
    ))
}
