//! Icons as small pictures: a quad for each, where its lines would be hundreds of corners, and a scene may
//! have thousands of lights.

use egui::{
    Color32, ColorImage, Context, Id, Mesh, Painter, Pos2, Rect, Shape, TextureHandle,
    TextureOptions, pos2, vec2,
};
use lightbench::world::glam::{Vec2, vec2 as place};

/// Points of the screen from an icon's middle to its edge.
pub const RADIUS: f32 = 7.0;

/// Points from the middle of its picture to the edge of that: with room for wide lines.
const HALF: f32 = RADIUS + 3.0;

/// Width of the lines, points.
const LINE: f32 = 1.3;

/// Width of what is dark below them, so that they are seen on anything, and how much it covers.
const HALO: (f32, f32) = (3.5, 150.0 / 255.0);

/// What an icon stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Icon {
    /// A bulb.
    Light,
    /// A box with a lens.
    Camera,
}

/// Icons of one kind that are drawn together.
pub struct Icons {
    /// Kept until they are drawn.
    texture: TextureHandle,
    mesh: Mesh,
}

impl Icons {
    /// None yet.
    pub fn new(ctx: &Context, icon: Icon) -> Self {
        let texture = texture(ctx, icon);
        let mesh = Mesh::with_texture(texture.id());
        Self { texture, mesh }
    }

    /// One more, in a colour.
    pub fn add(&mut self, at: Pos2, color: Color32) {
        let rect = Rect::from_center_size(at, vec2(2.0 * HALF, 2.0 * HALF));
        let all = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
        self.mesh.add_rect_with_uv(rect, all, color);
    }

    /// Draws them.
    pub fn draw(self, painter: &Painter) {
        debug_assert_eq!(self.mesh.texture_id, self.texture.id());
        painter.add(Shape::mesh(self.mesh));
    }
}

/// An icon's picture for the present pixels of a point, made once.
fn texture(ctx: &Context, icon: Icon) -> TextureHandle {
    let scale = ctx.pixels_per_point();
    let id = Id::unique(("icon", icon, scale.to_bits()));
    if let Some(made) = ctx.data(|data| data.get_temp::<TextureHandle>(id)) {
        return made;
    }
    let made = ctx.load_texture("icon", picture(icon, scale), TextureOptions::LINEAR);
    ctx.data_mut(|data| data.insert_temp(id, made.clone()));
    made
}

/// White lines over a dark halo.
fn picture(icon: Icon, scale: f32) -> ColorImage {
    let side = (2.0 * HALF * scale).ceil() as usize;
    let pixels = (0..side * side).map(|pixel| {
        let at = place((pixel % side) as f32, (pixel / side) as f32) + 0.5;
        let distance = icon.distance(at * (2.0 * HALF / side as f32) - HALF);
        // Half covered at the edge of a line, over one pixel.
        let covered = |width: f32| ((width * 0.5 - distance) * scale + 0.5).clamp(0.0, 1.0);
        let line = covered(LINE);
        let halo = covered(HALO.0) * HALO.1;
        let white = (line * 255.0).round() as u8;
        let alpha = ((line + halo * (1.0 - line)) * 255.0).round() as u8;
        Color32::from_rgba_premultiplied(white, white, white, alpha)
    });
    ColorImage::new([side, side], pixels.collect())
}

impl Icon {
    /// Points from a place to the nearest line of the icon; y points down.
    fn distance(self, at: Vec2) -> f32 {
        match self {
            Self::Light => {
                let ring = (at.length() - RADIUS * 0.45).abs();
                let rays = (0..8).map(|part| {
                    let ray = Vec2::from_angle(part as f32 * std::f32::consts::FRAC_PI_4) * RADIUS;
                    to_line(at, ray * 0.7, ray)
                });
                rays.fold(ring, f32::min)
            }
            Self::Camera => {
                let body = [
                    (-6.5, -4.0),
                    (2.5, -4.0),
                    (2.5, 4.0),
                    (-6.5, 4.0),
                    (-6.5, -4.0),
                ];
                let lens = [(2.5, -1.5), (RADIUS, -4.0), (RADIUS, 4.0), (2.5, 1.5)];
                let body = body.windows(2);
                let all = body.chain(lens.windows(2));
                let distances = all.map(|ends| to_line(at, ends[0].into(), ends[1].into()));
                distances.fold(f32::INFINITY, f32::min)
            }
        }
    }
}

/// From a point to a line between two others.
fn to_line(at: Vec2, from: Vec2, to: Vec2) -> f32 {
    let along = to - from;
    let part = ((at - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    at.distance(from + along * part)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixel(icon: Icon, x: f32, y: f32) -> Color32 {
        let image = picture(icon, 2.0);
        let place = |points: f32| ((points + HALF) * 2.0) as usize;
        image.pixels[place(y) * image.size[0] + place(x)]
    }

    #[test]
    fn lines_are_white_their_surroundings_dark_and_the_rest_empty() {
        // The ring, what lies inside, a ray, and a corner.
        assert_eq!(pixel(Icon::Light, RADIUS * 0.45 - 0.2, 0.0), Color32::WHITE);
        assert_eq!(pixel(Icon::Light, 0.0, 0.0), Color32::TRANSPARENT);
        assert_eq!(pixel(Icon::Light, RADIUS * 0.85, 0.0), Color32::WHITE);
        let beside = pixel(Icon::Light, RADIUS * 0.85, 1.4);
        assert!(beside.r() < 60 && beside.a() > 100, "{beside:?}");
        assert_eq!(pixel(Icon::Light, -HALF, -HALF), Color32::TRANSPARENT);
        // The body's upper edge, the lens, and between.
        assert_eq!(pixel(Icon::Camera, -2.0, -4.0), Color32::WHITE);
        assert_eq!(pixel(Icon::Camera, RADIUS, 0.0), Color32::WHITE);
        assert_eq!(pixel(Icon::Camera, -2.0, 0.2), Color32::TRANSPARENT);
    }
}
