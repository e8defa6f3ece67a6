//! What can be changed of a scene's structure, in terms that hold over loads.

use std::collections::HashSet;

use lightbench_world::{ComponentKind, Name, Transform};

use super::assets::AssetEdit;
use super::finding::{self, named};
use super::kinds::NewKind;
use super::{Overlays, with_all_below};
use crate::scene::Scene;

/// Which entity or asset is meant, in a scene that may have been loaded anew.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Who {
    /// Its name; empty for one without.
    pub name: String,
    /// Where several share the name, which of them in the order of the list or the table, from 0.
    pub nth: u32,
}

/// A change of a scene's structure.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    /// Makes an entity.
    Create {
        /// What it is.
        kind: NewKind,
        /// What it is called; empty for a name that is free.
        name: String,
        /// Its number in files; 0 for the next one.
        number: u32,
        /// Where it stands.
        place: Transform,
    },
    /// Makes copies of entities with all that hang on them, beside them.
    Copy {
        /// Which.
        of: Vec<Who>,
        /// What the copy of each name is called. Empty at first.
        names: Vec<(String, String)>,
        /// The first of the copies' numbers in files; 0 for the next one.
        number: u32,
    },
    /// Removes entities with all that hang on them.
    Delete {
        /// Which.
        of: Vec<Who>,
    },
    /// Calls entities otherwise.
    Rename {
        /// Which, and their new names.
        of: Vec<(Who, String)>,
    },
    /// Hangs entities below another one, or below none. Their Transforms stay as they are.
    Parent {
        /// Which.
        of: Vec<Who>,
        /// Below which.
        to: Option<Who>,
    },
    /// Gives entities a component with its default values.
    Add {
        /// Which.
        of: Vec<Who>,
        /// What they get.
        component: ComponentKind,
    },
    /// Takes a component away from entities.
    Drop {
        /// Which.
        of: Vec<Who>,
        /// What they lose.
        component: ComponentKind,
    },
    /// Gives entities a tag, or takes it away.
    Tag {
        /// Which.
        of: Vec<Who>,
        /// The tag.
        tag: String,
        /// Whether they have it then.
        on: bool,
    },
    /// Changes materials, meshes and textures, or what entities are drawn with.
    Assets(AssetEdit),
}

impl Edit {
    /// What was done, in words.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::Create { kind, name, .. } => match name.is_empty() {
                true => format!("Create {}", kind.name()),
                false => format!("Create {name}"),
            },
            Self::Copy { of, .. } => format!("Duplicate {}", spell(of)),
            Self::Delete { of } => format!("Delete {}", spell(of)),
            Self::Rename { of } => match of.as_slice() {
                [(who, name)] => format!("Rename {} to {name}", who.words()),
                all => format!("Rename {} entities", all.len()),
            },
            Self::Parent { of, to: Some(to) } => {
                format!("Put {} below {}", spell(of), to.words())
            }
            Self::Parent { of, to: None } => format!("Put {} below nothing", spell(of)),
            Self::Add { of, component } => {
                format!("Add {} to {}", component.info().name, spell(of))
            }
            Self::Drop { of, component } => {
                format!("Remove {} from {}", component.info().name, spell(of))
            }
            Self::Tag { of, tag, on } => match (tag.as_str(), on) {
                (super::LOCKED, true) => format!("Lock {}", spell(of)),
                (super::LOCKED, false) => format!("Unlock {}", spell(of)),
                (tag, true) => format!("Tag {} as {tag}", spell(of)),
                (tag, false) => format!("Take the tag {tag} from {}", spell(of)),
            },
            Self::Assets(edit) => edit.words(),
        }
    }

    /// The change with names and numbers for what it makes, if it can be done.
    pub(super) fn completed(
        self,
        scene: &Scene,
        overlays: &Overlays,
        greatest: u32,
    ) -> Result<Self, String> {
        match self {
            Self::Create {
                kind,
                name,
                number,
                place,
            } => {
                let mut taken = taken(scene, overlays);
                let name = match name.is_empty() {
                    true => free_name(kind.name(), &mut taken),
                    false if taken.contains(name.as_str()) => return Err(is_taken(&name)),
                    false => name,
                };
                let number = if number == 0 { greatest + 1 } else { number };
                Ok(Self::Create {
                    kind,
                    name,
                    number,
                    place,
                })
            }
            Self::Copy { of, names, number } => {
                let of = present(scene, of)?;
                let number = if number == 0 { greatest + 1 } else { number };
                let names = match names.is_empty() {
                    true => copies(scene, overlays, &of),
                    false => names,
                };
                Ok(Self::Copy { of, names, number })
            }
            Self::Delete { of } => Ok(Self::Delete {
                of: present(scene, of)?,
            }),
            Self::Rename { of } => {
                let (who, new): (Vec<Who>, Vec<String>) = of.into_iter().unzip();
                let who = present(scene, who)?;
                let mut taken = taken(scene, overlays);
                for old in who.iter().filter(|old| !old.name.is_empty()) {
                    taken.remove(&old.name);
                }
                for name in &new {
                    if name.trim().is_empty() {
                        return Err("a name has at least one letter".to_owned());
                    }
                    if !taken.insert(name.clone()) {
                        return Err(is_taken(name));
                    }
                }
                let of = who.into_iter().zip(new).collect();
                Ok(Self::Rename { of })
            }
            Self::Parent { of, to } => {
                let of = present(scene, of)?;
                let to = match to {
                    Some(to) => Some(present(scene, vec![to])?.remove(0)),
                    None => None,
                };
                if let Some(parent) = to.as_ref().and_then(|to| finding::one(&scene.world, to)) {
                    let children = finding::found(&scene.world, &of);
                    if with_all_below(scene, &children).contains(&parent) {
                        let name = to.as_ref().map_or_else(String::new, Who::words);
                        return Err(format!(
                            "{} can't be put below {name}, which is itself or hangs below it",
                            spell(&of)
                        ));
                    }
                }
                Ok(Self::Parent { of, to })
            }
            Self::Add { of, component } => {
                changeable(component)?;
                if component == ComponentKind::ClipVolume {
                    return Err(
                        "a clip volume needs a mesh: give it one in the scene's script, as in \
                                `clip_volume(box(1))`"
                            .to_owned(),
                    );
                }
                Ok(Self::Add {
                    of: present(scene, of)?,
                    component,
                })
            }
            Self::Drop { of, component } => {
                changeable(component)?;
                Ok(Self::Drop {
                    of: present(scene, of)?,
                    component,
                })
            }
            Self::Tag { of, tag, on } => Ok(Self::Tag {
                of: present(scene, of)?,
                tag,
                on,
            }),
            Self::Assets(edit) => edit
                .completed(scene, &mut taken(scene, overlays), greatest)
                .map(Self::Assets),
        }
    }
}

