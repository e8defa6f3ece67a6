//! How functions are given to scripts.
//!
//! Every function goes through [`Api`], which notes its name, its form and its text for messages
//! and for the reference, and hands the arguments over unconverted: [`Arguments`] takes `1` and
//! `1.0` alike and says in plain words what was wrong, where Rhai would only say that no function
//! fits the types.

use std::any::TypeId;
use std::sync::Arc;

use lightbench_render::Place;
use lightbench_render::problem::suggestion;
use rhai::{
    Dynamic, Engine, EvalAltResult, FuncRegistration, NativeCallContext, Position, Variant,
};

use crate::names::{Entry, Names, list};
pub(crate) use crate::spelling::{spell, spell_call, spell_number, spell_text};

/// What a script did wrong in a call, in plain words. The engine adds the position.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Mistake {
    pub(crate) message: String,
    pub(crate) hint: Option<String>,
}

impl Mistake {
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            hint: None,
        }
    }

    pub(crate) fn with_hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}

impl From<Mistake> for Box<EvalAltResult> {
    fn from(mistake: Mistake) -> Self {
        EvalAltResult::ErrorRuntime(Dynamic::from(mistake), Position::NONE).into()
    }
}

/// A value of a type that scripts see as an object.
pub(crate) trait ScriptType: Clone + Send + Sync + 'static {
    /// The name that messages and the reference use, as in "entity".
    const NAME: &'static str;
}

/// Registers functions on an engine.
pub(crate) struct Api<'a> {
    engine: &'a mut Engine,
    names: &'a mut Names,
}

impl<'a> Api<'a> {
    pub(crate) fn new(engine: &'a mut Engine, names: &'a mut Names) -> Self {
        Self { engine, names }
    }

    /// The engine, for what has no form: operators and iterators.
    pub(crate) fn engine(&mut self) -> &mut Engine {
        self.engine
    }

    /// Puts the functions that follow under a heading of the reference.
    pub(crate) fn section(&mut self, title: &'static str) {
        self.names.begin_section(title);
    }

    /// Registers a type.
    pub(crate) fn object<T: ScriptType>(&mut self) {
        self.engine.register_type_with_name::<T>(T::NAME);
        self.names.add_type(T::NAME);
    }

    /// Registers a plain function by its form, as in `noise(x, y, z)`.
    pub(crate) fn function<R: Variant + Clone>(
        &mut self,
        form: &str,
        about: &'static str,
        body: impl Fn(&mut Arguments) -> Result<R, Mistake> + Send + Sync + 'static,
    ) {
        let entry = Arc::new(Entry::new(None, form, false, about));
        let types = vec![TypeId::of::<Dynamic>(); entry.arguments.len()];
        self.register(&entry.name.clone(), &types, entry, 0, body);
    }

    /// Registers a function in place of Rhai's own of the same name, which is bound to the types
    /// that it takes: one copy for each mixture of whole numbers and others.
    pub(crate) fn overload(
        &mut self,
        form: &str,
        about: &'static str,
        body: impl Fn(&mut Arguments) -> Result<f64, Mistake> + Send + Sync + 'static,
    ) {
        let entry = Arc::new(Entry::new(None, form, false, about));
        self.names.add(Entry::clone(&entry));
        let body = Arc::new(body);
        let count = entry.arguments.len();
        let kinds = [
            TypeId::of::<f64>(),
            TypeId::of::<i64>(),
            TypeId::of::<Dynamic>(),
        ];
        for mixture in 0..kinds.len().pow(count as u32) {
            let types: Vec<TypeId> = (0..count)
                .map(|index| kinds[mixture / kinds.len().pow(index as u32) % kinds.len()])
                .collect();
            let body = Arc::clone(&body);
            self.raw(
                &entry.name.clone(),
                &types,
                Arc::clone(&entry),
                0,
                move |a| body(a),
            );
        }
    }

    /// Registers a method of `T` by its form, as in `range(metres)`.
    pub(crate) fn method<T: ScriptType, R: Variant + Clone>(
        &mut self,
        form: &str,
        about: &'static str,
        body: impl Fn(T, &mut Arguments) -> Result<R, Mistake> + Send + Sync + 'static,
    ) {
        let entry = Arc::new(Entry::new(Some(T::NAME), form, false, about));
        let mut types = vec![TypeId::of::<Dynamic>(); entry.arguments.len() + 1];
        types[0] = TypeId::of::<T>();
        self.register(&entry.name.clone(), &types, entry, 1, with_receiver(body));
    }

