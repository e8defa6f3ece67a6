//! The laboratory of experiments: what [`FrameInspector`] can do, for scripts.

mod measuring;
mod studying;

use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbench_assets::Progress;
use lightbench_assets::cache::Cache;
use lightbench_assets::files::Files;
use lightbench_render::inspect::{FirstInvalid, Part, PixelValue, Shown};
use lightbench_render::{
    Compiler, Gpu, GpuOptions, Pipeline, PipelineDesc, Problems, RenderError, Renderer, TargetImage,
};
use lightbench_script::{
    Chart, Cost, Laboratory, LaboratoryError, Limits, LogLine, Scene, Settings, Shot, StudyRow,
    StudyTask, Task, load_pipeline, load_scene_within,
};

use crate::capture::STEP;
use crate::inspect::FrameInspector;
use crate::shown::encode;
use crate::study::Launch;

/// Scenes that are kept for the next frame.
const MOST_SCENES: usize = 4;
/// Pipelines that are kept for the next frame.
const MOST_PIPELINES: usize = 16;

/// What a laboratory has to tell besides its results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Remark {
    /// A scene's script printed it, or it is a warning of a model.
    Scene(LogLine),
    /// What had to be changed for a scene to fit the device.
    Warning(String),
}

/// Draws frames for an experiment. The device opens with the first; scenes and pipelines are kept,
/// so that frames with the same arguments load and compile nothing.
pub struct Workbench {
    files: Files,
    gpu: GpuOptions,
    progress: Progress,
    tell: Box<dyn Fn(Remark) + Send>,
    /// Opened with the first frame; shared by the workbenches that stand beside each other.
    device: Arc<Mutex<Option<Renderer>>>,
    /// Of the own files: a compiler knows shaders by their paths.
    compiler: Option<Compiler>,
    /// The one that was used last stands last.
    scenes: Vec<Staged>,
    /// The one that was used last stands last.
    pipelines: Vec<Compiled>,
    cache: Cache,
    warned: Vec<String>,
    /// How a process of a study is started that measures into a folder.
    launch: Option<LaunchFor>,
}

/// Says how a process is started that measures into a folder.
type LaunchFor = Box<dyn Fn(&Path) -> Launch + Send>;

/// A scene at a moment.
struct Staged {
    name: String,
    settings: Settings,
    frame: u32,
    scene: Scene,
}

struct Compiled {
    name: String,
    settings: Settings,
    pipeline: Pipeline,
}

impl Workbench {
    /// A workbench over these files, on an adapter that is opened when it is needed. `tell` is given
    /// each remark; cancelling `progress` stops what is being loaded.
    pub fn new(
        files: &Files,
        gpu: GpuOptions,
        progress: &Progress,
        tell: impl Fn(Remark) + Send + 'static,
    ) -> Self {
        Self {
            files: files.clone(),
            gpu,
            progress: progress.clone(),
            tell: Box::new(tell),
            device: Arc::default(),
            compiler: None,
            scenes: Vec::new(),
            pipelines: Vec::new(),
            cache: Cache::default(),
            warned: Vec::new(),
            launch: None,
        }
    }

    /// The same workbench, which can measure studies too: `launch` says how a process is started that
    /// measures into a folder.
    #[must_use]
    pub fn with_studies(mut self, launch: impl Fn(&Path) -> Launch + Send + 'static) -> Self {
        self.launch = Some(Box::new(launch));
        self
    }

    /// Another workbench over other files, which draws on the same device.
    #[must_use]
    pub fn beside(&self, files: &Files, tell: impl Fn(Remark) + Send + 'static) -> Self {
        Self {
            device: Arc::clone(&self.device),
            ..Self::new(files, self.gpu.clone(), &self.progress, tell)
        }
    }

    /// Opens the device, if it is not open yet.
    ///
    /// # Errors
    /// No adapter that can draw.
    pub fn open_device(&mut self) -> Result<(), LaboratoryError> {
        self.open()
    }

