//! The layouts that the world is compared with.

use glam::{Mat4, Vec3};

use crate::culling::Frustum;
use crate::{MeshRenderer, Transform, Velocity, World, WorldBounds};

/// An object as engines often have it: everything that anybody ever wants to know
/// about it, in one structure.
#[derive(Clone, Debug)]
#[repr(C)]
pub struct Object {
    name: [u8; 32],
    translation: Vec3,
    rotation: [f32; 4],
    scale: Vec3,
    world_matrix: [f32; 16],
    center: Vec3,
    radius: f32,
    half_extents: Vec3,
    velocity: Vec3,
    angular_velocity: Vec3,
    mesh: u32,
    material: u32,
    flags: u32,
}

const _: () = assert!(size_of::<Object>() == 200);

/// What the jobs ask of an object whose type they do not know.
pub trait SceneObject: Send {
    /// Whether a view shows it.
    fn is_visible(&self, frustum: &Frustum) -> bool;
    /// Moves it by a step in seconds.
    fn step(&mut self, step: f32);
    /// Where it is, in metres.
    fn translation(&self) -> Vec3;
}

impl SceneObject for Object {
    fn is_visible(&self, frustum: &Frustum) -> bool {
        let Vec3 { x, y, z } = self.center;
        let mut planes = frustum.planes.iter();
        planes.all(|plane| plane.distance_to(x, y, z) >= -self.radius)
    }
    fn step(&mut self, step: f32) {
        self.translation += self.velocity * step;
    }
    fn translation(&self) -> Vec3 {
        self.translation
    }
}

/// Numbers that look random and are the same everywhere (Steele et al. 2014, "Fast
/// splittable pseudorandom number generators").
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    /// From −1 to 1.
    fn signed(&mut self) -> f32 {
        (self.next() >> 40) as f32 / (1 << 23) as f32 - 1.0
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::new(self.signed(), self.signed(), self.signed())
    }
}

/// The view of the culling job: about a tenth of the objects lies in it.
pub(super) fn view() -> Frustum {
    let projection = glam::camera::rh::proj::directx::perspective(1.0, 16.0 / 9.0, 500.0, 0.1);
    Frustum::from_view_projection(projection * Mat4::from_rotation_y(0.4))
}

/// Objects in an array.
pub fn objects(count: usize) -> Vec<Object> {
    let mut numbers = Numbers(1);
    (0..count as u32)
        .map(|i| {
            let center = numbers.vector() * 300.0;
            Object {
                name: [0; 32],
                translation: center,
                rotation: [0.0, 0.0, 0.0, 1.0],
                scale: Vec3::ONE,
                world_matrix: Mat4::from_translation(center).to_cols_array(),
                center,
                radius: 1.5 + numbers.signed(),
                half_extents: Vec3::ONE,
                velocity: numbers.vector(),
                angular_velocity: Vec3::ZERO,
                mesh: i % 64,
                material: i % 256,
                flags: 1,
            }
        })
        .collect()
}

/// Boxed objects with their numbers. They lie in memory in an order that has
/// nothing to do with that of the list, as after some time in which objects came
/// and went.
pub fn boxed(objects: &[Object]) -> Vec<(u32, Box<dyn SceneObject>)> {
    let mut list: Vec<(u32, Box<dyn SceneObject>)> = (0..)
        .zip(objects)
        .map(|(i, object)| (i, Box::new(object.clone()) as Box<dyn SceneObject>))
        .collect();
    let mut numbers = Numbers(2);
    for last in (1..list.len()).rev() {
        list.swap(last, (numbers.next() % (last as u64 + 1)) as usize);
    }
    list
}

/// The same objects in a world.
pub fn world(count: usize) -> World {
    let objects = objects(count);
    let mut world = World::new();
    world.spawn_batch(objects.iter().map(|object| {
        let velocity = Velocity {
            linear: object.velocity,
            angular: object.angular_velocity,
        };
        (
            Transform::from_translation(object.translation),
            velocity,
            MeshRenderer::default(),
        )
    }));
    let bounds = world.columns_mut::<WorldBounds>();
    for (row, object) in objects.iter().enumerate() {
        let Vec3 { x, y, z } = object.center;
        bounds.set_row(
            row,
            WorldBounds {
                x,
                y,
                z,
                radius: object.radius,
                half_x: object.half_extents.x,
                half_y: object.half_extents.y,
                half_z: object.half_extents.z,
            },
        );
    }
    world
}

/// Fills `visible` with the numbers of the objects that a view shows.
pub fn cull_objects(frustum: &Frustum, objects: &[Object], visible: &mut Vec<u32>) {
    visible.clear();
    let numbered = (0..).zip(objects);
    let shown = numbered.filter(|(_, object)| object.is_visible(frustum));
    visible.extend(shown.map(|(number, _)| number));
}

/// Fills `visible` with the numbers of the objects that a view shows.
pub fn cull_boxed(
    frustum: &Frustum,
    objects: &[(u32, Box<dyn SceneObject>)],
    visible: &mut Vec<u32>,
) {
    visible.clear();
    let shown = objects
        .iter()
        .filter(|(_, object)| object.is_visible(frustum));
    visible.extend(shown.map(|(number, _)| *number));
}
