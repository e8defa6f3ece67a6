//! Studies that experiments ask for.

use lightbench_script::{Cost, LaboratoryError, Settings, StudyRow, StudyTask};

use super::{Remark, Workbench, measuring};
use crate::capture::STEP;
use crate::report::analysis::{Analysis, Verdict, of_study};
use crate::report::{Parameter, write_study};
use crate::study::{
    Axis, Choice, Plan, ProcessError, Store, Study, TRACED, Told, join, run_processes,
};

impl Workbench {
    /// Measures what is missing of a study and writes its report.
    pub(super) fn study_task(
        &mut self,
        task: &StudyTask,
    ) -> Result<Vec<StudyRow>, LaboratoryError> {
        let other = |error: &dyn std::fmt::Display| LaboratoryError::Other(error.to_string());
        let Some(launch) = &self.launch else {
            return Err(LaboratoryError::Other(
                "no processes can be started here: run the experiment with `lightbench run`"
                    .to_owned(),
            ));
        };
        let Some(project) = self.files.project() else {
            return Err(LaboratoryError::Other(
                "there is no project to write the report into: `lightbench new project` makes one"
                    .to_owned(),
            ));
        };
        let folder = project.join(&task.out);
        let plan = plan(task, self.files.grants())?;
        let points = plan.points().map_err(|error| other(&error))?;
        let version = env!("CARGO_PKG_VERSION");
        // A script that was changed means its new study.
        let store = match Store::open(&folder, &plan, version, false) {
            Err(crate::study::StoreError::Other(_)) => Store::open(&folder, &plan, version, true),
            opened => opened,
        };
        let store = store.map_err(|error| other(&error))?;
        crate::study::drop_stale(&store, &plan, &points, &self.files)
            .map_err(|error| other(&error))?;
        let tell = &self.tell;
        let mut told = |told| match told {
            Told::Warning(text) | Told::Note(text) => tell(Remark::Warning(text)),
            Told::Done { .. } => {}
        };
        let launch = launch(&folder);
        let ran = run_processes(&launch, &store, &plan, &points, &self.progress, &mut told);
        ran.map_err(|error| match error {
            ProcessError::Cancelled(_) => LaboratoryError::Other("stopped".to_owned()),
            other => LaboratoryError::Other(other.to_string()),
        })?;
        let mut study = join(&store, &plan, &points).map_err(|error| other(&error))?;
        write_study(&mut study, &folder).map_err(|error| other(&error))?;
        rows(&study)
    }
}

fn plan(task: &StudyTask, outside: &[std::path::PathBuf]) -> Result<Plan, LaboratoryError> {
    let choice = |(path, settings): &(String, Settings)| Choice {
        label: None,
        path: path.clone(),
        settings: settings
            .iter()
            .map(|(name, value)| Parameter {
                name: name.to_owned(),
                value: value.to_string(),
            })
            .collect(),
    };
    let mut pipelines: Vec<Choice> = task.pipelines.iter().map(choice).collect();
    label(&mut pipelines);
    let names: Vec<String> = pipelines.iter().map(Choice::name).collect();
    let reference = task
        .reference
        .clone()
        .unwrap_or_else(|| names.first().cloned().unwrap_or_default());
    if reference != TRACED && !names.contains(&reference) {
        return Err(LaboratoryError::Other(format!(
            "the reference `{reference}` is not measured; it can be {} or `{TRACED}`",
            names
                .iter()
                .map(|name| format!("`{name}`"))
                .collect::<Vec<_>>()
                .join(", ")
        )));
    }
    let mut scenes: Vec<Choice> = task.scenes.iter().map(choice).collect();
    label(&mut scenes);
    Ok(Plan {
        title: task.title.clone(),
        scenes,
        pipelines,
        axes: task
            .sweep
            .iter()
            .map(|(name, values)| Axis {
                name: name.clone(),
                values: values.clone(),
            })
            .collect(),
        size: [task.size.0, task.size.1],
        reference,
        traced_samples: task.samples,
        warmup: task.warmup,
        frames: task.frames,
        step: task.step.unwrap_or(STEP),
        start: task.start,
        processes: task.processes,
        seconds: task.seconds,
        view: None,
        tuned: Vec::new(),
        outside: outside.to_vec(),
    })
}

/// Tells choices of one file apart by their values.
fn label(choices: &mut [Choice]) {
    let names: Vec<String> = choices.iter().map(Choice::name).collect();
    for (choice, name) in choices.iter_mut().zip(&names) {
        if names.iter().filter(|other| *other == name).count() > 1 && !choice.settings.is_empty() {
            let words = choice
                .settings
                .iter()
                .map(|s| format!("{}={}", s.name, s.value));
            choice.label = Some(format!("{name} {}", words.collect::<Vec<_>>().join(" ")));
        }
    }
}

fn rows(study: &Study) -> Result<Vec<StudyRow>, LaboratoryError> {
    let mut rows = Vec::new();
    for (point, analysis) in study.points.iter().zip(of_study(study)) {
        let place = point
            .coordinates
            .iter()
            .map(|c| (c.name.clone(), c.value.clone()));
        let place: Vec<(String, String)> = place.collect();
        for (index, result) in point.comparison.pipelines.iter().enumerate() {
            if result.name == TRACED {
                continue;
            }
            let cost: Cost = measuring::cost(result)?;
            rows.push(StudyRow {
                point: place.clone(),
                pipeline: result.name.clone(),
                cost,
                flip: result
                    .difference
                    .as_ref()
                    .map(|difference| difference.flip.mean),
                verdict: verdict(&analysis, index),
            });
        }
    }
    Ok(rows)
}

fn verdict(analysis: &Analysis, index: usize) -> &'static str {
    match analysis.against_baseline[index].map(|ratio| ratio.verdict) {
        None | Some(Verdict::Same) => "same",
        Some(Verdict::Faster) => "faster",
        Some(Verdict::Slower) => "slower",
        Some(Verdict::Undecided | Verdict::TooFew) => "undecided",
    }
}
