//! Values as text.

use std::fmt::Write as _;

use glam::{Quat, Vec2, Vec3, Vec4};

use super::AssetNames;
use crate::entity::Entity;
use crate::value::{MaterialId, MeshId, Value};

/// How deep lists and named values may lie in each other.
const MAX_DEPTH: usize = 32;

/// Appends a value. `number` gives the number of an entity in the file.
pub(super) fn write_value(
    text: &mut String,
    value: &Value,
    assets: &dyn AssetNames,
    number: &dyn Fn(Entity) -> Option<u32>,
) {
    match value {
        Value::Bool(value) => push(text, value),
        Value::Int(value) => push(text, value),
        Value::Float(value) => push_debug(text, value),
        Value::Vec2(v) => write_numbers(text, "", &v.to_array()),
        Value::Vec3(v) => write_numbers(text, "", &v.to_array()),
        Value::Vec4(v) => write_numbers(text, "", &v.to_array()),
        Value::Quat(q) => write_numbers(text, "quat", &q.to_array()),
        // Only computed components hold matrices, and those are not written.
        Value::Mat3(m) => write_numbers(text, "", &m.to_cols_array()),
        Value::Mat4(m) => write_numbers(text, "", &m.to_cols_array()),
        Value::Text(value) => write_text(text, value),
        Value::Entity(entity) => match number(*entity) {
            Some(number) => push(text, format_args!("#{number}")),
            None => text.push_str("none"),
        },
        Value::Mesh(mesh) => {
            text.push_str("mesh ");
            match assets.mesh_name(*mesh) {
                Some(name) => write_text(text, &name),
                None => push(text, mesh.0),
            }
        }
        Value::Material(material) => {
            text.push_str("material ");
            match assets.material_name(*material) {
                Some(name) => write_text(text, &name),
                None => push(text, material.0),
            }
        }
        Value::List(items) => {
            text.push('[');
            for (i, item) in items.iter().enumerate() {
                text.push_str(if i == 0 { "" } else { ", " });
                write_value(text, item, assets, number);
            }
            text.push(']');
        }
        Value::Map(entries) => {
            text.push('{');
            for (i, (name, value)) in entries.iter().enumerate() {
                text.push_str(if i == 0 { " " } else { ", " });
                write_text(text, name);
                text.push_str(": ");
                write_value(text, value, assets, number);
            }
            text.push_str(if entries.is_empty() { "}" } else { " }" });
        }
    }
}

fn push(text: &mut String, value: impl std::fmt::Display) {
    // Writing to a string cannot fail.
    write!(text, "{value}").ok();
}

/// The shortest digits that read back as the same bits, with a point or exponent.
fn push_debug(text: &mut String, number: &f32) {
    write!(text, "{number:?}").ok();
}

fn write_numbers(text: &mut String, prefix: &str, numbers: &[f32]) {
    text.push_str(prefix);
    text.push('(');
    for (i, number) in numbers.iter().enumerate() {
        text.push_str(if i == 0 { "" } else { ", " });
        push_debug(text, number);
    }
    text.push(')');
}

/// Appends text in quotation marks, on one line.
pub(super) fn write_text(text: &mut String, value: &str) {
    text.push('"');
    for letter in value.chars() {
        match letter {
            '"' => text.push_str("\\\""),
            '\\' => text.push_str("\\\\"),
            '\n' => text.push_str("\\n"),
            letter if letter.is_control() || letter == '\u{2028}' => {
                push(text, letter.escape_unicode());
            }
            letter => text.push(letter),
        }
    }
    text.push('"');
}

/// Reads values from the rest of a line.
pub(super) struct Parser<'a> {
    rest: &'a str,
    assets: &'a mut dyn AssetNames,
    entity: &'a dyn Fn(u32) -> Option<Entity>,
    depth: usize,
}

impl<'a> Parser<'a> {
    /// `entity` gives the entity of a number in the file.
    pub fn new(
        rest: &'a str,
        assets: &'a mut dyn AssetNames,
        entity: &'a dyn Fn(u32) -> Option<Entity>,
    ) -> Self {
        Self {
            rest,
            assets,
            entity,
            depth: 0,
        }
    }

    /// The one value that the whole rest of the line is.
    pub fn only_value(mut self) -> Result<Value, String> {
        let value = self.value()?;
        match self.rest.trim() {
            "" => Ok(value),
            more => Err(format!("after the value stands `{more}`")),
        }
    }

    /// A text in quotes at the beginning of a line's rest, and what follows it.
    pub fn leading_text(mut self) -> Result<(String, String), String> {
        let text = self.text()?;
        Ok((text, self.rest.to_owned()))
    }

