//! A vertex stage and the fragment stage after it.

use naga::ShaderStage;

use super::scene::check_scene;
use super::stages::mesh_input;
use crate::description::PassDesc;
use crate::problem::{Place, Problem};
use crate::reflection::{
    BindingKind, EntryPoint, FRAGMENT_ENTRY, Reflection, SampleKind, VERTEX_ENTRY, Varying,
};
use crate::shader::Shader;

/// A shader and what it asks for.
pub type Reflected<'a> = (&'a Shader, &'a Reflection);

/// Checks that a fragment stage takes only what the vertex stage before it gives, and that stages
/// which are not the pass's own bind nothing of the pass.
///
/// # Errors
/// The first input that the vertex stage does not give, or gives as something else.
pub fn link(
    pass: &PassDesc,
    vertex: Reflected,
    fragment: Option<Reflected>,
) -> Result<(), Problem> {
    for (shader, reflection) in std::iter::once(vertex).chain(fragment) {
        let own = pass
            .shader
            .as_ref()
            .is_some_and(|own| own.path == shader.path);
        if !own {
            shared(shader, reflection)?;
        }
    }
    let (shader, reflection) = vertex;
    let Some(given) = reflection.entry(VERTEX_ENTRY, ShaderStage::Vertex) else {
        return Err(Problem::new(
            Place::new(shader.path.as_str(), 1, 1),
            format!("the shader has no `{VERTEX_ENTRY}`"),
        )
        .with_hint(format!("write `@vertex fn {VERTEX_ENTRY}(…)`")));
    };
    let wanted = fragment.and_then(|(_, f)| f.entry(FRAGMENT_ENTRY, ShaderStage::Fragment));
    let inputs = wanted.iter().flat_map(|entry| &entry.inputs);
    for input in inputs {
        check_input(input, given, &shader.path, pass)?;
    }
    Ok(())
}

/// Checks what a vertex stage that many passes share reads of vertices. Without `meshes` it covers the
/// screen and has none.
///
/// # Errors
/// The first input that there is not, or that is something else.
pub fn check_vertices(vertex: Reflected, meshes: bool) -> Result<(), Problem> {
    let entry = vertex.1.entry(VERTEX_ENTRY, ShaderStage::Vertex);
    let mut inputs = entry.iter().flat_map(|entry| &entry.inputs);
    let problem = if meshes {
        inputs.find_map(mesh_input)
    } else {
        inputs.next().map(|input| {
            Problem::new(
                input.at.clone(),
                format!(
                    "what covers the screen has no `@location({})`",
                    input.location
                ),
            )
            .with_hint("take `@builtin(vertex_index)`, which is 0, 1 and 2")
        })
    };
    problem.map_or(Ok(()), Err)
}

/// A stage that many passes share knows the scene and nothing of a pass.
fn shared(shader: &Shader, reflection: &Reflection) -> Result<(), Problem> {
    if let Some(variable) = reflection.variables.iter().find(|v| v.group > 0) {
        return Err(Problem::new(
            variable.at.clone(),
            format!(
                "`{}` is run by many passes, which have no `{}` for it",
                shader.path, variable.name
            ),
        )
        .with_hint("write a vertex stage into the shader of the pass that needs it"));
    }
    check_scene(shader, reflection)
        .into_iter()
        .next()
        .map_or(Ok(()), Err)
}

fn check_input(
    input: &Varying,
    vertex: &EntryPoint,
    vertex_path: &str,
    pass: &PassDesc,
) -> Result<(), Problem> {
    let location = input.location;
    let problem = |message: String, hint: String| {
        Err(Problem::new(input.at.clone(), message).with_hint(hint))
    };
    let mut outputs = vertex.outputs.iter();
    let Some(output) = outputs.find(|output| output.location == location) else {
        let kind = pass.kind.name();
        return problem(
            format!(
                "the vertex stage of the `{kind}` pass `{}` gives no @location({location})",
                pass.name
            ),
            gives(vertex, vertex_path),
        );
    };
    let name = output.name.as_deref().unwrap_or("its result");
    if input.ty.kind != output.ty.kind || input.ty.components > output.ty.components {
        return problem(
            format!(
                "@location({location}) is {}, but the vertex stage gives {} there, `{name}`",
                input.ty, output.ty
            ),
            gives(vertex, vertex_path),
        );
    }
    if (input.interpolation, input.sampling) != (output.interpolation, output.sampling) {
        return problem(
            format!(
                "@location({location}) is not interpolated as the vertex stage says for `{name}`"
            ),
            format!("write `@location({location}) {}`", output.interpolated()),
        );
    }
    Ok(())
}

/// What a vertex stage hands on, for hints.
fn gives(vertex: &EntryPoint, path: &str) -> String {
    let outputs: Vec<String> = vertex
        .outputs
        .iter()
        .map(|output| {
            let name = output.name.as_deref().unwrap_or("result");
            format!("{} {name} ({})", output.location, output.ty)
        })
        .collect();
    match outputs.as_slice() {
        [] => format!("`{path}` gives `@builtin(position)` alone"),
        outputs => format!("`{path}` gives {}", outputs.join(", ")),
    }
}

/// Checks that a shader which no pass names, but which passes need, has a fragment stage.
///
/// # Errors
/// It has none.
pub fn shades(path: &str, reflection: &Reflection) -> Result<(), Problem> {
    if reflection.has_fragment {
        return Ok(());
    }
    let message = format!("the shader has no `{FRAGMENT_ENTRY}`");
    Err(Problem::new(Place::new(path, 1, 1), message).with_hint("copy the shipped file again"))
}

/// Checks the shader of `mips` passes: it reads the larger level, and nothing else.
///
/// # Errors
/// The first thing that is not as the pass needs it.
pub fn links_mips(path: &str, reflection: &Reflection, kind: SampleKind) -> Result<(), Problem> {
    shades(path, reflection)?;
    for variable in &reflection.variables {
        let fits = match &variable.kind {
            BindingKind::Texture(texture) => {
                (variable.group, variable.binding) == (0, 0)
                    && texture.kind == kind
                    && texture.dimension == wgpu::TextureViewDimension::D2
                    && !texture.multisampled
            }
            _ => false,
        };
        if !fits {
            return Err(Problem::new(
                variable.at.clone(),
                format!("a `mips` pass has nothing for `{}`", variable.name),
            )
            .with_hint("it has the larger level, a texture_2d at @group(0) @binding(0)"));
        }
    }
    let entry = reflection.entry(FRAGMENT_ENTRY, ShaderStage::Fragment);
    let outputs: Vec<&Varying> = entry.iter().flat_map(|entry| &entry.outputs).collect();
    match outputs.as_slice() {
        [output] if output.location == 0 && output.ty.kind == kind && output.ty.components == 4 => {
            Ok(())
        }
        _ => Err(Problem::new(
            entry.map_or_else(|| Place::file(path), |entry| entry.at.clone()),
            "a `mips` pass writes one texel, @location(0), of four numbers",
        )
        .with_hint("copy the shipped file again")),
    }
}
