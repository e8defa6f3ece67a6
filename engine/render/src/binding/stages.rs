//! Entry points, outputs and parameters of a shader against the pass that uses it.

use super::{Binder, declaration};
use crate::description::{ParameterKind, PassKind};
use crate::problem::{Place, Problem, suggestion};
use crate::reflection::{COMPUTE_ENTRY, FRAGMENT_ENTRY, Reflection, SampleKind};

impl Binder<'_> {
    /// The shader has the entry points that the kind of pass runs, and they fit its attachments.
    pub(super) fn stages(&mut self, reflection: &Reflection) {
        if matches!(self.pass.kind, PassKind::Compute(_)) {
            if reflection.workgroup_size.is_none() {
                self.no_entry(reflection, COMPUTE_ENTRY, "@compute @workgroup_size(8, 8)");
            }
        } else if reflection.has_fragment {
            self.outputs(reflection);
        } else {
            self.no_entry(reflection, FRAGMENT_ENTRY, "@fragment");
        }
    }

    fn no_entry(&mut self, reflection: &Reflection, entry: &str, stage: &str) {
        let path = self.shader.path.as_str();
        let names = reflection.entry_points.iter().map(String::as_str);
        let (place, hint) = match suggestion(entry, names.clone()) {
            Some(_) => {
                // The suggestion is for the reader's name, so it goes the other way round.
                let close = names
                    .clone()
                    .find(|name| suggestion(entry, std::iter::once(*name)).is_some())
                    .unwrap_or_default();
                (
                    declaration(self.shader, close),
                    format!("rename `{close}` to `{entry}`"),
                )
            }
            None => (Place::file(path), format!("write `{stage} fn {entry}(…)`")),
        };
        self.problems.push(
            Problem::new(place, format!("the shader has no `{entry}`"))
                .with_source(&self.shader.text)
                .with_hint(hint),
        );
    }

    /// The fragment stage writes each colour target, with the kind of numbers that it holds.
    fn outputs(&mut self, reflection: &Reflection) {
        let pass = self.pass;
        for (index, color) in pass.colors.iter().enumerate() {
            let Some(target) = self.desc.target(&color.target) else {
                continue;
            };
            let wanted = SampleKind::of_format(target.format.0);
            let output = reflection
                .outputs
                .iter()
                .find(|(location, _)| *location as usize == index);
            match output {
                None => self.report(
                    FRAGMENT_ENTRY,
                    format!(
                        "the shader has no output @location({index}) for `{}`",
                        target.name
                    ),
                    "outputs are numbered in the order of the pass's .writes",
                ),
                Some((_, kind)) if *kind != wanted => self.report(
                    FRAGMENT_ENTRY,
                    format!(
                        "@location({index}) gives {}, but the target `{}` is {}",
                        kind.in_words(),
                        target.name,
                        target.format
                    ),
                    format!("make the output {}", wanted.in_words()),
                ),
                Some(_) => {}
            }
        }
        for (location, _) in &reflection.outputs {
            if *location as usize >= pass.colors.len() {
                self.problems.push(
                    Problem::new(
                        pass.at.clone(),
                        format!(
                            "`{}` writes @location({location}), but the pass has {} colour targets",
                            self.shader.path,
                            pass.colors.len()
                        ),
                    )
                    .with_hint("add a .writes to the pass, or remove the output"),
                );
            }
        }
    }

    /// Each member of the shader's `parameters` is a parameter of the pipeline, of the right type.
    pub(super) fn parameters(&mut self, reflection: &Reflection) {
        let desc = self.desc;
        let members = reflection.parameters.iter();
        for member in members.flat_map(|(members, _)| members) {
            let Some(parameter) = desc.parameter(&member.name) else {
                let names = desc.parameters.iter().map(|p| p.name.as_str());
                let hint = suggestion(&member.name, names).unwrap_or_else(|| {
                    format!("declare it: p.number(\"{}\", 1.0, 0.0, 10.0)", member.name)
                });
                self.report(
                    &member.name,
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
                    &member.name,
                    format!("the parameter `{}` reaches shaders as {name}", member.name),
                    format!("declare it as `{}: {name}`", member.name),
                );
            }
        }
    }
}
