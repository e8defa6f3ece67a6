//! Every name that scripts can use, with its forms, for messages and for the reference.

use std::any::TypeId;
use std::collections::BTreeSet;

use lightbench_render::problem::suggestion;

/// One form of a function, method or property.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The type that it belongs to, as in "entity"; `None` for a plain function.
    pub receiver: Option<&'static str>,
    /// Its name.
    pub name: String,
    /// Names of its arguments.
    pub arguments: Vec<String>,
    /// Whether it is read (and perhaps written) without parentheses.
    pub property: bool,
    /// What it does, with units and defaults.
    pub about: &'static str,
    /// Under which heading of the reference it belongs; empty where nobody said.
    pub section: &'static str,
    /// What it gives; unknown for the writing of a property.
    pub(crate) gives: Option<TypeId>,
}

impl Entry {
    /// Reads a form as `range(metres)`.
    pub(crate) fn new(
        receiver: Option<&'static str>,
        form: &str,
        property: bool,
        about: &'static str,
    ) -> Self {
        let (name, rest) = form.split_once('(').unwrap_or((form, ""));
        let arguments = rest
            .trim_end_matches(')')
            .split(',')
            .map(str::trim)
            .filter(|argument| !argument.is_empty())
            .map(str::to_owned)
            .collect();
        Self {
            receiver,
            name: name.trim().to_owned(),
            arguments,
            property,
            about,
            section: "",
            gives: None,
        }
    }

    /// The same with the type of what it gives.
    pub(crate) fn giving<R: 'static>(mut self) -> Self {
        self.gives = Some(TypeId::of::<R>());
        self
    }

    /// The form as one writes it: `at(x, y, z)`, `.range(metres)`, `.position`.
    #[must_use]
    pub fn form(&self) -> String {
        let dot = if self.receiver.is_some() { "." } else { "" };
        if self.property {
            return format!("{dot}{}", self.name);
        }
        format!("{dot}{}({})", self.name, self.arguments.join(", "))
    }
}

/// Every name that the engine gives to a kind of script.
#[derive(Clone, Debug, Default)]
pub struct Names {
    entries: Vec<Entry>,
    /// Properties that can be written too: of which type, and their names.
    settable: BTreeSet<(&'static str, String)>,
    /// Plain functions of Rhai itself.
    builtin: BTreeSet<String>,
    types: Vec<(TypeId, &'static str)>,
    /// The heading of what is added next.
    section: &'static str,
}

impl Names {
    /// The forms of everything that Lightbench adds to Rhai, in the order of registration.
    #[must_use]
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    pub(crate) fn add(&mut self, entry: Entry) {
        let section = self.section;
        self.entries.push(Entry { section, ..entry });
    }

    pub(crate) fn add_setter(&mut self, receiver: &'static str, name: &str) {
        self.settable.insert((receiver, name.to_owned()));
    }

    /// Whether a property can be written.
    pub(crate) fn is_settable(&self, property: &Entry) -> bool {
        let mut settable = self.settable.iter();
        settable
            .any(|(receiver, name)| Some(*receiver) == property.receiver && *name == property.name)
    }

    /// Puts what is added from now on under a heading of the reference.
    pub(crate) fn begin_section(&mut self, title: &'static str) {
        self.section = title;
    }

    pub(crate) fn add_type(&mut self, id: TypeId, name: &'static str) {
        if !self.is_type(name) {
            self.types.push((id, name));
        }
    }

    /// The types of objects, as scripts name them.
    pub(crate) fn types(&self) -> impl Iterator<Item = &'static str> {
        self.types.iter().map(|(_, name)| *name)
    }

    /// The type of what an entry gives, as scripts name it; `?` where it depends or is not known.
    pub(crate) fn given_by(&self, entry: &Entry) -> &'static str {
        let Some(id) = entry.gives else {
            return "?";
        };
        let of_objects = self.types.iter().copied();
        let plain = [
            (TypeId::of::<()>(), "()"),
            (TypeId::of::<bool>(), "bool"),
            (TypeId::of::<i64>(), "int"),
            (TypeId::of::<f64>(), "float"),
            (TypeId::of::<String>(), "String"),
            (TypeId::of::<rhai::ImmutableString>(), "String"),
            (TypeId::of::<rhai::Array>(), "Array"),
            (TypeId::of::<rhai::Map>(), "Map"),
        ];
        let mut all = of_objects.chain(plain);
        all.find(|(known, _)| *known == id)
            .map_or("?", |(_, name)| name)
    }

