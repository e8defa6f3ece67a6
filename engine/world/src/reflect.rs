//! What a component says about itself to the editor, to scripts and to files.

use crate::value::{Value, ValueType};

/// Who may see a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Shown in the editor and settable by scripts.
    Shown,
    /// Data that nothing draws yet, or that has its own API: kept and saved, but
    /// not offered in the editor or to scripts.
    Hidden,
    /// Written by a system, present wherever the component that it follows is.
    Computed,
}

/// A component's own description.
#[derive(Debug)]
pub struct ComponentInfo {
    /// The name that files and scripts use.
    pub name: &'static str,
    /// What the component is for.
    pub doc: &'static str,
    /// Who may see it.
    pub role: Role,
    /// Its fields, in the order in which they are declared.
    pub fields: &'static [FieldInfo],
}

impl ComponentInfo {
    /// Whether the editor and scripts leave the component out.
    pub fn hidden(&self) -> bool {
        self.role != Role::Shown
    }

    /// The field of this name with its position.
    pub fn field(&self, name: &str) -> Option<(usize, &'static FieldInfo)> {
        self.fields
            .iter()
            .enumerate()
            .find(|(_, field)| field.name == name)
    }
}

/// The description of one field.
#[derive(Debug)]
pub struct FieldInfo {
    /// The name that files and scripts use.
    pub name: &'static str,
    /// What the field means.
    pub doc: &'static str,
    /// What kind of value it holds.
    pub value_type: ValueType,
    /// The unit of its numbers; empty for none.
    pub unit: &'static str,
    /// The least and the greatest number that it accepts.
    pub range: (f32, f32),
    /// The value of a fresh component.
    pub default: fn() -> Value,
}

impl FieldInfo {
    /// Whether its three numbers are a linear Rec. 709 colour. A field that holds one is called
    /// `color` in every component.
    pub fn is_color(&self) -> bool {
        self.value_type == ValueType::Vec3 && self.name == "color"
    }
}

/// The range of a field that accepts every number.
pub const ANY: (f32, f32) = (f32::NEG_INFINITY, f32::INFINITY);

/// The range of a field whose numbers are not negative.
pub const POSITIVE: (f32, f32) = (0.0, f32::INFINITY);
