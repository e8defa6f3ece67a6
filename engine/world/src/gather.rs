//! One field of many entities at once, for those who know it only by its name.
//!
//! Code that knows the component's type walks its slices. A script knows a name and a list of
//! entities; here it pays for the name once, and not once for each entity.

use std::marker::PhantomData;

use glam::Vec3;

use crate::columns::{Columns, check_range};
use crate::components::ComponentKind;
use crate::entity::Entity;
use crate::error::WorldError;
use crate::reflect::Role;
use crate::stores::{Stored, Visitor, VisitorMut};
use crate::ticks::Tick;
use crate::value::{FieldSlice, FieldSliceMut, FieldType};
use crate::world::World;

/// A type of field that is read and written for many entities at once.
pub trait Lane: FieldType + Copy {
    /// A field's array, if it holds this type.
    fn of(slice: FieldSlice<'_>) -> Option<&[Self]>;
    /// Like [`Lane::of`], to write.
    fn of_mut(slice: FieldSliceMut<'_>) -> Option<&mut [Self]>;
}

macro_rules! lane {
    ($type:ty, $variant:ident) => {
        impl Lane for $type {
            fn of(slice: FieldSlice<'_>) -> Option<&[Self]> {
                match slice {
                    FieldSlice::$variant(slice) => Some(slice),
                    _ => None,
                }
            }
            fn of_mut(slice: FieldSliceMut<'_>) -> Option<&mut [Self]> {
                match slice {
                    FieldSliceMut::$variant(slice) => Some(slice),
                    _ => None,
                }
            }
        }
    };
}

lane!(f32, Numbers);
lane!(Vec3, Vectors);

/// Why a field of many entities was not written, or not read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("entity number {index} of the list: {error}")]
pub struct Refused {
    /// At which entity of the list.
    pub index: usize,
    /// The reason.
    pub error: WorldError,
}

impl World {
    /// One field of each of many entities, in their order. The field is named by its position in
    /// the component's description.
    ///
    /// ```
    /// # use lightbench_world::{ComponentKind, Light, World};
    /// # let mut world = World::new();
    /// let lamps = world.spawn_batch((0..3).map(|_| (Light::default(),))).to_vec();
    /// let (range, _) = ComponentKind::Light.info().field("range").unwrap_or_else(|| panic!());
    /// let ranges = world.gather(ComponentKind::Light, range, &lamps, |range: f32| range)?;
    /// let halved: Vec<f32> = ranges.iter().map(|range| range * 0.5).collect();
    /// world.scatter(ComponentKind::Light, range, &lamps, &halved)?;
    /// assert_eq!(world.columns::<Light>().range(), halved);
    /// # Ok::<(), lightbench_world::Refused>(())
    /// ```
    ///
    /// # Errors
    /// An entity that was removed or lacks the component, or a field of another type.
    pub fn gather<F: Lane, T>(
        &self,
        kind: ComponentKind,
        field: usize,
        entities: &[Entity],
        convert: impl Fn(F) -> T,
    ) -> Result<Vec<T>, Refused> {
        let mut gather = Gather {
            field,
            entities,
            convert,
            found: Ok(Vec::new()),
            lane: PhantomData,
        };
        self.stores.get().visit_one(kind, &mut gather);
        gather
            .found
            .map_err(|failure| self.refused(kind, field, entities, failure))
    }

    /// Writes one field of each of many entities, and marks their rows as changed.
    ///
    /// # Errors
    /// As [`World::gather`]; also a computed component, another number of values than entities, and
    /// a value outside the field's range. Nothing is written then.
    pub fn scatter<F: Lane>(
        &mut self,
        kind: ComponentKind,
        field: usize,
        entities: &[Entity],
        values: &[F],
    ) -> Result<(), Refused> {
        let info = kind.info();
        if info.role == Role::Computed {
            let error = WorldError::Computed(info.name);
            return Err(Refused { index: 0, error });
        }
        let mut scatter = Scatter {
            field,
            entities,
            values,
            now: self.clock.now(),
            outcome: Ok(()),
        };
        self.stores.get_mut().visit_one_mut(kind, &mut scatter);
        scatter
            .outcome
            .map_err(|failure| self.refused(kind, field, entities, failure))
    }

    fn refused(
        &self,
        kind: ComponentKind,
        field: usize,
        entities: &[Entity],
        (index, failure): (usize, Failure),
    ) -> Refused {
        let component = kind.info().name;
        let field = kind.info().fields.get(field);
        let bad = |reason| WorldError::BadValue {
            component,
            field: field.map_or("", |field| field.name),
            reason,
        };
        let error = match failure {
            Failure::NoRow => match entities.get(index) {
                Some(&entity) if self.contains(entity) => WorldError::Missing { entity, component },
                entity => WorldError::Stale(entity.copied().unwrap_or_default()),
            },
            Failure::OtherType => bad("the field has another type".to_owned()),
            Failure::OtherCount(values) => bad(format!(
                "there are {values} values for {} entities",
                entities.len()
            )),
            Failure::BadValue(reason) => bad(reason),
        };
        Refused { index, error }
    }
}

enum Failure {
    /// The entity has no such component.
    NoRow,
    OtherType,
    OtherCount(usize),
    BadValue(String),
}

struct Gather<'a, F, T, C> {
    field: usize,
    entities: &'a [Entity],
    convert: C,
    found: Result<Vec<T>, (usize, Failure)>,
    lane: PhantomData<F>,
}

impl<F: Lane, T, G: Fn(F) -> T> Visitor for Gather<'_, F, T, G> {
    fn visit<C: Stored>(&mut self, columns: &Columns<C>) {
        self.found = match F::of(columns.lend(self.field)) {
            None => Err((0, Failure::OtherType)),
            Some(fields) => {
                let rows = self.entities.iter().enumerate();
                rows.map(|(index, &entity)| match columns.row_of(entity) {
                    Some(row) => Ok((self.convert)(fields[row])),
                    None => Err((index, Failure::NoRow)),
                })
                .collect()
            }
        };
    }
}

