//! Lines over the picture: edges of triangles and normals of vertices.

use lightbench::render::overlay::Lines;
use lightbench::world::MeshRenderer;

use super::Workbench;

impl Workbench {
    /// Chooses the lines over the picture: of all objects, or of those that are chosen alone.
    pub fn draw_lines(&mut self, edges: bool, normals: bool, chosen_alone: bool) {
        let rows = chosen_alone.then(|| self.chosen_rows());
        let wanted = (edges || normals).then_some(Lines {
            edges,
            normals,
            rows,
        });
        if self.lines != wanted {
            self.lines.clone_from(&wanted);
            self.renderer.overlay().ask(&self.files, wanted);
            self.canvas.repeat();
        }
    }

    /// The lines over the picture as they were last drawn, colours multiplied by alpha.
    pub fn lines_picture(&mut self) -> Option<wgpu::Texture> {
        self.lines.as_ref()?;
        self.renderer.overlay().picture().cloned()
    }

    fn chosen_rows(&self) -> Vec<u32> {
        let Some(scene) = self.scenes.scene() else {
            return Vec::new();
        };
        let renderers = scene.world.columns::<MeshRenderer>();
        let chosen = self.selection.entities();
        let rows = chosen.filter_map(|entity| renderers.row_of(entity));
        let mut rows: Vec<u32> = rows.map(|row| row as u32).collect();
        rows.sort_unstable();
        rows
    }
}
