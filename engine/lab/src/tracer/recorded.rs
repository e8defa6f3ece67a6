//! The rays of a picture, to send them through the bare tree once more.

use lightbench_render::View;
use obvhs::ray::Ray;

use super::camera::Sight;
use super::options::Options;
use super::rays::Witness;
use super::{TracedScene, Tracer};

/// The rays of a picture, in the order in which one thread sends them.
#[derive(Clone, Debug, Default)]
pub struct Recorded {
    rays: Vec<(Kind, Ray)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Nearest,
    Clear,
}

impl Witness for Recorded {
    fn nearest(&mut self, ray: &Ray) {
        self.rays.push((Kind::Nearest, *ray));
    }

    fn clear(&mut self, ray: &Ray) {
        self.rays.push((Kind::Clear, *ray));
    }
}

impl Recorded {
    /// Those of the first sample of each pixel.
    pub fn of(scene: &TracedScene, view: &View, options: &Options) -> Self {
        let sight = Sight::new(view, options.size);
        let mut tracer = Tracer::new(scene, &sight, options);
        let mut recorded = Self::default();
        for y in 0..options.size.1 {
            for x in 0..options.size.0 {
                tracer.sample([x, y], 0, &mut recorded);
            }
        }
        recorded
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.rays.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.rays.is_empty()
    }

    /// Sends all rays through the tree of the scene, with no regard to what triangles are made of, and
    /// counts those that meet something: what the tree alone takes.
    pub fn replay(&self, scene: &TracedScene) -> usize {
        let meets = |(kind, ray): &&(Kind, Ray)| match kind {
            Kind::Nearest => scene.geometry.bare_nearest(*ray),
            Kind::Clear => !scene.geometry.bare_clear(*ray),
        };
        self.rays.iter().filter(meets).count()
    }
}
