//! The light at one pixel, taken apart: what each lamp adds to it, and why the others add nothing.

use glam::DVec3;
use lightbench_render::View;
use lightbench_render::gpu_data::LightData;

use super::camera::Sight;
use super::direct::{Seen, line_of};
use super::rays::Count;
use super::scene::TracedScene;
use crate::reference::lighting::{AMBIENT, SPOT, arriving, cone_falloff};
use crate::reference::{Surface, evaluate_light};

/// Whether the light of a lamp comes to a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reach {
    /// It does.
    Reaches,
    /// The surface faces away from it.
    Behind,
    /// The surface is outside of a spot's cone.
    OutsideCone,
    /// The surface is beyond the light's range.
    BeyondRange,
}

/// What one light adds to a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct LightShare {
    /// The row of the light among the world's lights.
    pub row: usize,
    /// Whether it reaches the first surface in the pixel.
    pub reach: Reach,
    /// From the first surface in the pixel to the light, metres; none for lights without a place.
    pub distance: Option<f64>,
    /// Radiance that it adds, of all surfaces that show in the pixel together.
    pub radiance: DVec3,
}

/// The light at one pixel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightAtPixel {
    /// Where the line of sight meets the first surface; none where it meets none.
    pub position: Option<DVec3>,
    /// All lights in the order of their rows; empty where no surface is met.
    pub lights: Vec<LightShare>,
    /// What the surfaces emit by themselves.
    pub emitted: DVec3,
    /// What shows of the sky.
    pub sky: DVec3,
    /// All of it together: the radiance of the pixel.
    pub sum: DVec3,
}

impl TracedScene {
    /// The light at the middle of a pixel by the formulas of the pipelines, without shadows: the same as
    /// [`Mode::Direct`](super::Mode::Direct) gives, light by light.
    pub fn light_at(&self, view: &View, size: (u32, u32), pixel: (u32, u32)) -> LightAtPixel {
        let sight = Sight::new(view, size);
        let line = line_of(&sight, [pixel.0, pixel.1]);
        let to_viewer = -line.direction.normalize();
        let mut found = LightAtPixel::default();
        let mut seen = Seen::new(self, &sight, line);
        let mut count = Count::default();
        while let Some((point, share)) = seen.next(&mut count) {
            let surface = &point.surface;
            if found.position.is_none() {
                found.position = Some(surface.position);
                let lights = self.all_lights.iter().enumerate();
                found.lights = lights
                    .map(|(row, light)| first(row, light, surface))
                    .collect();
            }
            for (light, entry) in self.all_lights.iter().zip(&mut found.lights) {
                entry.radiance += evaluate_light(light, surface, to_viewer) * share;
            }
            found.emitted += surface.emissive * share;
        }
        found.sky = self.sky * seen.open;
        let lit: DVec3 = found.lights.iter().map(|light| light.radiance).sum();
        found.sum = found.emitted + found.sky + lit;
        found
    }
}

/// What is known of a light before anything is added up.
fn first(row: usize, light: &LightData, surface: &Surface) -> LightShare {
    let arrival = arriving(light, surface.position);
    let reach = match &arrival {
        _ if light.kind == AMBIENT => Reach::Reaches,
        None => Reach::BeyondRange,
        Some(arrival) if light.kind == SPOT && cone_falloff(light, arrival.to_light) <= 0.0 => {
            Reach::OutsideCone
        }
        Some(arrival) if surface.normal.dot(arrival.to_light) <= 0.0 => Reach::Behind,
        Some(_) => Reach::Reaches,
    };
    let offset = light.position.as_dvec3() - surface.position;
    // Neither ambient light nor one from afar has a place.
    let has_place = light.kind <= SPOT;
    LightShare {
        row,
        reach,
        distance: has_place.then(|| offset.length()),
        radiance: DVec3::ZERO,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::tracer::{Mode, Options, trace};
    use lightbench_assets::{Progress, files::Files};
    use lightbench_script::{Settings, load_scene};
    use lightbench_world::{Light, LightKind};

    #[test]
    fn the_shares_of_all_lights_are_the_traced_picture() {
        let progress = Progress::new();
        for name in ["cornell_box", "many_lights"] {
            let mut scene =
                load_scene(&Files::shipped(), name, &Settings::new(), &progress).unwrap();
            scene.refresh();
            let view = View::from_world(&scene.world).unwrap();
            let traced_scene = TracedScene::new(&scene.world, &scene.assets);
            let size = (24, 16);
            let options = Options {
                size,
                samples: 1,
                mode: Mode::Direct,
                ..Options::default()
            };
            let traced = trace(&traced_scene, &view, &options, &progress).unwrap();
            for (x, y) in [(0, 0), (12, 8), (5, 11), (23, 15), (9, 3)] {
                let found = traced_scene.light_at(&view, size, (x, y));
                let pixel = traced.picture.pixels[(y * size.0 + x) as usize];
                let wanted = DVec3::from_array([0, 1, 2].map(|channel| pixel[channel].into()));
                // The picture keeps single precision.
                let far = (found.sum - wanted).abs().cmpgt(wanted.abs() * 1e-6);
                assert!(!far.any(), "{name} {x} {y}: {} {wanted}", found.sum);
            }
        }
    }

    /// What reaches adds something, and what does not adds nothing; with the range and the cone of the
    /// component and not of the shader's row.
    #[test]
    fn lights_that_do_not_reach_say_why() {
        let progress = Progress::new();
        let files = Files::shipped();
        let mut scene = load_scene(&files, "many_lights", &Settings::new(), &progress).unwrap();
        scene.refresh();
        let view = View::from_world(&scene.world).unwrap();
        let traced_scene = TracedScene::new(&scene.world, &scene.assets);
        let mut seen = std::collections::BTreeSet::new();
        for (x, y) in [(20, 30), (32, 20), (40, 33), (10, 25), (50, 30)] {
            let found = traced_scene.light_at(&view, (64, 36), (x, y));
            let lights = scene.world.columns::<Light>();
            for share in &found.lights {
                let light = lights.row(share.row);
                seen.insert(share.reach);
                if share.reach != Reach::Reaches {
                    assert_eq!(share.radiance, DVec3::ZERO);
                }
                if matches!(light.kind, LightKind::Point | LightKind::Spot) {
                    let beyond = share.distance.unwrap() >= f64::from(light.range);
                    assert_eq!(beyond, share.reach == Reach::BeyondRange, "{share:?}");
                } else {
                    assert_eq!(share.distance, None);
                }
            }
        }
        assert!(seen.contains(&Reach::Reaches) && seen.contains(&Reach::BeyondRange));
    }
}
