#![allow(clippy::unwrap_used)]

use super::*;
use crate::picture::HdrImage;

/// Reference values: flip-evaluator 1.7, the authors' Python package (PyPI, 2025), on the same
/// pictures, default viewing conditions and 30 pixels per degree. Mean, maximum, map at points.
struct Known {
    reference: LdrImage,
    test: LdrImage,
    ppd: Option<f64>,
    mean: f64,
    max: f32,
    points: &'static [(usize, usize, f32)],
}

fn weave(width: u32, height: u32) -> [LdrImage; 2] {
    let pixel = |x: u32, y: u32, raise: u32| {
        let green = ((x * y) % 256 + raise).min(255);
        let blue = (255 + 3 * y as i32 - 5 * x as i32).rem_euclid(256);
        [
            ((37 * x + 11 * y) % 256) as u8,
            green as u8,
            blue as u8,
            255,
        ]
    };
    [
        LdrImage::from_fn(width, height, |x, y| pixel(x, y, 0)),
        LdrImage::from_fn(width, height, |x, y| {
            pixel(x, y, 48 * ((x / 8 + y / 8) % 2))
        }),
    ]
}

fn inverse(image: &LdrImage) -> LdrImage {
    let pixels = image
        .pixels
        .iter()
        .map(|p| [255 - p[0], 255 - p[1], 255 - p[2], p[3]])
        .collect();
    LdrImage::new(image.width, image.height, pixels).unwrap()
}

fn shifted(width: u32, height: u32) -> [LdrImage; 2] {
    [0, 1].map(|offset| {
        LdrImage::from_fn(width, height, |x, y| {
            let x = x + offset;
            let blue = if x < width / 2 { 128 } else { 30 };
            [((6 * x) % 256) as u8, ((10 * y) % 256) as u8, blue, 255]
        })
    })
}

fn noise(width: u32, height: u32) -> [LdrImage; 2] {
    let hash = |x: u32, y: u32, seed: u32| {
        let mixed =
            x.wrapping_mul(73_856_093) ^ y.wrapping_mul(19_349_663) ^ seed.wrapping_mul(83_492_791);
        let mut v = mixed.wrapping_mul(2_654_435_761);
        v ^= v >> 15;
        [v as u8, (v >> 8) as u8, (v >> 16) as u8, 255]
    };
    [
        LdrImage::from_fn(width, height, |x, y| hash(x, y, 1)),
        LdrImage::from_fn(width, height, |x, y| {
            hash(x, y, if (x + y) % 3 == 0 { 2 } else { 1 })
        }),
    ]
}

fn known() -> Vec<Known> {
    let case = |[reference, test]: [LdrImage; 2], ppd, mean, max, points| Known {
        reference,
        test,
        ppd,
        mean,
        max,
        points,
    };
    let inverted = |width, height| {
        let [a, _] = weave(width, height);
        let b = inverse(&a);
        [a, b]
    };
    vec![
        case(
            weave(48, 32),
            None,
            0.397_533_0,
            0.795_681,
            &[
                (0, 0, 0.002_293),
                (7, 5, 0.224_399),
                (12, 9, 0.174_173),
                (20, 15, 0.375_106),
                (23, 17, 0.419_887),
            ],
        ),
        case(
            weave(48, 32),
            Some(30.0),
            0.362_310_0,
            0.843_883,
            &[
                (0, 0, 0.0),
                (7, 5, 0.099_848),
                (12, 9, 0.053_874),
                (20, 15, 0.412_165),
                (23, 17, 0.306_43),
            ],
        ),
        case(
            shifted(40, 24),
            None,
            0.098_976_1,
            0.187_563,
            &[
                (0, 0, 0.030_209),
                (7, 5, 0.050_357),
                (12, 9, 0.066_03),
                (20, 15, 0.175_385),
                (23, 17, 0.148_135),
            ],
        ),
        case(
            shifted(40, 24),
            Some(30.0),
            0.100_671_7,
            0.316_452,
            &[
                (0, 0, 0.030_266),
                (1, 0, 0.031_087),
                (20, 15, 0.269_373),
                (23, 17, 0.099_31),
            ],
        ),
        case(
            noise(40, 30),
            None,
            0.345_060_8,
            0.756_767,
            &[
                (0, 0, 0.636_055),
                (1, 0, 0.469_015),
                (7, 5, 0.214_538),
                (12, 9, 0.281_178),
                (20, 15, 0.336_424),
            ],
        ),
        case(
            noise(40, 30),
            Some(30.0),
            0.470_870_2,
            0.975_069,
            &[
                (0, 0, 0.771_887),
                (7, 5, 0.723_831),
                (12, 9, 0.963_895),
                (20, 15, 0.203_609),
            ],
        ),
        case(
            inverted(1, 1),
            None,
            0.998_972_3,
            0.998_972,
            &[(0, 0, 0.998_972)],
        ),
        case(
            inverted(1, 40),
            None,
            0.980_513_6,
            0.984_913,
            &[(0, 0, 0.984_913)],
        ),
        case(
            inverted(40, 1),
            None,
            0.988_701_6,
            0.998_009,
            &[(0, 0, 0.997_394), (1, 0, 0.997_748)],
        ),
        case(
            inverted(40, 1),
            Some(30.0),
            0.989_806_5,
            0.998_382,
            &[(0, 0, 0.997_94)],
        ),
        case(
            noise(1, 9),
            None,
            0.680_704_8,
            0.899_106,
            &[(0, 0, 0.899_106)],
        ),
    ]
}

