//! The renderer: a device, a scene on it, and frames through pipelines.

mod course;
mod error;
mod reading;

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use lightbench_assets::Assets;
use lightbench_world::{SystemTime, World, systems};

use crate::compile::Compiler;
use crate::frame::{Frame, FrameRequest};
use crate::gpu::{Gpu, GpuError};
use crate::inspect::Inspector;
use crate::layout::SceneLayout;
use crate::overlay::Overlay;
use crate::pipeline::Pipeline;
use crate::queries::{Measured, Queries};
use crate::record::{Recording, is_cold, measures, record, warm};
use crate::room::check_room;
use crate::scene::{Scene, Uploads};
use crate::series::FIRST_SERIES;
use crate::statistics::FrameStatistics;
use crate::targets::Targets;
use crate::view::View;

use course::Course;

pub use error::RenderError;

/// How often a frame is drawn before a buffer that is still too small is left so.
const MOST_ATTEMPTS: usize = 4;
/// Seconds after which a frame that does not end is given up.
const WAIT_SECONDS: u64 = 60;

/// Draws worlds through pipelines.
pub struct Renderer {
    gpu: Gpu,
    layout: SceneLayout,
    scene: Scene,
    frame: Frame,
    queries: Queries,
    inspector: Inspector,
    overlay: Overlay,
    /// Submissions that the device has not done yet.
    in_flight: Arc<AtomicUsize>,
    statistics: FrameStatistics,
    /// Counts the frames of this renderer, for the queries.
    serial: u32,
    /// The series that is drawn: the first one, but for the time of a frame.
    drawn_series: usize,
    /// By series; there is always the first.
    series: Vec<Course>,
}

