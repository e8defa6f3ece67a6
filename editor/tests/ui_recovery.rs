//! Nothing is lost: after a crash, on a full disk, when the window is closed, when files change outside.
#![allow(clippy::unwrap_used)]

mod ui_support;

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant, SystemTime};

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use lightbench::script::overlays::NewKind;
use lightbench::world::{Light, Value};
use lightbench_editor::ui::layout::Panel;
use lightbench_editor::ui::recovery::{PAUSE, Session};
use lightbench_editor::ui::workbench::log::Level;
use tempfile::TempDir;

use ui_support::{Bench, CTRL, PATIENCE};

const CTRL_SHIFT: Modifiers = Modifiers {
    shift: true,
    ..CTRL
};

/// What a crash may take at most.
const MOST: Duration = Duration::from_secs(10);

/// The folder of a child of a test.
const CHILD: &str = "LIGHTBENCH_TEST_RECOVERY";

const FILE: &str = "scripts/scenes/still.rhai";

const STILL: &str = r#"
const HIGH = param("high", 1.0, 0, 9, "How high");
spawn("box").mesh(box(1)).at(1, HIGH, 0);
point_light("lamp").intensity(60).range(30).at(0, 4, 6);
camera("eye").at(0, 0, 9).look_at(0, 0, 0);
"#;

fn settle(bench: &mut Bench) {
    bench.until("the scene", |editor| {
        assert!(!Bench::has_problems(editor));
        let workbench = &editor.workbench;
        workbench.scenes.shown() == Some("still")
            && !workbench.scenes.is_busy()
            && !workbench.is_arriving()
    });
    bench.harness.run_steps(2);
}

/// The editor on a project with a scene that stands still.
fn open(project: TempDir, settings: &Path) -> Bench {
    let folder = project.path().join("scripts/scenes");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("still.rhai"), STILL).unwrap();
    // It has been started before.
    if !settings.exists() {
        std::fs::write(settings, "{}").unwrap();
    }
    let mut bench = Bench::open_project_of("still", project, Some(settings.to_owned()));
    settle(&mut bench);
    bench
}

fn text(bench: &mut Bench) -> String {
    let scenes = &mut bench.harness.state_mut().workbench.scenes;
    scenes.scene_mut().unwrap().to_text().unwrap()
}

fn intensity(bench: &Bench) -> f32 {
    let scene = bench.harness.state().workbench.scenes.scene().unwrap();
    let lamp = scene.world.find("lamp").unwrap();
    scene.world.get::<Light>(lamp).unwrap().intensity
}

fn set_intensity(bench: &mut Bench, value: f32) {
    let workbench = &mut bench.harness.state_mut().workbench;
    let scene = workbench.scenes.scene().unwrap();
    let lamp = scene.world.find("lamp").unwrap();
    let value = Value::Float(value);
    workbench.set_field(lamp, "light.intensity", value).unwrap();
    bench.harness.run_steps(2);
}

/// The sessions that lie below a folder.
fn sessions(folder: &Path) -> Vec<Session> {
    let runs = std::fs::read_dir(folder.join("recovery"));
    let runs = runs.into_iter().flatten().flatten();
    let files = runs.map(|run| run.path().join("session.json"));
    let texts = files.filter_map(|file| std::fs::read_to_string(file).ok());
    texts.map(|it| Session::from_json(&it).unwrap()).collect()
}

fn wants_to_quit(bench: &Bench) -> bool {
    bench.harness.state().wants_to_quit()
}

fn is_asked(bench: &Bench) -> bool {
    bench.count("Shall it be restored?") > 0
}

