//! A scene's own script: the functions that it has for what happens.

use lightbench_render::{Place, Problem};
use rhai::{Dynamic, EvalAltResult};

use super::handlers::{Event, Handlers, OF_SCENE};
use crate::host::Host;

/// The functions of a scene's script that are called while it runs.
#[derive(Default)]
pub(super) struct OwnScript {
    handlers: Handlers,
    /// Whether one of them failed; the script is not called again.
    pub(super) stopped: bool,
}

impl OwnScript {
    /// Looks for the functions in a file that was read, and will be called through a module.
    pub(super) fn find(host: &Host, path: &str, module: &str) -> Result<Self, Problem> {
        Ok(Self {
            handlers: Handlers::find(host, path, module, &OF_SCENE)?,
            stopped: false,
        })
    }

    /// Whether it hears keys.
    pub(super) fn hears_keys(&self) -> bool {
        !self.stopped && self.handlers.of(&Event::Key(String::new())).is_some()
    }

    /// Whether it is called while the scene runs.
    pub(super) fn runs(&self) -> bool {
        !self.stopped && !self.handlers.is_empty()
    }

    /// Calls the function for an event, where there is one. After an error none is called any more.
    pub(super) fn call(&mut self, host: &Host, path: &str, event: &Event) -> Result<(), Problem> {
        let Some(call) = self.handlers.of(event).filter(|_| !self.stopped) else {
            return Ok(());
        };
        host.watch.start(host.compiler.limits.update_time);
        let result = host
            .engine
            .eval_ast_with_scope::<Dynamic>(&mut event.scope(), call);
        match result {
            Ok(_) => Ok(()),
            Err(error) => {
                self.stopped = true;
                Err(explain(host, path, event, &error))
            }
        }
    }
}

fn explain(host: &Host, path: &str, event: &Event, error: &EvalAltResult) -> Problem {
    let compiler = &host.compiler;
    let problem = compiler.explain(error, path);
    // A limit that is hit inside knows only the place of the outermost call, which is ours.
    let inside = matches!(error, EvalAltResult::ErrorInFunctionCall(..));
    let source = compiler.sources.get(path).unwrap_or_default();
    let name = event.name(&OF_SCENE);
    match source.functions.iter().find(|f| f.name == name) {
        Some(function) if !inside => {
            let at = Place::new(path, function.line, function.column);
            Problem {
                place: at,
                ..problem
            }
            .with_source(&source.text)
        }
        _ => problem,
    }
}
