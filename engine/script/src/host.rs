//! A Rhai engine made safe: limits, project files, messages, a log.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::Duration;

use lightbench_assets::cache::Reuse;
use lightbench_assets::files::Files;
use lightbench_render::problem::suggestion;
use lightbench_render::{Place, Problem};
use rhai::{
    AST, Dynamic, Engine, EvalAltResult, ImmutableString, Module, ModuleResolver, Scope, Token,
};

use crate::api::{Api, Mistake, place};
use crate::compile::Compiler;
use crate::limits::{self, Limits, Watch};
use crate::log::Log;
use crate::names::Names;
use crate::resolver::Resolver;
use crate::sources::Sources;
use crate::{color, division, easing, math, matrix, noise, random};

/// An engine with the functions of one kind of script, and what it needs to run and to explain.
pub(crate) struct Host {
    pub(crate) engine: Engine,
    pub(crate) compiler: Arc<Compiler>,
    pub(crate) watch: Arc<Watch>,
    pub(crate) log: Log,
    /// The random numbers that its scripts take.
    pub(crate) rows: random::Rows,
    resolver: Arc<Resolver>,
    files: Files,
}

/// What a kind of script has beyond mathematics.
pub(crate) struct Extras<'a> {
    /// Registers its functions.
    pub(crate) register: &'a mut dyn FnMut(&mut Api, &Arc<Watch>, &Log),
    /// Its global variables.
    pub(crate) globals: Vec<(&'static str, Dynamic)>,
    /// Variables whose values depend on who asks, before those.
    pub(crate) variables: Variables,
    /// Where compiled files are kept.
    pub(crate) reuse: Reuse,
}

/// Looks a variable up: `None` where it is none of these.
type FindVariable = dyn Fn(&str) -> Result<Option<Dynamic>, Mistake> + Send + Sync;

/// Variables that are looked up when they are read.
pub(crate) struct Variables {
    pub(crate) names: Vec<&'static str>,
    pub(crate) find: Box<FindVariable>,
}

impl Default for Variables {
    fn default() -> Self {
        Self {
            names: Vec::new(),
            find: Box::new(|_| Ok(None)),
        }
    }
}

impl Host {
    pub(crate) fn new(files: &Files, limits: &Limits, extras: Extras) -> Self {
        let mut engine = Engine::new();
        let watch = Watch::new(limits);
        limits::apply(&mut engine, limits, &watch);
        engine.set_strict_variables(true);
        engine.set_fail_on_invalid_map_property(true);
        let log = Log::default();
        listen(&mut engine, &log);
        map_words(&mut engine);
        take_away(&mut engine);
        division::take_over(&mut engine, &log);
        let mut globals = extras.variables.names;
        find_variables(&mut engine, extras.variables.find);

        let mut names = Names::default();
        for signature in builtin_signatures(&engine) {
            names.add_builtin(signature);
        }
        let mut api = Api::new(&mut engine, &mut names);
        math::register(&mut api);
        matrix::register(&mut api);
        easing::register(&mut api);
        division::register(&mut api);
        color::register(&mut api);
        let rows = random::register(&mut api);
        noise::register(&mut api);
        (extras.register)(&mut api, &watch, &log);

        let mut module = Module::new();
        for (name, value) in extras.globals {
            module.set_var(name, value);
            globals.push(name);
        }
        engine.register_global_module(module.into());

        let compiler = Compiler {
            names,
            sources: Sources::default(),
            limits: limits.clone(),
            globals,
            reuse: extras.reuse,
        }
        .shared();
        let resolver = Arc::new(Resolver::new(files.clone()));
        resolver.set_compiler(Arc::clone(&compiler));
        engine.set_module_resolver(SharedResolver(Arc::clone(&resolver)));
        Self {
            engine,
            compiler,
            watch,
            log,
            rows,
            resolver,
            files: files.clone(),
        }
    }