#[test]
fn work_that_was_not_closed_is_offered_and_restored_exactly() {
    let kept = tempfile::tempdir().unwrap();
    let settings = kept.path().join("editor.json");
    let mut bench = open(tempfile::tempdir().unwrap(), &settings);
    assert!(!is_asked(&bench));
    set_intensity(&mut bench, 0.1);
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.create(NewKind::Torus).unwrap();
    workbench.set_scene_parameter("high", Some(2.5.into()));
    bench.harness.run_steps(2);
    settle(&mut bench);
    let workbench = &mut bench.harness.state_mut().workbench;
    let scene = workbench.scenes.scene().unwrap();
    let thing = scene.world.find("box").unwrap();
    workbench.selection.set(scene, [thing]);
    workbench.duplicate_chosen().unwrap();
    let scene = workbench.scenes.scene().unwrap();
    let thing = scene.world.find("box").unwrap();
    workbench.selection.set(scene, [thing]);
    workbench.delete_chosen().unwrap();
    workbench.set_pipeline_parameter("exposure", Some(1.5.into()));
    workbench.select_other("forward_single_pass");
    workbench.comparing.split = 0.25;
    workbench.comparing.flicker.rate = 2.0;
    workbench
        .camera
        .look(lightbench::world::glam::Vec2::new(0.1, 0.05));
    bench.harness.run_steps(2);
    let view = bench.harness.state().workbench.camera.view();
    let (written, picture) = (text(&mut bench), bench.picture());
    let began = Instant::now();
    bench.until("the session", |_| {
        let all = sessions(kept.path());
        all.first().is_some_and(|it| it.dials.split == 0.25)
    });
    assert!(began.elapsed() < MOST);
    let project = bench.close();

    let mut bench = open(project, &settings);
    assert!(is_asked(&bench));
    assert_eq!(bench.count("The editor ended before you closed it"), 1);
    assert_ne!(text(&mut bench), written);
    bench.press("Restore");
    settle(&mut bench);
    assert!(!is_asked(&bench));
    assert_eq!(text(&mut bench), written);
    let workbench = &bench.harness.state().workbench;
    assert_eq!(workbench.camera.view(), view);
    assert_eq!(workbench.comparing.split, 0.25);
    assert_eq!(workbench.comparing.flicker.rate, 2.0);
    let other = &workbench.comparing.side().unwrap().pipelines;
    assert_eq!(other.selected(), "forward_single_pass");
    bench.until("the pipeline", |editor| {
        let pipelines = &editor.workbench.pipelines;
        !pipelines.is_busy() && !pipelines.is_warming()
    });
    assert_eq!(bench.picture(), picture);
    // It is a session of this run now, and can be taken back as a whole.
    let project = bench.close();
    let mut bench = open(project, &settings);
    bench.press("Restore");
    settle(&mut bench);
    assert_eq!(text(&mut bench), written);
    bench.harness.state_mut().workbench.reset_all_fields();
    assert_eq!(intensity(&bench), 60.0);
    bench.key(CTRL, Key::Z);
    assert_eq!(text(&mut bench), written);
    let project = bench.close();
    let mut bench = open(project, &settings);
    bench.press("Discard");
    assert!(!is_asked(&bench));
    let bench = open(bench.close(), &settings);
    assert!(!is_asked(&bench));
    assert_eq!(intensity(&bench), 60.0);
}

/// The editor that is killed by the test below; by itself it is no test. After each change it writes
/// down how the scene is then, and when that was.
#[test]
fn child_that_edits_until_it_is_killed() {
    let Some(folder) = std::env::var_os(CHILD).map(PathBuf::from) else {
        return;
    };
    let project = tempfile::Builder::new().tempdir_in(&folder).unwrap();
    let mut bench = open(project, &folder.join("editor.json"));
    let began = Instant::now();
    for number in 1_u32.. {
        if number.is_multiple_of(7) {
            let workbench = &mut bench.harness.state_mut().workbench;
            workbench.create(NewKind::Box).unwrap();
        }
        set_intensity(&mut bench, number as f32);
        let text = text(&mut bench);
        std::fs::write(folder.join(format!("{number}.scene")), text).unwrap();
        let now = SystemTime::UNIX_EPOCH.elapsed().unwrap().as_millis();
        std::fs::write(folder.join(format!("{number}.time")), now.to_string()).unwrap();
        std::thread::sleep(Duration::from_millis(60));
        if began.elapsed() > PATIENCE {
            return;
        }
    }
}

fn child(name: &str, folder: &Path) -> Child {
    Command::new(std::env::current_exe().unwrap())
        .args(["--exact", name, "--nocapture"])
        .env(CHILD, folder)
        .stdout(Stdio::null())
        .spawn()
        .unwrap()
}