impl Renderer {
    /// A renderer with an empty scene.
    pub fn new(gpu: Gpu) -> Self {
        let layout = SceneLayout::new(&gpu);
        let scene = Scene::new(&gpu, &layout);
        let queries = Queries::new(&gpu);
        let inspector = Inspector::new(&gpu);
        let overlay = Overlay::new(&gpu, &layout);
        Self {
            scene,
            queries,
            inspector,
            overlay,
            layout,
            gpu,
            frame: Frame::default(),
            in_flight: Arc::default(),
            statistics: FrameStatistics::default(),
            serial: 0,
            drawn_series: FIRST_SERIES,
            series: vec![Course::default()],
        }
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// A compiler of pipelines for this renderer; it can work on another thread.
    pub fn compiler(&self) -> Compiler {
        Compiler::new(&self.gpu, &self.layout)
    }

    /// Meshes and textures that have travelled to the device since the renderer was made.
    pub fn uploads(&self) -> Uploads {
        self.scene.uploads()
    }

    /// Bytes of meshes and textures that are on the device.
    pub fn asset_bytes(&self) -> u64 {
        self.scene.asset_bytes()
    }

    /// Tells the renderer that another world and other assets come next. Meshes and textures that
    /// both scenes share, by their revision, stay on the device. What was seen of the last scene is
    /// no earlier view of the next.
    pub fn reset_scene(&mut self) {
        self.scene.reset();
        for course in &mut self.series {
            course.views = Default::default();
        }
    }

    /// What had to be changed for the scene to fit the device, and materials whose reflection model a
    /// pipeline does not carry, once.
    pub fn take_warnings(&mut self) -> Vec<String> {
        self.scene.take_warnings()
    }

    /// Draws one frame and submits it. Results of queries come later: [`Renderer::poll`].
    ///
    /// Brings the world's computed columns up to date, extracts what is visible, uploads what
    /// changed and records the passes. `size` is in pixels, `time` in seconds since the scene began.
    ///
    /// # Errors
    /// When the scene does not fit the device, or the device failed.
    pub fn render(
        &mut self,
        world: &mut World,
        assets: &Assets,
        pipeline: &mut Pipeline,
        view: &View,
        size: (u32, u32),
        time: f64,
    ) -> Result<&FrameStatistics, RenderError> {
        self.prepare(world, assets, pipeline, view, size, time)?;
        let visible = self.frame.visible_rows();
        let series = self.drawn_series;
        self.overlay
            .gather(series, world, &self.scene.meshes, visible);
        let course = &mut self.series[series];
        pipeline.begin_frame(self.serial, course.index);
        course
            .views
            .draw(course.index, self.frame.data.view_projection);
        let started = Instant::now();
        let (recording, ()) = SystemTime::of("recording", || self.record_frame(pipeline));
        self.statistics.systems.push(recording);
        self.statistics.record_ms += started.elapsed().as_secs_f64() * 1e3;
        self.statistics.gpu_ms = None;
        self.statistics.objects = self.frame.visible_objects;
        self.statistics.lights = self.frame.visible_lights;
        self.statistics.unconfined_lights = self.frame.unconfined_lights(world);
        self.statistics.uploaded_bytes = self.scene.take_uploaded_bytes();
        self.serial = self.serial.wrapping_add(1);
        let course = &mut self.series[series];
        course.index = course.index.wrapping_add(1);
        Ok(&self.statistics)
    }

    /// As [`Renderer::render`], as the next picture of a series of its own: see [`crate::series`]. What
    /// is drawn is in [`Pipeline::targets_of`].
    ///
    /// # Errors
    /// As [`Renderer::render`].
    #[allow(clippy::too_many_arguments)] // Those of `render`, and which series.
    pub fn render_in(
        &mut self,
        series: usize,
        world: &mut World,
        assets: &Assets,
        pipeline: &mut Pipeline,
        view: &View,
        size: (u32, u32),
        time: f64,
    ) -> Result<&FrameStatistics, RenderError> {
        if self.series.len() <= series {
            self.series.resize_with(series + 1, Course::default);
        }
        pipeline.swap_series(series);
        self.drawn_series = series;
        let result = self
            .render(world, assets, pipeline, view, size, time)
            .map(|_| ());
        self.drawn_series = FIRST_SERIES;
        pipeline.swap_series(series);
        result.map(|()| &self.statistics)
    }

    /// Makes a pipeline ready to draw without a delay: once the device is idle, draws once, clipped
    /// away, with one of the GPU pipelines that the frame would need and that nobody has drawn with.
    /// Says whether none is left.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn warm_up(
        &mut self,
        world: &mut World,
        assets: &Assets,
        pipeline: &mut Pipeline,
        view: &View,
        size: (u32, u32),
        time: f64,
    ) -> Result<bool, RenderError> {
        self.prepare(world, assets, pipeline, view, size, time)?;
        let cold = is_cold(pipeline, &self.frame, &self.scene.meshes);
        if !cold || self.in_flight() > 0 {
            return Ok(!cold);
        }
        let group = self.upload(pipeline);
        let mut encoder = self
            .gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let recording = Recording {
            frame: &self.frame,
            meshes: &self.scene.meshes,
            scene: &group,
            view_bytes: self.scene.view_bytes(),
        };
        warm(pipeline, &recording, &self.queries, &mut encoder);
        self.submit(encoder);
        Ok(false)
    }

    /// Uploads the frame, records all passes and submits them.
    fn record_frame(&mut self, pipeline: &Pipeline) {
        let group = self.upload(pipeline);
        let mut encoder = self
            .gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.queries.begin(
            self.serial,
            measures(pipeline, &self.frame, &self.inspector),
            pipeline.desc.counters.len(),
        );
        let recording = Recording {
            frame: &self.frame,
            meshes: &self.scene.meshes,
            scene: &group,
            view_bytes: self.scene.view_bytes(),
        };
        record(
            pipeline,
            &recording,
            &mut encoder,
            &self.queries,
            &mut self.inspector,
            &mut self.statistics.passes,
        );
        for (index, counter) in pipeline.desc.counters.iter().enumerate() {
            let targets = pipeline.targets();
            if let Some(buffer) = targets.and_then(|targets| targets.buffer(&counter.buffer)) {
                self.queries
                    .counter(index, buffer, counter.word, &mut encoder);
            }
        }
        self.queries.resolve(&mut encoder);
        if let Some(targets) = pipeline.targets() {
            let buffers = self.scene.meshes.buffers();
            self.overlay.draw(
                self.drawn_series,
                buffers,
                &group,
                targets.size,
                &mut encoder,
            );
        }
        self.inspector.end_frame(&mut encoder);
        self.submit(encoder);
        self.queries.submitted();
        self.inspector.submitted();
    }

