//! The light at a pixel equals the light that the CPU computes for the surface at that pixel.
#![allow(clippy::unwrap_used)]

use glam::DVec3;
use lightbench::assets::Reflection;
use lightbench::lab::reference::g_buffer::{self, Texel};
use lightbench::lab::reference::{Surface, outgoing_radiance};
use lightbench::render::TargetImage;
use lightbench::render::gpu_data::LightData;
use lightbench::world::Light;
use lightbench_tests::pixels::Pixels;
use lightbench_tests::{Numbers, Studio, settings};

const SIZE: (u32, u32) = (320, 180);
const PIXELS: usize = 1000;

/// The scene's surfaces as deferred shading keeps them.
struct Surfaces {
    depth: TargetImage,
    albedo: TargetImage,
    normal: TargetImage,
    specular: TargetImage,
    model: TargetImage,
    /// What shines by itself: the frame without any light.
    emission: TargetImage,
    pixels: Pixels,
    lights: Vec<LightData>,
}

impl Surfaces {
    fn read(studio: &mut Studio) -> Self {
        let none = settings(&[]);
        let pipeline = studio.draw("deferred_shading", &none, SIZE);
        let read = |name: &str| studio.renderer.read_target(&pipeline, name).unwrap();
        let [depth, albedo, normal, specular, model] =
            ["depth", "g_albedo", "g_normal", "g_specular", "g_model"].map(read);
        let pixels = Pixels::of(&studio.renderer);
        let lights = studio.renderer.lights().to_vec();

        let dark = studio.scene.world.clone();
        for &light in dark.columns::<Light>().entities() {
            studio.scene.world.remove::<Light>(light);
        }
        let emission = studio.hdr("deferred_shading", &none, SIZE);
        studio.scene.world = dark;
        studio.renderer.reset_scene();
        Self {
            depth,
            albedo,
            normal,
            specular,
            model,
            emission,
            pixels,
            lights,
        }
    }

    /// The surface at a pixel, or none where the sky is.
    fn at(&self, index: usize) -> Option<Surface> {
        let depth = self.depth.texels[index][0];
        let [red, green, blue, _] = self.emission.texels[index].map(f64::from);
        let texel = Texel {
            albedo: self.albedo.texels[index].map(f64::from),
            normal: [0, 1].map(|i| self.normal.texels[index][i] as u16),
            specular: self.specular.texels[index].map(|code| code as u8),
            model: self.model.texels[index][0] as u8,
        };
        let position = self.pixels.at(index, depth);
        let emissive = DVec3::new(red, green, blue);
        (depth > 0.0).then(|| g_buffer::unpack(&texel, position, emissive))
    }

    /// Random pixels that show a surface.
    fn sample(&self) -> Vec<(usize, Surface)> {
        let mut numbers = Numbers(20_121_106);
        let mut found = Vec::new();
        for _ in 0..PIXELS * 20 {
            let index = numbers.below(self.depth.texels.len());
            if let Some(surface) = self.at(index) {
                found.push((index, surface));
            }
            if found.len() == PIXELS {
                return found;
            }
        }
        panic!(
            "only {} of {} pixels show a surface",
            found.len(),
            PIXELS * 20
        );
    }

    fn radiance(&self, surface: &Surface) -> DVec3 {
        outgoing_radiance(&self.lights, surface, self.pixels.eye)
    }
}

fn channels(image: &TargetImage, index: usize) -> [f64; 3] {
    [0, 1, 2].map(|channel| f64::from(image.texels[index][channel]))
}

/// Accumulated in 32 bits the light is right within a thousandth; in 16 bits, which round each of a
/// pixel's additions by up to 1/2048, within half a percent or 1/1024.
fn deferred_equals_the_cpu(scene: &str) {
    let mut studio = Studio::new(scene, &settings(&[]));
    let surfaces = Surfaces::read(&mut studio);
    let formats = [
        ("accumulation=rgba32float", 1e-3, 1e-4),
        ("accumulation=rgba16float", 5e-3, 1.0 / 1024.0),
    ];
    for (format, relative, absolute) in formats {
        let picture = studio.hdr("deferred_shading", &settings(&[format]), SIZE);
        for (index, surface) in surfaces.sample() {
            let expected = surfaces.radiance(&surface).to_array();
            for (found, expected) in channels(&picture, index).into_iter().zip(expected) {
                let error = (found - expected).abs();
                assert!(
                    error < (relative * expected).max(absolute),
                    "{scene}, {format}, pixel {index}: {found} instead of {expected}"
                );
            }
        }
    }
}