#[test]
fn an_editor_that_is_killed_at_any_moment_loses_ten_seconds_at_most() {
    // Moments by which others differ in each run of the test.
    let seed = SystemTime::UNIX_EPOCH.elapsed().unwrap().subsec_nanos();
    for round in 0..4_u32 {
        let folder = tempfile::tempdir().unwrap();
        let mut child = child("child_that_edits_until_it_is_killed", folder.path());
        let began = Instant::now();
        while !folder.path().join("1.time").exists() {
            assert!(began.elapsed() < PATIENCE, "nothing was edited");
            assert!(child.try_wait().unwrap().is_none(), "the child ended");
            std::thread::sleep(Duration::from_millis(5));
        }
        let random = seed.rotate_left(round * 8).wrapping_mul(0x9e37_79b9) >> 16;
        let wait = Duration::from_millis(500 + u64::from(random % 7000));
        std::thread::sleep(wait);
        child.kill().unwrap();
        let killed = SystemTime::UNIX_EPOCH.elapsed().unwrap().as_millis();
        child.wait().unwrap();
        // How the scene was when it was kept last.
        let kept = sessions(folder.path());
        let number = kept.first().map_or(0, |session| {
            let all = &session.overlays["still"].fields;
            let intensity = all.iter().find(|(_, path, _)| path == "light.intensity");
            match intensity.unwrap().2 {
                Value::Float(number) => number as u32,
                _ => panic!("{all:?}"),
            }
        });
        let lost = std::fs::read_to_string(folder.path().join(format!("{}.time", number + 1)));
        let lost: u128 = lost.map_or(0, |time| killed - time.parse::<u128>().unwrap());
        eprintln!("killed after {wait:?}: the last {lost} ms are lost, change {number} is there");
        assert!(lost <= MOST.as_millis(), "{lost} ms were lost");
        assert!(
            number > 0 || wait < PAUSE * 3,
            "nothing is there after {wait:?}"
        );
        if number == 0 {
            continue;
        }
        let project = kept[0].project.clone().unwrap();
        let mut bench = adopt(&project, &folder.path().join("editor.json"));
        bench.press("Restore");
        settle(&mut bench);
        let wanted = std::fs::read_to_string(folder.path().join(format!("{number}.scene")));
        assert_eq!(text(&mut bench), wanted.unwrap());
    }
}

/// The editor on a project that another process has left.
fn adopt(project: &Path, settings: &Path) -> Bench {
    // The same folder, under the care of this process.
    let own = tempfile::tempdir().unwrap();
    let place = own.path().to_owned();
    std::fs::remove_dir(&place).unwrap();
    std::os::unix::fs::symlink(project, &place).unwrap();
    open(own, settings)
}

#[test]
fn closing_asks_while_changes_by_hand_are_in_no_file() {
    let kept = tempfile::tempdir().unwrap();
    let settings = kept.path().join("editor.json");
    let mut bench = open(tempfile::tempdir().unwrap(), &settings);
    set_intensity(&mut bench, 5.0);
    bench.key(CTRL, Key::Q);
    assert!(!wants_to_quit(&bench));
    assert_eq!(
        bench.count("still, changes by hand that are in no file: 1"),
        1
    );
    bench.press("Go on editing");
    assert_eq!(bench.count("Something would be lost"), 0);
    // The cross of the window does the same.
    bench.harness.state_mut().ask_to_quit();
    bench.harness.run_steps(2);
    assert!(!wants_to_quit(&bench));
    bench.press("Keep all and close");
    assert!(wants_to_quit(&bench));
    let project = bench.close();

    let mut bench = open(project, &settings);
    assert_eq!(
        bench.count("Changes were kept when the editor was closed"),
        1
    );
    bench.press("Restore");
    settle(&mut bench);
    assert_eq!(intensity(&bench), 5.0);
    // Taken back, there is nothing to lose.
    bench.harness.state_mut().workbench.reset_all_fields();
    bench.key(CTRL, Key::Q);
    assert!(wants_to_quit(&bench));
    let mut bench = open(bench.close(), &settings);
    assert!(!is_asked(&bench));

    // Saved, there is nothing to lose either.
    set_intensity(&mut bench, 6.0);
    bench.key(CTRL, Key::Q);
    bench.press("Save the scene as");
    bench.press("Save");
    bench.harness.run_steps(2);
    assert!(
        bench
            .path()
            .join("scripts/scenes/still_edited.scene")
            .exists()
    );
    bench.press("Go on editing");
    bench.key(CTRL, Key::Q);
    assert!(wants_to_quit(&bench));
    let mut bench = open(bench.close(), &settings);
    assert!(!is_asked(&bench));
    set_intensity(&mut bench, 7.0);
    bench.key(CTRL, Key::Q);
    bench.press("Don't save");
    assert!(wants_to_quit(&bench));
    let bench = open(bench.close(), &settings);
    assert!(!is_asked(&bench));
}

