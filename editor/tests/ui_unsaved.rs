//! What a crash leaves of unsaved text.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use lightbench_editor::ui::code::document::Outside;
use lightbench_editor::ui::code::drafts::PAUSE;

use ui_support::{Bench, CTRL, PATIENCE};

const SCENE: &str = "scripts/scenes/cornell_box.rhai";

/// The folder of the test's child that is killed.
const CHILD: &str = "LIGHTBENCH_TEST_KILLED";

fn typed(bench: &mut Bench, text: &str) {
    bench.key(CTRL, Key::E);
    bench.harness.get_by_role(Role::MultilineTextInput).focus();
    bench.harness.run_steps(3);
    bench.key(CTRL, Key::End);
    bench.type_text(text);
}

/// The drafts that lie below a folder.
fn drafts(folder: &Path) -> Vec<PathBuf> {
    let runs = std::fs::read_dir(folder.join("unsaved"))
        .into_iter()
        .flatten();
    let files = runs.flatten().flat_map(|run| std::fs::read_dir(run.path()));
    let files = files.flatten().flatten().map(|file| file.path());
    files
        .filter(|file| file.extension().is_some_and(|end| end == "json"))
        .collect()
}

fn text(bench: &Bench) -> String {
    bench.harness.state().code.shown().unwrap().text.clone()
}

#[test]
fn unsaved_text_is_offered_after_the_editor_ended_without_saving() {
    let kept = tempfile::tempdir().unwrap();
    let settings = kept.path().join("editor.json");
    let mut bench = Bench::open_with(Some(settings.clone()));
    bench.press("Start");
    let (on_disk, good) = bench.own(SCENE);
    typed(&mut bench, "// not saved");
    let began = Instant::now();
    bench.until("the draft", |_| !drafts(kept.path()).is_empty());
    assert!(began.elapsed() < Duration::from_secs(10));
    let project = bench.close();

    let mut bench = Bench::open_project(project, Some(settings.clone()));
    assert_eq!(bench.count("were not saved when the editor ended"), 1);
    bench.press("Open the text");
    assert_eq!(text(&bench), format!("{good}// not saved"));
    assert_eq!(bench.count("were not saved when the editor ended"), 0);
    assert_eq!(std::fs::read_to_string(&on_disk).unwrap(), good);
    // It is kept again, at once.
    let project = bench.close();
    std::fs::write(&on_disk, "// theirs").unwrap();
    let mut bench = Bench::open_project_of("atrium", project, Some(settings.clone()));
    bench.press("Open the text");
    let document = bench.harness.state().code.shown().unwrap();
    let theirs = Outside::Changed("// theirs".to_owned());
    assert_eq!(
        document.outside,
        Some(theirs),
        "the file is another one now"
    );
    bench.press("Take theirs");
    bench.until("the draft to go", |_| drafts(kept.path()).is_empty());
    let project = bench.close();
    let bench = Bench::open_project_of("atrium", project, Some(settings));
    assert_eq!(bench.count("were not saved when the editor ended"), 0);
}

/// The editor that is killed by the test below; by itself it is no test.
#[test]
fn child_that_types_until_it_is_killed() {
    let Some(folder) = std::env::var_os(CHILD).map(PathBuf::from) else {
        return;
    };
    let project = tempfile::Builder::new().tempdir_in(&folder).unwrap();
    let mut bench = Bench::open_project(project, Some(folder.join("editor.json")));
    bench.press("Start");
    bench.own(SCENE);
    typed(&mut bench, "// killed");
    let began = Instant::now();
    while began.elapsed() < PATIENCE {
        bench.harness.step();
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn unsaved_text_of_an_editor_that_was_killed_is_offered() {
    let folder = tempfile::tempdir().unwrap();
    let program = std::env::current_exe().unwrap();
    let mut child = Command::new(program)
        .args(["--exact", "child_that_types_until_it_is_killed"])
        .env(CHILD, folder.path())
        .spawn()
        .unwrap();
    let began = Instant::now();
    while drafts(folder.path()).is_empty() {
        assert!(began.elapsed() < PATIENCE, "no draft came");
        assert!(child.try_wait().unwrap().is_none(), "the child ended");
        std::thread::sleep(PAUSE / 20);
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let draft = std::fs::read_to_string(&drafts(folder.path())[0]).unwrap();
    let draft: serde_json::Value = serde_json::from_str(&draft).unwrap();
    let on_disk = PathBuf::from(draft["file"].as_str().unwrap());
    let left = on_disk.ancestors().nth(3).unwrap();
    let project = tempfile::tempdir().unwrap();
    // The same folder, under the care of this process.
    let place = project.path().to_owned();
    std::fs::remove_dir(&place).unwrap();
    std::os::unix::fs::symlink(left, &place).unwrap();
    let mut bench = Bench::open_project(project, Some(folder.path().join("editor.json")));
    bench.press("Open the text");
    assert!(text(&bench).ends_with("// killed"));
    assert!(
        !std::fs::read_to_string(&on_disk)
            .unwrap()
            .contains("killed")
    );
}
