//! Checks of lessons: experiments that look into what a student handed in, and say what they found.

mod evidence;
mod judging;
mod mistakes;
mod work;

use std::sync::{Arc, Mutex, PoisonError};

use lightbench_assets::Progress;
use lightbench_assets::cache::Reuse;
use lightbench_assets::files::Files;
use lightbench_render::{Problem, Problems};
use rhai::{AST, Array, CallFnOptions, Dynamic, Map, Scope};

use super::bench::Bench;
use super::{Laboratory, frames, images, limits, measuring, saying};
use crate::api::as_number;
use crate::host::{Extras, Host, Variables};
use crate::limits::Limits;
use crate::log::LogLine;
use crate::names::Names;
use crate::settings::Settings;
use work::Work;

pub use evidence::{Bound, Data, Evidence, Examiner, Expected, Told};

/// Why a check did not come to its end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CheckFault {
    /// What was handed in can't be loaded or drawn.
    Work(Problems),
    /// The check itself has a mistake, or used too much.
    Check(Problem),
    /// The caller's progress was cancelled.
    Stopped,
}

/// What a function of a check gives.
#[derive(Clone, Debug, PartialEq)]
pub enum Given {
    /// Nothing that has a meaning.
    Nothing,
    /// A number.
    Number(f64),
    /// A text: the name of a mistake.
    Text(String),
}

/// The check functions of a lesson, with the laboratories that they use.
pub struct CheckScript {
    host: Host,
    ast: Arc<AST>,
    path: String,
    work: Work,
    limits: Limits,
    progress: Progress,
}

impl CheckScript {
    /// Reads a file of checks. `reference` draws what lessons bring, `work` what was handed in; each
    /// line that the script prints goes to `print`.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn load(
        files: &Files,
        path: &str,
        [reference, work]: [Box<dyn Laboratory>; 2],
        examiner: Box<dyn Examiner>,
        print: impl Fn(LogLine) + Send + Sync + 'static,
        progress: &Progress,
    ) -> Result<Self, Problems> {
        let limits = limits().in_project(files)?;
        let (host, work) = host(files, path, [reference, work], examiner, &limits);
        let work = work.ok_or_else(|| {
            Problem::new(lightbench_render::Place::file(path), "no work is given")
        })?;
        host.watch.stop_with(progress);
        host.log.pass_on(print);
        let ast = host.load(path)?;
        Ok(Self {
            host,
            ast,
            path: path.to_owned(),
            work,
            limits,
            progress: progress.clone(),
        })
    }

    /// The functions of the file that have a name, each with how many arguments it takes.
    #[must_use]
    pub fn functions(&self) -> Vec<(String, usize)> {
        let functions = self.ast.iter_functions();
        functions
            // Rhai names closures itself, with a sign that no script can write.
            .filter(|function| !function.name.contains('$'))
            .map(|function| (function.name.to_owned(), function.params.len()))
            .collect()
    }

    /// Calls a function with the work, and with the report that an answer was read from.
    ///
    /// # Errors
    /// Why it did not come to its end.
    pub fn run(&mut self, function: &str, report: Option<&Data>) -> Result<Given, CheckFault> {
        self.work.forget();
        self.host.begin(&self.path);
        self.host.watch.start(self.limits.load_time);
        let mut arguments = vec![Dynamic::from(self.work.clone())];
        arguments.extend(report.map(dynamic));
        let called = self.host.engine.call_fn_with_options::<Dynamic>(
            CallFnOptions::new(),
            &mut Scope::new(),
            &self.ast,
            function,
            arguments,
        );
        match called {
            Ok(value) => Ok(given(value)),
            Err(_) if self.progress.is_cancelled() => Err(CheckFault::Stopped),
            Err(error) => Err(match self.work.fault() {
                Some(problems) => CheckFault::Work(problems),
                None => CheckFault::Check(self.host.compiler.explain(&error, &self.path)),
            }),
        }
    }
}

/// The names of everything that checks can call.
#[must_use]
pub fn check_names() -> Names {
    let nobody = || Box::new(super::Nobody) as Box<dyn Laboratory>;
    let files = Files::shipped();
    let (host, _) = host(
        &files,
        "",
        [nobody(), nobody()],
        Box::new(Nobody),
        &limits(),
    );
    host.compiler.names.clone()
}

fn host(
    files: &Files,
    path: &str,
    [reference, work]: [Box<dyn Laboratory>; 2],
    examiner: Box<dyn Examiner>,
    limits: &Limits,
) -> (Host, Option<Work>) {
    let settings = Settings::new();
    let (mut given, mut made) = (Some((reference, work, examiner)), None);
    let host = Host::new(
        files,
        limits,
        Extras {
            register: &mut |api, watch, _| {
                let Some((reference, work, examiner)) = given.take() else {
                    return;
                };
                let bench = Bench::new(reference, watch, files, &settings);
                let work = Work::new(Bench::new(work, watch, files, &settings), examiner);
                work::register(api);
                judging::register(api);
                frames::register(api, &bench, path);
                images::register(api);
                measuring::register(api, &bench, path);
                saying::register(api);
                made = Some(work);
            },
            globals: Vec::new(),
            variables: Variables::default(),
            reuse: Reuse::default(),
        },
    );
    (host, made)
}

fn given(value: Dynamic) -> Given {
    if let Some(number) = as_number(&value) {
        return Given::Number(number);
    }
    value.into_string().map_or(Given::Nothing, Given::Text)
}

/// A value of a file as scripts see it.
fn dynamic(data: &Data) -> Dynamic {
    match data {
        Data::Nothing => Dynamic::UNIT,
        Data::Switch(on) => (*on).into(),
        Data::Number(number) => (*number).into(),
        Data::Text(text) => text.clone().into(),
        Data::List(items) => items.iter().map(dynamic).collect::<Array>().into(),
        Data::Map(entries) => {
            let entries = entries.iter();
            let entries = entries.map(|(name, value)| (name.as_str().into(), dynamic(value)));
            entries.collect::<Map>().into()
        }
    }
}

/// An examiner for who only asks for names.
struct Nobody;

impl Examiner for Nobody {
    fn judge(&mut self, _: &str, _: Evidence) -> Result<bool, super::LaboratoryError> {
        super::Nobody::refuse()
    }

    fn constant(&self, _: &str) -> Result<f64, super::LaboratoryError> {
        super::Nobody::refuse()
    }
}

fn lock<T: ?Sized>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