#[test]
fn another_project_asks_too_and_the_first_one_offers_what_was_kept() {
    let kept = tempfile::tempdir().unwrap();
    let settings = kept.path().join("editor.json");
    let mut bench = open(tempfile::tempdir().unwrap(), &settings);
    set_intensity(&mut bench, 5.0);
    let other = tempfile::tempdir().unwrap();
    bench.press("File");
    let is_entry = |label: Option<String>| label.is_some_and(|it| it.starts_with("Open a project"));
    let harness = &bench.harness;
    let entry = harness.get_by(|node| node.role() == Role::Button && is_entry(node.label()));
    entry.click();
    bench.harness.run_steps(3);
    bench.key(CTRL, Key::A);
    bench.type_text(other.path().to_str().unwrap());
    bench.key(Modifiers::NONE, Key::Enter);
    assert_eq!(bench.count("Something would be lost"), 1);
    bench.press("Keep all and close");
    bench.until("the other project", |editor| {
        editor.workbench.scenes.shown() == Some("atrium") && !editor.workbench.scenes.is_busy()
    });
    assert!(!wants_to_quit(&bench));
    assert!(!is_asked(&bench), "it is of the other project");
    let mut bench = open(bench.close(), &settings);
    bench.press("Restore");
    settle(&mut bench);
    assert_eq!(intensity(&bench), 5.0);
}

#[test]
fn closing_asks_while_an_entry_of_the_notebook_is_in_memory_alone() {
    let mut bench = open(
        tempfile::tempdir().unwrap(),
        &tempfile::tempdir().unwrap().path().join("editor.json"),
    );
    let folder = bench.path().join("notebook");
    std::fs::write(&folder, "in the way").unwrap();
    bench.show(Panel::Notebook);
    bench.press("Keep this measurement");
    bench.until("the entry", |editor| {
        let notebook = &editor.workbench.notebook;
        !notebook.is_busy() && notebook.unsaved().count() == 1
    });
    bench.key(CTRL, Key::Q);
    assert_eq!(bench.count("an entry of the notebook that is in memory"), 1);
    bench.press("Keep all and close");
    assert!(!wants_to_quit(&bench), "it could not be kept");
    assert!(bench.count("Not saved:") > 0);
    std::fs::remove_file(&folder).unwrap();
    bench.press("Keep all and close");
    assert!(wants_to_quit(&bench));
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 2);
}

#[test]
fn a_script_that_another_program_saves_leaves_changes_by_hand() {
    let kept = tempfile::tempdir().unwrap();
    let settings = kept.path().join("editor.json");
    let mut bench = open(tempfile::tempdir().unwrap(), &settings);
    set_intensity(&mut bench, 5.0);
    let workbench = &mut bench.harness.state_mut().workbench;
    workbench.create(NewKind::Cone).unwrap();
    bench.harness.run_steps(2);
    let before = text(&mut bench);
    let swaps = bench.harness.state().workbench.scenes.swaps();
    // What is under watch is noticed without being told.
    let theirs = STILL.replace(".intensity(60)", ".intensity(70)");
    bench.save(FILE, &format!("{theirs}\nspawn(\"theirs\").mesh(box(1));"));
    bench.until("their scene", |editor| {
        let scenes = &editor.workbench.scenes;
        let theirs = scenes.scene().and_then(|scene| scene.world.find("theirs"));
        scenes.swaps() > swaps && theirs.is_some() && !scenes.is_busy()
    });
    assert_eq!(intensity(&bench), 5.0);
    let scene = bench.harness.state().workbench.scenes.scene().unwrap();
    assert!(scene.world.find("cone").is_some());
    // Broken, the last good scene stays with all that was changed.
    let with_theirs = text(&mut bench);
    bench.save(FILE, "spawn(");
    bench.until("the mistake", |editor| Bench::has_problems(editor));
    set_intensity(&mut bench, 6.0);
    bench.key(CTRL, Key::Z);
    assert_eq!(text(&mut bench), with_theirs);
    bench.save(FILE, STILL);
    bench.until("our scene", |editor| {
        !Bench::has_problems(editor) && !editor.workbench.scenes.is_busy()
    });
    assert_eq!(text(&mut bench), before);
    // Both were steps before the file changed.
    bench.key(CTRL, Key::Z);
    bench.key(CTRL, Key::Z);
    assert_eq!(intensity(&bench), 60.0);
    bench.key(CTRL_SHIFT, Key::Z);
    bench.key(CTRL_SHIFT, Key::Z);
    assert_eq!(text(&mut bench), before);
}