#[test]
fn deferred_shading_of_many_lights_equals_the_cpu() {
    deferred_equals_the_cpu("many_lights");
}

#[test]
fn deferred_shading_of_the_atrium_equals_the_cpu() {
    deferred_equals_the_cpu("atrium");
}

/// All reflection models, with tangents and coloured highlights, from the G-buffer.
#[test]
fn deferred_shading_of_all_reflection_models_equals_the_cpu() {
    deferred_equals_the_cpu("brdf_spheres");
}

/// Forward shading sees the surface before the G-buffer rounds it. So it may differ from the CPU's
/// light on the rounded surface by what rounding can change, and by no more.
fn forward_equals_the_cpu_within_the_g_buffer(scene: &str) {
    let mut studio = Studio::new(scene, &settings(&[]));
    let surfaces = Surfaces::read(&mut studio);
    let picture = studio.hdr(
        "forward_single_pass",
        &settings(&["accumulation=rgba32float"]),
        SIZE,
    );
    let step = 1.0_f64 / 255.0;
    for (index, surface) in surfaces.sample() {
        let radiance = surfaces.radiance(&surface);
        let matt = Surface {
            specular: DVec3::ZERO,
            ..surface
        };
        let diffuse = surfaces.radiance(&matt) - surface.emissive;
        let highlight = radiance - diffuse - surface.emissive;
        // Half a step of power changes the lobe; half a step of specular scales it.
        let Reflection::BlinnPhong { power } = surface.reflection else {
            panic!("{scene} has {:?}", surface.reflection);
        };
        let at_power = |factor: f64| {
            let surface = Surface {
                reflection: Reflection::BlinnPhong {
                    power: (f64::from(power) * factor).max(1.0) as f32,
                },
                specular: DVec3::ONE,
                ..surface
            };
            surfaces.radiance(&surface) - diffuse - surface.emissive
        };
        let half_power_step = (10.5 * 0.5 * step).exp2();
        let lobe = at_power(1.0);
        let power_change = (at_power(half_power_step) - lobe)
            .abs()
            .max((at_power(1.0 / half_power_step) - lobe).abs());
        // Specular is kept as its root: half a step changes it by twice the root's share.
        let roots = surface.specular.powf(0.5) + 0.5 * step;
        let specular_steps = roots * roots - surface.specular;
        for channel in 0..3 {
            let albedo = surface.base_color[channel];
            let root = albedo.sqrt() + 0.5 * step;
            let up = root * root - albedo;
            let bound = up / albedo.max(1e-6) * diffuse[channel]
                + specular_steps[channel] * lobe[channel]
                + power_change[channel] * (surface.specular + specular_steps)[channel]
                + 0.005 * highlight[channel].abs()
                + 1e-3 * radiance[channel]
                + 1e-4;
            let found = f64::from(picture.texels[index][channel]);
            let error = (found - radiance[channel]).abs();
            assert!(
                error < bound,
                "{scene}, pixel {index}, channel {channel}: {found} differs from {} by {error}; rounding explains {bound}",
                radiance[channel]
            );
        }
    }
}

#[test]
fn forward_shading_of_many_lights_equals_the_cpu_within_the_g_buffer() {
    forward_equals_the_cpu_within_the_g_buffer("many_lights");
}

#[test]
fn forward_shading_of_the_atrium_equals_the_cpu_within_the_g_buffer() {
    forward_equals_the_cpu_within_the_g_buffer("atrium");
}

#[test]
fn the_check_itself_notices_a_lost_light() {
    let mut studio = Studio::new("many_lights", &settings(&[]));
    let surfaces = Surfaces::read(&mut studio);
    let (_, surface) = surfaces.sample()[0];
    let brightest = surfaces.lights.iter().enumerate().max_by(|(_, a), (_, b)| {
        let light = |light: &LightData| {
            outgoing_radiance(&[*light], &surface, surfaces.pixels.eye).length()
        };
        light(a).total_cmp(&light(b))
    });
    let mut lights = surfaces.lights.clone();
    lights.remove(brightest.unwrap().0);
    let lost =
        surfaces.radiance(&surface) - outgoing_radiance(&lights, &surface, surfaces.pixels.eye);
    assert!(lost.max_element() > 0.005 * surfaces.radiance(&surface).max_element());
}
