//! A picture of a scene through a pipeline, without a window.

use lightbench_assets::{Cancelled, Progress};
use lightbench_render::{
    FrameStatistics, Pipeline, Problem, RenderError, Renderer, TargetImage, View,
};
use lightbench_script::Scene;

use crate::{HdrImage, LdrImage};

/// Seconds between two frames. Scenes move by this fixed step, however long drawing takes, so that
/// the same frame is always the same moment.
pub const STEP: f64 = 1.0 / 60.0;

/// What to take a picture of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CaptureOptions {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Which frame, counted from 0; frame `n` shows the scene after `n` steps of [`STEP`].
    pub frame: u32,
}

/// A picture and what it cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Capture {
    /// As a display shows it.
    pub output: LdrImage,
    /// In linear light before exposure and tone curve, where the pipeline names such a target.
    /// Alpha is 1: a picture hides what is behind it.
    pub hdr: Option<HdrImage>,
    /// The cost of the frame. Times on the GPU are not waited for.
    pub statistics: FrameStatistics,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum CaptureError {
    /// The frame could not be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The scene's script failed while the scene moved.
    #[error("{0}")]
    Script(Problem),
    /// It was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Takes one picture of a scene that has not moved yet.
///
/// The frames before it are stepped but not drawn, because a pipeline keeps nothing from one frame
/// to the next. The same scene, pipeline and options give the same picture, bit for bit, on the
/// same driver.
///
/// # Errors
/// When the size or the scene is beyond the device, the device or the scene's script failed, or
/// `progress` was cancelled.
pub fn capture(
    renderer: &mut Renderer,
    scene: &mut Scene,
    pipeline: &mut Pipeline,
    options: CaptureOptions,
    progress: &Progress,
) -> Result<Capture, CaptureError> {
    for frame in 1..=options.frame {
        progress.report(frame as f32 / (options.frame + 1) as f32)?;
        let time = f64::from(frame) * STEP;
        scene.update(time, STEP).map_err(CaptureError::Script)?;
    }
    renderer.set_frame_index(options.frame);
    let time = f64::from(options.frame) * STEP;
    let view = view_of(scene);
    let picture = capture_through(renderer, scene, pipeline, &view, options.size, time)?;
    progress.report(1.0)?;
    Ok(picture)
}

/// Takes one picture of a scene as it stands, through a camera that need not be its own. `time` is in
/// seconds since the scene began, for shaders.
///
/// # Errors
/// When the size or the scene is beyond the device, or the device failed.
pub fn capture_through(
    renderer: &mut Renderer,
    scene: &mut Scene,
    pipeline: &mut Pipeline,
    view: &View,
    size: (u32, u32),
    time: f64,
) -> Result<Capture, RenderError> {
    let (world, assets) = (&mut scene.world, &scene.assets);
    let statistics = renderer
        .render_whole(world, assets, pipeline, view, size, time)?
        .clone();
    Ok(Capture {
        output: read_output(renderer, pipeline)?,
        hdr: read_hdr(renderer, pipeline)?,
        statistics,
    })
}

/// Draws the scene as it stands, through its own camera.
pub(crate) fn draw<'a>(
    renderer: &'a mut Renderer,
    scene: &mut Scene,
    pipeline: &mut Pipeline,
    size: (u32, u32),
    time: f64,
) -> Result<&'a FrameStatistics, RenderError> {
    let view = view_of(scene);
    renderer.render(&mut scene.world, &scene.assets, pipeline, &view, size, time)
}

pub(crate) fn view_of(scene: &mut Scene) -> View {
    scene.refresh();
    View::from_world(&scene.world).unwrap_or_default()
}

/// The picture of the last frame as a display shows it.
pub(crate) fn read_output(
    renderer: &Renderer,
    pipeline: &Pipeline,
) -> Result<LdrImage, RenderError> {
    let (width, height, bytes) = renderer.read_output(pipeline)?;
    let pixels = bytes.as_chunks::<4>().0.to_vec();
    Ok(LdrImage {
        width,
        height,
        pixels,
    })
}

/// The picture of the last frame in linear light.
pub(crate) fn read_hdr(
    renderer: &Renderer,
    pipeline: &Pipeline,
) -> Result<Option<HdrImage>, RenderError> {
    Ok(renderer.read_hdr(pipeline)?.map(opaque))
}

fn opaque(image: TargetImage) -> HdrImage {
    let mut pixels = image.texels;
    for pixel in &mut pixels {
        pixel[3] = 1.0;
    }
    HdrImage {
        width: image.width,
        height: image.height,
        pixels,
    }
}
