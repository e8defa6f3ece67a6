//! `lightbench diff`: how far apart two pictures are.

use std::path::PathBuf;

use clap::Args;
use lightbench::lab::colormap::ColorMap;
use lightbench::lab::diff::{DiffOptions, diff_files};
use lightbench::lab::files::write_atomically;
use lightbench::lab::heatmap::heat_map_with_legend;
use lightbench::lab::metrics::FlipOptions;

use super::report::{Usage, say};

/// Arguments of `lightbench diff`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench diff reference.png mine.png
  lightbench diff reference.exr mine.exr --heat-map difference.png

Two PNG files are compared as a display shows them, two EXR files in linear light. FLIP is 0 where
nobody sees a difference and 1 where it is largest; below 0.01 in the mean, pictures look the same.")]
pub struct Arguments {
    /// The picture that counts as right: PNG, JPEG, TGA, BMP, EXR or HDR
    #[arg(value_name = "REFERENCE")]
    reference: PathBuf,
    /// The picture that is compared with it, of the same size and kind
    #[arg(value_name = "PICTURE")]
    test: PathBuf,
    /// Where to write a picture of the difference: FLIP of each pixel, with a legend
    #[arg(long, value_name = "FILE.png")]
    heat_map: Option<PathBuf>,
    /// FLIP above which a pixel counts as differing
    #[arg(long, value_name = "FLIP", default_value_t = DiffOptions::default().bound)]
    bound: f64,
    /// Pixels that one degree of sight covers; 67 is a 0.7 m wide 4K display at 0.7 m
    #[arg(long, value_name = "PIXELS", default_value_t = FlipOptions::DEFAULT_PIXELS_PER_DEGREE)]
    pixels_per_degree: f64,
    /// Print all numbers as JSON
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// Files that can't be read, pictures of different size or kind, a place that can't be written.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    if let Some(path) = &arguments.heat_map
        && path
            .extension()
            .is_none_or(|extension| !extension.eq_ignore_ascii_case("png"))
    {
        let message = format!(
            "--heat-map {}: name a file that ends in .png",
            path.display()
        );
        return Err(Usage(message).into());
    }
    let options = DiffOptions {
        flip: FlipOptions {
            pixels_per_degree: arguments.pixels_per_degree,
        },
        bound: arguments.bound,
    };
    let found = diff_files(&arguments.reference, &arguments.test, options)?;
    if let Some(path) = &arguments.heat_map {
        let picture = heat_map_with_legend(found.map(), ColorMap::Magma, 1.0);
        write_atomically(path, &picture.to_png()?)?;
    }
    if arguments.json {
        return say(serde_json::to_string_pretty(&found.to_json())?);
    }
    let lines = found.lines();
    let width = lines.iter().map(|line| line.name.chars().count()).max();
    for line in &lines {
        let name = &line.name;
        say(format!(
            "{name:<width$}  {}",
            line.value,
            width = width.unwrap_or(0)
        ))?;
    }
    Ok(())
}
