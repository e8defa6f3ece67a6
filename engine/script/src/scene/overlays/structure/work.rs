//! Doing a change of the structure.

use std::collections::HashMap;

use lightbench_world::components::SceneNumber;
use lightbench_world::{ComponentKind, Entity, MeshRenderer, Name};

use super::Done;
use super::edit::{Edit, Who};
use super::finding::{self, named};
use super::inverse::{Inverse, Moved, Renamed};
use super::kinds::NewKind;
use crate::scene::Scene;
use crate::scene::data::Data;

/// Does a change, as far as its entities are there, and gives what takes it back. `before` are the changes
/// before it.
///
/// # Errors
/// A sentence, where none of them is there or the scene may not have more. Nothing has changed then.
pub(super) fn perform(scene: &mut Scene, edit: &Edit, before: &[Done]) -> Result<Inverse, String> {
    match edit {
        Edit::Assets(edit) => super::assets::perform(scene, edit, before),
        Edit::Create {
            kind,
            name,
            number,
            place,
        } => {
            let meshes = match kind.shape() {
                Some(_) => scene.new_meshes()?,
                None => Vec::new(),
            };
            scene.on_data(|data| {
                let made = kind.make(data, &meshes, name, *place)?;
                give_number(data, made, *number);
                Ok(Inverse::Made(vec![made]))
            })
        }
        Edit::Copy { of, names, number } => {
            let roots = there(scene, of)?;
            scene.on_data(|data| copy(data, &roots, names, *number))
        }
        Edit::Delete { of } => {
            let roots = there(scene, of)?;
            Ok(scene.on_data(|data| {
                let removed = roots.into_iter().map(|root| data.world.take_out(root));
                Inverse::Removed(removed.filter(|all| !all.is_empty()).collect())
            }))
        }
        Edit::Rename { of } => {
            let who: Vec<Who> = of.iter().map(|(who, _)| who.clone()).collect();
            there(scene, &who)?;
            let found = finding::all(&scene.world, &who);
            let pairs = found.into_iter().zip(of);
            let pairs: Vec<(Entity, &String)> = pairs
                .filter_map(|(entity, (_, name))| Some((entity?, name)))
                .collect();
            Ok(scene.on_data(|data| {
                let renamed = pairs.into_iter().map(|(entity, name)| {
                    let before = Renamed {
                        entity,
                        before: named(&data.world, entity),
                        after: name.clone(),
                        had: data.world.has::<Name>(entity),
                    };
                    // It was found just now.
                    let _named = data.world.insert(entity, Name::new(name));
                    data.note_name(entity, name);
                    before
                });
                Inverse::Renamed(renamed.collect())
            }))
        }
        Edit::Parent { of, to } => {
            let children = there(scene, of)?;
            let parent = match to {
                Some(to) => Some(there(scene, std::slice::from_ref(to))?[0]),
                None => None,
            };
            Ok(scene.on_data(|data| {
                let moved = children.into_iter().filter_map(|entity| {
                    let before = Moved {
                        entity,
                        parent: data.world.parent(entity),
                        previous: data.world.previous_sibling(entity),
                    };
                    // One above the parent, in a script that has changed, stays where it is.
                    data.world.set_parent(entity, parent).ok().map(|()| before)
                });
                Inverse::Moved(moved.collect())
            }))
        }
        Edit::Add { of, component } => {
            let mut entities = there(scene, of)?;
            entities.retain(|entity| !scene.world.has_component(*entity, *component));
            if entities.is_empty() {
                return Err(format!("all have {} already", component.info().name));
            }
            let meshes = match component {
                ComponentKind::MeshRenderer => scene.new_meshes()?,
                _ => Vec::new(),
            };
            Ok(scene.on_data(|data| {
                for entity in &entities {
                    // They are there, and the component is no computed one.
                    let _given = match NewKind::Box.mesh(&meshes) {
                        Some(mesh) => {
                            let renderer = MeshRenderer {
                                mesh,
                                ..MeshRenderer::default()
                            };
                            data.world.insert(*entity, renderer)
                        }
                        None => data.world.insert_default(*entity, component.info().name),
                    };
                }
                Inverse::Added(*component, entities)
            }))
        }
        Edit::Drop { of, component } => {
            let entities = there(scene, of)?;
            let dropped = scene.on_data(|data| {
                let rows = entities.into_iter().filter_map(|entity| {
                    let row = data.world.take_row(entity, *component)?;
                    Some((entity, row))
                });
                rows.collect::<Vec<_>>()
            });
            match dropped.is_empty() {
                true => Err(format!("none has {}", component.info().name)),
                false => Ok(Inverse::Dropped(dropped)),
            }
        }
        Edit::Tag { of, tag, on } => {
            let mut entities = there(scene, of)?;
            entities.retain(|entity| scene.world.tags().contains(tag, *entity) != *on);
            Ok(scene.on_data(|data| {
                for entity in &entities {
                    match on {
                        true => _ = data.world.add_tag(*entity, tag),
                        false => _ = data.world.remove_tag(*entity, tag),
                    }
                }
                Inverse::Tagged {
                    tag: tag.clone(),
                    on: *on,
                    entities,
                }
            }))
        }
    }
}

