//! Functions that take columns where their plain forms take numbers and vectors.

use std::any::TypeId;

use lightbench_world::glam::DVec3;
use rhai::Dynamic;

use super::parts::{Operand, Part, each};
use super::{Column, Meter};
use crate::api::{Api, Arguments, Mistake, as_number};
use crate::color::{Color, hsv};
use crate::math::{UNARY, smoothstep};
use crate::noise::{fractal_noise, noise_along};

/// Registers a function for calls in which at least one argument is a column.
fn function(
    api: &mut Api,
    meter: &Meter,
    form: &str,
    about: &'static str,
    body: impl Fn(&Arguments) -> Result<Operand, Mistake> + Send + Sync + 'static,
) {
    let count = form.matches(',').count() + 1;
    let column = TypeId::of::<Column>();
    let mut mixtures: Vec<Vec<TypeId>> = (0..count)
        .map(|place| {
            let mut types = vec![TypeId::of::<Dynamic>(); count];
            types[place] = column;
            types
        })
        .collect();
    if count == 2 {
        // Before a plain form that takes a number or a vector, and then anything.
        let first = [
            TypeId::of::<f64>(),
            TypeId::of::<i64>(),
            TypeId::of::<DVec3>(),
            TypeId::of::<Color>(),
        ];
        mixtures.extend(first.map(|first| vec![first, column]));
    }
    let meter = meter.clone();
    api.typed(form, &mixtures, about, move |a| {
        meter.check()?;
        body(a).map(Operand::into_script)
    });
}

pub(super) fn register(api: &mut Api, meter: &Meter) {
    for (form, about, f) in UNARY {
        let name = form.split('(').next().unwrap_or_default();
        function(api, meter, &format!("{name}(column)"), about, move |a| {
            let x = a.numbers(0)?;
            each(name, [x.count()], |i| f(x.at(i))).map(Operand::Numbers)
        });
    }
    pairs_of_numbers(api, meter);
    between(api, meter);
    vectors(api, meter);
    makers(api, meter);
}

fn pairs_of_numbers(api: &mut Api, meter: &Meter) {
    type Binary = (&'static str, &'static str, fn(f64, f64) -> f64);
    let pairs: [Binary; 3] = [
        (
            "atan(y, x)",
            "The angles of the directions (x, y), in radians.",
            f64::atan2,
        ),
        ("hypot(x, y)", "The lengths of (x, y).", f64::hypot),
        (
            "pow(x, exponent)",
            "x to the power of an exponent.",
            f64::powf,
        ),
    ];
    for (form, about, f) in pairs {
        let name = form.split('(').next().unwrap_or_default();
        function(api, meter, form, about, move |a| {
            let (x, y) = (a.numbers(0)?, a.numbers(1)?);
            each(name, [x.count(), y.count()], |i| f(x.at(i), y.at(i))).map(Operand::Numbers)
        });
    }
    function(
        api,
        meter,
        "modulo(x, period)",
        "What remains of x, from 0 up to the period.",
        |a| {
            let (x, period) = (a.numbers(0)?, a.numbers(1)?);
            require(
                &period,
                |period| period > 0.0,
                |period| format!("`period` of `modulo` must be above 0, not {period}"),
            )?;
            let counts = [x.count(), period.count()];
            each("modulo", counts, |i| x.at(i).rem_euclid(period.at(i))).map(Operand::Numbers)
        },
    );
}

/// Refuses values that a function does not take.
fn require(
    values: &Part<f64>,
    fits: impl Fn(f64) -> bool,
    message: impl Fn(f64) -> String,
) -> Result<(), Mistake> {
    let mut all = 0..values.count().unwrap_or(1);
    match all.find(|&place| !fits(values.at(place))) {
        Some(place) => Err(Mistake::new(message(values.at(place)))),
        None => Ok(()),
    }
}

