//! Passes of a pipeline: `geometry`, `lights` and `fullscreen`, and what they read and write.

use lightbench_render::Place;
use lightbench_render::description::{
    Blend, ColorAttachment, DepthAttachment, DepthCompare, DrawList, Load, PassDesc, PassKind,
    Read, ShaderDesc,
};

use super::builder::{Builder, Last, Pipeline, shader_name};
use crate::api::{Api, Arguments, Mistake, ScriptType};

/// A pass, as scripts hold it.
#[derive(Clone, Debug)]
struct Pass {
    pipeline: Pipeline,
    index: usize,
}

impl ScriptType for Pass {
    const NAME: &'static str = "pass";
}

pub(super) fn register(api: &mut Api) {
    api.object::<Pass>();
    begin(
        api,
        "geometry(name)",
        "Adds a pass that draws the scene's meshes.",
        PassKind::Geometry {
            list: DrawList::Opaque,
            gather_lights: false,
        },
    );
    begin(
        api,
        "lights(name)",
        "Adds a pass that draws each light's volume: a sphere, a cone, or the whole screen.",
        PassKind::Lights { volumes: true },
    );
    begin(
        api,
        "fullscreen(name)",
        "Adds a pass that draws one triangle over the whole target.",
        PassKind::Fullscreen,
    );
    shader(api);
    kinds(api);
    reads(api);
    colors(api);
    depth(api);
}

/// Registers a method of the pipeline that begins a pass.
fn begin(api: &mut Api, form: &str, about: &'static str, kind: PassKind) {
    api.method(form, about, move |pipeline: Pipeline, arguments| {
        let mut name = String::new();
        pipeline.note(arguments, |builder, _| {
            name = arguments.text(0)?;
            if name.trim().is_empty() {
                return Err(Mistake::new("a pass needs a name"));
            }
            match builder.desc.passes.iter().find(|pass| pass.name == name) {
                Some(first) => Err(Mistake::new(format!(
                    "there is a pass `{name}` already, in line {} of {}",
                    first.at.line, first.at.file
                ))),
                None => Ok(()),
            }
        });
        // A pass with a wrong name is kept, so that its own mistakes are found too.
        let mut builder = pipeline.lock();
        let index = builder.desc.passes.len();
        builder.last.push(Last::Nothing);
        builder.desc.passes.push(PassDesc {
            name,
            at: arguments.place(),
            kind: kind.clone(),
            shader: None,
            reads: Vec::new(),
            colors: Vec::new(),
            depth: None,
        });
        drop(builder);
        Ok(Pass { pipeline, index })
    });
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
            let open = Open {
                pass: &mut builder.desc.passes[pass.index],
                last: &mut builder.last[pass.index],
                at,
            };
            body(open, arguments)
        });
        Ok(pass)
    });
}

fn shader(api: &mut Api) {
    method(
        api,
        "shader(path)",
        "Names the WGSL file, from the project's folder, as in `shaders/output.wgsl`.",
        |open, arguments| {
            let path = arguments.text(0)?;
            if let Some(first) = &open.pass.shader {
                return Err(Mistake::new(format!(
                    "the pass has a shader already, `{}`",
                    first.path
                )));
            }
            if !path.ends_with(".wgsl") {
                return Err(Mistake::new(format!("`{path}` is no shader"))
                    .with_hint("shaders are files that end in `.wgsl`"));
            }
            open.pass.shader = Some(ShaderDesc {
                path,
                at: open.at,
                defines: Vec::new(),
            });
            Ok(())
        },
    );
    method(
        api,
        "define(name)",
        "Chooses a variant of the shader: `#ifdef NAME` is true in it. Comes after `.shader`.",
        |open, arguments| {
            let name = arguments.text(0)?;
            shader_name(&name, "a define")?;
            match &mut open.pass.shader {
                Some(shader) if shader.defines.contains(&name) => {
                    Err(Mistake::new(format!("`{name}` is defined already")))
                }
                Some(shader) => {
                    shader.defines.push(name);
                    Ok(())
                }
                None => Err(Mistake::new("`.define` comes after `.shader`")),
            }
        },
    );
}

fn kinds(api: &mut Api) {
    method(
        api,
        "draws(list)",
        "Says which objects a geometry pass draws: `opaque`.",
        |open, arguments| {
            let chosen = arguments.choice(0, &DrawList::NAMES)?;
            match &mut open.pass.kind {
                PassKind::Geometry { list, .. } => {
                    *list = chosen;
                    Ok(())
                }
                other => Err(only_for("draws", "geometry", other)),
            }
        },
    );
    method(
        api,
        "gather_lights(on)",
        "Whether the engine gathers, for each object, the lights that reach it. Else each object \
         gets all lights.",
        |open, arguments| {
            let on = arguments.switch(0)?;
            match &mut open.pass.kind {
                PassKind::Geometry { gather_lights, .. } => {
                    *gather_lights = on;
                    Ok(())
                }
                other => Err(only_for("gather_lights", "geometry", other)),
            }
        },
    );
    method(
        api,
        "volumes(on)",
        "Whether lights are drawn as volumes. Else each covers the whole screen.",
        |open, arguments| {
            let on = arguments.switch(0)?;
            match &mut open.pass.kind {
                PassKind::Lights { volumes } => {
                    *volumes = on;
                    Ok(())
                }
                other => Err(only_for("volumes", "lights", other)),
            }
        },
    );
}