struct Scatter<'a, F> {
    field: usize,
    entities: &'a [Entity],
    values: &'a [F],
    now: Tick,
    outcome: Result<(), (usize, Failure)>,
}

impl<F: Lane> VisitorMut for Scatter<'_, F> {
    fn visit<C: Stored>(&mut self, columns: &mut Columns<C>) {
        columns.set_now(self.now);
        self.outcome = self.write(columns);
    }
}

impl<F: Lane> Scatter<'_, F> {
    fn write<C: Stored>(&self, columns: &mut Columns<C>) -> Result<(), (usize, Failure)> {
        if self.values.len() != self.entities.len() {
            return Err((0, Failure::OtherCount(self.values.len())));
        }
        let (fields, rows, mut marker) = columns.lend_mut(self.field);
        let fields = F::of_mut(fields).ok_or((0, Failure::OtherType))?;
        let info = &C::INFO.fields[self.field];
        // All is checked before anything is written.
        for (index, (value, &entity)) in self.values.iter().zip(self.entities).enumerate() {
            check_range(info, value.numbers())
                .map_err(|reason| (index, Failure::BadValue(reason)))?;
            rows.row_of(entity).ok_or((index, Failure::NoRow))?;
        }
        for (value, &entity) in self.values.iter().zip(self.entities) {
            if let Some(row) = rows.row_of(entity) {
                fields[row] = *value;
                marker.mark(row);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::components::{Light, Transform};

    fn field(kind: ComponentKind, name: &str) -> usize {
        kind.info().field(name).unwrap().0
    }

    #[test]
    fn what_is_scattered_is_gathered_and_marked() {
        let mut world = World::new();
        let all = world
            .spawn_batch((0..600).map(|_| (Transform::default(),)))
            .to_vec();
        // Every third, backwards: not the order of the rows.
        let some: Vec<Entity> = all.iter().rev().step_by(3).copied().collect();
        let values: Vec<Vec3> = (0..some.len()).map(|i| Vec3::splat(i as f32)).collect();
        let place = field(ComponentKind::Transform, "translation");
        let seen = world.observe();
        let kind = ComponentKind::Transform;
        world.scatter(kind, place, &some, &values).unwrap();
        let back = world.gather(kind, place, &some, |v: Vec3| v).unwrap();
        assert_eq!(back, values);
        for (entity, value) in some.iter().zip(&values) {
            assert_eq!(world.get::<Transform>(*entity).unwrap().translation, *value);
        }
        let columns = world.columns::<Transform>();
        let mut changed: Vec<Entity> = columns
            .changed_since(seen)
            .map(|row| columns.entities()[row])
            .collect();
        let mut expected = some.clone();
        changed.sort();
        expected.sort();
        assert_eq!(changed, expected);
    }

    #[test]
    fn refusals_name_the_entity_and_change_nothing() {
        let mut world = World::new();
        let lamps = world
            .spawn_batch((0..3).map(|_| (Light::default(),)))
            .to_vec();
        let range = field(ComponentKind::Light, "range");
        let kind = ComponentKind::Light;
        let refused = world.scatter(kind, range, &lamps, &[1.0, 2.0, -3.0]);
        assert_eq!(
            refused.unwrap_err().to_string(),
            "entity number 2 of the list: Light.range: -3 is outside 0 to inf m"
        );
        assert_eq!(world.columns::<Light>().range(), [10.0; 3]);
        let refused = world.scatter(kind, range, &lamps, &[1.0, 2.0]);
        assert!(refused.unwrap_err().to_string().contains("2 values for 3"));
        let refused = world.scatter(kind, range, &lamps, &[Vec3::ONE; 3]);
        assert!(refused.unwrap_err().to_string().contains("another type"));
        world.remove::<Light>(lamps[1]);
        let missing = world.gather(kind, range, &lamps, |range: f32| range);
        let missing = missing.unwrap_err();
        assert_eq!(missing.index, 1);
        assert!(matches!(missing.error, WorldError::Missing { .. }));
        world.despawn(lamps[0]);
        let stale = world.gather(kind, range, &lamps, |range: f32| range);
        assert_eq!(stale.unwrap_err().error, WorldError::Stale(lamps[0]));
        let bounds = ComponentKind::WorldBounds;
        let computed = world.scatter(bounds, 0, &[], &[] as &[f32]).unwrap_err();
        assert_eq!(computed.error, WorldError::Computed("WorldBounds"));
    }
}
