//! The window: events in, frames out, and a device that may be lost.

use std::sync::Arc;
use std::time::{Duration, Instant};

use anyhow::{Context as _, anyhow};
use egui_winit::accesskit_winit;
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::window::{Window, WindowId};

use super::gallery::thumbnails;
use super::kept::Kept;
use super::surface::WindowSurface;
use super::workbench::Workbench;
use super::{Editor, EditorOptions, theme};
use crate::ui::messages::say;

/// How often a lost device is replaced before the editor gives up.
const MAX_LOSSES: u32 = 3;

/// Sent from other threads.
#[derive(Debug)]
enum Sent {
    /// Something is to be drawn again.
    Repaint { at: Instant },
    /// From a screen reader, or another program that reads widgets and acts on them.
    Access(accesskit_winit::Event),
}

impl From<accesskit_winit::Event> for Sent {
    fn from(event: accesskit_winit::Event) -> Self {
        Self::Access(event)
    }
}

/// Opens the window and runs until it is closed.
pub(super) fn run(options: EditorOptions) -> anyhow::Result<()> {
    let events = EventLoop::<Sent>::with_user_event()
        .build()
        .context(say!("window.no_window_can_be_opened_here"))?;
    let mut program = Program {
        proxy: events.create_proxy(),
        options: Some(options),
        running: None,
        repaint_at: None,
        failure: None,
    };
    events
        .run_app(&mut program)
        .context(say!("window.the_window_event_loop_failed"))?;
    program.failure.map_or(Ok(()), Err)
}

struct Program {
    proxy: EventLoopProxy<Sent>,
    /// Taken when the window opens.
    options: Option<EditorOptions>,
    running: Option<Running>,
    repaint_at: Option<Instant>,
    failure: Option<anyhow::Error>,
}

/// Everything that exists while the window does.
struct Running {
    // Before the window, so that the surface goes first.
    surface: WindowSurface,
    editor: Editor,
    input: egui_winit::State,
    info: egui::ViewportInfo,
    window: Arc<Window>,
    losses: u32,
}

impl Program {
    fn open(&mut self, events: &ActiveEventLoop) -> anyhow::Result<()> {
        let Some(options) = self.options.take() else {
            return Ok(());
        };
        let attributes = Window::default_attributes()
            .with_title(say!("window.lightbench"))
            .with_inner_size(LogicalSize::new(1440.0, 900.0))
            .with_min_inner_size(LogicalSize::new(640.0, 400.0))
            // Shown when it can be read by other programs, which must be so from the beginning.
            .with_visible(false);
        let window = Arc::new(
            events
                .create_window(attributes)
                .context(say!("window.no_window"))?,
        );
        let (gpu, surface) = WindowSurface::open(events, &window, &options.gpu)?;

        let ctx = self.context();
        let wake_ctx = ctx.clone();
        let wake = Arc::new(move || wake_ctx.request_repaint());
        let mut input = egui_winit::State::new(
            ctx,
            egui::ViewportId::ROOT,
            &window,
            Some(window.scale_factor() as f32),
            window.theme(),
            Some(gpu.device.limits().max_texture_dimension_2d as usize),
        );
        input.init_accesskit(events, &window, self.proxy.clone());
        window.set_visible(true);
        let kept = Kept::read(options.kept.clone());
        let workbench = Workbench::new(gpu, options, wake);
        let mut editor = Editor::new(workbench, surface.painter(), kept);
        editor.dialogs.window = Some(Arc::clone(&window));
        editor.gallery.thumbnails.folder = thumbnails::default_folder();
        window.request_redraw();
        self.running = Some(Running {
            surface,
            editor,
            input,
            info: egui::ViewportInfo::default(),
            window,
            losses: 0,
        });
        Ok(())
    }

    /// A context that wakes the event loop, from any thread.
    fn context(&self) -> egui::Context {
        let ctx = egui::Context::default();
        theme::apply(&ctx);
        let proxy = self.proxy.clone();
        ctx.set_request_repaint_callback(move |info| {
            let at = Instant::now() + info.delay.min(Duration::from_secs(3600));
            // The loop has ended: there is nothing to repaint.
            let _ = proxy.send_event(Sent::Repaint { at });
        });
        ctx
    }

    fn redraw(&mut self, events: &ActiveEventLoop) {
        let Some(running) = &mut self.running else {
            return;
        };
        if let Err(error) = running.frame() {
            self.failure = Some(error);
            events.exit();
            return;
        }
        if running.editor.wants_to_quit() {
            events.exit();
        }
        if let Err(error) = self.replace_lost_device(events) {
            self.failure = Some(error);
            events.exit();
        }
    }

