//! Where in the world the pixels of a frame lie, and which lights reach there: all in double
//! precision, from the matrices of the last frame.

use glam::{DMat4, DVec3, DVec4};
use lightbench::render::Renderer;
use lightbench::render::gpu_data::LightData;

/// The pixels of a frame.
pub struct Pixels {
    to_world: DMat4,
    /// World to view.
    pub view: DMat4,
    /// The camera's place.
    pub eye: DVec3,
    /// The near and the far plane.
    pub planes: [f64; 2],
    /// Width and height.
    pub size: [usize; 2],
}

impl Pixels {
    /// Those of the frame that was drawn last.
    pub fn of(renderer: &Renderer) -> Self {
        let data = renderer.frame().data;
        let view = data.view.as_dmat4();
        Self {
            to_world: (data.projection.as_dmat4() * view).inverse(),
            view,
            eye: data.camera_position.as_dvec3(),
            planes: [data.near, data.far].map(f64::from),
            size: data.resolution.map(|side| side as usize),
        }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.size[0] * self.size[1]
    }

    /// Column and row.
    pub fn column_and_row(&self, index: usize) -> [usize; 2] {
        [index % self.size[0], index / self.size[0]]
    }

    /// The point at a reversed depth behind the middle of a pixel.
    pub fn at(&self, index: usize, depth: f32) -> DVec3 {
        let [x, y] = self.column_and_row(index).map(|at| at as f64 + 0.5);
        self.behind(x, y, f64::from(depth))
    }

    /// The point at a reversed depth behind a place of the picture, in pixels.
    pub fn behind(&self, x: f64, y: f64, depth: f64) -> DVec3 {
        let [width, height] = self.size.map(|side| side as f64);
        let ndc = DVec4::new(x / width * 2.0 - 1.0, 1.0 - y / height * 2.0, depth, 1.0);
        let world = self.to_world * ndc;
        world.truncate() / world.w
    }

    /// The point at a distance along the view behind the middle of a pixel.
    pub fn at_distance(&self, index: usize, distance: f64) -> DVec3 {
        let somewhere = self.at(index, 0.5);
        self.eye + (somewhere - self.eye) * (distance / self.distance(somewhere))
    }

    /// How far ahead a point lies, along the view.
    pub fn distance(&self, point: DVec3) -> f64 {
        -self.view.transform_point3(point).z
    }
}

/// How deep inside a light's range and cone a point lies: a share of the range or of the cone's edge,
/// negative outside. Within some 1e-4 of 0 rounding decides.
pub fn depth_inside(light: &LightData, point: DVec3) -> f64 {
    const POINT: u32 = 0;
    const SPOT: u32 = 1;
    let offset = light.position.as_dvec3() - point;
    let range = f64::from(light.range);
    let inside = (range - offset.length()) / range;
    match light.kind {
        POINT => inside,
        SPOT => {
            let cosine = -light.direction.as_dvec3().dot(offset.normalize());
            let edge = cosine * f64::from(light.angle_scale) + f64::from(light.angle_offset);
            inside.min(edge)
        }
        _ => 1.0,
    }
}
