//! Boxes along the axes against a view.

use std::ops::Range;

use super::Frustum;
use super::compact::{BLOCK, Test, append_passing};

/// Bounding boxes along the world's axes as six arrays of the same length, in
/// metres.
#[derive(Clone, Copy, Debug)]
pub struct Boxes<'a> {
    /// Centres, x.
    pub x: &'a [f32],
    /// Centres, y.
    pub y: &'a [f32],
    /// Centres, z.
    pub z: &'a [f32],
    /// Half extents along x.
    pub half_x: &'a [f32],
    /// Half extents along y.
    pub half_y: &'a [f32],
    /// Half extents along z.
    pub half_z: &'a [f32],
}

impl Boxes<'_> {
    /// Number of boxes: the length of the shortest array.
    pub fn len(&self) -> usize {
        let lengths = [
            self.y.len(),
            self.z.len(),
            self.half_x.len(),
            self.half_y.len(),
            self.half_z.len(),
        ];
        lengths.into_iter().fold(self.x.len(), usize::min)
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Frustum {
    /// Whether a box may be visible: no plane has it wholly outside.
    #[inline(always)]
    pub fn touches_box(&self, center: [f32; 3], half: [f32; 3]) -> bool {
        let mut inside = true;
        for plane in &self.planes {
            // The corner that reaches farthest inside.
            let reach = plane.normal.x.abs() * half[0]
                + plane.normal.y.abs() * half[1]
                + plane.normal.z.abs() * half[2];
            inside &= plane.distance_to(center[0], center[1], center[2]) >= -reach;
        }
        inside
    }
}

/// Fills `visible` with the rows of the boxes that a view may show, in ascending
/// order. The vector's memory is reused. Boxes cut off more than spheres do where
/// objects are long and thin, and cost one and a half times the memory traffic.
pub fn cull_boxes(frustum: &Frustum, boxes: Boxes<'_>, visible: &mut Vec<u32>) {
    visible.clear();
    append_passing(&BoxTest { frustum, boxes }, 0..boxes.len(), visible);
}

struct BoxTest<'a> {
    frustum: &'a Frustum,
    boxes: Boxes<'a>,
}

impl Test for BoxTest<'_> {
    #[inline(always)]
    fn flags(&self, rows: Range<usize>) -> [u8; BLOCK] {
        let mut flags = [0; BLOCK];
        let frustum = *self.frustum;
        let boxes = self.boxes;
        let parts = [
            boxes.x,
            boxes.y,
            boxes.z,
            boxes.half_x,
            boxes.half_y,
            boxes.half_z,
        ]
        .map(|array| &array[rows.clone()]);
        if let [
            Some(x),
            Some(y),
            Some(z),
            Some(half_x),
            Some(half_y),
            Some(half_z),
        ] = parts.map(<[f32]>::first_chunk::<BLOCK>)
        {
            for i in 0..BLOCK {
                let half = [half_x[i], half_y[i], half_z[i]];
                flags[i] = u8::from(frustum.touches_box([x[i], y[i], z[i]], half));
            }
        } else {
            for (i, flag) in flags[..rows.len()].iter_mut().enumerate() {
                let [x, y, z, half_x, half_y, half_z] = parts.map(|part| part[i]);
                *flag = u8::from(frustum.touches_box([x, y, z], [half_x, half_y, half_z]));
            }
        }
        flags
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::culling::Volume;
    use glam::camera::rh::proj::directx;
    use rand::{Rng, SeedableRng};

    #[test]
    fn boxes_are_found_exactly_as_one_by_one_and_never_missed() {
        let mut random = rand_pcg::Pcg64::seed_from_u64(2);
        let matrix = directx::perspective(1.0, 1.5, 30.0, 0.1);
        let frustum = Frustum::from_view_projection(matrix);
        let mut numbers = |range: Range<f32>| -> Vec<f32> {
            (0..5000)
                .map(|_| random.random_range(range.clone()))
                .collect()
        };
        let [x, y, z] = std::array::from_fn(|_| numbers(-30.0..30.0));
        let [half_x, half_y, mut half_z] = std::array::from_fn(|_| numbers(0.0..4.0));
        half_z[17] = f32::NAN;
        let boxes = Boxes {
            x: &x,
            y: &y,
            z: &z,
            half_x: &half_x,
            half_y: &half_y,
            half_z: &half_z,
        };
        let mut visible = Vec::new();
        cull_boxes(&frustum, boxes, &mut visible);
        let mut inside = 0;
        for i in 0..boxes.len() {
            let (center, half) = ([x[i], y[i], z[i]], [half_x[i], half_y[i], half_z[i]]);
            let found = visible.binary_search(&(i as u32)).is_ok();
            assert_eq!(found, frustum.touches_box(center, half));
            let shown = (0..27).any(|k| {
                let at = |axis: usize, k: i32| center[axis] + half[axis] * (k % 3 - 1) as f32;
                frustum.touches(at(0, k), at(1, k / 3), at(2, k / 9), 0.0)
            });
            assert!(!shown || found);
            inside += i32::from(shown);
        }
        assert!(inside > 200 && visible.len() < 4000);
    }
}
