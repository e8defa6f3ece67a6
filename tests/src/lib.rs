//! What the end-to-end tests share: shipped scenes through shipped pipelines.
//!
//! The tests themselves lie in `tests/`, one file a question.
#![warn(missing_docs)]
// A test stops where something is wrong; there is nobody to hand an error to.
#![allow(clippy::unwrap_used, clippy::missing_panics_doc)]

pub mod buffers;
pub mod compare;
pub mod flat;
pub mod grid;
pub mod lists;
pub mod mutation;
pub mod panes;
pub mod pixels;
pub mod tracing;
pub mod workshop;

pub use workshop::Workshop;

use std::cell::RefCell;

use lightbench::assets::files::Files;
use lightbench::assets::{Assets, MaterialId, Progress, ReflectionModels};
use lightbench::render::{
    Compiler, Gpu, GpuOptions, Pipeline, Renderer, TargetImage, Variants, View,
};
use lightbench::script::{Scene, Settings, load_pipeline, load_scene};

/// A scene and a device to draw it on.
pub struct Studio {
    /// The device with the scene on it.
    pub renderer: Renderer,
    /// The shipped files.
    pub files: Files,
    /// The scene.
    pub scene: Scene,
    /// The scene's camera.
    pub view: View,
    /// What has compiled the shipped files, and keeps what pipelines share.
    shipped: RefCell<Option<Compiler>>,
}

/// Settings from `name=value` texts.
pub fn settings(texts: &[&str]) -> Settings {
    let mut settings = Settings::new();
    texts
        .iter()
        .for_each(|text| settings.set_from_text(text).unwrap());
    settings
}

/// Opens a device, or says how to get a driver.
pub fn gpu(portable: bool) -> Gpu {
    Gpu::open(&GpuOptions {
        adapter: None,
        portable,
    })
    .unwrap_or_else(|error| panic!("{error}"))
}

impl Studio {
    /// A shipped scene on the default device.
    pub fn new(scene: &str, settings: &Settings) -> Self {
        Self::on(gpu(false), scene, settings)
    }

    /// A shipped scene on a device.
    pub fn on(gpu: Gpu, scene: &str, settings: &Settings) -> Self {
        let files = Files::shipped();
        let scene = load_scene(&files, scene, settings, &Progress::default())
            .unwrap_or_else(|e| panic!("{e}"));
        let view = View::from_world(&scene.world).unwrap_or_default();
        Self {
            renderer: Renderer::new(gpu),
            files,
            scene,
            view,
            shipped: RefCell::new(None),
        }
    }

    /// Shows a scene of a project instead.
    pub fn show(&mut self, files: Files, scene: &str) {
        self.files = files;
        self.load(scene, &Settings::new());
    }

    /// Shows another scene instead.
    pub fn load(&mut self, scene: &str, settings: &Settings) {
        let scene = load_scene(&self.files, scene, settings, &Progress::default());
        self.scene = scene.unwrap_or_else(|e| panic!("{e}"));
        self.view = View::from_world(&self.scene.world).unwrap_or_default();
        self.renderer.reset_scene();
    }

    /// A shipped pipeline, or one of the project, for the reflection models of the scene.
    pub fn compile(&self, pipeline: &str, settings: &Settings) -> Pipeline {
        let desc = load_pipeline(&self.files, pipeline, settings).unwrap_or_else(|e| panic!("{e}"));
        let variants = if self.scene.assets.reflection_models().has_others() {
            Variants::ALL
        } else {
            Variants::DEFAULT_MODEL
        };
        let mut shipped = self.shipped.borrow_mut();
        // The files of a project may have changed since.
        let mut fresh = None;
        let compiler = match self.files.project() {
            Some(_) => fresh.insert(self.renderer.compiler()),
            None => shipped.get_or_insert_with(|| self.renderer.compiler()),
        };
        let pipeline = compiler.compile_for(&self.files, &desc, variants);
        pipeline.unwrap_or_else(|e| panic!("{e}"))
    }

    /// Draws one frame of the scene at its beginning, and keeps all targets and the counters.
    pub fn draw_whole(
        &mut self,
        pipeline: &str,
        settings: &Settings,
        size: (u32, u32),
    ) -> (Pipeline, Counts) {
        let mut pipeline = self.compile(pipeline, settings);
        pipeline.keep_all_targets(true);
        let (world, assets) = (&mut self.scene.world, &self.scene.assets);
        if pipeline.may_outgrow() {
            self.renderer
                .render_whole(world, assets, &mut pipeline, &self.view, size, 0.0)
                .unwrap();
        }
        let serial = self.renderer.next_frame();
        self.renderer
            .render(world, assets, &mut pipeline, &self.view, size, 0.0)
            .unwrap();
        let measured = self.renderer.finish(60).unwrap();
        let measured = measured.into_iter().find(|m| m.frame == serial).unwrap();
        let names = pipeline.desc.counters.iter().map(|c| c.name.clone());
        let counts = Counts(names.zip(measured.counters).collect());
        (pipeline, counts)
    }

    /// Draws one frame of the scene at its beginning.
    pub fn draw(&mut self, pipeline: &str, settings: &Settings, size: (u32, u32)) -> Pipeline {
        let mut pipeline = self.compile(pipeline, settings);
        let (world, assets) = (&mut self.scene.world, &self.scene.assets);
        self.renderer
            .render_whole(world, assets, &mut pipeline, &self.view, size, 0.0)
            .unwrap();
        pipeline
    }

    /// The reflection models that a pipeline says it carries.
    pub fn models(&self, pipeline: &str, settings: &Settings) -> ReflectionModels {
        let desc = load_pipeline(&self.files, pipeline, settings).unwrap_or_else(|e| panic!("{e}"));
        desc.reflection_models()
    }

