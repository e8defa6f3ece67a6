//! `state`: what a script remembers from one update to the next.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rhai::{Dynamic, Engine, FuncRegistration, ImmutableString, Map};

use crate::api::{Api, Mistake, ScriptType};

/// A map that every function of the script sees: `state.angle += 1.0;`.
#[derive(Clone, Debug, Default)]
pub(super) struct State(Arc<Mutex<Map>>);

impl ScriptType for State {
    const NAME: &'static str = "state";
}

impl State {
    fn lock(&self) -> MutexGuard<'_, Map> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What it holds, apart from the handle that scripts have.
    pub(super) fn contents(&self) -> Map {
        self.lock().clone()
    }

    /// Puts other contents behind the handle.
    pub(super) fn replace(&self, contents: Map) {
        *self.lock() = contents;
    }

    fn get(&self, name: &str) -> Result<Dynamic, Mistake> {
        let map = self.lock();
        map.get(name).cloned().ok_or_else(|| {
            let mistake = Mistake::new(format!("`state` has no entry `{name}` yet"));
            let known = map.keys().map(|name| name.as_str());
            match lightbench_render::problem::suggestion(name, known) {
                Some(hint) => mistake.with_hint(hint),
                None => mistake.with_hint(format!(
                    "give it its first value outside of the functions: `state.{name} = …;`"
                )),
            }
        })
    }
}

pub(super) fn register(api: &mut Api) {
    api.object::<State>();
    api.method(
        "has(name)",
        "Whether there is an entry of that name.",
        |state: State, a| Ok(state.lock().contains_key(a.text(0)?.as_str())),
    );
    index(api.engine());
}

/// `state.name` and `state["name"]`, to read and to write. Pure, because the map behind the handle
/// changes and not the handle.
fn index(engine: &mut Engine) {
    FuncRegistration::new_index_getter().register_into_engine(
        engine,
        |state: &mut State, name: ImmutableString| {
            state.get(&name).map_err(Box::<rhai::EvalAltResult>::from)
        },
    );
    FuncRegistration::new_index_setter()
        .with_purity(true)
        .register_into_engine(
            engine,
            |state: &mut State, name: ImmutableString, value: Dynamic| {
                state.lock().insert(name.as_str().into(), value);
            },
        );
}
