//! One picture of a scene, a pipeline or an example.

use std::sync::{Arc, Mutex, PoisonError};

use lightbench::assets::files::{Access, Files};
use lightbench::assets::{Digest, Progress};
use lightbench::lab::capture::{CaptureOptions, capture};
use lightbench::render::{Gpu, GpuOptions, Pipeline, Renderer, Variants, heat_map};
use lightbench::script::{Scene, Settings, load_pipeline, load_scene};

use super::super::cards::Opens;
use super::super::kept_pictures::{self, Inputs, Picture};
use crate::ui::messages::say;

/// Pixels of a picture.
const SIZE: (u32, u32) = (320, 180);

/// The frame that is shown: what moves has begun to.
const FRAME: u32 = 20;

/// How scenes are drawn.
const PIPELINE: &str = "deferred_shading";

/// What pipelines draw. All draw the same picture of it, so what tells them apart is shown: how
/// many lights each computes for each pixel.
const SCENE: &str = "atrium";

/// Lights that count as most in that picture.
const MOST_LIGHTS: f64 = 24.0;

/// What examples of passes draw.
const SMALL_SCENE: &str = "cornell_box";

/// A device and what it has drawn with.
pub struct Studio {
    files: Files,
    renderer: Renderer,
    /// For scenes, once it was built, with what it was made from.
    pipeline: Option<(Pipeline, Inputs)>,
}

impl Studio {
    /// Opens a device.
    pub fn open(files: &Files, gpu: &GpuOptions) -> Result<Self, String> {
        let gpu = Gpu::open(gpu).map_err(|error| error.to_string())?;
        Ok(Self {
            files: files.clone(),
            renderer: Renderer::new(gpu),
            pipeline: None,
        })
    }

    /// Draws a picture. Returns what it was made from as well.
    pub fn draw(
        &mut self,
        path: &str,
        opens: Opens,
        progress: &Progress,
    ) -> Result<(Picture, Inputs), String> {
        match opens {
            Opens::Script => Err(say!("gallery.an_experiment").to_owned()),
            Opens::Scene => {
                let (scene, mut read) = self.scene(path, progress)?;
                let built = self.pipeline.take().filter(|(_, made_of)| {
                    kept_pictures::inputs(&self.files, made_of.keys()) == *made_of
                });
                let (mut pipeline, made_of) = match built {
                    Some(built) => built,
                    None => self.build(PIPELINE, &Settings::new(), Variants::ALL)?,
                };
                read.extend(made_of.clone());
                let picture = self.capture(scene, &mut pipeline, progress);
                self.pipeline = Some((pipeline, made_of));
                Ok((picture?, read))
            }
            Opens::Pipeline => {
                let is_example = path.contains("/examples/");
                let (scene, settings) = if is_example {
                    (SMALL_SCENE, Settings::new())
                } else {
                    let work = Settings::new()
                        .with(heat_map::PARAMETER, "lights_evaluated")
                        .with(heat_map::MOST, MOST_LIGHTS);
                    (SCENE, work)
                };
                let (scene, mut read) = self.scene(scene, progress)?;
                let variants = if scene.assets.reflection_models().has_others() {
                    Variants::ALL
                } else {
                    Variants::DEFAULT_MODEL
                };
                let (mut pipeline, more) = self.build(path, &settings, variants)?;
                read.extend(more);
                Ok((self.capture(scene, &mut pipeline, progress)?, read))
            }
        }
    }

    fn scene(&self, name: &str, progress: &Progress) -> Result<(Scene, Inputs), String> {
        self.reading(|files| {
            load_scene(files, name, &Settings::new(), progress)
                .map_err(|problems| problems.to_string())
        })
    }

    fn build(
        &self,
        name: &str,
        settings: &Settings,
        variants: Variants,
    ) -> Result<(Pipeline, Inputs), String> {
        // A compiler that has compiled before would not read again what it knows.
        let mut compiler = self.renderer.compiler();
        self.reading(|files| {
            let desc = load_pipeline(files, name, settings);
            desc.and_then(|desc| compiler.compile_for(files, &desc, variants))
                .map_err(|problems| problems.to_string())
        })
    }

    /// Takes note of all files that are read or looked for.
    fn reading<T>(
        &self,
        make: impl FnOnce(&Files) -> Result<T, String>,
    ) -> Result<(T, Inputs), String> {
        let read = Arc::new(Mutex::new(Inputs::new()));
        let told = Arc::clone(&read);
        let files = self.files.observed_with_missing(move |path, access| {
            let digest = match access {
                Access::Read(bytes) => Some(Digest::of(bytes).to_string()),
                Access::Missing => None,
            };
            let mut read = told.lock().unwrap_or_else(PoisonError::into_inner);
            read.insert(path.to_owned(), digest);
        });
        let made = make(&files)?;
        let read = read.lock().unwrap_or_else(PoisonError::into_inner).clone();
        Ok((made, read))
    }

    fn capture(
        &mut self,
        mut scene: Scene,
        pipeline: &mut Pipeline,
        progress: &Progress,
    ) -> Result<Picture, String> {
        self.renderer.reset_scene();
        let frame = if scene.moves() { FRAME } else { 0 };
        let options = CaptureOptions { size: SIZE, frame };
        let drawn = capture(&mut self.renderer, &mut scene, pipeline, options, progress)
            .map_err(|error| error.to_string())?;
        let output = drawn.output;
        Ok(Picture {
            size: [output.width as usize, output.height as usize],
            rgba: output.pixels.as_flattened().to_vec(),
        })
    }
}
