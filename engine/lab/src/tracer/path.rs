//! Light along all paths: from surface to surface, until the path leaves the scene or dies.
//!
//! Kajiya 1986, "The Rendering Equation". At each surface a path aims at lights and goes on into a
//! direction of the BRDF; both find surfaces that shine and the sky, and are weighed against each other
//! (Veach and Guibas 1995, "Optimally Combining Sampling Techniques for Monte Carlo Rendering").

use std::f64::consts::PI;

use glam::{DVec3, Vec3A};
use obvhs::ray::Ray;

use super::camera::Sight;
use super::geometry::Traits;
use super::lights::Weights;
use super::options::{Options, Strategy};
use super::point::{Line, Point};
use super::random::Random;
use super::rays::{Met, Witness, leave, leave_towards, to_lamp};
use super::scatter::{Scatter, cosine};
use super::scene::TracedScene;
use crate::reference::lighting::arriving;
use crate::reference::reflected;

/// Reflections after which a path that carries little may die.
const CERTAIN: u32 = 3;
/// How likely a path lives on at most, so that none lives for ever in a white room.
const MOST_LIKELY: f64 = 0.95;

/// Sends paths through a scene.
pub struct Paths<'a> {
    scene: &'a TracedScene,
    /// Whether lamps, surfaces that shine, and the sky light anything.
    lamps: bool,
    surfaces: bool,
    sky: bool,
    /// How likely a path that aims takes a surface that shines, and not the sky.
    aim_at_surfaces: f64,
    strategy: Strategy,
    depth: u32,
    weights: Weights,
}

/// How a path came to where it is.
struct Step {
    /// How likely it took the direction, 1/sr; none for lines of sight.
    density: Option<f64>,
    /// Where it came from.
    from: DVec3,
    /// The normal there.
    normal: DVec3,
}

impl<'a> Paths<'a> {
    /// Paths as the options want them.
    pub fn new(scene: &'a TracedScene, options: &Options) -> Self {
        let sources = options.sources;
        let surfaces = sources.surfaces && !scene.emitters.is_empty();
        let sky = sources.sky && scene.sky != DVec3::ZERO;
        Self {
            scene,
            lamps: sources.lights && scene.lights.len() > 0,
            surfaces: sources.surfaces,
            sky,
            aim_at_surfaces: match (surfaces, sky) {
                (true, true) => 0.5,
                (true, false) => 1.0,
                (false, _) => 0.0,
            },
            strategy: options.strategy,
            depth: options.depth.unwrap_or(u32::MAX),
            weights: Weights::default(),
        }
    }

    /// The radiance that one path finds along a line of sight.
    pub fn radiance(
        &mut self,
        sight: &Sight,
        direction: DVec3,
        random: &mut Random,
        witness: &mut impl Witness,
    ) -> DVec3 {
        let scene = self.scene;
        let mut line = Line {
            origin: sight.eye,
            direction,
            pixel: None,
        };
        let mut met = self.look(&line, sight, random, witness);
        let mut step = Step {
            density: None,
            from: sight.eye,
            normal: DVec3::ZERO,
        };
        let mut sum = DVec3::ZERO;
        let mut carried = DVec3::ONE;
        let mut reflections = 0;
        loop {
            let Some(point) = met else {
                return sum + carried * scene.sky * self.sky_weight(&step, line.direction);
            };
            let surface = &point.surface;
            let to_viewer = -line.direction.normalize();
            if surface.emissive != DVec3::ZERO {
                sum += carried * surface.emissive * self.emission_weight(&step, &point);
            }
            let black = !point.front && self.is_one_sided(&point);
            if reflections >= self.depth || black {
                return sum;
            }
            let Some(scatter) = Scatter::new(surface, to_viewer) else {
                return sum;
            };
            reflections += 1;
            if self.lamps {
                sum += carried * self.light_of_a_lamp(&point, to_viewer, random, witness);
            }
            if self.aims() {
                sum += carried * self.aim(&point, to_viewer, &scatter, random, witness);
            }
            let Some((direction, density)) = choose(&scatter, &point, random) else {
                return sum;
            };
            carried *= reflected(surface, direction, to_viewer) / density;
            if reflections >= CERTAIN {
                // Russian roulette (Arvo and Kirk 1990, "Particle Transport and Image Synthesis").
                let likely = carried.max_element().min(MOST_LIKELY);
                if random.number() >= likely {
                    return sum;
                }
                carried /= likely;
            }
            step = Step {
                density: Some(density),
                from: surface.position,
                normal: surface.normal,
            };
            met = self.meet(&point, direction, &mut line, random, witness);
        }
    }

