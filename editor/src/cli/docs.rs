//! `lightbench docs`: the reference, from what the program knows of itself.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use clap::{Args, ValueEnum};
use lightbench::assets::files::{Files, write_atomic};
use lightbench::script::reference;

use super::project;
use super::report::say;

/// Which page.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Page {
    /// Every function of pipeline files, by kind of pass, with a whole example of each
    Pipelines,
    /// Every function of scene scripts and behaviours, with an example of each
    Api,
    /// The pipelines side by side: what each can do, what it trades and when to choose it
    Abilities,
    /// What shaders can import: the modules of shaders/lib, with those of the project
    Shaders,
    /// What experiments can call, to draw frames and look into them
    Experiments,
    /// What the checks of lessons can call, to judge what was handed in
    Checks,
    /// Definition files (.d.rhai) of all kinds of scripts, for text editors that know Rhai
    Definitions,
}

/// Arguments of `lightbench docs`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench docs pipelines --out pipelines.md
  lightbench docs shaders | less
  lightbench docs definitions --out .rhai/definitions

The pages are Markdown. They are made from the functions that are registered with the engine and from
the files of the shader library, so they fit the program that prints them.")]
pub struct Arguments {
    /// The page to print
    #[arg(value_name = "PAGE")]
    page: Page,
    /// The file to write instead of the standard output; for definitions, the folder
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Prints or writes a page.
///
/// # Errors
/// A file of the project that can't be read, or a file that can't be written.
pub fn run(arguments: &Arguments, files: &Files) -> anyhow::Result<()> {
    if arguments.page == Page::Definitions {
        return definitions(arguments.out.as_deref());
    }
    let text = match arguments.page {
        Page::Pipelines => reference::pipelines(files)?,
        Page::Api => reference::api(),
        Page::Abilities => reference::abilities(files)?,
        Page::Shaders => reference::shaders(files)?,
        Page::Experiments => reference::experiments(),
        Page::Checks => reference::checks(),
        Page::Definitions => String::new(),
    };
    match &arguments.out {
        Some(out) => {
            project::writable(out)?;
            write_atomic(out, text.as_bytes())?;
            say(out.display().to_string())
        }
        None => say(text.trim_end()),
    }
}

/// Writes the definition files into a folder, which is made where it is not there; without one, prints
/// them all.
fn definitions(out: Option<&Path>) -> anyhow::Result<()> {
    let Some(folder) = out else {
        let texts = reference::definitions().into_iter().map(|one| one.text);
        return say(texts.collect::<Vec<_>>().join("\n").trim_end());
    };
    std::fs::create_dir_all(folder).with_context(|| format!("--out {}", folder.display()))?;
    for reference::Definitions { file, text } in reference::definitions() {
        let path = folder.join(file);
        write_atomic(&path, text.as_bytes())?;
        say(path.display().to_string())?;
    }
    Ok(())
}
