//! Easing: ways from 0 to 1 that begin or end softly, overshoot, swing or bounce.
//!
//! The curves are those of Penner 2002, "Motion, Tweening, and Easing", chapter 7 of "Programming
//! Macromedia Flash MX", as shares of the way over shares of the time.

use std::f64::consts::TAU;

use crate::api::{Api, Arguments, Mistake};

/// How far Penner's `back` goes beyond its ends: a tenth of the way.
const OVERSHOOT: f64 = 1.70158;

pub(crate) fn register(api: &mut Api) {
    let mut powers = |form: &str, about: &'static str, shape: fn(f64, f64) -> f64| {
        api.function(form, about, move |a| {
            let power = a.number_in(1, 1.0, 100.0)?;
            Ok(shape(share(a)?, power))
        });
    };
    powers(
        "ease_in(t, power)",
        "Begins slowly: the way at a share t of the time, both from 0 to 1. A power of 1 is even, 2 gentle, \
         5 abrupt.",
        ease_in,
    );
    powers(
        "ease_out(t, power)",
        "Ends slowly, as `ease_in` begins.",
        |t, power| 1.0 - ease_in(1.0 - t, power),
    );
    powers(
        "ease_in_out(t, power)",
        "Begins and ends slowly: half of the way is done after half of the time.",
        |t, power| {
            if t < 0.5 {
                0.5 * ease_in(2.0 * t, power)
            } else {
                1.0 - 0.5 * ease_in(2.0 - 2.0 * t, power)
            }
        },
    );
    let mut shapes = |form: &str, about: &'static str, shape: fn(f64) -> f64| {
        api.function(form, about, move |a| share(a).map(shape));
    };
    shapes(
        "ease_back(t)",
        "Shoots a tenth of the way beyond its end and comes back.",
        |t| {
            let left = t - 1.0;
            1.0 + left * left * ((OVERSHOOT + 1.0) * left + OVERSHOOT)
        },
    );
    shapes(
        "ease_elastic(t)",
        "Swings around its end like a spring that comes to rest.",
        |t| {
            if t == 0.0 || t == 1.0 {
                return t;
            }
            1.0 + (-10.0 * t).exp2() * ((t - 0.075) / 0.3 * TAU).sin()
        },
    );
    shapes(
        "ease_bounce(t)",
        "Falls to its end and bounces three times, lower each time.",
        bounce,
    );
}

/// The first argument, kept between 0 and 1: before and after its time nothing moves.
fn share(a: &Arguments) -> Result<f64, Mistake> {
    Ok(a.number(0)?.clamp(0.0, 1.0))
}

fn ease_in(t: f64, power: f64) -> f64 {
    t.powf(power)
}

/// A fall that lasts 1 / 2.75 of the time, and three parabolas of 1/4, 1/16 and 1/64 of its height.
fn bounce(t: f64) -> f64 {
    const STEEPNESS: f64 = 2.75 * 2.75;
    let parabola = |middle: f64, lowest: f64| {
        let from = t - middle / 2.75;
        STEEPNESS * from * from + lowest
    };
    match t * 2.75 {
        at if at < 1.0 => parabola(0.0, 0.0),
        at if at < 2.0 => parabola(1.5, 0.75),
        at if at < 2.5 => parabola(2.25, 0.9375),
        _ => parabola(2.625, 0.984_375),
    }
}

#[cfg(test)]
mod tests {
    use crate::testing::{printed, value};

    #[test]
    fn every_way_begins_at_0_and_ends_at_1_and_stays_there() {
        for call in [
            "ease_in(#, 3)",
            "ease_out(#, 3)",
            "ease_in_out(#, 3)",
            "ease_back(#)",
            "ease_elastic(#)",
            "ease_bounce(#)",
        ] {
            let script = format!(
                "for t in [-1, 0, 1, 7] {{ print({}); }}",
                call.replace('#', "t")
            );
            for (found, expected) in printed(&script).into_iter().zip([0.0, 0.0, 1.0, 1.0]) {
                assert!((found - expected).abs() < 1e-12, "{call}: {found}");
            }
        }
    }

    #[test]
    fn ways_are_those_of_the_closed_forms() {
        assert!((value("ease_in(0.5, 3)") - 0.125).abs() < 1e-12);
        assert!((value("ease_out(0.5, 3)") - 0.875).abs() < 1e-12);
        assert!((value("ease_in_out(0.25, 2)") - 0.125).abs() < 1e-12);
        // The ball touches the ground at 4, 8 and 10 elevenths, and is highest between.
        for t in ["4.0 / 11", "8.0 / 11", "10.0 / 11"] {
            assert!((value(&format!("ease_bounce({t})")) - 1.0).abs() < 1e-12);
        }
        assert!((value("ease_bounce(6.0 / 11)") - 0.75).abs() < 1e-12);
        // The curve of `back` is highest a tenth above its end.
        let highest = printed("for i in 0..501 { print(ease_back(i / 500.0)); }")
            .into_iter()
            .fold(0.0, f64::max);
        assert!((highest - 1.1).abs() < 1e-4, "{highest}");
    }
}
