//! What takes a change of the structure back.

use std::collections::HashSet;

use lightbench_world::{ComponentKind, Entity, EntityMap, Name, Removed, Row};

use super::assets::AssetInverse;
use super::finding::named;
use crate::scene::Scene;
use crate::scene::data::Data;

/// What takes a change back.
#[derive(Clone, Debug)]
pub(super) enum Inverse {
    /// It has made these.
    Made(Vec<Entity>),
    /// It has removed these, each with all that hung on it.
    Removed(Vec<Vec<Removed>>),
    /// It has called these otherwise.
    Renamed(Vec<Renamed>),
    /// It has hung these elsewhere.
    Moved(Vec<Moved>),
    /// It has given a component to these.
    Added(ComponentKind, Vec<Entity>),
    /// It has taken a component away from these.
    Dropped(Vec<(Entity, (Row, usize))>),
    /// It has given these a tag, or taken it away.
    Tagged {
        tag: String,
        on: bool,
        entities: Vec<Entity>,
    },
    /// It has changed assets, or what is drawn with them.
    Assets(Box<AssetInverse>),
}

/// An entity that is called otherwise.
#[derive(Clone, Debug)]
pub(super) struct Renamed {
    pub(super) entity: Entity,
    pub(super) before: String,
    pub(super) after: String,
    /// Whether it had a name, be it an empty one.
    pub(super) had: bool,
}

/// An entity that hangs elsewhere, and where it hung.
#[derive(Clone, Debug)]
pub(super) struct Moved {
    pub(super) entity: Entity,
    pub(super) parent: Option<Entity>,
    pub(super) previous: Option<Entity>,
}

impl Inverse {
    /// Takes the change back. What is gone meanwhile needs nothing. Gives the new handles of what could
    /// not have its own again.
    pub(super) fn revert(&self, scene: &mut Scene) -> EntityMap {
        scene.on_data(|data| self.revert_on(data))
    }

    fn revert_on(&self, data: &mut Data) -> EntityMap {
        let mut map = EntityMap::default();
        match self {
            Self::Made(made) => {
                for entity in made.iter().rev() {
                    let below = data.world.descendants(*entity);
                    let all: HashSet<Entity> = below.into_iter().chain([*entity]).collect();
                    // Another one may get its handle.
                    data.made.retain(|made| !all.contains(made));
                    data.aims.retain(|aimed, _| !all.contains(aimed));
                    data.world.unmake(*entity);
                }
            }
            Self::Removed(removed) => {
                for together in removed.iter().rev() {
                    map.extend(&data.world.put_back(together));
                    for one in together {
                        let entity = map.get(one.entity()).unwrap_or(one.entity());
                        data.note_name(entity, &named(&data.world, entity));
                        if let Some(aim) = data.aims.get(&one.entity()).copied() {
                            data.aims.insert(entity, aim);
                        }
                    }
                }
            }
            Self::Renamed(all) => {
                for one in all.iter().rev() {
                    if one.had {
                        // What has gone meanwhile is called nothing.
                        let _named = data.world.insert(one.entity, Name::new(&one.before));
                        data.note_name(one.entity, &one.before);
                    } else {
                        data.world.remove::<Name>(one.entity);
                    }
                }
            }
            Self::Moved(all) => {
                for one in all.iter().rev() {
                    // A parent that has gone leaves it where it is.
                    let _moved = data.world.place_below(one.entity, one.parent, one.previous);
                }
            }
            Self::Added(kind, entities) => {
                for entity in entities.iter().rev() {
                    data.world.take_row(*entity, *kind);
                }
            }
            Self::Dropped(all) => {
                for (entity, row) in all.iter().rev() {
                    data.world.give_back(*entity, row.clone());
                }
            }
            Self::Assets(inverse) => inverse.revert(data),
            Self::Tagged { tag, on, entities } => {
                for entity in entities {
                    match on {
                        true => _ = data.world.remove_tag(*entity, tag),
                        false => _ = data.world.add_tag(*entity, tag),
                    }
                }
            }
        }
        map
    }

    /// Follows entities that have other handles now.
    pub(super) fn follow(&mut self, map: &EntityMap) {
        let renew = |entity: &mut Entity| {
            if let Some(new) = map.get(*entity) {
                *entity = new;
            }
        };
        match self {
            Self::Made(all) | Self::Added(_, all) | Self::Tagged { entities: all, .. } => {
                all.iter_mut().for_each(renew);
            }
            Self::Removed(all) => {
                let all = all.iter_mut().flatten();
                all.for_each(|removed| removed.follow(map));
            }
            Self::Renamed(all) => all.iter_mut().for_each(|one| renew(&mut one.entity)),
            Self::Moved(all) => {
                for one in all {
                    renew(&mut one.entity);
                    one.parent.iter_mut().for_each(renew);
                    one.previous.iter_mut().for_each(renew);
                }
            }
            Self::Dropped(all) => all.iter_mut().for_each(|(entity, _)| renew(entity)),
            Self::Assets(inverse) => inverse.follow(map),
        }
    }
}
