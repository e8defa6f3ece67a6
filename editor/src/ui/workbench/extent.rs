//! How large the scene is, for the camera.

use lightbench::script::Scene;
use lightbench::world::glam::Vec3;
use lightbench::world::{Entity, WorldBounds, WorldMatrix};

use super::Workbench;
use super::viewports::Viewport;

/// A box around the meshes of an entity and of all below it.
pub fn bounds_of(scene: &Scene, entity: Entity) -> Option<(Vec3, Vec3)> {
    let below = scene.world.descendants(entity).into_iter();
    below
        .chain([entity])
        .filter_map(|entity| {
            let b: WorldBounds = scene.world.get(entity)?;
            let center = Vec3::new(b.x, b.y, b.z);
            let half = Vec3::new(b.half_x, b.half_y, b.half_z);
            Some((center - half, center + half))
        })
        .filter(|(min, max)| min.is_finite() && max.is_finite())
        .reduce(|(a, b), (min, max)| (a.min(min), b.max(max)))
}

impl Workbench {
    /// Shows the whole scene from the present direction, in the viewport that has the focus.
    pub fn frame_scene(&mut self) {
        if let Some(bounds) = self.scene_bounds() {
            self.frame_in(self.focus(), bounds);
        }
    }

    /// Shows all of what is chosen from the present direction, or the whole scene where nothing is, in
    /// the viewport that has the focus.
    pub fn frame_selection(&mut self) {
        match self.selection_bounds() {
            Some(bounds) => self.frame_in(self.focus(), bounds),
            None => self.frame_scene(),
        }
    }

    fn frame_in(&mut self, viewport: Viewport, (min, max): (Vec3, Vec3)) {
        let aspect = self.aspect_of(viewport);
        self.camera_of_mut(viewport).frame(min, max, aspect);
    }

    /// A box around what is chosen and all below it; what has no mesh counts with the metre around
    /// it.
    fn selection_bounds(&self) -> Option<(Vec3, Vec3)> {
        let scene = self.scenes.scene()?;
        let boxes = self.selection.entities().filter_map(|entity| {
            bounds_of(scene, entity).or_else(|| {
                let matrix: WorldMatrix = scene.world.get(entity)?;
                let at = Vec3::from(matrix.matrix.translation);
                Some((at - Vec3::splat(0.5), at + Vec3::splat(0.5)))
            })
        });
        boxes.reduce(|(a, b), (min, max)| (a.min(min), b.max(max)))
    }

    /// Back to the scene's own camera, in the viewport that has the focus.
    pub fn reset_camera(&mut self) {
        self.reset_camera_of(self.focus());
    }

    /// The same in a viewport.
    pub(super) fn reset_camera_of(&mut self, viewport: Viewport) {
        self.watch_camera(viewport, None);
        self.camera_of_mut(viewport).reset();
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
