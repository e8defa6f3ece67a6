//! `lightbench check-pipeline`: every mistake of a pipeline at once.

use clap::Args;
use lightbench::assets::files::Files;
use lightbench::render::problem::counted;
use lightbench::render::{Gpu, Renderer};
use lightbench::script::{Settings, load_pipeline};

use super::arguments::GpuArguments;
use super::project;
use super::report::{self, Usage, say};

/// Arguments of `lightbench check-pipeline`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench check-pipeline scripts/pipelines/mine.rhai
  lightbench check-pipeline deferred_shading --portable
  lightbench check-pipeline mine --set accumulation=rgba32float

The whole description is checked, then every shader, and each mistake is printed with its file and
line. The exit status is 1 if there is one.")]
pub struct Arguments {
    /// A pipeline's name, as in `lightbench list pipelines`, or the path of a .rhai file
    #[arg(value_name = "PIPELINE")]
    pipeline: String,
    /// A value for one of its parameters, as in `--set tone_curve=linear`; may be given again
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    gpu: GpuArguments,
}

/// Runs the command.
///
/// # Errors
/// The mistakes of the pipeline, or no driver to check the shaders with.
pub fn run(arguments: &Arguments, mut files: Files) -> anyhow::Result<()> {
    let pipeline = project::script(&mut files, &arguments.pipeline)?;
    let mut settings = Settings::new();
    for text in &arguments.set {
        settings.set_from_text(text).map_err(Usage)?;
    }
    let desc = load_pipeline(&files, &pipeline, &settings)
        .map_err(|problems| report::problems(&files, problems))?;
    let renderer = Renderer::new(Gpu::open(&arguments.gpu.options())?);
    let compiled = renderer
        .compiler()
        .compile(&files, &desc)
        .map_err(|problems| report::problems(&files, problems))?;
    say(format!(
        "{}: {}, {}, no mistakes",
        files.display(&desc.file.file),
        counted(desc.targets.len(), "target"),
        counted(desc.passes.len(), "pass")
    ))?;
    for name in compiled.lives().dropped(&compiled.desc) {
        say(format!(
            "the pass `{name}` is left out: nobody uses what it writes"
        ))?;
    }
    for note in &compiled.notes {
        say(note.as_str())?;
    }
    for ability in &desc.abilities {
        let can = if ability.supported {
            "can do"
        } else {
            "can't do"
        };
        say(format!("{can} {}: {}", ability.name, ability.text))?;
    }
    let needs = desc.features_needed();
    if !needs.is_empty() {
        say(format!(
            "needs beyond WebGPU's default: {}",
            needs.join(", ")
        ))?;
    }
    Ok(())
}
