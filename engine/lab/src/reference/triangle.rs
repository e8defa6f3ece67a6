//! The twin of `shaders/lib/triangle.wgsl`: where a line of sight meets a triangle.

use glam::DVec3;

/// A triangle in a space where the eye is the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// One corner, metres.
    pub corner: DVec3,
    /// From it to the second corner.
    pub edge_b: DVec3,
    /// From it to the third corner.
    pub edge_c: DVec3,
}

/// Weights of the three corners and how they change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Together 1.
    pub weights: DVec3,
    /// Their change along `step`.
    pub change: DVec3,
    /// Whether the corners run counter-clockwise as the eye sees them.
    pub counter_clockwise: bool,
}

impl Triangle {
    /// The point in a direction, and how its weights change when the direction moves by `step`
    /// (Möller and Trumbore 1997; the quotient rule for the change).
    pub fn meet(&self, direction: DVec3, step: DVec3) -> Hit {
        let b = self.corner.cross(self.edge_c);
        let c = self.edge_b.cross(self.corner);
        let area = self.edge_c.cross(self.edge_b);
        let facing = direction.dot(area);
        let inverse = if facing == 0.0 { 0.0 } else { 1.0 / facing };
        let (wb, wc) = (direction.dot(b) * inverse, direction.dot(c) * inverse);
        let change_b = (step.dot(b) - wb * step.dot(area)) * inverse;
        let change_c = (step.dot(c) - wc * step.dot(area)) * inverse;
        Hit {
            weights: DVec3::new(1.0 - wb - wc, wb, wc),
            change: DVec3::new(-change_b - change_c, change_b, change_c),
            counter_clockwise: facing > 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(corners: [DVec3; 3]) -> Triangle {
        Triangle {
            corner: corners[0],
            edge_b: corners[1] - corners[0],
            edge_c: corners[2] - corners[0],
        }
    }

    fn slanted() -> [DVec3; 3] {
        [
            DVec3::new(-1.0, -0.5, -2.0),
            DVec3::new(1.5, -0.2, -9.0),
            DVec3::new(0.2, 1.4, -4.0),
        ]
    }

    #[test]
    fn weights_of_a_known_point_come_back() {
        let corners = slanted();
        for known in [
            DVec3::new(1.0, 0.0, 0.0),
            DVec3::new(0.2, 0.3, 0.5),
            DVec3::new(0.0, 0.5, 0.5),
            // Outside of the triangle too.
            DVec3::new(1.2, -0.1, -0.1),
        ] {
            let point = corners[0] * known.x + corners[1] * known.y + corners[2] * known.z;
            // The length of the direction does not matter.
            let hit = triangle(corners).meet(point * 0.3, DVec3::X);
            assert!((hit.weights - known).length() < 1e-12, "{hit:?}");
        }
    }

    #[test]
    fn the_middle_on_the_screen_is_not_the_middle_of_an_edge() {
        // From z = -1 to z = -3: halfway on the screen is a quarter of the way, 1/z being linear.
        let corners = [
            DVec3::new(-1.0, 0.0, -1.0),
            DVec3::new(3.0, 0.0, -3.0),
            DVec3::new(0.0, 5.0, -2.0),
        ];
        let hit = triangle(corners).meet(DVec3::new(0.0, 0.0, -1.0), DVec3::X);
        assert!((hit.weights - DVec3::new(0.75, 0.25, 0.0)).length() < 1e-12);
    }

    #[test]
    fn changes_are_those_of_a_small_step() {
        let triangle = triangle(slanted());
        let direction = DVec3::new(0.05, 0.1, -1.0);
        for step in [DVec3::X, DVec3::Y] {
            let hit = triangle.meet(direction, step);
            let small = 1e-6;
            let before = triangle.meet(direction - step * small, step).weights;
            let after = triangle.meet(direction + step * small, step).weights;
            let measured = (after - before) / (2.0 * small);
            assert!((hit.change - measured).length() < 1e-6 * measured.length());
            assert!(hit.change.element_sum().abs() < 1e-12);
        }
    }

    #[test]
    fn the_way_round_tells_the_side() {
        let [a, b, c] = slanted();
        let direction = (a + b + c) / 3.0;
        assert!(
            triangle([a, b, c])
                .meet(direction, DVec3::X)
                .counter_clockwise
        );
        assert!(
            !triangle([a, c, b])
                .meet(direction, DVec3::X)
                .counter_clockwise
        );
        // Seen from its edge it has no inside.
        let edge = triangle([a, b, (a + b) / 2.0 * 1.5]).meet(a, DVec3::X);
        assert!(edge.weights.is_finite());
    }
}
