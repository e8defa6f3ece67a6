//! What the functions of an experiment share: its laboratory, its parameters, its files.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbench_assets::files::Files;
use lightbench_render::{Place, Problem, Problems, RenderError, TargetImage};
use rhai::Dynamic;

use super::laboratory::{Laboratory, LaboratoryError};
use crate::api::{Arguments, Mistake};
use crate::limits::Watch;
use crate::parameters::{self, SceneParameter, undeclared};
use crate::settings::Settings;

/// Shared by all functions of one experiment.
#[derive(Clone)]
pub(super) struct Bench(Arc<Inner>);

struct Inner {
    laboratory: Mutex<Box<dyn Laboratory>>,
    watch: Arc<Watch>,
    files: Files,
    settings: Settings,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    parameters: Vec<SceneParameter>,
    /// Whether a frame was drawn. Then all parameters are known.
    drawn: bool,
    /// What went wrong in the laboratory last, with all of its places.
    fault: Option<Problems>,
}

impl Bench {
    pub(super) fn new(
        laboratory: Box<dyn Laboratory>,
        watch: &Arc<Watch>,
        files: &Files,
        settings: &Settings,
    ) -> Self {
        Self(Arc::new(Inner {
            laboratory: Mutex::new(laboratory),
            watch: Arc::clone(watch),
            files: files.clone(),
            settings: settings.clone(),
            state: Mutex::default(),
        }))
    }

    /// Lets the laboratory work, in time that is not the script's.
    pub(super) fn work<T>(
        &self,
        work: impl FnOnce(&mut dyn Laboratory) -> Result<T, LaboratoryError>,
    ) -> Result<T, Mistake> {
        let mut laboratory = lock(&self.0.laboratory);
        let result = self.0.watch.free_of_charge(|| work(&mut **laboratory));
        // What a script caught and went on after is not what ends it.
        lock(&self.0.state).fault = match &result {
            Ok(_) => None,
            Err(LaboratoryError::Files(problems)) => Some(problems.clone()),
            Err(other) => Some(Problem::new(Place::default(), other.to_string()).into()),
        };
        result.map_err(mistake)
    }

    /// An image whose texels count as the script's memory: it may hold many.
    pub(super) fn charged(&self, image: TargetImage) -> Arc<TargetImage> {
        let charged = image.clone();
        self.0.watch.free_of_charge(|| drop(image));
        Arc::new(charged)
    }

    /// Writes a file of the project's folder `out`.
    pub(super) fn write(&self, path: &str, bytes: &[u8]) -> Result<(), Mistake> {
        let written = self.0.files.write(path, bytes);
        written
            .map(|_| ())
            .map_err(|error| Mistake::new(error.to_string()))
    }

    /// Declares a parameter of the experiment.
    pub(super) fn declare(&self, arguments: &Arguments) -> Result<Dynamic, Mistake> {
        let mut state = lock(&self.0.state);
        if state.drawn {
            return Err(
                Mistake::new("parameters are declared before the first `draw`").with_hint(
                    "move `param` to the top of the file: then a misspelt `--set` is told at once",
                ),
            );
        }
        parameters::declare(&mut state.parameters, &self.0.settings, arguments)
    }

    /// Takes the last thing that went wrong in the laboratory.
    pub(super) fn take_fault(&self) -> Option<Problems> {
        lock(&self.0.state).fault.take()
    }

    /// Notes that a frame is to be drawn, and refuses it where something was set that the
    /// experiment has not declared.
    pub(super) fn begin_draw(&self, path: &str) -> Result<(), Mistake> {
        lock(&self.0.state).drawn = true;
        match self.undeclared(path).into_iter().next() {
            None => Ok(()),
            Some(problem) => Err(problem.into()),
        }
    }

    /// A problem for each value that was set and that the experiment has not declared.
    pub(super) fn undeclared(&self, path: &str) -> Vec<Problem> {
        let state = lock(&self.0.state);
        undeclared("experiment", path, &state.parameters, &self.0.settings)
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What went wrong in the laboratory, in the words of the script's line.
pub(super) fn mistake(error: LaboratoryError) -> Mistake {
    let hint = match &error {
        LaboratoryError::Files(problems) => return first_problem(problems),
        LaboratoryError::Render(RenderError::NoSlice { mips, layers, .. }) => Some(format!(
            "`mip` goes from 0 to {}, `layer` from 0 to {}",
            mips.saturating_sub(1),
            layers.saturating_sub(1)
        )),
        LaboratoryError::Render(RenderError::NoSample { samples, .. }) => Some(format!(
            "`sample` goes from 0 to {}; without it, it is the mean of all",
            samples.saturating_sub(1)
        )),
        LaboratoryError::Render(RenderError::NoStencil(_)) => Some(
            "the formats `depth24plus-stencil8` and `depth32float-stencil8` have stencil"
                .to_owned(),
        ),
        _ => None,
    };
    Mistake {
        message: error.to_string(),
        hint,
    }
}

/// The first mistake of a scene, a pipeline or a shader, with its place, and how many there are.
fn first_problem(Problems(problems): &Problems) -> Mistake {
    let Some(first) = problems.first() else {
        return Mistake::new("it can't be drawn");
    };
    // A problem without a line is one of what was asked for.
    let mut message = match first.place.line {
        0 => first.message.clone(),
        _ => format!("{}: {}", first.place, first.message),
    };
    match problems.len() {
        0 | 1 => {}
        2 => message.push_str(" (and one more)"),
        count => message.push_str(&format!(" (and {} more)", count - 1)),
    }
    Mistake {
        message,
        hint: first.hint.clone(),
    }
}
