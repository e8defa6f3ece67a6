//! What an experiment says and asserts.

use rhai::{Array, Dynamic};

use crate::api::{Api, Arguments, Mistake, as_number};

/// The widest cell of a table, in letters.
const WIDEST: i64 = 1000;

pub(super) fn register(api: &mut Api) {
    api.section("Saying and asserting");
    for form in ["assert(condition)", "assert(condition, message)"] {
        api.function(
            form,
            "Ends the experiment with an error that names this line, unless the condition holds.",
            |arguments| {
                if arguments.switch(0)? {
                    return Ok(());
                }
                Err(Mistake::new(match arguments.len() {
                    2 => format!("the assertion does not hold: {}", shown(arguments.value(1))),
                    _ => "the assertion does not hold".to_owned(),
                }))
            },
        );
    }
    api.function(
        "decimals(value, count)",
        "A number as text, rounded to so many digits behind the point, from 0 to 12; of an array \
         of numbers, each of them.",
        |arguments| {
            let count = arguments.whole(1, 0, 12)? as usize;
            rounded(arguments.value(0), count)
                .ok_or_else(|| arguments.wrong(0, "a number or an array of numbers"))
        },
    );
    for (form, about) in [
        (
            "left(value, width)",
            "A value as text with blanks behind it, so that it takes so many letters: a cell at the \
             left of its column.",
        ),
        (
            "right(value, width)",
            "A value as text with blanks before it, so that it takes so many letters: a cell at the \
             right of its column.",
        ),
    ] {
        let at_left = form.starts_with("left");
        api.function(form, about, move |arguments: &mut Arguments| {
            let width = arguments.whole(1, 0, WIDEST)? as usize;
            let text = shown(arguments.value(0));
            Ok(match at_left {
                true => format!("{text:<width$}"),
                false => format!("{text:>width$}"),
            })
        });
    }
}

/// A value as `print` shows it.
fn shown(value: &Dynamic) -> String {
    value.to_string()
}

fn rounded(value: &Dynamic, count: usize) -> Option<String> {
    if let Some(number) = as_number(value) {
        return Some(format!("{number:.count$}"));
    }
    let items = value.read_lock::<Array>()?;
    let items: Option<Vec<String>> = items.iter().map(|item| rounded(item, count)).collect();
    Some(format!("[{}]", items?.join(", ")))
}
