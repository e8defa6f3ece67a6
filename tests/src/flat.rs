//! Scenes of flat rectangles, of which the CPU knows by itself what each pixel shows.

use std::fmt::Write;

use glam::DVec3;
use lightbench::assets::Reflection;
use lightbench::lab::reference::Surface;

use crate::pixels::Pixels;

/// The material of a rectangle.
#[derive(Clone, Copy, Debug)]
pub struct Paint {
    /// Diffuse reflectance.
    pub color: [f64; 3],
    /// Specular reflectance.
    pub specular: f64,
    /// Exponent of the highlight.
    pub power: f64,
    /// Radiance of its own.
    pub emissive: f64,
}

/// A rectangle, seen from the side that `along × up` points to.
#[derive(Clone, Copy, Debug)]
pub struct Rectangle {
    /// One of its corners.
    pub corner: DVec3,
    /// From there to the next one.
    pub along: DVec3,
    /// And to the one on the other side.
    pub up: DVec3,
    /// Its material.
    pub paint: Paint,
}

impl Rectangle {
    /// The unit normal.
    pub fn normal(&self) -> DVec3 {
        self.along.cross(self.up).normalize()
    }

    /// Where a line of sight meets its front.
    fn meet(&self, eye: DVec3, sight: DVec3) -> Option<DVec3> {
        let normal = self.along.cross(self.up);
        let toward = sight.dot(normal);
        if toward >= 0.0 {
            return None;
        }
        let at = eye + sight * ((self.corner - eye).dot(normal) / toward);
        let offset = at - self.corner;
        let area = normal.length_squared();
        let shares = [offset.cross(self.up), self.along.cross(offset)];
        let inside = |share: DVec3| (0.0..=1.0).contains(&(share.dot(normal) / area));
        shares.into_iter().all(inside).then_some(at)
    }
}

/// What a pixel shows.
#[derive(Clone, Copy, Debug)]
pub enum Seen {
    /// The sky.
    Sky,
    /// An edge runs so close to its middle that rounding decides.
    Edge,
    /// A rectangle, and the surface there.
    Surface(usize, Surface),
}

/// Writes the script that spawns rectangles.
pub fn script(rectangles: &[Rectangle]) -> String {
    let vector = |v: DVec3| format!("vec3({:?}, {:?}, {:?})", v.x, v.y, v.z);
    let mut script = String::new();
    for (index, rectangle) in rectangles.iter().enumerate() {
        let Rectangle {
            corner,
            along,
            up,
            paint,
        } = *rectangle;
        let corners = [corner, corner + along, corner + along + up, corner + up].map(vector);
        let [r, g, b] = paint.color;
        let Paint {
            specular,
            power,
            emissive,
            ..
        } = paint;
        writeln!(
            script,
            "spawn(\"rectangle {index}\").mesh(faces([[{}]])).material(material(\"{index}\")
                .color(rgb({r:?}, {g:?}, {b:?})).specular({specular:?}).power({power:?})
                .emissive({emissive:?}, {emissive:?}, {emissive:?}));",
            corners.join(", "),
        )
        .unwrap();
    }
    script
}

/// What a pixel shows of rectangles.
pub fn seen(rectangles: &[Rectangle], pixels: &Pixels, index: usize) -> Seen {
    // The rasteriser moves corners to a grid of 1/256 of a pixel.
    const NEAR: f64 = 0.02;
    let [x, y] = pixels.column_and_row(index).map(|at| at as f64 + 0.5);
    let first = |x: f64, y: f64| -> Option<(usize, DVec3)> {
        let sight = pixels.behind(x, y, 0.5) - pixels.eye;
        let hits = rectangles.iter().enumerate().filter_map(|(index, one)| {
            let at = one.meet(pixels.eye, sight)?;
            let [near, far] = pixels.planes;
            (near..far)
                .contains(&pixels.distance(at))
                .then_some((index, at))
        });
        hits.min_by(|a, b| pixels.distance(a.1).total_cmp(&pixels.distance(b.1)))
    };
    let middle = first(x, y);
    let around = [(-NEAR, -NEAR), (NEAR, -NEAR), (-NEAR, NEAR), (NEAR, NEAR)];
    let which = |hit: Option<(usize, DVec3)>| hit.map(|(index, _)| index);
    if around
        .iter()
        .any(|(dx, dy)| which(first(x + dx, y + dy)) != which(middle))
    {
        return Seen::Edge;
    }
    let Some((which, position)) = middle else {
        return Seen::Sky;
    };
    let Paint {
        color,
        specular,
        power,
        emissive,
    } = rectangles[which].paint;
    let surface = Surface {
        position,
        normal: rectangles[which].normal(),
        base_color: color.into(),
        specular: DVec3::splat(specular),
        reflection: Reflection::BlinnPhong {
            power: power as f32,
        },
        tangent: DVec3::X,
        emissive: DVec3::splat(emissive),
    };
    Seen::Surface(which, surface)
}
