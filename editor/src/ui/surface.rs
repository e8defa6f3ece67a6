//! A window's surface on a device of our own, and the painter of widgets.

use std::sync::Arc;

use anyhow::{Context as _, anyhow};
use egui::mutex::RwLock;
use egui_wgpu::{RendererOptions, ScreenDescriptor};
use lightbench::render::{Gpu, GpuOptions};
use winit::event_loop::ActiveEventLoop;
use winit::window::Window;

/// A surface, its settings, and what paints widgets on it.
pub(super) struct WindowSurface {
    gpu: Gpu,
    instance: wgpu::Instance,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    painter: Arc<RwLock<egui_wgpu::Renderer>>,
}

impl WindowSurface {
    /// Opens a device that can draw to the window.
    ///
    /// # Errors
    /// Without a driver that can.
    pub(super) fn open(
        events: &ActiveEventLoop,
        window: &Arc<Window>,
        options: &GpuOptions,
    ) -> anyhow::Result<(Gpu, Self)> {
        let display = Box::new(events.owned_display_handle());
        let descriptor = wgpu::InstanceDescriptor::new_with_display_handle_from_env(display);
        let instance = wgpu::Instance::new(descriptor);
        let surface = instance
            .create_surface(Arc::clone(window))
            .context("the window can't be drawn to")?;
        let gpu = Gpu::open_for(&instance, &surface, options)?;

        let size = window.inner_size();
        let capabilities = surface.get_capabilities(&gpu.adapter);
        let format = egui_wgpu::preferred_framebuffer_format(&capabilities.formats)?;
        let mut config = surface
            .get_default_config(&gpu.adapter, size.width.max(1), size.height.max(1))
            .ok_or_else(|| anyhow!("{} can't draw to the window", gpu.summary.name))?;
        config.format = format;
        config.present_mode = wgpu::PresentMode::AutoVsync;
        // More frames on their way would only make the widgets late.
        config.desired_maximum_frame_latency = 1;
        surface.configure(&gpu.device, &config);
        let painter = egui_wgpu::Renderer::new(&gpu.device, format, RendererOptions::default());
        let this = Self {
            gpu: gpu.clone(),
            instance,
            surface,
            config,
            painter: Arc::new(RwLock::new(painter)),
        };
        Ok((gpu, this))
    }

    /// What paints the widgets.
    pub(super) fn painter(&self) -> Arc<RwLock<egui_wgpu::Renderer>> {
        Arc::clone(&self.painter)
    }

    /// Follows the window's size, in pixels.
    pub(super) fn resize(&mut self, width: u32, height: u32) {
        if width > 0 && height > 0 && (width, height) != (self.config.width, self.config.height) {
            (self.config.width, self.config.height) = (width, height);
            self.surface.configure(&self.gpu.device, &self.config);
        }
    }

    /// Paints one frame and shows it.
    ///
    /// # Errors
    /// When the surface can't be made anew after it was lost.
    pub(super) fn paint(
        &mut self,
        window: &Arc<Window>,
        shapes: &[egui::ClippedPrimitive],
        pixels_per_point: f32,
        mut textures: egui::TexturesDelta,
    ) -> anyhow::Result<()> {
        let (device, queue) = (&self.gpu.device, &self.gpu.queue);
        let mut painter = self.painter.write();
        for (id, deltas) in textures.set.drain() {
            for delta in deltas {
                painter.update_texture(device, queue, id, &delta);
            }
        }
        if let Some(frame) = acquire(
            &self.instance,
            &mut self.surface,
            window,
            device,
            &self.config,
        )? {
            let screen = ScreenDescriptor {
                size_in_pixels: [self.config.width, self.config.height],
                pixels_per_point,
            };
            let mut encoder =
                device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let buffers = painter.update_buffers(device, queue, &mut encoder, shapes, &screen);
            let view = frame
                .texture
                .create_view(&wgpu::TextureViewDescriptor::default());
            let render_pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("widgets"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations::default(),
                })],
                ..Default::default()
            });
            painter.render(&mut render_pass.forget_lifetime(), shapes, &screen);
            queue.submit(buffers.into_iter().chain([encoder.finish()]));
            window.pre_present_notify();
            queue.present(frame);
        }
        for id in textures.free.drain() {
            painter.free_texture(&id);
        }
        Ok(())
    }
}

/// The next texture to draw to; `None` where this frame can't be shown.
fn acquire(
    instance: &wgpu::Instance,
    surface: &mut wgpu::Surface<'static>,
    window: &Arc<Window>,
    device: &wgpu::Device,
    config: &wgpu::SurfaceConfiguration,
) -> anyhow::Result<Option<wgpu::SurfaceTexture>> {
    use wgpu::CurrentSurfaceTexture as Current;
    match surface.get_current_texture() {
        Current::Success(frame) | Current::Suboptimal(frame) => return Ok(Some(frame)),
        Current::Outdated => surface.configure(device, config),
        Current::Lost => {
            *surface = instance
                .create_surface(Arc::clone(window))
                .context("the window can't be drawn to any more")?;
            surface.configure(device, config);
        }
        // Hidden, or the display is busy: the next frame may do.
        Current::Timeout | Current::Occluded | Current::Validation => return Ok(None),
    }
    window.request_redraw();
    Ok(None)
}
