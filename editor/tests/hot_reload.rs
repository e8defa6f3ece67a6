//! Saves that reach the picture while the editor runs: what they build again, and what they survive.
//! Through the editor's model, without its widgets.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use lightbench::assets::files::Files;
use lightbench::render::readback::read_bytes;
use lightbench::render::{Gpu, GpuOptions};
use lightbench_editor::ui::EditorOptions;
use lightbench_editor::ui::workbench::Workbench;

const PATIENCE: Duration = Duration::from_secs(60);
const SIZE: (u32, u32) = (48, 27);

const SCENE: &str = r#"import "parts/lamp" as lamp;
let paint = material("paint").texture(picture("textures/paint.png")).specular(0.04).power(40);
spawn("floor").mesh(plane(6, 6)).material(paint);
load_obj("models/block.obj").at(0, 0.2, 0);
lamp::hang(2.5);
camera("main").at(0, 2, 5).look_at(0, 0.5, 0).fov(50);
"#;
const LAMP: &str = "fn hang(height) {
    point_light(\"lamp\").at(1, height, 2).intensity(6).range(8);
    ambient_light(\"sky\").intensity(0.2);
}
";
const BLOCK: &str = "v -1 0 0\nv 1 0 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
const PIPELINE: &str = r#"import "parts/end" as end;
let p = pipeline("Mine");
p.target("depth", "depth32float");
p.target("hdr", "rgba16float");
p.geometry("draw").shader("shaders/mine.wgsl").object_lights("all")
    .writes("hdr").clear(0, 0, 0, 0).depth("depth").clear(0.0);
end::finish(p);
p
"#;
const END: &str = r#"import "output" as output;
fn finish(p) { output::add(p, "hdr"); }
"#;
const SHADER: &str = "#import lightbench::scene
#import lightbench::geometry
#import lightbench::surface
#import lightbench::lighting
#import mine::tint

@fragment
fn fragment_main(
    in: geometry::VertexOutput,
    @builtin(front_facing) front_facing: bool,
) -> @location(0) vec4f {
    let fragment = surface::fragment_surface(in, front_facing);
    let to_viewer = surface::safe_normalize(scene::frame.camera_position - fragment.position);
    var radiance = vec3f(0.0);
    for (var i = 0u; i < scene::frame.light_count; i++) {
        radiance += lighting::evaluate_light(scene::lights[i], fragment, to_viewer);
    }
    return vec4f(tint::tinted(radiance), 1.0);
}
";
const TINT: &str = "#define_import_path mine::tint
fn tinted(color: vec3f) -> vec3f { return color * vec3f(1.0, 0.9, 0.8); }
";

/// Everything that the picture is made of, by path.
fn sources() -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("scripts/scenes/mine.rhai", SCENE.into()),
        ("scripts/scenes/parts/lamp.rhai", LAMP.into()),
        ("models/block.obj", BLOCK.into()),
        ("textures/paint.png", png([200, 120, 60])),
        ("scripts/pipelines/mine.rhai", PIPELINE.into()),
        ("scripts/pipelines/parts/end.rhai", END.into()),
        ("shaders/mine.wgsl", SHADER.into()),
        ("shaders/lib/mine_tint.wgsl", TINT.into()),
    ]
}

/// A picture of one colour.
fn png(color: [u8; 3]) -> Vec<u8> {
    let mut bytes = Vec::new();
    image::RgbImage::from_pixel(4, 4, image::Rgb(color))
        .write_to(
            &mut std::io::Cursor::new(&mut bytes),
            image::ImageFormat::Png,
        )
        .unwrap();
    bytes
}

/// A project under the eyes of an editor.
struct Desk {
    workbench: Workbench,
    // Last, so that the watcher ends before the folder does.
    folder: tempfile::TempDir,
}

impl Desk {
    fn open() -> Self {
        let folder = tempfile::tempdir().unwrap();
        for (path, content) in sources() {
            write(&folder.path().join(path), &content);
        }
        Self::on(folder)
    }

    fn on(folder: tempfile::TempDir) -> Self {
        let files = Files::with_project(folder.path()).unwrap();
        let options = EditorOptions {
            scene: "mine".to_owned(),
            pipeline: "mine".to_owned(),
            ..EditorOptions::new(files)
        };
        let gpu = Gpu::open(&GpuOptions::default()).unwrap();
        let mut workbench = Workbench::new(gpu, options, Arc::new(|| {}));
        workbench.resolution.adaptive = false;
        let mut desk = Self { workbench, folder };
        desk.until("the first picture", |w| w.drawn_size() == Some(SIZE));
        desk
    }

