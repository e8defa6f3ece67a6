//! Textures of the workbench as pictures in widgets.

use std::sync::Arc;

use egui::mutex::RwLock;
use egui::{TextureId, TextureOptions};

/// A texture and the name under which egui draws it.
#[derive(Debug)]
struct Shown {
    texture: wgpu::Texture,
    id: TextureId,
    options: TextureOptions,
}

/// Where a texture is shown. Each place keeps one name, whatever texture is behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The viewport.
    Viewport,
    /// The target viewer.
    Targets,
    /// What a pass left, in the viewport.
    Pass,
    /// Lines over the picture.
    Lines,
    /// The second viewport.
    Second,
    /// Lines over its picture.
    SecondLines,
}

/// Hands textures to the painter that draws the widgets.
pub struct Screen {
    device: wgpu::Device,
    painter: Arc<RwLock<egui_wgpu::Renderer>>,
    shown: [Option<Shown>; 6],
}

impl Screen {
    /// A screen whose widgets are drawn by `painter` on `device`.
    pub fn new(device: wgpu::Device, painter: Arc<RwLock<egui_wgpu::Renderer>>) -> Self {
        Self {
            device,
            painter,
            shown: [const { None }; 6],
        }
    }

    /// The name under which widgets draw a texture, until the next call for that place.
    pub fn show(
        &mut self,
        place: Place,
        texture: &wgpu::Texture,
        options: TextureOptions,
    ) -> TextureId {
        let slot = &mut self.shown[place as usize];
        if let Some(shown) = slot
            && shown.texture == *texture
            && shown.options == options
        {
            return shown.id;
        }
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let sampler = sampler(options);
        let mut painter = self.painter.write();
        let id = match slot.take() {
            Some(shown) => {
                painter.update_egui_texture_from_wgpu_texture_with_sampler_options(
                    &self.device,
                    &view,
                    sampler,
                    shown.id,
                );
                shown.id
            }
            None => {
                painter.register_native_texture_with_sampler_options(&self.device, &view, sampler)
            }
        };
        *slot = Some(Shown {
            texture: texture.clone(),
            id,
            options,
        });
        id
    }
}

fn sampler(options: TextureOptions) -> wgpu::SamplerDescriptor<'static> {
    let filter = |filter| match filter {
        egui::TextureFilter::Nearest => wgpu::FilterMode::Nearest,
        egui::TextureFilter::Linear => wgpu::FilterMode::Linear,
    };
    wgpu::SamplerDescriptor {
        label: Some("shown texture"),
        mag_filter: filter(options.magnification),
        min_filter: filter(options.minification),
        ..Default::default()
    }
}
