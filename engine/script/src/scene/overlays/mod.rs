//! Overlays: what a person changed by hand on the entities that a script made.
//!
//! An overlay is a value for one field of the entity of one name. It lies over whatever the script
//! says: it is laid on again after the script was loaded anew, and after each step of a script that
//! writes the field too. It knows the script's own value, to give it back. One whose entity or
//! component is not there waits until it comes.

mod kept;
mod lines;
mod names;
mod structure;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use lightbench_world::glam::Vec3;
use lightbench_world::reflect::{FieldInfo, Role};
use lightbench_world::{ComponentKind, Entity, Name, Tick, Value, ValueType};

use super::Scene;
use super::data::Data;
use super::fields;
use super::tables::{self, Field};
pub use crate::scene::shelf::AssetId;
pub use kept::{KeptEdit, KeptField, KeptOverlays};
pub use lines::{degrees_of, line, rotation_of};
pub(crate) use lines::{spell_point, spell_single};
use structure::Done;
pub(super) use structure::LastListing;
pub use structure::{
    AssetEdit, Edit, LOCKED, Listed, Listing, NewKind, Picture, SurfaceField, SurfaceValue, Who,
    topmost,
};

/// One value that a person has set.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlay {
    /// What was asked for.
    pub value: Value,
    /// What the field held, or was given by the script since; `None` while the overlay waits.
    pub script: Option<Value>,
    /// Whether something else has written the field after the overlay was laid on: the scene's
    /// script, a behaviour, or a component that moves the entity.
    pub contested: bool,
    /// What the field holds. It differs from `value` where the scene does not take that whole.
    in_force: Option<Value>,
    entity: Entity,
    /// The point to which the entity was kept turned, where the change has ended that.
    aim: Option<Vec3>,
}

impl Overlay {
    /// Whether there is no such field to lie on.
    #[must_use]
    pub fn is_waiting(&self) -> bool {
        self.script.is_none()
    }
}

/// What of a scene was changed by hand: fields by the entity's name and the field, as in `light.range`,
/// and the structure as a list of edits.
#[derive(Clone, Debug, Default)]
pub struct Overlays {
    all: BTreeMap<(String, String), Overlay>,
    edits: Vec<Done>,
    /// The number of the last edit.
    serial: u64,
    /// Until when names were looked at for those that wait.
    looked: Option<Tick>,
    /// The revision of the assets at which materials were looked at.
    assets_seen: u64,
}

/// The name of a field in scripts, as in `mesh_renderer.visible`; `None` for components that scripts
/// and people are not offered.
#[must_use]
pub fn field_path(kind: ComponentKind, info: &FieldInfo) -> Option<&'static str> {
    let component = tables::components().iter().find(|c| c.kind == kind)?;
    let field = tables::field_of(component, info.name).ok()?;
    Some(&field.path)
}

/// Whether a field can be changed by hand.
///
/// # Errors
/// A sentence that says why not.
pub fn editable(kind: ComponentKind, info: &FieldInfo) -> Result<(), &'static str> {
    if kind.info().role == Role::Computed {
        return Err("The engine computes it.");
    }
    match info.value_type {
        _ if kind == ComponentKind::Name => Err("The name is changed in the field above."),
        ValueType::Bool
        | ValueType::Int
        | ValueType::Float
        | ValueType::Vec2
        | ValueType::Vec3
        | ValueType::Vec4
        | ValueType::Quat
        | ValueType::Text
        | ValueType::Choice(_) => Ok(()),
        ValueType::Mesh | ValueType::Material | ValueType::Entity => {
            Err("The scene's script makes it anew with each load: choose another one there.")
        }
        ValueType::Mat3 | ValueType::Mat4 | ValueType::List(_) | ValueType::Map => {
            Err("It has too many parts to be changed here: change it in the scene's script.")
        }
    }
}

fn is_finite(value: &Value) -> bool {
    match value {
        Value::Float(number) => number.is_finite(),
        Value::Vec2(pair) => pair.is_finite(),
        Value::Vec3(vector) => vector.is_finite(),
        Value::Vec4(four) => four.is_finite(),
        Value::Quat(rotation) => rotation.is_finite(),
        _ => true,
    }
}

