//! `state`: what a script remembers from one update to the next, and where it asks for it, from before
//! a change of its file to after.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbench_world::glam::{DMat4, DQuat, DVec3};
use rhai::{Dynamic, Engine, FuncRegistration, ImmutableString, Map};

use crate::api::{Api, Mistake, ScriptType};
use crate::color::Color;

/// A map that every function of the script sees: `state.angle += 1.0;`.
#[derive(Clone, Debug, Default)]
pub(super) struct State(Arc<Mutex<Entries>>);

#[derive(Debug, Default)]
struct Entries {
    map: Map,
    /// The entries that are kept when the script is loaded again.
    kept: BTreeSet<ImmutableString>,
    /// What was kept by a load before, and nobody has asked for yet.
    before: Map,
}

/// What the scripts of a scene keep for when it is loaded again: the entries that they have named with
/// `state.keep`.
#[derive(Clone, Debug, Default)]
pub struct KeptState {
    pub(super) scene: Map,
    pub(super) behaviours: Vec<KeptBehaviour>,
}

/// What one behaviour keeps.
#[derive(Clone, Debug)]
pub(super) struct KeptBehaviour {
    /// The name of its entity.
    pub(super) entity: String,
    pub(super) script: String,
    pub(super) entries: Map,
}

impl ScriptType for State {
    const NAME: &'static str = "state";
}

impl State {
    /// An empty state, with what an earlier one kept.
    pub(super) fn with(before: Map) -> Self {
        Self(Arc::new(Mutex::new(Entries {
            before,
            ..Entries::default()
        })))
    }

    /// The entries that were to be kept, as far as they can be.
    pub(super) fn kept(&self) -> Map {
        let entries = self.lock();
        let values = entries.kept.iter().filter_map(|name| {
            let value = entries.map.get(name.as_str())?;
            is_lasting(value).then(|| (name.as_str().into(), value.clone()))
        });
        values.collect()
    }

    fn lock(&self) -> MutexGuard<'_, Entries> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What it holds, apart from the handle that scripts have.
    pub(super) fn contents(&self) -> Map {
        self.lock().map.clone()
    }

    /// Puts other contents behind the handle.
    pub(super) fn replace(&self, contents: Map) {
        self.lock().map = contents;
    }

    fn get(&self, name: &str) -> Result<Dynamic, Mistake> {
        let entries = self.lock();
        entries.map.get(name).cloned().ok_or_else(|| {
            let mistake = Mistake::new(format!("`state` has no entry `{name}` yet"));
            let known = entries.map.keys().map(|name| name.as_str());
            match lightbench_render::problem::suggestion(name, known) {
                Some(hint) => mistake.with_hint(hint),
                None => mistake.with_hint(format!(
                    "give it its first value outside of the functions: `state.{name} = …;`"
                )),
            }
        })
    }
}

/// Whether a value means the same after the script was loaded again: it stands for nothing in the world.
fn is_lasting(value: &Dynamic) -> bool {
    if let Some(items) = value.read_lock::<rhai::Array>() {
        return items.iter().all(is_lasting);
    }
    if let Some(map) = value.read_lock::<Map>() {
        return map.values().all(is_lasting);
    }
    value.is_unit()
        || value.is_bool()
        || value.is_int()
        || value.is_float()
        || value.is_string()
        || value.is_char()
        || value.is::<DVec3>()
        || value.is::<DQuat>()
        || value.is::<DMat4>()
        || value.is::<Color>()
}

pub(super) fn register(api: &mut Api) {
    api.object::<State>();
    api.method(
        "has(name)",
        "Whether there is an entry of that name.",
        |state: State, a| Ok(state.lock().map.contains_key(a.text(0)?.as_str())),
    );
    api.method(
        "keep(name, first)",
        "Gives an entry its first value, as `state.name = first` does, and keeps it when the script is saved and \
         loaded again: then the entry goes on with the value that it had. Kept are numbers, texts, `true` and \
         `false`, vectors, rotations, matrices, colours, and arrays and maps of them. Gives the value.",
        |state: State, a| {
            let name = a.text(0)?;
            let first = a.value(1).clone();
            if !is_lasting(&first) {
                return Err(Mistake::new(format!(
                    "`keep` can't keep {}: it belongs to this run alone",
                    a.describe(&first)
                ))
                .with_hint("keep what it is made of: a name, a number, an array of them"));
            }
            let mut entries = state.lock();
            let value = entries.before.remove(name.as_str()).unwrap_or(first);
            entries.kept.insert(name.as_str().into());
            entries.map.insert(name.as_str().into(), value.clone());
            Ok(value)
        },
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
                state.lock().map.insert(name.as_str().into(), value);
            },
        );
}