    /// Reads and compiles a file.
    pub(crate) fn load(&self, path: &str) -> Result<Arc<AST>, Problem> {
        let text = self
            .files
            .read_text(path)
            .map_err(|error| Problem::new(Place::file(path), error.to_string()))?;
        self.compile(path, &text)
    }

    /// Lets the imports that follow come from that file.
    pub(crate) fn begin(&self, path: &str) {
        self.resolver.begin(path);
    }

    /// Compiles a text as if it were that file.
    pub(crate) fn compile(&self, path: &str, text: &str) -> Result<Arc<AST>, Problem> {
        self.resolver.begin(path);
        self.compiler
            .compile(&self.engine, path, text)
            .map_err(|error| self.compiler.explain(&error, path))
    }

    /// Runs a file and gives its value.
    pub(crate) fn run(&self, ast: &AST, path: &str, time: Duration) -> Result<Dynamic, Problem> {
        self.watch.start(time);
        self.engine
            .eval_ast_with_scope::<Dynamic>(&mut Scope::new(), ast)
            .map_err(|error| self.compiler.explain(&error, path))
    }

    /// Compiles a text of the program's own, whose names are known when it runs.
    pub(crate) fn compile_loosely(&self, scope: &Scope, text: &str) -> Result<AST, String> {
        let mut engine = Engine::new_raw();
        engine.set_strict_variables(false);
        engine
            .compile_with_scope(scope, text)
            .map_err(|error| error.to_string())
    }
}

/// The file that a name or a path means: `atrium` is `scripts/scenes/atrium.rhai`.
pub(crate) fn find(files: &Files, folder: &str, name_or_path: &str) -> Result<String, Problem> {
    let asked = name_or_path.trim();
    let is_path = asked.contains('/') || asked.ends_with(".rhai") || asked.ends_with(".scene");
    let path = if is_path {
        asked.to_owned()
    } else {
        format!("{folder}/{asked}.rhai")
    };
    let Err(error) = files.origin(&path) else {
        return Ok(path);
    };
    if is_path || asked.is_empty() {
        return Err(Problem::new(Place::file(path), error.to_string()));
    }
    let kind = folder
        .rsplit('/')
        .next()
        .unwrap_or(folder)
        .trim_end_matches('s');
    let known = stems(files, folder);
    let mut problem = Problem::new(Place::file(path), format!("there is no {kind} `{asked}`"));
    let known = || known.iter().map(String::as_str);
    problem.hint = suggestion(asked, known()).or_else(|| {
        let all = crate::names::list(known(), "and");
        (!all.is_empty()).then(|| format!("there are {all}"))
    });
    Err(problem)
}

/// The names of the scripts directly in a folder.
pub(crate) fn stems(files: &Files, folder: &str) -> Vec<String> {
    let listed = files.list(folder, "rhai").unwrap_or_default();
    listed
        .iter()
        .filter_map(|file| stem_in(folder, &file.path))
        .map(str::to_owned)
        .collect()
}

/// The name of a script, if it lies directly in the folder.
pub(crate) fn stem_in<'a>(folder: &str, path: &'a str) -> Option<&'a str> {
    let name = path.strip_prefix(folder)?.strip_prefix('/')?;
    let stem = name.strip_suffix(".rhai")?;
    (!stem.contains('/')).then_some(stem)
}

/// The signatures of Rhai's own functions. To list them takes as long as to make an engine, and they
/// are the same in all of them.
fn builtin_signatures(engine: &Engine) -> &'static [String] {
    static SIGNATURES: OnceLock<Vec<String>> = OnceLock::new();
    SIGNATURES.get_or_init(|| engine.gen_fn_signatures(true))
}

