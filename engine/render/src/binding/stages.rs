//! Entry points, outputs and parameters of a shader against the pass that uses it.

use naga::ShaderStage;

use super::Binder;
use crate::description::{BlendFactor, ColorAttachment, ParameterKind, PassKind, TargetDesc};
use crate::problem::{Place, Problem, suggestion};
use crate::reflection::{
    BindingKind, COMPUTE_ENTRY, EntryPoint, FRAGMENT_ENTRY, NumberType, SampleKind, VERTEX_ENTRY,
    Varying,
};
use crate::validate::FormatSupport;

/// The stages that a shader may have, with what marks them and the names of their entry points.
const STAGES: [(ShaderStage, &str, &str); 3] = [
    (ShaderStage::Vertex, "@vertex", VERTEX_ENTRY),
    (ShaderStage::Fragment, "@fragment", FRAGMENT_ENTRY),
    (
        ShaderStage::Compute,
        "@compute @workgroup_size(8, 8)",
        COMPUTE_ENTRY,
    ),
];

impl<S: FormatSupport> Binder<'_, S> {
    /// The shader has the entry points that the kind of pass runs, and they fit its attachments.
    pub(super) fn stages(&mut self) {
        self.one_of_each();
        let wanted = self.wanted();
        let reflection = self.reflection;
        for (stage, mark, name) in STAGES {
            match reflection.entry(name, stage) {
                None if stage == wanted => self.no_entry(stage, mark, name),
                Some(entry) if stage == ShaderStage::Fragment && stage == wanted => {
                    self.outputs(entry);
                }
                Some(entry) if stage == ShaderStage::Vertex && wanted == ShaderStage::Fragment => {
                    self.own_vertex(entry);
                }
                None if stage == ShaderStage::Vertex && self.pulls_vertices() => {
                    let at = self.pass.shader.as_ref().map(|shader| &shader.at);
                    self.fetches_nothing(at.unwrap_or(&self.pass.at));
                }
                _ => {}
            }
        }
    }

    fn pulls_vertices(&self) -> bool {
        matches!(&self.pass.kind, PassKind::Geometry(geometry) if geometry.pull_vertices)
    }

    /// A pass that draws without vertex buffers has a shader that reads them, or that has no vertex
    /// stage.
    fn fetches_nothing(&mut self, at: &Place) {
        let message = format!(
            "`{}` pulls its vertices, but `{}` has no vertex stage that fetches them",
            self.pass.name, self.shader.path
        );
        self.report(
            at,
            message,
            "write `@vertex fn vertex_main(@builtin(vertex_index) …)` without @location inputs, and \
             fetch from `mesh_indices` and `mesh_positions`",
        );
    }

    /// The stage that the pass can't do without.
    fn wanted(&self) -> ShaderStage {
        match self.pass.kind {
            PassKind::Compute(_) => ShaderStage::Compute,
            _ => ShaderStage::Fragment,
        }
    }

    /// Whether the shader is of another kind altogether: it has entry points, but none of the stage
    /// that the pass runs.
    pub(super) fn is_alien(&self) -> bool {
        let wanted = self.wanted();
        let entries = &self.reflection.entry_points;
        !entries.is_empty() && entries.iter().all(|entry| entry.stage != wanted)
    }

    /// No two entry points of one stage, and none that has the name of another stage's.
    fn one_of_each(&mut self) {
        let reflection = self.reflection;
        for (stage, mark, name) in STAGES {
            let mut others = reflection.entry_points.iter();
            if let Some(other) = others.find(|e| e.name == name && e.stage != stage) {
                self.report(
                    &other.at,
                    format!("`{name}` is marked {}", mark_of(other.stage)),
                    format!("write `{mark}` before it"),
                );
            }
            let of_stage = || reflection.entry_points.iter().filter(|e| e.stage == stage);
            if of_stage().count() > 1
                && let Some(extra) = of_stage().find(|entry| entry.name != name)
            {
                let first = of_stage().find(|entry| entry.name != extra.name);
                self.report(
                    &extra.at,
                    format!(
                        "`{}` is a second {} stage beside `{}`",
                        extra.name,
                        word(stage),
                        first.map_or(name, |first| first.name.as_str())
                    ),
                    format!("a shader has one, `{name}`; put the other into a file of its own"),
                );
            }
        }
    }

    fn no_entry(&mut self, stage: ShaderStage, mark: &str, name: &str) {
        let reflection = self.reflection;
        let entries = || reflection.entry_points.iter();
        if entries().any(|entry| entry.name == name) {
            // It was told already that it is of another stage.
            return;
        }
        let path = self.shader.path.as_str();
        let message = format!("the shader has no `{name}`");
        // One of the stage under another name, or under nearly this one.
        let of_stage = entries().find(|entry| entry.stage == stage);
        let near = || entries().find(|entry| suggestion(name, [entry.name.as_str()]).is_some());
        if let Some(entry) = of_stage.or_else(near) {
            let hint = format!("rename `{}` to `{name}`", entry.name);
            self.report(&entry.at, message, hint);
            return;
        }
        let function = self.shader.listings.function(name);
        if function.line > 0 {
            let hint = format!("write `{mark}` before it");
            self.report(&function, format!("`{name}` is marked as no stage"), hint);
            return;
        }
        let place = self.pass.shader.as_ref().map(|shader| shader.at.clone());
        let kind = self.pass.kind.name();
        self.report(
            &place.unwrap_or_else(|| Place::file(path)),
            format!("`{path}` has no `{name}`, which a `{kind}` pass runs"),
            format!("write `{mark} fn {name}(…)` in the shader, or name another file"),
        );
    }

    /// What a vertex stage of the shader's own may read.
    fn own_vertex(&mut self, entry: &EntryPoint) {
        match self.pass.kind {
            PassKind::Lights(_) => self.report(
                &entry.at,
                format!("a `lights` pass never runs `{VERTEX_ENTRY}`"),
                "remove it: the pass draws the volumes of its lights by itself",
            ),
            PassKind::Fullscreen => {
                if let Some(input) = entry.inputs.first() {
                    self.report(
                        &input.at,
                        format!(
                            "a fullscreen pass has no vertices, so nothing for `@location({})`",
                            input.location
                        ),
                        "take `@builtin(vertex_index)`, which is 0, 1 and 2",
                    );
                }
            }
            PassKind::Geometry(_) if self.pulls_vertices() => {
                if let Some(input) = entry.inputs.first() {
                    self.fetches_nothing(&input.at);
                }
            }
            _ => self
                .problems
                .extend(entry.inputs.iter().filter_map(mesh_input)),
        }
        let reflection = self.reflection;
        for variable in reflection.targets() {
            let writable = matches!(
                variable.kind,
                BindingKind::Buffer { writable: true } | BindingKind::StorageTexture { .. }
            );
            if writable && entry.uses.contains(&(1, variable.binding)) {
                self.report(
                    &entry.at,
                    format!(
                        "`{VERTEX_ENTRY}` uses `{}`, which can be written",
                        variable.name
                    ),
                    "only fragment stages and compute shaders write: declare a buffer as \
                     `var<storage, read>`, and write it in another pass",
                );
            }
        }
    }

    /// The fragment stage writes each colour target, with the kind of numbers that it holds.
    fn outputs(&mut self, entry: &EntryPoint) {
        let (pass, desc) = (self.pass, self.desc);
        for (index, color) in pass.colors.iter().enumerate() {
            let Some(target) = desc.target(&color.target) else {
                continue;
            };
            let mut outputs = entry.outputs.iter();
            match outputs.find(|output| output.location as usize == index) {
                None => self.report(
                    &entry.at,
                    format!(
                        "the shader has no output @location({index}) for `{}`",
                        target.name
                    ),
                    "outputs are numbered in the order of the pass's .writes",
                ),
                Some(output) => self.output(output, color, target),
            }
        }
        let count = pass.colors.len();
        for output in &entry.outputs {
            if output.location as usize >= count {
                let targets = match count {
                    0 => "no colour target".to_owned(),
                    1 => "one colour target".to_owned(),
                    count => format!("{count} colour targets"),
                };
                self.report(
                    &output.at,
                    format!(
                        "the shader writes @location({}), but the pass `{}` has {targets}",
                        output.location, pass.name
                    ),
                    match pass.kind {
                        PassKind::Shadow(_) => "remove the output: a shadow pass keeps depth alone",
                        _ => {
                            "add a .writes to the pass, or remove the output; outputs are counted \
                             from 0"
                        }
                    },
                );
            }
        }
        if let Some(at) = &entry.writes_depth
            && pass.depth.is_none()
        {
            self.report(
                at,
                format!(
                    "the shader writes depth, but the pass `{}` has no depth target",
                    pass.name
                ),
                "add .depth(\"depth\") to the pass, or remove `@builtin(frag_depth)`",
            );
        }
    }

    fn output(&mut self, output: &Varying, color: &ColorAttachment, target: &TargetDesc) {
        let wanted = NumberType {
            kind: SampleKind::of_format(target.format.0),
            components: target.format.0.components(),
        };
        let location = output.location;
        if output.ty.kind != wanted.kind {
            self.report(
                &output.at,
                format!(
                    "@location({location}) gives {}, but the target `{}` is {}",
                    output.ty.kind.in_words(),
                    target.name,
                    target.format
                ),
                format!("declare it as `{wanted}`"),
            );
        } else if output.ty.components < wanted.components {
            self.report(
                &output.at,
                format!(
                    "@location({location}) is {}, but the target `{}` is {}, with {} channels",
                    output.ty, target.name, target.format, wanted.components
                ),
                format!("declare it as `{wanted}`"),
            );
        } else if output.ty.components < 4 && asks_for_alpha(color) {
            self.report(
                &output.at,
                format!(
                    "@location({location}) is {}, but `{}` is blended by alpha",
                    output.ty, target.name
                ),
                "declare it as `vec4f`; the last number is alpha",
            );
        }
    }

    /// Group 2 is the parameters; each of its members is one of the pipeline, of the right type.
    pub(super) fn parameters(&mut self) {
        let (desc, reflection) = (self.desc, self.reflection);
        for variable in reflection.variables.iter().filter(|v| v.group == 2) {
            let uniform = variable.kind == BindingKind::Uniform;
            let named = self
                .pass
                .reads
                .iter()
                .any(|read| read.variable == variable.name)
                || self
                    .pass
                    .updates
                    .iter()
                    .any(|u| u.variable == variable.name);
            // A target in the wrong group was told of already.
            if (variable.binding != 0 || !uniform || reflection.parameters.is_none()) && !named {
                self.report(
                    &variable.at,
                    format!("`{}` is not what group 2 holds", variable.name),
                    "group 2 has one variable, a structure of numbers: `@group(2) @binding(0) \
                     var<uniform> parameters: Parameters;`",
                );
            }
        }
        let members = reflection.parameters.iter();
        for member in members.flat_map(|(members, _)| members) {
            let Some(parameter) = desc.parameter(&member.name) else {
                let names = desc.parameters.iter().map(|p| p.name.as_str());
                let hint = suggestion(&member.name, names).unwrap_or_else(|| {
                    format!("declare it: p.number(\"{}\", 1.0, 0.0, 10.0)", member.name)
                });
                self.report(
                    &member.at,
                    format!("the pipeline has no parameter `{}`", member.name),
                    hint,
                );
                continue;
            };
            let (wanted, name) = match parameter.kind {
                ParameterKind::Number { .. } => (SampleKind::Float, "f32"),
                ParameterKind::Switch | ParameterKind::Choice { .. } => (SampleKind::Uint, "u32"),
            };
            if member.kind != Some(wanted) {
                self.report(
                    &member.at,
                    format!("the parameter `{}` reaches shaders as {name}", member.name),
                    format!("declare it as `{}: {name}`", member.name),
                );
            }
        }
    }
}

