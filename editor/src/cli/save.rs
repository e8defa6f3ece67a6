//! `lightbench save`: a scene as a file that holds its world.

use std::path::PathBuf;

use anyhow::anyhow;
use clap::Args;
use lightbench::assets::files::Files;
use lightbench::script::SCENE_EXTENSION;

use super::arguments::SceneArguments;
use super::load;
use super::project;
use super::report::{Usage, say, warn};

/// Arguments of `lightbench save`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench save atrium --out scripts/scenes/my_atrium.scene
  lightbench save many_lights --set lights=256 --frame 60 --out later.scene
  lightbench render later.scene --out later.png

The file is text: entities with their components, and how each mesh, material and texture is made.
Models and pictures stay where they are and are named by their paths. The script's `update` is not
part of it.")]
pub struct Arguments {
    /// A scene's name, as in `lightbench list scenes`, or the path of a .rhai or .scene file
    #[arg(value_name = "SCENE")]
    scene: String,
    /// Which frame, from 0; the scene takes 60 steps a second
    #[arg(long, value_name = "N", default_value_t = 0)]
    frame: u32,
    /// The file to write; it ends in .scene
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    #[command(flatten)]
    scene_arguments: SceneArguments,
}

/// Runs the command.
///
/// # Errors
/// A scene with mistakes, one that can't be saved, or a file that can't be written.
pub fn run(arguments: &Arguments, mut files: Files) -> anyhow::Result<()> {
    let extension = arguments.out.extension().and_then(|end| end.to_str());
    if extension != Some(SCENE_EXTENSION) {
        let out = arguments.out.display();
        return Err(Usage(format!(
            "--out {out}: a scene file ends in .{SCENE_EXTENSION}"
        ))
        .into());
    }
    project::writable(&arguments.out)?;
    let (name, given) = (&arguments.scene, &arguments.scene_arguments);
    let mut scene = load::moment(&mut files, name, given, arguments.frame)?;
    load::tell(&files, &mut scene);
    if scene.has_update() {
        warn("the script's `update` is not part of the file: what only it moves will stand still");
    }
    let saved = scene.save(&arguments.out);
    saved.map_err(|problem| anyhow!("{}", problem.message))?;
    say(arguments.out.display().to_string())
}
