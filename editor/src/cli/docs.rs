//! `lightbench docs`: the reference, from what the program knows of itself.

use std::path::PathBuf;

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
}

/// Arguments of `lightbench docs`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench docs pipelines --out pipelines.md
  lightbench docs shaders | less

The pages are Markdown. They are made from the functions that are registered with the engine and from
the files of the shader library, so they fit the program that prints them.")]
pub struct Arguments {
    /// The page to print
    #[arg(value_name = "PAGE")]
    page: Page,
    /// The file to write instead of the standard output
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Prints or writes a page.
///
/// # Errors
/// A file of the project that can't be read, or a file that can't be written.
pub fn run(arguments: &Arguments, files: &Files) -> anyhow::Result<()> {
    let text = match arguments.page {
        Page::Pipelines => reference::pipelines(files)?,
        Page::Api => reference::api(),
        Page::Abilities => reference::abilities(files)?,
        Page::Shaders => reference::shaders(files)?,
        Page::Experiments => reference::experiments(),
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
