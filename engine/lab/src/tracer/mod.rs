//! A path tracer on the scenes, materials and lights of the pipelines: pictures to compare them with.
//!
//! It evaluates the same formulas as the shaders, from [`mod@crate::reference`], but finds out by rays
//! what is seen and what is lit. [`Mode`] says how much light it follows: what the pipelines compute,
//! the same with exact shadows, or light along all paths. The chapter `engine/lab/docs/tracer.md`
//! tells how, and what it leaves out.
//!
//! ```
//! use lightbench_assets::{Progress, files::Files};
//! use lightbench_lab::tracer::{Options, TracedScene, trace};
//! use lightbench_render::View;
//! use lightbench_script::{Settings, load_scene};
//!
//! let progress = Progress::new();
//! let mut scene = load_scene(&Files::shipped(), "cornell_box", &Settings::new(), &progress)?;
//! scene.refresh();
//! let view = View::from_world(&scene.world).unwrap_or_default();
//! let traced_scene = TracedScene::new(&scene.world, &scene.assets);
//! let options = Options { size: (32, 32), samples: 4, ..Options::default() };
//! let traced = trace(&traced_scene, &view, &options, &progress)?;
//! assert!(traced.picture.pixels.iter().any(|pixel| pixel[0] > 1.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod camera;
mod direct;
mod emitters;
mod film;
mod geometry;
mod joined;
mod lights;
mod options;
mod path;
mod point;
mod random;
mod rays;
mod recorded;
mod scatter;
mod scene;
mod shares;
mod texture;

use glam::{DVec2, DVec3};
use lightbench_assets::{Cancelled, Progress};
use lightbench_render::View;
use rayon::prelude::*;

pub use options::{Mode, Options, Sources, Strategy};
pub use recorded::Recorded;
pub use scene::TracedScene;
pub use shares::{LightAtPixel, LightShare, Reach};

use crate::HdrImage;
use camera::Sight;
use film::Pixel;
use path::Paths;
use random::Random;
use rays::{Count, Witness};

/// A traced picture and what it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Traced {
    /// Linear radiance; alpha is 1.
    pub picture: HdrImage,
    /// The variance of each value of the picture, from the spread of the samples. 0 where nothing was
    /// left to chance.
    pub variance: HdrImage,
    /// Samples that each pixel has at least: fewer than asked for where it was stopped.
    pub samples: u32,
    /// Whether it was stopped.
    pub stopped: bool,
    /// Rays that were sent.
    pub rays: u64,
    /// Samples that were no finite numbers and are left out.
    pub unusable: u64,
}

/// Traces a picture, one sample of every pixel after the other, on all threads of rayon's pool. The
/// picture depends on nothing but scene, view and options.
///
/// # Errors
/// It was stopped before each pixel had a sample. Stopped later, it gives what it has.
pub fn trace(
    scene: &TracedScene,
    view: &View,
    options: &Options,
    progress: &Progress,
) -> Result<Traced, Cancelled> {
    let (width, height) = options.size;
    let sight = Sight::new(view, options.size);
    let mut pixels = vec![Pixel::default(); width as usize * height as usize];
    let passes = options.passes();
    let mut rays = 0;
    for pass in 0..passes {
        let row = |(y, row): (usize, &mut [Pixel])| {
            let mut count = Count::default();
            // Later passes are left out, not cut off: each pixel keeps what it has.
            if progress.is_cancelled() {
                return count;
            }
            let mut tracer = Tracer::new(scene, &sight, options);
            for (x, pixel) in row.iter_mut().enumerate() {
                let place = [x as u32, y as u32];
                pixel.add(tracer.sample(place, pass, &mut count));
            }
            count
        };
        let rows = pixels.par_chunks_mut(width.max(1) as usize).enumerate();
        let counts: Vec<Count> = rows.map(row).collect();
        rays += counts.iter().map(|count| count.0).sum::<u64>();
        if progress.report((pass + 1) as f32 / passes as f32).is_err() {
            break;
        }
    }
    let taken = |pixel: &Pixel| pixel.samples() + pixel.unusable();
    let samples = pixels.iter().map(taken).min().unwrap_or(0);
    if samples == 0 {
        return Err(Cancelled);
    }
    Ok(Traced {
        picture: film::picture(&pixels, options.size),
        variance: film::variance(&pixels, options.size),
        samples,
        stopped: samples < passes,
        rays,
        unusable: pixels.iter().map(|pixel| u64::from(pixel.unusable())).sum(),
    })
}

/// Takes samples of pixels, on one thread.
struct Tracer<'a> {
    scene: &'a TracedScene,
    sight: &'a Sight,
    options: &'a Options,
    paths: Paths<'a>,
}

impl<'a> Tracer<'a> {
    fn new(scene: &'a TracedScene, sight: &'a Sight, options: &'a Options) -> Self {
        Self {
            scene,
            sight,
            options,
            paths: Paths::new(scene, options),
        }
    }

    fn sample(&mut self, place: [u32; 2], number: u32, witness: &mut impl Witness) -> DVec3 {
        let shadows = match self.options.mode {
            Mode::Direct => false,
            Mode::Shadowed => true,
            Mode::Full => return self.path(place, number, witness),
        };
        direct::radiance(self.scene, self.sight, place, shadows, witness)
    }

    fn path(&mut self, [x, y]: [u32; 2], number: u32, witness: &mut impl Witness) -> DVec3 {
        let pixel = u64::from(y) * u64::from(self.options.size.0) + u64::from(x);
        let mut random = Random::of_sample(self.options.seed, pixel, number.into());
        // Anywhere in the pixel, all places alike: a box is the filter.
        let within = DVec2::from_array(random.pair());
        let place = DVec2::new(x.into(), y.into()) + within;
        let direction = self.sight.direction(place);
        self.paths
            .radiance(self.sight, direction, &mut random, witness)
    }
}

/// Luminance of linear Rec. 709 (ITU-R BT.709-6, item 3.2).
fn luminance(color: DVec3) -> f64 {
    color.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}
