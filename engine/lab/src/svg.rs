//! SVG drawings as pixels.

use std::sync::{Arc, LazyLock};

use resvg::{tiny_skia, usvg};

use crate::{LabError, LdrImage};

/// The family of the fonts that drawings are set in.
const FAMILY: &str = "Ubuntu";

/// The interface's own fonts, so that drawings look alike on all machines.
static FONTS: LazyLock<Arc<usvg::fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = usvg::fontdb::Database::new();
    fonts.load_font_data(epaint_default_fonts::UBUNTU_LIGHT.to_vec());
    // For what that font has no glyphs for.
    fonts.load_font_data(epaint_default_fonts::HACK_REGULAR.to_vec());
    fonts.set_sans_serif_family(FAMILY);
    fonts.set_serif_family(FAMILY);
    Arc::new(fonts)
});

/// A drawing on a transparent ground, `scale` pixels for each of its units.
///
/// # Errors
/// [`LabError::Encode`] if the SVG is not well-formed or too large.
pub fn draw(svg: &str, scale: f32) -> Result<LdrImage, LabError> {
    let map = render(svg, scale, tiny_skia::Color::TRANSPARENT)?;
    let pixels = map.pixels().iter().map(|pixel| {
        let color = pixel.demultiply();
        [color.red(), color.green(), color.blue(), color.alpha()]
    });
    LdrImage::new(map.width(), map.height(), pixels.collect())
}

/// The same on a ground of one colour.
pub(crate) fn render(
    svg: &str,
    scale: f32,
    ground: tiny_skia::Color,
) -> Result<tiny_skia::Pixmap, LabError> {
    let fail = |reason: String| LabError::Encode {
        format: "SVG drawing",
        reason,
    };
    let options = usvg::Options {
        fontdb: FONTS.clone(),
        font_family: FAMILY.into(),
        ..usvg::Options::default()
    };
    let tree = usvg::Tree::from_str(svg, &options).map_err(|error| fail(error.to_string()))?;
    let size = tree.size();
    let pixels = |length: f32| (length * scale).ceil() as u32;
    let mut map = tiny_skia::Pixmap::new(pixels(size.width()), pixels(size.height()))
        .ok_or_else(|| fail("the drawing is too large".into()))?;
    map.fill(ground);
    let transform = tiny_skia::Transform::from_scale(scale, scale);
    resvg::render(&tree, transform, &mut map.as_mut());
    Ok(map)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_drawing_has_its_colours_and_a_transparent_ground() {
        let svg = r##"<svg xmlns="http://www.w3.org/2000/svg" width="4" height="2">
            <rect width="2" height="2" fill="#ff8000"/></svg>"##;
        let picture = draw(svg, 2.0).unwrap();
        assert_eq!((picture.width, picture.height), (8, 4));
        assert_eq!(picture.pixels[0], [255, 128, 0, 255]);
        assert_eq!(picture.pixels[7], [0; 4]);
        assert!(draw("<svg", 1.0).unwrap_err().to_string().contains("SVG"));
    }
}
