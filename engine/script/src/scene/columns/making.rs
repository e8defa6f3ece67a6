//! Where columns come from, apart from the fields of a selection.

use lightbench_world::glam::DVec3;
use rhai::{Array, Dynamic};

use super::{Column, Meter};
use crate::api::{Api, Arguments, Mistake, as_number};
use crate::random::Random;

pub(super) fn register(api: &mut Api, meter: &Meter) {
    let limit = meter.limits.array_elements;
    api.function(
        "column_of(array)",
        "A column of the numbers, vectors or colors of an array, which are all of one kind. Columns \
         are combined with `+`, `-`, `*` and `/`, value by value with columns of the same length, \
         or with a number or a vec3 for all; `-column` changes all signs. The functions below take \
         numbers and vectors for all beside columns too.",
        |a| {
            let Some(array) = a.value(0).read_lock::<Array>() else {
                return Err(a.wrong(0, "an array of numbers or vec3"));
            };
            of_array(a, &array)
        },
    );
    api.function(
        "indices(count)",
        "A column of the whole numbers from 0 up to, but not including, `count`: at most as many \
         as an array may have elements.",
        move |a| {
            let count = count(a, 0, limit)?;
            Ok(Column::numbers(
                (0..count).map(|index| index as f64).collect(),
            ))
        },
    );
    random(api, meter);
}

fn count(a: &Arguments, index: usize, limit: usize) -> Result<usize, Mistake> {
    a.whole(index, 0, i64::try_from(limit).unwrap_or(i64::MAX))
        .map(|count| count as usize)
}

fn of_array(a: &Arguments, array: &Array) -> Result<Column, Mistake> {
    let wrong = |index: usize, value: &Dynamic, wanted: &str| {
        Mistake::new(format!(
            "element `[{index}]` of the array must be {wanted}, not {}",
            a.describe(value)
        ))
    };
    let vector = |value: &Dynamic| {
        let vector = value.read_lock::<DVec3>().map(|vector| *vector);
        vector.or_else(|| {
            value
                .read_lock::<crate::color::Color>()
                .map(|color| color.0)
        })
    };
    let elements = || array.iter().enumerate();
    if array.first().is_some_and(|first| vector(first).is_some()) {
        let vectors = elements().map(|(i, value)| {
            vector(value).ok_or_else(|| wrong(i, value, "a vec3, as the first is"))
        });
        return vectors.collect::<Result<_, _>>().map(Column::vectors);
    }
    let numbers =
        elements().map(|(i, value)| as_number(value).ok_or_else(|| wrong(i, value, "a number")));
    numbers.collect::<Result<_, _>>().map(Column::numbers)
}

fn random(api: &mut Api, meter: &Meter) {
    let limit = meter.limits.array_elements;
    for form in ["floats(count)", "floats(count, from, to)"] {
        api.method(
            form,
            "A column of numbers, evenly between two: 0 and 1 unless told. They are those that as \
             many calls of `float` or `range` would give.",
            move |random: Random, a| {
                let count = count(a, 0, limit)?;
                let (from, to) = match a.len() {
                    1 => (0.0, 1.0),
                    _ => (a.number(1)?, a.number(2)?),
                };
                let numbers = (0..count).map(|_| from + (to - from) * random.float());
                Ok(Column::numbers(numbers.collect()))
            },
        );
    }
    api.method(
        "normals(count, mean, deviation)",
        "A column of numbers from the normal distribution, as `normal` gives them.",
        move |random: Random, a| {
            let count = count(a, 0, limit)?;
            let (mean, deviation) = (a.number(1)?, a.number(2)?);
            let numbers = (0..count).map(|_| mean + deviation * random.normal());
            Ok(Column::numbers(numbers.collect()))
        },
    );
    api.method(
        "directions(count)",
        "A column of vectors of length 1, evenly over the sphere, as `direction` gives them.",
        move |random: Random, a| {
            let count = count(a, 0, limit)?;
            Ok(Column::vectors(
                (0..count).map(|_| random.direction()).collect(),
            ))
        },
    );
}