    fn submit(&self, encoder: wgpu::CommandEncoder) {
        self.gpu.queue.submit([encoder.finish()]);
        self.in_flight.fetch_add(1, Ordering::AcqRel);
        let in_flight = Arc::clone(&self.in_flight);
        self.gpu.queue.on_submitted_work_done(move || {
            in_flight.fetch_sub(1, Ordering::AcqRel);
        });
    }

    /// Frames and warming draws that the device has not done yet, as far as [`Renderer::poll`] has
    /// seen. Many drivers let the next submission wait for them.
    pub fn in_flight(&self) -> usize {
        self.in_flight.load(Ordering::Acquire)
    }

    /// Extracts the frame and makes the pipeline's targets fit it.
    fn prepare(
        &mut self,
        world: &mut World,
        assets: &Assets,
        pipeline: &mut Pipeline,
        view: &View,
        size: (u32, u32),
        time: f64,
    ) -> Result<(), RenderError> {
        let limit = self.gpu.device.limits().max_texture_dimension_2d;
        let (width, height) = (size.0.max(1), size.1.max(1));
        if width > limit || height > limit {
            return Err(RenderError::Size {
                width,
                height,
                limit,
            });
        }
        self.gpu.check()?;

        let started = Instant::now();
        systems::update_computed(world, assets.mesh_bounds());
        self.scene
            .sync_assets(assets, pipeline.models)
            .map_err(RenderError::Scene)?;
        self.tell_models(pipeline);
        let (copying, ()) = SystemTime::of("changed rows", || self.scene.sync_world(world));
        let course = &self.series[self.drawn_series];
        let request = FrameRequest {
            view: *view,
            size: (width, height),
            time: time as f32,
            index: course.index,
            models: pipeline.models,
            previous: course.views.before(course.index),
            lists: &pipeline.lists,
            light_lists: &pipeline.light_lists,
            shadow_lists: &pipeline.shadow_lists,
            clamps_depth: self.gpu.clamps_depth(),
        };
        let (extraction, ()) = SystemTime::of("extraction", || {
            let (instances, lights) = (self.scene.instances(), self.scene.lights());
            self.frame
                .extract(world, assets, instances, lights, &request);
        });
        self.statistics.systems.clear();
        self.statistics.systems.extend([copying, extraction]);
        self.statistics.extract_ms = started.elapsed().as_secs_f64() * 1e3;
        let missing = self.frame.variants.without(pipeline.variants());
        if !missing.is_empty() {
            return Err(RenderError::NotBuilt(missing));
        }

        let started = Instant::now();
        let lights = self.scene.lights().len() as u32;
        let same = |targets: &Targets| targets.size == (width, height) && lights <= targets.lights;
        if !pipeline.targets().is_some_and(same) {
            let limits = self.gpu.device.limits();
            let room = lights.next_power_of_two();
            check_room(&pipeline.desc, &limits, (width, height), room)
                .map_err(RenderError::Room)?;
        }
        self.scene.upload_views(&self.frame);
        let engine = self.scene.engine_buffers();
        let most = self.gpu.device.limits().max_storage_buffer_binding_size;
        if let Some(problem) = engine.too_large(pipeline.engine_buffers(), most) {
            return Err(RenderError::Scene(problem));
        }
        let targets = pipeline.prepare(&self.gpu, engine, (width, height), lights);
        self.statistics.target_bytes = targets.bytes();
        self.statistics.saved_bytes = targets.saved_bytes;
        self.statistics.record_ms = started.elapsed().as_secs_f64() * 1e3;
        Ok(())
    }

