//! What is on the screen as a line of text, and back.

use std::path::Path;
use std::time::{Duration, Instant};

use lightbench::script::Settings;

use super::Workbench;
use super::pipelines::Pipelines;
use super::viewports::Viewport;
use crate::ui::messages::say;
use crate::viewpoint::moment::Steps;
use crate::viewpoint::{Eye, Viewpoint};

/// How long steps of a scene may hold up one frame of the window.
const SLICE: Duration = Duration::from_millis(12);

/// The way to a view that was asked for.
pub(super) struct Arriving {
    pub(super) camera: Eye,
    /// The viewport that it is for.
    pub(super) viewport: Viewport,
    pub(super) steps: Steps,
    /// Whether its scene is on screen.
    pub(super) is_there: bool,
    /// Whether time runs on from there.
    pub(super) then_plays: bool,
}

impl Workbench {
    /// What is on the screen; `None` before the first picture. Of two pipelines it has A, of two
    /// viewports the first.
    pub fn viewpoint(&self) -> Option<Viewpoint> {
        self.viewpoint_in(Viewport::First)
    }

    /// The same of a viewport.
    pub fn viewpoint_in(&self, viewport: Viewport) -> Option<Viewpoint> {
        self.viewpoint_of(&self.pipelines, viewport)
    }

    /// The same with B, while two pipelines are compared.
    pub fn other_viewpoint(&self) -> Option<Viewpoint> {
        let side = self.comparing.side().filter(|_| self.comparing.is_on())?;
        self.viewpoint_of(&side.pipelines, Viewport::First)
    }

    fn viewpoint_of(&self, pipelines: &Pipelines, viewport: Viewport) -> Option<Viewpoint> {
        let size = self.canvas_of(viewport).drawn?.size;
        self.viewpoint_with(pipelines, pipelines.shown()?, viewport, size)
    }

    /// What there is to see, also where no picture of it can be drawn.
    pub(super) fn view_to_keep(&self) -> Option<Viewpoint> {
        let viewport = Viewport::First;
        let size = self.canvas.drawn.map_or((640, 360), |drawn| drawn.size);
        self.viewpoint_with(&self.pipelines, self.pipelines.selected(), viewport, size)
    }

    fn viewpoint_with(
        &self,
        pipelines: &Pipelines,
        pipeline: &str,
        viewport: Viewport,
        size: (u32, u32),
    ) -> Option<Viewpoint> {
        let settings = pipelines.slot(pipeline).map(|slot| slot.settings.clone());
        let scene = self.scenes.shown()?;
        let scene_settings = self
            .scenes
            .settings()
            .filter(|_| scene == self.scenes.selected());
        Some(Viewpoint {
            scene: self.files.display(scene),
            scene_settings: self.outside_by_path(scene_settings.cloned().unwrap_or_default()),
            pipeline: pipeline.to_owned(),
            pipeline_settings: settings.unwrap_or_default(),
            camera: self.eye(viewport),
            time: self.clock.time(),
            size,
        })
    }

    /// Settings in which files outside of the project stand with their path on the disk.
    fn outside_by_path(&self, settings: Settings) -> Settings {
        let mut shown = Settings::new();
        for (name, value) in settings.iter() {
            let text = value.to_string();
            if text.starts_with('@') {
                shown.set(name, self.files.display(&text));
            } else {
                shown.set(name, value.clone());
            }
        }
        shown
    }

    /// From where the scene is seen in a viewport.
    pub(super) fn eye(&self, viewport: Viewport) -> Eye {
        let camera = self.camera_of(viewport);
        if let Some(flat) = camera.flat() {
            return Eye::Side(*flat);
        }
        if camera.is_moved() {
            return Eye::Free(camera.free());
        }
        let watched = self.watched_camera_of(viewport).clone();
        watched.map_or(Eye::Scene, Eye::Named)
    }

    /// What a view in words leaves out of what is on the screen, in a sentence.
    pub fn left_out_of_view(&self) -> Option<String> {
        let changed = self.overlays_now().map_or(0, |all| all.iter().count());
        (changed > 0).then(|| say!("viewing.the_view_has_the_scene_as", changed = changed))
    }

