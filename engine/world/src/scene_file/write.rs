//! From a world to text.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::text::{write_text, write_value};
use super::{AssetNames, Definition, VERSION};
use crate::components::{KeptText, SceneNumber};
use crate::entity::Entity;
use crate::reflect::Role;
use crate::value::Value;
use crate::world::World;

/// A world as text. Entities that were never written before get their numbers,
/// which is why the world changes.
pub fn write(world: &mut World, assets: &dyn AssetNames) -> String {
    let numbered = number_entities(world);
    let number = |entity: Entity| {
        let number = world.get::<SceneNumber>(entity)?.number;
        (numbered.get(&number) == Some(&entity)).then_some(number)
    };
    let mut text = format!("lightbench scene {VERSION}\n");
    let definitions = assets.definitions();
    if !definitions.is_empty() {
        text.push('\n');
    }
    for Definition { kind, name, recipe } in definitions {
        text.push_str(kind);
        text.push(' ');
        write_text(&mut text, &name);
        writeln!(text, " = {recipe}").ok();
    }
    for (&id, &entity) in &numbered {
        write!(text, "\nentity #{id}\n").ok();
        let mut attribute = |name: &str, value: Value| {
            write!(text, "  {name} = ").ok();
            write_value(&mut text, &value, assets, &number);
            text.push('\n');
        };
        let children: Vec<_> = world.children(entity).map(Value::Entity).collect();
        if !children.is_empty() {
            attribute("children", Value::List(children));
        }
        let tags: Vec<_> = world
            .tags()
            .of(entity)
            .map(|tag| Value::Text(tag.to_owned()))
            .collect();
        if !tags.is_empty() {
            attribute("tags", Value::List(tags));
        }
        if let Some(group) = world.group_of(entity) {
            attribute("group", Value::Text(group.to_owned()));
        }
        write_components(&mut text, world, entity, assets, &number);
    }
    text
}

fn write_components(
    text: &mut String,
    world: &World,
    entity: Entity,
    assets: &dyn AssetNames,
    number: &dyn Fn(Entity) -> Option<u32>,
) {
    for kind in world.components_of(entity) {
        let info = kind.info();
        let own = matches!(info.name, "SceneNumber" | "KeptText");
        if info.role == Role::Computed || own {
            continue;
        }
        writeln!(text, "  {}", info.name).ok();
        for field in info.fields {
            if let Some(value) = world.get_field(entity, info.name, field.name) {
                write!(text, "    {} = ", field.name).ok();
                write_value(text, &value, assets, number);
                text.push('\n');
            }
        }
    }
    for line in world.get::<KeptText>(entity).unwrap_or_default().lines {
        text.push_str(&line);
        text.push('\n');
    }
}

/// Gives a number to every entity that has none, as a file does that is written, and returns the
/// greatest of all; 0 where there is no entity.
pub fn number(world: &mut World) -> u32 {
    let numbers = world.columns::<SceneNumber>();
    let known = numbers.number().iter().copied().max().unwrap_or(0);
    if numbers.len() == world.len() {
        return known;
    }
    let numbered = number_entities(world);
    numbered.keys().next_back().copied().unwrap_or(0)
}

/// Gives a number to every entity that has none, and returns all by number. Where
/// two entities have the same, because one is a copy, the later one gets a new
/// number.
fn number_entities(world: &mut World) -> BTreeMap<u32, Entity> {
    let mut numbered = BTreeMap::new();
    let mut fresh = Vec::new();
    for entity in world.entities() {
        match world.get::<SceneNumber>(entity) {
            Some(known) if known.number > 0 && !numbered.contains_key(&known.number) => {
                numbered.insert(known.number, entity);
            }
            _ => fresh.push(entity),
        }
    }
    let mut number = numbered.keys().next_back().copied().unwrap_or(0);
    for entity in fresh {
        number = next_free(&numbered, number);
        numbered.insert(number, entity);
        // The entity was listed by the world just now.
        world.insert(entity, SceneNumber { number }).ok();
    }
    numbered
}

/// The first number after this one that is not taken; begins again at 1 after the
/// last one.
fn next_free(numbered: &BTreeMap<u32, Entity>, after: u32) -> u32 {
    let mut number = after;
    loop {
        number = number.checked_add(1).unwrap_or(1);
        if !numbered.contains_key(&number) {
            return number;
        }
    }
}