    /// The first surface along a line of sight; transparent ones are passed by chance.
    fn look(
        &self,
        line: &Line,
        sight: &Sight,
        random: &mut Random,
        witness: &mut impl Witness,
    ) -> Option<Point> {
        let mut from = sight.near;
        loop {
            let met = self.scene.look(line, [from, sight.far], witness);
            match self.stop(line, met, random)? {
                Ok(point) => return Some(point),
                Err(at) => from = at.next_up(),
            }
        }
    }

    /// The next surface after one, and the line to it.
    fn meet(
        &self,
        point: &Point,
        direction: DVec3,
        line: &mut Line,
        random: &mut Random,
        witness: &mut impl Witness,
    ) -> Option<Point> {
        let mut ray = leave(
            point.surface.position,
            point.geometric,
            direction,
            f64::INFINITY,
        );
        *line = Line {
            origin: ray.origin.as_dvec3(),
            direction: ray.direction.as_dvec3(),
            pixel: None,
        };
        loop {
            let met = self.scene.meet(ray, witness);
            match self.stop(line, met, random)? {
                Ok(point) => return Some(point),
                Err(at) => ray.tmin = at.next_up(),
            }
        }
    }

    /// The surface that was met, or where a path that passes it goes on; none in the open.
    fn stop(&self, line: &Line, met: Met, random: &mut Random) -> Option<Result<Point, f32>> {
        let (triangle, at) = met?;
        let point = self.scene.point(line, triangle);
        let passes = point.opacity < 1.0 && random.number() >= point.opacity;
        Some(if passes { Err(at) } else { Ok(point) })
    }

    fn is_one_sided(&self, point: &Point) -> bool {
        self.scene
            .geometry
            .traits(point.triangle)
            .any(Traits::ONE_SIDED)
    }

    /// Whether paths aim at what shines.
    fn aims(&self) -> bool {
        let has_aims = self.aim_at_surfaces > 0.0 || self.sky;
        has_aims && self.strategy != Strategy::Scatter
    }

    /// The share of light that was found by chance, where aiming could have found it with `aimed`.
    fn found_by_chance(&self, density: f64, aimed: f64) -> f64 {
        match self.strategy {
            _ if aimed <= 0.0 => 1.0,
            Strategy::Scatter => 1.0,
            Strategy::Aim => 0.0,
            Strategy::Both => power_heuristic(density, aimed),
        }
    }

    /// The same for light that was aimed at.
    fn found_by_aiming(&self, aimed: f64, density: f64) -> f64 {
        match self.strategy {
            Strategy::Both => power_heuristic(aimed, density),
            Strategy::Aim | Strategy::Scatter => 1.0,
        }
    }

    /// What the sky counts for a path that leaves the scene. The viewer always sees it.
    fn sky_weight(&self, step: &Step, direction: DVec3) -> f64 {
        let Some(density) = step.density else {
            return 1.0;
        };
        if !self.sky {
            return 0.0;
        }
        let cosine = step.normal.dot(direction.normalize()).max(0.0);
        self.found_by_chance(density, (1.0 - self.aim_at_surfaces) * cosine / PI)
    }

    fn emission_weight(&self, step: &Step, point: &Point) -> f64 {
        let Some(density) = step.density else {
            return 1.0;
        };
        if !self.surfaces {
            return 0.0;
        }
        let scene = self.scene;
        let area = scene.emitters.density(&scene.geometry, point.triangle) * self.aim_at_surfaces;
        let offset = point.surface.position - step.from;
        let cosine = point.geometric.dot(offset.normalize_or_zero()).abs();
        let aimed = area * offset.length_squared() / cosine.max(1e-9);
        self.found_by_chance(density, aimed)
    }

