//! Bad saves while the editor runs: the last good picture stays, bit for bit, and the editor says
//! why.
//!
//! The editor's model works on a project in a process of its own, which is ended when it takes too
//! long: what is saved here may do anything.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::{Duration, Instant};

use lightbench::assets::files::Files;
use lightbench::render::readback::read_bytes;
use lightbench::render::{Gpu, GpuOptions};
use lightbench_editor::ui::EditorOptions;
use lightbench_editor::ui::workbench::Workbench;
use tempfile::TempDir;

/// Longer than all saves together may take.
const PATIENCE: Duration = Duration::from_secs(240);
/// Longer than the editor may take for one.
const SETTLING: Duration = Duration::from_secs(60);
/// Makes the child's test run.
const CHILD: &str = "LIGHTBENCH_BAD_SAVES";
const SIZE: (u32, u32) = (96, 54);

#[test]
fn bad_saves_leave_the_last_good_picture_and_are_explained() {
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "child_that_saves", "--ignored", "--nocapture"])
        .env(CHILD, "1")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let began = Instant::now();
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            assert!(status.success(), "the editor's process ended with {status}");
            return;
        }
        if began.elapsed() > PATIENCE {
            child.kill().unwrap();
            child.wait().unwrap();
            panic!("the editor's process did not end within {PATIENCE:?}");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Not a test by itself: the process in which the editor works.
#[test]
#[ignore = "the child process of another test"]
fn child_that_saves() {
    if std::env::var(CHILD).is_err() {
        return;
    }
    let mut desk = Desk::open();
    planted_mistakes(&mut desk);
    half_written_files(&mut desk);
    a_broken_module_and_other_pipelines(&mut desk);
    a_broken_scene(&mut desk);
}

/// A mistake: the file, what goes, what comes, and what the editor must say.
type Planted = (&'static str, &'static str, &'static str, &'static str);

const PLANTED: [Planted; 14] = [
    (
        "shaders/output.wgsl",
        "let exposed =",
        "let exposed: u32 =",
        "`exposed` is declared as `u32`",
    ),
    (
        "shaders/output.wgsl",
        "@fragment",
        "@vertex",
        "`@builtin(position)` does not exist here",
    ),
    (
        "shaders/output.wgsl",
        "var hdr: texture_2d<f32>",
        "var hdr: texture_2d<u32>",
        "argument 1 is `vec3u`: give all the same type",
    ),
    (
        "shaders/deferred_shading/light.wgsl",
        "@interpolate(flat) light: u32",
        "@interpolate(flat) light: f32",
        "an element is chosen by a whole number, not by `f32`",
    ),
    (
        "shaders/lib/g_buffer_texels.wgsl",
        "@group(1) @binding(10) var depth: texture_depth_2d",
        "@group(1) @binding(11) var depth: texture_depth_2d",
        "@group(1) @binding(11)",
    ),
    (
        "shaders/deferred_shading/g_buffer.wgsl",
        "g_buffer::pack",
        "g_buffer::pakc",
        "did you mean `pack`?",
    ),
    (
        "shaders/lib/lighting.wgsl",
        "let n_dot_l = dot(",
        "let n_dot_l = dto(",
        "did you mean `dot`?",
    ),
    (
        "shaders/lib/scene.wgsl",
        "    camera_position: vec3f,",
        "    camera_place: vec3f,",
        "there is no `.camera_position` here",
    ),
    (
        "shaders/vertex/geometry.wgsl",
        "geometry::transform_vertex(vertex, drawn)",
        "geometry::transform_vertex(vertex)",
        "takes 2 arguments",
    ),
    (
        "scripts/pipelines/parts/output.rhai",
        "fn add(",
        "fn add((",
        "parts/output.rhai",
    ),
    (
        "scripts/pipelines/parts/output.rhai",
        "\"rgba8unorm\"",
        "\"rgba8unrom\"",
        "did you mean `rgba8unorm`?",
    ),
    (
        "scripts/pipelines/parts/g_buffer.rhai",
        ".depth(\"depth\").clear(0.0)",
        ".depth(\"depth\")",
        "which nobody wrote yet",
    ),
    (
        "scripts/pipelines/parts/g_buffer.rhai",
        ".reads(\"g_albedo\")",
        ".reads(\"g_albdeo\")",
        "did you mean `g_albedo`?",
    ),
    (
        "scripts/pipelines/deferred_shading.rhai",
        "p.lights(\"lights\" + part.name)",
        "p.fullscreen(\"lights\" + part.name)",
        "deferred_shading.rhai",
    ),
];

fn planted_mistakes(desk: &mut Desk) {
    let good = desk.picture();
    let mut wrong = Vec::new();
    for (file, from, to, said) in PLANTED {
        let text = desk.text(file);
        assert!(text.contains(from), "`{from}` is not in {file}");
        desk.save(file, &text.replacen(from, to, 1));
        assert!(desk.picture() == good, "{file}, {to}: the picture changed");
        let explained = desk.explanation();
        if !explained.contains(said) {
            wrong.push(format!("{file}, {to}: `{said}` is not in\n{explained}"));
        }
        desk.save(file, &text);
        assert_eq!(desk.explanation(), "", "{file} is good again");
        assert!(
            desk.picture() == good,
            "{file} is good again, the picture is not"
        );
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Files cut off anywhere, empty, and full of what is no text.
fn half_written_files(desk: &mut Desk) {
    let good = desk.picture();
    for file in [
        "shaders/output.wgsl",
        "shaders/lib/surface.wgsl",
        "scripts/pipelines/deferred_shading.rhai",
        "scripts/pipelines/parts/g_buffer.rhai",
    ] {
        let text = desk.text(file);
        // All that follows the last parenthesis may be missing without harm.
        let most = text.rfind(')').unwrap();
        let cuts = (0..6).map(|cut| {
            let end = (0..=most * cut / 5)
                .rev()
                .find(|end| text.is_char_boundary(*end));
            text[..end.unwrap_or(0)].to_owned()
        });
        let noise = [
            "\u{0}\u{1}\u{2}".to_owned(),
            "\u{feff}\u{202e}}}}}((((".to_owned(),
        ];
        for broken in cuts.chain(noise) {
            desk.save(file, &broken);
            let explained = desk.explanation();
            assert!(!explained.is_empty(), "{file} as {broken:?} is no mistake");
            assert!(
                desk.picture() == good,
                "{file} as {broken:?}: the picture changed"
            );
        }
        desk.save(file, &text);
        assert_eq!(desk.explanation(), "", "{file} is good again");
        assert!(
            desk.picture() == good,
            "{file} is good again, the picture is not"
        );
    }
}

/// What is broken for all pipelines does not take away the one on screen.
fn a_broken_module_and_other_pipelines(desk: &mut Desk) {
    let good = desk.picture();
    let file = "shaders/lib/lighting.wgsl";
    let text = desk.text(file);
    desk.save(
        file,
        &text.replacen("fn evaluate_light(", "fn evaluate_light((", 1),
    );
    desk.workbench.select_pipeline("forward_single_pass");
    desk.settle();
    assert_eq!(desk.workbench.pipelines.shown(), Some("deferred_shading"));
    assert!(
        desk.picture() == good,
        "a pipeline that can't be built took the picture away"
    );
    assert!(desk.explanation().contains(file), "{}", desk.explanation());
    desk.workbench.select_pipeline("deferred_shading");
    desk.workbench.pipelines.set("exposure", 1.0.into());
    desk.settle();
    assert!(desk.picture() == good, "half of a change was drawn");
    assert!(desk.explanation().contains(file), "{}", desk.explanation());
    desk.workbench.pipelines.unset("exposure");
    desk.save(file, &text);
    assert_eq!(desk.explanation(), "");
    assert!(desk.picture() == good);
}

fn a_broken_scene(desk: &mut Desk) {
    let good = desk.picture();
    let file = "scripts/scenes/cornell_box.rhai";
    let text = desk.text(file);
    for broken in ["", "let a = ;", "loop {}", &text[..text.len() / 2]] {
        desk.save(file, broken);
        if broken.is_empty() {
            // A scene may be empty: nothing is a scene too.
            continue;
        }
        assert!(
            desk.explanation().contains("cornell_box.rhai"),
            "{}",
            desk.explanation()
        );
    }
    desk.save(file, &text);
    assert_eq!(desk.explanation(), "");
    assert!(
        desk.picture() == good,
        "the scene is good again, the picture is not"
    );
}

/// The editor's model on a project of its own.
struct Desk {
    workbench: Workbench,
    files: Files,
    project: PathBuf,
    // Last, so that the watcher ends before the folder does.
    _folder: TempDir,
}

impl Desk {
    fn open() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let files = Files::with_project(folder.path()).unwrap();
        let gpu = Gpu::open(&GpuOptions::default()).unwrap();
        let options = EditorOptions {
            scene: "cornell_box".to_owned(),
            ..EditorOptions::new(files.clone())
        };
        let mut workbench = Workbench::new(gpu, options, Arc::new(|| {}));
        workbench.resolution.adaptive = false;
        let mut desk = Self {
            workbench,
            files,
            project: folder.path().to_owned(),
            _folder: folder,
        };
        desk.settle();
        assert_eq!(desk.explanation(), "");
        desk.picture();
        desk
    }

    fn text(&self, file: &str) -> String {
        self.files.read_text(file).unwrap()
    }

    /// Saves a file and waits for what the editor makes of it.
    fn save(&mut self, file: &str, text: &str) {
        let path = self.project.join(Path::new(file));
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
        self.workbench.files_changed(&[file.to_owned()]);
        self.settle();
    }

    /// Ticks until nothing goes on any more.
    fn settle(&mut self) {
        let began = Instant::now();
        loop {
            self.workbench.tick(Instant::now());
            // A new pipeline is warmed by draws.
            self.workbench.draw(SIZE, Instant::now());
            let workbench = &self.workbench;
            let busy = workbench.pipelines.is_busy()
                || workbench.scenes.is_busy()
                || workbench.library.is_busy()
                || workbench.pipelines.is_warming()
                || !workbench.picture_is_current();
            if workbench.picture_ready() && !busy {
                return;
            }
            assert!(began.elapsed() < SETTLING, "the editor is busy without end");
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// What is on screen.
    fn picture(&mut self) -> Vec<u8> {
        let picture = self.workbench.picture().unwrap();
        read_bytes(self.workbench.gpu(), &picture.texture).unwrap()
    }

    /// All that the editor has to say against the newest state.
    fn explanation(&self) -> String {
        let problems = self.workbench.problems().map(ToString::to_string);
        problems.collect::<Vec<_>>().join("\n")
    }
}
