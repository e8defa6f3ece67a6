#![allow(clippy::unwrap_used)]
use std::fs;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use tempfile::TempDir;

use super::*;

const PATIENCE: Duration = Duration::from_secs(10);

struct Project {
    folder: TempDir,
    watcher: Watcher,
}

impl Project {
    fn new() -> Self {
        let folder = tempfile::Builder::new()
            .prefix("práctica 1 ñ")
            .tempdir()
            .unwrap();
        fs::create_dir_all(folder.path().join("shaders/lib")).unwrap();
        fs::create_dir_all(folder.path().join("out")).unwrap();
        fs::write(folder.path().join("shaders/a.wgsl"), "old").unwrap();
        let files = Files::with_project(folder.path()).unwrap();
        let watcher = Watcher::new(&files, || ()).unwrap();
        Self { folder, watcher }
    }

    fn path(&self, path: &str) -> PathBuf {
        self.folder.path().join(path)
    }

    /// Everything that is reported until `done` says so.
    fn until(&self, done: impl Fn(&Changes) -> bool) -> Changes {
        let start = Instant::now();
        let mut all = Changes::default();
        while !done(&all) {
            assert!(start.elapsed() < PATIENCE, "only {all:?}");
            if let Some(more) = self.watcher.wait(Duration::from_millis(100)) {
                all = merged(all, more);
            }
        }
        all
    }

    fn until_named(&self, path: &str) -> Changes {
        self.until(|changes| changes.paths.contains(path))
    }

    /// Reads a file whenever it is reported, as a reloading editor does, until
    /// it has the expected content.
    fn until_read(&self, path: &str, expected: &str) {
        let files = Files::with_project(self.folder.path()).unwrap();
        let start = Instant::now();
        let mut read = None;
        while read.as_deref() != Some(expected) {
            assert!(start.elapsed() < PATIENCE, "last read {read:?}");
            if let Some(changes) = self.watcher.wait(Duration::from_millis(100))
                && changes.paths.contains(path)
            {
                read = files.read_text(path).ok();
            }
        }
    }
}

#[test]
fn a_save_is_reported_soon_and_alone() {
    let project = Project::new();
    let start = Instant::now();
    fs::write(project.path("shaders/a.wgsl"), "new").unwrap();
    let changes = project.until_named("shaders/a.wgsl");
    println!("{:?} from save to report", start.elapsed());
    assert_eq!(changes.paths.len(), 1, "{changes:?}");
    assert!(!changes.everything);
    // Reading is no change.
    fs::read(project.path("shaders/a.wgsl")).unwrap();
    assert_eq!(project.watcher.wait(Duration::from_millis(250)), None);
}

#[test]
fn half_written_and_empty_files_are_named_again_when_they_go_on() {
    use std::io::Write;
    let project = Project::new();
    let mut file = fs::File::create(project.path("shaders/a.wgsl")).unwrap();
    project.until_named("shaders/a.wgsl");
    file.write_all(b"fn ma").unwrap();
    file.flush().unwrap();
    project.until_named("shaders/a.wgsl");
    file.write_all(b"in() {}").unwrap();
    drop(file);
    project.until_read("shaders/a.wgsl", "fn main() {}");
}

#[test]
fn renamed_and_deleted_files_are_both_named() {
    let project = Project::new();
    fs::rename(
        project.path("shaders/a.wgsl"),
        project.path("shaders/b ñ.wgsl"),
    )
    .unwrap();
    let both = |changes: &Changes| {
        changes.paths.contains("shaders/a.wgsl") && changes.paths.contains("shaders/b ñ.wgsl")
    };
    project.until(both);
    fs::remove_file(project.path("shaders/b ñ.wgsl")).unwrap();
    project.until_named("shaders/b ñ.wgsl");
}

