//! Sets of entities: asking for them, and doing something with each.

mod batch;
mod filters;

use std::sync::Arc;

use lightbench_world::Entity;
use rhai::{Array, Dynamic, FuncRegistration};

use super::data::{Data, Stage};
use super::fields::{Values, drop_component};
use super::{tables, tags};
use crate::api::{Api, Arguments, Mistake, ScriptType};

/// Some entities, in the order in which they were made. It stays as it is when entities come and
/// go.
#[derive(Clone, Debug)]
pub(super) struct Selection(Arc<Vec<Entity>>);

impl ScriptType for Selection {
    const NAME: &'static str = "selection";
}

impl Selection {
    fn new(entities: Vec<Entity>) -> Self {
        Self(Arc::new(entities))
    }
}

impl IntoIterator for Selection {
    type Item = Entity;
    type IntoIter = std::vec::IntoIter<Entity>;

    fn into_iter(self) -> Self::IntoIter {
        Arc::unwrap_or_clone(self.0).into_iter()
    }
}

pub(super) fn register(api: &mut Api, stage: &Stage) {
    api.section("Selections: many entities at once");
    api.object::<Selection>();
    let all = stage.clone();
    api.function(
        "entities()",
        "All entities of the scene, in the order in which they were made. A selection is asked \
         for once, and does not follow what comes and goes later; keep it in `state`.",
        move |_| Ok(Selection::new(all.lock().all())),
    );
    filters::register(api, stage);
    members(api);
    batch::register(api, stage);
    changes(api, stage);
}

fn members(api: &mut Api) {
    api.getter(
        "count",
        "How many entities there are in the selection.",
        |selection: Selection, _| Ok(selection.0.len() as i64),
    );
    api.method(
        "to_array()",
        "The entities as an array. `for` goes through a selection without it, and `selection[0]` is \
         its first entity.",
        |selection: Selection, _| {
            let entities: Array = selection.0.iter().copied().map(Dynamic::from).collect();
            Ok(entities)
        },
    );
    let engine = api.engine();
    engine.register_iterator::<Selection>();
    FuncRegistration::new_index_getter().register_into_engine(
        engine,
        |selection: &mut Selection, index: i64| {
            let found = usize::try_from(index)
                .ok()
                .and_then(|index| selection.0.get(index).copied());
            found.ok_or_else(|| {
                Box::<rhai::EvalAltResult>::from(outside(
                    "selection",
                    index,
                    selection.0.len(),
                    "entities",
                ))
            })
        },
    );
    crate::math::text(engine, |selection: &Selection| {
        format!("selection of {} entities", selection.0.len())
    });
}

/// The mistake of an index that is too large or negative.
pub(super) fn outside(object: &str, index: i64, count: usize, what: &str) -> Mistake {
    Mistake::new(match count {
        0 => format!("`[{index}]` is outside of the {object}, which is empty"),
        count => format!(
            "`[{index}]` is outside of the {object}: it has {count} {what}, `[0]` to `[{}]`",
            count - 1
        ),
    })
}

/// Registers a method of a selection that gives the selection back, for chains.
fn method(
    api: &mut Api,
    stage: &Stage,
    form: &str,
    about: &'static str,
    body: impl Fn(&mut Data, &[Entity], &Arguments) -> Result<(), Mistake> + Send + Sync + 'static,
) {
    let stage = stage.clone();
    api.method(form, about, move |selection: Selection, a| {
        body(&mut stage.lock(), &selection.0, a)?;
        Ok(selection)
    });
}

fn changes(api: &mut Api, stage: &Stage) {
    for form in ["add(component)", "add(component, values)"] {
        method(
            api,
            stage,
            form,
            "Gives each entity a component, as `add` of an entity does.",
            |data, entities, a| {
                let values = Values::of(data, a)?;
                entities.iter().try_for_each(|&e| values.add(data, e))
            },
        );
    }
    method(
        api,
        stage,
        "drop(component)",
        "Takes a component away from each entity that has it.",
        |data, entities, a| {
            let component = tables::component(&a.text(0)?)?;
            component.refuse_computed()?;
            let mut entities = entities.iter();
            entities.try_for_each(|&entity| drop_component(data, entity, component))
        },
    );
    method(
        api,
        stage,
        "tag(tag)",
        "Gives each entity a tag, as `tag` of an entity does.",
        |data, entities, a| {
            let tag = tags::tag_argument(a)?;
            entities.iter().try_for_each(|&e| tags::add(data, e, &tag))
        },
    );
    let stage = stage.clone();
    api.method(
        "remove()",
        "Removes each entity and everything below it.",
        move |selection: Selection, _| {
            let mut data = stage.lock();
            for &entity in selection.0.iter() {
                // One that lay below another of the selection is gone already.
                data.world.despawn(entity);
                data.aims.remove(&entity);
            }
            Ok(())
        },
    );
}
