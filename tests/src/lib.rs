//! What the end-to-end tests share: shipped scenes through shipped pipelines.
//!
//! The tests themselves lie in `tests/`, one file a question.
#![warn(missing_docs)]
// A test stops where something is wrong; there is nobody to hand an error to.
#![allow(clippy::unwrap_used, clippy::missing_panics_doc)]

use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::render::{Gpu, GpuOptions, Pipeline, Renderer, TargetImage, View};
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
        }
    }

    /// Shows a scene of a project instead.
    pub fn show(&mut self, files: Files, scene: &str) {
        let scene = load_scene(&files, scene, &Settings::new(), &Progress::default());
        self.scene = scene.unwrap_or_else(|e| panic!("{e}"));
        self.view = View::from_world(&self.scene.world).unwrap_or_default();
        self.files = files;
        self.renderer.reset_scene();
    }

    /// A shipped pipeline, or one of the project.
    pub fn compile(&self, pipeline: &str, settings: &Settings) -> Pipeline {
        let desc = load_pipeline(&self.files, pipeline, settings).unwrap_or_else(|e| panic!("{e}"));
        self.renderer
            .compiler()
            .compile(&self.files, &desc)
            .unwrap_or_else(|e| panic!("{e}"))
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
}
