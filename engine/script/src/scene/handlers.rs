//! The functions of a script that are called when something happens.

use lightbench_render::problem::suggestion;
use lightbench_render::{Place, Problem};
use lightbench_world::Entity;
use lightbench_world::glam::DVec3;
use rhai::{AST, Dynamic, Scope};

use crate::host::Host;

/// Something that a script is told of.
pub(super) enum Event {
    /// The entity has got the behaviour.
    Init,
    /// A step that ends at `time`, both in seconds.
    Update { time: f64, dt: f64 },
    /// A key went down.
    Key(String),
    /// An entity was clicked at a point in the world.
    Click(Entity, DVec3),
    /// Another behaviour, or the scene, sent something.
    Message(String, Dynamic),
}

/// How functions are named, and what each may take, in the order of [`Event`].
pub(super) type Forms = [(&'static str, &'static [&'static str]); 5];

/// The functions of a behaviour.
pub(super) const OF_BEHAVIOUR: Forms = [
    ("init", &[]),
    ("update", &["time", "dt"]),
    ("on_key", &["key"]),
    ("on_click", &["point"]),
    ("on_message", &["name", "value"]),
];

/// The functions of a scene's own script. What `init` would do stands outside of its functions.
pub(super) const OF_SCENE: Forms = [
    ("", &[]),
    ("update", &["time", "dt"]),
    ("on_key", &["key"]),
    ("on_click", &["entity", "point"]),
    ("on_message", &["name", "value"]),
];

impl Event {
    fn index(&self) -> usize {
        match self {
            Self::Init => 0,
            Self::Update { .. } => 1,
            Self::Key(_) => 2,
            Self::Click(..) => 3,
            Self::Message(..) => 4,
        }
    }

    /// The function that is called for it.
    pub(super) fn name(&self, forms: &Forms) -> &'static str {
        forms[self.index()].0
    }

    /// The arguments, under the names with which they are called.
    pub(super) fn scope(&self) -> Scope<'static> {
        let mut scope = Scope::new();
        match self {
            Self::Init => {}
            Self::Update { time, dt } => {
                scope.push("time", *time).push("dt", *dt);
            }
            Self::Key(key) => {
                scope.push("key", key.clone());
            }
            Self::Click(entity, point) => {
                scope.push("entity", *entity).push("point", *point);
            }
            Self::Message(name, value) => {
                scope.push("name", name.clone());
                scope.push_dynamic("value", value.clone());
            }
        }
        scope
    }
}

/// What calls the functions that a script has.
#[derive(Clone, Default)]
pub(super) struct Handlers([Option<AST>; 5]);

impl Handlers {
    /// Looks for the functions in a file that was read.
    pub(super) fn find(
        host: &Host,
        path: &str,
        module: &str,
        forms: &Forms,
    ) -> Result<Self, Problem> {
        let source = host.compiler.sources.get(path).unwrap_or_default();
        let mut found = Self::default();
        for (slot, (name, takes)) in found.0.iter_mut().zip(forms) {
            let Some(function) = source.functions.iter().find(|f| f.name == *name) else {
                continue;
            };
            let count = function.arguments.len();
            if count > takes.len() {
                let at = Place::new(path, function.line, function.column);
                let message = format!("`{name}` takes {count} arguments");
                let hint = format!("it is written `fn {name}({}) {{ … }}`", takes.join(", "));
                return Err(Problem::new(at, message)
                    .with_hint(hint)
                    .with_source(&source.text));
            }
            let mut scope = Scope::new();
            for argument in *takes {
                scope.push(*argument, ());
            }
            let call = format!("{module}::{name}({})", takes[..count].join(", "));
            // Without strictness: the module is registered after the file has run.
            let call = host
                .compile_loosely(&scope, &call)
                .map_err(|error| Problem::new(Place::file(path), error))?;
            *slot = Some(call);
        }
        warn_of_near_misses(host, path, forms);
        Ok(found)
    }

    /// Whether there is none at all.
    pub(super) fn is_empty(&self) -> bool {
        self.0.iter().all(Option::is_none)
    }

    pub(super) fn of(&self, event: &Event) -> Option<&AST> {
        self.0[event.index()].as_ref()
    }
}

/// Tells of functions whose names are almost those that are called, and which nobody calls.
fn warn_of_near_misses(host: &Host, path: &str, forms: &Forms) {
    let source = host.compiler.sources.get(path).unwrap_or_default();
    let known = || {
        forms
            .iter()
            .map(|(name, _)| *name)
            .filter(|name| !name.is_empty())
    };
    for function in &source.functions {
        let name = function.name.as_str();
        let calls = source.text.matches(&format!("{name}(")).count();
        if known().any(|known| known == name) || calls > 1 {
            continue;
        }
        let folded = name.to_lowercase();
        if let Some(hint) = suggestion(&folded, known()) {
            let at = Place::new(path, function.line, function.column);
            let text = format!("warning: nothing calls `{name}`: {hint}");
            host.log.add(at, text);
        }
    }
}
