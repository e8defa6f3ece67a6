//! Tags: words by which scripts find entities again.

use lightbench_world::Entity;
use rhai::Array;

use super::data::{Data, Stage};
use super::entities::{getter, method};
use crate::api::{Api, Arguments, Mistake};

pub(super) fn register(api: &mut Api, stage: &Stage) {
    api.section("Tags");
    method(
        api,
        stage,
        "tag(tag)",
        "Gives the entity a tag: any text. It may have many, and `entities().tagged(tag)` finds all \
         that have one. Scene files keep them.",
        |data, entity, a| add(data, entity, &tag_argument(a)?),
    );
    method(
        api,
        stage,
        "untag(tag)",
        "Takes a tag away from the entity. Nothing happens if it has no such tag.",
        |data, entity, a| {
            let tag = tag_argument(a)?;
            data.check(entity)?;
            data.world.remove_tag(entity, &tag);
            Ok(())
        },
    );
    getter(
        api,
        stage,
        "tags",
        "The entity's tags, as an array of texts in the order of the alphabet.",
        |data, entity| {
            data.check(entity)?;
            let tags: Array = data.world.tags().of(entity).map(Into::into).collect();
            Ok(tags)
        },
    );
    let asked = stage.clone();
    api.method(
        "has_tag(tag)",
        "Whether the entity has a tag.",
        move |entity: Entity, a| {
            let tag = tag_argument(a)?;
            let data = asked.lock();
            data.check(entity)?;
            Ok(data.world.tags().contains(&tag, entity))
        },
    );
}

/// The tag that the first argument is.
pub(super) fn tag_argument(a: &Arguments) -> Result<String, Mistake> {
    let tag = a.text(0)?;
    if tag.is_empty() {
        return Err(Mistake::new("a tag has at least one letter"));
    }
    Ok(tag)
}

pub(super) fn add(data: &mut Data, entity: Entity, tag: &str) -> Result<(), Mistake> {
    data.check(entity)?;
    let added = data.world.add_tag(entity, tag);
    added.map_err(|error| Mistake::new(error.to_string()))
}
