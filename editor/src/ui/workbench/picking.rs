//! What is under the pointer.

use lightbench::render::View;
use lightbench::script::{Ray, SceneEvent};
use lightbench::world::glam::Vec3;

use super::Workbench;
use super::viewports::Viewport;

/// The line of sight through a place of the picture, in shares of its width and height from the
/// upper left. It begins at the near plane: what is nearer is not drawn.
pub fn line_of_sight(view: &View, share: [f32; 2], aspect: f32) -> Ray {
    let to_world = (view.projection(aspect) * view.view).inverse();
    // Depth is reversed: 1 is the near plane.
    let ndc = Vec3::new(2.0 * share[0] - 1.0, 1.0 - 2.0 * share[1], 1.0);
    let origin = to_world.project_point3(ndc);
    let direction = (origin - view.position()).normalize_or_zero();
    Ray { origin, direction }
}

impl Workbench {
    /// Tells the scene's scripts what happens in the viewport.
    pub fn happen(&mut self, event: SceneEvent) {
        if let Some(scene) = self.scenes.scene_mut() {
            scene.happen(event);
        }
    }

    /// Tells the scene's scripts of a click at shares of the width and height of a viewport's picture,
    /// from the upper left.
    pub fn click(&mut self, viewport: Viewport, share: [f32; 2], aspect: f32) {
        let ray = line_of_sight(&self.camera_of(viewport).view(), share, aspect);
        self.happen(SceneEvent::Click(ray));
    }
}
