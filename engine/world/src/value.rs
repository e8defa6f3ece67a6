//! Values of fields, for those who know a field only by its name: scene files,
//! scripts and the editor.

use glam::{Affine2, Affine3A, Mat3, Mat4, Quat, Vec2, Vec3, Vec4};

use crate::entity::Entity;
use crate::merge::EntityMap;

/// The value of any field of any component.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Yes or no.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// A number.
    Float(f32),
    /// Two numbers.
    Vec2(Vec2),
    /// Three numbers: a position, a direction, a linear Rec. 709 colour.
    Vec3(Vec3),
    /// Four numbers.
    Vec4(Vec4),
    /// A rotation.
    Quat(Quat),
    /// An affine map of the plane.
    Mat3(Mat3),
    /// An affine map of space.
    Mat4(Mat4),
    /// Text, or one of the named choices of a [`ValueType::Choice`].
    Text(String),
    /// Another entity of the same world, or [`Entity::NONE`].
    Entity(Entity),
    /// A mesh, by handle.
    Mesh(MeshId),
    /// A material, by handle.
    Material(MaterialId),
    /// Several values of one type.
    List(Vec<Value>),
    /// Named values in the order in which they were given.
    Map(Vec<(String, Value)>),
}

/// What kind of value a field holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueType {
    /// [`Value::Bool`]
    Bool,
    /// [`Value::Int`]
    Int,
    /// [`Value::Float`]
    Float,
    /// [`Value::Vec2`]
    Vec2,
    /// [`Value::Vec3`]
    Vec3,
    /// [`Value::Vec4`]
    Vec4,
    /// [`Value::Quat`]
    Quat,
    /// [`Value::Mat3`]
    Mat3,
    /// [`Value::Mat4`]
    Mat4,
    /// [`Value::Text`]
    Text,
    /// [`Value::Text`] out of these.
    Choice(&'static [&'static str]),
    /// [`Value::Entity`]
    Entity,
    /// [`Value::Mesh`]
    Mesh,
    /// [`Value::Material`]
    Material,
    /// [`Value::List`] of this type.
    List(&'static ValueType),
    /// [`Value::Map`]
    Map,
}

/// A type that can be a field of a component.
pub trait FieldType: Clone + Send + Sync + 'static {
    /// The kind of value that stands for it.
    const TYPE: ValueType;
    /// The field as a value.
    fn to_value(&self) -> Value;
    /// The field from a value.
    ///
    /// # Errors
    /// A value of another kind, with a sentence that names both kinds.
    fn from_value(value: &Value) -> Result<Self, String>;
    /// The numbers inside that a range applies to; none where ranges make no
    /// sense.
    fn numbers(&self) -> ([f32; 4], usize) {
        ([0.0; 4], 0)
    }
    /// An array of such fields, if its elements are numbers or vectors.
    fn lend(_fields: &[Self]) -> FieldSlice<'_> {
        FieldSlice::Other
    }
    /// Like [`FieldType::lend`], to write.
    fn lend_mut(_fields: &mut [Self]) -> FieldSliceMut<'_> {
        FieldSliceMut::Other
    }
    /// Replaces handles to entities of one world by their copies in another.
    fn map_entities(&mut self, _map: &EntityMap) {}
    /// Bytes that the field holds outside its column.
    fn heap_bytes(&self) -> usize {
        0
    }
}

