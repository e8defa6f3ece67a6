//! A project of a test's own: scenes, pipelines and shaders as texts.

use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::render::{Pipeline, PipelineDesc, Renderer};
use lightbench::script::{Scene, Settings, load_pipeline, load_scene};
use tempfile::TempDir;

/// A folder with files that lie over the shipped ones.
pub struct Workshop {
    /// The files.
    pub files: Files,
    folder: TempDir,
}

/// Reads `result`, so that it is needed.
const SHOW: &str = "@group(1) @binding(0) var result: texture_2d<f32>;
@fragment fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    return textureLoad(result, vec2u(pixel.xy) % textureDimensions(result), 0);
}";

impl Default for Workshop {
    fn default() -> Self {
        Self::new()
    }
}

impl Workshop {
    /// An empty project.
    pub fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        Self {
            files: Files::with_project(folder.path()).unwrap(),
            folder,
        }
    }

    /// Writes a file.
    pub fn write(&self, path: &str, text: &str) {
        let path = self.folder.path().join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }

    /// Writes the scene `test`, and loads it.
    pub fn scene(&self, text: &str) -> Scene {
        self.write("scripts/scenes/test.rhai", text);
        self.load("test", &Settings::new())
    }

    /// Loads a scene.
    pub fn load(&self, name: &str, settings: &Settings) -> Scene {
        load_scene(&self.files, name, settings, &Progress::default())
            .unwrap_or_else(|problems| panic!("{problems}"))
    }

    /// Writes the pipeline `test` with its shaders by name, and evaluates it. `body` declares a float
    /// target `result` and fills it; what shows it follows.
    pub fn pipeline(&self, body: &str, shaders: &[(&str, &str)]) -> PipelineDesc {
        self.write("shaders/show.wgsl", SHOW);
        for (name, text) in shaders {
            self.write(&format!("shaders/{name}.wgsl"), text);
        }
        let text = format!(
            "let p = pipeline(\"Test\");
            {body}
            p.target(\"output\", \"rgba8unorm\");
            p.fullscreen(\"show\").shader(\"shaders/show.wgsl\").reads(\"result\").writes(\"output\");
            p.show(\"output\");
            p"
        );
        self.write("scripts/pipelines/test.rhai", &text);
        load_pipeline(&self.files, "test", &Settings::new())
            .unwrap_or_else(|problems| panic!("{problems}"))
    }

    /// Compiles a pipeline so that all its targets can be read after a frame.
    pub fn compile(&self, renderer: &Renderer, desc: &PipelineDesc) -> Pipeline {
        let mut pipeline = renderer
            .compiler()
            .compile(&self.files, desc)
            .unwrap_or_else(|problems| panic!("{problems}"));
        pipeline.keep_all_targets(true);
        pipeline
    }
}