fn between(api: &mut Api, meter: &Meter) {
    type Choose = (
        &'static str,
        &'static str,
        fn(f64, f64) -> f64,
        fn(DVec3, DVec3) -> DVec3,
    );
    let choices: [Choose; 2] = [
        (
            "min(a, b)",
            "The smaller of both numbers; of vectors, the smaller of each part.",
            f64::min,
            DVec3::min,
        ),
        (
            "max(a, b)",
            "The larger of both numbers; of vectors, the larger of each part.",
            f64::max,
            DVec3::max,
        ),
    ];
    for (form, about, of_numbers, of_vectors) in choices {
        let name = form.split('(').next().unwrap_or_default();
        function(api, meter, form, about, move |a| match a.operand(0)? {
            Operand::Numbers(x) => {
                let y = a.numbers(1)?;
                let counts = [x.count(), y.count()];
                each(name, counts, |i| of_numbers(x.at(i), y.at(i))).map(Operand::Numbers)
            }
            Operand::Vectors(x) => {
                let y = a.vectors(1)?;
                let counts = [x.count(), y.count()];
                each(name, counts, |i| of_vectors(x.at(i), y.at(i))).map(Operand::Vectors)
            }
        });
    }
    function(
        api,
        meter,
        "clamp(x, min, max)",
        "Keeps numbers between two others.",
        |a| {
            let (x, min, max) = (a.numbers(0)?, a.numbers(1)?, a.numbers(2)?);
            let counts = [x.count(), min.count(), max.count()];
            let wrong = each("clamp", counts, |i| min.at(i) > max.at(i))?;
            let mut all = 0..wrong.count().unwrap_or(1);
            if let Some(place) = all.find(|&place| wrong.at(place)) {
                return Err(Mistake::new(format!(
                    "`min` ({}) is larger than `max` ({})",
                    min.at(place),
                    max.at(place)
                )));
            }
            each("clamp", counts, |i| x.at(i).max(min.at(i)).min(max.at(i))).map(Operand::Numbers)
        },
    );
    function(
        api,
        meter,
        "lerp(a, b, t)",
        "Goes from a (t = 0) to b (t = 1) evenly, for numbers, vectors and colors.",
        |a| {
            let t = a.numbers(2)?;
            match a.operand(0)? {
                Operand::Numbers(x) => {
                    let y = a.numbers(1)?;
                    let counts = [x.count(), y.count(), t.count()];
                    each("lerp", counts, |i| x.at(i) + (y.at(i) - x.at(i)) * t.at(i))
                        .map(Operand::Numbers)
                }
                Operand::Vectors(x) => {
                    let y = a.vectors(1)?;
                    let counts = [x.count(), y.count(), t.count()];
                    each("lerp", counts, |i| x.at(i).lerp(y.at(i), t.at(i))).map(Operand::Vectors)
                }
            }
        },
    );
    function(
        api,
        meter,
        "smoothstep(from, to, x)",
        "0 below `from`, 1 above `to`, and a soft way between.",
        |a| {
            let (from, to, x) = (a.numbers(0)?, a.numbers(1)?, a.numbers(2)?);
            let counts = [from.count(), to.count(), x.count()];
            each("smoothstep", counts, |i| {
                smoothstep(from.at(i), to.at(i), x.at(i))
            })
            .map(Operand::Numbers)
        },
    );
}

