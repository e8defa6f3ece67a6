//! How functions are given to scripts.
//!
//! Every function goes through [`Api`], which notes its name, its form and its text for messages
//! and for the reference, and hands the arguments over unconverted: [`Arguments`] takes `1` and
//! `1.0` alike and says in plain words what was wrong, where Rhai would only say that no function
//! fits the types.

use std::any::TypeId;
use std::sync::Arc;

use lightbench_render::Problem;
use rhai::{
    Dynamic, Engine, EvalAltResult, FuncRegistration, NativeCallContext, Position, Variant,
};

pub(crate) use crate::arguments::{Arguments, as_number, kind, not_finite, place};
use crate::names::{Entry, Names};
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

/// A problem of another file, told at the line that asked for it.
impl From<Problem> for Mistake {
    fn from(problem: Problem) -> Self {
        Self {
            message: problem.message,
            hint: problem.hint,
        }
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
        self.names.add_type(TypeId::of::<T>(), T::NAME);
    }

    /// Registers a plain function by its form, as in `noise(x, y, z)`.
    pub(crate) fn function<R: Variant + Clone>(
        &mut self,
        form: &str,
        about: &'static str,
        body: impl Fn(&mut Arguments) -> Result<R, Mistake> + Send + Sync + 'static,
    ) {
        let entry = Arc::new(Entry::new(None, form, false, about).giving::<R>());
        let types = vec![TypeId::of::<Dynamic>(); entry.arguments.len()];
        self.register(&entry.name.clone(), &types, entry, 0, body);
    }

    /// Registers a plain function that calls a function of the script, whose errors are told as they are.
    pub(crate) fn calling_function<R: Variant + Clone>(
        &mut self,
        form: &str,
        about: &'static str,
        body: impl Fn(&mut Arguments) -> Result<R, Box<EvalAltResult>> + Send + Sync + 'static,
    ) {
        let entry = Arc::new(Entry::new(None, form, false, about));
        let types = vec![TypeId::of::<Dynamic>(); entry.arguments.len()];
        self.names.add(Entry::clone(&entry));
        self.raw(&entry.name.clone(), &types, entry, 0, body);
    }

    /// Registers a method of `T` that calls a function of the script.
    pub(crate) fn calling_method<T: ScriptType, R: Variant + Clone>(
        &mut self,
        form: &str,
        about: &'static str,
        body: impl Fn(T, &mut Arguments) -> Result<R, Box<EvalAltResult>> + Send + Sync + 'static,
    ) {
        let entry = Arc::new(Entry::new(Some(T::NAME), form, false, about));
        let mut types = vec![TypeId::of::<Dynamic>(); entry.arguments.len() + 1];
        types[0] = TypeId::of::<T>();
        self.names.add(Entry::clone(&entry));
        let body = move |arguments: &mut Arguments| {
            let receiver = arguments.receiver::<T>()?;
            body(receiver, arguments)
        };
        self.raw(&entry.name.clone(), &types, entry, 1, body);
    }

    /// Registers a function in place of Rhai's own of the same name, which is bound to the types
    /// that it takes: one copy for each mixture of whole numbers and others.
    pub(crate) fn overload(
        &mut self,
        form: &str,
        about: &'static str,
        body: impl Fn(&mut Arguments) -> Result<f64, Mistake> + Send + Sync + 'static,
    ) {
        let entry = Arc::new(Entry::new(None, form, false, about).giving::<f64>());
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
        let entry = Arc::new(Entry::new(Some(T::NAME), form, false, about).giving::<R>());
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
        let entry = Arc::new(Entry::new(Some(T::NAME), name, true, about).giving::<R>());
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
        self.names.add_setter(T::NAME, name);
        let entry = Arc::new(Entry::new(Some(T::NAME), name, true, ""));
        let types = [TypeId::of::<T>(), TypeId::of::<Dynamic>()];
        let name = format!("set${name}");
        let body = move |arguments: &mut Arguments| -> Result<(), Mistake> {
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
        let entry = Arc::new(Entry::new(None, form, false, about).giving::<R>());
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
        self.names.add_setter(T::NAME, name);
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

    fn raw<R: Variant + Clone, E: Into<Box<EvalAltResult>>>(
        &mut self,
        name: &str,
        types: &[TypeId],
        entry: Arc<Entry>,
        skip: usize,
        body: impl Fn(&mut Arguments) -> Result<R, E> + Send + Sync + 'static,
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
