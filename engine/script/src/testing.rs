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
