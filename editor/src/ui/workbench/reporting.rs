//! A report of what is on the screen: the study that `lightbench compare --view` would run, on a thread
//! and in processes of its own.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use lightbench::assets::files::Files;
use lightbench::assets::{Progress, Task};
use lightbench::lab::report::write_study;
use lightbench::lab::study::{
    Launch, Plan, ProcessError, Store, Told, drop_stale, join, run_processes,
};
use lightbench::render::GpuOptions;

use super::Workbench;
use crate::ui::messages::say;
use crate::viewpoint::Viewpoint;
use crate::viewpoint::plan::{Effort, plan};

/// The folder of reports in a project.
pub const REPORTS: &str = "reports";

/// How the processes of a study are started.
#[derive(Clone, Debug, Default)]
pub struct WorkerOptions {
    /// The program `lightbench`; the one that runs, without it.
    pub program: Option<PathBuf>,
    /// The file of `--limits`.
    pub limits: Option<PathBuf>,
}

/// The report that is being made, or that was made last.
#[derive(Default)]
pub struct Reporting {
    /// How much is measured.
    pub effort: Effort,
    task: Option<Task<Result<Report, String>>>,
    folder: PathBuf,
    last: Option<Result<Report, String>>,
}

/// A report that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// Its folder.
    pub folder: PathBuf,
    /// The page to open.
    pub page: PathBuf,
    /// Warnings of the processes.
    pub warnings: Vec<String>,
}

impl Reporting {
    /// How far it is and what is being done, while a report is made.
    pub fn progress(&self) -> Option<(f32, String)> {
        let progress = self.task.as_ref()?.progress();
        Some((progress.fraction(), progress.label()))
    }

    /// What came of the last one.
    pub fn last(&self) -> Option<&Result<Report, String>> {
        self.last.as_ref()
    }

    /// Says why there is no report.
    pub fn refuse(&mut self, why: String) {
        self.last = Some(Err(why));
    }

    /// Asks the report at hand to stop.
    pub fn cancel(&self) {
        if let Some(task) = &self.task {
            task.progress().cancel();
        }
    }
}

impl Workbench {
    /// Begins a report of what is on the screen, in the project's folder of reports.
    ///
    /// # Errors
    /// A sentence that says why there can be none.
    pub fn report(&mut self) -> Result<(), String> {
        if self.reporting.task.is_some() {
            return Err(say!("reporting.a_report_is_being_made_already").to_owned());
        }
        let Some(project) = self.files.project().map(Path::to_owned) else {
            return Err(say!("reporting.reports_are_written_into_a_project").to_owned());
        };
        let views: Vec<Viewpoint> = [self.viewpoint(), self.other_viewpoint()]
            .into_iter()
            .flatten()
            .collect();
        if views.is_empty() {
            return Err(say!("reporting.there_is_no_picture_yet").to_owned());
        }
        // Paths as the loaders take them, not as people read them.
        let mut plain = views.clone();
        for view in &mut plain {
            self.scenes
                .shown()
                .unwrap_or_default()
                .clone_into(&mut view.scene);
            view.scene_settings = self.scenes.settings().cloned().unwrap_or_default();
        }
        let plan = plan(&self.files, &plain, self.reporting.effort);
        let plan = plan.map_err(|error| error.to_string())?;
        let scene = plan.scenes[0].name();
        let folder = free_folder(&project.join(REPORTS), &scene);
        let order = Order {
            files: self.files.clone(),
            command_line: command_line(&views, &self.reporting.effort, &folder),
            plan,
            folder: folder.clone(),
            gpu: self.gpu_options.clone(),
            worker: self.worker.clone(),
        };
        // Whatever else is drawn would be measured too.
        self.clock.playing = false;
        let wake = self.wake.clone();
        let task = Task::start(move |progress| {
            let made = make(&order, progress);
            wake();
            made
        });
        self.reporting.task =
            Some(task.map_err(|error| say!("reporting.no_thread_for_it", error = error))?);
        self.reporting.folder = folder;
        self.reporting.last = None;
        Ok(())
    }

