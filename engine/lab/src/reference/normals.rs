//! The twin of `shaders/lib/normals.wgsl`: octahedral normals in 2 × 16 bits.

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_direction_comes_back_within_four_thousandths_of_a_degree() {
        let count = 20_000;
        let mut worst: f64 = 0.0;
        for i in 0..count {
            // A Fibonacci sphere, and the axes.
            let z = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(count);
            let angle = f64::from(i) * 2.399_963_229_728_653;
            let radius = (1.0 - z * z).sqrt();
            let n = DVec3::new(radius * angle.cos(), radius * angle.sin(), z);
            worst = worst.max(n.angle_between(decode_octahedral(encode_octahedral(n))));
        }
        for axis in [
            DVec3::X,
            DVec3::Y,
            DVec3::Z,
            DVec3::NEG_X,
            DVec3::NEG_Y,
            DVec3::NEG_Z,
        ] {
            worst = worst.max(axis.angle_between(decode_octahedral(encode_octahedral(axis))));
        }
        assert!(worst.to_degrees() < 0.004, "{}", worst.to_degrees());
    }
}
