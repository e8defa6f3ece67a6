//! From text to a world.

use std::collections::HashMap;

use super::text::Parser;
use super::{AssetNames, SceneError, VERSION};
use crate::components::{ComponentKind, KeptText, SceneNumber};
use crate::entity::Entity;
use crate::reflect::{ComponentInfo, Role};
use crate::value::Value;
use crate::world::World;

/// A world from text.
///
/// # Errors
/// [`SceneError::Text`] with the first line that is wrong.
pub fn read(text: &str, assets: &mut dyn AssetNames) -> Result<World, SceneError> {
    let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line));
    let (_, first) = lines.next().unwrap_or((1, ""));
    check_version(first.trim_start_matches('\u{feff}'))?;
    let lines: Vec<_> = lines.filter(|(_, line)| !line.trim().is_empty()).collect();

    // Entities first, because values may name later ones.
    let mut world = World::new();
    let mut entities = HashMap::new();
    for &(line, content) in &lines {
        if !content.starts_with(' ') && definition_kind(content).is_none() {
            let number = entity_number(line, content)?;
            let entity = world.spawn();
            if entities.insert(number, entity).is_some() {
                let message = format!("entity #{number} stands twice in this file");
                return Err(SceneError::at(line, message));
            }
            let numbered = world.insert(entity, SceneNumber { number });
            numbered.map_err(|error| SceneError::at(line, error.to_string()))?;
        }
    }
    let mut reader = Reader {
        world,
        entities: &entities,
        assets,
        entity: Entity::NONE,
        block: Block::Attributes,
    };
    for (line, content) in lines {
        let read = reader.line(line, content.trim_end());
        read.map_err(|message| SceneError::at(line, message))?;
    }
    Ok(reader.world)
}

fn check_version(line: &str) -> Result<(), SceneError> {
    let version = line.strip_prefix("lightbench scene ").map(str::trim);
    match version.map(str::parse::<u32>) {
        Some(Ok(1..=VERSION)) => Ok(()),
        Some(Ok(version)) => Err(SceneError::at(
            1,
            format!(
                "this is version {version} of the format and this program knows up to \
                 {VERSION}: it was written by a newer program"
            ),
        )),
        _ => Err(SceneError::at(
            1,
            format!("a scene file begins with `lightbench scene {VERSION}`"),
        )),
    }
}

/// The kinds of assets that a file may define.
const KINDS: [&str; 3] = ["mesh", "material", "texture"];

/// What a line defines and what follows the kind, if it defines an asset.
fn definition_kind(content: &str) -> Option<(&'static str, &str)> {
    KINDS.into_iter().find_map(|kind| {
        let rest = content.strip_prefix(kind)?;
        rest.starts_with(' ').then_some((kind, rest))
    })
}

fn entity_number(line: usize, content: &str) -> Result<u32, SceneError> {
    let number = content.strip_prefix("entity #").map(str::trim_end);
    match number.map(str::parse::<u32>) {
        Some(Ok(number)) if number > 0 => Ok(number),
        _ => Err(SceneError::at(
            line,
            format!("expected `entity #` and a number from 1, found `{content}`"),
        )),
    }
}

/// What the fields four spaces deep belong to.
#[derive(Clone, Copy)]
enum Block {
    /// Nothing: the entity's own attributes come before its components.
    Attributes,
    /// A component that this version knows.
    Component(ComponentKind),
    /// One that it does not know.
    Unknown,
}

struct Reader<'a> {
    world: World,
    entities: &'a HashMap<u32, Entity>,
    assets: &'a mut dyn AssetNames,
    /// The entity whose lines are being read.
    entity: Entity,
    block: Block,
}

