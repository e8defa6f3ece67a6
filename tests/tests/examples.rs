//! Every small example runs, says nothing that is wrong, and shows something.
#![allow(clippy::unwrap_used)]

use std::sync::{Arc, Mutex};

use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::lab::experiment::Workbench;
use lightbench::render::GpuOptions;
use lightbench::script::{Settings, run_experiment};
use lightbench_tests::Studio;

const FOLDER: &str = "scripts/examples";

/// The examples with their texts.
fn examples() -> Vec<(String, String)> {
    let files = Files::shipped();
    let listed = files.list(FOLDER, "rhai").unwrap();
    let read = |path: String| {
        let text = files.read_text(&path).unwrap().to_string();
        (path, text)
    };
    listed.into_iter().map(|file| read(file.path)).collect()
}

/// Whether an example is an experiment: its header says how to try it.
fn is_experiment(text: &str) -> bool {
    text.contains("lightbench run ")
}

#[test]
fn scenes_are_drawn_without_a_warning_and_are_neither_dark_nor_even() {
    let scenes = examples();
    let scenes: Vec<_> = scenes
        .iter()
        .filter(|(_, text)| !is_experiment(text))
        .collect();
    assert!(scenes.len() >= 15, "{}", scenes.len());
    let mut studio = Studio::new("layers", &Settings::new());
    for (path, _) in scenes {
        studio.load(path, &Settings::new());
        for step in 1..=30 {
            let time = f64::from(step) / 60.0;
            let done = studio.scene.update(time, 1.0 / 60.0);
            done.unwrap_or_else(|problem| panic!("{problem}"));
        }
        for line in studio.scene.take_log() {
            assert!(
                !line.text.starts_with("warning"),
                "{}: {}",
                line.place,
                line.text
            );
        }
        let picture = studio.hdr("forward_single_pass", &Settings::new(), (96, 54));
        let luminance =
            |texel: &[f32; 4]| 0.2126 * texel[0] + 0.7152 * texel[1] + 0.0722 * texel[2];
        let mut values: Vec<f32> = picture.texels.iter().map(luminance).collect();
        values.sort_by(f32::total_cmp);
        let share = |share: f32| values[((values.len() - 1) as f32 * share) as usize];
        assert!(values[0] >= 0.0 && share(1.0).is_finite(), "{path}");
        // Mid-grey is 0.18; something is lit, and not all of it is the same.
        assert!(share(0.9) > 0.03, "{path} is dark: {}", share(0.9));
        assert!(share(0.95) > 1.5 * share(0.05), "{path} shows nothing");
    }
}

#[test]
fn experiments_run() {
    let experiments = examples();
    let experiments = experiments.iter().filter(|(_, text)| is_experiment(text));
    let mut count = 0;
    for (path, _) in experiments {
        let folder = tempfile::tempdir().unwrap();
        let files = Files::with_project(folder.path()).unwrap();
        let progress = Progress::new();
        let laboratory = Workbench::new(&files, GpuOptions::default(), &progress, |_| {});
        let said = Arc::new(Mutex::new(Vec::new()));
        let lines = Arc::clone(&said);
        let done = run_experiment(
            &files,
            path,
            &Settings::new(),
            Box::new(laboratory),
            move |line| lines.lock().unwrap().push(line.text),
            &progress,
        );
        done.unwrap_or_else(|problems| panic!("{problems}"));
        let said = said.lock().unwrap();
        assert!(!said.is_empty(), "{path} says nothing");
        assert!(
            !said.iter().any(|line| line.starts_with("warning")),
            "{said:?}"
        );
        count += 1;
    }
    assert!(count >= 3, "{count}");
}
