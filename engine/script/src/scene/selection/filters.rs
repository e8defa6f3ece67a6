//! Which entities a selection holds.

use std::collections::HashSet;

use lightbench_world::glam::{DVec3, Vec3};
use lightbench_world::{Entity, Name, Transform, World};

use super::Selection;
use crate::api::{Api, Arguments, Mistake};
use crate::scene::bounds::world_matrix;
use crate::scene::data::{Data, Stage};
use crate::scene::entities::getter;
use crate::scene::fields::field_argument;
use crate::scene::values::from_script;
use crate::scene::{tables, tags};

/// Registers a method that keeps some of the entities. `test` is made once for each call.
fn filter<T: FnMut(&Data, Entity) -> bool>(
    api: &mut Api,
    stage: &Stage,
    form: &str,
    about: &'static str,
    test: impl Fn(&mut Data, &Arguments) -> Result<T, Mistake> + Send + Sync + 'static,
) {
    let stage = stage.clone();
    api.method(form, about, move |selection: Selection, a| {
        let data = &mut *stage.lock();
        let mut test = test(data, a)?;
        let kept = selection.0.iter().copied();
        let kept = kept.filter(|&entity| data.world.contains(entity) && test(data, entity));
        Ok(Selection::new(kept.collect()))
    });
}

pub(super) fn register(api: &mut Api, stage: &Stage) {
    components(api, stage);
    filter(
        api,
        stage,
        "named(pattern)",
        "Keeps the entities of that name. A `*` stands for any letters, as in \"lamp *\".",
        |_, a| {
            let pattern = a.text(0)?;
            Ok(move |data: &Data, entity| {
                let names = data.world.columns::<Name>();
                let row = names.row_of(entity);
                row.is_some_and(|row| matches(&pattern, &names.text()[row]))
            })
        },
    );
    filter(
        api,
        stage,
        "tagged(tag)",
        "Keeps the entities that have a tag.",
        |_, a| {
            let tag = tags::tag_argument(a)?;
            Ok(move |data: &Data, entity| data.world.tags().contains(&tag, entity))
        },
    );
    filter(
        api,
        stage,
        "near(point, metres)",
        "Keeps the entities whose origin lies within a distance of a point of the world.",
        |_, a| {
            let point: DVec3 = a.object(0)?;
            let metres = a.number_in(1, 0.0, f64::INFINITY)?;
            Ok(move |data: &Data, entity| {
                data.world.has::<Transform>(entity)
                    && origin(&data.world, entity).as_dvec3().distance(point) <= metres
            })
        },
    );
    family(api, stage);
}

/// Where an entity's origin is in the world.
fn origin(world: &World, entity: Entity) -> Vec3 {
    match world.parent(entity) {
        None => {
            world
                .get::<Transform>(entity)
                .unwrap_or_default()
                .translation
        }
        Some(_) => world_matrix(world, entity).translation.into(),
    }
}

fn components(api: &mut Api, stage: &Stage) {
    filter(
        api,
        stage,
        "with(component)",
        "Keeps the entities that have a component, as in `with(\"light\")`.",
        |_, a| {
            let kind = tables::component(&a.text(0)?)?.kind;
            Ok(move |data: &Data, entity| data.world.has_component(entity, kind))
        },
    );
    filter(
        api,
        stage,
        "with(field, value)",
        "Keeps the entities whose field has a value, as in `with(\"light.kind\", \"spot\")`. Numbers \
         must be the same to the last digit.",
        |data, a| {
            let field = field_argument(a, 0)?;
            let value = from_script(data, field, a.value(1), a)?;
            Ok(move |data: &Data, entity| {
                let found = data.world.field_at(entity, field.kind, field.index);
                found.is_some_and(|found| found == value)
            })
        },
    );
    filter(
        api,
        stage,
        "without(component)",
        "Keeps the entities that have no such component.",
        |_, a| {
            let kind = tables::component(&a.text(0)?)?.kind;
            Ok(move |data: &Data, entity| !data.world.has_component(entity, kind))
        },
    );
}

fn family(api: &mut Api, stage: &Stage) {
    filter(
        api,
        stage,
        "below(entity)",
        "Keeps the entities that lie below another one: its children, their children and so on.",
        |data, a| {
            let above: Entity = a.object(0)?;
            data.check(above)?;
            let below: HashSet<Entity> = data.world.descendants(above).into_iter().collect();
            Ok(move |_: &Data, entity| below.contains(&entity))
        },
    );
    filter(
        api,
        stage,
        "roots()",
        "Keeps the entities that lie below no other one.",
        |_, _| Ok(|data: &Data, entity| data.world.parent(entity).is_none()),
    );
    getter(
        api,
        stage,
        "descendants",
        "A selection of everything below it: its children first, then theirs.",
        |data, entity| {
            data.check(entity)?;
            Ok(Selection::new(data.world.descendants(entity)))
        },
    );
}

/// Whether a text fits a pattern, in which `*` stands for any letters. Each part between two `*` may
/// take the first place where it fits: a later one would leave less to those behind it.
fn matches(pattern: &str, text: &str) -> bool {
    let mut parts = pattern.split('*');
    let first = parts.next().unwrap_or_default();
    let Some(mut rest) = text.strip_prefix(first) else {
        return false;
    };
    let Some(last) = parts.next_back() else {
        return rest.is_empty();
    };
    for part in parts {
        match rest.find(part) {
            Some(place) => rest = &rest[place + part.len()..],
            None => return false,
        }
    }
    rest.ends_with(last)
}

#[cfg(test)]
mod tests {
    use super::matches;

    #[test]
    fn patterns() {
        for (pattern, text, fits) in [
            ("lamp", "lamp", true),
            ("lamp", "lamps", false),
            ("lamp*", "lamp", true),
            ("lamp *", "lamp", false),
            ("*lamp*", "a lamp 3", true),
            ("*a*b", "aabab", true),
            ("*a*b", "aaba", false),
            ("*", "", true),
            ("", "x", false),
            ("ä*ö", "äxö", true),
            ("a*a", "a", false),
            ("a*", "ba", false),
            ("**b**", "abc", true),
        ] {
            assert_eq!(matches(pattern, text), fits, "{pattern} on {text}");
        }
    }
}
