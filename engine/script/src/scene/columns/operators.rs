//! Operators between columns, numbers and vectors.

use lightbench_world::glam::DVec3;
use rhai::{Dynamic, Engine, EvalAltResult, Variant};

use super::parts::{Operand, combine, combine_into};
use super::{Column, Meter};
use crate::api::{Api, Mistake};
use crate::color::Color;

/// An operator's name, and what it makes of two operands.
type Operator = (
    &'static str,
    fn(Operand, Operand) -> Result<Operand, Mistake>,
);

const OPERATORS: [Operator; 4] = [("+", add), ("-", subtract), ("*", multiply), ("/", divide)];

pub(super) fn register(api: &mut Api, meter: &Meter) {
    let engine = api.engine();
    for operator in OPERATORS {
        pair::<Column, Column>(engine, meter, operator);
        both_ways::<f64>(engine, meter, operator);
        both_ways::<i64>(engine, meter, operator);
        both_ways::<DVec3>(engine, meter, operator);
        both_ways::<Color>(engine, meter, operator);
    }
    let meter = meter.clone();
    engine.register_fn("-", move |column: Column| {
        run(&meter, || multiply(Operand::from(-1.0), column.into()))
    });
}

fn both_ways<T: Variant + Clone + Into<Operand>>(
    engine: &mut Engine,
    meter: &Meter,
    operator: Operator,
) {
    pair::<Column, T>(engine, meter, operator);
    pair::<T, Column>(engine, meter, operator);
}

/// Registers an operator for two types. It takes the operands over: one that is the value of an
/// expression is not copied.
fn pair<A: Variant + Clone + Into<Operand>, B: Variant + Clone + Into<Operand>>(
    engine: &mut Engine,
    meter: &Meter,
    (name, combine): Operator,
) {
    let meter = meter.clone();
    engine.register_fn(name, move |a: A, b: B| {
        run(&meter, || combine(a.into(), b.into()))
    });
}

fn run(
    meter: &Meter,
    work: impl FnOnce() -> Result<Operand, Mistake>,
) -> Result<Dynamic, Box<EvalAltResult>> {
    meter.check()?;
    Ok(work()?.into_script())
}

fn add(a: Operand, b: Operand) -> Result<Operand, Mistake> {
    use Operand::{Numbers, Vectors};
    match (a, b) {
        (Numbers(a), Numbers(b)) => combine("+", a, b, |a, b| a + b).map(Numbers),
        (Vectors(a), Vectors(b)) => combine("+", a, b, |a, b| a + b).map(Vectors),
        (a, b) => Err(mixed("+", &a, &b)),
    }
}

fn subtract(a: Operand, b: Operand) -> Result<Operand, Mistake> {
    use Operand::{Numbers, Vectors};
    match (a, b) {
        (Numbers(a), Numbers(b)) => combine("-", a, b, |a, b| a - b).map(Numbers),
        (Vectors(a), Vectors(b)) => combine("-", a, b, |a, b| a - b).map(Vectors),
        (a, b) => Err(mixed("-", &a, &b)),
    }
}

fn multiply(a: Operand, b: Operand) -> Result<Operand, Mistake> {
    use Operand::{Numbers, Vectors};
    match (a, b) {
        (Numbers(a), Numbers(b)) => combine("*", a, b, |a, b| a * b).map(Numbers),
        (Vectors(a), Vectors(b)) => combine("*", a, b, |a, b| a * b).map(Vectors),
        (Vectors(a), Numbers(b)) => combine_into("*", a, b, |a, b| a * b).map(Vectors),
        (Numbers(a), Vectors(b)) => combine_into("*", b, a, |b, a| b * a).map(Vectors),
    }
}

fn divide(a: Operand, b: Operand) -> Result<Operand, Mistake> {
    use Operand::{Numbers, Vectors};
    match (a, b) {
        (Numbers(a), Numbers(b)) => combine("/", a, b, |a, b| a / b).map(Numbers),
        (Vectors(a), Vectors(b)) => combine("/", a, b, |a, b| a / b).map(Vectors),
        // As the plain form does it, so that both give the same numbers.
        (Vectors(a), Numbers(b)) => combine_into("/", a, b, |a, b| a * (1.0 / b)).map(Vectors),
        (a, b) => Err(mixed("/", &a, &b)),
    }
}

/// The mistake of numbers where vectors are wanted, or the other way round.
fn mixed(name: &str, a: &Operand, b: &Operand) -> Mistake {
    Mistake::new(format!(
        "`{name}` can't combine {} and {}",
        a.kind(),
        b.kind()
    ))
}
