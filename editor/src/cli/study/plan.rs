//! From the arguments of `lightbench compare` to the plan of a study.

use std::path::Path;

use clap::Args;
use lightbench::assets::files::Files;
use lightbench::lab::capture::STEP;
use lightbench::lab::report::Parameter;
use lightbench::lab::study::{Axis, CAMERA, Choice, Plan, SIZE, START, TRACED};
use lightbench::render::PipelineDesc;
use lightbench::render::problem::suggestion;
use lightbench::script::{Settings, list_pipelines};

use super::scene_name;
use crate::cli::arguments::{GpuArguments, SceneArguments, Size};
use crate::cli::load::{self, Request, Scripts};
use crate::cli::report::{self, Usage};
use crate::viewpoint::Viewpoint;
use crate::viewpoint::plan::{Effort, ViewsError, plan as plan_of_views};

/// What is swept where no scene is named.
const DEFAULT_SWEEP: &str = "lights=4,16,64,256";
/// The scene where none is named.
const DEFAULT_SCENE: &str = "atrium";

/// What to measure, and how.
#[derive(Args, Debug)]
pub struct PlanArguments {
    /// Scenes: names, as in `lightbench list scenes`, or paths of .rhai and .scene files. Without any,
    /// the atrium with 4, 16, 64 and 256 lights
    #[arg(value_name = "SCENE")]
    scenes: Vec<String>,
    /// The pipelines, separated by commas; without it, all that there are
    #[arg(long, value_name = "A,B,…", value_delimiter = ',')]
    pipelines: Vec<String>,
    /// Something to vary, with its values, as in `--sweep lights=4,16,64`; may be given again, for all
    /// combinations. A parameter of the scene or of pipelines, named as for `--set`; or `size`, `start`
    /// or `camera`
    #[arg(long, value_name = "NAME=A,B,…")]
    sweep: Vec<String>,
    /// A view that the editor has copied; given again, the same with another pipeline or other values.
    /// Measures the pipelines of the views on what they show, in place of SCENE, --pipelines and --set
    #[arg(long, value_name = "VIEW", conflicts_with_all = ["scenes", "pipelines", "set", "model", "size",
        "start", "step", "samples"])]
    view: Vec<Viewpoint>,
    /// The pipeline whose picture the others are compared with, or `traced` for the path tracer; the
    /// first pipeline without it
    #[arg(long, value_name = "PIPELINE")]
    reference: Option<String>,
    /// Samples a pixel of a traced reference. 0 traces what pipelines draw: direct light without
    /// shadows; more follow light along all paths
    #[arg(long, value_name = "N", default_value_t = 0)]
    samples: u32,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "640x360")]
    size: Size,
    /// How many frames to measure of each pipeline in each process
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..))]
    frames: u32,
    /// How many frames to draw before, which are not measured; more are drawn until times settle
    #[arg(long, value_name = "N", default_value_t = 1)]
    warmup: u32,
    /// The frame at which the scene is drawn first; the scene takes 60 a second
    #[arg(long, value_name = "N", default_value_t = 0)]
    start: u32,
    /// Seconds by which the scene moves between two measured frames: along a path of its camera, how
    /// far [default: a sixtieth]
    #[arg(long, value_name = "SECONDS")]
    step: Option<f64>,
    /// How many fresh processes measure, one after another; five are the least for a ranking
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    processes: u32,
    /// Seconds for a pipeline at a point, over all processes; what is cut short is marked, and what too
    /// few processes had time for is not ranked
    #[arg(long, value_name = "SECONDS", default_value_t = 5.0)]
    seconds: f64,
    /// Heading of the report
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,
    #[command(flatten)]
    scene_arguments: SceneArguments,
    #[command(flatten)]
    pub gpu: GpuArguments,
}

