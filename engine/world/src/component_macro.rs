//! The macro that declares all components.
//!
//! `components!` reads a list of components. For each one it makes
//!
//! - the row struct (`Transform`) with its default,
//! - a module (`transform`) with the arrays, one `Vec` a field, and with the
//!   structs `Slices` and `SlicesMut` that lend out all of them,
//! - a getter for each field's slice on `Columns<Transform>`,
//! - the description by which files, scripts and the editor know it.
//!
//! For all of them together it makes `Stores`, which holds one set of columns a
//! component, and the enum `ComponentKind`.

/// Declares one component. `components!` calls it for each.
macro_rules! component {
    (
        $(#[doc = $doc:literal])*
        $(#[derive($($derive:ident),*)])?
        $module:ident: $name:ident, $role:ident {
            $(
                $(#[doc = $field_doc:literal])*
                $field:ident: $type:ty = $default:expr, $unit:literal, $range:expr;
            )*
        }
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, Debug, PartialEq $($(, $derive)*)?)]
        pub struct $name {
            $($(#[doc = $field_doc])* pub $field: $type,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }

        impl $crate::columns::Component for $name {
            type Arrays = $module::Arrays;
            const INFO: &'static $crate::reflect::ComponentInfo = &$crate::reflect::ComponentInfo {
                name: stringify!($name),
                doc: concat!($($doc, "\n"),*),
                role: $crate::reflect::Role::$role,
                fields: &[$($crate::reflect::FieldInfo {
                    name: stringify!($field),
                    doc: concat!($($field_doc, "\n"),*),
                    value_type: <$type as $crate::value::FieldType>::TYPE,
                    unit: $unit,
                    range: $range,
                    default: || {
                        let value: $type = $default;
                        $crate::value::FieldType::to_value(&value)
                    },
                },)*],
            };
        }

        impl $crate::columns::Columns<$name> {
            $($(#[doc = $field_doc])*
            pub fn $field(&self) -> &[$type] {
                self.slices().$field
            })*
        }

        #[doc = concat!("The arrays behind [`", stringify!($name), "`](crate::components::", stringify!($name), ").")]
        pub mod $module {
            use super::*;

            #[doc = concat!("One array for every field of `", stringify!($name), "`.")]
            #[derive(Clone, Debug, Default)]
            pub struct Arrays {
                $($field: Vec<$type>,)*
            }

            #[doc = concat!("A slice for every field of `", stringify!($name), "`.")]
            #[derive(Clone, Copy, Debug)]
            pub struct Slices<'a> {
                $($(#[doc = $field_doc])* pub $field: &'a [$type],)*
            }

            #[doc = concat!("A mutable slice for every field of `", stringify!($name), "`.")]
            #[derive(Debug)]
            pub struct SlicesMut<'a> {
                $($(#[doc = $field_doc])* pub $field: &'a mut [$type],)*
            }

            impl $crate::batches::SliceSet for SlicesMut<'_> {
                fn split(self, row: usize) -> (Self, Self) {
                    $(let $field = self.$field.split_at_mut(row);)*
                    (Self { $($field: $field.0,)* }, Self { $($field: $field.1,)* })
                }
            }

            impl $crate::columns::Arrays for Arrays {
                type Row = $name;
                type Slices<'a> = Slices<'a>;
                type SlicesMut<'a> = SlicesMut<'a>;

                fn reserve(&mut self, additional: usize) {
                    $(self.$field.reserve(additional);)*
                }
                fn shrink_to_fit(&mut self) {
                    $(self.$field.shrink_to_fit();)*
                }
                #[inline]
                fn push(&mut self, row: $name) {
                    $(self.$field.push(row.$field);)*
                }
                fn push_mapped(&mut self, mut row: $name, map: &$crate::merge::EntityMap) {
                    $($crate::value::FieldType::map_entities(&mut row.$field, map);)*
                    self.push(row);
                }
                fn extend_with(&mut self, row: $name, count: usize) {
                    $(self.$field.resize(self.$field.len() + count, row.$field);)*
                }
                #[inline]
                fn discard(&mut self, row: usize) {
                    $(self.$field.swap_remove(row);)*
                }
                fn fill_holes(&mut self, moves: &[(u32, u32)], len: usize) {
                    $(
                        for &(hole, source) in moves {
                            self.$field.swap(hole as usize, source as usize);
                        }
                        self.$field.truncate(len);
                    )*
                }
                #[inline]
                fn swap_remove(&mut self, row: usize) -> $name {
                    $name { $($field: self.$field.swap_remove(row),)* }
                }
                #[inline]
                fn get(&self, row: usize) -> $name {
                    $name { $($field: self.$field[row].clone(),)* }
                }
                #[inline]
                fn set(&mut self, row: usize, value: $name) {
                    $(self.$field[row] = value.$field;)*
                }
                fn reorder(&mut self, order: &[u32]) {
                    $(self.$field = order.iter().map(|&row| self.$field[row as usize].clone()).collect();)*
                }
                fn slices(&self) -> Slices<'_> {
                    Slices { $($field: &self.$field,)* }
                }
                fn slices_mut(&mut self) -> SlicesMut<'_> {
                    SlicesMut { $($field: &mut self.$field,)* }
                }
                fn field(&self, row: usize, field: usize) -> Option<$crate::value::Value> {
                    let fields: &[fn(&Self, usize) -> $crate::value::Value] = &[
                        $(|arrays, row| $crate::value::FieldType::to_value(&arrays.$field[row]),)*
                    ];
                    Some(fields.get(field)?(self, row))
                }
                fn set_field(&mut self, row: usize, field: usize, value: &$crate::value::Value, check: bool) -> Result<(), String> {
                    type Set = fn(&mut Arrays, usize, &$crate::value::Value, Option<&$crate::reflect::FieldInfo>) -> Result<(), String>;
                    let fields: &[Set] = &[$(|arrays, row, value, range_of| {
                        let value: $type = $crate::value::FieldType::from_value(value)?;
                        if let Some(info) = range_of {
                            $crate::columns::check_range(info, $crate::value::FieldType::numbers(&value))?;
                        }
                        arrays.$field[row] = value;
                        Ok(())
                    },)*];
                    let info = <$name as $crate::columns::Component>::INFO.fields;
                    match (fields.get(field), info.get(field)) {
                        (Some(set), Some(info)) => set(self, row, value, check.then_some(info)),
                        _ => Err(format!("there is no field number {field}")),
                    }
                }
                fn lend(&self, field: usize) -> $crate::value::FieldSlice<'_> {
                    type Lend = for<'a> fn(&'a Arrays) -> $crate::value::FieldSlice<'a>;
                    let fields: &[Lend] = &[$(|arrays| $crate::value::FieldType::lend(&arrays.$field),)*];
                    fields.get(field).map_or($crate::value::FieldSlice::Other, |lend| lend(self))
                }
                fn lend_mut(&mut self, field: usize) -> $crate::value::FieldSliceMut<'_> {
                    type Lend = for<'a> fn(&'a mut Arrays) -> $crate::value::FieldSliceMut<'a>;
                    let fields: &[Lend] = &[$(|arrays| $crate::value::FieldType::lend_mut(&mut arrays.$field),)*];
                    match fields.get(field) {
                        Some(lend) => lend(self),
                        None => $crate::value::FieldSliceMut::Other,
                    }
                }
                fn capacity_bytes(&self) -> usize {
                    0 $(+ self.$field.capacity() * size_of::<$type>()
                        + self.$field.iter().map($crate::value::FieldType::heap_bytes).sum::<usize>())*
                }
            }
        }
    };
}
pub(crate) use component;

