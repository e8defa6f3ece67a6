//! What may have gone wrong with a picture, seen from the picture alone.
//!
//! These need no knowledge of the lesson: nothing was drawn, all is brighter by a factor, light was
//! encoded for a display once too often, rows are upside down.

use lightbench_assets::color::{linear_to_srgb, srgb_to_linear};
use lightbench_render::TargetImage;
use lightbench_script::{Bound, Expected};

use super::compare::compare;
use super::words::{Words, number};

/// A changed expectation must come so much nearer than the right one to be taken for the cause.
const NEARER: f64 = 0.05;

/// Whether a picture is what a mistake would have given, rather than what it should be. Only texels of which
/// something is expected are looked at; a mistake that says nothing of any of them explains nothing.
pub(super) fn is_explained(
    found: &TargetImage,
    expected: &Expected,
    by: &Expected,
    bound: Bound,
    distance: f64,
) -> bool {
    let both = by.texels.iter().zip(&expected.texels);
    let by = Expected {
        channels: by.channels,
        texels: both
            .map(|(by, expected)| by.filter(|_| expected.is_some()))
            .collect(),
    };
    let other = compare(found, &by, bound);
    // What is no number is as far from everything.
    let nearer = other.distance.is_finite() && other.distance <= NEARER * distance;
    other.compared > 0 && (other.error <= 1.0 || nearer)
}

/// What the picture itself tells of its mistake.
pub(super) fn of_picture(
    found: &TargetImage,
    expected: &Expected,
    bound: Bound,
    distance: f64,
) -> Option<Words> {
    let channels = expected.channels;
    let pairs = || {
        let texels = found.texels.iter().zip(&expected.texels);
        let texels = texels.filter_map(|(found, expected)| Some((found, expected.as_ref()?)));
        texels.flat_map(move |(found, expected)| found.iter().zip(expected).take(channels))
    };
    if pairs().any(|(found, _)| !found.is_finite()) {
        return Some(Words::new(
            "Some values are no numbers, or infinite: look for a division by zero, a root or a power of a negative number, or a zero vector that is normalised",
            "Algunos valores no son números o son infinitos: busca una división entre cero, una raíz o una potencia de un número negativo, o un vector nulo que se normaliza",
        ));
    }
    let differs = pairs().any(|(_, expected)| expected.abs() > 1e-6);
    if differs && pairs().all(|(found, _)| *found == 0.0) {
        return Some(Words::new(
            "All values are zero: is this still to be written, or is a factor zero?",
            "Todos los valores son cero: ¿falta por escribir, o algún factor es cero?",
        ));
    }
    let explained = |by: &Expected| is_explained(found, expected, by, bound, distance);
    let changed = |change: &dyn Fn(f32) -> f32| {
        let texels = expected.texels.iter();
        let changed = texels.map(|texel| texel.map(|texel| texel.map(change)));
        Expected {
            channels: expected.channels,
            texels: changed.collect(),
        }
    };
    if let Some(factor) = factor(pairs())
        && explained(&changed(&|value| (f64::from(value) * factor) as f32))
    {
        let named = named_factor(factor);
        return Some(Words::new(
            format!(
                "Everything is {named} times what is expected: a constant factor is missing or is one too many"
            ),
            format!("Todo vale {named} veces lo esperado: falta o sobra un factor constante"),
        ));
    }
    let encoded = |value: f32| linear_to_srgb(value.clamp(0.0, 1.0));
    if explained(&changed(&encoded)) || explained(&changed(&|value| value.max(0.0).powf(1.0 / 2.2)))
    {
        return Some(Words::new(
            "These are values for a display (with gamma) where linear light is expected: the encoding is applied once too often",
            "Son valores para una pantalla (con gamma) donde se espera luz lineal: la codificación se aplica una vez de más",
        ));
    }
    if explained(&changed(&|value| srgb_to_linear(value.clamp(0.0, 1.0)))) {
        return Some(Words::new(
            "The values were decoded as if they came from a display: gamma is taken off once too often, or was never applied",
            "Los valores se han decodificado como si vinieran de una pantalla: se quita la gamma una vez de más, o nunca se aplicó",
        ));
    }
    turned(found, expected)
        .into_iter()
        .find(|(by, _)| explained(by))
        .map(|(_, words)| words)
}

/// The factor between found and expected values that fits best (least squares), if it is not 1.
fn factor<'a>(pairs: impl Iterator<Item = (&'a f32, &'a f32)>) -> Option<f64> {
    let (mut products, mut squares) = (0.0, 0.0);
    for (&found, &expected) in pairs {
        products += f64::from(found) * f64::from(expected);
        squares += f64::from(expected) * f64::from(expected);
    }
    let factor = products / squares;
    (factor.is_finite() && factor.abs() > 1e-6 && (factor - 1.0).abs() > 1e-3).then_some(factor)
}

/// A factor by its name, where it has one.
fn named_factor(factor: f64) -> String {
    use std::f64::consts::PI;
    let named = [
        (PI, "π"),
        (1.0 / PI, "1/π"),
        (2.0 * PI, "2π"),
        (1.0 / (2.0 * PI), "1/(2π)"),
        (4.0 * PI, "4π"),
        (1.0 / (4.0 * PI), "1/(4π)"),
        (PI * PI, "π²"),
        (PI.powi(-2), "1/π²"),
        (0.5, "1/2"),
        (0.25, "1/4"),
        (-1.0, "−1"),
    ];
    let near = named
        .iter()
        .find(|(value, _)| (factor / value - 1.0).abs() < 0.005);
    near.map_or_else(
        || number(factor),
        |(value, name)| format!("{name} ({})", number(*value)),
    )
}