#[test]
fn agrees_with_the_authors_program() {
    for (number, case) in known().iter().enumerate() {
        let options = case.ppd.map_or_else(FlipOptions::default, |p| FlipOptions {
            pixels_per_degree: p,
        });
        let map = ldr_flip(&case.reference, &case.test, options).unwrap();
        let max = map.values.iter().copied().fold(0.0, f32::max);
        assert!(
            (map.mean() - case.mean).abs() < 1e-5,
            "case {number}: mean {}",
            map.mean()
        );
        assert!((max - case.max).abs() < 2e-4, "case {number}: max {max}");
        for &(x, y, value) in case.points {
            let found = map.at(x, y);
            assert!(
                (found - value).abs() < 2e-4,
                "case {number} at {x},{y}: {found} not {value}"
            );
        }
    }
}

#[test]
fn weighted_quartiles_agree_with_the_authors_program() {
    // The program `flip` 1.7 prints these for the noise at 30 pixels per degree.
    let [a, b] = noise(40, 30);
    let map = ldr_flip(
        &a,
        &b,
        FlipOptions {
            pixels_per_degree: 30.0,
        },
    )
    .unwrap();
    let found = crate::metrics::MapStatistics::of(&map, 0.1);
    for (value, expected) in found
        .weighted_quartiles
        .iter()
        .zip([0.362_747, 0.554_609, 0.812_210])
    {
        assert!((value - expected).abs() < 2e-4, "{value} {expected}");
    }
    assert!((found.min - 0.102_838).abs() < 2e-4);
}

#[test]
fn hdr_agrees_with_the_authors_program() {
    // flip-evaluator 1.7, HDR mode, ACES.
    let image = |gain: f32| {
        HdrImage::from_fn(48, 32, |x, y| {
            let scale = 2.0_f32.powi(((x / 8) % 6) as i32 - 3) / 16.0;
            let k = if (x / 4 + y / 4) % 2 == 1 { gain } else { 1.0 };
            let v = [
                1 + (x * 7 + y * 13) % 29,
                1 + (x * 5 + y * 3) % 23,
                1 + (x * 11 + y * 17) % 31,
            ];
            let [r, g, b] = v.map(|c| c as f32 * scale * k);
            [r, g, b, 1.0]
        })
    };
    let found = hdr_flip(&image(1.0), &image(1.25), FlipOptions::default()).unwrap();
    assert_eq!(found.exposures, 4);
    assert!(
        (found.start_exposure + 1.518_613_2).abs() < 1e-5,
        "{}",
        found.start_exposure
    );
    assert!(
        (found.stop_exposure - 1.993_866_7).abs() < 1e-5,
        "{}",
        found.stop_exposure
    );
    assert!(
        (found.map.mean() - 0.137_125_7).abs() < 1e-5,
        "{}",
        found.map.mean()
    );
    for (x, y, value) in [
        (0, 0, 0.014_951),
        (7, 5, 0.150_581),
        (12, 9, 0.178_484),
        (23, 17, 0.159_708),
    ] {
        assert!(
            (found.map.at(x, y) - value).abs() < 2e-4,
            "{x},{y} {}",
            found.map.at(x, y)
        );
    }
    // One pixel: start and stop coincide.
    let pixel = |k: f32| HdrImage::from_fn(1, 1, |_, _| [k / 128.0, k / 128.0, k / 128.0, 1.0]);
    let one = hdr_flip(&pixel(1.0), &pixel(2.0), FlipOptions::default()).unwrap();
    assert_eq!(one.exposures, 2);
    assert!(
        (one.map.mean() - 0.144_832_7).abs() < 1e-4,
        "{}",
        one.map.mean()
    );
    assert!((one.start_exposure - 8.083_296_8).abs() < 1e-5);
}

