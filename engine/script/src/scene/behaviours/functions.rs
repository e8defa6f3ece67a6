//! What scripts call to give entities behaviours, and to send messages.

use lightbench_world::{Behaviour, Entity, Parameters, Value};
use rhai::Dynamic;

use super::super::data::{Data, Stage};
use super::super::entities::method;
use super::{BEHAVIOURS, MOST_MESSAGES, Message};
use crate::api::{Api, Arguments, Mistake, as_number};
use crate::host::find;

pub(crate) fn register(api: &mut Api, stage: &Stage) {
    api.section("Behaviours and messages");
    let about = "Gives the entity a behaviour: a script of its own, `scripts/behaviours/NAME.rhai` or a \
                 path, with values for its parameters. The script sees the entity as `me` and has its \
                 own `state`; its functions `init()`, `update(time, dt)`, `on_key(key)`, \
                 `on_click(point)` and `on_message(name, value)` are called. A click on a part goes \
                 to the nearest entity above it that hears clicks. A path begins in the \
                 project's folder, as in `scripts/behaviours/spin.rhai`. An entity has one \
                 behaviour; another takes its place.";
    for form in ["behave(name)", "behave(name, values)"] {
        method(api, stage, form, about, |data, entity, a| {
            let path = find(&data.files, BEHAVIOURS, &a.text(0)?)?;
            let behaviour = Behaviour {
                script: path,
                parameters: parameters(a)?,
                enabled: true,
            };
            data.insert(entity, behaviour)
        });
    }
    let about =
        "Lets the entity's behaviour run, or rest: then it keeps its state and is told nothing.";
    method(api, stage, "behaving(on)", about, |data, entity, a| {
        let mut behaviour: Behaviour = data.get(entity, "thing with a behaviour")?;
        behaviour.enabled = a.switch(0)?;
        data.insert(entity, behaviour)
    });
    let about = "Sends a message to the entity's behaviour, whose `on_message(name, value)` is called \
                 after all behaviours of this step were updated. Without a value it gets `()`.";
    for form in ["send(name)", "send(name, value)"] {
        let stage = stage.clone();
        api.method(form, about, move |entity: Entity, a| {
            let message = message(Some(entity), a)?;
            let mut data = stage.lock();
            data.check(entity)?;
            post(&mut data, message)?;
            Ok(entity)
        });
    }
    let about = "Sends a message to the behaviours of all entities.";
    for form in ["broadcast(name)", "broadcast(name, value)"] {
        let stage = stage.clone();
        api.function(form, about, move |a| {
            let message = message(None, a)?;
            post(&mut stage.lock(), message)
        });
    }
}

fn post(data: &mut Data, message: Message) -> Result<(), Mistake> {
    if data.messages.len() >= MOST_MESSAGES {
        return Err(Mistake::new(format!(
            "more than {MOST_MESSAGES} messages wait: does each answer to a message send others?"
        )));
    }
    data.messages.push(message);
    Ok(())
}

fn message(to: Option<Entity>, a: &Arguments) -> Result<Message, Mistake> {
    Ok(Message {
        to,
        name: a.text(0)?,
        value: if a.len() > 1 {
            a.value(1).clone()
        } else {
            Dynamic::UNIT
        },
    })
}

/// The values that were given by name, as a component keeps them.
fn parameters(a: &Arguments) -> Result<Parameters, Mistake> {
    let mut values = Vec::new();
    if a.len() > 1 {
        let map = a.value(1).read_lock::<rhai::Map>();
        let map = map.ok_or_else(|| a.wrong(1, "a map, as in `#{ speed: 30 }`"))?;
        for (name, value) in map.iter() {
            let kept = if let Ok(number) = value.as_int() {
                Value::Int(number)
            } else if let Some(number) = as_number(value) {
                Value::Float(number as f32)
            } else if let Ok(on) = value.as_bool() {
                Value::Bool(on)
            } else if let Ok(text) = value.clone().into_string() {
                Value::Text(text)
            } else {
                return Err(Mistake::new(format!(
                    "`{name}` must be a number, a text, `true` or `false`, not {}",
                    a.describe(value)
                )));
            };
            values.push((name.to_string(), kept));
        }
    }
    Ok(Parameters(values))
}
