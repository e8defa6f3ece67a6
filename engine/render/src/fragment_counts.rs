//! Turns a shader into one whose fragments count 1, for overdraw.
//!
//! Vertices stay where the shader puts them, and fragments that it discards do not count: only what
//! it gives back is replaced. So any shader can be counted, those that students write too.

use naga::{
    Binding, Block, Constant, Expression, FunctionResult, Handle, Literal, Module, Scalar,
    ShaderStage, Span, Statement, Type, TypeInner, VectorSize,
};

/// The define that asks for it.
pub const COUNT_FRAGMENTS: &str = "COUNT_FRAGMENTS";

/// Makes each fragment stage of a module give 1 in four channels, and nothing else.
pub fn count_fragments(module: &mut Module) {
    let number = Type {
        name: None,
        inner: TypeInner::Vector {
            size: VectorSize::Quad,
            scalar: Scalar::F32,
        },
    };
    let ty = module.types.insert(number, Span::UNDEFINED);
    let global = &mut module.global_expressions;
    let one = global.append(Expression::Literal(Literal::F32(1.0)), Span::UNDEFINED);
    let components = vec![one; 4];
    let init = global.append(Expression::Compose { ty, components }, Span::UNDEFINED);
    let constant = Constant {
        name: None,
        ty,
        init,
    };
    let constant = module.constants.append(constant, Span::UNDEFINED);
    for entry in &mut module.entry_points {
        if entry.stage != ShaderStage::Fragment {
            continue;
        }
        let function = &mut entry.function;
        let expressions = &mut function.expressions;
        let one = expressions.append(Expression::Constant(constant), Span::UNDEFINED);
        function.result = Some(FunctionResult {
            ty,
            binding: Some(Binding::Location {
                location: 0,
                interpolation: None,
                sampling: None,
                blend_src: None,
                per_primitive: false,
            }),
        });
        give(&mut function.body, one);
    }
}

/// Makes all returns of a block give one value.
fn give(block: &mut Block, one: Handle<Expression>) {
    for statement in block.iter_mut() {
        match statement {
            Statement::Return { value } => *value = Some(one),
            Statement::Block(inner) => give(inner, one),
            Statement::If { accept, reject, .. } => {
                give(accept, one);
                give(reject, one);
            }
            Statement::Switch { cases, .. } => {
                for case in cases {
                    give(&mut case.body, one);
                }
            }
            Statement::Loop {
                body, continuing, ..
            } => {
                give(body, one);
                give(continuing, one);
            }
            _ => {}
        }
    }
}
