//! Stone, marble and plaster.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::{Noise, Surface, normal_map, paint};
use crate::Texture;

/// Cut stone: a fine grain over soft clouds of colour, such as sandstone or
/// limestone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stone {
    /// Pixels a side.
    pub size: u32,
    /// Darkest and lightest colour.
    pub colors: [Vec3; 2],
    /// Clouds along a side.
    pub scale: u32,
    /// Height of the grain, in shares of the picture's side.
    pub roughness: f32,
    /// Another stone of the same kind.
    pub seed: u32,
}

impl Default for Stone {
    fn default() -> Self {
        Self {
            size: 512,
            colors: [Vec3::new(0.42, 0.35, 0.26), Vec3::new(0.62, 0.55, 0.44)],
            scale: 4,
            roughness: 0.002,
            seed: 1,
        }
    }
}

impl Stone {
    /// Colours and normals.
    #[must_use]
    pub fn paint(&self) -> Surface {
        let noise = Noise::new(self.seed);
        let grain = Noise::new(self.seed.wrapping_add(101));
        let scale = self.scale.max(1);
        let fine = scale.saturating_mul(16);
        let base_color = paint("stone", self.size, |at| {
            let clouds = noise.fractal(at, scale, 5);
            let grains = grain.fractal(at, fine, 2);
            self.colors[0].lerp(
                self.colors[1],
                (0.5 + 0.7 * clouds + 0.25 * grains).clamp(0.0, 1.0),
            )
        });
        let normal = normal_map("stone normals", self.size, |at| {
            self.roughness * (0.5 * grain.fractal(at, fine, 2) + noise.fractal(at, scale * 2, 5))
        });
        Surface { base_color, normal }
    }
}

/// Polished marble: thin dark veins along bent bands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marble {
    /// Pixels a side.
    pub size: u32,
    /// Of the stone and of its veins.
    pub colors: [Vec3; 2],
    /// Bands across the picture to the right and down.
    pub bands: [u32; 2],
    /// How far the bands are bent, in their own widths.
    pub turbulence: f32,
    /// Another slab.
    pub seed: u32,
}

impl Default for Marble {
    fn default() -> Self {
        Self {
            size: 512,
            colors: [Vec3::new(0.78, 0.76, 0.72), Vec3::new(0.24, 0.24, 0.26)],
            bands: [2, 1],
            turbulence: 1.6,
            seed: 1,
        }
    }
}

impl Marble {
    /// The colours. A polished slab needs no normals.
    #[must_use]
    pub fn paint(&self) -> Texture {
        let noise = Noise::new(self.seed);
        let clouds = Noise::new(self.seed.wrapping_add(101));
        let [right, down] = self.bands.map(|bands| bands as f32);
        paint("marble", self.size, |at| {
            let bent = self.turbulence * noise.fractal(at, 3, 6);
            let wave = (TAU * (right * at.x + down * at.y + bent)).sin();
            // Near 1 only close to where the wave crosses 0.
            let vein = (1.0 - wave.abs()).powi(6) * (0.55 + 0.9 * clouds.at(at, 5)).clamp(0.0, 1.0);
            let haze = 0.12 * (0.5 + 0.5 * clouds.fractal(at, 2, 4));
            self.colors[0].lerp(self.colors[1], (vein + haze).clamp(0.0, 1.0))
        })
    }
}

/// A plastered wall: one colour, a little uneven, in stains and in height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plaster {
    /// Pixels a side.
    pub size: u32,
    /// Of clean plaster.
    pub color: Vec3,
    /// How much darker the stains are, 0 to 1.
    pub stains: f32,
    /// Height of the trowel's marks, in shares of the picture's side.
    pub roughness: f32,
    /// Another wall.
    pub seed: u32,
}

impl Default for Plaster {
    fn default() -> Self {
        Self {
            size: 512,
            color: Vec3::new(0.72, 0.66, 0.56),
            stains: 0.25,
            roughness: 0.006,
            seed: 1,
        }
    }
}

impl Plaster {
    /// Colours and normals.
    #[must_use]
    pub fn paint(&self) -> Surface {
        let stain = Noise::new(self.seed);
        let trowel = Noise::new(self.seed.wrapping_add(101));
        let marks = |at: Vec2| trowel.fractal(at, 12, 4);
        let base_color = paint("plaster", self.size, |at| {
            let stain = (0.5 + stain.fractal(at, 3, 5)).clamp(0.0, 1.0);
            let light = 1.0 - self.stains.clamp(0.0, 1.0) * stain + 0.04 * marks(at);
            (self.color * light).clamp(Vec3::ZERO, Vec3::ONE)
        });
        let normal = normal_map("plaster normals", self.size, |at| {
            self.roughness * marks(at)
        });
        Surface { base_color, normal }
    }
}
