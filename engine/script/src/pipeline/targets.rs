//! Targets of a pipeline.

use lightbench_render::Format;
use lightbench_render::description::{TargetDesc, TargetSize};
use lightbench_render::problem::suggestion;

use super::builder::{Pipeline, problem, shader_name};
use crate::api::{Api, Mistake, ScriptType};

/// The largest side of a target, which every adapter can do.
const MAX_SIDE: i64 = 8192;

/// A target, as scripts hold it.
#[derive(Clone, Debug)]
struct Target {
    pipeline: Pipeline,
    /// Its place in the description; `None` where its declaration has a mistake.
    index: Option<usize>,
}

impl ScriptType for Target {
    const NAME: &'static str = "target";
}

impl Target {
    fn resize(&self, size: TargetSize) {
        if let Some(index) = self.index {
            self.pipeline.lock().desc.targets[index].size = size;
        }
    }
}

pub(super) fn register(api: &mut Api) {
    api.object::<Target>();
    api.method(
        "target(name, format)",
        "Declares a texture that passes write and read, as large as the output. The format is a \
         WebGPU name, as in `rgba16float`.",
        |pipeline: Pipeline, arguments| {
            let mut index = None;
            pipeline.note(arguments, |builder, at| {
                let name = arguments.text(0)?;
                shader_name(&name, "a target")?;
                if let Some(first) = builder.desc.target(&name) {
                    return Err(Mistake::new(format!(
                        "there is a target `{name}` already, in line {} of {}",
                        first.at.line, first.at.file
                    )));
                }
                let asked = arguments.text(1)?;
                let mut format = Format::from_name(&asked);
                if format.is_none() {
                    let names: Vec<String> = Format::names().collect();
                    let mistake = Mistake::new(format!("there is no format `{asked}`"));
                    let hint = suggestion(&asked, names.iter().map(String::as_str))
                        .unwrap_or_else(|| format!("there are {}", names.join(", ")));
                    let problem = problem(at.clone(), mistake.with_hint(hint));
                    builder.problems.push(problem);
                    // The target is declared all the same, so that its uses are no mistakes too.
                    format = names.first().and_then(|name| Format::from_name(name));
                }
                if let Some(format) = format {
                    index = Some(builder.desc.targets.len());
                    builder.desc.targets.push(TargetDesc {
                        name,
                        at,
                        format,
                        size: TargetSize::Relative(1.0),
                    });
                }
                Ok(())
            });
            Ok(Target { pipeline, index })
        },
    );
    api.method(
        "scale(factor)",
        "Makes the target smaller or larger than the output, by a factor from 1/64 to 4.",
        |target: Target, arguments| {
            target.pipeline.note(arguments, |_, _| {
                arguments.number_in(0, 1.0 / 64.0, 4.0).map(|_| ())
            });
            if let Ok(factor) = arguments.number_in(0, 1.0 / 64.0, 4.0) {
                target.resize(TargetSize::Relative(factor as f32));
            }
            Ok(target)
        },
    );
    api.method(
        "size(width, height)",
        "Gives the target a fixed size in texels.",
        |target: Target, arguments| {
            let sides = || {
                let width = arguments.whole(0, 1, MAX_SIDE)?;
                let height = arguments.whole(1, 1, MAX_SIDE)?;
                Ok((width as u32, height as u32))
            };
            target
                .pipeline
                .note(arguments, |_, _| sides().map(|_: (u32, u32)| ()));
            if let Ok((width, height)) = sides() {
                target.resize(TargetSize::Absolute(width, height));
            }
            Ok(target)
        },
    );
}
