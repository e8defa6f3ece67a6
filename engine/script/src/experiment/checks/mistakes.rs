//! The options of judgements: how far values may be apart, and what known mistakes would have given.

use rhai::{Dynamic, Map};

use super::evidence::Bound;
use crate::api::Mistake;
use crate::experiment::options::Options;

/// Reads `absolute`, `relative` and `share`; `bound` is what counts without them.
pub(super) fn bound(options: &Options, bound: Bound) -> Result<Bound, Mistake> {
    let number = |name: &str, otherwise: f64, most: f64| {
        let given = options.number(name, 0.0, most)?;
        Ok::<_, Mistake>(given.unwrap_or(otherwise))
    };
    // Who sets one of the two means it alone.
    let none_given = options.value("absolute").is_none() && options.value("relative").is_none();
    let otherwise = |value: f64| if none_given { value } else { 0.0 };
    Ok(Bound {
        absolute: number("absolute", otherwise(bound.absolute), f64::MAX)?,
        relative: number("relative", otherwise(bound.relative), 1e6)?,
        share: number("share", bound.share, 1.0)?,
    })
}

/// Reads `mistakes`, a map from the names of mistakes to what each would have given.
pub(super) fn mistakes<T, E: From<Mistake>>(
    options: &Options,
    wanted: &str,
    mut read: impl FnMut(&Dynamic) -> Result<Option<T>, E>,
) -> Result<Vec<(String, T)>, E> {
    let Some(value) = options.value("mistakes") else {
        return Ok(Vec::new());
    };
    let wrong = || {
        options.wrong(
            "mistakes",
            &format!("a map from names of mistakes to {wanted}"),
        )
    };
    let map: Map = value.clone().try_cast().ok_or_else(wrong)?;
    let mut found = Vec::new();
    for (name, value) in &map {
        let read = read(value)?.ok_or_else(wrong)?;
        found.push((name.to_string(), read));
    }
    Ok(found)
}
