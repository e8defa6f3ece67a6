//! From views to the plan of a study: the pipelines of the views on the scene that they share, from the
//! same place at the same time.

use lightbench::assets::files::Files;
use lightbench::lab::capture::STEP;
use lightbench::lab::report::Parameter;
use lightbench::lab::study::{Axis, CAMERA, Choice, Plan};
use lightbench::render::Problems;
use lightbench::script::{Settings, load_pipeline};

use super::{Eye, Viewpoint};

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Frames drawn first by each pipeline and not measured.
    pub warmup: u32,
    /// Frames measured of each pipeline in each process.
    pub frames: u32,
    /// Fresh processes.
    pub processes: u32,
    /// Seconds for each pipeline.
    pub seconds: f64,
}

impl Default for Effort {
    /// As `lightbench compare` without arguments.
    fn default() -> Self {
        Self {
            warmup: 1,
            frames: 4,
            processes: 5,
            seconds: 5.0,
        }
    }
}

/// Why views make no plan.
#[derive(Debug, thiserror::Error)]
pub enum ViewsError {
    /// There is none.
    #[error("a study needs a view at least")]
    None,
    /// They don't show the same.
    #[error(
        "view {number} differs from the first one in its {what}: views that are compared show one scene \
         from one place at one time, and differ in the pipeline and its values"
    )]
    Differ {
        /// Which, from 1.
        number: usize,
        /// In what.
        what: &'static str,
    },
    /// A pipeline has mistakes.
    #[error(transparent)]
    Problems(#[from] Problems),
}

/// The plan of a study of all pipelines of some views.
///
/// # Errors
/// Views that don't show the same, or pipelines with mistakes.
pub fn plan(files: &Files, views: &[Viewpoint], effort: Effort) -> Result<Plan, ViewsError> {
    let first = views.first().ok_or(ViewsError::None)?;
    for (index, view) in views.iter().enumerate() {
        let differences = [
            ("scene", view.scene != first.scene),
            (
                "scene's parameters",
                parameters(&view.scene_settings) != parameters(&first.scene_settings),
            ),
            ("camera", view.camera != first.camera),
            ("time", view.time != first.time),
            ("size", view.size != first.size),
        ];
        if let Some((what, _)) = differences.into_iter().find(|(_, differs)| *differs) {
            return Err(ViewsError::Differ {
                number: index + 1,
                what,
            });
        }
    }
    let mut pipelines: Vec<Choice> = views
        .iter()
        .map(|view| Choice {
            label: None,
            path: view.pipeline.clone(),
            settings: parameters(&view.pipeline_settings),
        })
        .collect();
    label(&mut pipelines);
    let described = load_pipeline(files, &first.pipeline, &first.pipeline_settings)?;
    for view in &views[1..] {
        load_pipeline(files, &view.pipeline, &view.pipeline_settings)?;
    }
    let reference = pipelines[0].label.clone().unwrap_or(described.name);
    let scene = Choice {
        label: None,
        path: first.scene.clone(),
        settings: parameters(&first.scene_settings),
    };
    let names: Vec<String> = pipelines.iter().map(Choice::name).collect();
    Ok(Plan {
        title: format!("{}: {}", scene.name(), names.join(" against ")),
        scenes: vec![scene],
        pipelines,
        axes: match &first.camera {
            Eye::Named(name) => vec![Axis {
                name: CAMERA.to_owned(),
                values: vec![name.clone()],
            }],
            _ => Vec::new(),
        },
        size: [first.size.0, first.size.1],
        reference,
        warmup: effort.warmup,
        frames: effort.frames,
        step: STEP,
        start: (first.time / STEP).round() as u32,
        processes: effort.processes,
        seconds: effort.seconds,
        view: match &first.camera {
            Eye::Scene | Eye::Named(_) => None,
            Eye::Free(free) => Some(free.view().into()),
            Eye::Side(flat) => Some(flat.view().into()),
        },
        outside: files.grants().to_vec(),
        ..Plan::default()
    })
}

fn parameters(settings: &Settings) -> Vec<Parameter> {
    let all = settings.iter();
    all.map(|(name, value)| Parameter {
        name: name.to_owned(),
        value: value.to_string(),
    })
    .collect()
}

/// Tells choices of one pipeline apart, by their values and at last by their number.
fn label(choices: &mut [Choice]) {
    let names: Vec<String> = choices.iter().map(Choice::name).collect();
    let twice = |names: &[String], index: usize| {
        let same = names.iter().filter(|name| **name == names[index]);
        same.count() > 1
    };
    let mut labels = names.clone();
    for (index, choice) in choices.iter().enumerate() {
        if twice(&names, index) && !choice.settings.is_empty() {
            let settings = choice.settings.iter();
            let words: Vec<String> = settings
                .map(|s| format!("{}={}", s.name, s.value))
                .collect();
            labels[index] = format!("{} {}", names[index], words.join(" "));
        }
    }
    let worded = labels.clone();
    for (index, label) in labels.iter_mut().enumerate() {
        if twice(&worded, index) {
            *label = format!("{label} ({})", index + 1);
        }
        if *label != names[index] {
            choices[index].label = Some(label.clone());
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn view(pipeline: &str, settings: &str) -> Viewpoint {
        let camera = "camera=free camera.eye=1,2,3 camera.turn=0,0 camera.orbit=1 \
                      camera.lens=1,0.1,inf";
        let text = format!(
            "lightbench-view-1 scene=atrium scene.lights=4 pipeline={pipeline} {settings} {camera} time=0.5 \
             size=64x36"
        );
        text.parse().unwrap()
    }

    #[test]
    fn a_pipeline_against_itself_has_two_names() {
        let files = Files::shipped();
        let name = "deferred_shading";
        let views = [
            view(name, ""),
            view(name, "pipeline.exposure=1"),
            view(name, ""),
        ];
        let plan = plan(&files, &views, Effort::default()).unwrap();
        let names: Vec<String> = plan.pipelines.iter().map(Choice::name).collect();
        assert_eq!(
            names,
            [
                "deferred_shading (1)",
                "deferred_shading exposure=1",
                "deferred_shading (3)"
            ]
        );
        assert_eq!(plan.reference, names[0]);
        assert_eq!((plan.start, plan.size), (30, [64, 36]));
        let fixed = plan.view.unwrap();
        let Eye::Free(free) = views[0].camera else {
            panic!("the camera is free")
        };
        assert_eq!(lightbench::render::View::from(fixed), free.view());
        // Through a file, also where the far plane is infinitely far.
        let text = serde_json::to_string(&plan).unwrap();
        assert_eq!(serde_json::from_str::<Plan>(&text).unwrap(), plan);
    }

    #[test]
    fn views_of_different_places_are_refused() {
        let files = Files::shipped();
        let mut other = view("forward_single_pass", "");
        other.time = 1.0;
        let views = [view("deferred_shading", ""), other];
        let error = plan(&files, &views, Effort::default()).unwrap_err();
        assert!(error.to_string().contains("in its time"), "{error}");
        let broken = [view("deferred_shading", "pipeline.nothing=1")];
        assert!(plan(&files, &broken, Effort::default()).is_err());
        assert!(plan(&files, &[], Effort::default()).is_err());
    }
}