    fn path(&self, path: &str) -> PathBuf {
        self.folder.path().join(path)
    }

    fn step(&mut self) {
        self.workbench.tick(Instant::now());
        self.workbench.draw(SIZE, Instant::now());
    }

    fn until(&mut self, what: &str, done: impl Fn(&mut Workbench) -> bool) {
        let began = Instant::now();
        loop {
            self.step();
            if done(&mut self.workbench) {
                return;
            }
            let problems: Vec<_> = self.workbench.problems().map(ToString::to_string).collect();
            assert!(
                began.elapsed() < PATIENCE,
                "waited in vain for {what}: {problems:?}"
            );
            std::thread::sleep(Duration::from_millis(3));
        }
    }

    /// Goes on until nothing has happened for a while.
    fn settle(&mut self) {
        let mut quiet = Instant::now();
        let began = Instant::now();
        while quiet.elapsed() < Duration::from_millis(250) {
            assert!(began.elapsed() < PATIENCE, "it never ends");
            self.step();
            let w = &self.workbench;
            if w.scenes.is_busy()
                || w.pipelines.is_busy()
                || w.pipelines.is_warming()
                || !w.picture_is_current()
            {
                quiet = Instant::now();
            }
            std::thread::sleep(Duration::from_millis(3));
        }
    }

    /// The bytes on screen.
    fn picture(&mut self) -> Vec<u8> {
        let picture = self.workbench.picture().unwrap();
        read_bytes(self.workbench.gpu(), &picture.texture).unwrap()
    }

    fn problems(&self) -> Vec<String> {
        let problems = self.workbench.problems();
        problems.map(ToString::to_string).collect()
    }

    /// What an editor shows that opens the project as it is now.
    fn fresh(&self) -> Vec<u8> {
        let copy = tempfile::tempdir().unwrap();
        for (path, _) in sources() {
            if let Ok(content) = fs::read(self.path(path)) {
                write(&copy.path().join(path), &content);
            }
        }
        Desk::on(copy).picture()
    }
}

fn write(path: &std::path::Path, content: &[u8]) {
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, content).unwrap();
}

/// What of the picture hangs on a file.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Hangs {
    Scene,
    Pipeline,
    Nothing,
}

#[test]
fn a_save_builds_again_only_what_depends_on_it() {
    let mut desk = Desk::open();
    let table: [(&str, Vec<u8>, Hangs); 11] = [
        (
            "shaders/mine.wgsl",
            SHADER.replace("vec3f(0.0)", "vec3f(0.05)").into(),
            Hangs::Pipeline,
        ),
        (
            "shaders/lib/mine_tint.wgsl",
            TINT.replace("0.8", "0.5").into(),
            Hangs::Pipeline,
        ),
        (
            "scripts/pipelines/parts/end.rhai",
            format!("{END}// more\n").into(),
            Hangs::Pipeline,
        ),
        (
            "scripts/pipelines/mine.rhai",
            PIPELINE.replace("0, 0, 0, 0", "0, 0, 0.3, 0").into(),
            Hangs::Pipeline,
        ),
        (
            "scripts/scenes/mine.rhai",
            SCENE.replace("2.5", "1.5").into(),
            Hangs::Scene,
        ),
        (
            "scripts/scenes/parts/lamp.rhai",
            LAMP.replace("(6)", "(9)").into(),
            Hangs::Scene,
        ),
        (
            "models/block.obj",
            BLOCK.replace("1 1 0", "1 2 0").into(),
            Hangs::Scene,
        ),
        ("textures/paint.png", png([40, 120, 200]), Hangs::Scene),
        // Neither the shader nor what it imports uses these.
        (
            "shaders/lib/tile_lights.wgsl",
            b"nonsense".to_vec(),
            Hangs::Nothing,
        ),
        (
            "shaders/tiled/shade.wgsl",
            b"nonsense".to_vec(),
            Hangs::Nothing,
        ),
        (
            "scripts/pipelines/tiled_forward.rhai",
            b"nonsense".to_vec(),
            Hangs::Nothing,
        ),
    ];
    for (path, content, hangs) in table {
        let before = desk.picture();
        let swaps = desk.workbench.pipelines.swaps();
        write(&desk.path(path), &content);
        desk.settle();
        assert_eq!(desk.problems(), Vec::<String>::new(), "{path}");
        let scene = desk.workbench.scenes.changed(&[path.to_owned()]);
        assert_eq!(scene, hangs == Hangs::Scene, "{path}");
        let built = desk.workbench.pipelines.swaps() - swaps;
        // A comment in a script changes nothing that was built.
        let expected = u64::from(hangs == Hangs::Pipeline && !path.ends_with("end.rhai"));
        assert_eq!(built, expected, "{path}");
        desk.settle();
        let changed = desk.picture() != before;
        assert_eq!(
            changed,
            hangs != Hangs::Nothing && !path.ends_with("end.rhai"),
            "{path}"
        );
    }
    assert!(desk.picture() == desk.fresh());
}

