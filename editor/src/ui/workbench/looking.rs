//! A target that somebody looks at.

use lightbench::render::inspect;

use super::Workbench;

impl Workbench {
    /// Chooses a target to look at, or none.
    pub fn inspect(&mut self, request: Option<inspect::Inspection>) {
        self.renderer.inspector().look(&self.files, request);
        self.canvas.invalidate();
    }

    /// What is being looked at.
    pub fn inspection(&mut self) -> Option<inspect::Inspection> {
        self.renderer.inspector().request().cloned()
    }

    /// The texture of a target of the pipeline on screen.
    pub fn target_texture(&mut self, name: &str) -> Option<wgpu::Texture> {
        let targets = self.pipelines.shown_pipeline()?.targets()?;
        Some(targets.get(name)?.texture.clone())
    }

    /// The picture of what is being looked at.
    pub fn inspected(&mut self) -> Option<wgpu::Texture> {
        self.renderer.inspector().picture().cloned()
    }
}
