//! Many spheres, several views, all threads.

use rayon::prelude::*;

use super::compact::append_passing;
use super::spheres::SphereTest;
use super::{Spheres, Volume};

/// Spheres that one thread tests before it takes more: 256 KiB of coordinates,
/// which stay in its cache while all views are tested against them.
const PART: usize = 1 << 14;

/// Culls for several views at once, on all threads. Keeps its memory from frame to
/// frame.
///
/// Each thread has lists of its own for the part of the spheres that it tests, so
/// that no thread waits for another; the lists are joined in the order of the
/// parts. The result is that of [`cull_spheres`](super::cull_spheres) for each
/// view.
#[derive(Clone, Debug, Default)]
pub struct Culler {
    parts: Vec<Vec<Vec<u32>>>,
}

impl Culler {
    /// Fills one list for each volume with the rows of the spheres that it may
    /// touch, in ascending order. Lists are added where there are too few and
    /// emptied where there are too many.
    pub fn cull<V: Volume>(
        &mut self,
        volumes: &[V],
        spheres: Spheres<'_>,
        visible: &mut Vec<Vec<u32>>,
    ) {
        visible.resize_with(visible.len().max(volumes.len()), Vec::new);
        visible.iter_mut().for_each(Vec::clear);
        let count = spheres.len();
        let parts = count.div_ceil(PART);
        if parts <= 1 {
            // Handing out work costs more than testing so few.
            for (volume, list) in volumes.iter().zip(visible) {
                append_passing(&SphereTest { volume, spheres }, 0..count, list);
            }
            return;
        }
        if self.parts.len() < parts {
            self.parts.resize_with(parts, Vec::new);
        }
        let lists = self.parts[..parts].par_iter_mut().enumerate();
        lists.for_each(|(part, lists)| {
            let rows = part * PART..count.min((part + 1) * PART);
            lists.resize_with(lists.len().max(volumes.len()), Vec::new);
            for (volume, list) in volumes.iter().zip(lists) {
                list.clear();
                append_passing(&SphereTest { volume, spheres }, rows.clone(), list);
            }
        });
        for (view, list) in visible.iter_mut().enumerate().take(volumes.len()) {
            for part in &self.parts[..parts] {
                list.extend_from_slice(&part[view]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::culling::{Ball, cull_spheres};
    use glam::Vec3;
    use rand::{Rng, SeedableRng};

    #[test]
    fn all_views_and_threads_give_what_one_gives() {
        let mut random = rand_pcg::Pcg64::seed_from_u64(3);
        let mut culler = Culler::default();
        let mut visible = vec![vec![1, 2, 3]; 5];
        for count in [0, 100, PART, PART + 1, 100_000] {
            let arrays: [Vec<f32>; 4] = std::array::from_fn(|_| {
                let numbers = (0..count).map(|_| random.random_range(-5.0..5.0));
                numbers.collect()
            });
            let [x, y, z, radius] = &arrays;
            let spheres = Spheres { x, y, z, radius };
            let balls: Vec<_> = (0..3)
                .map(|i| Ball {
                    center: Vec3::splat(i as f32),
                    radius: 2.0,
                })
                .collect();
            culler.cull(&balls, spheres, &mut visible);
            for (ball, list) in balls.iter().zip(&visible) {
                let mut expected = Vec::new();
                cull_spheres(ball, spheres, &mut expected);
                assert_eq!(*list, expected);
                assert_eq!(expected.is_empty(), count == 0);
            }
            assert!(visible[3].is_empty() && visible[4].is_empty());
        }
    }
}