/// Everything that can happen to a file between two good states, for each kind of file: the last
/// good picture stays, an explanation comes, and the next good state is shown.
#[test]
fn files_that_are_half_written_empty_renamed_or_gone_keep_the_last_picture() {
    let mut desk = Desk::open();
    for (path, content) in sources() {
        let good = desk.picture();
        let file = desk.path(path);
        let away = desk.path("away.keep");
        type Spoil = fn(&std::path::Path, &std::path::Path, &[u8]);
        let spoils: [(&str, Spoil); 4] = [
            ("half", |file, _, content| {
                fs::write(file, &content[..content.len() * 3 / 5]).unwrap();
            }),
            ("empty", |file, _, _| fs::write(file, b"").unwrap()),
            ("renamed", |file, away, _| fs::rename(file, away).unwrap()),
            ("deleted", |file, _, _| fs::remove_file(file).unwrap()),
        ];
        for (what, spoil) in spoils {
            spoil(&file, &away, &content);
            desk.settle();
            let problems = desk.problems();
            // Some halves are whole files of another meaning: then the picture follows.
            if problems.is_empty() {
                assert!(desk.picture() == desk.fresh(), "{path} {what}");
            } else {
                assert!(desk.picture() == good, "{path} {what}: {problems:?}");
                assert!(
                    problems.iter().all(|problem| problem.contains(".rhai")
                        || problem.contains(".wgsl")
                        || problem.contains(path)),
                    "{path} {what}: {problems:?}"
                );
            }
            let _ = fs::remove_file(&away);
            write(&file, &content);
            desk.settle();
            assert_eq!(desk.problems(), Vec::<String>::new(), "{path} {what}");
            assert!(
                desk.picture() == good,
                "{path} {what}: not as before when mended"
            );
        }
    }
}

#[test]
fn saves_through_a_temporary_file_and_a_hundred_in_a_second_end_with_the_last() {
    let mut desk = Desk::open();
    let text = |edit: usize| SHADER.replace("vec3f(0.0)", &format!("vec3f(0.{edit:03})"));
    let file = desk.path("shaders/mine.wgsl");
    for (edit, temporary) in [
        "shaders/.mine.wgsl.swp",
        "shaders/mine.wgsl~",
        "shaders/4913",
    ]
    .into_iter()
    .enumerate()
    {
        let temporary = desk.path(temporary);
        fs::write(&temporary, text(10 + edit)).unwrap();
        fs::rename(&temporary, &file).unwrap();
        desk.settle();
        assert!(desk.picture() == desk.fresh(), "{temporary:?}");
    }
    let saved = file.clone();
    let writer = std::thread::spawn(move || {
        for edit in 100..200 {
            fs::write(&saved, text(edit)).unwrap();
            std::thread::sleep(Duration::from_millis(10));
        }
    });
    while !writer.is_finished() {
        desk.step();
        std::thread::sleep(Duration::from_millis(3));
    }
    writer.join().unwrap();
    desk.settle();
    assert_eq!(desk.problems(), Vec::<String>::new());
    assert!(fs::read_to_string(&file).unwrap().contains("0.199"));
    assert!(desk.picture() == desk.fresh());
}

#[test]
fn a_save_during_a_load_is_not_lost() {
    let mut desk = Desk::open();
    // The load begins with the first save and has read the lamp when the second comes.
    for height in 1..6 {
        let scene = SCENE.replace("2.5", &format!("{}", 1.0 + 0.2 * f64::from(height)));
        write(&desk.path("scripts/scenes/mine.rhai"), scene.as_bytes());
        desk.until("the load", |w| w.scenes.loading().is_some());
        let lamp = LAMP.replace("(6)", &format!("({})", 6 + height));
        write(
            &desk.path("scripts/scenes/parts/lamp.rhai"),
            lamp.as_bytes(),
        );
        desk.settle();
        assert!(desk.picture() == desk.fresh(), "{height}");
    }
}
