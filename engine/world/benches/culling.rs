//! Culling spheres: the world against the best loops written by hand, an array of
//! structures and boxed objects.

use std::time::{Duration, Instant};

use glam::Mat4;
use glam::camera::rh::proj::directx;
use lightbench_world::culling::{
    Culler, Frustum, InstructionSet, Spheres, cull_spheres, cull_spheres_with,
};
use lightbench_world_benches::{Contest, criterion};
use rand::{Rng, SeedableRng};

fn frustum() -> Frustum {
    let projection = directx::perspective(1.0, 16.0 / 9.0, 500.0, 0.1);
    Frustum::from_view_projection(projection * Mat4::from_rotation_y(0.4))
}

fn random_spheres(count: usize) -> [Vec<f32>; 4] {
    let mut random = rand_pcg::Pcg64::seed_from_u64(9);
    let mut numbers = |least: f32, greatest: f32| -> Vec<f32> {
        (0..count)
            .map(|_| random.random_range(least..greatest))
            .collect()
    };
    [
        numbers(-300.0, 300.0),
        numbers(-300.0, 300.0),
        numbers(-300.0, 300.0),
        numbers(0.1, 3.0),
    ]
}

/// An object as it often stands in an engine: 200 bytes, of which 16 are needed.
#[derive(Clone)]
struct Object {
    _matrix: [f32; 16],
    _name: [u8; 24],
    sphere: [f32; 4],
    _rest: [u8; 96],
}

trait Drawable {
    fn visible(&self, frustum: &Frustum) -> bool;
}

impl Drawable for Object {
    fn visible(&self, frustum: &Frustum) -> bool {
        let [x, y, z, radius] = self.sphere;
        let mut planes = frustum.planes.iter();
        planes.all(|plane| plane.distance_to(x, y, z) + radius >= 0.0)
    }
}

/// Sixteen spheres at once and the compress instruction, which is the best that
/// can be written by hand for this processor.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f")]
fn cull_avx512(frustum: &Frustum, spheres: Spheres<'_>, visible: &mut Vec<u32>) {
    use std::arch::x86_64::*;
    let count = spheres.x.len() / 16 * 16;
    visible.clear();
    visible.reserve(spheres.x.len() + 16);
    let mut found = 0;
    let mut rows = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    let planes = frustum.planes.map(|plane| {
        [
            plane.normal.x,
            plane.normal.y,
            plane.normal.z,
            plane.distance,
        ]
        .map(|n| _mm512_set1_ps(n))
    });
    for first in (0..count).step_by(16) {
        // SAFETY: `first + 16` is not beyond the arrays, and the list has room for
        // sixteen more than it can get.
        unsafe {
            let x = _mm512_loadu_ps(spheres.x.as_ptr().add(first));
            let y = _mm512_loadu_ps(spheres.y.as_ptr().add(first));
            let z = _mm512_loadu_ps(spheres.z.as_ptr().add(first));
            let radius = _mm512_loadu_ps(spheres.radius.as_ptr().add(first));
            let limit = _mm512_sub_ps(_mm512_setzero_ps(), radius);
            let mut mask = u16::MAX;
            for [a, b, c, d] in planes {
                let sum = _mm512_fmadd_ps(a, x, _mm512_fmadd_ps(b, y, _mm512_fmadd_ps(c, z, d)));
                mask = _mm512_mask_cmp_ps_mask::<_CMP_GE_OQ>(mask, sum, limit);
            }
            let packed = _mm512_maskz_compress_epi32(mask, rows);
            _mm512_storeu_si512(visible.as_mut_ptr().add(found).cast(), packed);
            found += mask.count_ones() as usize;
        }
        rows = _mm512_add_epi32(rows, _mm512_set1_epi32(16));
    }
    // SAFETY: so many were written.
    unsafe { visible.set_len(found) };
    for row in count..spheres.x.len() {
        let s = spheres;
        if frustum.intersects_sphere(s.x[row], s.y[row], s.z[row], s.radius[row]) {
            visible.push(row as u32);
        }
    }
}