    /// Plain functions of Rhai itself.
    pub(crate) fn builtin(&self) -> impl Iterator<Item = &str> {
        self.builtin.iter().map(String::as_str)
    }

    /// Takes note of Rhai's own functions from their signatures, as in `push(array: array)`.
    pub(crate) fn add_builtin(&mut self, signature: &str) {
        let name = signature.split('(').next().unwrap_or_default().trim();
        let word = name.starts_with(|c: char| c.is_ascii_alphabetic())
            && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if word {
            self.builtin.insert(name.to_owned());
        }
    }

    pub(crate) fn is_type(&self, name: &str) -> bool {
        self.types.iter().any(|(_, known)| *known == name)
    }

    /// The forms of a method of that type, or of a plain function.
    pub(crate) fn forms(&self, receiver: Option<&str>, name: &str) -> Vec<String> {
        let mut forms: Vec<String> = self
            .entries
            .iter()
            .filter(|entry| entry.receiver == receiver && entry.name == name)
            .map(Entry::form)
            .collect();
        forms.dedup();
        forms
    }

    /// Whether Rhai itself has a function of that name.
    pub(crate) fn is_builtin(&self, name: &str) -> bool {
        self.builtin.contains(name)
    }

    /// The nearest plain function.
    pub(crate) fn near_function(&self, name: &str, own: &[String]) -> Option<String> {
        // As shaders and other languages call them.
        let elsewhere = [
            ("ceil", "ceiling"),
            ("fract", "fraction"),
            ("frac", "fraction"),
            ("mod", "modulo"),
            ("mix", "lerp"),
            ("radians", "to_radians"),
            ("degrees", "to_degrees"),
            ("quat", "turn"),
            ("mat4", "matrix"),
        ];
        if let Some((_, ours)) = elsewhere.iter().find(|(theirs, _)| *theirs == name) {
            return Some(format!("it is called `{ours}` here"));
        }
        let names = self
            .entries
            .iter()
            .filter(|entry| entry.receiver.is_none())
            .map(|entry| entry.name.as_str())
            .chain(own.iter().map(String::as_str))
            .chain(self.builtin.iter().map(String::as_str));
        suggestion(name, names)
    }

    /// The nearest method of that type.
    pub(crate) fn near_method(&self, receiver: &str, name: &str) -> Option<String> {
        suggestion(name, self.members(receiver, false))
    }

    /// The nearest property of that type.
    pub(crate) fn near_property(&self, receiver: &str, name: &str) -> Option<String> {
        suggestion(name, self.members(receiver, true))
    }

    /// The names of all methods, or all properties, of that type.
    pub(crate) fn members<'a>(
        &'a self,
        receiver: &'a str,
        property: bool,
    ) -> impl Iterator<Item = &'a str> {
        self.entries
            .iter()
            .filter(move |entry| entry.receiver == Some(receiver) && entry.property == property)
            .map(|entry| entry.name.as_str())
    }
}

/// A list for a sentence: `a`, `b` or `c`.
pub(crate) fn list<'a>(names: impl IntoIterator<Item = &'a str>, last: &str) -> String {
    let mut seen = BTreeSet::new();
    let names: Vec<String> = names
        .into_iter()
        .filter(|name| seen.insert(*name))
        .map(|name| format!("`{name}`"))
        .collect();
    match names.as_slice() {
        [] => String::new(),
        [only] => only.clone(),
        [front @ .., end] => format!("{} {last} {end}", front.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms_read_as_one_writes_them() {
        let entry = |receiver, form, property| Entry::new(receiver, form, property, "");
        assert_eq!(entry(None, "noise(x, y)", false).form(), "noise(x, y)");
        assert_eq!(entry(Some("lamp"), "off()", false).form(), ".off()");
        assert_eq!(entry(Some("vec3"), "x", true).form(), ".x");
        assert_eq!(entry(None, "noise(x, y)", false).arguments, ["x", "y"]);
    }

    #[test]
    fn lists_read_as_sentences() {
        assert_eq!(list(["a"], "or"), "`a`");
        assert_eq!(list(["a", "b", "a", "c"], "or"), "`a`, `b` or `c`");
    }
}