    /// Goes to a view: loads its scene anew, swaps to its pipeline and moves time there, and the camera
    /// of the viewport that has the focus.
    ///
    /// # Errors
    /// A sentence, where the view names a file outside of the project that nobody has opened.
    pub fn go_to(&mut self, view: &Viewpoint) -> Result<(), String> {
        let what = say!("history.view", scene = view.scene);
        self.as_place("view", &what, true, |this| this.go_to_now(view))
    }

    fn go_to_now(&mut self, view: &Viewpoint) -> Result<(), String> {
        let scene = self.known(&view.scene)?;
        let pipeline = self.known(&view.pipeline)?;
        let mut settings = Settings::new();
        for (name, value) in view.scene_settings.iter() {
            let text = value.to_string();
            if Path::new(&text).is_absolute() {
                settings.set(name, self.known(&text)?);
            } else {
                settings.set(name, value.clone());
            }
        }
        let before = self.pipelines.shown().map(str::to_owned);
        self.pipelines
            .select_with(&pipeline, view.pipeline_settings.clone());
        self.pipeline_shown(before.as_deref());
        self.clock.playing = false;
        self.arriving = Some(Arriving {
            camera: view.camera.clone(),
            viewport: self.focus(),
            steps: Steps::to(view.time),
            is_there: false,
            then_plays: false,
        });
        self.scenes.select(&scene, Some(settings));
        self.scenes.poll();
        self.did("scene", say!("viewing.the_scene", scene = scene));
        Ok(())
    }

    /// A scene, pipeline or model as the loaders take it.
    fn known(&mut self, name: &str) -> Result<String, String> {
        let path = Path::new(name);
        if !path.is_absolute() {
            return Ok(name.to_owned());
        }
        // A line of text from anywhere must not open folders to scripts.
        let folder = path.parent().and_then(|folder| folder.canonicalize().ok());
        let is_open = folder.is_some_and(|folder| {
            let project = self.files.project();
            self.files.grants().contains(&folder)
                || project.is_some_and(|it| folder.starts_with(it))
        });
        if !is_open {
            return Err(say!("viewing.the_view_names_which_is_outside", name = name));
        }
        self.files.grant(path).map_err(|error| error.to_string())
    }

    /// Whether a view was asked for that is not on the screen yet.
    pub fn is_arriving(&self) -> bool {
        self.arriving.is_some()
    }

    /// The scene of a view is on screen: it begins, seen from where the view is.
    pub(super) fn begin_arrival(&mut self) {
        let Some(arriving) = &mut self.arriving else {
            return;
        };
        arriving.is_there = true;
        let (camera, viewport) = (arriving.camera.clone(), arriving.viewport);
        self.clock.playing = false;
        if let Eye::Named(name) = &camera
            && !self.cameras().contains(name)
        {
            self.log
                .error(say!("viewing.the_view_is_through_the_camera", name = name));
        }
        self.look_with(viewport, camera);
    }

    /// Goes some steps on towards the moment of a view.
    pub(super) fn arrive(&mut self) {
        if !self.arriving.as_ref().is_some_and(|way| way.is_there) {
            return;
        }
        let began = Instant::now();
        while began.elapsed() < SLICE {
            let next = self.arriving.as_mut().and_then(|way| way.steps.next());
            let Some((time, step)) = next else {
                self.run_again(None);
                self.clock.playing = self.arriving.take().is_some_and(|way| way.then_plays);
                self.absorb_view();
                if let Some(left_out) = self.left_out_of_view() {
                    self.log.warn(left_out);
                }
                return;
            };
            if step > 0.0 {
                self.begin_play(self.clock);
            }
            self.clock.set(time);
            self.update_scene(step);
            self.run_again(Some(time));
            if self.ran_into_a_problem {
                self.run_again(None);
                // It is shown; there is no way on.
                self.arriving = None;
                return;
            }
        }
    }
}