/// What is expected, mirrored; only where all texels are.
fn turned(found: &TargetImage, expected: &Expected) -> Vec<(Expected, Words)> {
    let (width, height) = (found.width as usize, found.height as usize);
    if expected.texels.iter().any(Option::is_none) {
        return Vec::new();
    }
    let taken = |from: &dyn Fn(usize, usize) -> usize| {
        let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let texels = texels.map(|(x, y)| expected.texels[from(x, y)]);
        Expected {
            channels: expected.channels,
            texels: texels.collect(),
        }
    };
    vec![
        (
            taken(&|x, y| (height - 1 - y) * width + x),
            Words::new(
                "The picture is upside down: which way does y go?",
                "La imagen está cabeza abajo: ¿hacia dónde va y?",
            ),
        ),
        (
            taken(&|x, y| y * width + width - 1 - x),
            Words::new(
                "Left and right are exchanged: which way does x go?",
                "La izquierda y la derecha están cambiadas: ¿hacia dónde va x?",
            ),
        ),
    ]
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use lightbench_render::Format;

    const BOUND: Bound = Bound {
        absolute: 1e-4,
        relative: 1e-3,
        share: 0.0,
    };

    fn image(value: impl Fn(f32, f32) -> f32) -> TargetImage {
        let texels = (0..64).map(|index| {
            let (x, y) = ((index % 8) as f32 / 8.0, (index / 8) as f32 / 8.0);
            [value(x, y), 0.5 * value(x, y), 0.1, 1.0]
        });
        TargetImage {
            width: 8,
            height: 8,
            format: Format::from_name("rgba32float").unwrap(),
            channels: 4,
            texels: texels.collect(),
        }
    }

    fn right(x: f32, y: f32) -> f32 {
        0.1 + 0.5 * x + 0.2 * y * y
    }

    fn cause(found: &TargetImage) -> Option<Words> {
        let texels = image(right).texels.into_iter().map(Some).collect();
        let expected = Expected {
            channels: 2,
            texels,
        };
        let distance = compare(found, &expected, BOUND).distance;
        of_picture(found, &expected, BOUND, distance)
    }

    #[test]
    fn a_mistake_explains_only_what_it_speaks_of() {
        let found = image(|x, y| 2.0 * right(x, y));
        let of =
            |texel: &dyn Fn(usize, [f32; 4]) -> Option<[f32; 4]>, image: &TargetImage| Expected {
                channels: 2,
                texels: (0..64).map(|at| texel(at, image.texels[at])).collect(),
            };
        let expected = of(&|at, texel| (at < 32).then_some(texel), &image(right));
        let distance = compare(&found, &expected, BOUND).distance;
        let explains = |by: &Expected| is_explained(&found, &expected, by, BOUND, distance);
        assert!(explains(&of(&|_, texel| Some(texel), &found)));
        // No number is explained by nothing.
        let broken = image(|_, _| f32::NAN);
        let all = of(&|_, texel| Some(texel), &found);
        assert!(!is_explained(
            &broken,
            &expected,
            &all,
            BOUND,
            f64::INFINITY
        ));
        // Right about some of them.
        assert!(explains(&of(
            &|at, texel| (at < 4).then_some(texel),
            &found
        )));
        // Nothing at all, and nothing but texels that are not judged.
        assert!(!explains(&of(&|_, _| None, &found)));
        assert!(!explains(&of(
            &|at, texel| (at >= 32).then_some(texel),
            &found
        )));
        // Wrong where it counts, right where it does not.
        let half = of(
            &|at, texel| Some(texel.map(|v| if at < 32 { 9.0 * v } else { v })),
            &found,
        );
        assert!(!explains(&half));
    }

    #[test]
    fn each_trace_is_told_from_the_others() {
        let cases: [(TargetImage, &str); 8] = [
            (image(|_, _| 0.0), "zero"),
            (
                image(|x, y| if x == 0.5 { f32::NAN } else { right(x, y) }),
                "no numbers",
            ),
            (
                image(|x, y| std::f32::consts::PI * right(x, y)),
                "π (3.142) times",
            ),
            (image(|x, y| 0.7 * right(x, y)), "0.7 times"),
            (image(|x, y| linear_to_srgb(right(x, y))), "once too often"),
            (image(|x, y| srgb_to_linear(right(x, y))), "decoded"),
            (image(|x, y| right(x, 7.0 / 8.0 - y)), "upside down"),
            (image(|x, y| right(7.0 / 8.0 - x, y)), "Left and right"),
        ];
        for (index, (found, words)) in cases.iter().enumerate() {
            let cause = cause(found);
            // Half of the second channel does not follow an encoding of the first.
            if index == 4 || index == 5 {
                continue;
            }
            let cause = cause.unwrap_or_else(|| panic!("{words}"));
            assert!(cause.en.contains(words), "{words}: {cause:?}");
        }
        assert_eq!(cause(&image(|x, y| right(x, y) + 0.3 * x * y)), None);
    }

    #[test]
    fn encodings_are_told_in_both_directions() {
        let grey = |value: &dyn Fn(f32, f32) -> f32| {
            let mut image = image(value);
            image
                .texels
                .iter_mut()
                .for_each(|texel| texel[1] = texel[0]);
            image
        };
        let expected: Vec<_> = grey(&right).texels.into_iter().map(Some).collect();
        let expected = Expected {
            channels: 2,
            texels: expected,
        };
        for (found, words) in [
            (grey(&|x, y| linear_to_srgb(right(x, y))), "once too often"),
            (grey(&|x, y| srgb_to_linear(right(x, y))), "decoded"),
        ] {
            let distance = compare(&found, &expected, BOUND).distance;
            let cause = of_picture(&found, &expected, BOUND, distance).unwrap();
            assert!(cause.en.contains(words), "{cause:?}");
        }
    }
}