/// The array behind one field, for those who work on numbers and vectors only.
#[derive(Clone, Copy, Debug)]
pub enum FieldSlice<'a> {
    /// Numbers.
    Numbers(&'a [f32]),
    /// Vectors.
    Vectors(&'a [Vec3]),
    /// Something else.
    Other,
}

/// Like [`FieldSlice`], to write.
#[derive(Debug)]
pub enum FieldSliceMut<'a> {
    /// Numbers.
    Numbers(&'a mut [f32]),
    /// Vectors.
    Vectors(&'a mut [Vec3]),
    /// Something else.
    Other,
}

/// Named values, in the order in which they were given.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parameters(pub Vec<(String, Value)>);

/// A handle to a mesh. The asset store gives it out and knows what it means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MeshId(pub u32);

/// A handle to a material. The asset store gives it out and knows what it means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MaterialId(pub u32);

impl Value {
    /// The kind of the value in words, for messages.
    pub fn kind(&self) -> &'static str {
        match self {
            Value::Bool(_) => "true or false",
            Value::Int(_) => "a whole number",
            Value::Float(_) => "a number",
            Value::Vec2(_) => "two numbers",
            Value::Vec3(_) => "three numbers",
            Value::Vec4(_) => "four numbers",
            Value::Quat(_) => "a rotation",
            Value::Mat3(_) | Value::Mat4(_) => "a matrix",
            Value::Text(_) => "text",
            Value::Entity(_) => "an entity",
            Value::Mesh(_) => "a mesh",
            Value::Material(_) => "a material",
            Value::List(_) => "a list",
            Value::Map(_) => "named values",
        }
    }

    fn map_entities(&mut self, map: &EntityMap) {
        match self {
            Value::Entity(entity) => entity.map_entities(map),
            Value::List(items) => items.iter_mut().for_each(|item| item.map_entities(map)),
            Value::Map(entries) => {
                entries
                    .iter_mut()
                    .for_each(|(_, value)| value.map_entities(map));
            }
            _ => {}
        }
    }

    fn heap_bytes(&self) -> usize {
        match self {
            Value::Text(text) => text.capacity(),
            Value::List(items) => {
                items.capacity() * size_of::<Value>()
                    + items.iter().map(Value::heap_bytes).sum::<usize>()
            }
            Value::Map(entries) => map_bytes(entries),
            _ => 0,
        }
    }
}

/// Bytes that named values hold outside their vector.
fn map_bytes(entries: &Vec<(String, Value)>) -> usize {
    let inside = entries.iter();
    entries.capacity() * size_of::<(String, Value)>()
        + inside
            .map(|(name, value)| name.capacity() + value.heap_bytes())
            .sum::<usize>()
}

pub(crate) fn mismatch(expected: &str, value: &Value) -> String {
    format!("expected {expected}, found {}", value.kind())
}

/// `FieldType` for a type that is the payload of one variant.
macro_rules! field_type {
    ($type:ty, $variant:ident, $expected:literal $(, numbers $numbers:expr)? $(, lent as $lent:ident)?) => {
        impl FieldType for $type {
            const TYPE: ValueType = ValueType::$variant;
            fn to_value(&self) -> Value {
                Value::$variant(self.clone())
            }
            fn from_value(value: &Value) -> Result<Self, String> {
                match value {
                    Value::$variant(value) => Ok(value.clone()),
                    other => Err(mismatch($expected, other)),
                }
            }
            $(fn numbers(&self) -> ([f32; 4], usize) {
                let numbers: fn(&Self) -> ([f32; 4], usize) = $numbers;
                numbers(self)
            })?
            $(fn lend(fields: &[Self]) -> FieldSlice<'_> {
                FieldSlice::$lent(fields)
            }
            fn lend_mut(fields: &mut [Self]) -> FieldSliceMut<'_> {
                FieldSliceMut::$lent(fields)
            })?
        }
    };
}

field_type!(bool, Bool, "true or false");
field_type!(
    Vec2,
    Vec2,
    "two numbers",
    numbers | v | ([v.x, v.y, 0.0, 0.0], 2)
);
field_type!(
    Vec3,
    Vec3,
    "three numbers",
    numbers | v | ([v.x, v.y, v.z, 0.0], 3),
    lent as Vectors
);
field_type!(
    Vec4,
    Vec4,
    "four numbers",
    numbers | v | ([v.x, v.y, v.z, v.w], 4)
);
field_type!(
    Quat,
    Quat,
    "a rotation",
    numbers | q | ([q.x, q.y, q.z, q.w], 4)
);
field_type!(MeshId, Mesh, "a mesh");
field_type!(MaterialId, Material, "a material");

impl FieldType for Entity {
    const TYPE: ValueType = ValueType::Entity;
    fn to_value(&self) -> Value {
        Value::Entity(*self)
    }
    fn from_value(value: &Value) -> Result<Self, String> {
        match value {
            Value::Entity(entity) => Ok(*entity),
            other => Err(mismatch("an entity", other)),
        }
    }
    fn map_entities(&mut self, map: &EntityMap) {
        *self = map.get(*self).unwrap_or(Entity::NONE);
    }
}

impl FieldType for String {
    const TYPE: ValueType = ValueType::Text;
    fn to_value(&self) -> Value {
        Value::Text(self.clone())
    }
    fn from_value(value: &Value) -> Result<Self, String> {
        match value {
            Value::Text(text) => Ok(text.clone()),
            other => Err(mismatch("text", other)),
        }
    }
    fn heap_bytes(&self) -> usize {
        self.capacity()
    }
}

