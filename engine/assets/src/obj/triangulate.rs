//! Polygons into triangles, concave ones too.

use glam::{DVec2, DVec3};

/// The most corners of a concave polygon that is cut properly, for the time
/// grows with the square. Larger ones become fans.
const MAX_CONCAVE: usize = 4096;

/// Cuts a polygon into triangles with the same turn, as numbers of its corners.
///
/// Convex polygons become fans. Concave ones are cut by ear clipping (Meisters,
/// "Polygons have ears", 1975) in the plane that they nearly lie in. A polygon
/// that crosses itself gives triangles too, whatever they may cover.
pub(super) fn triangulate(corners: &[DVec3], triangles: &mut Vec<[usize; 3]>) {
    match corners.len() {
        0..3 => {}
        3 => triangles.push([0, 1, 2]),
        count => {
            let flat = project(corners);
            if count > MAX_CONCAVE || is_convex(&flat) {
                triangles.extend((2..count).map(|at| [0, at - 1, at]));
            } else {
                clip_ears(&flat, triangles);
            }
        }
    }
}

/// The polygon in the plane of two axes to which it is least inclined, turned
/// so that its area is positive.
fn project(corners: &[DVec3]) -> Vec<DVec2> {
    // Newell's method gives the normal of a polygon that is not quite flat
    // (Sutherland, Sproull, Schumacker, "A characterization of ten
    // hidden-surface algorithms", 1974).
    let origin = corners[0];
    let normal: DVec3 = (0..corners.len())
        .map(|at| {
            let (a, b) = (
                corners[at] - origin,
                corners[(at + 1) % corners.len()] - origin,
            );
            a.cross(b)
        })
        .sum();
    let size = normal.abs();
    let flatten = |corner: &DVec3| {
        let corner = *corner - origin;
        if size.x >= size.y && size.x >= size.z {
            DVec2::new(corner.y * normal.x.signum(), corner.z)
        } else if size.y >= size.z {
            DVec2::new(corner.z * normal.y.signum(), corner.x)
        } else {
            DVec2::new(corner.x * normal.z.signum(), corner.y)
        }
    };
    corners.iter().map(flatten).collect()
}

/// Twice the signed area of a triangle.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Whether a fan from the first corner covers the polygon: every corner turns
/// left, and all of it lies around the first corner in order. Straight corners
/// don't count as convex, for a fan may pass over them, and a neighbour that
/// uses them would gape.
fn is_convex(flat: &[DVec2]) -> bool {
    let count = flat.len();
    (0..count).all(|at| turn(flat[at], flat[(at + 1) % count], flat[(at + 2) % count]) > 0.0)
        && (2..count).all(|at| turn(flat[0], flat[at - 1], flat[at]) > 0.0)
}

fn clip_ears(flat: &[DVec2], triangles: &mut Vec<[usize; 3]>) {
    let mut left: Vec<usize> = (0..flat.len()).collect();
    let mut at = 0;
    while left.len() > 3 {
        let count = left.len();
        let corner = |at: usize| {
            [
                left[(at + count - 1) % count],
                left[at % count],
                left[(at + 1) % count],
            ]
        };
        let area = |at: usize| {
            let [a, b, c] = corner(at).map(|corner| flat[corner]);
            turn(a, b, c)
        };
        // From where the last one was cut, so that the triangles don't all
        // meet in one corner. Without an ear the polygon touches or crosses
        // itself: first a corner goes that covers nothing, else any.
        let mut round = at..at + count;
        let ear = round
            .clone()
            .find(|&at| is_ear(flat, &left, corner(at)))
            .or_else(|| round.find(|&at| area(at) == 0.0))
            .unwrap_or(at);
        triangles.push(corner(ear));
        left.remove(ear % count);
        at = ear % count % (count - 1);
    }
    triangles.push([left[0], left[1], left[2]]);
}