    fn accept(&mut self, token: &str) -> bool {
        match self.rest.trim_start().strip_prefix(token) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn expect(&mut self, token: &str) -> Result<(), String> {
        match self.accept(token) {
            true => Ok(()),
            false => Err(format!("expected `{token}`, found {}", self.found())),
        }
    }

    fn found(&self) -> String {
        match self.rest.trim_start().chars().next() {
            Some(_) => format!("`{}`", self.rest.trim()),
            None => "the end of the line".to_owned(),
        }
    }

    /// Letters, digits and what numbers are made of.
    fn word(&mut self) -> &'a str {
        self.rest = self.rest.trim_start();
        let of_word = |letter: char| letter.is_alphanumeric() || "+-._".contains(letter);
        let end = self.rest.find(|letter| !of_word(letter));
        let (word, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        self.rest = rest;
        word
    }

    fn value(&mut self) -> Result<Value, String> {
        if self.depth >= MAX_DEPTH {
            return Err(format!(
                "values lie more than {MAX_DEPTH} deep in each other"
            ));
        }
        self.depth += 1;
        let value = self.any_value();
        self.depth -= 1;
        value
    }

    fn any_value(&mut self) -> Result<Value, String> {
        match self.rest.trim_start().chars().next() {
            Some('"') => Ok(Value::Text(self.text()?)),
            Some('(') => self.vector(),
            Some('[') => self.list(),
            Some('{') => self.map(),
            Some('#') => self.entity(),
            _ => {
                let found = self.found();
                match self.word() {
                    "true" => Ok(Value::Bool(true)),
                    "false" => Ok(Value::Bool(false)),
                    "none" => Ok(Value::Entity(Entity::NONE)),
                    "quat" => match self.vector()? {
                        Value::Vec4(v) => Ok(Value::Quat(Quat::from_vec4(v))),
                        _ => Err("a rotation has four numbers".to_owned()),
                    },
                    "mesh" => match self.name_or_number()? {
                        Ok(name) => self.assets.mesh(&name).map(Value::Mesh),
                        Err(number) => Ok(Value::Mesh(MeshId(number))),
                    },
                    "material" => match self.name_or_number()? {
                        Ok(name) => self.assets.material(&name).map(Value::Material),
                        Err(number) => Ok(Value::Material(MaterialId(number))),
                    },
                    word => match (word.parse::<i64>(), word.parse::<f32>()) {
                        (Ok(number), _) => Ok(Value::Int(number)),
                        (_, Ok(number)) => Ok(Value::Float(number)),
                        _ => Err(format!("expected a value, found {found}")),
                    },
                }
            }
        }
    }

    fn name_or_number(&mut self) -> Result<Result<String, u32>, String> {
        if self.rest.trim_start().starts_with('"') {
            return Ok(Ok(self.text()?));
        }
        let found = self.found();
        let number = self.word().parse();
        number
            .map(Err)
            .map_err(|_| format!("expected a name in quotation marks, found {found}"))
    }

    fn entity(&mut self) -> Result<Value, String> {
        self.expect("#")?;
        let word = self.word();
        let number = word
            .parse()
            .map_err(|_| format!("`#{word}` is not the number of an entity"))?;
        let entity = (self.entity)(number);
        entity
            .map(Value::Entity)
            .ok_or_else(|| format!("there is no entity #{number} in this file"))
    }

    /// The items between two signs, with commas between them.
    fn items<T>(
        &mut self,
        open: &str,
        close: &str,
        mut item: impl FnMut(&mut Self) -> Result<T, String>,
    ) -> Result<Vec<T>, String> {
        self.expect(open)?;
        let mut items = Vec::new();
        while !self.accept(close) {
            if !items.is_empty() {
                self.expect(",")?;
            }
            items.push(item(self)?);
        }
        Ok(items)
    }

    fn list(&mut self) -> Result<Value, String> {
        self.items("[", "]", Self::value).map(Value::List)
    }

    fn map(&mut self) -> Result<Value, String> {
        let entries = self.items("{", "}", |parser| {
            let name = parser.text()?;
            parser.expect(":")?;
            Ok((name, parser.value()?))
        });
        entries.map(Value::Map)
    }

    fn vector(&mut self) -> Result<Value, String> {
        let numbers = self.items("(", ")", |parser| {
            let found = parser.found();
            let number = parser.word().parse::<f32>();
            number.map_err(|_| format!("expected a number, found {found}"))
        })?;
        match numbers[..] {
            [x, y] => Ok(Value::Vec2(Vec2::new(x, y))),
            [x, y, z] => Ok(Value::Vec3(Vec3::new(x, y, z))),
            [x, y, z, w] => Ok(Value::Vec4(Vec4::new(x, y, z, w))),
            _ => Err(format!(
                "expected two, three or four numbers, found {}",
                numbers.len()
            )),
        }
    }

    fn text(&mut self) -> Result<String, String> {
        self.expect("\"")?;
        let mut text = String::new();
        let mut letters = self.rest.chars();
        loop {
            match letters.next() {
                Some('"') => break,
                Some('\\') => match letters.next() {
                    Some('n') => text.push('\n'),
                    Some(letter @ ('"' | '\\')) => text.push(letter),
                    Some('u') => {
                        let rest = letters.as_str();
                        let (code, after) = rest
                            .strip_prefix('{')
                            .and_then(|rest| rest.split_once('}'))
                            .ok_or("expected `\\u{…}`")?;
                        let letter = u32::from_str_radix(code, 16).ok().and_then(char::from_u32);
                        text.push(letter.ok_or_else(|| format!("there is no letter {code}"))?);
                        letters = after.chars();
                    }
                    _ => return Err("after `\\` stands one of \" \\ n u".to_owned()),
                },
                Some(letter) => text.push(letter),
                None => return Err("the text has no closing quotation mark".to_owned()),
            }
        }
        self.rest = letters.as_str();
        Ok(text)
    }
}
