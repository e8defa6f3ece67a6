//! What is wrong with an expression of a function.

use naga::common::wgsl::{TryToWgsl, TypeContext as _};
use naga::proc::ResolveContext;
use naga::valid::{ComposeError, ExpressionError};
use naga::{Expression, Function, Handle};

use super::{Context, Reason, lacking};

impl Context<'_> {
    pub(super) fn expression(
        &self,
        function: Option<&Function>,
        handle: Option<Handle<Expression>>,
        error: &ExpressionError,
    ) -> Reason {
        use ExpressionError as E;
        let name = |inner: &naga::TypeInner| self.inner_name(inner).unwrap_or_default();
        let ty = |expression: Handle<Expression>| {
            let found = self.expression_type(function, expression);
            found.map_or_else(|| "this type".to_owned(), |found| format!("`{found}`"))
        };
        match error {
            E::InvalidBinaryOperandTypes {
                op,
                lhs_type,
                rhs_type,
                ..
            } => Reason::new(format!(
                "`{}` can't combine `{}` and `{}`",
                sign(*op),
                name(lhs_type),
                name(rhs_type)
            ))
            .hint(match sign(*op) {
                "&&" | "||" => "both sides must be `bool`",
                _ => "both sides need the same type, or one of them is a single number",
            }),
            E::InvalidUnaryOperandType(op, operand) => Reason::new(format!(
                "`{}` can't be applied to {}",
                match op {
                    naga::UnaryOperator::Negate => "-",
                    naga::UnaryOperator::LogicalNot => "!",
                    naga::UnaryOperator::BitwiseNot => "~",
                },
                ty(*operand)
            )),
            E::InvalidIndexType(index) => Reason::new(format!(
                "an element is chosen by a whole number, not by {}",
                ty(*index)
            )),
            E::InvalidBaseType(base) => Reason::new(format!(
                "{} has no elements or members to choose from",
                ty(*base)
            )),
            E::NegativeIndex(_) => Reason::new("elements are counted from 0"),
            E::IndexOutOfBounds(base, index) => {
                let base = self.expression_type(function, *base);
                let base = base.map_or_else(|| "it".to_owned(), |base| pointed(&base));
                Reason::new(format!("there is no element {index} in `{base}`"))
                    .hint("elements are counted from 0")
            }
            E::InvalidSwizzleComponent(component, size) => Reason::new(format!(
                "a vector of {} has no `.{}`",
                *size as u8,
                format!("{component:?}").to_lowercase()
            )),
            E::SelectValuesTypeMismatch { accept, reject } => Reason::new(format!(
                "`select` chooses between values of one type, not `{}` and `{}`",
                name(reject),
                name(accept)
            )),
            E::SelectConditionNotABool { actual } => Reason::new(format!(
                "the condition of `select` is true or false, not `{}`",
                name(actual)
            ))
            .hint("write select(if_false, if_true, condition)"),
            E::Compose(error) => match error {
                ComposeError::ComponentCount { given, expected } => {
                    Reason::new(format!("{expected} values are needed here, not {given}"))
                }
                ComposeError::ComponentType { index } => {
                    self.component(function, handle, *index).unwrap_or_else(|| {
                        Reason::new(format!("value {} has the wrong type here", index + 1))
                    })
                }
                ComposeError::Type(_) => Reason::new("no value of this type can be made"),
            },
            E::InvalidArgumentType(math, index, argument) => Reason::new(format!(
                "argument {} of `{}` can't be {}",
                index + 1,
                math.to_wgsl_for_diagnostics(),
                ty(*argument)
            ))
            .hint("most functions take numbers with a point, and all arguments of one type"),
            E::WrongArgumentCount(math) => Reason::new(format!(
                "`{}` takes another number of arguments",
                math.to_wgsl_for_diagnostics()
            )),
            E::ComparisonSamplingMismatch { sampler, .. } => Reason::new(if *sampler {
                "this sampler compares depth, and this call does not"
            } else {
                "this call compares depth, and its sampler or texture does not"
            })
            .hint(
                "`textureSampleCompare` takes a depth texture and `depth_sampler: \
                     sampler_comparison`; `textureSample` takes the others",
            ),
            E::InvalidImageCoordinateType(_, coordinate) => Reason::new(format!(
                "{} is no position in this texture",
                ty(*coordinate)
            ))
            .hint(
                "`textureLoad` counts texels (`vec2i`, `vec2u`); `textureSample` goes from \
                           0 to 1 (`vec2f`)",
            ),
            E::InvalidImageClass(_) => {
                Reason::new("this can't be done with a texture of this type")
                    .hint("storage textures are read by `textureLoad`, others sampled or loaded")
            }
            E::InvalidImageArrayIndex | E::InvalidImageArrayIndexType(_) => {
                Reason::new("the layer of an array is a whole number, and only arrays have layers")
            }
            E::InvalidImageSampleSelector | E::MissingImageSampleSelector => Reason::new(
                "`textureLoad` takes the number of a sample where the texture has several",
            ),
            E::InvalidImageLevelSelector | E::MissingImageLevelSelector => {
                Reason::new("`textureLoad` takes a mip level where the texture has them")
                    .hint("as in `textureLoad(hdr, texel, 0)`; storage textures have none")
            }
            E::InvalidImageOtherIndexType(_) => {
                Reason::new("a mip level or sample is a whole number")
            }
            E::InvalidDerivative => Reason::new("only numbers with a point have derivatives"),
            E::MissingCapabilities(wanted) => lacking(*wanted),
            E::Literal(_) => Reason::new("this number can't be held by its type"),
            E::DivideByZero => Reason::new("a whole number is divided by zero"),
            E::ShiftAmountTooLarge { .. } => {
                Reason::new("bits can't be shifted by as many as the number has")
            }
            E::InvalidCastArgument => Reason::new("this can't be converted"),
            E::InvalidPointerType(_) => Reason::new("there is no value to read here"),
            E::InvalidArrayType(_) => {
                Reason::new("`arrayLength` takes the address of an array without a length")
                    .hint("as in `arrayLength(&lights)`")
            }
            E::ExpectedImageType(_) | E::ExpectedGlobalVariable | E::ExpectedGlobalOrArgument => {
                Reason::new("a texture that is declared with @group and @binding is needed here")
            }
            E::ExpectedSamplerType(_) => Reason::new("a sampler is needed here"),
            E::InvalidSampleOffset(..) | E::InvalidSampleOffsetExprType => {
                Reason::new("the offset is a constant of whole numbers")
            }
            _ => Reason::new("this can't be computed so"),
        }
    }

    /// A value that does not fit into the structure or array that is made of it.
    fn component(
        &self,
        function: Option<&Function>,
        handle: Option<Handle<Expression>>,
        index: u32,
    ) -> Option<Reason> {
        let module = self.module?;
        let Expression::Compose { ty, components } = function?.expressions.try_get(handle?).ok()?
        else {
            return None;
        };
        let found = self.expression_type(function, *components.get(index as usize)?)?;
        let ty = &module.types[*ty];
        let (place, wanted) = match &ty.inner {
            naga::TypeInner::Struct { members, .. } => {
                let member = members.get(index as usize)?;
                (format!("`{}`", member.name.as_deref()?), member.ty)
            }
            naga::TypeInner::Array { base, .. } => (format!("element {index}"), *base),
            _ => return None,
        };
        let name = ty.name.as_deref().unwrap_or("the array");
        let wanted = self.type_name(wanted)?;
        let message = format!("{place} of `{name}` is `{wanted}`, not `{found}`");
        Some(Reason::new(message).convert(&found, &wanted))
    }

    /// The type of an expression of a function, as WGSL writes it.
    pub(super) fn expression_type(
        &self,
        function: Option<&Function>,
        expression: Handle<Expression>,
    ) -> Option<String> {
        let (module, function) = (self.module?, function?);
        function.expressions.try_get(expression).ok()?;
        let mut types = naga::front::Typifier::new();
        let context =
            ResolveContext::with_locals(module, &function.local_variables, &function.arguments);
        types
            .grow(expression, &function.expressions, &context)
            .ok()?;
        Some(
            module
                .to_ctx()
                .type_resolution_to_string(&types[expression]),
        )
    }
}

/// `vec3<f32>` of `ptr<function, vec3<f32>>`.
pub(super) fn pointed(text: &str) -> String {
    let inner = text
        .strip_prefix("ptr<")
        .and_then(|rest| rest.strip_suffix('>'));
    let Some((_, target)) = inner.and_then(|inner| inner.split_once(", ")) else {
        return text.to_owned();
    };
    // The access stands behind the type where a buffer is meant.
    let target = target.strip_suffix(", read_write").unwrap_or(target);
    target.strip_suffix(", read").unwrap_or(target).to_owned()
}

fn sign(op: naga::BinaryOperator) -> &'static str {
    use naga::BinaryOperator as B;
    match op {
        B::Add => "+",
        B::Subtract => "-",
        B::Multiply => "*",
        B::Divide => "/",
        B::Modulo => "%",
        B::Equal => "==",
        B::NotEqual => "!=",
        B::Less => "<",
        B::LessEqual => "<=",
        B::Greater => ">",
        B::GreaterEqual => ">=",
        B::And => "&",
        B::ExclusiveOr => "^",
        B::InclusiveOr => "|",
        B::LogicalAnd => "&&",
        B::LogicalOr => "||",
        B::ShiftLeft => "<<",
        B::ShiftRight => ">>",
    }
}
