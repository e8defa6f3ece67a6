//! Behaviours: scripts that belong to an entity, each with its own parameters and its own state.
//!
//! A behaviour is a file, `scripts/behaviours/NAME.rhai`. For each entity that has it, the file is run
//! once, when the entity gets it: that declares its parameters and gives its `state` first values. From
//! then on its functions are called: `init` once, `update` in each step, `on_key`, `on_click` and
//! `on_message` when something happens. All of them see the entity as `me`.

mod functions;
mod snapshot;

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use lightbench_render::Problem;
use lightbench_render::problem::Problems;
use lightbench_world::glam::DVec3;
use lightbench_world::{Behaviour, Entity, Name, Parameters, Value, World};
use rhai::{Dynamic, Module, Scope, Shared};

use super::data::{Data, Stage};
use super::handlers::{Event, Handlers, OF_BEHAVIOUR};
use super::state::{KeptBehaviour, State};
use crate::api::Mistake;
use crate::host::{Host, Variables};
use crate::parameters::{SceneParameter, undeclared};
use crate::settings::{SettingValue, Settings};
pub(super) use functions::register;
pub(super) use snapshot::BehavioursSnapshot;

/// The folder of the behaviours.
pub const BEHAVIOURS: &str = "scripts/behaviours";

/// What a behaviour's file declares while it runs.
#[derive(Default)]
pub(super) struct Starting {
    pub(super) settings: Settings,
    pub(super) parameters: Vec<SceneParameter>,
}

/// Messages that may wait for delivery: two behaviours that answer each broadcast with another would
/// double them in each step.
pub(super) const MOST_MESSAGES: usize = 10_000;

/// A message on its way.
#[derive(Clone, Debug)]
pub(super) struct Message {
    /// To whom; to all where there is none.
    pub(super) to: Option<Entity>,
    pub(super) name: String,
    pub(super) value: Dynamic,
}

/// The behaviour at work, as its functions see it.
#[derive(Clone, Default)]
pub(super) struct AtWork {
    now: Arc<Mutex<Option<(Entity, State)>>>,
    /// What the scene's own script remembers.
    scene: State,
}

impl AtWork {
    pub(super) fn new(scene: &State) -> Self {
        Self {
            now: Arc::default(),
            scene: scene.clone(),
        }
    }

    fn set(&self, now: Option<(Entity, State)>) {
        *self.now.lock().unwrap_or_else(PoisonError::into_inner) = now;
    }

    fn get(&self) -> Option<(Entity, State)> {
        let now = self.now.lock().unwrap_or_else(PoisonError::into_inner);
        now.clone()
    }

    /// `me`, and the `state` of a behaviour in place of the scene's.
    pub(super) fn variables(&self) -> Variables {
        let at_work = self.clone();
        Variables {
            names: vec!["me"],
            find: Box::new(move |name| match (name, at_work.get()) {
                ("me", Some((entity, _))) => Ok(Some(Dynamic::from(entity))),
                ("me", None) => Err(Mistake::new(
                    "`me` is the entity of a behaviour, and the scene's own script has none",
                )
                .with_hint(format!("behaviours lie in {BEHAVIOURS}/"))),
                ("state", Some((_, state))) => Ok(Some(Dynamic::from(state))),
                // Functions without a name see what is looked up, and no globals.
                ("state", None) => Ok(Some(Dynamic::from(at_work.scene.clone()))),
                _ => Ok(None),
            }),
        }
    }
}

/// A behaviour of one entity.
#[derive(Clone)]
struct Instance {
    entity: Entity,
    /// What the component said when it was started.
    component: Behaviour,
    parameters: Vec<SceneParameter>,
    state: State,
    handlers: Handlers,
    slot: usize,
    /// Its functions, as they are registered under the name of the slot.
    module: Option<Shared<Module>>,
    /// After an error it is not called again.
    stopped: bool,
    /// Whether its entity still has it; for [`Behaviours::start_and_end`].
    goes_on: bool,
}

/// What somebody outside sees of a behaviour.
#[derive(Clone, Debug, PartialEq)]
pub struct BehaviourInfo {
    /// The entity that has it.
    pub entity: Entity,
    /// The path of its file.
    pub path: String,
    /// What can be set, with the values in force.
    pub parameters: Vec<SceneParameter>,
    /// Whether an error stopped it.
    pub stopped: bool,
}

/// The behaviours of a scene, in the order in which they were started.
#[derive(Default)]
pub(super) struct Behaviours {
    instances: Vec<Instance>,
    /// Where the behaviour of each entity is.
    places: HashMap<Entity, usize>,
    at_work: AtWork,
    /// Modules that no instance uses any more.
    free: Vec<usize>,
    slots: usize,
    /// Errors that nobody has been told of yet.
    problems: Vec<Problem>,
}

