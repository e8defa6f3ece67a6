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
    let line = Line {
        origin: sight.eye,
        direction: sight.direction(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)),
        pixel: Some([sight.across, sight.down]),
    };
    let mut sum = DVec3::ZERO;
    // The share of what lies behind that shows.
    let mut open = 1.0;
    let mut from = sight.near;
    while let Some((triangle, at)) = scene.look(&line, [from, sight.far], witness) {
        let point = scene.point(&line, triangle);
        let lit = lit(scene, &point, -line.direction.normalize(), shadows, witness);
        sum += (point.surface.emissive + lit) * (open * point.opacity);
        open *= 1.0 - point.opacity;
        if open <= 0.0 {
            return sum;
        }
        from = at.next_up();
    }
    sum + scene.sky * open
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
