//! `import`: finds other scripts of the project, and nothing else.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use lightbench_assets::files::{Files, join};
use lightbench_render::problem::suggestion;
use rhai::{
    Dynamic, Engine, EvalAltResult, GlobalRuntimeState, Module, ModuleResolver, Position, Scope,
    Shared,
};

use crate::api::Mistake;
use crate::compile::Compiler;

/// The folder from which every script may import by the same path.
const SCRIPTS: &str = "scripts";

type Fallible<T> = Result<T, Box<EvalAltResult>>;

/// Resolves `import "path"`: relative to the importing file's folder first, then to `scripts/`.
///
/// Paths can't leave the project; [`Files`] sees to that for every layer.
pub(crate) struct Resolver {
    files: Files,
    /// Known once the engine is complete.
    compiler: OnceLock<Arc<Compiler>>,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    loaded: BTreeMap<String, Shared<Module>>,
    /// The files that are being loaded, outermost first.
    loading: Vec<String>,
}

impl Resolver {
    pub(crate) fn new(files: Files) -> Self {
        Self {
            files,
            compiler: OnceLock::new(),
            state: Mutex::default(),
        }
    }

    pub(crate) fn set_compiler(&self, compiler: Arc<Compiler>) {
        // A second call could only come from a second host of the same engine; the first stays.
        let _ = self.compiler.set(compiler);
    }

    /// Begins a run: `path` is what everything else is imported from.
    pub(crate) fn begin(&self, path: &str) {
        let mut state = self.state();
        state.loaded.clear();
        state.loading = vec![path.to_owned()];
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The path of the file that is meant.
    fn find(&self, importer: &str, asked: &str) -> Result<String, Mistake> {
        let file = if asked.ends_with(".rhai") {
            asked.to_owned()
        } else {
            format!("{asked}.rhai")
        };
        let mut refused = None;
        for base in [importer, &format!("{SCRIPTS}/file")] {
            match join(base, &file) {
                Ok(path) if self.files.exists(&path) => return Ok(path),
                Ok(path) => {
                    // A file that is there but may not be read says why.
                    if let Err(error) = self.files.origin(&path)
                        && !matches!(error, lightbench_assets::files::FileError::NotFound { .. })
                    {
                        refused = refused.or(Some(error));
                    }
                }
                Err(error) => refused = refused.or(Some(error)),
            }
        }
        if let Some(error) = refused {
            return Err(Mistake::new(format!(
                "`{asked}` can't be imported: {error}"
            )));
        }
        let mistake = Mistake::new(format!("there is no script `{asked}` to import"));
        let known = self.importable(importer);
        // The right file by a wrong way is commoner than a slip of the finger.
        let file = |path: &str| path.rsplit('/').next().unwrap_or(path).to_owned();
        let mut same = known.iter().filter(|path| file(path) == file(asked));
        let same = same.next().map(|path| format!("did you mean `{path}`?"));
        match same.or_else(|| suggestion(asked, known.iter().map(String::as_str))) {
            Some(hint) => Err(mistake.with_hint(hint)),
            None => Err(mistake
                .with_hint("paths start at the folder of the importing file, or at `scripts/`")),
        }
    }

    /// What the importer could have asked for, for suggestions.
    fn importable(&self, importer: &str) -> Vec<String> {
        let folder = importer.rsplit_once('/').map_or("", |(folder, _)| folder);
        let listed = self.files.list(SCRIPTS, "rhai").unwrap_or_default();
        let mut known = Vec::new();
        for file in listed {
            let stem = file.path.trim_end_matches(".rhai");
            for base in [folder, SCRIPTS] {
                if let Some(below) = stem.strip_prefix(base).and_then(|s| s.strip_prefix('/')) {
                    known.push(below.to_owned());
                }
            }
        }
        known
    }

    fn load(
        &self,
        engine: &Engine,
        global: &mut GlobalRuntimeState,
        path: &str,
    ) -> Fallible<Shared<Module>> {
        let Some(compiler) = self.compiler.get() else {
            return Err("scripts can't be imported here".into());
        };
        // What goes wrong inside is explained here, where the imported file is known.
        let explained = |error: Box<EvalAltResult>| {
            let problem = compiler.explain(&error, path);
            EvalAltResult::ErrorRuntime(Dynamic::from(problem), Position::NONE)
        };
        let text = self
            .files
            .read_text(path)
            .map_err(|error| Mistake::new(error.to_string()))?;
        let ast = compiler.compile(engine, path, &text).map_err(explained)?;
        // An empty scope: an imported file does not see the variables of the importing one.
        let module = Module::eval_ast_as_new_raw(engine, &mut Scope::new(), global, &ast)
            .map_err(explained)?;
        Ok(module.into())
    }
}

impl ModuleResolver for Resolver {
    fn resolve(
        &self,
        engine: &Engine,
        source: Option<&str>,
        path: &str,
        position: Position,
    ) -> Fallible<Shared<Module>> {
        let mut global = engine.new_global_runtime_state();
        global.source = source.map(Into::into);
        self.resolve_raw(engine, &mut global, &mut Scope::new(), path, position)
    }

    fn resolve_raw(
        &self,
        engine: &Engine,
        global: &mut GlobalRuntimeState,
        _scope: &mut Scope,
        asked: &str,
        position: Position,
    ) -> Fallible<Shared<Module>> {
        let importer = global.source().unwrap_or_default().to_owned();
        let path = match self.find(&importer, asked) {
            Ok(path) => path,
            Err(mistake) => return Err(at(mistake, position)),
        };
        {
            let mut state = self.state();
            if let Some(module) = state.loaded.get(&path) {
                return Ok(module.clone());
            }
            let cycle = state.loading.iter().position(|loading| *loading == path);
            if let Some(first) = cycle {
                let mut round: Vec<&str> = state
                    .loading
                    .iter()
                    .skip(first)
                    .map(String::as_str)
                    .collect();
                round.push(&path);
                let round = round.join(" imports ");
                return Err(at(
                    Mistake::new(format!("the imports go round in a circle: {round}"))
                        .with_hint("move what both need into a third file"),
                    position,
                ));
            }
            let limit = engine.max_modules();
            if state.loaded.len() + state.loading.len() >= limit {
                return Err(EvalAltResult::ErrorTooManyModules(position).into());
            }
            state.loading.push(path.clone());
        }
        let result = self.load(engine, global, &path);
        let mut state = self.state();
        state.loading.pop();
        let module = result.map_err(|mut error| {
            if error.position().is_none() {
                error.set_position(position);
            }
            error
        })?;
        state.loaded.insert(path, module.clone());
        Ok(module)
    }
}

fn at(mistake: Mistake, position: Position) -> Box<EvalAltResult> {
    EvalAltResult::ErrorRuntime(Dynamic::from(mistake), position).into()
}