/// Sends `print` and `debug` to the log, with their places.
fn listen(engine: &mut Engine, log: &Log) {
    // Rhai hands the printed text over without its place; only functions are told theirs. So each
    // kind of value gets its own `print`, and what Rhai prints after it is dropped.
    engine.on_print(|_| {});
    let print = |engine: &mut Engine, kind: std::any::TypeId| {
        let log = log.clone();
        engine.register_raw_fn("print", [kind], move |context, values| {
            let value: &Dynamic = values[0];
            let text = context
                .call_native_fn::<ImmutableString>("to_string", (value.clone(),))
                .unwrap_or_else(|_| value.to_string().into());
            let at = place(context.call_source(), context.call_position());
            log.add(at, text.to_string());
            Ok(ImmutableString::new())
        });
    };
    use std::any::TypeId;
    for kind in [
        TypeId::of::<ImmutableString>(),
        TypeId::of::<i64>(),
        TypeId::of::<f64>(),
        TypeId::of::<bool>(),
        TypeId::of::<char>(),
        TypeId::of::<()>(),
        TypeId::of::<rhai::Array>(),
        TypeId::of::<rhai::Map>(),
        TypeId::of::<rhai::FnPtr>(),
        TypeId::of::<Dynamic>(),
    ] {
        print(engine, kind);
    }
    let log = log.clone();
    engine.on_debug(move |text, source, position| {
        log.add(place(source, position), text.to_owned());
    });
}

/// Takes away what Rhai brings and a scene must not have: it waits, or differs from run to run.
fn take_away(engine: &mut Engine) {
    engine.disable_symbol("eval");
    let no_clock = || -> Result<Dynamic, Box<EvalAltResult>> {
        Err(
            Mistake::new("scripts have no clock, so that every run is the same")
                .with_hint("`fn update(time, dt)` of a scene is given the time, and `measure` of an experiment tells what a frame costs")
                .into(),
        )
    };
    engine
        .register_fn("timestamp", no_clock)
        .register_fn("sleep", move |_: i64| no_clock())
        .register_fn("sleep", move |_: f64| no_clock());
}

/// Lets scripts use words that Rhai keeps for itself: `spawn(…)`, and `.switch(…)` and `.with(…)` after
/// a dot.
fn map_words(engine: &mut Engine) {
    let after_dot = AtomicBool::new(false);
    #[allow(deprecated)] // Rhai marks what may still change so; nothing is going away.
    engine.on_parse_token(move |token, _, _| {
        let was_after_dot = after_dot.swap(
            matches!(token, Token::Period | Token::Elvis),
            Ordering::Relaxed,
        );
        match token {
            Token::Reserved(word) if *word == "spawn" => Token::Identifier(word),
            Token::Reserved(word) if *word == "with" && was_after_dot => Token::Identifier(word),
            Token::Switch if was_after_dot => Token::Identifier(Box::new("switch".into())),
            token => token,
        }
    });
}

/// Lets functions see the constants of their file, which Rhai hides behind `global::`, and what `find`
/// knows.
fn find_variables(engine: &mut Engine, find: Box<FindVariable>) {
    #[allow(deprecated)] // Rhai marks what may still change so; nothing is going away.
    engine.on_var(move |name, index, context| {
        // A variable with an index was found when the file was compiled.
        if index > 0 {
            return Ok(None);
        }
        if context.scope().contains(name) {
            return Ok(None);
        }
        if let Some(value) = find(name)? {
            return Ok(Some(value));
        }
        let Some(constants) = &context.global_runtime_state().constants else {
            return Ok(None);
        };
        let constants = constants
            .read()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        Ok(constants.get(name).cloned())
    });
}

struct SharedResolver(Arc<Resolver>);

impl ModuleResolver for SharedResolver {
    fn resolve(
        &self,
        engine: &Engine,
        source: Option<&str>,
        path: &str,
        position: rhai::Position,
    ) -> Result<rhai::Shared<Module>, Box<EvalAltResult>> {
        self.0.resolve(engine, source, path, position)
    }

    fn resolve_raw(
        &self,
        engine: &Engine,
        global: &mut rhai::GlobalRuntimeState,
        scope: &mut Scope,
        path: &str,
        position: rhai::Position,
    ) -> Result<rhai::Shared<Module>, Box<EvalAltResult>> {
        self.0.resolve_raw(engine, global, scope, path, position)
    }
}
