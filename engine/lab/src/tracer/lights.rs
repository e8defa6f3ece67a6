//! Lights that shine from somewhere, and which of them a path asks.

use glam::{DVec3, Vec3};
use lightbench_render::gpu_data::LightData;

use super::luminance;
use crate::reference::lighting::AMBIENT;

/// A choice among lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Which light.
    pub light: LightData,
    /// How likely it was chosen.
    pub probability: f64,
}

/// Room for the weights of all lights, so that no path takes memory.
#[derive(Clone, Debug, Default)]
pub struct Weights(Vec<f32>);

/// Lights that shine from somewhere, one array for each number that their weight is made of.
#[derive(Clone, Debug, Default)]
pub struct Lights {
    lights: Vec<LightData>,
    x: Vec<f32>,
    y: Vec<f32>,
    z: Vec<f32>,
    /// One over the square of the range; 0 for directional lights.
    inverse_range_squared: Vec<f32>,
    strength: Vec<f32>,
    forward_x: Vec<f32>,
    forward_y: Vec<f32>,
    forward_z: Vec<f32>,
    angle_scale: Vec<f32>,
    angle_offset: Vec<f32>,
}

/// How far off directional lights are put: their falloff is then taken out of their strength.
const FAR: f32 = 1e4;

impl Lights {
    /// All but the ambient ones.
    pub fn new(lights: &[LightData]) -> Self {
        let mut found = Self::default();
        for light in lights.iter().filter(|light| light.kind != AMBIENT) {
            found.add(light);
        }
        found
    }

    fn add(&mut self, light: &LightData) {
        const SPOT: u32 = 1;
        const DIRECTIONAL: u32 = 2;
        let strength = luminance(light.intensity.as_dvec3()) as f32;
        let is_directional = light.kind == DIRECTIONAL;
        let place = if is_directional {
            -light.direction * FAR
        } else {
            light.position
        };
        self.lights.push(*light);
        self.x.push(place.x);
        self.y.push(place.y);
        self.z.push(place.z);
        self.inverse_range_squared.push(match is_directional {
            true => 0.0,
            false => (light.range * light.range).recip(),
        });
        self.strength.push(match is_directional {
            true => strength * FAR * FAR,
            false => strength,
        });
        self.forward_x.push(light.direction.x);
        self.forward_y.push(light.direction.y);
        self.forward_z.push(light.direction.z);
        let is_spot = light.kind == SPOT;
        self.angle_scale
            .push(if is_spot { light.angle_scale } else { 0.0 });
        self.angle_offset
            .push(if is_spot { light.angle_offset } else { 1.0 });
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.lights.len()
    }

    /// Chooses one, the likelier the more of its light falls on a point; shadows are not known yet.
    /// None where all is dark.
    ///
    /// A light that lights the point may not have a weight of nothing. Weights leave out only what
    /// [`arriving`](crate::reference::lighting::arriving) and the cosine leave out too.
    pub fn choose(
        &self,
        position: DVec3,
        normal: DVec3,
        number: f64,
        weights: &mut Weights,
    ) -> Option<Choice> {
        if self.lights.is_empty() {
            return None;
        }
        self.weigh(position.as_vec3(), normal.as_vec3(), &mut weights.0);
        let total: f64 = weights.0.iter().map(|&weight| f64::from(weight)).sum();
        if total <= 0.0 || !total.is_finite() {
            return None;
        }
        let wanted = number * total;
        let mut sum = 0.0;
        let mut chosen = None;
        for (index, &weight) in weights.0.iter().enumerate() {
            if weight > 0.0 {
                sum += f64::from(weight);
                chosen = Some((index, f64::from(weight)));
                if sum > wanted {
                    break;
                }
            }
        }
        chosen.map(|(index, weight)| Choice {
            light: self.lights[index],
            probability: weight / total,
        })
    }