impl Who {
    /// For people.
    #[must_use]
    pub fn words(&self) -> String {
        match (self.name.as_str(), self.nth) {
            ("", _) => "an entity without a name".to_owned(),
            (name, 0) => name.to_owned(),
            (name, nth) => format!("{name} ({})", nth + 1),
        }
    }
}

pub(super) fn spell(of: &[Who]) -> String {
    match of {
        [one] => one.words(),
        all => format!("{} entities", all.len()),
    }
}

pub(super) fn is_taken(name: &str) -> String {
    format!("another entity is called `{name}`, or changes wait for one of that name")
}

/// Refuses components that are no one's to give and to take.
fn changeable(component: ComponentKind) -> Result<(), String> {
    let info = component.info();
    if info.hidden() {
        return Err(format!("{} is no component for people", info.name));
    }
    if component == ComponentKind::Name {
        return Err("a name is changed, and neither added nor removed".to_owned());
    }
    Ok(())
}

/// Refuses entities that are not there, and the camera that no script made.
fn present(scene: &Scene, of: Vec<Who>) -> Result<Vec<Who>, String> {
    are_present(scene, &of)?;
    Ok(of)
}

/// The same without taking them.
pub(super) fn are_present(scene: &Scene, of: &[Who]) -> Result<(), String> {
    if of.is_empty() {
        return Err("no entity is chosen".to_owned());
    }
    let found = finding::all(&scene.world, of);
    for (who, found) in of.iter().zip(found) {
        let Some(found) = found else {
            return Err(format!("nothing is called `{}` now", who.name));
        };
        if scene.default_camera == Some(found) {
            return Err(
                "the scene's script makes no camera, so this one was made for it: make one to change \
                 it"
                .to_owned(),
            );
        }
    }
    Ok(())
}

/// Names that a new entity can't have.
fn taken(scene: &Scene, overlays: &Overlays) -> HashSet<String> {
    let names = scene.world.columns::<Name>().text().iter();
    let waiting = overlays.all.keys().map(|(name, _)| name);
    names.chain(waiting).cloned().collect()
}

/// The first free name that begins so.
pub(super) fn free_name(wanted: &str, taken: &mut HashSet<String>) -> String {
    let mut name = wanted.to_owned();
    let (base, mut number) = match wanted.rsplit_once(' ') {
        Some((base, end)) => match end.parse::<u32>() {
            Ok(number) => (base, number),
            Err(_) => (wanted, 1),
        },
        None => (wanted, 1),
    };
    while !taken.insert(name.clone()) {
        number = number.saturating_add(1);
        name = format!("{base} {number}");
    }
    name
}

/// What the copies of entities and of all that hang on them are called.
fn copies(scene: &Scene, overlays: &Overlays, of: &[Who]) -> Vec<(String, String)> {
    let mut taken = taken(scene, overlays);
    let mut names = Vec::new();
    for root in finding::found(&scene.world, of) {
        let below = scene.world.descendants(root);
        for entity in std::iter::once(root).chain(below) {
            let name = named(&scene.world, entity);
            if !name.is_empty() {
                let copy = free_name(&name, &mut taken);
                names.push((name, copy));
            }
        }
    }
    names
}
