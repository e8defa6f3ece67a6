#![allow(clippy::unwrap_used)]
use std::time::{Duration, Instant};

use super::*;

fn all(size: u32, seed: u32) -> Vec<Texture> {
    let stone = Stone {
        size,
        seed,
        ..Stone::default()
    }
    .paint();
    let plaster = Plaster {
        size,
        seed,
        ..Plaster::default()
    }
    .paint();
    let brick = Brick {
        size,
        seed,
        ..Brick::default()
    }
    .paint();
    let tiles = Tiles {
        size,
        seed,
        ..Tiles::default()
    }
    .paint();
    let cloth = Weave {
        size,
        seed,
        ..Weave::default()
    }
    .paint();
    let marble = Marble {
        size,
        seed,
        ..Marble::default()
    }
    .paint();
    let mut all = vec![marble];
    for surface in [stone, plaster, brick, tiles, cloth] {
        all.extend([surface.base_color, surface.normal]);
    }
    all
}

fn difference(texture: &Texture, a: (u32, u32), b: (u32, u32)) -> f32 {
    let pixel = |(x, y)| texture.pixel(0, x, y).unwrap();
    (pixel(a) - pixel(b)).abs().max_element()
}

#[test]
fn pictures_repeat_without_a_seam() {
    // Steps across the edge are as small as steps inside, over the whole edge.
    for texture in all(256, 5) {
        let last = 255;
        let mean = |step: &dyn Fn(u32) -> f32| (0..=last).map(step).sum::<f32>() / 256.0;
        let inside = (0..last)
            .map(|x| {
                mean(&|y| difference(&texture, (x, y), (x + 1, y)))
                    .max(mean(&|y| difference(&texture, (y, x), (y, x + 1))))
            })
            .fold(0.0, f32::max);
        let right = mean(&|y| difference(&texture, (last, y), (0, y)));
        let down = mean(&|x| difference(&texture, (x, last), (x, 0)));
        assert!(right <= inside && down <= inside, "{}", texture.name);
    }
}

#[test]
fn seeds_decide_every_byte() {
    for ((one, again), other) in all(128, 1).iter().zip(all(128, 1)).zip(all(128, 2)) {
        assert_eq!(*one, again);
        let woven = one.name == "cloth normals";
        assert_eq!(one.mips[0] == other.mips[0], woven, "{}", one.name);
    }
}

#[test]
fn normal_maps_hold_unit_vectors_that_are_level_on_average() {
    for texture in all(256, 1)
        .iter()
        .filter(|texture| texture.name.ends_with("normals"))
    {
        let mut sum = Vec3::ZERO;
        let mut steepest = 1.0_f32;
        for i in 0..256 * 256 {
            let normal = texture.pixel(0, i % 256, i / 256).unwrap().truncate() * 2.0 - 1.0;
            assert!((normal.length() - 1.0).abs() < 0.01, "{}", texture.name);
            steepest = steepest.min(normal.z);
            sum += normal;
        }
        let mean = sum / 65536.0;
        assert!(mean.truncate().length() < 0.02, "{}: {mean}", texture.name);
        assert!(
            steepest > 0.2 && steepest < 0.995,
            "{}: {steepest}",
            texture.name
        );
    }
}

#[test]
fn a_slope_up_to_the_right_leans_to_the_left() {
    let texture = normal_map("", 64, |at| 0.1 * (at.x * std::f32::consts::TAU).sin());
    let red = |x| texture.pixel(0, x, 7).unwrap().x;
    assert!(red(0) < 0.4 && red(32) > 0.6);
    // Height that grows down the picture leans up the picture: green is high.
    let texture = normal_map("", 64, |at| 0.1 * (at.y * std::f32::consts::TAU).sin());
    let green = |y| texture.pixel(0, 7, y).unwrap().y;
    assert!(green(0) > 0.6 && green(32) < 0.4);
}

#[test]
fn noise_has_its_range_and_is_zero_on_the_lattice() {
    let noise = Noise::new(3);
    let (mut low, mut high, mut sum) = (0.0_f32, 0.0_f32, 0.0);
    for i in 0..100_000 {
        let place = Vec2::new((i % 317) as f32 / 317.0, (i / 317) as f32 / 316.0);
        let value = noise.at(place, 16);
        (low, high, sum) = (low.min(value), high.max(value), sum + f64::from(value));
    }
    assert!(
        (-1.0..-0.7).contains(&low) && (0.7..1.0).contains(&high),
        "{low} {high}"
    );
    assert!((sum / 100_000.0).abs() < 0.02);
    assert_eq!(noise.at(Vec2::new(0.25, 0.5), 16), 0.0);
    let place = Vec2::new(0.3, 0.9);
    assert!((noise.at(place + Vec2::new(1.0, -1.0), 16) - noise.at(place, 16)).abs() < 1e-4);
}

#[test]
fn odd_sizes_and_counts_are_brought_into_range() {
    assert_eq!(
        checker(0, 0, [Vec3::ZERO, Vec3::ONE]).mips,
        [[0, 0, 0, 255]]
    );
    let wild = Brick {
        size: 5,
        columns: 0,
        courses: 3,
        joint: f32::NAN,
        ..Brick::default()
    };
    assert_eq!(wild.paint().normal.width, 5);
    let wild = Tiles {
        size: 7,
        count: u32::MAX,
        joint: 9.0,
        variety: f32::NAN,
        ..Tiles::default()
    };
    assert_eq!(wild.paint().base_color.mips.len(), 3);
    let wild = Weave {
        size: 3,
        threads: 0,
        stripe_width: f32::NAN,
        ..Weave::default()
    };
    assert_eq!(wild.paint().base_color.height, 3);
    let wild = Stone {
        size: 3,
        scale: u32::MAX / 2,
        ..Stone::default()
    };
    assert_eq!(wild.paint().base_color.height, 3);
}

#[test]
fn a_picture_takes_milliseconds() {
    // The best of several, for the machine may be busy with other things.
    let once = |_| {
        let start = Instant::now();
        let surface = Brick::default().paint();
        let each = start.elapsed() / 2;
        assert_eq!(surface.normal.mips.len(), 10);
        each
    };
    let best = (0..8).map(once).min().unwrap();
    println!("{best:?} for one picture of 512 x 512 with its levels");
    assert!(best < Duration::from_millis(250), "{best:?}");
}
