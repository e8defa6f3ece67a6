//! What a `shadow` pass draws: the depth of the casters as lights, or given viewpoints, see them.

use super::Faces;
use crate::problem::Place;

/// What a `shadow` pass draws. Each view fills one layer of the depth target, in order; views beyond
/// the last layer are left out and counted.
#[derive(Clone, Debug, PartialEq)]
pub struct Shadow {
    /// From where.
    pub views: ShadowViews,
    /// Which faces of the casters; back faces alone avoid false shadows on what faces the light.
    pub faces: Faces,
    /// Distance of the near plane of spot and point lights, metres.
    pub near: f32,
}

impl Shadow {
    /// Near planes unless a pipeline says otherwise, metres.
    pub const NEAR: f32 = 0.05;
}

/// The lights from which a `shadow` pass looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ShadowLights {
    /// From each spot light whose range the camera sees: one layer, which its cone fills.
    Spot,
    /// From each point light whose range the camera sees: six layers, the sides +x, −x, +y, −y, +z,
    /// −z of a cube, turned so that a `texture_cube` finds them.
    Point,
    /// Along each directional light: one layer, a box around all casters.
    Directional,
}

impl ShadowLights {
    /// The names used in pipeline files.
    pub const NAMES: [(&'static str, Self); 3] = [
        ("spot", Self::Spot),
        ("point", Self::Point),
        ("directional", Self::Directional),
    ];

    /// Layers that one light takes.
    pub fn layers(self) -> u32 {
        match self {
            Self::Point => 6,
            Self::Spot | Self::Directional => 1,
        }
    }
}

/// From where a `shadow` pass looks.
#[derive(Clone, Debug, PartialEq)]
pub enum ShadowViews {
    /// From lights, in the order of their indices.
    Lights(ShadowLights),
    /// From viewpoints that the pipeline file gives.
    Given(Vec<GivenView>),
}

/// A viewpoint in world space.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenView {
    /// Where it was declared.
    pub at: Place,
    /// Position.
    pub eye: [f32; 3],
    /// A point that it looks at.
    pub target: [f32; 3],
    /// How it projects.
    pub lens: Lens,
    /// Near plane, metres.
    pub near: f32,
    /// Far plane, metres.
    pub far: f32,
}

/// How a view projects onto its square layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// In perspective: the full angle, radians.
    Perspective(f32),
    /// Along parallel lines: the side of the square, metres.
    Orthographic(f32),
}
