//! Help for the tests of this crate.
#![allow(clippy::unwrap_used)]

use lightbench_assets::files::Files;

/// The allocator that a program would install, so that memory limits work in tests.
#[global_allocator]
static ALLOCATOR: crate::CountingAllocator = crate::CountingAllocator;

/// A project with the given files. Lives as long as the folder.
pub(crate) fn project(files: &[(&str, &str)]) -> (tempfile::TempDir, Files) {
    let folder = tempfile::tempdir().unwrap();
    for (path, text) in files {
        let path = folder.path().join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    let store = Files::with_project(folder.path()).unwrap();
    (folder, store)
}

/// The numbers that a scene script prints, one a line.
pub(crate) fn printed(script: &str) -> Vec<f64> {
    let (_folder, store) = project(&[("scripts/scenes/test.rhai", script)]);
    let loaded = crate::load_scene(
        &store,
        "test",
        &crate::Settings::new(),
        &lightbench_assets::Progress::new(),
    );
    let mut scene = loaded.unwrap_or_else(|problems| panic!("{problems}"));
    let lines = scene.take_log().into_iter();
    lines.map(|line| line.text.parse().unwrap()).collect()
}

/// The number that an expression is.
pub(crate) fn value(expression: &str) -> f64 {
    printed(&format!("print({expression});"))[0]
}