    /// Registers a property of `T` that can only be read.
    pub(crate) fn getter<T: ScriptType, R: Variant + Clone>(
        &mut self,
        name: &str,
        about: &'static str,
        body: impl Fn(T, &mut Arguments) -> Result<R, Mistake> + Send + Sync + 'static,
    ) {
        let entry = Arc::new(Entry::new(Some(T::NAME), name, true, about));
        let types = [TypeId::of::<T>()];
        let name = format!("get${name}");
        self.register(&name, &types, entry, 1, with_receiver(body));
    }

    /// Registers writing to a property of `T`. The object is changed in place.
    pub(crate) fn setter<T: ScriptType>(
        &mut self,
        name: &str,
        body: impl Fn(&mut T, &mut Arguments) -> Result<(), Mistake> + Send + Sync + 'static,
    ) {
        let entry = Arc::new(Entry::new(Some(T::NAME), name, true, ""));
        let types = [TypeId::of::<T>(), TypeId::of::<Dynamic>()];
        let name = format!("set${name}");
        let body = move |arguments: &mut Arguments| {
            let mut object = arguments.receiver::<T>()?;
            body(&mut object, arguments)?;
            if let Some(mut place) = arguments.values[0].write_lock::<T>() {
                *place = object;
            }
            Ok(())
        };
        self.raw(&name, &types, entry, 1, body);
    }

    /// Registers one form for several mixtures of types, each of which Rhai prefers to a form that
    /// takes values of any type.
    pub(crate) fn typed<R: Variant + Clone>(
        &mut self,
        form: &str,
        mixtures: &[Vec<TypeId>],
        about: &'static str,
        body: impl Fn(&mut Arguments) -> Result<R, Mistake> + Send + Sync + 'static,
    ) {
        let entry = Arc::new(Entry::new(None, form, false, about));
        self.names.add(Entry::clone(&entry));
        let body = Arc::new(body);
        for types in mixtures {
            let body = Arc::clone(&body);
            self.raw(
                &entry.name.clone(),
                types,
                Arc::clone(&entry),
                0,
                move |a| body(a),
            );
        }
    }

    /// Registers writing to a property of what a handle stands for. The handle itself does not change,
    /// so that it may be a constant.
    pub(crate) fn handle_setter<T: ScriptType>(
        &mut self,
        name: &str,
        body: impl Fn(&T, &mut Arguments) -> Result<(), Mistake> + Send + Sync + 'static,
    ) {
        let entry = Entry::new(Some(T::NAME), name, true, "");
        let set = move |context: NativeCallContext, handle: &mut T, value: Dynamic| {
            let (mut receiver, mut value) = (Dynamic::from(handle.clone()), value);
            let mut arguments = Arguments {
                context: &context,
                values: &mut [&mut receiver, &mut value],
                entry: &entry,
                skip: 1,
            };
            body(handle, &mut arguments).map_err(Box::<EvalAltResult>::from)
        };
        FuncRegistration::new_setter(name)
            .with_purity(true)
            .register_into_engine(self.engine, set);
    }

    fn register<R: Variant + Clone>(
        &mut self,
        name: &str,
        types: &[TypeId],
        entry: Arc<Entry>,
        skip: usize,
        body: impl Fn(&mut Arguments) -> Result<R, Mistake> + Send + Sync + 'static,
    ) {
        self.names.add(Entry::clone(&entry));
        self.raw(name, types, entry, skip, body);
    }

    fn raw<R: Variant + Clone>(
        &mut self,
        name: &str,
        types: &[TypeId],
        entry: Arc<Entry>,
        skip: usize,
        body: impl Fn(&mut Arguments) -> Result<R, Mistake> + Send + Sync + 'static,
    ) {
        self.engine
            .register_raw_fn(name, types, move |context, values| {
                let mut arguments = Arguments {
                    context: &context,
                    values,
                    entry: &entry,
                    skip,
                };
                body(&mut arguments).map_err(Into::into)
            });
    }
}

