//! Scenes through the path tracer, and what their noise allows.

use glam::DVec3;
use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::lab::tracer::{Options, Traced, TracedScene, trace};
use lightbench::render::View;
use lightbench::script::{Settings, load_scene};

use crate::project;

/// A scene ready to be traced, and its camera.
pub struct Set {
    /// The scene.
    pub scene: TracedScene,
    /// Its camera.
    pub view: View,
}

impl Set {
    /// A scene from the text of a script.
    pub fn of(script: &str) -> Self {
        let (_folder, files) = project(&[("scripts/scenes/traced.rhai", script)]);
        Self::load(&files, "traced", &Settings::new())
    }

    /// A scene by its name.
    pub fn load(files: &Files, name: &str, settings: &Settings) -> Self {
        let scene = load_scene(files, name, settings, &Progress::default());
        let mut scene = scene.unwrap_or_else(|e| panic!("{e}"));
        scene.refresh();
        Self {
            scene: TracedScene::new(&scene.world, &scene.assets),
            view: View::from_world(&scene.world).unwrap_or_default(),
        }
    }

    /// The same, seen from so far off a point that all pixels show it from one direction.
    #[must_use]
    pub fn seen_at(mut self, point: DVec3, from: DVec3) -> Self {
        const ANGLE: f32 = 1e-3;
        let (eye, point) = ((point + from).as_vec3(), point.as_vec3());
        self.view = View::look_at(eye, point, ANGLE, 0.01, 1000.0);
        self
    }

    /// Traces it.
    pub fn trace(&self, options: &Options) -> Traced {
        trace(&self.scene, &self.view, options, &Progress::new()).unwrap()
    }

    /// The mean of the red channel of all pixels, which all show the same.
    pub fn estimate(&self, options: &Options) -> Estimate {
        Estimate::of_all(&self.trace(options))
    }
}

/// A mean with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The mean.
    pub mean: f64,
    /// Its standard error.
    pub error: f64,
}

impl Estimate {
    /// Of the red channel of all pixels.
    pub fn of_all(traced: &Traced) -> Self {
        let red = |pixels: &[[f32; 4]]| pixels.iter().map(|p| f64::from(p[0])).sum::<f64>();
        let count = traced.picture.pixels.len() as f64;
        Self {
            mean: red(&traced.picture.pixels) / count,
            error: red(&traced.variance.pixels).sqrt() / count,
        }
    }

    /// How many standard errors it is off a value. What 32 bits round is no deviation.
    pub fn deviations(&self, expected: f64) -> f64 {
        (self.mean - expected) / (self.error + 2e-6 * expected.abs()).max(1e-12)
    }

    /// How many standard errors of the difference two estimates are apart (Welch 1947, "The
    /// Generalization of Student's Problem when Several Different Population Variances are Involved"; with
    /// so many samples the distribution is normal).
    pub fn apart(&self, other: &Self) -> f64 {
        let error = (self.error.powi(2) + other.error.powi(2)).sqrt();
        (self.mean - other.mean) / (error + 2e-6 * self.mean.abs()).max(1e-12)
    }
}

/// The share of the hemisphere, weighed by the cosine, that a rectangle covers which lies parallel above
/// a point: `half` is half its width and depth, its middle `height` above the point. The closed form of
/// a corner, four times (Howell, Mengüç, Daun and Siegel 2020, "Thermal Radiation Heat Transfer",
/// configuration C-11).
pub fn form_factor([half_x, half_y]: [f64; 2], height: f64) -> f64 {
    let (a, b) = (half_x / height, half_y / height);
    let side = |a: f64, b: f64| {
        let length = (1.0 + a * a).sqrt();
        a / length * (b / length).atan()
    };
    4.0 * (side(a, b) + side(b, a)) / std::f64::consts::TAU
}
