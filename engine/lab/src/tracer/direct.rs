//! Direct light as the pipelines compute it, one line of sight through the middle of each pixel.

use glam::{DVec2, DVec3};

use super::camera::Sight;
use super::geometry::Traits;
use super::point::{Line, Point};
use super::rays::{Witness, to_lamp};
use super::scene::TracedScene;
use crate::reference::evaluate_light;
use crate::reference::lighting::arriving;

/// The radiance at a pixel: what its surface emits, and the light of all lamps on it, with or without
/// their shadows. Ambient light casts none. Transparent surfaces are blended over what lies behind.
pub fn radiance(
    scene: &TracedScene,
    sight: &Sight,
    [x, y]: [u32; 2],
    shadows: bool,
    witness: &mut impl Witness,
) -> DVec3 {
    let line = line_of(sight, [x, y]);
    let to_viewer = -line.direction.normalize();
    let mut sum = DVec3::ZERO;
    let mut seen = Seen::new(scene, sight, line);
    while let Some((point, share)) = seen.next(witness) {
        let lit = lit(scene, &point, to_viewer, shadows, witness);
        sum += (point.surface.emissive + lit) * share;
    }
    sum + scene.sky * seen.open
}

/// The line of sight through the middle of a pixel.
pub fn line_of(sight: &Sight, [x, y]: [u32; 2]) -> Line {
    Line {
        origin: sight.eye,
        direction: sight.direction(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)),
        pixel: Some([sight.across, sight.down]),
    }
}

/// What a line of sight meets, one surface after the other until one hides all that is behind it.
pub struct Seen<'a> {
    scene: &'a TracedScene,
    line: Line,
    from: f32,
    far: f32,
    /// The share of what lies behind all of them that shows.
    pub open: f64,
}

impl<'a> Seen<'a> {
    /// Nothing is met yet.
    pub fn new(scene: &'a TracedScene, sight: &Sight, line: Line) -> Self {
        Self {
            scene,
            line,
            from: sight.near,
            far: sight.far,
            open: 1.0,
        }
    }

    /// The next surface, and its share of the pixel.
    pub fn next(&mut self, witness: &mut impl Witness) -> Option<(Point, f64)> {
        if self.open <= 0.0 {
            return None;
        }
        let reach = [self.from, self.far];
        let (triangle, at) = self.scene.look(&self.line, reach, witness)?;
        let point = self.scene.point(&self.line, triangle);
        let share = self.open * point.opacity;
        self.open *= 1.0 - point.opacity;
        self.from = at.next_up();
        Some((point, share))
    }
}

fn lit(
    scene: &TracedScene,
    point: &Point,
    to_viewer: DVec3,
    shadows: bool,
    witness: &mut impl Witness,
) -> DVec3 {
    let surface = &point.surface;
    let lights = scene.all_lights.iter();
    lights
        .map(|light| {
            let light_there = evaluate_light(light, surface, to_viewer);
            match arriving(light, surface.position) {
                Some(arrival) if shadows && light_there != DVec3::ZERO => {
                    if arrival.to_light.dot(point.geometric) <= 0.0 {
                        return DVec3::ZERO;
                    }
                    let ray = to_lamp(point, &arrival);
                    light_there * scene.share(ray, Traits::EMISSIVE, witness)
                }
                _ => light_there,
            }
        })
        .sum()
}
