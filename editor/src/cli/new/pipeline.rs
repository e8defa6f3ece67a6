//! `lightbench new pipeline`: a pipeline that draws, for somebody to change.

use anyhow::bail;
use lightbench::assets::files::{FileError, Files, Origin, find_project};
use lightbench::script::PIPELINES;

use super::{name, title};
use crate::cli::report::{Usage, note, say};

/// The files that are made. In both, `NAME` stands for the pipeline's name, and `TITLE` for the
/// same as people write it.
const PIPELINE: &str = include_str!("template/pipeline.rhai");
const SHADER: &str = include_str!("template/shade.wgsl");

/// Makes the files in the project and says what to do with them.
///
/// # Errors
/// No project, a name that is taken or can't be a file's, or a folder that can't be written.
pub fn make(name: &str, files: &Files) -> anyhow::Result<()> {
    name::check(name, "pipeline").map_err(Usage)?;
    let pipeline = format!("{PIPELINES}/{name}.rhai");
    if files.project().is_none() {
        return Err(FileError::NoProject { path: pipeline }.into());
    }
    refuse_taken(name, files)?;
    let filled = |template: &str| {
        template
            .replace("NAME", name)
            .replace("TITLE", &title(name))
    };
    // The shader first: a pipeline whose shader is missing would be listed with a mistake.
    let shader = files.create(
        &format!("shaders/{name}/shade.wgsl"),
        filled(SHADER).as_bytes(),
    )?;
    let pipeline = files.create(&pipeline, filled(PIPELINE).as_bytes())?;
    say(pipeline.display().to_string())?;
    say(shader.display().to_string())?;
    note("Next:");
    if let Some(project) = files.project()
        && find_project(".").as_deref() != Some(project)
    {
        note(format!("  cd \"{}\"", project.display()));
    }
    note(format!(
        "  lightbench check-pipeline {name}\n  \
         lightbench render cornell_box --pipeline {name} --out out/{name}.png\n  \
         lightbench edit --pipeline {name}\n\
         Change a file and save it, and the picture in the editor follows.\n\
         What else a pipeline can say: lightbench docs pipelines"
    ));
    Ok(())
}

/// A name that differs only in small and capital letters is the same on some systems.
fn refuse_taken(name: &str, files: &Files) -> anyhow::Result<()> {
    let same = |path: &str, other: &str| path.to_lowercase() == other.to_lowercase();
    let file = format!("{PIPELINES}/{name}.rhai");
    let pipelines = files.list(PIPELINES, "rhai")?;
    if let Some(taken) = pipelines.iter().find(|found| same(&found.path, &file)) {
        match &taken.origin {
            Origin::Shipped => bail!(
                "the program has a pipeline of that name, {path}, which yours would hide; choose \
                 another name, or take that one to change it: lightbench copy {path}",
                path = taken.path
            ),
            Origin::Project(place) => bail!(
                "there is {} already; choose another name, or change that file",
                place.display()
            ),
        }
    }
    let shaders = files.list("shaders", "")?;
    let folders = shaders.iter().filter_map(|found| {
        let (folder, _) = found.path.strip_prefix("shaders/")?.split_once('/')?;
        Some(folder)
    });
    let taken = folders.into_iter().find(|folder| same(folder, name));
    if let Some(taken) = taken {
        bail!("there are shaders in shaders/{taken}/ already; choose another name");
    }
    Ok(())
}