    /// Takes in the report when it is made.
    pub(super) fn take_report(&mut self) {
        let Some(task) = &self.reporting.task else {
            return;
        };
        let result = match task.poll() {
            Ok(None) => return,
            Ok(Some(result)) => result,
            Err(lost) => Err(lost.to_string()),
        };
        self.reporting.task = None;
        match &result {
            Ok(report) => {
                for warning in &report.warnings {
                    self.log.warn(warning.clone());
                }
                self.log.info(say!(
                    "reporting.the_report_is",
                    page = report.page.display()
                ));
            }
            Err(error) => self.log.error(say!("reporting.no_report", error = error)),
        }
        self.reporting.last = Some(result);
    }
}

/// What the thread is given.
struct Order {
    files: Files,
    plan: Plan,
    folder: PathBuf,
    gpu: GpuOptions,
    worker: WorkerOptions,
    command_line: String,
}

fn make(order: &Order, progress: &Progress) -> Result<Report, String> {
    let words = |error: &dyn std::fmt::Display| error.to_string();
    let launch = launch(order)?;
    let version = env!("CARGO_PKG_VERSION");
    let store = Store::open(&order.folder, &order.plan, version, false);
    let store = store.map_err(|error| words(&error))?;
    let points = order.plan.points().map_err(|error| words(&error))?;
    drop_stale(&store, &order.plan, &points, &order.files).map_err(|error| words(&error))?;
    let mut warnings = Vec::new();
    let mut tell = |told| {
        if let Told::Warning(text) = told {
            warnings.push(text);
        }
    };
    let ran = run_processes(&launch, &store, &order.plan, &points, progress, &mut tell);
    match ran {
        Ok(()) => {}
        Err(ProcessError::Cancelled(_)) => {
            return Err(say!(
                "reporting.it_was_stopped_what_was_measured",
                folder = order.folder.display(),
                command_line = order.command_line
            ));
        }
        Err(error) => return Err(words(&error)),
    }
    let mut study = join(&store, &order.plan, &points).map_err(|error| words(&error))?;
    write_study(&mut study, &order.folder).map_err(|error| words(&error))?;
    Ok(Report {
        page: order.folder.join("report.html"),
        folder: order.folder.clone(),
        warnings,
    })
}

fn launch(order: &Order) -> Result<Launch, String> {
    let program = match &order.worker.program {
        Some(program) => program.clone(),
        None => std::env::current_exe()
            .map_err(|error| say!("reporting.cant_find_this_program_own_file", error = error))?,
    };
    let mut arguments: Vec<OsString> = Vec::new();
    if let Some(project) = order.files.project() {
        arguments.extend(["--project".into(), project.into()]);
    }
    if let Some(limits) = &order.worker.limits {
        arguments.extend(["--limits".into(), limits.into()]);
    }
    arguments.push("study-worker".into());
    arguments.extend(["--command-line".into(), order.command_line.as_str().into()]);
    if let Some(adapter) = &order.gpu.adapter {
        arguments.extend(["--adapter".into(), adapter.into()]);
    }
    if order.gpu.portable {
        arguments.push("--portable".into());
    }
    arguments.extend(["--store".into(), order.folder.as_path().into()]);
    Ok(Launch { program, arguments })
}

/// The command that measures the same, for a shell.
fn command_line(views: &[Viewpoint], effort: &Effort, folder: &Path) -> String {
    let quoted = |text: &str| format!("'{}'", text.replace('\'', r"'\''"));
    let views: Vec<String> = views
        .iter()
        .map(|view| format!("--view {}", quoted(&view.to_string())))
        .collect();
    format!(
        "lightbench compare {} --warmup {} --frames {} --processes {} --seconds {} --out {}",
        views.join(" "),
        effort.warmup,
        effort.frames,
        effort.processes,
        effort.seconds,
        quoted(&folder.display().to_string())
    )
}

/// A folder that is not there yet, named after the scene and the time.
fn free_folder(reports: &Path, scene: &str) -> PathBuf {
    let now = jiff::Zoned::now().strftime("%Y-%m-%d_%H-%M-%S").to_string();
    let letter = |c: char| if c.is_alphanumeric() { c } else { '_' };
    let name: String = scene.chars().map(letter).collect();
    let first = reports.join(format!("{name}_{now}"));
    let others = (2..).map(|number| reports.join(format!("{name}_{now}_{number}")));
    let mut all = std::iter::once(first.clone()).chain(others);
    all.find(|folder| !folder.exists()).unwrap_or(first)
}