    /// Opens another device where one was lost. The scene, the camera, the time and the panels
    /// stay; pipelines are built anew.
    fn replace_lost_device(&mut self, events: &ActiveEventLoop) -> anyhow::Result<()> {
        let ctx = self.context();
        let Some(running) = &mut self.running else {
            return Ok(());
        };
        let Some(reason) = running.editor.workbench.lost() else {
            return Ok(());
        };
        running.losses += 1;
        if running.losses > MAX_LOSSES {
            return Err(anyhow!(
                "the graphics device was lost {MAX_LOSSES} times, at last: {reason}"
            ));
        }
        let options = running.editor.workbench.gpu_options().clone();
        let (gpu, surface) = WindowSurface::open(events, &running.window, &options)?;
        // A new context sends its fonts to the new device; what it remembers stays.
        let memory = running.input.egui_ctx().memory(Clone::clone);
        ctx.memory_mut(|new| *new = memory);
        // Whoever reads the window goes on with the widgets of the new context.
        let reader = running.input.accesskit.take();
        if reader.is_some() {
            ctx.enable_accesskit();
        }
        running.input = egui_winit::State::new(
            ctx,
            egui::ViewportId::ROOT,
            &running.window,
            Some(running.window.scale_factor() as f32),
            running.window.theme(),
            Some(gpu.device.limits().max_texture_dimension_2d as usize),
        );
        running.input.accesskit = reader;
        running.editor.move_to(gpu, surface.painter());
        running.surface = surface;
        running.window.request_redraw();
        Ok(())
    }

    fn schedule(&mut self, at: Instant) {
        self.repaint_at = Some(self.repaint_at.map_or(at, |earlier| earlier.min(at)));
    }
}

impl Running {
    /// What a program asks that reads the window: a tree of the widgets, or to act on one.
    fn access(&mut self, event: accesskit_winit::WindowEvent) {
        let ctx = self.input.egui_ctx();
        match event {
            accesskit_winit::WindowEvent::InitialTreeRequested => ctx.enable_accesskit(),
            accesskit_winit::WindowEvent::ActionRequested(request) => {
                self.input.on_accesskit_action_request(request);
            }
            accesskit_winit::WindowEvent::AccessibilityDeactivated => ctx.disable_accesskit(),
        }
        self.window.request_redraw();
    }

    /// One frame: input, widgets, paint.
    fn frame(&mut self) -> anyhow::Result<()> {
        let ctx = self.input.egui_ctx().clone();
        egui_winit::update_viewport_info(&mut self.info, &ctx, &self.window, false);
        let mut input = self.input.take_egui_input(&self.window);
        input
            .viewports
            .insert(egui::ViewportId::ROOT, self.info.clone());
        let output = ctx.run_ui(input, |ui| self.editor.ui(ui));
        self.input
            .handle_platform_output(&self.window, output.platform_output);
        let shapes = ctx.tessellate(output.shapes, output.pixels_per_point);
        self.surface.paint(
            &self.window,
            &shapes,
            output.pixels_per_point,
            output.textures_delta,
        )
    }
}

impl ApplicationHandler<Sent> for Program {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.running.is_none()
            && let Err(error) = self.open(events)
        {
            self.failure = Some(error);
            events.exit();
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, sent: Sent) {
        match sent {
            Sent::Repaint { at } => self.schedule(at),
            Sent::Access(event) => {
                if let Some(running) = &mut self.running {
                    running.access(event.window_event);
                }
            }
        }
    }

    fn new_events(&mut self, _: &ActiveEventLoop, _: StartCause) {
        if let Some(at) = self.repaint_at
            && at <= Instant::now()
            && let Some(running) = &self.running
        {
            self.repaint_at = None;
            running.window.request_redraw();
        }
    }

    fn about_to_wait(&mut self, events: &ActiveEventLoop) {
        events.set_control_flow(match self.repaint_at {
            Some(at) => ControlFlow::WaitUntil(at),
            None => ControlFlow::Wait,
        });
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(running) = &mut self.running else {
            return;
        };
        match &event {
            WindowEvent::RedrawRequested => {
                self.redraw(events);
                return;
            }
            WindowEvent::CloseRequested => {
                running.editor.ask_to_quit();
                if running.editor.wants_to_quit() {
                    events.exit();
                } else {
                    running.window.request_redraw();
                }
                return;
            }
            WindowEvent::Resized(size) => running.surface.resize(size.width, size.height),
            _ => {}
        }
        if running
            .input
            .on_window_event(&running.window, &event)
            .repaint
        {
            running.window.request_redraw();
        }
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        // Threads end and the device goes before the display connection does.
        self.running = None;
    }
}