    /// The share of each light's irradiance at a point, as `reference::lighting` has it. Without a
    /// branch, so that the compiler works on several lights at a time.
    fn weigh(&self, position: Vec3, normal: Vec3, weights: &mut Vec<f32>) {
        let count = self.lights.len();
        weights.clear();
        weights.resize(count, 0.0);
        let (x, y, z) = (&self.x[..count], &self.y[..count], &self.z[..count]);
        let ranges = &self.inverse_range_squared[..count];
        let strengths = &self.strength[..count];
        let forward_x = &self.forward_x[..count];
        let forward_y = &self.forward_y[..count];
        let forward_z = &self.forward_z[..count];
        let scales = &self.angle_scale[..count];
        let offsets = &self.angle_offset[..count];
        for (i, weight) in weights.iter_mut().enumerate() {
            let offset = [x[i] - position.x, y[i] - position.y, z[i] - position.z];
            let squared = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
            let clamped = squared.max(1e-4);
            let inverse = clamped.sqrt().recip();
            let ratio = squared * ranges[i];
            let window = (1.0 - ratio * ratio).max(0.0);
            let forward =
                forward_x[i] * offset[0] + forward_y[i] * offset[1] + forward_z[i] * offset[2];
            let edge = (offsets[i] - forward * inverse * scales[i]).clamp(0.0, 1.0);
            let cosine = normal.x * offset[0] + normal.y * offset[1] + normal.z * offset[2];
            *weight = strengths[i] * window * window * edge * edge * (cosine * inverse).max(0.0)
                / clamped;
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::reference::lighting::arriving;
    use lightbench_render::scene::light_data;
    use lightbench_world::{Light, LightKind};

    fn several() -> Vec<LightData> {
        let light = |kind, intensity, place: Vec3, forward: Vec3| {
            let light = Light {
                kind,
                intensity,
                range: 9.0,
                ..Light::default()
            };
            light_data(&light, place, forward)
        };
        vec![
            light(LightKind::Point, 3.0, Vec3::new(1.0, 2.0, 0.0), Vec3::NEG_Z),
            light(LightKind::Ambient, 9.0, Vec3::ZERO, Vec3::NEG_Z),
            light(LightKind::Spot, 8.0, Vec3::new(0.0, 3.0, 0.5), Vec3::NEG_Y),
            light(
                LightKind::Directional,
                0.3,
                Vec3::ZERO,
                Vec3::new(-1.0, -2.0, 0.3),
            ),
            light(
                LightKind::Point,
                5.0,
                Vec3::new(0.0, -1.0, 0.0),
                Vec3::NEG_Z,
            ),
            light(LightKind::Point, 5.0, Vec3::new(0.0, 9.5, 0.0), Vec3::NEG_Z),
        ]
    }

    #[test]
    fn lights_are_chosen_by_their_share_of_the_irradiance() {
        let lights = several();
        let position = DVec3::new(0.2, 0.1, 0.3);
        let normal = DVec3::new(0.1, 1.0, 0.2).normalize();
        let irradiance = |light: &LightData| {
            arriving(light, position).map_or(0.0, |arrival| {
                luminance(arrival.irradiance) * arrival.to_light.dot(normal).max(0.0)
            })
        };
        let total: f64 = lights.iter().map(irradiance).sum();
        let table = Lights::new(&lights);
        assert_eq!(table.len(), 5);
        let mut weights = Weights::default();
        let mut seen = 0.0;
        let mut last = None;
        for step in 0..10_000 {
            let number = (f64::from(step) + 0.5) / 10_000.0;
            let choice = table
                .choose(position, normal, number, &mut weights)
                .unwrap();
            let expected = irradiance(&choice.light) / total;
            assert!(
                (choice.probability / expected - 1.0).abs() < 1e-3,
                "{choice:?}"
            );
            if last != Some(choice.light) {
                seen += choice.probability;
                last = Some(choice.light);
            }
        }
        assert!(
            (seen - 1.0).abs() < 1e-9,
            "each light that is seen once: {seen}"
        );
    }

    #[test]
    fn where_no_light_arrives_none_is_chosen() {
        let table = Lights::new(&several()[4..5]);
        let mut weights = Weights::default();
        let choose = |normal, weights: &mut Weights| {
            table.choose(DVec3::ZERO, normal, 0.5, weights).is_some()
        };
        assert!(!choose(DVec3::Y, &mut weights));
        assert!(choose(DVec3::NEG_Y, &mut weights));
        let none = Lights::default();
        assert_eq!(none.choose(DVec3::ZERO, DVec3::Y, 0.5, &mut weights), None);
    }
}
