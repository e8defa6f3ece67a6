//! What the editor does, without a widget in it: a scene, pipelines, a camera, time, and files
//! that change under them.
//!
//! Everything slow runs on threads: scenes load, pipelines compile and lists are read while the
//! last good picture goes on. [`Workbench::tick`] takes in what they finished and
//! [`Workbench::draw`] draws if something changed.

mod assets;
pub mod beside;
pub mod camera;
mod canvas;
pub mod clock;
pub mod comparing;
pub mod compiling;
mod drawing;
mod entering;
pub mod extent;
pub mod fields;
pub mod flat;
pub mod hand;
pub mod history;
pub mod library;
pub mod lighting;
mod lines;
pub mod log;
mod looking;
pub mod measuring;
pub mod notebook;
pub mod opening;
pub mod picking;
pub mod pipelines;
mod play;
pub mod probing;
mod project;
pub mod reporting;
pub mod resolution;
mod resuming;
mod returning;
mod running;
pub mod saving;
pub mod scenes;
pub mod second;
pub mod selection;
mod setting;
pub mod sight;
pub mod stepping;
pub mod structure;
pub mod timing;
pub mod trends;
pub mod typed;
pub mod undo;
mod viewing;
pub mod viewports;
pub mod views;
mod watching;

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use lightbench::assets::files::Files;
use lightbench::render::overlay::OVERLAY_SHADERS;
use lightbench::render::problem::Problems;
use lightbench::render::{FrameStatistics, Gpu, GpuOptions, Problem, Renderer, View, inspect};
use lightbench::script::overlays::Overlays;

use self::beside::Beside;
use self::camera::CameraRig;
use self::canvas::Canvas;
use self::clock::Clock;
use self::comparing::Comparing;
use self::history::History;
use self::library::Library;
use self::lighting::Lighting;
use self::log::Log;
use self::measuring::Measuring;
use self::notebook::Notebook;
use self::pipelines::{News, Pipelines};
use self::play::Before;
use self::probing::Probing;
use self::reporting::{Reporting, WorkerOptions};
use self::resolution::Resolution;
use self::resuming::Saved;
use self::scenes::Scenes;
use self::second::Second;
use self::selection::Selection;
use self::stepping::Stop;
use self::timing::Timings;
use self::trends::Trends;
use self::typed::{Coming, Typed};
use self::undo::Undo;
use self::viewing::Arriving;
use self::viewports::Viewport;
use self::views::Views;
use self::watching::{Touched, Watch};
use super::EditorOptions;
use crate::ui::messages::say;

/// Called from any thread when there is something for [`Workbench::tick`].
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// The model behind the editor.
pub struct Workbench {
    /// Whether the keys of this frame are the scene's.
    pub scene_has_keys: bool,
    files: Files,
    wake: Wake,
    renderer: Renderer,
    watch: Watch,
    /// What changed on the disk, for who shows files.
    touched: Option<Touched>,
    canvas: Canvas,
    last_tick: Option<Instant>,
    lost: Option<String>,
    gpu_options: GpuOptions,
    /// What lies over the scripts of the scenes, by their names.
    overlays: BTreeMap<String, Overlays>,
    /// What lay over them when they were saved.
    saved: Saved,
    /// Lines of the console that have changed the scene on screen, oldest first.
    typed: Vec<Typed>,
    /// Those that are in a file.
    saved_lines: Vec<Typed>,
    /// Lines that wait for their scenes.
    coming: Vec<Coming>,
    /// What stop gives back.
    before: Option<Arc<Before>>,
    /// Whether a mistake that is shown came up while time ran.
    ran_into_a_problem: bool,
    /// What to call the next moment in the history.
    noted_time: Option<&'static str>,
    /// The moved camera that the history knows.
    noted_view: Option<View>,
    /// The camera of the scene through which a person wants to look, by its name.
    watched_camera: Option<String>,
    /// The view to which the scene is on its way.
    arriving: Option<Arriving>,
    /// How processes that measure are started.
    worker: WorkerOptions,
    /// Where in the frame the picture stops.
    stop: Option<Stop>,
    /// The lines over the pictures, by series.
    lines: [Option<lightbench::render::overlay::Lines>; 2],
    focus: Viewport,
    /// Which viewport has drawn last.
    last_drawn: Viewport,
    /// Whether the first viewport can be seen.
    first_is_seen: bool,
    /// The second viewport.
    pub second: Second,
    /// How the values of the target that is looked at spread.
    pub measuring: Measuring,
    /// The light at the probed pixel.
    pub lighting: Lighting,
    /// The probed pixel under another pipeline.
    pub beside: Beside,
    /// What frames cost over time.
    pub trends: Trends,
    /// The entities that are chosen.
    pub selection: Selection,
    /// Visited pipelines.
    pub pipelines: Pipelines,
    /// The scene.
    pub scenes: Scenes,
    /// What can be chosen.
    pub library: Library,
    /// Where the first viewport's picture is seen from.
    pub camera: CameraRig,
    /// The scene's time.
    pub clock: Clock,
    /// What happened.
    pub log: Log,
    /// What frames cost.
    pub timings: Timings,
    /// How many pixels are drawn.
    pub resolution: Resolution,
    /// What the passes did to a pixel.
    pub probing: Probing,
    /// What was done, as lines of scripts.
    pub history: History,
    /// What can be taken back.
    pub undo: Undo,
    /// What was looked at.
    pub views: Views,
    /// A second pipeline beside the first.
    pub comparing: Comparing,
    /// The report that is being made.
    pub reporting: Reporting,
    /// Measurements that were kept.
    pub notebook: Notebook,
}

