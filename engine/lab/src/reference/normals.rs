//! The twin of `shaders/lib/normals.wgsl`: unit normals in 32 bits, in three ways.

use glam::DVec3;

/// A unit vector as two 16-bit integers.
pub fn encode_octahedral(normal: DVec3) -> [u16; 2] {
    let n = normal / (normal.x.abs() + normal.y.abs() + normal.z.abs());
    let fold = |a: f64, b: f64| (1.0 - b.abs()) * if a >= 0.0 { 1.0 } else { -1.0 };
    let (x, y) = if n.z < 0.0 {
        (fold(n.x, n.y), fold(n.y, n.x))
    } else {
        (n.x, n.y)
    };
    [x, y].map(|v| ((v * 0.5 + 0.5) * 65535.0).round() as u16)
}

/// The unit vector again.
pub fn decode_octahedral(encoded: [u16; 2]) -> DVec3 {
    let [x, y] = encoded.map(|v| f64::from(v) / 65535.0 * 2.0 - 1.0);
    let z = 1.0 - x.abs() - y.abs();
    let fold = |a: f64, b: f64| (1.0 - b.abs()) * if a >= 0.0 { 1.0 } else { -1.0 };
    let (x, y) = if z < 0.0 {
        (fold(x, y), fold(y, x))
    } else {
        (x, y)
    };
    DVec3::new(x, y, z).normalize()
}

/// The plain components in three bytes, -1 to 1 as 0 to 255.
pub fn encode_plain(normal: DVec3) -> [u8; 3] {
    (normal * 0.5 + 0.5)
        .to_array()
        .map(|v| (v * 255.0).round() as u8)
}

/// The unit vector again.
pub fn decode_plain(encoded: [u8; 3]) -> DVec3 {
    let [x, y, z] = encoded.map(|v| f64::from(v) / 255.0 * 2.0 - 1.0);
    DVec3::new(x, y, z).normalize()
}

/// The point of a cube of bytes that lies closest to the direction (Kaplanyan 2010, "CryENGINE 3:
/// Reaching the Speed of Light").
pub fn encode_best_fit(normal: DVec3) -> [u8; 3] {
    let direction = normal / normal.abs().max_element();
    let points = (1..=127).map(|length| (direction * f64::from(length)).round());
    let error = |point: &DVec3| point.cross(normal).length_squared() / point.length_squared();
    let best = points.min_by(|a, b| error(a).total_cmp(&error(b)));
    let best = best.unwrap_or(direction);
    best.to_array().map(|v| (v + 127.0) as u8)
}

/// The unit vector again.
pub fn decode_best_fit(encoded: [u8; 3]) -> DVec3 {
    let [x, y, z] = encoded.map(|v| f64::from(v) - 127.0);
    DVec3::new(x, y, z).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A Fibonacci sphere, and the axes.
    fn directions() -> impl Iterator<Item = DVec3> {
        let count = 20_000;
        let spread = (0..count).map(move |i| {
            let z = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(count);
            let angle = f64::from(i) * 2.399_963_229_728_653;
            let radius = (1.0 - z * z).sqrt();
            DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
        });
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        spread.chain(axes.into_iter().flat_map(|axis| [axis, -axis]))
    }

    /// The largest and the mean angle between directions and what comes back, in degrees.
    fn errors(round_trip: impl Fn(DVec3) -> DVec3) -> (f64, f64) {
        let angles: Vec<f64> = directions()
            .map(|n| n.cross(round_trip(n)).length().asin().to_degrees())
            .collect();
        let mean = angles.iter().sum::<f64>() / angles.len() as f64;
        (angles.into_iter().fold(0.0, f64::max), mean)
    }

    #[test]
    fn every_direction_comes_back_within_the_angles_that_the_shader_states() {
        let octahedral = errors(|n| decode_octahedral(encode_octahedral(n)));
        let best_fit = errors(|n| decode_best_fit(encode_best_fit(n)));
        let plain = errors(|n| decode_plain(encode_plain(n)));
        println!("{octahedral:?} {best_fit:?} {plain:?}");
        for ((most, mean), (stated, stated_mean)) in [
            (octahedral, (0.004, 0.001_5)),
            (best_fit, (0.31, 0.035)),
            (plain, (0.39, 0.175)),
        ] {
            assert!(most < stated && most > 0.5 * stated, "{most}");
            assert!(mean < stated_mean && mean > 0.5 * stated_mean, "{mean}");
        }
    }
}
