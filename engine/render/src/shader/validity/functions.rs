//! What can be wrong inside a function.

use naga::valid::{CallError, FunctionError, LocalVariableError, UniformityRequirements};
use naga::{Expression, Function, Handle};

use super::expressions::pointed;
use super::{Context, Reason, lacking};

impl Context<'_> {
    pub(super) fn function(
        &self,
        function: Option<&Function>,
        name: &str,
        error: &FunctionError,
    ) -> Reason {
        use FunctionError as E;
        let ty = |expression: Handle<Expression>| self.expression_type(function, expression);
        let is = |expression| {
            let found = ty(expression);
            found.map_or_else(String::new, |found| format!(", but is `{found}`"))
        };
        match error {
            E::Expression { handle, source } => self.expression(function, Some(*handle), source),
            E::InvalidImageStore(source) | E::InvalidImageAtomic(source) => {
                self.expression(function, None, source)
            }
            E::LocalVariable { name, source, .. } => match source {
                LocalVariableError::InitializerType => {
                    Reason::new(format!("the first value of `{name}` has another type than it declares"))
                }
                _ => Reason::new(format!("`{name}` has a type that a variable can't have"))
                    .hint("textures, samplers and arrays without a length are declared outside of functions"),
            },
            E::InvalidArgumentType { name, .. } | E::InvalidArgumentPointerSpace { name, .. } => {
                Reason::new(format!("the argument `{name}` has a type that can't be handed over"))
            }
            E::NonConstructibleReturnType => {
                Reason::new(format!("`{name}` returns a type that can't be handed over"))
            }
            E::BreakOutsideOfLoopOrSwitch => Reason::new("`break` belongs inside a loop or `switch`"),
            E::ContinueOutsideOfLoop => Reason::new("`continue` belongs inside a loop"),
            E::InvalidReturnSpot => Reason::new("`return` can't stand in `continuing`"),
            E::InvalidReturnType {
                expression,
                expected_ty,
            } => {
                let expected = expected_ty.and_then(|ty| self.type_name(ty));
                let found = expression.and_then(ty);
                match (expected, found) {
                    (Some(expected), Some(found)) => {
                        Reason::new(format!("`{name}` must return `{expected}`, but returns `{found}`"))
                            .convert(&found, &expected)
                    }
                    (Some(expected), None) => Reason::new(format!(
                        "`{name}` must return `{expected}`, but a way through it returns nothing"
                    ))
                    .hint("let each `if` that returns have an `else` that does, or end with `return …;`"),
                    (None, Some(found)) => {
                        Reason::new(format!("`{name}` returns a value, but does not say of which type"))
                            .hint(format!("write `-> {found}` after its arguments"))
                    }
                    (None, None) => Reason::new(format!("`{name}` does not return what it says")),
                }
            }
            E::InvalidIfType(condition) => {
                Reason::new(format!("a condition must be true or false{}", is(*condition)))
                    .hint("compare it, as in `if x > 0.0`")
            }
            E::InvalidSwitchType(value) => {
                Reason::new(format!("`switch` takes a whole number{}", is(*value)))
            }
            E::ConflictingSwitchCase(_) => Reason::new("this case is there twice"),
            E::ConflictingCaseType => Reason::new("the cases of this `switch` differ in type")
                .hint("write all with `u`, or all without"),
            E::MissingDefaultCase => Reason::new("this `switch` has no default")
                .hint("add `default: {}`"),
            E::MultipleDefaultCases => Reason::new("this `switch` has two defaults"),
            E::InvalidStorePointer(_) => Reason::new("this can't be assigned to")
                .hint("only a `var`, or a buffer that is `read_write`, can be assigned to"),
            E::InvalidStoreTypes { pointer, value } if self.is_condition(function, *pointer) => {
                let found = ty(*value).unwrap_or_default();
                Reason::new(format!("`&&` and `||` join conditions, but one of these is `{found}`"))
                    .hint("compare it, as in `x > 0.0`")
            }
            E::InvalidStoreTypes { pointer, value } => {
                let target = ty(*pointer).map(|text| pointed(&text));
                Reason::new(match (ty(*value), target) {
                    (Some(value), Some(target)) => {
                        format!("`{value}` can't be assigned to `{target}`")
                    }
                    _ => "this value can't be assigned: the types differ".to_owned(),
                })
            }
            E::InvalidStoreTexture { .. } => {
                Reason::new("`textureStore` writes to a storage texture")
                    .hint("as in `var picture: texture_storage_2d<rgba16float, write>`")
            }
            E::InvalidStoreValue {
                actual_ty,
                expected_ty,
                ..
            } => Reason::new(match (self.inner_name(expected_ty), self.inner_name(actual_ty)) {
                (Some(expected), Some(actual)) => {
                    format!("`textureStore` takes `{expected}` here, not `{actual}`")
                }
                _ => "`textureStore` takes a vector of four here".to_owned(),
            }),
            E::InvalidCall { function: called, error } => self.call(function, *called, error),
            E::InvalidAtomic(error) => atomic(&error.to_string()),
            E::NonUniformControlFlow(wanted, ..) => {
                if wanted.contains(UniformityRequirements::WORK_GROUP_BARRIER) {
                    Reason::new("not every invocation of the workgroup may reach this barrier")
                        .hint("a barrier can't stand in an `if` or after a `return` that only some take")
                } else {
                    Reason::new("only some fragments may reach this, so their neighbours' values are missing")
                        .hint("compute it before the `if`, or use `textureSampleLevel`")
                }
            }
            E::NonUniformWorkgroupUniformLoad(_) => {
                Reason::new("not every invocation of the workgroup may reach this load")
            }
            E::PipelineInputRegularFunction { name } => {
                Reason::new(format!("`{name}` has attributes, but its function is no entry point"))
                    .hint("write @vertex, @fragment or @compute before the function")
            }
            E::PipelineOutputRegularFunction => {
                Reason::new(format!("the result of `{name}` has attributes, but it is no entry point"))
                    .hint("write @vertex, @fragment or @compute before the function")
            }
            E::MissingCapability(wanted) => lacking(*wanted),
            E::InvalidSubgroup(_) => lacking(naga::valid::Capabilities::SUBGROUP),
            _ => Reason::new(format!("`{name}` does something that can't be done")),
        }
    }

    /// Whether it is the variable that the library makes for `a && b`, which has no name.
    fn is_condition(&self, function: Option<&Function>, pointer: Handle<Expression>) -> bool {
        let variable = || {
            let function = function?;
            match function.expressions.try_get(pointer).ok()? {
                Expression::LocalVariable(handle) => function.local_variables.try_get(*handle).ok(),
                _ => None,
            }
        };
        let boolean = self.expression_type(function, pointer);
        variable().is_some_and(|variable| variable.name.is_none())
            && boolean.is_some_and(|name| name.contains("bool"))
    }

    /// The arguments of a function, as they are declared.
    fn argument_list(&self, function: Option<&Function>) -> String {
        let arguments = function.iter().flat_map(|function| &function.arguments);
        let arguments = arguments.map(|argument| {
            let name = argument.name.as_deref().unwrap_or("_");
            let ty = self.type_name(argument.ty).unwrap_or_default();
            format!("{name}: {ty}")
        });
        arguments.collect::<Vec<_>>().join(", ")
    }

    fn call(
        &self,
        caller: Option<&Function>,
        called: Handle<Function>,
        error: &CallError,
    ) -> Reason {
        let function = self
            .module
            .and_then(|module| module.functions.try_get(called).ok());
        let name = function.and_then(|f| f.name.clone()).unwrap_or_default();
        match error {
            CallError::ArgumentCount { required, seen } => {
                let takes = self.argument_list(function);
                Reason::new(format!("`{name}` takes {required} arguments, not {seen}"))
                    .hint(format!("it is declared `{name}({takes})`"))
            }
            CallError::ArgumentType {
                index,
                required,
                seen_expression,
            } => {
                let argument = function.and_then(|f| f.arguments.get(*index)?.name.clone());
                let argument = argument.unwrap_or_else(|| format!("argument {}", index + 1));
                let seen = self.expression_type(caller, *seen_expression);
                let reason = Reason::new(match (self.type_name(*required), seen) {
                    (Some(required), Some(seen)) => {
                        format!("`{argument}` of `{name}` is `{required}`, not `{seen}`")
                    }
                    _ => format!("`{argument}` of `{name}` has another type"),
                });
                let takes = self.argument_list(function);
                reason.hint(format!("it is declared `{name}({takes})`"))
            }
            _ => Reason::new(format!("`{name}` can't be called so")),
        }
    }
}

/// The library keeps the type of these errors to itself, so its words are told apart.
fn atomic(words: &str) -> Reason {
    if words.starts_with("Pointer") {
        return Reason::new("an atomic operation takes the address of an atomic")
            .hint("as in `atomicAdd(&count, 1u)`, where `count` is `atomic<u32>`");
    }
    if words.starts_with("Address space") {
        return Reason::new(
            "atomics live in workgroup memory and in buffers that are `read_write`",
        );
    }
    if words.starts_with("Operand") {
        return Reason::new("the value has another type than the atomic")
            .hint("of an `atomic<u32>` it is a `u32`");
    }
    Reason::new("this atomic operation can't be done here")
}
