//! What a person changes of the scene's structure: entities that come and go, their names, places in
//! the tree, components and marks. Each is one step that can be taken back, over all that is chosen.

use std::collections::HashSet;

use lightbench::script::Scene;
use lightbench::script::overlays::{AssetEdit, Edit, LOCKED, NewKind, Who, topmost};
use lightbench::world::glam::{Affine3A, Vec3};
use lightbench::world::{
    ComponentKind, Entity, Light, MeshRenderer, Transform, Value, World, WorldMatrix,
};

use super::Workbench;
use super::history::Script;
use super::undo::{Change, Content, Target};
use crate::ui::messages::say;

/// Whether an entity, or one above it, is locked.
pub fn is_locked(world: &World, entity: Entity) -> bool {
    if world.tags().members(LOCKED).is_empty() {
        return false;
    }
    let mut above = std::iter::successors(Some(entity), |above| world.parent(*above));
    above.any(|entity| world.tags().contains(LOCKED, entity))
}

/// Entities below one that are looked at for whether it is shown: it is asked for rows of a list in
/// each frame.
const WALKED: usize = 500;

/// Whether something of an entity and of what hangs on it is drawn or shines; `None` where nothing
/// could. What hangs on it counts as long as it is not too much to look at.
pub fn is_shown(world: &World, entity: Entity) -> Option<bool> {
    let mut known = own_switch(world, entity);
    let mut below: Vec<Entity> = world.children(entity).take(WALKED).collect();
    let mut walked = 0;
    while known != Some(true)
        && let Some(next) = below.pop()
    {
        if walked == WALKED {
            return known.or(Some(true));
        }
        walked += 1;
        known = own_switch(world, next).or(known);
        let room = WALKED.saturating_sub(below.len());
        below.extend(world.children(next).take(room));
    }
    known
}

fn own_switch(world: &World, entity: Entity) -> Option<bool> {
    let mesh = world.get::<MeshRenderer>(entity).map(|mesh| mesh.visible);
    let light = world.get::<Light>(entity).map(|light| light.visible);
    match (mesh, light) {
        (None, None) => None,
        (mesh, light) => Some(mesh.unwrap_or(false) || light.unwrap_or(false)),
    }
}

/// From an entity's own space to the world's; that of what it hangs on, where it has no place.
fn to_world(world: &World, entity: Option<Entity>) -> Affine3A {
    let mut above = std::iter::successors(entity, |above| world.parent(*above));
    let placed = above.find_map(|entity| world.get::<WorldMatrix>(entity));
    placed.map_or(Affine3A::IDENTITY, |placed| placed.matrix)
}

impl Workbench {
    /// Changes the structure of the scene by hand, as one step.
    ///
    /// # Errors
    /// A sentence that says why it can't be. Then nothing has changed.
    pub fn edit(&mut self, edit: Edit) -> Result<(), String> {
        let chosen = self.names_chosen();
        let edit = self.do_edit(edit)?;
        let what = edit.words();
        self.note_structure(what, vec![done(edit)], chosen);
        Ok(())
    }

    /// Makes an entity where the view is turned to; a camera gets the view itself.
    ///
    /// # Errors
    /// As [`Workbench::edit`].
    pub fn create(&mut self, kind: NewKind) -> Result<(), String> {
        let place = match kind {
            NewKind::Camera if self.camera_of(self.focus()).flat().is_none() => {
                let to_world =
                    Affine3A::from_mat4(self.camera_of(self.focus()).view().view.inverse());
                let (_, rotation, translation) = to_world.to_scale_rotation_translation();
                Transform {
                    rotation,
                    translation,
                    ..Transform::default()
                }
            }
            NewKind::SpotLight | NewKind::DirectionalLight => {
                let at = self.camera_of(self.focus()).pivot();
                Transform::looking_at(at, at + Vec3::NEG_Y, Vec3::Y)
            }
            _ => Transform::from_translation(self.camera_of(self.focus()).pivot()),
        };
        self.edit(Edit::Create {
            kind,
            name: String::new(),
            number: 0,
            place,
        })
    }

    /// Makes copies of what is chosen, with all that hangs on it, and chooses these.
    ///
    /// # Errors
    /// As [`Workbench::edit`].
    pub fn duplicate_chosen(&mut self) -> Result<(), String> {
        let of = self.chosen(Who::topmost)?;
        self.edit(Edit::Copy {
            of,
            names: Vec::new(),
            number: 0,
        })
    }

    /// Removes what is chosen, with all that hangs on it.
    ///
    /// # Errors
    /// As [`Workbench::edit`].
    pub fn delete_chosen(&mut self) -> Result<(), String> {
        let of = self.chosen(Who::topmost)?;
        self.edit(Edit::Delete { of })
    }