fn vectors(api: &mut Api, meter: &Meter) {
    function(
        api,
        meter,
        "abs(column)",
        "Numbers or vectors without signs.",
        |a| match a.operand(0)? {
            Operand::Numbers(x) => {
                each("abs", [x.count()], |i| x.at(i).abs()).map(Operand::Numbers)
            }
            Operand::Vectors(x) => {
                each("abs", [x.count()], |i| x.at(i).abs()).map(Operand::Vectors)
            }
        },
    );
    function(
        api,
        meter,
        "length(column)",
        "The lengths of vectors.",
        |a| {
            let x = a.vectors(0)?;
            each("length", [x.count()], |i| x.at(i).length()).map(Operand::Numbers)
        },
    );
    function(
        api,
        meter,
        "normalize(column)",
        "Vectors of length 1 in the same directions; zero stays zero.",
        |a| {
            let x = a.vectors(0)?;
            each("normalize", [x.count()], |i| x.at(i).normalize_or_zero()).map(Operand::Vectors)
        },
    );
    function(
        api,
        meter,
        "cross(a, b)",
        "The cross products of vectors.",
        |a| {
            let (x, y) = (a.vectors(0)?, a.vectors(1)?);
            each("cross", [x.count(), y.count()], |i| x.at(i).cross(y.at(i))).map(Operand::Vectors)
        },
    );
    type Measure = (&'static str, &'static str, fn(DVec3, DVec3) -> f64);
    let measures: [Measure; 2] = [
        ("dot(a, b)", "The dot products of vectors.", DVec3::dot),
        (
            "distance(a, b)",
            "The distances between points.",
            DVec3::distance,
        ),
    ];
    for (form, about, f) in measures {
        let name = form.split('(').next().unwrap_or_default();
        function(api, meter, form, about, move |a| {
            let (x, y) = (a.vectors(0)?, a.vectors(1)?);
            each(name, [x.count(), y.count()], |i| f(x.at(i), y.at(i))).map(Operand::Numbers)
        });
    }
}

fn makers(api: &mut Api, meter: &Meter) {
    function(
        api,
        meter,
        "vec3(x, y, z)",
        "Vectors of three columns, of which some may be single numbers.",
        |a| {
            let (x, y, z) = (a.numbers(0)?, a.numbers(1)?, a.numbers(2)?);
            let counts = [x.count(), y.count(), z.count()];
            each("vec3", counts, |i| DVec3::new(x.at(i), y.at(i), z.at(i))).map(Operand::Vectors)
        },
    );
    function(
        api,
        meter,
        "hsv(hue, saturation, value)",
        "Colors, as a column of vec3, from hues in degrees (0 red, 120 green, 240 blue), \
         saturations and values, both 0 to 1.",
        |a| {
            let (hue, saturation, value) = (a.numbers(0)?, a.numbers(1)?, a.numbers(2)?);
            for (name, part) in [("saturation", &saturation), ("value", &value)] {
                require(
                    part,
                    |x| (0.0..=1.0).contains(&x),
                    |x| format!("`{name}` of `hsv` must be from 0 to 1, not {x}"),
                )?;
            }
            let counts = [hue.count(), saturation.count(), value.count()];
            each("hsv", counts, |i| {
                hsv(hue.at(i), saturation.at(i), value.at(i)).0
            })
            .map(Operand::Vectors)
        },
    );
    for form in ["noise(x)", "noise(x, y)", "noise(x, y, z)"] {
        function(
            api,
            meter,
            form,
            "Smooth noise of about -1 to 1, with one hill or valley to a unit of length.",
            |a| {
                let at: Vec<Part<f64>> = (0..a.len())
                    .map(|i| a.numbers(i))
                    .collect::<Result<_, _>>()?;
                let counts: Vec<Option<usize>> = at.iter().map(Part::count).collect();
                let noise = |i| {
                    let mut point = [0.0; 3];
                    for (coordinate, part) in point.iter_mut().zip(&at) {
                        *coordinate = part.at(i);
                    }
                    noise_along(&point[..at.len()])
                };
                each("noise", counts, noise).map(Operand::Numbers)
            },
        );
    }
    function(
        api,
        meter,
        "fractal_noise(x, y, z, octaves)",
        "A sum of noises, each half as large and half as strong as the one before; about -1 to 1. \
         `octaves` is one number, 1 to 16.",
        |a| {
            let (x, y, z) = (a.numbers(0)?, a.numbers(1)?, a.numbers(2)?);
            if as_number(a.value(3)).is_none() {
                return Err(a.wrong(3, "a number"));
            }
            let octaves = a.whole(3, 1, 16)? as u32;
            let counts = [x.count(), y.count(), z.count()];
            each("fractal_noise", counts, |i| {
                fractal_noise([x.at(i), y.at(i), z.at(i)], octaves)
            })
            .map(Operand::Numbers)
        },
    );
}