/// The editor on a full disk, for the test below; by itself it is no test.
#[test]
fn child_on_a_full_disk() {
    let Some(folder) = std::env::var_os(CHILD).map(PathBuf::from) else {
        return;
    };
    let full = std::fs::write(folder.join("no room"), [0; 4096]);
    assert!(full.is_err(), "the disk is not full");
    let files = lightbench::assets::files::Files::with_project(folder.join("project")).unwrap();
    drop(files);
    let mut bench = adopt_as_it_is(&folder.join("project"), &folder.join("editor.json"));
    settle(&mut bench);
    set_intensity(&mut bench, 5.0);
    let before = text(&mut bench);
    bench.key(CTRL_SHIFT, Key::S);
    bench.key(CTRL, Key::A);
    bench.type_text("mine");
    bench.press("Save");
    let refused = bench.count("mine.scene");
    assert!(refused > 0, "it is said what could not be written");
    bench.press("Cancel");
    let old = std::fs::read_to_string(folder.join("project/scripts/scenes/mine.scene"));
    assert_eq!(old.unwrap(), "old");
    assert_eq!(text(&mut bench), before);
    // What is kept for a crash is tried again and again, and told once.
    let errors = |bench: &Bench| {
        let lines = bench.harness.state().workbench.log.lines();
        let errors = lines.filter(|line| line.level == Level::Error);
        errors.filter(|it| it.text.contains("is not kept")).count()
    };
    bench.until("the complaint", |editor| {
        let mut lines = editor.workbench.log.lines();
        lines.any(|line| line.text.contains("is not kept"))
    });
    for number in 0..30 {
        set_intensity(&mut bench, number as f32);
        std::thread::sleep(Duration::from_millis(500));
    }
    assert_eq!(errors(&bench), 1);
    // It can't be kept aside, so that closing says so, and nothing is gone.
    bench.key(CTRL, Key::Q);
    bench.press("Keep all and close");
    assert!(!wants_to_quit(&bench));
    assert!(bench.count("Not saved:") > 0);
    bench.press("Go on editing");
    assert_eq!(intensity(&bench), 29.0);
    bench.key(CTRL, Key::Z);
    assert_eq!(intensity(&bench), 28.0);
}

/// As [`adopt`], without writing a file.
fn adopt_as_it_is(project: &Path, settings: &Path) -> Bench {
    let own = tempfile::tempdir().unwrap();
    let place = own.path().to_owned();
    std::fs::remove_dir(&place).unwrap();
    std::os::unix::fs::symlink(project, &place).unwrap();
    Bench::open_project_of("still", own, Some(settings.to_owned()))
}

#[test]
fn a_full_disk_loses_nothing_and_is_told_once() {
    let folder = tempfile::tempdir().unwrap();
    let scenes = folder.path().join("project/scripts/scenes");
    std::fs::create_dir_all(&scenes).unwrap();
    std::fs::write(scenes.join("still.rhai"), STILL).unwrap();
    std::fs::write(scenes.join("mine.scene"), "old").unwrap();
    std::fs::write(folder.path().join("editor.json"), "{}").unwrap();
    // No file may grow: each write fails as it does where no room is left. The signal that comes with it
    // would end the program.
    let script = "trap '' XFSZ; ulimit -f 0; exec \"$0\" \"$@\"";
    let status = Command::new("sh")
        .args(["-c", script])
        .arg(std::env::current_exe().unwrap())
        .args(["--exact", "child_on_a_full_disk", "--nocapture"])
        .env(CHILD, folder.path())
        .stdout(Stdio::null())
        .status()
        .unwrap();
    assert!(status.success(), "{status}");
}

#[test]
fn who_decides_later_is_asked_again_and_keys_wait_for_the_answer() {
    let kept = tempfile::tempdir().unwrap();
    let settings = kept.path().join("editor.json");
    let mut bench = open(tempfile::tempdir().unwrap(), &settings);
    set_intensity(&mut bench, 5.0);
    bench.until("the session", |_| !sessions(kept.path()).is_empty());
    let mut bench = open(bench.close(), &settings);
    assert!(is_asked(&bench));
    let pipeline = bench.shown();
    bench.key(Modifiers::NONE, Key::CloseBracket);
    assert_eq!(bench.shown(), pipeline);
    let heading = "The editor ended before you closed it";
    assert!(bench.harness.query_by_label(heading).is_some());
    assert!(
        bench
            .harness
            .query_by_role_and_label(Role::Button, "Restore")
            .is_some()
    );
    bench.key(Modifiers::NONE, Key::Escape);
    assert!(!is_asked(&bench));
    let bench = open(bench.close(), &settings);
    assert!(is_asked(&bench));
}