    /// Calls what is chosen otherwise: one entity as given, several with a number behind it.
    ///
    /// # Errors
    /// As [`Workbench::edit`].
    pub fn rename_chosen(&mut self, name: &str) -> Result<(), String> {
        let of = self.chosen(Who::of)?;
        let name = name.trim();
        let names = (1..=of.len()).map(|number| match number {
            1 => name.to_owned(),
            number => format!("{name} {number}"),
        });
        let of = of.into_iter().zip(names).collect();
        self.edit(Edit::Rename { of })
    }

    /// Hangs entities below another one, or below none. They stay where they are in the world.
    ///
    /// # Errors
    /// As [`Workbench::edit`].
    pub fn put_below(&mut self, entities: &[Entity], to: Option<Entity>) -> Result<(), String> {
        let scene = self.scenes.scene_mut().ok_or_else(no_scene)?;
        scene.refresh();
        let entities = topmost(&scene.world, entities);
        let of = Who::of(&scene.world, &entities);
        let to_who = to.and_then(|to| Who::of(&scene.world, &[to]).pop());
        if to.is_some() && to_who.is_none() {
            return Err(say!("structure.the_entity_is_gone").to_owned());
        }
        let into = to_world(&scene.world, to).inverse();
        if !into.is_finite() {
            return Err(say!("structure.what_is_scaled_to_nothing_cant").to_owned());
        }
        let mut places = Vec::new();
        for entity in entities {
            if let Some(old) = scene.world.get::<Transform>(entity) {
                scene.keeps_by_name(entity)?;
                let local = into * to_world(&scene.world, Some(entity));
                let (scale, rotation, translation) = local.to_scale_rotation_translation();
                if !(scale.is_finite() && rotation.is_finite() && translation.is_finite()) {
                    return Err(say!("structure.it_has_no_place_that_could").to_owned());
                }
                places.push((entity, old, local));
            }
        }
        let chosen = self.names_chosen();
        let edit = self.do_edit(Edit::Parent { of, to: to_who })?;
        let what = edit.words();
        let mut changes = vec![done(edit)];
        for (entity, old, local) in places {
            let (scale, rotation, translation) = local.to_scale_rotation_translation();
            let near = 1e-5 * (1.0 + translation.abs().max_element());
            let stays = translation.abs_diff_eq(old.translation, near);
            let fields = [
                // First, because what is kept turned to a point turns when it moves.
                (
                    "transform.rotation",
                    Value::Quat(rotation.normalize()),
                    stays && rotation.dot(old.rotation).abs() > 1.0 - 1e-6,
                ),
                ("transform.translation", Value::Vec3(translation), stays),
                (
                    "transform.scale",
                    Value::Vec3(scale),
                    scale.abs_diff_eq(old.scale, 1e-5),
                ),
            ];
            for (path, value, same) in fields {
                if !same {
                    changes.push(self.change_field(entity, path, value)?);
                }
            }
        }
        self.note_structure(what, changes, chosen);
        Ok(())
    }

    /// Shows what is drawn or shines of what is chosen and of all that hangs on it, or hides it.
    ///
    /// # Errors
    /// A sentence that says why it can't be. Then nothing has changed.
    pub fn show_entities(&mut self, entities: &[Entity], on: bool) -> Result<(), String> {
        let scene = self.scenes.scene().ok_or_else(no_scene)?;
        let world = &scene.world;
        let mut fields: Vec<(Entity, &str, Value)> = Vec::new();
        let mut seen = HashSet::new();
        for root in entities {
            let below = world.descendants(*root);
            for entity in std::iter::once(*root).chain(below) {
                if !seen.insert(entity) {
                    continue;
                }
                let mesh = world.get::<MeshRenderer>(entity).map(|mesh| mesh.visible);
                let light = world.get::<Light>(entity).map(|light| light.visible);
                if mesh.is_some_and(|shown| shown != on) {
                    fields.push((entity, "mesh_renderer.visible", Value::Bool(on)));
                }
                if light.is_some_and(|shown| shown != on) {
                    fields.push((entity, "light.visible", Value::Bool(on)));
                }
            }
        }
        if fields.is_empty() {
            return Err(say!("structure.nothing_of_it_is_drawn_or").to_owned());
        }
        let changed: Vec<Entity> = fields.iter().map(|(entity, ..)| *entity).collect();
        scene.keep_names(&changed)?;
        let what = format!(
            "{} {}",
            if on {
                say!("structure.show")
            } else {
                say!("structure.hide")
            },
            self.words_for(entities)
        );
        self.undo.seal();
        let result = self.set_fields(&what, &fields);
        self.undo.seal();
        result
    }

    /// Locks entities, or unlocks them.
    ///
    /// # Errors
    /// As [`Workbench::edit`].
    pub fn lock_entities(&mut self, entities: &[Entity], on: bool) -> Result<(), String> {
        let scene = self.scenes.scene().ok_or_else(no_scene)?;
        let of = Who::of(&scene.world, entities);
        let tag = LOCKED.to_owned();
        self.edit(Edit::Tag { of, tag, on })
    }

