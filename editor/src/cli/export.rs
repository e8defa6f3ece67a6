//! `lightbench export`: a scene for another renderer.

use std::path::PathBuf;

use clap::Args;
use lightbench::assets::files::Files;
use lightbench::lab::mitsuba;
use lightbench::render::View;

use super::arguments::{SceneArguments, Size};
use super::load;
use super::report::{say, warn};

/// Arguments of `lightbench export`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench export cornell_box --set bounces=false --mitsuba out/box
  mitsuba -m llvm_ad_rgb out/box/scene.xml

Mitsuba 3 has other reflection models and other falloffs. What has no counterpart is left out and named,
on the terminal and in the file.")]
pub struct Arguments {
    /// A scene's name, as in `lightbench list scenes`, or the path of a .rhai or .scene file
    #[arg(value_name = "SCENE")]
    scene: String,
    /// The folder for Mitsuba's scene.xml, with meshes and textures beside it
    #[arg(long, value_name = "DIR", required = true)]
    mitsuba: PathBuf,
    /// Width and height of the picture that the scene asks for
    #[arg(long, value_name = "WxH", default_value = "640x360")]
    size: Size,
    /// Which frame, from 0; the scene takes 60 steps a second
    #[arg(long, value_name = "N", default_value_t = 0)]
    frame: u32,
    #[command(flatten)]
    scene_arguments: SceneArguments,
}

/// Runs the command.
///
/// # Errors
/// A scene with mistakes, or a folder that can't be written.
pub fn run(arguments: &Arguments, mut files: Files) -> anyhow::Result<()> {
    let (name, given) = (&arguments.scene, &arguments.scene_arguments);
    let mut scene = load::moment(&mut files, name, given, arguments.frame)?;
    load::tell(&files, &mut scene);
    let view = View::from_world(&scene.world).unwrap_or_default();
    let size = arguments.size.into();
    let folder = &arguments.mitsuba;
    let exported = mitsuba::export(&scene.world, &scene.assets, &view, size, folder)?;
    for what in &exported.left_out {
        warn(format!("not exported: {what}"));
    }
    say(exported.scene.display().to_string())
}