/// Those that there are, at least one.
pub(super) fn there(scene: &Scene, of: &[Who]) -> Result<Vec<Entity>, String> {
    let found = finding::found(&scene.world, of);
    match (found.is_empty(), of) {
        (false, _) => Ok(found),
        (true, [one]) => Err(format!("nothing is called `{}` now", one.name)),
        (true, _) => Err("none of these entities is there now".to_owned()),
    }
}

/// Gives an entity its number in files, unless another one has it.
pub(super) fn give_number(data: &mut Data, entity: Entity, number: u32) {
    let numbers = data.world.columns::<SceneNumber>().number();
    if !numbers.contains(&number) {
        // It was made just now.
        let _numbered = data.world.insert(entity, SceneNumber { number });
    }
}

/// Copies entities with all that hang on them. `names` says what each copy is called.
fn copy(
    data: &mut Data,
    roots: &[Entity],
    names: &[(String, String)],
    first: u32,
) -> Result<Inverse, String> {
    let subtrees = roots.iter().map(|root| {
        let below = data.world.descendants(*root);
        std::iter::once(*root).chain(below).collect::<Vec<_>>()
    });
    let subtrees: Vec<Vec<Entity>> = subtrees.collect();
    let count: usize = subtrees.iter().map(Vec::len).sum();
    if data.world.len() + count > data.limits.entities {
        return Err(format!(
            "the scene has {} entities, and may not have more than {}",
            data.world.len(),
            data.limits.entities
        ));
    }
    let mut number = first;
    let mut unused: Vec<Option<&(String, String)>> = names.iter().map(Some).collect();
    let mut made = Vec::new();
    for subtree in subtrees {
        let mut copies: HashMap<Entity, Entity> = HashMap::new();
        for (place, source) in subtree.into_iter().enumerate() {
            let name = named(&data.world, source);
            // Several of a name each have one of their own.
            let of_it = |known: &&mut Option<&(String, String)>| {
                known.is_some_and(|(known, _)| *known == name)
            };
            let own = unused.iter_mut().find(of_it).and_then(Option::take);
            let own = own.map_or("", |(_, copy)| copy.as_str());
            let entity = data.copy(source, own)?;
            give_number(data, entity, number);
            number = number.saturating_add(1);
            let parent = data.world.parent(source);
            let parent = parent.map(|parent| copies.get(&parent).copied().unwrap_or(parent));
            // A new leaf makes no cycle.
            let _hung = data.world.set_parent(entity, parent);
            copies.insert(source, entity);
            if place == 0 {
                made.push(entity);
            }
        }
    }
    Ok(Inverse::Made(made))
}

impl Data {
    /// A copy of an entity but for its place in the tree, its name and its number.
    fn copy(&mut self, source: Entity, name: &str) -> Result<Entity, String> {
        let entity = self.spawn(name).map_err(|mistake| mistake.message)?;
        for row in self.world.rows_of(source) {
            // No row of a computed component is among them, and the copy is there.
            let _copied = match row.kind() {
                ComponentKind::Name | ComponentKind::SceneNumber => Ok(()),
                _ => row.insert_into(&mut self.world, entity),
            };
        }
        if !self.world.has_component(source, ComponentKind::Transform) {
            let _none = self.world.remove_named(entity, "Transform");
        }
        let tags: Vec<String> = self.world.tags().of(source).map(str::to_owned).collect();
        for tag in tags {
            let _tagged = self.world.add_tag(entity, &tag);
        }
        let group = self.world.group_of(source).map(str::to_owned);
        if group.is_some() {
            let _grouped = self.world.set_group(entity, group.as_deref());
        }
        if let Some(aim) = self.aims.get(&source).copied() {
            self.aims.insert(entity, aim);
        }
        Ok(entity)
    }
}