    /// Gives each material of the scene the nearest reflection model among some, as a pipeline does
    /// that carries no others. Returns the assets as they were.
    pub fn replace_models(&mut self, carried: ReflectionModels) -> Assets {
        let before = self.scene.assets.clone();
        for (index, entry) in before.materials().iter().enumerate() {
            let mut material = entry.value.clone();
            material.reflection = material.reflection.nearest(carried);
            let id = MaterialId(index as u32);
            self.scene.assets.replace_material(id, material).unwrap();
        }
        before
    }

    /// The linear picture of a frame.
    pub fn hdr(&mut self, pipeline: &str, settings: &Settings, size: (u32, u32)) -> TargetImage {
        let pipeline = self.draw(pipeline, settings, size);
        self.renderer.read_hdr(&pipeline).unwrap().unwrap()
    }

    /// The picture of a frame as a display shows it, RGBA with 8 bits.
    pub fn output(&mut self, pipeline: &str, settings: &Settings, size: (u32, u32)) -> Vec<u8> {
        let pipeline = self.draw(pipeline, settings, size);
        self.renderer.read_output(&pipeline).unwrap().2
    }
}

/// What the counters of a pipeline said of a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Counts(Vec<(String, u32)>);

impl Counts {
    /// One of them.
    pub fn of(&self, name: &str) -> u32 {
        let found = self.0.iter().find(|(known, _)| known == name);
        found
            .unwrap_or_else(|| panic!("there is no counter `{name}` in {self:?}"))
            .1
    }
}

/// A project that lays files over the shipped ones, until the folder is dropped.
pub fn project(files: &[(&str, &str)]) -> (tempfile::TempDir, Files) {
    let folder = tempfile::tempdir().unwrap();
    for (path, text) in files {
        let path = folder.path().join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    let files = Files::with_project(folder.path()).unwrap();
    (folder, files)
}

/// A mistake: in a shipped file, one text in place of another.
pub type Mistake<'a> = (&'a str, &'a str, &'a str);

/// A project in which somebody made a mistake, with other files beside it.
pub fn project_with_mistake(
    files: &[(&str, &str)],
    (path, from, to): Mistake<'_>,
) -> (tempfile::TempDir, Files) {
    let text = Files::shipped().read_text(path).unwrap();
    assert!(text.contains(from), "{path} has no `{from}`");
    project(&[files, &[(path, &text.replace(from, to))]].concat())
}

/// The scene of [`hard_shapes`].
const SHAPES: &str = "
let cloth = material(\"cloth\").surface(weave_texture()).specular(0.1).power(60).two_sided();
let stone = material(\"stone\").surface(tiles_texture().pieces(3)).specular(0.2).power(90);
let leaf = material(\"leaf\").texture(picture(\"leaf.tga\")).cutoff(0.5).two_sided().specular(0.1);
spawn(\"floor\").mesh(plane(200, 200)).material(stone).at(0, -1, 0);
spawn(\"near\").mesh(plane(3, 3)).material(stone).at(0, -0.2, 4.9);
spawn(\"mirrored\").mesh(torus(0.6, 0.25)).material(stone).at(-2.2, 0.2, 0).scale(-1, 1.4, 0.7);
spawn(\"cloth\").mesh(plane(2, 2)).material(cloth).at(0, 0.4, -1).turn(-70, 20, 0);
spawn(\"behind\").mesh(plane(2, 2)).material(cloth).at(2.2, 0.4, -1).turn(80, 190, 10);
spawn(\"leaf\").mesh(plane(1.5, 1.5)).material(leaf).at(1.2, 0.3, 1.5).turn(75, 0, 0);
spawn(\"ball\").mesh(sphere(0.5).segments(96, 48)).material(stone).at(-0.9, -0.2, 1.6);
point_light(\"lamp\").at(1, 2, 3).range(12).intensity(9);
point_light(\"other\").at(-3, 1, 1).range(9).intensity(6).color(0.4, 0.6, 1);
ambient_light(\"sky\").color(0.6, 0.7, 1).intensity(0.1);
camera(\"eye\").at(0, 0.8, 5).look_at(0, 0, 0).fov(55).near(0.1).far(90);
";

/// A green picture full of round holes, as a TGA file of 32 bits a pixel.
fn leaf() -> Vec<u8> {
    let mut bytes = vec![0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 64, 0, 64, 0, 32, 0x28];
    for pixel in 0..64 * 64_i32 {
        let (x, y) = (pixel % 64 % 16 - 8, pixel / 64 % 16 - 8);
        let alpha = if x * x + y * y < 30 { 0 } else { 255 };
        bytes.extend([40, 160, 60, alpha]);
    }
    bytes
}

/// A project with the scene `shapes`, whose surfaces are hard to find: mirrored, scaled unevenly, seen
/// from behind, full of holes, cut by the near plane, bumpy, with large and small triangles.
pub fn hard_shapes() -> (tempfile::TempDir, Files) {
    let (folder, files) = project(&[("scripts/scenes/shapes.rhai", SHAPES)]);
    std::fs::write(folder.path().join("leaf.tga"), leaf()).unwrap();
    (folder, files)
}

/// Numbers that look random and are the same in every run (SplitMix64, Steele et al. 2014).
pub struct Numbers(pub u64);

impl Numbers {
    /// The next number below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % end as u64) as usize
    }

    /// One of some things.
    pub fn pick<'a, T>(&mut self, things: &'a [T]) -> &'a T {
        &things[self.below(things.len())]
    }
}
