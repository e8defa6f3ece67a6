//! Operands: one value for each place, or one for all.

use std::sync::Arc;

use lightbench_world::glam::DVec3;
use rhai::Dynamic;

use super::Column;
use crate::api::{Arguments, Mistake, as_number};
use crate::color::Color;

/// Values of one type.
#[derive(Clone, Debug)]
pub(super) enum Part<T> {
    One(T),
    Many(Arc<Vec<T>>),
}

impl<T: Copy> Part<T> {
    /// How many values there are; `None` where one stands for all.
    pub(super) fn count(&self) -> Option<usize> {
        match self {
            Self::One(_) => None,
            Self::Many(values) => Some(values.len()),
        }
    }

    /// The value at a place below [`Part::count`].
    #[inline]
    pub(super) fn at(&self, place: usize) -> T {
        match self {
            Self::One(value) => *value,
            Self::Many(values) => values[place],
        }
    }
}

/// What scripts combine with columns.
#[derive(Clone, Debug)]
pub(super) enum Operand {
    Numbers(Part<f64>),
    Vectors(Part<DVec3>),
}

impl Operand {
    /// The operand that a value is: a number, a vector, a colour or a column.
    pub(super) fn of(value: &Dynamic) -> Option<Self> {
        if let Some(column) = value.read_lock::<Column>() {
            return Some(column.clone().into());
        }
        if let Some(vector) = value.read_lock::<DVec3>() {
            return Some(Self::Vectors(Part::One(*vector)));
        }
        if let Some(color) = value.read_lock::<Color>() {
            return Some(Self::Vectors(Part::One(color.0)));
        }
        Some(Self::Numbers(Part::One(as_number(value)?)))
    }

    /// What it is, in words.
    pub(super) fn kind(&self) -> &'static str {
        match self {
            Self::Numbers(Part::One(_)) => "a number",
            Self::Numbers(Part::Many(_)) => "a column of numbers",
            Self::Vectors(Part::One(_)) => "a vec3",
            Self::Vectors(Part::Many(_)) => "a column of vec3",
        }
    }

    /// As a script has it.
    pub(super) fn into_script(self) -> Dynamic {
        match self {
            Self::Numbers(Part::One(number)) => number.into(),
            Self::Vectors(Part::One(vector)) => Dynamic::from(vector),
            Self::Numbers(Part::Many(numbers)) => Dynamic::from(Column::Numbers(numbers)),
            Self::Vectors(Part::Many(vectors)) => Dynamic::from(Column::Vectors(vectors)),
        }
    }
}

impl From<Column> for Operand {
    fn from(column: Column) -> Self {
        match column {
            Column::Numbers(numbers) => Self::Numbers(Part::Many(numbers)),
            Column::Vectors(vectors) => Self::Vectors(Part::Many(vectors)),
        }
    }
}

impl From<f64> for Operand {
    fn from(number: f64) -> Self {
        Self::Numbers(Part::One(number))
    }
}

impl From<i64> for Operand {
    fn from(number: i64) -> Self {
        (number as f64).into()
    }
}

impl From<DVec3> for Operand {
    fn from(vector: DVec3) -> Self {
        Self::Vectors(Part::One(vector))
    }
}

impl From<Color> for Operand {
    fn from(color: Color) -> Self {
        color.0.into()
    }
}

impl Arguments<'_, '_, '_, '_> {
    /// A number or a vector, or a column of either.
    pub(super) fn operand(&self, index: usize) -> Result<Operand, Mistake> {
        Operand::of(self.value(index))
            .ok_or_else(|| self.wrong(index, "a number, a vec3 or a column"))
    }

    /// Numbers, or one for all.
    pub(super) fn numbers(&self, index: usize) -> Result<Part<f64>, Mistake> {
        match self.operand(index)? {
            Operand::Numbers(numbers) => Ok(numbers),
            Operand::Vectors(_) => Err(self.wrong(index, "a number or a column of numbers")),
        }
    }

    /// Vectors, or one for all.
    pub(super) fn vectors(&self, index: usize) -> Result<Part<DVec3>, Mistake> {
        match self.operand(index)? {
            Operand::Vectors(vectors) => Ok(vectors),
            Operand::Numbers(_) => Err(self.wrong(index, "a vec3 or a column of vec3")),
        }
    }
}

/// Calls a function for each place of operands of these counts.
pub(super) fn each<R>(
    name: &str,
    counts: impl IntoIterator<Item = Option<usize>>,
    value: impl Fn(usize) -> R,
) -> Result<Part<R>, Mistake> {
    let mut counts = counts.into_iter().flatten();
    let Some(count) = counts.next() else {
        return Ok(Part::One(value(0)));
    };
    if let Some(other) = counts.find(|other| *other != count) {
        return Err(mismatch(name, count, other));
    }
    Ok(Part::Many(Arc::new((0..count).map(value).collect())))
}

/// Combines two operands of the same type. Writes into the memory of one that nobody else holds, as
/// the value of an expression is.
pub(super) fn combine<T: Copy>(
    name: &str,
    a: Part<T>,
    b: Part<T>,
    f: impl Fn(T, T) -> T,
) -> Result<Part<T>, Mistake> {
    let second_is_free = match (&a, &b) {
        (Part::One(_), Part::Many(_)) => true,
        (Part::Many(first), Part::Many(second)) if first.len() == second.len() => {
            Arc::strong_count(first) > 1 && Arc::strong_count(second) == 1
        }
        _ => false,
    };
    if second_is_free {
        combine_into(name, b, a, |b, a| f(a, b))
    } else {
        combine_into(name, a, b, f)
    }
}

/// Combines two operands. The result has the type, and where nobody else holds it the memory, of
/// the first one.
pub(super) fn combine_into<A: Copy, B: Copy>(
    name: &str,
    a: Part<A>,
    b: Part<B>,
    f: impl Fn(A, B) -> A,
) -> Result<Part<A>, Mistake> {
    Ok(match (a, b) {
        (Part::One(a), b) => each(name, [b.count()], |place| f(a, b.at(place)))?,
        (Part::Many(mut a), Part::One(b)) => {
            for value in Arc::make_mut(&mut a) {
                *value = f(*value, b);
            }
            Part::Many(a)
        }
        (Part::Many(a), Part::Many(b)) if a.len() != b.len() => {
            return Err(mismatch(name, a.len(), b.len()));
        }
        (Part::Many(mut a), Part::Many(b)) => {
            for (value, &other) in Arc::make_mut(&mut a).iter_mut().zip(b.iter()) {
                *value = f(*value, other);
            }
            Part::Many(a)
        }
    })
}

/// The mistake of columns of different lengths.
pub(super) fn mismatch(name: &str, a: usize, b: usize) -> Mistake {
    Mistake::new(format!(
        "`{name}` can't combine a column of {a} values with one of {b}"
    ))
}