impl Workbench {
    /// Opens the first scene and pipeline on a device.
    pub fn new(gpu: Gpu, options: EditorOptions, wake: Wake) -> Self {
        let EditorOptions { files, .. } = options;
        let mut log = Log::default();
        let summary = &gpu.summary;
        log.info(format!("{} ({})", summary.name, summary.driver_info));
        if summary.software {
            log.warn(say!("workbench.the_processor_draws_times_are_not"));
        }
        for missing in &summary.missing {
            log.warn(say!("workbench.the_adapter_lacks", missing = missing));
        }
        let resolution = Resolution::new(summary.software);
        let renderer = Renderer::new(gpu);
        let pipelines = Pipelines::new(renderer.compiler(), files.clone(), wake.clone());
        let watch = Watch::start(&files, &wake, &mut log);
        let mut this = Self {
            scene_has_keys: false,
            scenes: Scenes::new(files.clone(), wake.clone()),
            pipelines,
            watch,
            touched: None,
            renderer,
            resolution,
            log,
            wake,
            files,
            canvas: Canvas::default(),
            last_tick: None,
            lost: None,
            gpu_options: options.gpu,
            library: Library::default(),
            camera: CameraRig::default(),
            clock: Clock::default(),
            timings: Timings::default(),
            probing: Probing::default(),
            history: History::default(),
            undo: Undo::default(),
            views: Views::default(),
            comparing: Comparing::default(),
            reporting: Reporting::default(),
            notebook: Notebook::default(),
            arriving: None,
            worker: options.worker,
            overlays: BTreeMap::new(),
            saved: Saved::new(),
            typed: Vec::new(),
            saved_lines: Vec::new(),
            coming: Vec::new(),
            before: None,
            ran_into_a_problem: false,
            noted_time: None,
            noted_view: None,
            watched_camera: None,
            stop: None,
            lines: [None, None],
            focus: Viewport::First,
            last_drawn: Viewport::First,
            first_is_seen: true,
            second: Second::default(),
            measuring: Measuring::default(),
            lighting: Lighting::default(),
            beside: Beside::default(),
            trends: Trends::default(),
            selection: Selection::default(),
        };
        this.library.refresh(&this.files, &this.wake);
        this.scenes
            .select(&options.scene, Some(options.scene_settings));
        this.scenes.poll();
        this.pipelines
            .select_with(&options.pipeline, options.pipeline_settings);
        this
    }

    /// Goes on with another device after one was lost. Scene, camera, time and settings stay.
    pub fn move_to(&mut self, gpu: Gpu) {
        self.log.warn(say!(
            "workbench.drawing_goes_on_with",
            name = gpu.summary.name
        ));
        self.resolution = Resolution::new(gpu.summary.software);
        let request = self.renderer.inspector().request().cloned();
        self.renderer = Renderer::new(gpu);
        self.pipelines.move_to(
            self.renderer.compiler(),
            self.files.clone(),
            self.wake.clone(),
        );
        self.move_other();
        self.canvas = Canvas::default();
        self.second.forget_pictures();
        self.probing = Probing::default();
        self.measuring = Measuring::default();
        self.beside = Beside::default();
        // Asked for again with the next frame.
        self.lines = [None, None];
        self.timings.reset();
        self.lost = None;
        self.inspect(request);
    }

    /// The device, for those who draw beside the workbench.
    pub fn gpu(&self) -> &Gpu {
        self.renderer.gpu()
    }

    /// How the device was chosen.
    pub fn gpu_options(&self) -> &GpuOptions {
        &self.gpu_options
    }

    /// The file store.
    pub fn files(&self) -> &Files {
        &self.files
    }

    /// Why the device is lost, if it is: then [`Workbench::move_to`] mends it.
    pub fn lost(&self) -> Option<&str> {
        self.lost.as_deref()
    }

    /// Swaps the pipeline; scene, camera and time stay.
    pub fn select_pipeline(&mut self, name: &str) {
        let what = say!("history.pipeline", name = name);
        self.as_place("pipeline", &what, false, |this| {
            let before = this.pipelines.shown().map(str::to_owned);
            this.pipelines.select(name);
            this.pipeline_shown(before.as_deref());
            this.did("pipeline", say!("workbench.the_pipeline", name = name));
        });
    }