impl Behaviours {
    pub(super) fn new(at_work: AtWork) -> Self {
        Self {
            at_work,
            ..Self::default()
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.instances.is_empty()
    }

    pub(super) fn list(&self) -> Vec<BehaviourInfo> {
        let info = |instance: &Instance| BehaviourInfo {
            entity: instance.entity,
            path: instance.component.script.clone(),
            parameters: instance.parameters.clone(),
            stopped: instance.stopped,
        };
        self.instances.iter().map(info).collect()
    }

    /// Whether one of them hears keys.
    pub(super) fn hear_keys(&self) -> bool {
        let key = Event::Key(String::new());
        let hears = |instance: &Instance| !instance.stopped && instance.handlers.of(&key).is_some();
        self.instances.iter().any(hears)
    }

    /// The next error that nobody has been told of.
    pub(super) fn take_problem(&mut self) -> Option<Problem> {
        (!self.problems.is_empty()).then(|| self.problems.remove(0))
    }

    /// One step: starts what is new, ends what is gone, tells what happened, and updates all.
    pub(super) fn step(
        &mut self,
        host: &mut Host,
        stage: &Stage,
        happened: &[Event],
        time: f64,
        dt: f64,
    ) {
        self.start_and_end(host, stage);
        for event in happened {
            match event {
                Event::Click(entity, _) => {
                    if let Some(heard) = self.nearest(stage, *entity) {
                        self.tell(host, stage, heard, event);
                    }
                }
                _ => self.tell_all(host, stage, event),
            }
        }
        self.tell_all(host, stage, &Event::Update { time, dt });
    }

    /// The entity, or the nearest above it, whose behaviour hears clicks: a door is made of parts.
    fn nearest(&self, stage: &Stage, entity: Entity) -> Option<Entity> {
        let hears = |entity: &Entity| {
            let instance = self.places.get(entity).map(|&at| &self.instances[at]);
            let click = Event::Click(*entity, DVec3::ZERO);
            instance.is_some_and(|instance| instance.handlers.of(&click).is_some())
        };
        let data = stage.lock();
        std::iter::successors(Some(entity), |entity| data.world.parent(*entity)).find(hears)
    }

    /// Delivers messages to the behaviours that they are for.
    pub(super) fn deliver(
        &mut self,
        host: &Host,
        stage: &Stage,
        to: Option<Entity>,
        event: &Event,
    ) {
        match to {
            Some(entity) => self.tell(host, stage, entity, event),
            None => self.tell_all(host, stage, event),
        }
    }

    /// What the behaviours keep for when they are loaded again, by the names of their entities.
    pub(super) fn kept(&self, world: &World) -> Vec<KeptBehaviour> {
        let kept = self.instances.iter().filter_map(|instance| {
            let entries = instance.state.kept();
            let name = world.get::<Name>(instance.entity)?;
            (!entries.is_empty()).then(|| KeptBehaviour {
                entity: name.text,
                script: instance.component.script.clone(),
                entries,
            })
        });
        kept.collect()
    }

    /// Starts the behaviours of entities that have got one, and ends those of entities that lost it,
    /// or have another now. In a step in which nothing changed it takes no memory.
    pub(super) fn start_and_end(&mut self, host: &mut Host, stage: &Stage) {
        let mut begun = Vec::new();
        {
            let data = stage.lock();
            let columns = data.world.columns::<Behaviour>();
            let rows = columns.slices();
            let mut going_on = 0;
            for instance in &mut self.instances {
                instance.goes_on = false;
            }
            for (row, &entity) in columns.entities().iter().enumerate() {
                let (script, parameters) = (&rows.script[row], &rows.parameters[row]);
                let known = self.places.get(&entity).map(|&at| &mut self.instances[at]);
                let is_same = |instance: &&mut Instance| {
                    let component = &instance.component;
                    component.script == *script && component.parameters == *parameters
                };
                match known.filter(is_same) {
                    Some(instance) => {
                        instance.component.enabled = rows.enabled[row];
                        instance.goes_on = true;
                        going_on += 1;
                    }
                    None => {
                        let component = Behaviour {
                            script: script.clone(),
                            parameters: parameters.clone(),
                            enabled: rows.enabled[row],
                        };
                        begun.push((entity, component));
                    }
                }
            }
            if going_on < self.instances.len() {
                let free = &mut self.free;
                self.instances.retain(|instance| {
                    if !instance.goes_on {
                        free.push(instance.slot);
                    }
                    instance.goes_on
                });
                let places = self.instances.iter().enumerate();
                self.places = places.map(|(at, one)| (one.entity, at)).collect();
            }
        }
        for (entity, component) in begun {
            let slot = self.free.pop().unwrap_or_else(|| {
                self.slots += 1;
                self.slots - 1
            });
            let state = stage.lock().take_kept(entity, &component.script);
            let mut instance = Instance {
                entity,
                component,
                parameters: Vec::new(),
                state,
                handlers: Handlers::default(),
                slot,
                module: None,
                stopped: false,
                goes_on: true,
            };
            if let Err(problems) = self.start(host, stage, &mut instance) {
                // It stays, so that it is not tried again until it changes.
                instance.stopped = true;
                self.problems.extend(problems.0);
            }
            self.places.insert(entity, self.instances.len());
            self.instances.push(instance);
            self.tell(host, stage, entity, &Event::Init);
        }
    }

    /// Runs a behaviour's file for an entity.
    fn start(
        &self,
        host: &mut Host,
        stage: &Stage,
        instance: &mut Instance,
    ) -> Result<(), Problems> {
        let path = &instance.component.script;
        let settings = settings(&instance.component.parameters);
        let ast = host.load(path)?;
        let module = module_of(instance.slot);
        instance.handlers = Handlers::find(host, path, &module, &OF_BEHAVIOUR)?;
        stage.lock().starting = Some(Starting {
            settings: settings.clone(),
            parameters: Vec::new(),
        });
        let now = (instance.entity, instance.state.clone());
        self.at_work.set(Some(now));
        host.watch.start(host.compiler.limits.load_time);
        let made = Module::eval_ast_as_new(Scope::new(), &ast, &host.engine);
        self.at_work.set(None);
        let starting = stage.lock().starting.take().unwrap_or_default();
        let made = made.map_err(|error| host.compiler.explain(&error, path))?;
        let problems = undeclared("behaviour", path, &starting.parameters, &settings);
        if !problems.is_empty() {
            return Err(Problems(problems));
        }
        instance.parameters = starting.parameters;
        let made: Shared<Module> = made.into();
        instance.module = Some(made.clone());
        host.engine.register_static_module(module, made);
        Ok(())
    }

    fn tell_all(&mut self, host: &Host, stage: &Stage, event: &Event) {
        for index in 0..self.instances.len() {
            self.call(host, stage, index, event);
        }
    }

    fn tell(&mut self, host: &Host, stage: &Stage, entity: Entity, event: &Event) {
        if let Some(&index) = self.places.get(&entity) {
            self.call(host, stage, index, event);
        }
    }

    /// Calls a behaviour's function for an event, where it has one. An error stops this behaviour and
    /// no other.
    fn call(&mut self, host: &Host, stage: &Stage, index: usize, event: &Event) {
        let instance = &mut self.instances[index];
        if instance.stopped || !instance.component.enabled {
            return;
        }
        let Some(call) = instance.handlers.of(event) else {
            return;
        };
        // One that a behaviour before it has removed.
        if !stage.lock().world.contains(instance.entity) {
            return;
        }
        let now = (instance.entity, instance.state.clone());
        self.at_work.set(Some(now));
        host.watch.start(host.compiler.limits.update_time);
        let result = host
            .engine
            .eval_ast_with_scope::<Dynamic>(&mut event.scope(), call);
        self.at_work.set(None);
        if let Err(error) = result {
            instance.stopped = true;
            let path = &instance.component.script;
            self.problems.push(host.compiler.explain(&error, path));
        }
    }

    /// Sets a parameter of an entity's behaviour, which starts it again.
    pub(super) fn set_parameter(
        &self,
        data: &mut Data,
        entity: Entity,
        name: &str,
        value: &SettingValue,
    ) -> Result<(), String> {
        let instance = self.places.get(&entity).map(|&at| &self.instances[at]);
        let instance = instance.ok_or("the entity has no behaviour")?;
        let parameter = instance.parameters.iter().find(|p| p.name == name);
        let parameter = parameter.ok_or_else(|| format!("there is no parameter `{name}`"))?;
        let value = parameter.parse(value)?;
        let mut component = instance.component.clone();
        let values = &mut component.parameters.0;
        let value = match value {
            SettingValue::Text(text) => Value::Text(text),
            SettingValue::Number(number) => Value::Float(number as f32),
            SettingValue::Switch(on) => Value::Bool(on),
        };
        match values.iter_mut().find(|(known, _)| known == name) {
            Some((_, old)) => *old = value,
            None => values.push((name.to_owned(), value)),
        }
        data.insert(entity, component)
            .map_err(|mistake| mistake.message)
    }
}

/// The name of the module of a slot.
fn module_of(slot: usize) -> String {
    format!("behaviour_{slot}")
}

/// The component's values as settings.
fn settings(parameters: &Parameters) -> Settings {
    let mut settings = Settings::new();
    for (name, value) in &parameters.0 {
        match value {
            Value::Bool(on) => settings.set(name, *on),
            Value::Int(number) => settings.set(name, *number as f64),
            // As it is written, and not with the digits that 32 bits add.
            Value::Float(number) => settings.set(name, number.to_string()),
            Value::Text(text) => settings.set(name, text.clone()),
            _ => {}
        }
    }
    settings
}

#[cfg(test)]
mod tests;
