//! How large the scene is, for the camera.

use lightbench::world::WorldBounds;
use lightbench::world::glam::Vec3;

use super::Workbench;

impl Workbench {
    /// Shows the whole scene from the present direction.
    pub fn frame_scene(&mut self) {
        if let Some((min, max)) = self.scene_bounds() {
            self.camera.frame(min, max);
        }
    }

    /// A box around everything that is drawn.
    pub fn scene_bounds(&self) -> Option<(Vec3, Vec3)> {
        let bounds = self.scenes.scene()?.world.columns::<WorldBounds>();
        let b = bounds.slices();
        let boxes = (0..b.x.len()).map(|row| {
            let center = Vec3::new(b.x[row], b.y[row], b.z[row]);
            let half = Vec3::new(b.half_x[row], b.half_y[row], b.half_z[row]);
            (center - half, center + half)
        });
        boxes
            .filter(|(min, max)| min.is_finite() && max.is_finite())
            .reduce(|(a, b), (min, max)| (a.min(min), b.max(max)))
    }

    /// The median distance from the camera to the objects, metres: unlike the size of the box
    /// around them, a wide floor or sky does not sway it.
    pub fn typical_distance(&self) -> Option<f32> {
        let bounds = self.scenes.scene()?.world.columns::<WorldBounds>();
        let b = bounds.slices();
        let eye = self.camera.view().position();
        let distance = |row: usize| (Vec3::new(b.x[row], b.y[row], b.z[row]) - eye).length();
        let mut distances: Vec<f32> = (0..b.x.len()).map(distance).collect();
        distances.retain(|distance| distance.is_finite());
        let middle = distances.len() / 2;
        let (_, median, _) = distances
            .get(middle)
            .is_some()
            .then(|| distances.select_nth_unstable_by(middle, f32::total_cmp))?;
        Some(*median)
    }
}