impl PlanArguments {
    /// The plan. Every script is read, so that a mistake shows before anything is measured.
    ///
    /// # Errors
    /// Scripts that are not there or have mistakes, values that nobody takes, sweeps over nothing.
    pub fn plan(&self, files: &mut Files) -> anyhow::Result<Plan> {
        if !self.view.is_empty() {
            return self.plan_of_views(files);
        }
        let pipelines = chosen(&self.pipelines, files)?;
        let mut scenes = self.scenes.clone();
        let mut sweeps = self.sweep.clone();
        if scenes.is_empty() {
            scenes.push(DEFAULT_SCENE.to_owned());
            if sweeps.is_empty() {
                sweeps.push(DEFAULT_SWEEP.to_owned());
            }
        }
        let mut choices = Vec::new();
        let mut first: Option<Scripts> = None;
        for scene in &scenes {
            let request = Request {
                scene,
                arguments: &self.scene_arguments,
                pipelines: &pipelines,
                gpu: &self.gpu,
            };
            let scripts = load::scripts(files, &request)?;
            choices.push(Choice {
                label: None,
                path: scripts.scene.clone(),
                settings: parameters(&scripts.scene_settings),
            });
            first.get_or_insert(scripts);
        }
        let Some(scripts) = first else {
            return Err(Usage("name a scene".to_owned()).into());
        };
        unique(&scripts.descriptions)?;
        let axes = self.axes(&sweeps, &scripts)?;
        let step = self.step.unwrap_or(STEP);
        for (name, value) in [("--step", step), ("--seconds", self.seconds)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(Usage(format!("{name} {value}: it must be a number above 0")).into());
            }
        }
        let names: Vec<String> = choices
            .iter()
            .map(|choice| scene_name(&choice.path))
            .collect();
        Ok(Plan {
            title: self
                .title
                .clone()
                .unwrap_or_else(|| format!("{}: {} pipelines", names.join(", "), pipelines.len())),
            scenes: choices,
            pipelines: scripts
                .pipelines
                .iter()
                .map(|(path, settings)| Choice {
                    label: None,
                    path: path.clone(),
                    settings: parameters(settings),
                })
                .collect(),
            axes,
            size: [self.size.width, self.size.height],
            reference: self.reference(&scripts.descriptions)?,
            traced_samples: self.samples,
            warmup: self.warmup,
            frames: self.frames,
            step,
            start: self.start,
            processes: self.processes,
            seconds: self.seconds,
            view: None,
            tuned: Vec::new(),
            outside: files.grants().to_vec(),
        })
    }

    fn plan_of_views(&self, files: &Files) -> anyhow::Result<Plan> {
        let effort = Effort {
            warmup: self.warmup,
            frames: self.frames,
            processes: self.processes,
            seconds: self.seconds,
        };
        if !(self.seconds.is_finite() && self.seconds > 0.0) {
            let text = format!("--seconds {}: it must be a number above 0", self.seconds);
            return Err(Usage(text).into());
        }
        let plan = plan_of_views(files, &self.view, effort);
        let mut plan = plan.map_err(|error| match error {
            ViewsError::Problems(problems) => report::problems(files, problems),
            other => anyhow::Error::from(Usage(format!("--view: {other}"))),
        })?;
        if let Some(title) = &self.title {
            plan.title.clone_from(title);
        }
        if let Some(reference) = &self.reference {
            let names: Vec<String> = plan.pipelines.iter().map(Choice::name).collect();
            if reference != TRACED && !names.contains(reference) {
                let hint = suggestion(reference, names.iter().map(String::as_str));
                return Err(Usage(format!(
                    "--reference {reference}: it is not measured; {}",
                    hint.unwrap_or_else(|| format!("name one of {}", names.join(", ")))
                ))
                .into());
            }
            plan.reference.clone_from(reference);
        }
        for text in &self.sweep {
            let axis =
                Axis::read(text).map_err(|error| Usage(format!("--sweep {text}: {error}")))?;
            plan.axes.push(axis);
        }
        Ok(plan)
    }

    fn axes(&self, sweeps: &[String], scripts: &Scripts) -> Result<Vec<Axis>, Usage> {
        let mut axes = Vec::new();
        for text in sweeps {
            let wrong = |error: String| Usage(format!("--sweep {text}: {error}"));
            let mut axis = Axis::read(text).map_err(|error| wrong(error.to_string()))?;
            axis.name = owner(&axis.name, &scripts.descriptions).map_err(wrong)?;
            let set = |settings: &Settings| settings.get(&axis.name).is_some();
            if set(&scripts.scene_settings) {
                return Err(wrong(
                    "`--set` gives it a value already; leave one of them out".into(),
                ));
            }
            axes.push(axis);
        }
        Ok(axes)
    }

    fn reference(&self, pipelines: &[PipelineDesc]) -> Result<String, Usage> {
        let names = || pipelines.iter().map(|pipeline| pipeline.name.as_str());
        let wanted = self.reference.as_deref().map(|wanted| {
            // A path means the pipeline that it declares.
            let stem = Path::new(wanted).file_stem().and_then(|stem| stem.to_str());
            stem.filter(|_| wanted.ends_with(".rhai")).unwrap_or(wanted)
        });
        match wanted {
            None => Ok(names().next().unwrap_or_default().to_owned()),
            Some(TRACED) => Ok(TRACED.to_owned()),
            Some(_) if self.samples > 0 => Err(Usage(
                "--samples belongs to `--reference traced`".to_owned(),
            )),
            Some(wanted) if names().any(|name| name == wanted) => Ok(wanted.to_owned()),
            Some(wanted) => {
                let hint = suggestion(wanted, names().chain([TRACED]))
                    .unwrap_or_else(|| "name one of those in --pipelines".to_owned());
                Err(Usage(format!(
                    "--reference {wanted}: it is not measured; {hint}"
                )))
            }
        }
    }
}

