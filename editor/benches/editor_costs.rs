//! What the editor's widgets cost: processor time of the window's thread for a frame with all panels open,
//! against the bare viewport (the world's step and the picture, without a widget), in turn in one process.
//!
//! ```sh
//! cargo bench -p lightbench-editor --bench editor_costs
//! ```

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use cpu_time::ThreadTime;
use egui::mutex::RwLock;
use lightbench::assets::files::Files;
use lightbench::render::{Gpu, GpuOptions};
use lightbench_editor::ui::kept::Kept;
use lightbench_editor::ui::workbench::Workbench;
use lightbench_editor::ui::{Editor, EditorOptions, layout, theme};

/// The window in points, which are pixels here.
const WINDOW: (u32, u32) = (2560, 1440);

/// Frames of each kind.
const FRAMES: usize = 200;

/// The scene's entities: boxes that stand in rows, each with a name, and one lamp for sixteen of them.
fn scene(entities: usize) -> String {
    format!(
        "let across = 40;
for i in 0..{entities} {{
    let x = (i % across) * 0.5 - 10.0;
    let z = -(i / across) * 0.5;
    if i % 16 == 0 {{
        point_light(`lamp ${{i}}`).at(x, 1.0, z).range(2).intensity(1);
    }} else {{
        spawn(`box ${{i}}`).mesh(box(0.2)).at(x, 0.1, z);
    }}
}}
camera(\"eye\").at(0, 4, 8).look_at(0, 0, -4).fov(50);
"
    )
}

struct Window {
    ctx: egui::Context,
    editor: Editor,
    painter: Arc<RwLock<egui_wgpu::Renderer>>,
    target: wgpu::TextureView,
    began: Instant,
}

impl Window {
    fn open(project: &Path, entities: usize) -> Self {
        let folder = project.join("scripts/scenes");
        std::fs::create_dir_all(&folder).expect("the folder of scenes");
        std::fs::write(folder.join("rows.rhai"), scene(entities)).expect("the scene");
        let files = Files::with_project(project).expect("the project");
        let gpu = Gpu::open(&GpuOptions::default()).expect("an adapter");
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let options = egui_wgpu::RendererOptions::default();
        let painter = egui_wgpu::Renderer::new(&gpu.device, format, options);
        let painter = Arc::new(RwLock::new(painter));
        let target = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("window"),
            size: wgpu::Extent3d {
                width: WINDOW.0,
                height: WINDOW.1,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        let options = EditorOptions {
            scene: "rows".to_owned(),
            ..EditorOptions::new(files)
        };
        let mut workbench = Workbench::new(gpu, options, Arc::new(|| {}));
        workbench.resolution.adaptive = false;
        let mut editor = Editor::new(workbench, Arc::clone(&painter), Kept::read(None));
        editor.welcome = false;
        editor.hint = false;
        editor.lay_out(layout::all());
        let ctx = egui::Context::default();
        theme::apply(&ctx);
        let mut window = Self {
            ctx,
            editor,
            painter,
            target: target.create_view(&wgpu::TextureViewDescriptor::default()),
            began: Instant::now(),
        };
        let began = Instant::now();
        while window.editor.workbench.drawn_size().is_none()
            || window.editor.workbench.library.is_busy()
        {
            window.frame();
            if let Some(problem) = window.editor.workbench.problems().next() {
                panic!("{problem}");
            }
            assert!(began.elapsed() < Duration::from_secs(60), "no picture");
        }
        let workbench = &mut window.editor.workbench;
        let scene = workbench.scenes.scene().expect("a scene");
        let middle = scene.world.entities().nth(entities / 2);
        workbench.selection.set(scene, middle);
        window
    }

    /// A frame of the window, with all its widgets.
    fn frame(&mut self) {
        let size = egui::vec2(WINDOW.0 as f32, WINDOW.1 as f32);
        let input = egui::RawInput {
            screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, size)),
            time: Some(self.began.elapsed().as_secs_f64()),
            focused: true,
            ..egui::RawInput::default()
        };
        let editor = &mut self.editor;
        let mut output = self.ctx.run_ui(input, |ui| editor.ui(ui));
        let shapes = self.ctx.tessellate(output.shapes, output.pixels_per_point);
        let gpu = self.editor.workbench.gpu();
        let (device, queue) = (&gpu.device, &gpu.queue);
        let mut painter = self.painter.write();
        for (id, deltas) in output.textures_delta.set.drain() {
            for delta in deltas {
                painter.update_texture(device, queue, id, &delta);
            }
        }
        let screen = egui_wgpu::ScreenDescriptor {
            size_in_pixels: [WINDOW.0, WINDOW.1],
            pixels_per_point: 1.0,
        };
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let buffers = painter.update_buffers(device, queue, &mut encoder, &shapes, &screen);
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("widgets"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations::default(),
            })],
            ..Default::default()
        });
        painter.render(&mut pass.forget_lifetime(), &shapes, &screen);
        queue.submit(buffers.into_iter().chain([encoder.finish()]));
        for id in output.textures_delta.free.drain() {
            painter.free_texture(&id);
        }
    }

    /// The same without a widget.
    fn bare(&mut self, size: (u32, u32)) {
        self.editor.workbench.tick(Instant::now());
        self.editor.workbench.draw(size, Instant::now());
    }

    fn wait(&self) {
        let gpu = self.editor.workbench.gpu();
        gpu.wait(60).expect("the device has done its work");
    }
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_unstable_by(f64::total_cmp);
    times[times.len() / 2]
}

fn main() {
    println!(
        "processor time of the window's thread for a frame of {} x {}, ms, medians of {FRAMES}",
        WINDOW.0, WINDOW.1
    );
    println!(
        "{:>9} {:>8} {:>8} {:>8} {:>8} {:>7}",
        "entities", "time", "all", "bare", "widgets", "ratio"
    );
    for entities in [1_000, 20_000] {
        let project = tempfile::tempdir().expect("a folder");
        let mut window = Window::open(project.path(), entities);
        for playing in [false, true] {
            window.editor.workbench.clock.playing = playing;
            let size = window.editor.workbench.drawn_size().expect("a picture");
            let (mut all, mut bare) = (Vec::new(), Vec::new());
            for frame in 0..2 * FRAMES {
                window.wait();
                let began = ThreadTime::now();
                match frame % 2 {
                    0 => window.frame(),
                    _ => window.bare(size),
                }
                let took = began.elapsed().as_secs_f64() * 1e3;
                match frame % 2 {
                    0 => all.push(took),
                    _ => bare.push(took),
                }
            }
            let (all, bare) = (median(&mut all), median(&mut bare));
            println!(
                "{entities:>9} {:>8} {all:>8.2} {bare:>8.2} {:>8.2} {:>7.2}",
                if playing { "runs" } else { "stands" },
                all - bare,
                all / bare
            );
        }
    }
}
