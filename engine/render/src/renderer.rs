//! The renderer: a device, a scene on it, and frames through pipelines.

use std::time::Instant;

use lightbench_assets::Assets;
use lightbench_world::{SystemTime, World, systems};

use crate::compile::Compiler;
use crate::description::Slice;
use crate::frame::{Frame, FrameRequest};
use crate::gpu::{Gpu, GpuError};
use crate::inspect::Inspector;
use crate::layout::SceneLayout;
use crate::pipeline::Pipeline;
use crate::queries::{Measured, Queries};
use crate::readback::{TargetImage, read_bytes, read_image};
use crate::record::{Recording, measures, record};
use crate::scene::Scene;
use crate::statistics::FrameStatistics;
use crate::view::View;

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
    statistics: FrameStatistics,
    /// Counts the frames of this renderer, for the queries.
    serial: u32,
    /// What shaders see as `frame_index`.
    index: u32,
}

/// Why a frame could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The scene does not fit the device.
    #[error("{0}")]
    Scene(String),
    /// A target was asked for that the pipeline does not have, or before the first frame.
    #[error("the pipeline has no target `{0}` yet")]
    NoTarget(String),
    /// A mip level or layer was asked for that the target does not have.
    #[error("`{target}` has {mips} mip levels and {layers} layers, both counted from 0")]
    NoSlice {
        /// The target.
        target: String,
        /// Its mip levels.
        mips: u32,
        /// Its layers.
        layers: u32,
    },
    /// The size asked for is beyond the device.
    #[error(
        "{width} × {height} is more than this device draws; its limit is {limit} in each direction"
    )]
    Size {
        /// Asked for.
        width: u32,
        /// Asked for.
        height: u32,
        /// The device's limit.
        limit: u32,
    },
}