#[test]
fn hdr_shows_invalid_pixels_and_survives_black() {
    let grey = HdrImage::from_fn(8, 8, |_, _| [0.5, 0.5, 0.5, 1.0]);
    let mut broken = grey.clone();
    broken.pixels[10][1] = f32::NAN;
    broken.pixels[20][0] = f32::INFINITY;
    let found = hdr_flip(&grey, &broken, FlipOptions::default()).unwrap();
    assert!(found.map.values.iter().all(|v| (0.0..=1.0).contains(v)));
    assert_eq!([found.map.values[10], found.map.values[20]], [1.0, 1.0]);
    let black = HdrImage::from_fn(8, 8, |_, _| [0.0; 4]);
    let both = hdr_flip(&black, &black, FlipOptions::default()).unwrap();
    assert_eq!((both.map.mean(), both.exposures), (0.0, 1));
    assert!(
        hdr_flip(&black, &grey, FlipOptions::default())
            .unwrap()
            .map
            .mean()
            > 0.5
    );
    let huge = HdrImage::from_fn(2, 2, |_, _| [f32::MAX; 4]);
    assert!(hdr_flip(&grey, &huge, FlipOptions::default()).is_err());
    let huge = HdrImage::from_fn(8, 8, |_, _| [f32::MAX; 4]);
    assert!(
        hdr_flip(&grey, &huge, FlipOptions::default())
            .unwrap()
            .map
            .mean()
            > 0.1
    );
}

#[test]
fn equal_pictures_have_no_difference() {
    for [a, _] in [weave(48, 32), noise(5, 3), weave(1, 1), noise(1, 17)] {
        let map = ldr_flip(&a, &a, FlipOptions::default()).unwrap();
        assert!(map.values.iter().all(|v| *v == 0.0));
    }
}

#[test]
fn black_and_white_and_symmetry() {
    let flat = |v: u8| LdrImage::from_fn(16, 16, |_, _| [v, v, v, 255]);
    let options = FlipOptions::default();
    // flip-evaluator 1.7 gives 0.967391 both ways.
    let there = ldr_flip(&flat(0), &flat(255), options).unwrap();
    assert!((there.mean() - 0.967_391).abs() < 1e-5);
    let [a, b] = noise(31, 17);
    let (there, back) = (
        ldr_flip(&a, &b, options).unwrap(),
        ldr_flip(&b, &a, options).unwrap(),
    );
    assert_eq!(there, back);
}

#[test]
fn a_larger_step_is_a_larger_difference() {
    let flat = |v: u8| LdrImage::from_fn(9, 9, |_, _| [v, v, v, 255]);
    let mut last = 0.0;
    for value in [101, 104, 110, 120, 160, 255] {
        let mean = ldr_flip(&flat(100), &flat(value), FlipOptions::default())
            .unwrap()
            .mean();
        assert!(mean > last, "{value}: {mean} after {last}");
        last = mean;
    }
}

#[test]
fn a_wrong_viewing_distance_is_refused() {
    let [a, b] = weave(4, 4);
    for ppd in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e6] {
        assert!(
            ldr_flip(
                &a,
                &b,
                FlipOptions {
                    pixels_per_degree: ppd
                }
            )
            .is_err()
        );
    }
}