impl Reader<'_> {
    fn line(&mut self, line: usize, content: &str) -> Result<(), String> {
        let inside = content.trim_start_matches(' ');
        if let Some((kind, rest)) = definition_kind(content) {
            return self.define(kind, rest);
        }
        match (content.len() - inside.len(), self.block) {
            (0, _) => {
                let number = entity_number(line, content).map_err(|error| error.to_string())?;
                self.entity = self.entities[&number];
                self.block = Block::Attributes;
                Ok(())
            }
            _ if self.entity == Entity::NONE => Err("an entity must come first".to_owned()),
            (2, _) => match inside.split_once(" = ") {
                Some((name, value)) => self.attribute(name, value),
                None => self.component(content, inside),
            },
            (_, Block::Unknown) => {
                self.keep(content);
                Ok(())
            }
            (4, Block::Component(kind)) => self.field(kind.info(), inside),
            (4, Block::Attributes) => Err("a field must stand below a component".to_owned()),
            (depth, _) => Err(format!(
                "expected a line 0, 2 or 4 spaces deep, found {depth}"
            )),
        }
    }

    fn define(&mut self, kind: &str, rest: &str) -> Result<(), String> {
        if self.entity != Entity::NONE {
            return Err("assets must be defined before the first entity".to_owned());
        }
        let parser = Parser::new(rest, self.assets, &|_| None);
        let (name, rest) = parser.leading_text()?;
        let recipe = rest.trim_start().strip_prefix("= ");
        let recipe = recipe.ok_or_else(|| format!("expected ` = ` and how the {kind} is made"))?;
        self.assets.define(kind, &name, recipe.trim())
    }

    fn value(&mut self, text: &str) -> Result<Value, String> {
        let entities = self.entities;
        let entity = |number| entities.get(&number).copied();
        Parser::new(text, self.assets, &entity).only_value()
    }

    fn attribute(&mut self, name: &str, text: &str) -> Result<(), String> {
        let value = self.value(text)?;
        match (name, value) {
            ("children", Value::List(children)) => {
                for child in children {
                    let Value::Entity(child) = child else {
                        return Err(format!("a child is an entity, not {}", child.kind()));
                    };
                    let linked = self.world.set_parent(child, Some(self.entity));
                    linked.map_err(|error| error.to_string())?;
                }
                Ok(())
            }
            ("tags", Value::List(tags)) => {
                for tag in tags {
                    let Value::Text(tag) = tag else {
                        return Err(format!("a tag is text, not {}", tag.kind()));
                    };
                    let tagged = self.world.add_tag(self.entity, &tag);
                    tagged.map_err(|error| error.to_string())?;
                }
                Ok(())
            }
            ("group", Value::Text(group)) => {
                let grouped = self.world.set_group(self.entity, Some(&group));
                grouped.map_err(|error| error.to_string())
            }
            ("children" | "tags", other) => Err(format!("{name} are a list, not {}", other.kind())),
            ("group", other) => Err(format!("a group is text, not {}", other.kind())),
            _ => Err(format!(
                "an entity has children, tags and a group, but no `{name}`"
            )),
        }
    }

    fn component(&mut self, content: &str, name: &str) -> Result<(), String> {
        let known = ComponentKind::from_name(name);
        match known.filter(|kind| kind.info().role != Role::Computed) {
            Some(kind) => {
                self.block = Block::Component(kind);
                let inserted = self.world.insert_default(self.entity, name);
                inserted.map_err(|error| error.to_string())
            }
            None if name.chars().all(|c| c.is_alphanumeric() || c == '_') => {
                self.block = Block::Unknown;
                self.keep(content);
                Ok(())
            }
            None => Err(format!(
                "expected the name of a component or `name = value`, found `{name}`"
            )),
        }
    }

    fn keep(&mut self, content: &str) {
        let mut kept: KeptText = self.world.get(self.entity).unwrap_or_default();
        kept.lines.push(content.to_owned());
        // The entity exists since the file was opened.
        self.world.insert(self.entity, kept).ok();
    }

    fn field(&mut self, info: &ComponentInfo, inside: &str) -> Result<(), String> {
        let (name, text) = inside
            .split_once(" = ")
            .ok_or_else(|| format!("expected `field = value`, found `{inside}`"))?;
        let value = self.value(text)?;
        // Without the check of ranges: what a world holds can be read back.
        let set = self
            .world
            .set_field_unchecked(self.entity, info.name, name, &value);
        set.map_err(|error| error.to_string())
    }
}
