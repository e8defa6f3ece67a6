//! Counts a pixel as pictures: the lights that each pipeline evaluates.

use lightbench_assets::Progress;
use lightbench_render::{Pipeline, RenderError, Renderer};
use lightbench_script::Scene;

use crate::capture::{CaptureError, CaptureOptions, capture};
use crate::colormap::ColorMap;
use crate::heatmap::heat_map;
use crate::metrics::Plane;
use crate::report::ViewResult;

/// The heat map that counts, by the name that every pipeline's parameter `heat_map` has for it.
pub(super) const COUNTED: &str = "lights_evaluated";

/// The counts of the scene as it stands; `None` where the pipeline keeps no linear picture.
pub(super) fn count(
    renderer: &mut Renderer,
    scene: &mut Scene,
    pipeline: &mut Pipeline,
    size: (u32, u32),
) -> Result<Option<Plane>, RenderError> {
    let options = CaptureOptions { size, frame: 0 };
    let drawn = match capture(renderer, scene, pipeline, options, &Progress::new()) {
        Ok(drawn) => drawn,
        Err(CaptureError::Render(error)) => return Err(error),
        // Neither is done here: the scene is not moved, and nobody cancels.
        Err(CaptureError::Script(_) | CaptureError::Cancelled(_)) => return Ok(None),
    };
    Ok(drawn.hdr.map(|counts| Plane {
        width: counts.width as usize,
        height: counts.height as usize,
        values: counts.pixels.iter().map(|pixel| pixel[0]).collect(),
    }))
}

/// The counts of all pipelines at a point, painted with one scale, so that colours can be compared.
pub(super) fn paint(counts: &[Option<Plane>]) -> Vec<Option<ViewResult>> {
    let values = counts.iter().flatten().flat_map(|plane| &plane.values);
    let largest = values
        .copied()
        .filter(|v| v.is_finite())
        .fold(1.0, f32::max);
    let scale = f32::exp2(largest.log2().ceil());
    let view = |plane: &Plane| {
        let mean = plane.values.iter().map(|v| f64::from(*v)).sum::<f64>();
        let mean = mean / plane.values.len().max(1) as f64;
        ViewResult {
            name: "lights evaluated".to_owned(),
            description: format!(
                "Lights that each pixel evaluated, painted with the map viridis from 0 to {scale}; {mean:.2} \
                 in the mean"
            ),
            file: None,
            picture: Some(heat_map(plane, ColorMap::Viridis, scale)),
        }
    };
    counts
        .iter()
        .map(|plane| plane.as_ref().map(view))
        .collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn all_counts_share_one_scale() {
        let plane = |values: &[f32]| {
            Some(Plane {
                width: values.len(),
                height: 1,
                values: values.to_vec(),
            })
        };
        let views = paint(&[plane(&[0.0, 5.0]), None, plane(&[8.0, 9.0])]);
        assert!(views[1].is_none());
        let first = views[0].as_ref().unwrap();
        assert!(first.description.contains("from 0 to 16; 2.50 in the mean"));
        let pixels = &first.picture.as_ref().unwrap().pixels;
        let [r, g, b] = ColorMap::Viridis.color(5.0 / 16.0);
        assert_eq!(pixels[1], [r, g, b, 255]);
    }
}