/// The pipelines that were named, or all.
pub fn chosen(named: &[String], files: &Files) -> anyhow::Result<Vec<String>> {
    let mut chosen: Vec<String> = Vec::new();
    for name in named.iter().map(|name| name.trim()) {
        if name.is_empty() {
            return Err(
                Usage("--pipelines has an empty name; write it as a,b,c".to_owned()).into(),
            );
        }
        if chosen.iter().any(|known| known == name) {
            return Err(Usage(format!("--pipelines names `{name}` twice")).into());
        }
        chosen.push(name.to_owned());
    }
    if chosen.is_empty() {
        let entries = list_pipelines(files)?.into_iter();
        chosen.extend(entries.filter(|e| e.problem.is_none()).map(|e| e.name));
    }
    Ok(chosen)
}

fn unique(pipelines: &[PipelineDesc]) -> Result<(), Usage> {
    let mut seen = std::collections::HashSet::new();
    match pipelines.iter().find(|desc| !seen.insert(&desc.name)) {
        None => Ok(()),
        Some(twice) => Err(Usage(format!(
            "two of the pipelines are called `{}`; rename one file",
            twice.name
        ))),
    }
}

/// Whose parameter a sweep means, as a plan writes it.
fn owner(name: &str, pipelines: &[PipelineDesc]) -> Result<String, String> {
    let has = |parameter: &str| {
        pipelines
            .iter()
            .any(|desc| desc.parameter(parameter).is_some())
    };
    if [SIZE, START, CAMERA].contains(&name) {
        return Ok(name.to_owned());
    }
    match name.rsplit_once('.') {
        None if has(name) => Ok(format!("*.{name}")),
        None => Ok(name.to_owned()),
        Some(("scene", name)) => Ok(name.to_owned()),
        Some(("pipeline" | "*", parameter)) if has(parameter) => Ok(format!("*.{parameter}")),
        Some(("pipeline" | "*", parameter)) => Err(format!(
            "none of the pipelines has a parameter `{parameter}`"
        )),
        Some((owner, parameter)) => match pipelines.iter().find(|desc| desc.name == owner) {
            Some(desc) if desc.parameter(parameter).is_some() => Ok(name.to_owned()),
            Some(desc) => {
                let known = desc.parameters.iter().map(|p| p.name.as_str());
                let hint =
                    suggestion(parameter, known).map_or_else(String::new, |h| format!("; {h}"));
                Err(format!("`{owner}` has no parameter `{parameter}`{hint}"))
            }
            None => {
                let known = pipelines.iter().map(|desc| desc.name.as_str());
                let hint =
                    suggestion(owner, known.chain(["scene", "pipeline"])).unwrap_or_else(|| {
                        "before the dot stands `scene`, `pipeline` or a pipeline".into()
                    });
                Err(format!("there is no `{owner}`; {hint}"))
            }
        },
    }
}

fn parameters(settings: &Settings) -> Vec<Parameter> {
    settings
        .iter()
        .map(|(name, value)| Parameter {
            name: name.to_owned(),
            value: value.to_string(),
        })
        .collect()
}
