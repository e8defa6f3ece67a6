//! The twin of `shaders/lib/surface.wgsl`: normals and tangents of the surface at a point of a mesh.

use glam::{DVec3, DVec4};

/// A unit vector, or +y where the length vanishes.
pub fn safe_normalize(v: DVec3) -> DVec3 {
    let length_squared = v.length_squared();
    if length_squared < 1e-30 {
        return DVec3::Y;
    }
    v / length_squared.sqrt()
}

/// The part of a tangent that lies in the surface, as a unit vector; where nothing is left of it,
/// any unit vector that lies there.
pub fn surface_tangent(tangent: DVec3, normal: DVec3) -> DVec3 {
    let along = safe_normalize(tangent);
    let along = along - normal * normal.dot(along);
    if along.length_squared() >= 1e-6 {
        return along.normalize();
    }
    let axis = if normal.x.abs() > 0.7 {
        DVec3::Y
    } else {
        DVec3::X
    };
    (axis - normal * normal.dot(axis)).normalize()
}

/// The unit normal towards the viewer, bent by a normal map.
///
/// `normal` and `tangent` are the world's, interpolated and of any length; `encoded` is what the normal
/// map holds at the point, if there is one.
pub fn bent_normal(
    normal: DVec3,
    tangent: DVec4,
    front_facing: bool,
    encoded: Option<DVec3>,
) -> DVec3 {
    // Two-sided surfaces turn the normal towards the viewer.
    let side = if front_facing { 1.0 } else { -1.0 };
    let normal = safe_normalize(normal) * side;
    let Some(encoded) = encoded else {
        return normal;
    };
    let bent = encoded * 2.0 - 1.0;
    let direction = tangent.truncate();
    let along = safe_normalize(direction - normal * normal.dot(direction));
    let across = normal.cross(along) * tangent.w * side;
    safe_normalize(along * bent.x + across * bent.y + normal * bent.z)
}

/// The share of what lies behind that a surface hides: a texture's alpha thins out only what is
/// transparent as a whole.
pub fn opacity(material: f64, alpha: f64) -> f64 {
    if material >= 1.0 {
        1.0
    } else {
        material * alpha
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flat_normal_map_changes_nothing_and_a_tilted_one_leans_along_the_tangent() {
        let (normal, tangent) = (DVec3::Y * 3.0, DVec4::new(2.0, 0.5, 0.0, 1.0));
        let flat = DVec3::new(0.5, 0.5, 1.0);
        assert_eq!(bent_normal(normal, tangent, true, Some(flat)), DVec3::Y);
        assert_eq!(bent_normal(normal, tangent, false, Some(flat)), -DVec3::Y);
        let tilted = DVec3::new(1.0, 0.5, 1.0);
        let bent = bent_normal(normal, tangent, true, Some(tilted));
        assert!((bent - DVec3::new(1.0, 1.0, 0.0).normalize()).length() < 1e-12);
        // Green is up the picture: along w · normal × tangent.
        let up = DVec3::new(0.5, 1.0, 1.0);
        let bent = bent_normal(normal, tangent, true, Some(up));
        assert!((bent - DVec3::new(0.0, 1.0, -1.0).normalize()).length() < 1e-12);
    }

    #[test]
    fn a_tangent_is_at_right_angles_to_the_normal_whatever_it_was() {
        for normal in [DVec3::X, DVec3::Y, DVec3::new(0.6, 0.0, 0.8)] {
            for tangent in [DVec3::ZERO, normal, DVec3::new(0.3, 2.0, -1.0)] {
                let tangent = surface_tangent(tangent, normal);
                assert!(tangent.dot(normal).abs() < 1e-12);
                assert!((tangent.length() - 1.0).abs() < 1e-12);
            }
        }
    }
}
