//! All systems of a frame, in one schedule.

use crate::schedule::{Schedule, SystemTime};
use crate::world::World;

use super::bounds::{know_meshes, update_known_bounds};
use super::motion::add_motion;
use super::{MeshBounds, update_bounds, update_world_matrices};

/// The systems that bring a world from one moment to the next: even motion, rigid animation, world
/// matrices and bounds, in this order.
///
/// ```
/// # use lightbench_world::{Transform, Velocity, World, systems::FrameSystems};
/// # let mut world = World::new();
/// # world.spawn_batch([(Transform::default(), Velocity::default())]);
/// let mut systems = FrameSystems::default();
/// systems.run(&mut world, &[], 1.0 / 60.0, 1.0 / 60.0);
/// for system in systems.times() {
///     println!("{}: {:.3} ms", system.name, system.thread_ms());
/// }
/// ```
pub struct FrameSystems {
    schedule: Schedule,
}

impl Default for FrameSystems {
    fn default() -> Self {
        let mut schedule = Schedule::default();
        add_motion(&mut schedule);
        schedule.add_exclusive("world matrices", update_world_matrices);
        schedule.add_exclusive("bounds", update_known_bounds);
        Self { schedule }
    }
}

impl FrameSystems {
    /// Runs all of them for a step that ends at `time`, both in seconds. The caller chooses the
    /// step, so that the same steps give the same world however long they take. A step of 0 moves
    /// nothing evenly and poses what is animated.
    ///
    /// `mesh_bounds` is indexed by [`MeshId`](crate::MeshId).
    pub fn run(&mut self, world: &mut World, mesh_bounds: &[MeshBounds], time: f64, step: f32) {
        know_meshes(world, mesh_bounds);
        self.schedule.run_at(world, time, step);
    }

    /// How long each took when it last ran.
    pub fn times(&self) -> impl Iterator<Item = SystemTime> + '_ {
        self.schedule.times()
    }
}

/// Brings the computed columns up to date with what was written since the systems last ran,
/// without letting time pass. Costs next to nothing where nothing was.
pub fn update_computed(world: &mut World, mesh_bounds: &[MeshBounds]) {
    update_world_matrices(world);
    update_bounds(world, mesh_bounds);
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::curve::{Curve, Interpolation};
    use crate::{MeshRenderer, RigidAnimation, Transform, Velocity, WorldBounds};
    use glam::Vec3;

    #[test]
    fn one_run_moves_and_computes_everything() {
        let mut world = World::new();
        let slide = Curve::new(
            vec![0.0, 2.0],
            vec![Vec3::ZERO, Vec3::Y],
            Interpolation::Linear,
        );
        let animation = RigidAnimation {
            translation: slide.unwrap(),
            ..RigidAnimation::default()
        };
        let carrier = world.spawn_batch([(Transform::default(), animation)])[0];
        let speed = Velocity {
            linear: Vec3::X,
            ..Velocity::default()
        };
        let parts = (Transform::default(), speed, MeshRenderer::default());
        let rider = world.spawn_batch([parts])[0];
        world.set_parent(rider, Some(carrier)).unwrap();
        let mut systems = FrameSystems::default();
        let table = [MeshBounds {
            radius: 1.0,
            half_extents: Vec3::ONE,
            ..MeshBounds::default()
        }];
        systems.run(&mut world, &table, 1.0, 0.5);
        let bounds: WorldBounds = world.get(rider).unwrap();
        assert_eq!(bounds.center(), Vec3::new(0.5, 0.5, 0.0));
        assert_eq!(bounds.radius, 1.0);

        // No time passes: nobody moves, and no row counts as written.
        let seen = world.observe();
        systems.run(&mut world, &table, 1.0, 0.0);
        assert_eq!(world.columns::<Transform>().changed_since(seen).count(), 0);
        assert_eq!(
            world.columns::<WorldBounds>().changed_since(seen).count(),
            0
        );
        let names: Vec<_> = systems.times().map(|system| system.name).collect();
        assert_eq!(names, ["velocity", "animation", "world matrices", "bounds"]);
    }
}