fn many(criterion: &mut criterion::Criterion, count: usize, job: &'static str) {
    let [x, y, z, radius] = random_spheres(count);
    let spheres = Spheres {
        x: &x,
        y: &y,
        z: &z,
        radius: &radius,
    };
    let frustum = frustum();
    let mut visible = Vec::new();
    let mut contest = Contest::new(criterion, job);

    contest.enter("world", || cull_spheres(&frustum, spheres, &mut visible));
    let expected = visible.clone();
    println!("{} of {count} visible", expected.len());

    contest.enter("by hand, a branch a sphere", || {
        visible.clear();
        for row in 0..count {
            if frustum
                .planes
                .iter()
                .all(|plane| plane.distance_to(x[row], y[row], z[row]) + radius[row] >= 0.0)
            {
                visible.push(row as u32);
            }
        }
    });
    assert_eq!(visible, expected);

    contest.enter("by hand, branchless", || {
        visible.clear();
        visible.resize(count, 0);
        let mut found = 0;
        for row in 0..count {
            visible[found] = row as u32;
            found += usize::from(frustum.intersects_sphere(x[row], y[row], z[row], radius[row]));
        }
        visible.truncate(found);
    });
    assert_eq!(visible, expected);

    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx512f") {
        // SAFETY: the processor has the instructions.
        contest.enter("by hand, AVX-512", || unsafe {
            cull_avx512(&frustum, spheres, &mut visible);
        });
        contest.ratio("world", "by hand, AVX-512", 1.15);
    }
    contest.ratio("world", "by hand, branchless", 1.15);

    for (name, instructions) in [
        ("world, AVX2", InstructionSet::Avx2),
        ("world, baseline", InstructionSet::Baseline),
    ] {
        contest.enter(name, || {
            cull_spheres_with(instructions, &frustum, spheres, &mut visible);
        });
        assert_eq!(visible, expected);
        contest.ratio(name, "by hand, branchless", 1.15);
        contest.ratio(name, "world", f64::INFINITY);
    }

    let mut culler = Culler::default();
    let mut lists = Vec::new();
    // Wall-clock time, because several threads work.
    contest.enter_timed("world, all threads", || {
        let start = Instant::now();
        culler.cull(&[frustum], spheres, &mut lists);
        start.elapsed()
    });
    assert_eq!(lists[0], expected);
    contest.enter_timed("world, all threads, four views", || {
        let start = Instant::now();
        culler.cull(&[frustum; 4], spheres, &mut lists);
        start.elapsed()
    });

    let objects: Vec<Object> = (0..count)
        .map(|row| Object {
            _matrix: [0.0; 16],
            _name: [0; 24],
            sphere: [x[row], y[row], z[row], radius[row]],
            _rest: [0; 96],
        })
        .collect();
    contest.enter("array of 200-byte structures", || {
        visible.clear();
        for (row, object) in objects.iter().enumerate() {
            if object.visible(&frustum) {
                visible.push(row as u32);
            }
        }
    });
    assert_eq!(visible, expected);
    let mut boxed: Vec<(usize, Box<dyn Drawable>)> = Vec::new();
    for (row, object) in objects.iter().enumerate() {
        boxed.push((row, Box::new(object.clone())));
    }
    contest.enter("boxed objects", || {
        visible.clear();
        for (row, object) in &boxed {
            if object.visible(&frustum) {
                visible.push(*row as u32);
            }
        }
    });
    match count {
        1_000_000 => contest.ratio("world", "array of 200-byte structures", 1.0 / 15.0),
        6_708 => contest.within("world", Duration::from_micros(10)),
        15_000 => contest.within("world", Duration::from_micros(20)),
        _ => {}
    }
}

fn main() {
    let mut criterion = criterion();
    many(&mut criterion, 1_000_000, "cull 1,000,000 spheres");
    many(&mut criterion, 15_000, "cull 15,000 spheres");
    many(&mut criterion, 6_708, "cull 6,708 spheres");
    criterion.final_summary();
}