#[test]
fn editors_that_save_through_a_temporary_file() {
    let project = Project::new();
    for (round, temporary) in [
        "shaders/.a.wgsl.swp",
        "shaders/a.wgsl~",
        "shaders/a.wgsl.tmp",
        "shaders/4913",
    ]
    .into_iter()
    .enumerate()
    {
        let content = format!("version {round}");
        fs::write(project.path(temporary), &content).unwrap();
        fs::rename(project.path(temporary), project.path("shaders/a.wgsl")).unwrap();
        project.until_read("shaders/a.wgsl", &content);
    }
    // Our own way of writing.
    let files = Files::with_project(project.folder.path()).unwrap();
    files.write("shaders/a.wgsl", b"version 5").unwrap();
    project.until_read("shaders/a.wgsl", "version 5");
}

#[test]
fn a_hundred_saves_in_a_second_end_with_the_last() {
    let project = Project::new();
    let path = project.path("shaders/a.wgsl");
    let writer = std::thread::spawn(move || {
        for round in 0..100 {
            fs::write(&path, format!("save {round}")).unwrap();
            std::thread::sleep(Duration::from_millis(10));
        }
    });
    let files = Files::with_project(project.folder.path()).unwrap();
    let began = Instant::now();
    let mut reports = 0;
    let mut read = String::new();
    // Until nothing more comes for a while.
    while project.watcher.wait(Duration::from_millis(500)).is_some() {
        reports += 1;
        read = files.read_text("shaders/a.wgsl").unwrap();
    }
    writer.join().unwrap();
    assert_eq!(read, "save 99");
    let most = began.elapsed().as_millis() / SETTLE.as_millis() + 1;
    assert!(
        reports <= most,
        "{reports} reports, at most {most} expected"
    );
}

#[test]
fn files_in_new_and_moved_folders_are_named() {
    let project = Project::new();
    fs::create_dir_all(project.path("scripts/scenes/deep")).unwrap();
    fs::write(project.path("scripts/scenes/deep/x.rhai"), "1").unwrap();
    project.until_named("scripts/scenes/deep/x.rhai");
    let outside = tempfile::tempdir().unwrap();
    fs::create_dir(outside.path().join("models")).unwrap();
    fs::write(outside.path().join("models/y.obj"), "v").unwrap();
    if fs::rename(outside.path().join("models"), project.path("models")).is_ok() {
        project.until_named("models/y.obj");
        // And it is watched from now on.
        fs::write(project.path("models/y.obj"), "v 1").unwrap();
        project.until_named("models/y.obj");
    }
}

#[test]
fn hidden_files_and_outputs_are_not_named() {
    let project = Project::new();
    fs::write(project.path("out/picture.png"), "x").unwrap();
    fs::create_dir(project.path(".git")).unwrap();
    fs::write(project.path(".git/index"), "x").unwrap();
    fs::write(project.path("shaders/.hidden"), "x").unwrap();
    fs::write(project.path("shaders/last.wgsl"), "x").unwrap();
    let changes = project.until_named("shaders/last.wgsl");
    assert_eq!(changes.paths.len(), 1, "{changes:?}");
}

#[test]
fn granted_files_are_watched_and_the_waker_is_called() {
    let outside = tempfile::tempdir().unwrap();
    fs::write(outside.path().join("x.obj"), "v").unwrap();
    let mut files = Files::shipped();
    let path = files.grant(outside.path().join("x.obj")).unwrap();
    let woken = Arc::new(AtomicUsize::new(0));
    let count = Arc::clone(&woken);
    let watcher = Watcher::new(&files, move || {
        count.fetch_add(1, Ordering::SeqCst);
    })
    .unwrap();
    assert_eq!(watcher.changes(), None);
    fs::write(outside.path().join("x.obj"), "v 1").unwrap();
    let changes = watcher.wait(PATIENCE).unwrap();
    assert!(changes.paths.contains(&path), "{changes:?}");
    let start = Instant::now();
    while woken.load(Ordering::SeqCst) == 0 {
        assert!(start.elapsed() < PATIENCE);
        std::thread::yield_now();
    }
}