    /// Gives what is chosen a component, where it has none such.
    ///
    /// # Errors
    /// As [`Workbench::edit`].
    pub fn add_component(&mut self, component: ComponentKind) -> Result<(), String> {
        let of = self.chosen(Who::of)?;
        self.edit(Edit::Add { of, component })
    }

    /// Takes a component away from what is chosen.
    ///
    /// # Errors
    /// As [`Workbench::edit`].
    pub fn drop_component(&mut self, component: ComponentKind) -> Result<(), String> {
        let of = self.chosen(Who::of)?;
        self.edit(Edit::Drop { of, component })
    }

    /// Takes back all changes of the structure, one by one, as changes of a step.
    pub(super) fn lift_structure(&mut self) -> Vec<Change> {
        let mut changes = Vec::new();
        while let Some(edit) = self.last_edit() {
            if self.take_back_edit(&edit).is_err() {
                break;
            }
            changes.push(Change {
                target: Target::Structure,
                before: Some(Content::Edit(Box::new(edit))),
                after: None,
            });
            // Fields that were changed on what comes back.
            let fields = self.lifted();
            for change in &fields {
                if let Target::Field { entity, path } = &change.target {
                    self.lift_field(entity, path);
                }
            }
            changes.extend(fields);
        }
        changes
    }

    /// Changes the structure, and chooses what was made.
    pub(super) fn do_edit(&mut self, edit: Edit) -> Result<Edit, String> {
        let name = self.scenes.shown().unwrap_or_default().to_owned();
        let overlays = self.overlays.entry(name).or_default();
        let scene = self.scenes.scene_mut().ok_or_else(no_scene)?;
        let edit = overlays.edit(scene, edit)?;
        if !overlays.made_last().is_empty() {
            self.selection
                .set(scene, overlays.made_last().iter().copied());
        }
        self.selection.names_changed(scene);
        let lines = overlays.edit_lines(scene).next_back();
        let line = match lines {
            Some((_, Ok(lines))) => lines,
            Some((_, Err(why))) => format!("// {why}"),
            None => String::new(),
        };
        // The way of a slider is one line.
        let target = match &edit {
            Edit::Assets(AssetEdit::Paint { .. }) => edit.words(),
            _ => String::new(),
        };
        self.history.add(&target, edit.words(), Script::Scene, line);
        self.canvas.invalidate();
        self.absorb_view();
        Ok(edit)
    }

    /// Takes a change of the structure back, which must be the last one.
    pub(super) fn take_back_edit(&mut self, edit: &Edit) -> Result<(), String> {
        if self.last_edit().as_ref() != Some(edit) {
            return Err(say!(
                "structure.was_not_the_last_change",
                words = edit.words()
            ));
        }
        self.on_overlays(|overlays, scene| {
            overlays.undo_edit(scene);
        });
        if let Some(scene) = self.scenes.scene() {
            self.selection.names_changed(scene);
        }
        Ok(())
    }

    fn last_edit(&self) -> Option<Edit> {
        let (edit, _) = self.overlays_now()?.edits().next_back()?;
        Some(edit.clone())
    }

    pub(super) fn chosen(
        &self,
        name: fn(&World, &[Entity]) -> Vec<Who>,
    ) -> Result<Vec<Who>, String> {
        let scene = self.scenes.scene().ok_or_else(no_scene)?;
        let chosen: Vec<Entity> = self.selection.entities().collect();
        Ok(name(&scene.world, &chosen))
    }

    fn words_for(&self, entities: &[Entity]) -> String {
        let world = self.scenes.scene().map(|scene: &Scene| &scene.world);
        match (entities, world) {
            ([one], Some(world)) => Who::of(world, &[*one])
                .first()
                .map_or_else(String::new, Who::words),
            (all, _) => say!("structure.entities", all = all.len()),
        }
    }

    /// Takes note of a change that may go on, as while a slider is dragged.
    pub(super) fn note_growing(&mut self, edit: Edit) {
        self.undo.seal();
        self.undo.note(edit.words(), vec![done(edit)]);
    }

    fn note_structure(&mut self, what: String, changes: Vec<Change>, chosen: Vec<String>) {
        self.undo.seal();
        self.undo.note_with(what, changes, chosen);
        self.undo.seal();
    }

    /// The names of what is chosen, of those that have one.
    fn names_chosen(&self) -> Vec<String> {
        let chosen: Vec<Entity> = self.selection.entities().collect();
        let mut names = self.names_of(&chosen);
        names.retain(|name| !name.is_empty());
        names
    }
}

fn done(edit: Edit) -> Change {
    Change {
        target: Target::Structure,
        before: None,
        after: Some(Content::Edit(Box::new(edit))),
    }
}

fn no_scene() -> String {
    say!("structure.no_scene_is_loaded").to_owned()
}