/// What is wrong with an input of a vertex stage that draws meshes: they have positions in one stream
/// and the rest of their vertices in another.
pub(super) fn mesh_input(input: &Varying) -> Option<Problem> {
    let location = input.location;
    let streams = [
        ("position", 3),
        ("normal", 3),
        ("texture coordinates", 2),
        ("tangent", 4),
    ];
    let Some((what, components)) = streams.get(location as usize).copied() else {
        let message = format!("meshes have nothing at `@location({location})`");
        return Some(Problem::new(input.at.clone(), message).with_hint(
            "they have 0 position (vec3f), 1 normal (vec3f), 2 texture coordinates (vec2f), 3 tangent \
             (vec4f)",
        ));
    };
    let wanted = NumberType {
        kind: SampleKind::Float,
        components,
    };
    (input.ty != wanted).then(|| {
        let message = format!(
            "`@location({location})` of a mesh is its {what}, a {wanted}, not a {}",
            input.ty
        );
        Problem::new(input.at.clone(), message).with_hint(format!("declare it as `{wanted}`"))
    })
}

/// Whether the output's alpha takes part in blending.
fn asks_for_alpha(color: &ColorAttachment) -> bool {
    let alpha = [BlendFactor::SourceAlpha, BlendFactor::OneMinusSourceAlpha];
    color.blend.parts().is_some_and(|(color, other)| {
        [color, other]
            .iter()
            .any(|part| alpha.contains(&part.source) || alpha.contains(&part.destination))
    })
}

fn word(stage: ShaderStage) -> &'static str {
    match stage {
        ShaderStage::Vertex => "vertex",
        ShaderStage::Fragment => "fragment",
        _ => "compute",
    }
}

fn mark_of(stage: ShaderStage) -> &'static str {
    match stage {
        ShaderStage::Vertex => "@vertex",
        ShaderStage::Fragment => "@fragment",
        _ => "@compute",
    }
}
