//! Directions in which a surface may send a path on, and how likely it does.
//!
//! The BRDF is that of [`reflected`](crate::reference::reflected), in which every pipeline's light is
//! computed. Only the choice of directions is here: a mixture of Lambert's cosine and of the lobe of
//! the reflection model, so that the quotient of BRDF and density stays small.

mod lobes;
#[cfg(test)]
mod tests;

use std::f64::consts::PI;

use glam::DVec3;
use lightbench_assets::Reflection;

use super::luminance;
use crate::reference::Surface;
use crate::reference::brdf::{LEAST_COSINE, schlick_weight};

pub use lobes::{Lobe, cosine};

/// A surface seen from somewhere, ready to scatter.
#[derive(Clone, Copy, Debug)]
pub struct Scatter {
    tangent: DVec3,
    bitangent: DVec3,
    normal: DVec3,
    /// To the viewer, in the surface's own frame: the normal along +z, the tangent along +x.
    to_viewer: DVec3,
    lobe: Lobe,
    /// How often a direction is chosen by Lambert's cosine.
    matt: f64,
}

impl Scatter {
    /// None for a surface that reflects nothing.
    pub fn new(surface: &Surface, to_viewer: DVec3) -> Option<Self> {
        let (normal, tangent) = (surface.normal, surface.tangent);
        let bitangent = normal.cross(tangent);
        let local = DVec3::new(
            to_viewer.dot(tangent),
            to_viewer.dot(bitangent),
            to_viewer.dot(normal),
        );
        let diffuse = luminance(surface.base_color);
        let specular = luminance(surface.specular);
        let mirrored = match surface.reflection {
            Reflection::Beckmann { .. } | Reflection::Ggx { .. } => {
                specular + (1.0 - specular) * schlick_weight(local.z.max(0.0))
            }
            _ => specular,
        };
        if diffuse + mirrored <= 0.0 {
            return None;
        }
        // A bent normal may turn a surface that is seen away from the viewer; lobes mean nothing there.
        let grazes = local.z < LEAST_COSINE;
        Some(Self {
            tangent,
            bitangent,
            normal,
            to_viewer: local,
            lobe: Lobe::new(surface.reflection),
            matt: if grazes || mirrored <= 0.0 {
                1.0
            } else if diffuse <= 0.0 {
                0.0
            } else {
                (diffuse / (diffuse + mirrored)).clamp(0.1, 0.9)
            },
        })
    }

    /// A direction to the light, by three even numbers. None where the lobe points into the surface:
    /// the path ends.
    pub fn choose(&self, which: f64, numbers: [f64; 2]) -> Option<DVec3> {
        let local = if which < self.matt {
            cosine(numbers)
        } else {
            self.lobe.choose(self.to_viewer, numbers)?
        };
        (local.z > 0.0).then(|| self.in_world(local))
    }

    /// A direction from the surface's own frame.
    pub fn in_world(&self, local: DVec3) -> DVec3 {
        self.tangent * local.x + self.bitangent * local.y + self.normal * local.z
    }

    /// How likely [`Scatter::choose`] takes a direction, 1/sr.
    pub fn density(&self, to_light: DVec3) -> f64 {
        let local = DVec3::new(
            to_light.dot(self.tangent),
            to_light.dot(self.bitangent),
            to_light.dot(self.normal),
        );
        if local.z <= 0.0 {
            return 0.0;
        }
        let matt = self.matt * local.z / PI;
        if self.matt >= 1.0 {
            return matt;
        }
        matt + (1.0 - self.matt) * self.lobe.density(self.to_viewer, local)
    }
}
