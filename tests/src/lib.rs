//! What the end-to-end tests share: shipped scenes through shipped pipelines.
//!
//! The tests themselves lie in `tests/`, one file a question.
#![warn(missing_docs)]
// A test stops where something is wrong; there is nobody to hand an error to.
#![allow(clippy::unwrap_used, clippy::missing_panics_doc)]

use lightbench::assets::files::Files;
use lightbench::assets::{Assets, MaterialId, Progress, ReflectionModels};
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

    /// Draws one frame of the scene at its beginning.
    pub fn draw(&mut self, pipeline: &str, settings: &Settings, size: (u32, u32)) -> Pipeline {
        let desc = load_pipeline(&self.files, pipeline, settings).unwrap_or_else(|e| panic!("{e}"));
        let mut pipeline = self
            .renderer
            .compiler()
            .compile(&self.files, &desc)
            .unwrap_or_else(|e| panic!("{e}"));
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