/// Whether a corner can be cut off: it turns left, and no other corner lies in
/// its triangle or on its border. Corners at the same place as one of its own,
/// as at the bridge to a hole, are in nobody's way.
fn is_ear(flat: &[DVec2], left: &[usize], ear: [usize; 3]) -> bool {
    let [a, b, c] = ear.map(|corner| flat[corner]);
    turn(a, b, c) > 0.0
        && !left.iter().any(|&other| {
            let p = flat[other];
            !ear.contains(&other)
                && p != a
                && p != b
                && p != c
                && turn(a, b, p) >= 0.0
                && turn(b, c, p) >= 0.0
                && turn(c, a, p) >= 0.0
        })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use rand::Rng;

    use super::*;
    use crate::fuzz;

    /// Areas of the triangles against the area of the polygon, all turning as
    /// it does: then they cover it once.
    fn check(flat: &[DVec2]) {
        let tilt = |p: &DVec2| DVec3::new(p.x, 0.3 * p.x - 0.2 * p.y, -p.y);
        let corners: Vec<DVec3> = flat.iter().map(tilt).collect();
        let mut triangles = Vec::new();
        triangulate(&corners, &mut triangles);
        assert_eq!(triangles.len(), flat.len() - 2);
        let area: f64 = (0..flat.len())
            .map(|at| flat[at].perp_dot(flat[(at + 1) % flat.len()]))
            .sum();
        let mut covered = 0.0;
        for [a, b, c] in triangles {
            let part = turn(flat[a], flat[b], flat[c]) * area.signum();
            assert!(part >= -1e-12, "a triangle turns the wrong way in {flat:?}");
            covered += part;
        }
        assert!(
            (covered - area.abs()).abs() < 1e-9 * area.abs(),
            "{covered} of {area}: {flat:?}"
        );
    }

    #[test]
    fn known_shapes() {
        let arrow = [[0., 0.], [2., -1.], [0.5, 0.], [2., 1.]];
        let comb = [
            [0., 0.],
            [5., 0.],
            [5., 3.],
            [4., 3.],
            [4., 1.],
            [3., 1.],
            [3., 3.],
            [2., 3.],
            [2., 1.],
            [1., 1.],
            [1., 3.],
            [0., 3.],
        ];
        // A square hole, reached by a bridge that is walked twice.
        let hole = [
            [0., 0.],
            [4., 0.],
            [4., 4.],
            [0., 4.],
            [0., 0.],
            [1., 1.],
            [1., 3.],
            [3., 3.],
            [3., 1.],
            [1., 1.],
        ];
        let straight = [
            [0., 0.],
            [1., 0.],
            [2., 0.],
            [2., 1.],
            [2., 2.],
            [0., 2.],
            [0., 1.],
        ];
        let first_corner_hollow = [[1., 1.], [0., 3.], [-4., 0.], [0., -3.]];
        for shape in [&arrow[..], &comb, &hole, &straight, &first_corner_hollow] {
            let mut shape: Vec<DVec2> = shape.iter().map(|&p| DVec2::from_array(p)).collect();
            // From every corner, and both ways round.
            for _ in 0..shape.len() {
                shape.rotate_left(1);
                check(&shape);
            }
            shape.reverse();
            check(&shape);
        }
    }

    #[test]
    fn random_stars() {
        let mut random = fuzz::random();
        for _ in 0..fuzz::rounds(2000, 1_000_000) {
            let count = random.random_range(4..40);
            let star: Vec<DVec2> = (0..count)
                .map(|at| {
                    let angle = std::f64::consts::TAU * f64::from(at) / f64::from(count);
                    DVec2::from_angle(angle) * random.random_range(0.1..1.0)
                })
                .collect();
            check(&star);
        }
    }

    #[test]
    fn hopeless_polygons_end() {
        let mut random = fuzz::random();
        for _ in 0..fuzz::rounds(2000, 1_000_000) {
            let count = random.random_range(3..24);
            // A coarse grid makes many coincident and collinear corners.
            let corners: Vec<DVec3> = (0..count)
                .map(|_| DVec3::from_array([0, 1, 2].map(|_| f64::from(random.random_range(0..4)))))
                .collect();
            let mut triangles = Vec::new();
            triangulate(&corners, &mut triangles);
            assert_eq!(triangles.len(), count - 2);
        }
        let same = vec![DVec3::ONE; 5000];
        let mut triangles = Vec::new();
        triangulate(&same, &mut triangles);
        assert_eq!(triangles.len(), 4998);
    }
}