    /// Looks into a frame as if it were the first that is ever drawn.
    fn look<T>(
        &mut self,
        shot: &Shot,
        look: impl FnOnce(&mut FrameInspector<'_>) -> Result<T, RenderError>,
    ) -> Result<T, LaboratoryError> {
        self.open()?;
        self.bring_scene(shot)?;
        self.bring_pipeline(shot)?;
        let device = Arc::clone(&self.device);
        let mut device = lock(&device);
        let (Some(renderer), Some(staged), Some(compiled)) = (
            device.as_mut(),
            self.scenes.last_mut(),
            self.pipelines.last_mut(),
        ) else {
            return Err(LaboratoryError::Other(
                "there is nothing to draw".to_owned(),
            ));
        };
        // Nothing of another frame may show in this one. A new inspector gives the pipeline new
        // targets and buffers, so history begins afresh too.
        renderer.reset_scene();
        let mut inspector = FrameInspector::new(
            renderer,
            &self.files,
            &mut staged.scene,
            &mut compiled.pipeline,
            shot.size,
            shot.frame,
        );
        let found = look(&mut inspector);
        drop(inspector);
        let warnings = renderer.take_warnings();
        self.tell_warnings(warnings);
        Ok(found?)
    }

    /// Opens the device, the first time.
    fn open(&mut self) -> Result<(), LaboratoryError> {
        let mut device = lock(&self.device);
        let renderer = match device.take() {
            Some(renderer) => renderer,
            None => Renderer::new(Gpu::open(&self.gpu).map_err(RenderError::from)?),
        };
        let renderer = device.insert(renderer);
        if self.compiler.is_none() {
            self.compiler = Some(renderer.compiler());
        }
        Ok(())
    }

    fn tell_warnings(&mut self, warnings: Vec<String>) {
        for warning in warnings {
            // Each look begins anew, and would warn anew.
            if !self.warned.contains(&warning) {
                self.warned.push(warning.clone());
                (self.tell)(Remark::Warning(warning));
            }
        }
    }

    /// Brings the shot's scene to its moment, and puts it last.
    fn bring_scene(&mut self, shot: &Shot) -> Result<(), LaboratoryError> {
        let known = self
            .scenes
            .iter()
            .position(|staged| staged.name == shot.scene && staged.settings == shot.scene_settings);
        let known = known.map(|index| self.scenes.remove(index));
        // Scenes step forward alone.
        let mut staged = match known.filter(|staged| staged.frame <= shot.frame) {
            Some(staged) => staged,
            None => self.load_scene(shot)?,
        };
        while staged.frame < shot.frame {
            if self.progress.is_cancelled() {
                return Err(LaboratoryError::Other("stopped".to_owned()));
            }
            staged.frame += 1;
            let time = f64::from(staged.frame) * STEP;
            let stepped = staged.scene.update(time, STEP);
            stepped.map_err(Problems::from)?;
        }
        staged.scene.refresh();
        for line in staged.scene.take_log() {
            (self.tell)(Remark::Scene(line));
        }
        self.scenes.push(staged);
        if self.scenes.len() > MOST_SCENES {
            self.scenes.remove(0);
        }
        Ok(())
    }

    fn load_scene(&self, shot: &Shot) -> Result<Staged, LaboratoryError> {
        let limits = Limits::default().in_project(&self.files);
        let limits = limits.map_err(Problems::from)?;
        let scene = load_scene_within(
            &self.files,
            &shot.scene,
            &shot.scene_settings,
            &self.progress,
            &self.cache,
            &limits,
        )?;
        Ok(Staged {
            name: shot.scene.clone(),
            settings: shot.scene_settings.clone(),
            frame: 0,
            scene,
        })
    }

    /// Builds the shot's pipeline where it is not known yet, and puts it last.
    fn bring_pipeline(&mut self, shot: &Shot) -> Result<(), LaboratoryError> {
        let settings = &shot.pipeline_settings;
        let known = self
            .pipelines
            .iter()
            .position(|compiled| compiled.name == shot.pipeline && compiled.settings == *settings);
        let compiled = match known {
            Some(index) => self.pipelines.remove(index),
            None => self.build_pipeline(shot)?,
        };
        self.pipelines.push(compiled);
        if self.pipelines.len() > MOST_PIPELINES {
            self.pipelines.remove(0);
        }
        Ok(())
    }

    fn build_pipeline(&mut self, shot: &Shot) -> Result<Compiled, LaboratoryError> {
        let desc = load_pipeline(&self.files, &shot.pipeline, &shot.pipeline_settings)?;
        // Where only values of parameters differ, one that was built takes them over.
        let adopting = self.pipelines.iter_mut().position(|compiled| {
            compiled.name == shot.pipeline && compiled.pipeline.adopt_values(&desc)
        });
        if let Some(index) = adopting {
            let mut compiled = self.pipelines.remove(index);
            compiled.settings = shot.pipeline_settings.clone();
            return Ok(compiled);
        }
        let Some(compiler) = &mut self.compiler else {
            return Err(LaboratoryError::Other("no device is open".to_owned()));
        };
        Ok(Compiled {
            name: shot.pipeline.clone(),
            settings: shot.pipeline_settings.clone(),
            pipeline: compiler.compile(&self.files, &desc)?,
        })
    }
}

/// A workbench that failed in the middle of a frame left nothing behind that the next one uses.
fn lock(device: &Mutex<Option<Renderer>>) -> MutexGuard<'_, Option<Renderer>> {
    device.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Laboratory for Workbench {
    fn draw(&mut self, shot: &Shot) -> Result<PipelineDesc, LaboratoryError> {
        self.look(shot, |inspector| inspector.whole())?;
        let drawn = self.pipelines.last();
        Ok(drawn
            .map(|drawn| drawn.pipeline.desc.clone())
            .unwrap_or_default())
    }

    fn target(
        &mut self,
        shot: &Shot,
        pass: usize,
        target: &str,
        part: Part,
    ) -> Result<TargetImage, LaboratoryError> {
        self.look(shot, |inspector| inspector.target(pass, target, part))
    }

    fn pixel(
        &mut self,
        shot: &Shot,
        pixel: (u32, u32),
    ) -> Result<Vec<PixelValue>, LaboratoryError> {
        self.look(shot, |inspector| inspector.history(pixel))
    }

    fn first_invalid(&mut self, shot: &Shot) -> Result<Option<FirstInvalid>, LaboratoryError> {
        self.look(shot, |inspector| inspector.first_invalid())
    }

    fn measure(&mut self, task: &Task) -> Result<Vec<Cost>, LaboratoryError> {
        self.measure_task(task)
    }

    fn study(&mut self, task: &StudyTask) -> Result<Vec<StudyRow>, LaboratoryError> {
        self.study_task(task)
    }

    fn compare(
        &self,
        reference: &TargetImage,
        image: &TargetImage,
    ) -> Result<Vec<(&'static str, f64)>, LaboratoryError> {
        measuring::compare(reference, image)
    }

    fn plot(&self, chart: &Chart) -> Vec<u8> {
        crate::curves::chart(chart).into_bytes()
    }

    fn values(&mut self, shot: &Shot, name: &str) -> Result<Vec<f64>, LaboratoryError> {
        self.bring_scene(shot)?;
        let plots = self.scenes.last().map(|staged| staged.scene.plots());
        let plots = plots.unwrap_or_default();
        let plot = plots.into_iter().find(|plot| plot.name == name);
        Ok(plot
            .into_iter()
            .flat_map(|plot| plot.values)
            .map(|(_, value)| value)
            .collect())
    }

    fn encode(
        &self,
        path: &str,
        image: &TargetImage,
        shown: Shown,
    ) -> Result<Vec<u8>, LaboratoryError> {
        encode(path, image, shown).map_err(|error| LaboratoryError::Other(error.to_string()))
    }
}