impl Overlays {
    /// Nothing was changed.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Whether nothing was changed.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.all.is_empty() && self.edits.is_empty()
    }

    /// All changed fields with the entity's name and the field's path, by these.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str, &Overlay)> {
        self.all
            .iter()
            .map(|((entity, field), overlay)| (entity.as_str(), field.as_str(), overlay))
    }

    /// The overlay of a field.
    #[must_use]
    pub fn get(&self, entity: &str, field: &str) -> Option<&Overlay> {
        self.all.get(&(entity.to_owned(), field.to_owned()))
    }

    /// Those whose entity or component is not there.
    pub fn waiting(&self) -> impl Iterator<Item = (&str, &str, &Overlay)> {
        self.iter().filter(|(_, _, overlay)| overlay.is_waiting())
    }

    /// Changes a field by hand.
    ///
    /// # Errors
    /// A sentence, where the entity can't be found by its name, or the field does not take the value.
    pub fn set(
        &mut self,
        scene: &mut Scene,
        entity: Entity,
        path: &str,
        value: Value,
    ) -> Result<(), String> {
        let name = scene.keeps_by_name(entity)?;
        self.lay(scene, (entity, name), path, value)?;
        scene.refresh();
        Ok(())
    }

    /// Changes fields by hand. Gives how many of them, from the first on.
    ///
    /// # Errors
    /// As [`Overlays::set`], for the field after those.
    pub fn set_many(
        &mut self,
        scene: &mut Scene,
        fields: &[(Entity, &str, Value)],
    ) -> (usize, Result<(), String>) {
        let entities: Vec<Entity> = fields.iter().map(|(entity, ..)| *entity).collect();
        let names = match scene.keep_names(&entities) {
            Ok(names) => names,
            Err(why) => return (0, Err(why)),
        };
        let mut result = Ok(());
        let mut count = 0;
        for ((entity, path, value), name) in fields.iter().zip(names) {
            result = self.lay(scene, (*entity, name), path, value.clone());
            if result.is_err() {
                break;
            }
            count += 1;
        }
        scene.refresh();
        (count, result)
    }

    /// Lays a value on a field that was changed by hand before. Where the entity or its component is not
    /// there now, it waits for it, as it does after a load.
    ///
    /// # Errors
    /// A sentence, where the field does not take the value.
    pub fn lay_again(
        &mut self,
        scene: &mut Scene,
        entity: &str,
        path: &str,
        value: Value,
    ) -> Result<(), String> {
        let field = tables::field(path).map_err(|mistake| mistake.message)?;
        let found = scene.world.find(entity);
        let there = found.and_then(|found| scene.world.field_at(found, field.kind, field.index));
        if let (Some(found), Some(_)) = (found, there) {
            return self.set(scene, found, path, value);
        }
        editable(field.kind, field.info).map_err(str::to_owned)?;
        let waiting = Overlay {
            value,
            script: None,
            in_force: None,
            contested: false,
            entity: Entity::NONE,
            aim: None,
        };
        self.all
            .insert((entity.to_owned(), path.to_owned()), waiting);
        self.looked = None;
        Ok(())
    }

    fn lay(
        &mut self,
        scene: &mut Scene,
        (entity, name): (Entity, String),
        path: &str,
        value: Value,
    ) -> Result<(), String> {
        let field = tables::field(path).map_err(|mistake| mistake.message)?;
        editable(field.kind, field.info).map_err(str::to_owned)?;
        let before = scene
            .world
            .field_at(entity, field.kind, field.index)
            .ok_or_else(|| format!("`{name}` has no `{}`", field.component))?;
        if !is_finite(&value) {
            return Err("the number must be finite".to_owned());
        }
        if path == "camera.far"
            && let Some(Value::Float(near)) = scene.world.get_field(entity, "Camera", "near")
            && matches!(value, Value::Float(far) if far <= near)
        {
            // It would pull the near plane along, which nobody would give back.
            return Err(format!(
                "the near plane is at {near} m: bring it nearer first"
            ));
        }
        let aim = scene.aim_of(entity);
        scene.write_by_hand(entity, field, &value)?;
        let overlay = Overlay {
            aim: scene.lost_aim(entity, aim),
            in_force: scene.world.field_at(entity, field.kind, field.index),
            value,
            script: Some(before),
            contested: false,
            entity,
        };
        self.all
            .entry((name, path.to_owned()))
            .and_modify(|old| {
                let script = old.script.take();
                let (contested, aim) = (old.contested, old.aim);
                *old = overlay.clone();
                old.aim = overlay.aim.or(aim);
                if script.is_some() {
                    (old.script, old.contested) = (script, contested);
                }
            })
            .or_insert(overlay);
        Ok(())
    }

    /// Gives one field back to the script. Returns whether it had been changed.
    pub fn reset(&mut self, scene: &mut Scene, entity: &str, field: &str) -> bool {
        let key = (entity.to_owned(), field.to_owned());
        let Some(overlay) = self.all.remove(&key) else {
            return false;
        };
        overlay.take_off(scene, field);
        scene.refresh();
        true
    }

    /// Gives all fields of the entity of that name back to the script.
    pub fn reset_entity(&mut self, scene: &mut Scene, entity: &str) {
        let fields = self.iter().filter(|(name, ..)| *name == entity);
        let fields: Vec<String> = fields.map(|(_, field, _)| field.to_owned()).collect();
        for field in fields {
            self.reset(scene, entity, &field);
        }
    }

    /// Gives all fields back to the script. The structure stays.
    pub fn reset_all(&mut self, scene: &mut Scene) {
        for ((_, field), overlay) in std::mem::take(&mut self.all) {
            overlay.take_off(scene, &field);
        }
        scene.refresh();
    }

    /// Lays all on a scene that was loaded anew.
    pub fn lay_on(&mut self, scene: &mut Scene) {
        for overlay in self.all.values_mut() {
            *overlay = overlay.clone().lifted();
            overlay.contested = false;
        }
        self.replay(scene, 0);
        self.looked = None;
        self.follow(scene);
    }

    /// Lays them on again after a step, where something wrote a field too or an entity has come or
    /// gone.
    pub fn follow(&mut self, scene: &mut Scene) {
        if self.is_empty() {
            return;
        }
        let names = scene.world.columns::<Name>();
        let named = self
            .looked
            .is_none_or(|looked| names.any_changed_since(looked));
        let mut written = named && self.retry(scene);
        self.looked = Some(scene.world.observe());
        self.follow_surfaces(scene);
        for ((name, path), overlay) in &mut self.all {
            if let Ok(field) = tables::field(path) {
                written |= overlay.follow(scene, name, field, named);
            }
        }
        if written {
            scene.refresh();
        }
    }

    /// Goes on with a scene that was taken back to an earlier moment, at which `before` lay on it.
    pub fn taken_back(&mut self, scene: &mut Scene, before: &Self) {
        self.structure_taken_back(scene, before.clone());
        for overlay in self.all.values_mut() {
            *overlay = overlay.clone().lifted();
            overlay.contested = false;
        }
        self.settle(scene);
    }
}