    /// Loads another scene; until it is ready the present one stays.
    pub fn select_scene(&mut self, name: &str) {
        let what = say!("history.scene", name = name);
        self.as_place("scene", &what, true, |this| {
            this.arriving = None;
            this.scenes.select(name, None);
            this.scenes.poll();
            this.did("scene", say!("workbench.the_scene", name = name));
        });
    }

    /// All mistakes that keep the newest state off the screen.
    pub fn problems(&self) -> impl Iterator<Item = &Problem> {
        let sources = [self.scenes.problems(), self.pipelines.problems()];
        let canvases = Viewport::ALL.map(|viewport| self.canvas_of(viewport));
        let drawing = canvases
            .into_iter()
            .filter_map(|canvas| canvas.problem.as_ref());
        sources
            .into_iter()
            .flatten()
            .flat_map(|problems| problems.0.iter())
            .chain(drawing)
            .chain(self.comparing.problems())
    }

    /// The cost of the last frame.
    pub fn statistics(&self) -> &FrameStatistics {
        &self.canvas.statistics
    }

    /// Reads and builds everything again.
    pub fn reload(&mut self) {
        self.touched.get_or_insert_default().everything = true;
        let all = self.files.list("shaders", "wgsl").unwrap_or_default();
        let mut paths: Vec<String> = all.into_iter().map(|entry| entry.path).collect();
        paths.push(format!("{}/", lightbench::script::PIPELINES));
        self.pipelines.changed(&paths);
        self.other_files_changed(&paths);
        self.scenes.reload();
        self.library.refresh(&self.files, &self.wake);
    }

    /// Takes in what threads, files and the device have finished, and lets time pass.
    pub fn tick(&mut self, now: Instant) {
        let elapsed = self.last_tick.map_or(Duration::ZERO, |last| now - last);
        self.last_tick = Some(now);

        if let Some(changes) = self.watch.poll() {
            if changes.everything {
                self.reload();
            } else {
                let paths: Vec<String> = changes.paths.into_iter().collect();
                self.files_changed(&paths);
            }
        }
        self.take_pipelines();
        self.take_other_pipelines();
        self.take_scene();
        // A moment that one pipeline has drawn and the other has not must not go by.
        let waits = self.comparing.is_waiting();
        if !waits {
            self.arrive();
        }
        for error in self.library.poll(&self.files, &self.wake) {
            self.log.error(error);
        }
        let clock = self.clock;
        if !waits && let Some(step) = self.clock.advance(elapsed) {
            if step > 0.0 {
                self.begin_play(clock);
            }
            self.update_scene(step);
            while let Some(step) = self.clock.next_step() {
                self.update_scene(step);
            }
        }
        if let Some(what) = self.noted_time.take() {
            self.did("time", what);
        }
        self.follow_camera();
        self.note_camera();
        self.travel();
        if let Some(scene) = self.scenes.scene() {
            self.selection.refresh(scene, self.scenes.swaps());
        }
        self.take_measurements();
        self.judge(now);
        self.take_report();
        self.take_notes();
    }

    /// Tells that project files changed: only what depends on them is built again.
    pub fn files_changed(&mut self, paths: &[String]) {
        let touched = self.touched.get_or_insert_default();
        touched.paths.extend(paths.iter().cloned());
        self.pipelines.changed(paths);
        self.other_files_changed(paths);
        self.scenes.changed(paths);
        if paths.iter().any(|path| path.starts_with("scripts/")) {
            self.library.refresh(&self.files, &self.wake);
        }
        let looks = |path: &String| {
            let folders = [inspect::INSPECT_SHADERS, OVERLAY_SHADERS, "shaders/lib/"];
            folders.iter().any(|folder| path.starts_with(folder))
        };
        if paths.iter().any(looks) {
            self.renderer.overlay().forget_shaders();
            // What could not be drawn is asked for again.
            self.lines = [None, None];
            self.renderer.inspector().forget_shaders();
            self.comparing.forget_shaders();
            self.canvas.invalidate();
        }
    }

    fn pipeline_shown(&mut self, before: Option<&str>) {
        if self.pipelines.shown() != before {
            self.timings.reset();
            self.canvas.invalidate();
        }
    }

    fn take_pipelines(&mut self) {
        let before = self.pipelines.shown().map(str::to_owned);
        for news in self.pipelines.poll() {
            match news {
                News::Compiled(name, took) => {
                    let title = self.library.pipeline_title(&name).to_owned();
                    let ms = took.as_secs_f64() * 1e3;
                    self.log.info(say!(
                        "workbench.built_in_ms",
                        title = title,
                        ms = format_args!("{ms:.0}")
                    ));
                }
                News::Values(_) => self.canvas.invalidate(),
                News::Failed(_, problems) => self.log_problems(&problems),
                News::LeftOut(name, settings) => self.log.warn(say!(
                    "workbench.no_longer_set_because_the_file",
                    name = name,
                    parameters = settings.join(", ")
                )),
            }
        }
        self.pipeline_shown(before.as_deref());
    }

    fn log_problems(&mut self, problems: &Problems) {
        for problem in &problems.0 {
            self.log.problem(problem);
        }
    }
}
