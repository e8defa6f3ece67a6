//! What a column tells of itself, and its parts.

use std::sync::Arc;

use lightbench_world::glam::DVec3;
use rhai::{Array, Dynamic, FuncRegistration};

use super::Column;
use super::parts::{Operand, Part, combine_into};
use crate::api::{Api, Mistake, ScriptType, as_number};
use crate::scene::selection::outside;

pub(super) fn register(api: &mut Api) {
    api.getter(
        "count",
        "How many values the column has.",
        |column: Column, _| Ok(column.len() as i64),
    );
    parts(api);
    api.method(
        "to_array()",
        "The values as an array. `column[0]` is the first value, and can be written too.",
        |column: Column, _| {
            let values: Array = match &column {
                Column::Numbers(numbers) => numbers.iter().map(|&n| n.into()).collect(),
                Column::Vectors(vectors) => vectors.iter().map(|&v| Dynamic::from(v)).collect(),
            };
            Ok(values)
        },
    );
    sums(api);
    index(api);
    crate::math::text(api.engine(), show);
}

fn parts(api: &mut Api) {
    for (index, name) in ["x", "y", "z"].into_iter().enumerate() {
        api.getter(
            name,
            "A part of each vector, as a column of numbers. A column or one number is written to \
             it.",
            move |column: Column, _| match column {
                Column::Vectors(vectors) => Ok(Column::numbers(
                    vectors.iter().map(|vector| vector[index]).collect(),
                )),
                Column::Numbers(_) => Err(no_parts(name)),
            },
        );
        api.setter(name, move |column: &mut Column, a| {
            let Column::Vectors(vectors) = column else {
                return Err(no_parts(name));
            };
            let numbers = match Operand::of(a.value(0)) {
                Some(Operand::Numbers(numbers)) => numbers,
                _ => {
                    return Err(Mistake::new(format!(
                        "`{name}` of a column takes a number or a column of numbers, not {}",
                        a.describe(a.value(0))
                    )));
                }
            };
            let whole = Part::Many(std::mem::take(vectors));
            let changed = combine_into(name, whole, numbers, |mut vector: DVec3, number| {
                vector[index] = number;
                vector
            })?;
            if let Part::Many(changed) = changed {
                *vectors = changed;
            }
            Ok(())
        });
    }
}

fn no_parts(name: &str) -> Mistake {
    Mistake::new(format!("a column of numbers has no `{name}`"))
        .with_hint("only columns of vec3 have parts")
}

fn sums(api: &mut Api) {
    api.method(
        "sum()",
        "All values together, added up in their order: a number or a vec3.",
        |column: Column, _| {
            Ok(match &column {
                Column::Numbers(numbers) => Dynamic::from(total(numbers)),
                Column::Vectors(vectors) => Dynamic::from(total(vectors)),
            })
        },
    );
    api.method(
        "average()",
        "The sum, divided by how many values there are: a number or a vec3.",
        |column: Column, _| match (&column, column.len() as f64) {
            (_, 0.0) => Err(empty("average")),
            (Column::Numbers(numbers), count) => Ok((total(numbers) / count).into()),
            (Column::Vectors(vectors), count) => Ok(Dynamic::from(total(vectors) / count)),
        },
    );
    type Choose = (
        &'static str,
        &'static str,
        fn(f64, f64) -> f64,
        fn(DVec3, DVec3) -> DVec3,
    );
    let choices: [Choose; 2] = [
        (
            "smallest",
            "The smallest number; of vectors, the smallest of each part, as a vec3.",
            f64::min,
            DVec3::min,
        ),
        (
            "largest",
            "The largest number; of vectors, the largest of each part, as a vec3.",
            f64::max,
            DVec3::max,
        ),
    ];
    for (name, about, of_numbers, of_vectors) in choices {
        api.method(&format!("{name}()"), about, move |column: Column, _| {
            let chosen = match &column {
                Column::Numbers(numbers) => numbers
                    .iter()
                    .copied()
                    .reduce(of_numbers)
                    .map(Dynamic::from),
                Column::Vectors(vectors) => vectors
                    .iter()
                    .copied()
                    .reduce(of_vectors)
                    .map(Dynamic::from),
            };
            chosen.ok_or_else(|| empty(name))
        });
    }
}

/// The sum of all values in their order.
fn total<T: Copy + Default + std::ops::Add<Output = T>>(values: &[T]) -> T {
    values.iter().fold(T::default(), |sum, &value| sum + value)
}

/// The mistake of asking a column without values.
fn empty(name: &str) -> Mistake {
    Mistake::new(format!("an empty column has no {name}"))
}

/// `column[index]`, to read and to write.
fn index(api: &mut Api) {
    let engine = api.engine();
    let place = |column: &Column, index: i64| {
        let found = usize::try_from(index).ok().filter(|&i| i < column.len());
        found.ok_or_else(|| outside(Column::NAME, index, column.len(), "values"))
    };
    type Reads = Result<Dynamic, Box<rhai::EvalAltResult>>;
    FuncRegistration::new_index_getter().register_into_engine(
        engine,
        move |column: &mut Column, index: i64| -> Reads {
            let place = place(column, index)?;
            Ok(match column {
                Column::Numbers(numbers) => numbers[place].into(),
                Column::Vectors(vectors) => Dynamic::from(vectors[place]),
            })
        },
    );
    type Writes = Result<(), Box<rhai::EvalAltResult>>;
    FuncRegistration::new_index_setter().register_into_engine(
        engine,
        move |column: &mut Column, index: i64, value: Dynamic| -> Writes {
            let place = place(column, index)?;
            match column {
                Column::Numbers(numbers) => {
                    let number = as_number(&value)
                        .ok_or_else(|| Mistake::new("a column of numbers takes a number here"))?;
                    Arc::make_mut(numbers)[place] = number;
                }
                Column::Vectors(vectors) => {
                    let vector = value
                        .read_lock::<DVec3>()
                        .ok_or_else(|| Mistake::new("a column of vec3 takes a vec3 here"))?;
                    Arc::make_mut(vectors)[place] = *vector;
                }
            }
            Ok(())
        },
    );
}

/// A column as `print` shows it: its first values.
fn show(column: &Column) -> String {
    const SHOWN: usize = 4;
    let first: Vec<String> = match column {
        Column::Numbers(numbers) => numbers.iter().take(SHOWN).map(f64::to_string).collect(),
        Column::Vectors(vectors) => vectors
            .iter()
            .take(SHOWN)
            .map(|v| format!("({}, {}, {})", v.x, v.y, v.z))
            .collect(),
    };
    let more = if column.len() > SHOWN { ", …" } else { "" };
    format!(
        "column of {} {}: {}{more}",
        column.len(),
        column.kind(),
        first.join(", ")
    )
}