impl Renderer {
    /// A renderer with an empty scene.
    pub fn new(gpu: Gpu) -> Self {
        let layout = SceneLayout::new(&gpu);
        let scene = Scene::new(&gpu, &layout);
        let queries = Queries::new(&gpu);
        let inspector = Inspector::new(&gpu);
        Self {
            scene,
            queries,
            inspector,
            layout,
            gpu,
            frame: Frame::default(),
            statistics: FrameStatistics::default(),
            serial: 0,
            index: 0,
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

    /// Tells the renderer that another world and other assets come next.
    pub fn reset_scene(&mut self) {
        self.scene.reset();
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
        let request = FrameRequest {
            view: *view,
            size: (width, height),
            time: time as f32,
            index: self.index,
            models: pipeline.models,
            lists: &pipeline.lists,
            light_lists: &pipeline.light_lists,
        };
        let (extraction, ()) = SystemTime::of("extraction", || {
            let (instances, lights) = (self.scene.instances(), self.scene.lights());
            self.frame
                .extract(world, assets, instances, lights, &request);
        });
        self.statistics.systems.clear();
        self.statistics.systems.extend([copying, extraction]);
        self.statistics.extract_ms = started.elapsed().as_secs_f64() * 1e3;

        let started = Instant::now();
        let lights = self.scene.lights().len() as u32;
        let engine = self.scene.engine_buffers();
        let numbers = (self.serial, self.index);
        let targets = pipeline.prepare(&self.gpu, engine, (width, height), lights, numbers);
        let target_bytes = targets.bytes();
        self.statistics.saved_bytes = targets.saved_bytes;
        self.frame.data.history_frames = pipeline.history_frames();
        let group = self.scene.upload(&self.frame).clone();
        let mut encoder = self
            .gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.queries.begin(
            self.serial,
            measures(pipeline, &self.inspector),
            pipeline.desc.counters.len(),
        );
        let recording = Recording {
            frame: &self.frame,
            meshes: &self.scene.meshes,
            scene: &group,
            other_models: self.scene.has_other_models(),
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
        self.gpu.queue.submit([encoder.finish()]);
        self.queries.submitted();

        self.statistics.record_ms = started.elapsed().as_secs_f64() * 1e3;
        self.statistics.gpu_ms = None;
        self.statistics.objects = self.frame.visible_objects;
        self.statistics.lights = self.frame.visible_lights;
        self.statistics.uploaded_bytes = self.scene.take_uploaded_bytes();
        self.statistics.target_bytes = target_bytes;
        self.serial = self.serial.wrapping_add(1);
        self.index = self.index.wrapping_add(1);
        Ok(&self.statistics)
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
        let index = self.index;
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

    /// The number that the next frame will have in [`Measured::frame`].
    pub fn next_frame(&self) -> u32 {
        self.serial
    }

    /// Sets what the shaders of the next frame see as `frame_index`, which then counts on. Several
    /// pipelines that draw the same moment of a scene must see the same.
    pub fn set_frame_index(&mut self, index: u32) {
        self.index = index;
    }

    /// The frame as it was last extracted.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The lights of the last frame as shaders saw them, in the order of their rows.
    pub fn lights(&self) -> &[crate::gpu_data::LightData] {
        self.scene.lights()
    }

    /// Query results that have come back, without waiting.
    ///
    /// # Errors
    /// When the device failed.
    pub fn poll(&mut self) -> Result<Vec<Measured>, GpuError> {
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
        Ok(self.queries.collect())
    }

    /// The display-ready picture of the last frame, 8 bits a channel, sRGB, rows from the top.
    ///
    /// # Errors
    /// Before the first frame, or when the device failed.
    pub fn read_output(&self, pipeline: &Pipeline) -> Result<(u32, u32, Vec<u8>), RenderError> {
        let name = pipeline
            .desc
            .output
            .as_ref()
            .map_or("output", |output| output.name.as_str());
        let texture = self.texture(pipeline, name)?;
        Ok((
            texture.width(),
            texture.height(),
            read_bytes(&self.gpu, texture)?,
        ))
    }

    /// The linear HDR picture of the last frame, if the pipeline names one.
    ///
    /// # Errors
    /// As [`Renderer::read_output`].
    pub fn read_hdr(&self, pipeline: &Pipeline) -> Result<Option<TargetImage>, RenderError> {
        match &pipeline.desc.hdr {
            Some(hdr) => self.read_target(pipeline, &hdr.name).map(Some),
            None => Ok(None),
        }
    }

    /// Any target of the last frame, its first layer.
    ///
    /// Targets may share a texture with another, and then hold what that one holds: see
    /// [`Pipeline::keep_all_targets`].
    ///
    /// # Errors
    /// As [`Renderer::read_output`].
    pub fn read_target(&self, pipeline: &Pipeline, name: &str) -> Result<TargetImage, RenderError> {
        self.read_target_slice(pipeline, name, Slice::default())
    }

    /// One mip level of one layer of a target of the last frame.
    ///
    /// # Errors
    /// As [`Renderer::read_output`], and where there is no such level or layer.
    pub fn read_target_slice(
        &self,
        pipeline: &Pipeline,
        name: &str,
        slice: Slice,
    ) -> Result<TargetImage, RenderError> {
        let texture = self.texture(pipeline, name)?;
        let layers = texture.depth_or_array_layers();
        if slice.mip >= texture.mip_level_count() || slice.layer >= layers {
            return Err(RenderError::NoSlice {
                target: name.to_owned(),
                mips: texture.mip_level_count(),
                layers,
            });
        }
        Ok(read_image(&self.gpu, texture, slice)?)
    }

    fn texture<'a>(
        &self,
        pipeline: &'a Pipeline,
        name: &str,
    ) -> Result<&'a wgpu::Texture, RenderError> {
        let target = pipeline.targets().and_then(|targets| targets.get(name));
        target
            .map(|target| &target.texture)
            .ok_or_else(|| RenderError::NoTarget(name.to_owned()))
    }
}
