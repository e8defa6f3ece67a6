//! Lines over the picture: edges of triangles and normals of vertices.

use lightbench::render::overlay::Lines;
use lightbench::world::MeshRenderer;

use super::Workbench;
use super::viewports::Viewport;

impl Workbench {
    /// Chooses the lines over a viewport's picture: of all objects, or of those that are chosen alone.
    pub fn draw_lines(
        &mut self,
        viewport: Viewport,
        edges: bool,
        normals: bool,
        chosen_alone: bool,
    ) {
        let shown = edges || normals;
        let rows = (chosen_alone && shown).then(|| self.chosen_rows());
        let wanted = shown.then_some(Lines {
            edges,
            normals,
            rows,
        });
        let series = viewport.series();
        if self.lines[series] != wanted {
            self.lines[series].clone_from(&wanted);
            self.renderer.overlay().ask_in(series, &self.files, wanted);
            self.canvas_of_mut(viewport).repeat();
        }
    }

    /// The lines over a viewport's picture as they were last drawn, colours multiplied by alpha.
    pub fn lines_picture(&mut self, viewport: Viewport) -> Option<wgpu::Texture> {
        let series = viewport.series();
        self.lines[series].as_ref()?;
        self.renderer.overlay().picture_of(series).cloned()
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