impl FieldType for f32 {
    const TYPE: ValueType = ValueType::Float;
    fn to_value(&self) -> Value {
        Value::Float(*self)
    }
    fn from_value(value: &Value) -> Result<Self, String> {
        match value {
            Value::Float(number) => Ok(*number),
            Value::Int(number) => Ok(*number as f32),
            other => Err(mismatch("a number", other)),
        }
    }
    fn numbers(&self) -> ([f32; 4], usize) {
        ([*self, 0.0, 0.0, 0.0], 1)
    }
    fn lend(fields: &[Self]) -> FieldSlice<'_> {
        FieldSlice::Numbers(fields)
    }
    fn lend_mut(fields: &mut [Self]) -> FieldSliceMut<'_> {
        FieldSliceMut::Numbers(fields)
    }
}

impl FieldType for u32 {
    const TYPE: ValueType = ValueType::Int;
    fn to_value(&self) -> Value {
        Value::Int(i64::from(*self))
    }
    fn from_value(value: &Value) -> Result<Self, String> {
        match value {
            Value::Int(number) => u32::try_from(*number)
                .map_err(|_| format!("expected a whole number from 0 to {}", u32::MAX)),
            other => Err(mismatch("a whole number", other)),
        }
    }
    fn numbers(&self) -> ([f32; 4], usize) {
        ([*self as f32, 0.0, 0.0, 0.0], 1)
    }
}

impl FieldType for Affine3A {
    const TYPE: ValueType = ValueType::Mat4;
    fn to_value(&self) -> Value {
        Value::Mat4(Mat4::from(*self))
    }
    fn from_value(value: &Value) -> Result<Self, String> {
        match value {
            Value::Mat4(matrix) => Ok(Affine3A::from_mat4(*matrix)),
            other => Err(mismatch("a matrix of 4 by 4", other)),
        }
    }
}

impl FieldType for Affine2 {
    const TYPE: ValueType = ValueType::Mat3;
    fn to_value(&self) -> Value {
        Value::Mat3(Mat3::from(*self))
    }
    fn from_value(value: &Value) -> Result<Self, String> {
        match value {
            Value::Mat3(matrix) => Ok(Affine2::from_mat3(*matrix)),
            other => Err(mismatch("a matrix of 3 by 3", other)),
        }
    }
}

impl<T: FieldType> FieldType for Vec<T> {
    const TYPE: ValueType = ValueType::List(&T::TYPE);
    fn to_value(&self) -> Value {
        Value::List(self.iter().map(FieldType::to_value).collect())
    }
    fn from_value(value: &Value) -> Result<Self, String> {
        match value {
            Value::List(items) => items
                .iter()
                .enumerate()
                .map(|(i, item)| T::from_value(item).map_err(|e| format!("item {i}: {e}")))
                .collect(),
            other => Err(mismatch("a list", other)),
        }
    }
    fn map_entities(&mut self, map: &EntityMap) {
        self.iter_mut().for_each(|item| item.map_entities(map));
    }
    fn heap_bytes(&self) -> usize {
        self.capacity() * size_of::<T>() + self.iter().map(FieldType::heap_bytes).sum::<usize>()
    }
}

impl FieldType for Parameters {
    const TYPE: ValueType = ValueType::Map;
    fn to_value(&self) -> Value {
        Value::Map(self.0.clone())
    }
    fn from_value(value: &Value) -> Result<Self, String> {
        match value {
            Value::Map(entries) => Ok(Self(entries.clone())),
            other => Err(mismatch("named values", other)),
        }
    }
    fn map_entities(&mut self, map: &EntityMap) {
        self.0
            .iter_mut()
            .for_each(|(_, value)| value.map_entities(map));
    }
    fn heap_bytes(&self) -> usize {
        map_bytes(&self.0)
    }
}

/// Declares a field type that is one of several named choices.
macro_rules! choice {
    ($(#[doc = $doc:literal])* $name:ident { $($(#[doc = $variant_doc:literal])* $variant:ident = $text:literal,)* }) => {
        $(#[doc = $doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $name { $($(#[doc = $variant_doc])* $variant,)* }

        impl $name {
            /// All choices, in the order in which they are declared.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// The name that files and scripts use.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $text),* }
            }
        }

        impl $crate::value::FieldType for $name {
            const TYPE: $crate::value::ValueType = $crate::value::ValueType::Choice(&[$($text),*]);
            fn to_value(&self) -> $crate::value::Value {
                $crate::value::Value::Text(self.name().to_owned())
            }
            fn from_value(value: &$crate::value::Value) -> Result<Self, String> {
                match value {
                    $($crate::value::Value::Text(text) if text == $text => Ok(Self::$variant),)*
                    $crate::value::Value::Text(text) => Err(format!(
                        "`{text}` is none of {}", [$($text),*].join(", "))),
                    other => Err(format!(
                        "expected one of {}, found {}", [$($text),*].join(", "), other.kind())),
                }
            }
        }
    };
}
pub(crate) use choice;
