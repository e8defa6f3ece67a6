//! Division: as Rhai does it, with a word where two whole numbers lose a fraction.
//!
//! `1 / 2` is 0 in Rhai as in many languages, and a common first mistake: a scene of which one half is
//! missing. Rhai does the arithmetic of its own numbers without asking anybody, so `/` becomes an
//! operator of ours. It costs a call; the other operators stay as fast as they are.

use std::any::TypeId;
use std::collections::HashSet;
use std::sync::{Mutex, PoisonError};

use lightbench_render::Place;
use rhai::{Dynamic, Engine, EvalAltResult};

use crate::api::{Api, Mistake, as_number, place};
use crate::log::Log;

/// How strongly `/` binds, as `*` does.
const PRECEDENCE: u8 = 180;

/// Takes over `/`, before any script is compiled. The first time that a line loses a fraction, `log`
/// says so.
pub(crate) fn take_over(engine: &mut Engine, log: &Log) {
    engine.disable_symbol("/");
    // It fails for names that are no operators alone.
    let taken = engine.register_custom_operator("/", PRECEDENCE);
    debug_assert!(taken.is_ok(), "{taken:?}");
    let (whole, float) = (TypeId::of::<i64>(), TypeId::of::<f64>());
    for types in [[float, float], [float, whole], [whole, float]] {
        engine.register_raw_fn("/", types, |_, values| {
            let number = |index: usize| as_number(values[index]).unwrap_or(f64::NAN);
            Ok(number(0) / number(1))
        });
    }
    let told: Mutex<HashSet<Place>> = Mutex::default();
    let log = log.clone();
    engine.register_raw_fn("/", [whole, whole], move |context, values| {
        let number = |index: usize| values[index].as_int().unwrap_or(0);
        let (a, b) = (number(0), number(1));
        let Some(result) = a.checked_div(b) else {
            let what = if b == 0 {
                "Division by zero"
            } else {
                "Division overflow"
            };
            let message = format!("{what}: {a} / {b}");
            return Err(EvalAltResult::ErrorArithmetic(message, context.call_position()).into());
        };
        if a % b != 0 {
            let at = place(context.call_source(), context.call_position());
            let mut told = told.lock().unwrap_or_else(PoisonError::into_inner);
            if told.insert(at.clone()) {
                log.add(at, lost(a, b, result));
            }
        }
        Ok(result)
    });
}

/// What is said of a fraction that was lost.
fn lost(a: i64, b: i64, result: i64) -> String {
    let exact = a as f64 / b as f64;
    let exact = (exact * 1000.0).round() / 1000.0;
    format!(
        "warning: {a} / {b} is {result}, because both are whole numbers. Write one with a point, as in `{b}.0`, \
         for {exact}; or `quotient({a}, {b})` where the whole number is meant"
    )
}

/// Registers what is meant where a fraction is to be dropped.
pub(crate) fn register(api: &mut Api) {
    api.function(
        "quotient(a, b)",
        "How often b goes into a: the whole number below a / b. With `a % b` it makes rows and columns of a count.",
        |arguments| {
            let (a, b) = (arguments.number(0)?, arguments.number(1)?);
            if b == 0.0 {
                return Err(Mistake::new("`b` of `quotient` is 0"));
            }
            let quotient = (a / b).floor();
            // Whole numbers of scripts have 64 bits.
            if quotient.abs() >= i64::MAX as f64 {
                return Err(Mistake::new(format!("`quotient({a}, {b})` is too large")));
            }
            Ok(Dynamic::from(quotient as i64))
        },
    );
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use lightbench_assets::Progress;

    use crate::testing::{printed, project};
    use crate::{Settings, load_scene};

    #[test]
    fn division_is_that_of_rhai() {
        let script = "
            print(6 / 2); print(1 / 2.0); print(1.0 / 2); print(3.0 / 4.0); print(7 / -7);
            print(2 + 6 / 2 * 3); print(12 / 2 / 3); print(-6 / 3);
            let x = 9; x /= 2.0; print(x);
            print(quotient(7, 2)); print(quotient(-7, 2)); print(quotient(6.5, 2));";
        let expected = [
            3.0, 0.5, 0.5, 0.75, -1.0, 11.0, 2.0, -2.0, 4.5, 3.0, -4.0, 3.0,
        ];
        assert_eq!(printed(script), expected);
    }

    #[test]
    fn a_lost_fraction_is_told_once_for_each_place() {
        let text =
            "for i in 0..5 {\n    let half = i / 2;\n}\nlet third = 1 / 3; let whole = 4 / 2;";
        let (_folder, files) = project(&[("scripts/scenes/test.rhai", text)]);
        let scene = load_scene(&files, "test", &Settings::new(), &Progress::new());
        let lines = scene.unwrap().take_log();
        let told: Vec<String> = lines
            .iter()
            .map(|line| format!("{}: {}", line.place, line.text))
            .collect();
        assert_eq!(told.len(), 2, "{told:?}");
        assert!(told[0].starts_with("scripts/scenes/test.rhai:2:18: warning: 1 / 2 is 0"));
        assert!(told[0].contains("for 0.5;"), "{told:?}");
        assert!(told[1].starts_with("scripts/scenes/test.rhai:4:15: warning: 1 / 3 is 0"));
        assert!(told[1].contains("for 0.333;"), "{told:?}");
    }

    #[test]
    fn division_by_zero_is_told_as_ever() {
        for (text, expected) in [
            ("let x = 1 / 0;", "1 / 0"),
            ("print(quotient(1, 0));", "is 0"),
        ] {
            let (_folder, files) = project(&[("scripts/scenes/test.rhai", text)]);
            let error = load_scene(&files, "test", &Settings::new(), &Progress::new());
            let error = error.unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        }
    }
}