impl Overlay {
    /// One that lies nowhere.
    fn lifted(self) -> Self {
        Self {
            script: None,
            in_force: None,
            entity: Entity::NONE,
            aim: None,
            ..self
        }
    }

    /// Returns whether the scene was written.
    fn follow(&mut self, scene: &mut Scene, name: &str, field: &Field, named: bool) -> bool {
        let is_called = |scene: &Scene, entity| {
            let names = scene.world.columns::<Name>();
            names.row_of(entity).map(|row| &names.text()[row]) == Some(&name.to_owned())
        };
        let is_there = is_called(scene, self.entity);
        let known = is_there && self.script.is_some();
        if !is_there {
            self.script = None;
            // A name that was looked for in vain is looked for again when names change.
            let found = named.then(|| scene.world.find(name)).flatten();
            let Some(found) = found else {
                self.entity = Entity::NONE;
                return false;
            };
            self.entity = found;
        }
        let Some(now) = scene.world.field_at(self.entity, field.kind, field.index) else {
            self.script = None;
            return false;
        };
        if known && self.in_force.as_ref() == Some(&now) {
            return false;
        }
        self.contested |= known;
        self.script = Some(now);
        let value = self.value.clone();
        let aim = scene.aim_of(self.entity);
        // A value that was taken once is out of range now only where the field itself has changed.
        let written = scene.write_by_hand(self.entity, field, &value).is_ok();
        self.in_force = scene.world.field_at(self.entity, field.kind, field.index);
        self.aim = scene.lost_aim(self.entity, aim).or(self.aim);
        written
    }

    fn take_off(self, scene: &mut Scene, path: &str) {
        let (Some(script), Ok(field)) = (self.script, tables::field(path)) else {
            return;
        };
        // What has gone needs nothing back.
        let _ = scene.write_by_hand(self.entity, field, &script);
        if let Some(aim) = self.aim.filter(|_| scene.world.contains(self.entity)) {
            // It was placed before too.
            let _turned = scene.on_data(|data| {
                data.aims.insert(self.entity, aim);
                data.place(self.entity, |_| {})
            });
        }
    }
}

impl Scene {
    /// Lends the world to something that works on what scripts work on.
    fn on_data<T>(&mut self, work: impl FnOnce(&mut Data) -> T) -> T {
        self.swap();
        let result = work(&mut self.stage.lock());
        self.swap();
        result
    }

    /// The point to which an entity is kept turned.
    fn aim_of(&self, entity: Entity) -> Option<Vec3> {
        self.stage.lock().aims.get(&entity).copied()
    }

    /// The point to which an entity was kept turned until now.
    fn lost_aim(&self, entity: Entity, before: Option<Vec3>) -> Option<Vec3> {
        before.filter(|_| self.aim_of(entity).is_none())
    }

    /// Writes a field as `set` of a script does.
    fn write_by_hand(
        &mut self,
        entity: Entity,
        field: &Field,
        value: &Value,
    ) -> Result<(), String> {
        self.swap();
        let written = fields::set(&mut self.stage.lock(), entity, field, value);
        self.swap();
        written.map_err(|mistake| mistake.message)
    }
}
