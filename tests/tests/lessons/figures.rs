//! The figures of the texts are what the program renders from the solutions.
//!
//! `LIGHTBENCH_UPDATE=1` (`./x docs`) writes them anew instead of comparing them.

use std::fs;

use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::lab::LdrImage;
use lightbench::lab::capture::{CaptureOptions, capture};
use lightbench::lab::diff::{DiffOptions, diff_ldr};
use lightbench::lab::lesson::{FORMULAS, Language};
use lightbench::render::{Gpu, GpuOptions, Renderer};
use lightbench::script::{Settings, load_pipeline, load_scene};

use super::{all, solved};

/// Pictures of other versions of the driver may differ so much (FLIP, mean).
const SAME_PICTURE: f64 = 0.005;

#[test]
fn figures_are_what_the_solutions_draw() {
    let update = std::env::var_os("LIGHTBENCH_UPDATE").is_some();
    let mut renderer = Renderer::new(Gpu::open(&GpuOptions::default()).unwrap());
    for (folder, lesson) in all() {
        let work = solved(&folder);
        let files = Files::with_project(work.path()).unwrap();
        let progress = Progress::new();
        let desc = load_pipeline(&files, &lesson.about.pipeline, &Settings::new()).unwrap();
        // Of its own, since a compiler knows shaders by their paths.
        let mut pipeline = renderer.compiler().compile(&files, &desc).unwrap();
        let mut drawn = Vec::new();
        for figure in &lesson.about.figures {
            let mut settings = Settings::new();
            for text in &figure.set {
                settings.set_from_text(text).unwrap();
            }
            let mut scene = load_scene(&files, &lesson.about.scene, &settings, &progress).unwrap();
            renderer.reset_scene();
            let [width, height] = figure.size;
            let options = CaptureOptions {
                size: (width, height),
                frame: 0,
            };
            let picture =
                capture(&mut renderer, &mut scene, &mut pipeline, options, &progress).unwrap();
            let file = folder.join(&figure.file);
            if update {
                fs::create_dir_all(file.parent().unwrap()).unwrap();
                fs::write(&file, picture.output.to_png().unwrap()).unwrap();
            }
            let kept = lightbench::lab::Picture::open(&file).unwrap();
            let lightbench::lab::Picture::Ldr(kept) = kept else {
                panic!("{} is no 8-bit picture", file.display());
            };
            let flip = difference(&kept, &picture.output);
            assert!(
                flip <= SAME_PICTURE,
                "{}: FLIP {flip}; render it anew with `./x docs`",
                file.display()
            );
            drawn.push(figure.file.clone());
        }
        // Each picture of the texts is one of these, so that none grows old.
        for (_, language) in Language::ALL {
            for link in lesson.text(language).unwrap().links() {
                let is_formula = link.target.starts_with(FORMULAS);
                if link.target.starts_with("figures/") && !is_formula {
                    assert!(
                        drawn.contains(&link.target),
                        "{}: {}",
                        lesson.name,
                        link.target
                    );
                }
            }
        }
    }
}

fn difference(a: &LdrImage, b: &LdrImage) -> f64 {
    diff_ldr(a, b, DiffOptions::default())
        .unwrap()
        .difference
        .flip
        .mean
}