fn only_for(method: &str, wanted: &str, found: &PassKind) -> Mistake {
    Mistake::new(format!(
        "`.{method}` belongs to a `{wanted}` pass, and this is a `{}` pass",
        found.name()
    ))
}

fn reads(api: &mut Api) {
    for form in ["reads(target)", "reads(target, variable)"] {
        method(
            api,
            form,
            "Lets the shader read a target, under the target's name or another.",
            |open, arguments| {
                let target = arguments.text(0)?;
                let variable = match arguments.len() {
                    2 => arguments.text(1)?,
                    _ => target.clone(),
                };
                shader_name(&variable, "a variable")?;
                if open.pass.reads.iter().any(|read| read.variable == variable) {
                    return Err(Mistake::new(format!(
                        "the pass reads something as `{variable}` already"
                    )));
                }
                open.pass.reads.push(Read {
                    target,
                    variable,
                    at: open.at,
                });
                Ok(())
            },
        );
    }
}

fn colors(api: &mut Api) {
    method(
        api,
        "writes(target)",
        "Adds a colour target, in the order of the shader's outputs. `.clear` and `.blend` after \
         it apply to it.",
        |open, arguments| {
            let target = arguments.text(0)?;
            if open.pass.colors.iter().any(|color| color.target == target) {
                return Err(Mistake::new(format!("the pass writes `{target}` already")));
            }
            open.pass.colors.push(ColorAttachment {
                target,
                at: open.at,
                load: Load::Keep,
                blend: Blend::Replace,
            });
            *open.last = Last::Color;
            Ok(())
        },
    );
    method(
        api,
        "clear(red, green, blue, alpha)",
        "Fills the last `.writes` target with a constant before the pass.",
        |open, arguments| {
            let mut color = [0.0; 4];
            for (index, channel) in color.iter_mut().enumerate() {
                *channel = arguments.number(index)?;
            }
            match (*open.last, open.pass.colors.last_mut()) {
                (Last::Color, Some(attachment)) => {
                    attachment.load = Load::Clear(color);
                    Ok(())
                }
                (Last::Depth, _) => Err(Mistake::new("depth is cleared to one number")
                    .with_hint("write `.clear(0.0)`; depth is reversed, 0 is the far plane")),
                _ => Err(before_attachment("clear")),
            }
        },
    );
    method(
        api,
        "blend(mode)",
        "How new values combine with the last `.writes` target: `replace`, `add` or `over`.",
        |open, arguments| {
            let blend = arguments.choice(0, &Blend::NAMES)?;
            match (*open.last, open.pass.colors.last_mut()) {
                (Last::Color, Some(attachment)) => {
                    attachment.blend = blend;
                    Ok(())
                }
                (Last::Depth, _) => Err(Mistake::new("depth does not blend")
                    .with_hint("`.blend` comes after the `.writes` that it applies to")),
                _ => Err(before_attachment("blend")),
            }
        },
    );
}

fn depth(api: &mut Api) {
    method(
        api,
        "depth(target)",
        "Sets the depth target. Nearer fragments pass and write; a `lights` pass never writes.",
        |open, arguments| {
            let target = arguments.text(0)?;
            if let Some(first) = &open.pass.depth {
                return Err(Mistake::new(format!(
                    "the pass has a depth target already, `{}`",
                    first.target
                )));
            }
            open.pass.depth = Some(DepthAttachment {
                target,
                at: open.at,
                load: Load::Keep,
                compare: DepthCompare::Nearer,
                write: !matches!(open.pass.kind, PassKind::Lights { .. }),
            });
            *open.last = Last::Depth;
            Ok(())
        },
    );
    method(
        api,
        "clear(depth)",
        "Fills the depth target before the pass. Depth is reversed: 0 is the far plane.",
        |open, arguments| {
            let depth = arguments.number_in(0, 0.0, 1.0)?;
            match (*open.last, &mut open.pass.depth) {
                (Last::Depth, Some(attachment)) => {
                    attachment.load = Load::Clear([depth, 0.0, 0.0, 0.0]);
                    Ok(())
                }
                (Last::Color, _) => Err(Mistake::new("a colour target is cleared to four numbers")
                    .with_hint("write `.clear(0, 0, 0, 0)`")),
                _ => Err(before_attachment("clear")),
            }
        },
    );
    method(
        api,
        "test(compare)",
        "Which fragments pass the depth test: `nearer`, `equal` or `always`.",
        |open, arguments| {
            let compare = arguments.choice(0, &DepthCompare::NAMES)?;
            attached_depth(open, "test", |depth| depth.compare = compare)
        },
    );
    method(
        api,
        "read_only()",
        "Tests depth without writing it, so that the shader may read it too.",
        |open, _| attached_depth(open, "read_only", |depth| depth.write = false),
    );
}

fn attached_depth(
    open: Open,
    method: &str,
    change: impl FnOnce(&mut DepthAttachment),
) -> Result<(), Mistake> {
    match &mut open.pass.depth {
        Some(depth) => {
            change(depth);
            Ok(())
        }
        None => Err(Mistake::new(format!("`.{method}` comes after `.depth`"))),
    }
}

fn before_attachment(method: &str) -> Mistake {
    Mistake::new(format!(
        "`.{method}` comes after the `.writes` or `.depth` that it applies to"
    ))
}
