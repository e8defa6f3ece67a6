//! What a frame costs: world matrices in trees, and all systems of a scene of
//! lights.

use std::time::Duration;

use glam::camera::rh::proj::directx;
use glam::camera::rh::view::look_at_mat4;
use glam::{Affine3A, Quat, Vec3};
use lightbench_world::culling::{Frustum, cull_spheres};
use lightbench_world::systems::{update_bounds, update_world_matrices};
use lightbench_world::{
    Entity, Light, Mailbox, MeshBounds, MeshRenderer, Transform, World, WorldBounds, WorldMatrix,
};
use lightbench_world_benches::{Contest, criterion, now};

const COUNT: usize = 100_000;
const CHAIN: usize = 8;

fn place(i: usize, turn: f32) -> Transform {
    Transform {
        translation: Vec3::new(0.1, 0.2, i as f32 * 1e-3),
        rotation: Quat::from_rotation_y(turn),
        scale: Vec3::ONE,
    }
}

/// Chains of eight, spawned chain after chain or level after level.
fn chains(level_after_level: bool) -> World {
    let mut world = World::new();
    let entities = world
        .spawn_batch((0..COUNT).map(|i| (place(i, 0.3),)))
        .to_vec();
    for i in 0..COUNT {
        let parent = if level_after_level {
            i.checked_sub(COUNT / CHAIN)
        } else {
            (i % CHAIN != 0).then(|| i - 1)
        };
        let parent: Option<Entity> = parent.map(|parent| entities[parent]);
        world.set_parent(entities[i], parent).ok();
    }
    world
}

/// Transforms in the order of depth, each with its parent's position.
struct ByHand {
    translation: Vec<Vec3>,
    rotation: Vec<Quat>,
    scale: Vec<Vec3>,
    parent: Vec<u32>,
    matrix: Vec<Affine3A>,
}

impl ByHand {
    fn new() -> Self {
        let level = COUNT / CHAIN;
        let places: Vec<_> = (0..COUNT).map(|i| place(i, 0.3)).collect();
        Self {
            translation: places.iter().map(|place| place.translation).collect(),
            rotation: places.iter().map(|place| place.rotation).collect(),
            scale: places.iter().map(|place| place.scale).collect(),
            parent: (0..COUNT)
                .map(|i| {
                    i.checked_sub(level)
                        .map_or(u32::MAX, |parent| parent as u32)
                })
                .collect(),
            matrix: vec![Affine3A::IDENTITY; COUNT],
        }
    }

    fn update(&mut self) {
        for i in 0..COUNT {
            let local = Affine3A::from_scale_rotation_translation(
                self.scale[i],
                self.rotation[i],
                self.translation[i],
            );
            self.matrix[i] = match self.parent[i] {
                u32::MAX => local,
                parent => self.matrix[parent as usize] * local,
            };
        }
    }
}

fn matrices(criterion: &mut criterion::Criterion) {
    let mut contest = Contest::new(criterion, "world matrices of 100,000 in chains of eight");
    let mut by_hand = ByHand::new();
    contest.enter("by hand", || by_hand.update());
    let names = [
        ("world, level after level", true),
        ("world, chain after chain", false),
    ];
    for (name, level_after_level) in names {
        let mut world = chains(level_after_level);
        let mut turn = 0.0;
        contest.enter_timed(name, || {
            turn += 0.01;
            let rotations = world.columns_mut::<Transform>().slices_mut().rotation;
            rotations.fill(Quat::from_rotation_y(turn));
            let start = now();
            update_world_matrices(&mut world);
            start.elapsed()
        });
        contest.ratio(name, "by hand", 1.3);
    }
    let mut world = chains(false);
    update_world_matrices(&mut world);
    contest.enter("world, none moved", || update_world_matrices(&mut world));
    contest.within("world, none moved", Duration::from_micros(50));
    let one = world.columns::<Transform>().entities()[COUNT / 2];
    contest.enter_timed("world, one moved", || {
        let mut place: Transform = world.get(one).unwrap_or_default();
        place.translation.x += 0.1;
        world.set(one, place).ok();
        let start = now();
        update_world_matrices(&mut world);
        start.elapsed()
    });
}

/// Spheres over a field and lights above them, all lights moving.
fn many_lights(criterion: &mut criterion::Criterion) {
    let mut world = World::new();
    let bounds = [MeshBounds {
        center: Vec3::ZERO,
        half_extents: Vec3::ONE,
        radius: 1.0,
    }];
    let at = |i: usize, y: f32| {
        Transform::from_translation(Vec3::new((i % 100) as f32, y, (i / 100) as f32))
    };
    world.spawn_batch((0..10_000).map(|i| (at(i, 0.0), MeshRenderer::default())));
    let lights = world
        .spawn_batch((0..1024).map(|i| (at(i * 9, 1.0), Light::default())))
        .to_vec();
    let projection = directx::perspective(1.0, 16.0 / 9.0, 500.0, 0.1);
    let view = look_at_mat4(
        Vec3::new(50.0, 30.0, -40.0),
        Vec3::new(50.0, 0.0, 50.0),
        Vec3::Y,
    );
    let frustum = Frustum::from_view_projection(projection * view);
    let mut visible = Vec::new();
    let mut rows: Vec<(Affine3A, u32)> = Vec::new();
    let mut contest = Contest::new(criterion, "a frame of 10,000 objects and 1,024 lights");
    contest.enter("systems and extraction", || {
        for &light in &lights {
            let mut place: Transform = world.get(light).unwrap_or_default();
            place.translation.y += 1e-3;
            world.set(light, place).ok();
        }
        update_world_matrices(&mut world);
        update_bounds(&mut world, &bounds);
        cull_spheres(
            &frustum,
            world.columns::<WorldBounds>().spheres(),
            &mut visible,
        );
        let renderers = world.columns::<MeshRenderer>();
        let matrices = world.columns::<WorldMatrix>();
        rows.clear();
        for &row in &visible {
            let entity = renderers.entities()[row as usize];
            if let Some(place) = matrices.row_of(entity) {
                rows.push((
                    matrices.matrix()[place],
                    renderers.material()[row as usize].0,
                ));
            }
        }
        rows.len()
    });
    contest.within("systems and extraction", Duration::from_millis(2));
    println!("{} of 10,000 visible", visible.len());
}

/// 100,000 messages to 10,000 entities.
fn messages(criterion: &mut criterion::Criterion) {
    let mut world = World::new();
    let entities: Vec<Entity> = (0..10_000).map(|_| world.spawn()).collect();
    let mut mailbox = Mailbox::<(u32, f32)>::default();
    let mut contest = Contest::new(criterion, "100,000 messages");
    contest.enter("send and deliver", || {
        for (batch, outbox) in mailbox.outboxes(10).iter_mut().enumerate() {
            for i in 0..10_000 {
                outbox.send(
                    entities[(i * 7919 + batch) % entities.len()],
                    (i as u32, 0.5),
                );
            }
        }
        mailbox.deliver(&world)
    });
    contest.within("send and deliver", Duration::from_millis(16));
}

fn main() {
    let mut criterion = criterion();
    matrices(&mut criterion);
    many_lights(&mut criterion);
    messages(&mut criterion);
    criterion.final_summary();
}