    /// Light of one lamp, chosen by what it would send if nothing stood between.
    fn light_of_a_lamp(
        &mut self,
        point: &Point,
        to_viewer: DVec3,
        random: &mut Random,
        witness: &mut impl Witness,
    ) -> DVec3 {
        let surface = &point.surface;
        let number = random.number();
        let (lights, weights) = (&self.scene.lights, &mut self.weights);
        let chosen = lights.choose(surface.position, surface.normal, number, weights);
        let Some(choice) = chosen else {
            return DVec3::ZERO;
        };
        let Some(arrival) = arriving(&choice.light, surface.position) else {
            return DVec3::ZERO;
        };
        let to_light = arrival.to_light;
        let light = reflected(surface, to_light, to_viewer) * arrival.irradiance;
        if light == DVec3::ZERO || to_light.dot(point.geometric) <= 0.0 {
            return DVec3::ZERO;
        }
        let ray = to_lamp(point, &arrival);
        light * (self.scene.share(ray, Traits::EMISSIVE, witness) / choice.probability)
    }

    /// Light of a point of a surface that shines, or of the sky from a direction.
    fn aim(
        &self,
        point: &Point,
        to_viewer: DVec3,
        scatter: &Scatter,
        random: &mut Random,
        witness: &mut impl Witness,
    ) -> DVec3 {
        let (which, numbers) = (random.number(), random.pair());
        let surface = &point.surface;
        let aimed = if which < self.aim_at_surfaces {
            self.aim_at_surface(point, which / self.aim_at_surfaces, numbers)
        } else {
            Some(self.aim_at_sky(point, scatter, numbers))
        };
        let Some(aimed) = aimed.filter(|aimed| aimed.ray.direction != Vec3A::ZERO) else {
            return DVec3::ZERO;
        };
        let light = reflected(surface, aimed.direction, to_viewer) * aimed.radiance;
        if light == DVec3::ZERO || aimed.direction.dot(point.geometric) <= 0.0 {
            return DVec3::ZERO;
        }
        let share = self.scene.share(aimed.ray, Traits::default(), witness);
        let density = scatter.density(aimed.direction);
        light * (share * self.found_by_aiming(aimed.density, density) / aimed.density)
    }

    fn aim_at_surface(&self, point: &Point, which: f64, numbers: [f64; 2]) -> Option<Aimed> {
        let scene = self.scene;
        let aim = scene.emitters.choose(&scene.geometry, which, numbers)?;
        let offset = aim.position - point.surface.position;
        let direction = offset.try_normalize()?;
        let cosine = -direction.dot(aim.normal);
        let cosine = if aim.two_sided { cosine.abs() } else { cosine };
        (cosine > 0.0).then(|| Aimed {
            direction,
            radiance: aim.radiance,
            density: aim.density * self.aim_at_surfaces * offset.length_squared() / cosine,
            // Just short of the surface itself.
            ray: leave_towards(point, aim.position, 1.0 - 1e-4),
        })
    }

    /// Chooses a direction as Lambert's cosine weighs it, since the sky is the same all over.
    fn aim_at_sky(&self, point: &Point, scatter: &Scatter, numbers: [f64; 2]) -> Aimed {
        let local = cosine(numbers);
        let direction = scatter.in_world(local);
        Aimed {
            direction,
            radiance: self.scene.sky,
            density: (1.0 - self.aim_at_surfaces) * local.z / PI,
            ray: leave(
                point.surface.position,
                point.geometric,
                direction,
                f64::INFINITY,
            ),
        }
    }
}

/// Where a path aims.
struct Aimed {
    direction: DVec3,
    radiance: DVec3,
    /// How likely it aims there, 1/sr.
    density: f64,
    /// The ray that must be clear.
    ray: Ray,
}

/// A direction in which a path goes on, and its density. None where it would go into the surface.
fn choose(scatter: &Scatter, point: &Point, random: &mut Random) -> Option<(DVec3, f64)> {
    let (which, numbers) = (random.number(), random.pair());
    let direction = scatter.choose(which, numbers)?;
    let density = scatter.density(direction);
    (density > 0.0 && direction.dot(point.geometric) > 0.0).then_some((direction, density))
}

/// The power heuristic with an exponent of 2.
fn power_heuristic(density: f64, other: f64) -> f64 {
    let (density, other) = (density * density, other * other);
    density / (density + other)
}
