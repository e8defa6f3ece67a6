//! The shader of a pass and its defines.

use lightbench_render::description::{Define, ShaderDesc};

use super::{Open, method};
use crate::api::{Api, Mistake};
use crate::pipeline::builder::shader_name;

pub(super) fn register(api: &mut Api) {
    api.section("The shader");
    method(
        api,
        "shader(path)",
        "Names the WGSL file, from the project's folder, as in `shaders/output.wgsl`. A pass has one \
         shader.",
        |open, arguments| {
            let path = arguments.text(0)?;
            if let Some(first) = &open.pass.shader {
                return Err(Mistake::new(format!(
                    "the pass has a shader already, `{}`",
                    first.path
                )));
            }
            set(open, path)
        },
    );
    method(
        api,
        "replace_shader(path)",
        "Takes another WGSL file in place of the one that was named, without its defines: for \
         passes of parts and of derived pipelines.",
        |open, arguments| {
            let path = arguments.text(0)?;
            set(open, path)
        },
    );
    method(
        api,
        "define(name)",
        "Chooses a variant of the shader: `#ifdef NAME` is true in it. Without it, it is false. Comes \
         after `.shader`.",
        |open, arguments| {
            let name = arguments.text(0)?;
            define(open, Define { name, value: None })
        },
    );
    method(
        api,
        "define(name, value)",
        "Gives the shader a whole number: `#{NAME}` in it stands for the value. Comes after \
         `.shader`.",
        |open, arguments| {
            let name = arguments.text(0)?;
            let value = arguments.whole(1, i64::from(i32::MIN), i64::from(i32::MAX))?;
            let value = Some(value as i32);
            define(open, Define { name, value })
        },
    );
}

fn set(open: Open, path: String) -> Result<(), Mistake> {
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
}

fn define(open: Open, define: Define) -> Result<(), Mistake> {
    shader_name(&define.name, "a define")?;
    let Some(shader) = &mut open.pass.shader else {
        return Err(Mistake::new("`.define` comes after `.shader`"));
    };
    if shader.defines.iter().any(|known| known.name == define.name) {
        return Err(Mistake::new(format!(
            "`{}` is defined already",
            define.name
        )));
    }
    shader.defines.push(define);
    Ok(())
}