/// Takes the receiver out of the arguments.
fn with_receiver<T: ScriptType, R>(
    body: impl Fn(T, &mut Arguments) -> Result<R, Mistake> + Send + Sync + 'static,
) -> impl Fn(&mut Arguments) -> Result<R, Mistake> + Send + Sync + 'static {
    move |arguments| {
        let receiver = arguments.receiver::<T>()?;
        body(receiver, arguments)
    }
}

/// The arguments of one call, with what is needed to speak about them.
///
/// Indices count the arguments in parentheses, from 0.
pub(crate) struct Arguments<'a, 'c, 'v, 'd> {
    context: &'a NativeCallContext<'c>,
    values: &'v mut [&'d mut Dynamic],
    entry: &'a Entry,
    skip: usize,
}

impl Arguments<'_, '_, '_, '_> {
    /// Where the call was written.
    pub(crate) fn place(&self) -> Place {
        place(self.context.call_source(), self.context.call_position())
    }

    /// How many arguments there are.
    pub(crate) fn len(&self) -> usize {
        self.values.len() - self.skip
    }

    /// The value itself.
    pub(crate) fn value(&self, index: usize) -> &Dynamic {
        self.values[index + self.skip]
    }

    /// The call as a script would write it, with the values in place of what was written.
    pub(crate) fn spelled(&self) -> Option<String> {
        let values = self.values[self.skip..].iter();
        let values: Option<Vec<String>> = values.map(|value| spell(value)).collect();
        Some(format!("{}({})", self.entry.name, values?.join(", ")))
    }

    fn receiver<T: ScriptType>(&self) -> Result<T, Mistake> {
        self.values[0]
            .read_lock::<T>()
            .map(|object| object.clone())
            .ok_or_else(|| Mistake::new(format!("this is no {}", T::NAME)))
    }

    /// A finite number.
    pub(crate) fn number(&self, index: usize) -> Result<f64, Mistake> {
        let value = self.value(index);
        let number = as_number(value).ok_or_else(|| self.wrong(index, "a number"))?;
        if number.is_finite() {
            Ok(number)
        } else {
            let what = format!("`{}` of `{}`", self.name(index), self.entry.name);
            Err(not_finite(&what, number))
        }
    }

    /// Whether an argument is a number.
    pub(crate) fn is_number(&self, index: usize) -> bool {
        as_number(self.value(index)).is_some()
    }

    /// A finite number as `f32`.
    pub(crate) fn float(&self, index: usize) -> Result<f32, Mistake> {
        self.number(index).map(|number| number as f32)
    }

    /// A number inside a range.
    pub(crate) fn number_in(&self, index: usize, min: f64, max: f64) -> Result<f64, Mistake> {
        let number = self.number(index)?;
        if (min..=max).contains(&number) {
            Ok(number)
        } else {
            let range = if max == f64::INFINITY {
                format!("at least {min}")
            } else {
                format!("from {min} to {max}")
            };
            Err(Mistake::new(format!(
                "`{}` of `{}` must be {range}, not {number}",
                self.name(index),
                self.entry.name
            )))
        }
    }

    /// A whole number inside a range. `3.0` is whole, `3.5` is not.
    pub(crate) fn whole(&self, index: usize, min: i64, max: i64) -> Result<i64, Mistake> {
        let number = self.number(index)?;
        if number.fract() != 0.0 {
            return Err(Mistake::new(format!(
                "`{}` of `{}` must be a whole number, not {number}",
                self.name(index),
                self.entry.name
            )));
        }
        let number = self.number_in(index, min as f64, max as f64)?;
        Ok(number as i64)
    }

    /// A text.
    pub(crate) fn text(&self, index: usize) -> Result<String, Mistake> {
        self.value(index)
            .clone()
            .into_string()
            .map_err(|_| self.wrong(index, "a text in quotes"))
    }

    /// `true` or `false`.
    pub(crate) fn switch(&self, index: usize) -> Result<bool, Mistake> {
        self.value(index)
            .as_bool()
            .map_err(|_| self.wrong(index, "`true` or `false`"))
    }

    /// An object of a type.
    pub(crate) fn object<T: ScriptType>(&self, index: usize) -> Result<T, Mistake> {
        self.try_object(index)
            .ok_or_else(|| self.wrong(index, &a(T::NAME)))
    }

    /// An object of a type, if the argument is one.
    pub(crate) fn try_object<T: ScriptType>(&self, index: usize) -> Option<T> {
        self.value(index)
            .read_lock::<T>()
            .map(|object| object.clone())
    }