    /// Uploads the frame, and gives the scene's bind group.
    fn upload(&mut self, pipeline: &Pipeline) -> wgpu::BindGroup {
        self.frame.data.history_frames = pipeline.history_frames();
        self.scene.upload(&self.frame).clone()
    }

    /// Warns once where a pipeline does not carry the reflection models of the scene's materials.
    fn tell_models(&mut self, pipeline: &mut Pipeline) {
        let replaced = self.scene.replaced_models();
        self.statistics.replaced_models = replaced;
        if pipeline.told_models != replaced {
            pipeline.told_models = replaced;
            if replaced.total() > 0 {
                let name = &pipeline.desc.name;
                self.scene.warn(format!("{name}: {replaced}"));
            }
        }
    }

    /// As [`Renderer::render`], but waits for the counters of pipelines whose buffers may be too
    /// small, and draws again until all fits.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn render_whole(
        &mut self,
        world: &mut World,
        assets: &Assets,
        pipeline: &mut Pipeline,
        view: &View,
        size: (u32, u32),
        time: f64,
    ) -> Result<&FrameStatistics, RenderError> {
        let index = self.frame_index();
        if pipeline.may_outgrow() {
            // Results of earlier frames that nobody took would leave no room for this one's.
            self.finish(WAIT_SECONDS)?;
        }
        // A buffer that grew is large enough, unless another grew because of it.
        for _ in 0..MOST_ATTEMPTS {
            self.set_frame_index(index);
            self.render(world, assets, pipeline, view, size, time)?;
            if !pipeline.may_outgrow() || !pipeline.grow(&self.finish(WAIT_SECONDS)?) {
                break;
            }
        }
        Ok(&self.statistics)
    }

    /// Shows a target as it is after a pass: see [`Inspector`].
    pub fn inspector(&mut self) -> &mut Inspector {
        &mut self.inspector
    }

    /// Draws lines over pictures: see [`Overlay`].
    pub fn overlay(&mut self) -> &mut Overlay {
        &mut self.overlay
    }

    /// Whether the passes of the frames from now on are timed and their fragments and counters counted,
    /// as they are at first. Without, a frame costs what it costs where nobody measures, and
    /// [`Renderer::finish`] has nothing of it; nor is it told then that a buffer was too small.
    pub fn enable_queries(&mut self, enabled: bool) {
        self.queries.enable(enabled);
    }

    /// The number that the next frame will have in [`Measured::frame`].
    pub fn next_frame(&self) -> u32 {
        self.serial
    }

    /// Sets what the shaders of the next frame see as `frame_index`, which then counts on. Several
    /// pipelines that draw the same moment of a scene must see the same.
    pub fn set_frame_index(&mut self, index: u32) {
        self.series[FIRST_SERIES].index = index;
    }

    /// What the shaders of the next frame see as `frame_index`.
    pub fn frame_index(&self) -> u32 {
        self.series[FIRST_SERIES].index
    }

    /// The frame as it was last extracted.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The lights of the last frame as shaders saw them, in the order of their rows.
    pub fn lights(&self) -> &[crate::gpu_data::LightData] {
        self.scene.lights()
    }

    /// Query results that have come back, without waiting; until the next call.
    ///
    /// # Errors
    /// When the device failed.
    pub fn poll(&mut self) -> Result<&[Measured], GpuError> {
        if let Err(error) = self.gpu.device.poll(wgpu::PollType::Poll) {
            return Err(GpuError::Driver(error.to_string()));
        }
        self.gpu.check()?;
        Ok(self.queries.collect())
    }

    /// Waits for all frames and returns the query results.
    ///
    /// # Errors
    /// When the device failed or takes longer than `seconds`.
    pub fn finish(&mut self, seconds: u64) -> Result<Vec<Measured>, GpuError> {
        self.gpu.wait(seconds)?;
        Ok(self.queries.collect().to_vec())
    }
}
