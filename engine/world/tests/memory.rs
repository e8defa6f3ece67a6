//! What a world allocates: nothing in a steady frame, and little beside its rows.
#![allow(clippy::unwrap_used)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use glam::camera::rh::proj::directx;
use glam::{Affine3A, Quat, Vec3};
use lightbench_world::culling::{Culler, Frustum, cull_spheres};
use lightbench_world::systems::{FrameSystems, animate, update_bounds, update_world_matrices};
use lightbench_world::{
    Entity, Light, LightKind, Mailbox, MeshBounds, MeshRenderer, Transform, Velocity, World,
    WorldBounds,
};

/// Counts the allocations of each thread.
struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

fn count_one() {
    // A thread that ends has no counter any more, and nobody asks for it.
    ALLOCATIONS
        .try_with(|count| count.set(count.get() + 1))
        .ok();
}

// SAFETY: everything is handed on to the system's allocator.
#[allow(unsafe_code)]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count_one();
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count_one();
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations of this thread during a few rounds of work, after some to warm up.
fn allocations(mut round: impl FnMut()) -> usize {
    (0..5).for_each(|_| round());
    let before = ALLOCATIONS.get();
    (0..5).for_each(|_| round());
    ALLOCATIONS.get() - before
}

fn place(i: usize) -> Transform {
    Transform::from_translation(Vec3::new((i % 100) as f32, 0.0, (i / 100) as f32))
}

#[test]
fn a_steady_frame_allocates_nothing() {
    let mut world = World::new();
    let velocity = Velocity {
        linear: Vec3::Y,
        angular: Vec3::X,
    };
    world.spawn_batch((0..10_000).map(|i| (place(i), MeshRenderer::default())));
    let lights = world
        .spawn_batch((0..1_000).map(|i| (place(i), Light::default(), velocity)))
        .to_vec();
    for pair in lights.chunks_exact(2) {
        world.set_parent(pair[1], Some(pair[0])).unwrap();
    }
    let bounds = [MeshBounds::default()];
    let frustum = Frustum::from_view_projection(directx::perspective(1.0, 1.5, 100.0, 0.1));
    let (mut visible, mut views, mut culler) = (Vec::new(), Vec::new(), Culler::default());
    let frame = allocations(|| {
        world.set(lights[3], place(7)).unwrap();
        animate(&mut world, 1.0);
        update_world_matrices(&mut world);
        update_bounds(&mut world, &bounds);
        let spheres = world.columns::<WorldBounds>().spheres();
        cull_spheres(&frustum, spheres, &mut visible);
        culler.cull(&[frustum; 3], spheres, &mut views);
    });
    assert_eq!(frame, 0, "systems and culling");

    let mut systems = FrameSystems::default();
    let scheduled = allocations(|| systems.run(&mut world, &bounds, 1.0, 0.01));
    assert_eq!(scheduled, 0, "schedule");

    let mut mailbox = Mailbox::<(u32, f32)>::default();
    let messages = allocations(|| {
        for (batch, outbox) in mailbox.outboxes(10).iter_mut().enumerate() {
            for i in 0..10_000 {
                outbox.send(lights[(i * 7 + batch) % lights.len()], (i as u32, 0.5));
            }
        }
        assert_eq!(mailbox.deliver(&world), 0);
        assert_eq!(mailbox.iter().count(), 100_000);
    });
    assert_eq!(messages, 0, "100,000 messages");
}

/// At most 1.15 times the bytes of the rows and 12 for each entity and component.
/// Change ticks, maps and the slots of the entities themselves count as used.
#[test]
fn memory_is_little_more_than_the_rows() {
    let count = 100_000;
    let mut world = World::new();
    world.spawn_batch((0..count).map(|i| (place(i), MeshRenderer::default())));
    let lamps: Vec<Entity> = world.entities().step_by(10).collect();
    for lamp in lamps {
        world.insert(lamp, Light::default()).unwrap();
    }
    let transform = size_of::<[f32; 6]>() + size_of::<Quat>();
    let renderer = 2 * size_of::<u32>() + size_of::<bool>();
    let matrix = size_of::<Affine3A>();
    let bounds = size_of::<[f32; 7]>();
    let light = size_of::<LightKind>() + size_of::<[f32; 7]>();
    let rows = count * (transform + matrix + renderer + bounds) + count / 10 * light;
    let pairs = 4 * count + count / 10;
    let bar = (1.15 * rows as f64) as usize + 12 * pairs;
    world.shrink_to_fit();
    let used = world.capacity_bytes();
    println!("{used} bytes used, {bar} allowed, {rows} in rows");
    assert!(used <= bar, "{used} {bar}");
}