    /// An array.
    pub(crate) fn array(&self, index: usize) -> Result<rhai::Array, Mistake> {
        self.value(index)
            .clone()
            .into_array()
            .map_err(|_| self.wrong(index, "an array"))
    }

    /// One of some names.
    pub(crate) fn choice<T: Copy>(
        &self,
        index: usize,
        choices: &[(&'static str, T)],
    ) -> Result<T, Mistake> {
        let text = self.text(index)?;
        choices
            .iter()
            .find(|(name, _)| *name == text)
            .map(|(_, choice)| *choice)
            .ok_or_else(|| {
                let names = || choices.iter().map(|(name, _)| *name);
                let mistake = Mistake::new(format!(
                    "`{}` of `{}` must be {}, not `{text}`",
                    self.name(index),
                    self.entry.name,
                    list(names(), "or")
                ));
                match suggestion(&text, names()) {
                    Some(hint) => mistake.with_hint(hint),
                    None => mistake,
                }
            })
    }

    /// The mistake of an argument of the wrong kind.
    pub(crate) fn wrong(&self, index: usize, wanted: &str) -> Mistake {
        let dot = if self.entry.receiver.is_some() {
            "."
        } else {
            ""
        };
        Mistake::new(format!(
            "`{}` of `{}` must be {wanted}, not {}",
            self.name(index),
            self.entry.name,
            describe(self.context.engine(), self.value(index))
        ))
        .with_hint(format!(
            "it is written `{dot}{}({})`",
            self.entry.name,
            self.entry.arguments.join(", ")
        ))
    }

    /// A value in plain words.
    pub(crate) fn describe(&self, value: &Dynamic) -> String {
        describe(self.context.engine(), value)
    }

    fn name(&self, index: usize) -> &str {
        // A property is written without arguments: what is assigned bears the property's name.
        self.entry
            .arguments
            .get(index)
            .map_or(self.entry.name.as_str(), String::as_str)
    }
}

/// The mistake of a number that is none, or infinite.
pub(crate) fn not_finite(what: &str, number: f64) -> Mistake {
    Mistake::new(format!(
        "{what} is {}: did something divide by zero?",
        if number.is_nan() {
            "not a number"
        } else {
            "infinite"
        },
    ))
}

/// A number, whether written `1` or `1.0`.
pub(crate) fn as_number(value: &Dynamic) -> Option<f64> {
    value
        .as_float()
        .ok()
        .or_else(|| value.as_int().ok().map(|whole| whole as f64))
}

/// The place of a position in a script.
pub(crate) fn place(source: Option<&str>, position: Position) -> Place {
    Place::new(
        source.unwrap_or_default(),
        position.line().unwrap_or(0) as u32,
        position.position().unwrap_or(0) as u32,
    )
}

/// A value in plain words, as in "the text `six`".
pub(crate) fn describe(engine: &Engine, value: &Dynamic) -> String {
    if let Some(number) = as_number(value) {
        return format!("the number {number}");
    }
    if let Ok(on) = value.as_bool() {
        return format!("`{on}`");
    }
    if let Ok(text) = value.clone().into_string() {
        let short: String = text.chars().take(40).collect();
        return if short.is_empty() {
            "an empty text".to_owned()
        } else if short == text {
            format!("the text `{text}`")
        } else {
            format!("the text `{short}…`")
        };
    }
    kind(engine.map_type_name(value.type_name()))
}

/// A type in plain words, from Rhai's name for it.
pub(crate) fn kind(name: &str) -> String {
    match name.trim() {
        "i64" | "f64" | "INT" | "FLOAT" => "a number".to_owned(),
        "bool" => "`true` or `false`".to_owned(),
        "string" | "&str | ImmutableString | String" => "a text".to_owned(),
        "char" => "a character".to_owned(),
        "()" => "nothing".to_owned(),
        "Fn" => "a function".to_owned(),
        name if name.starts_with("range") => "a range".to_owned(),
        name if name.contains("::") => "a value".to_owned(),
        name => a(name),
    }
}

/// The name with its article.
fn a(name: &str) -> String {
    let article = if name.starts_with(['a', 'e', 'i', 'o', 'u']) {
        "an"
    } else {
        "a"
    };
    format!("{article} {name}")
}