/// Declares all components and the struct that holds their columns.
///
/// `Name, Role` says who may see a component ([`Role`](crate::reflect::Role));
/// `followed by x` names the computed component whose rows come, move and go
/// together with this one's, so that row `i` of both is the same entity.
macro_rules! components {
    ($(
        $(# $attribute:tt)*
        $module:ident: $name:ident, $role:ident $(followed by $follower:ident)? { $($fields:tt)* }
    )*) => {
        $($crate::component_macro::component! {
            $(# $attribute)*
            $module: $name, $role { $($fields)* }
        })*

        /// One name for each component type.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u8)]
        pub enum ComponentKind {
            $(#[doc = concat!("[`", stringify!($name), "`]")] $name,)*
        }

        impl ComponentKind {
            /// All component types in the order in which they are declared.
            pub const ALL: &'static [Self] = &[$(Self::$name),*];

            /// The component type of this name.
            pub fn from_name(name: &str) -> Option<Self> {
                match name {
                    $(stringify!($name) => Some(Self::$name),)*
                    _ => None,
                }
            }

            pub(crate) fn insert_default(
                self,
                world: &mut $crate::World,
                entity: $crate::Entity,
            ) -> Result<(), $crate::WorldError> {
                match self { $(Self::$name => world.insert(entity, $name::default()),)* }
            }

            pub(crate) fn remove(self, world: &mut $crate::World, entity: $crate::Entity) -> bool {
                match self { $(Self::$name => world.remove::<$name>(entity).is_some(),)* }
            }

            /// The component's own description.
            pub fn info(self) -> &'static $crate::reflect::ComponentInfo {
                match self { $(Self::$name => <$name as $crate::columns::Component>::INFO,)* }
            }
        }

        /// The row of any component.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Row {
            $(#[doc = concat!("A [`", stringify!($name), "`]")] $name($name),)*
        }

        impl Row {
            /// Whose row it is.
            pub fn kind(&self) -> ComponentKind {
                match self { $(Self::$name(_) => ComponentKind::$name,)* }
            }

            /// Gives an entity the component.
            ///
            /// # Errors
            /// As [`World::insert`](crate::World::insert).
            pub fn insert_into(
                self,
                world: &mut $crate::World,
                entity: $crate::Entity,
            ) -> Result<(), $crate::WorldError> {
                match self { $(Self::$name(row) => world.insert(entity, row),)* }
            }
        }

        $(impl From<$name> for Row {
            fn from(row: $name) -> Self {
                Self::$name(row)
            }
        })*

        /// One set of columns for each component type.
        #[derive(Clone, Debug, Default)]
        pub struct Stores {
            $($module: $crate::columns::Columns<$name>,)*
        }

        impl Stores {
            /// Adds copies of all rows of another world.
            pub(crate) fn append(
                &mut self,
                other: &Self,
                map: &$crate::merge::EntityMap,
                now: $crate::ticks::Tick,
            ) {
                $(
                    self.$module.set_now(now);
                    self.$module.append(&other.$module, map);
                )*
            }

            /// Calls the visitor with every set of columns, in a fixed order.
            pub(crate) fn visit<V: $crate::stores::Visitor>(&self, visitor: &mut V) {
                $(visitor.visit(&self.$module);)*
            }

            /// Calls the visitor with every set of columns, in a fixed order.
            pub(crate) fn visit_mut<V: $crate::stores::VisitorMut>(&mut self, visitor: &mut V) {
                $(visitor.visit(&mut self.$module);)*
            }

            /// Calls the visitor with the columns of one component.
            pub(crate) fn visit_one<V: $crate::stores::Visitor>(&self, kind: ComponentKind, visitor: &mut V) {
                match kind { $(ComponentKind::$name => visitor.visit(&self.$module),)* }
            }

            /// Calls the visitor with the columns of one component.
            pub(crate) fn visit_one_mut<V: $crate::stores::VisitorMut>(&mut self, kind: ComponentKind, visitor: &mut V) {
                match kind { $(ComponentKind::$name => visitor.visit(&mut self.$module),)* }
            }
        }

        $(impl $crate::stores::Stored for $name {
            const KIND: ComponentKind = ComponentKind::$name;
            const BITS: u32 = 1 << ComponentKind::$name as u32 $(| 1 << <$follower as $crate::stores::Stored>::KIND as u32)?;
            fn columns(stores: &Stores) -> &$crate::columns::Columns<Self> {
                &stores.$module
            }
            fn columns_mut(stores: &mut Stores) -> &mut $crate::columns::Columns<Self> {
                &mut stores.$module
            }
            $(
                fn extend_follower(stores: &mut Stores, entities: &[$crate::entity::Entity], now: $crate::ticks::Tick) {
                    let columns = <$follower as $crate::stores::Stored>::columns_mut(stores);
                    columns.set_now(now);
                    columns.extend_default(entities);
                }
                fn push_follower(stores: &mut Stores, entity: $crate::entity::Entity, now: $crate::ticks::Tick) {
                    let columns = <$follower as $crate::stores::Stored>::columns_mut(stores);
                    columns.set_now(now);
                    columns.push(entity, Default::default());
                }
                fn reserve_follower(stores: &mut Stores, additional: usize) {
                    <$follower as $crate::stores::Stored>::columns_mut(stores).reserve(additional);
                }
                fn reorder_follower(stores: &mut Stores, order: &[u32], now: $crate::ticks::Tick) {
                    let columns = <$follower as $crate::stores::Stored>::columns_mut(stores);
                    columns.set_now(now);
                    columns.reorder(order);
                }
                fn remove_follower(stores: &mut Stores, entity: $crate::entity::Entity, now: $crate::ticks::Tick) {
                    let columns = <$follower as $crate::stores::Stored>::columns_mut(stores);
                    columns.set_now(now);
                    columns.discard(entity);
                }
            )?
        })*
    };
}
pub(crate) use components;
