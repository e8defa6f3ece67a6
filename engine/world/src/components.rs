//! All components, each declared once.
//!
//! A field reads `name: Type = default, "unit", RANGE;`. To add a component, add
//! it here: columns, insertion, removal, change ticks, files, scripts and the
//! editor follow from the declaration.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_3, PI};

use glam::{Affine2, Affine3A, Quat, Vec2, Vec3};

use crate::component_macro::components;
use crate::entity::Entity;
use crate::reflect::{ANY, POSITIVE};
use crate::value::{MaterialId, MeshId, choice};

choice! {
    /// The kinds of light.
    LightKind {
        /// Shines from a point in all directions.
        Point = "point",
        /// Shines from a point into a cone along −z.
        Spot = "spot",
        /// Shines along −z from infinitely far away.
        Directional = "directional",
        /// Shines from everywhere alike.
        Ambient = "ambient",
    }
}

components! {
    /// Where an entity stands in its parent's space: scaled, then rotated, then
    /// translated.
    #[derive(Copy)]
    transform: Transform, Shown followed by WorldMatrix {
        /// Position of the entity's origin in its parent's space.
        translation: Vec3 = Vec3::ZERO, "m", ANY;
        /// Rotation, a unit quaternion.
        rotation: Quat = Quat::IDENTITY, "", ANY;
        /// Scale along the entity's own axes.
        scale: Vec3 = Vec3::ONE, "", ANY;
    }

    /// From the entity's own space to the world's. Written by
    /// [`update_world_matrices`](crate::systems::update_world_matrices) for
    /// every entity with a Transform, in the same rows.
    #[derive(Copy)]
    world_matrix: WorldMatrix, Computed {
        /// The product of the transforms of all ancestors, outermost first.
        matrix: Affine3A = Affine3A::IDENTITY, "m", ANY;
    }

    /// Where an entity stands on the screen, in its parent's plane: pixels from
    /// the top left corner, x to the right and y down.
    #[derive(Copy)]
    transform_2d: Transform2d, Hidden followed by WorldMatrix2d {
        /// Position of the entity's origin in its parent's plane.
        translation: Vec2 = Vec2::ZERO, "px", ANY;
        /// Clockwise turn.
        rotation: f32 = 0.0, "rad", ANY;
        /// Scale along the entity's own axes.
        scale: Vec2 = Vec2::ONE, "", ANY;
    }

    /// From the entity's own plane to the screen. Written by
    /// [`update_world_matrices`](crate::systems::update_world_matrices) for
    /// every entity with a Transform2d, in the same rows.
    #[derive(Copy)]
    world_matrix_2d: WorldMatrix2d, Computed {
        /// The product of the transforms of all ancestors, outermost first.
        matrix: Affine2 = Affine2::IDENTITY, "px", ANY;
    }

    /// Draws a mesh with a material.
    #[derive(Copy)]
    mesh_renderer: MeshRenderer, Shown followed by WorldBounds {
        /// The mesh to draw.
        mesh: MeshId = MeshId(0), "", ANY;
        /// The material to draw it with.
        material: MaterialId = MaterialId(0), "", ANY;
        /// Whether it is drawn at all.
        visible: bool = true, "", ANY;
    }

    /// A sphere and a box in world space that hold the entity's mesh, with the
    /// same centre. Written by [`update_bounds`](crate::systems::update_bounds)
    /// for every entity with a MeshRenderer, in the same rows. Each number has
    /// an array of its own, so that culling reads nothing else.
    #[derive(Copy)]
    world_bounds: WorldBounds, Computed {
        /// Centre, x.
        x: f32 = 0.0, "m", ANY;
        /// Centre, y.
        y: f32 = 0.0, "m", ANY;
        /// Centre, z.
        z: f32 = 0.0, "m", ANY;
        /// Radius of the sphere.
        radius: f32 = 0.0, "m", POSITIVE;
        /// Half the box's extent along x.
        half_x: f32 = 0.0, "m", POSITIVE;
        /// Half the box's extent along y.
        half_y: f32 = 0.0, "m", POSITIVE;
        /// Half the box's extent along z.
        half_z: f32 = 0.0, "m", POSITIVE;
    }

    /// A source of light. Spot and directional lights shine along −z of their
    /// transform.
    ///
    /// The unit of `intensity` depends on the kind. Point and spot: radiant
    /// intensity in W/sr, which makes the irradiance on a surface that faces the
    /// light from 1 m away equal to it in W/m². Directional: irradiance in W/m²
    /// on a surface that faces the light. Ambient: radiance in W/(m² sr) from
    /// every direction.
    #[derive(Copy)]
    light: Light, Shown {
        /// The kind of light.
        kind: LightKind = LightKind::Point, "", ANY;
        /// Colour in linear Rec. 709; multiplies the intensity.
        color: Vec3 = Vec3::ONE, "", POSITIVE;
        /// Strength; the unit depends on the kind.
        intensity: f32 = 1.0, "W/sr, W/m² or W/(m² sr)", POSITIVE;
        /// Distance at which a point or spot light has faded to nothing.
        range: f32 = 10.0, "m", POSITIVE;
        /// Full angle of the cone within which a spot light is at full strength.
        inner_angle: f32 = FRAC_PI_3 * 0.5, "rad", (0.0, 2.0 * PI);
        /// Full angle of the cone outside which a spot light is dark.
        outer_angle: f32 = FRAC_PI_2 * 0.5, "rad", (0.0, 2.0 * PI);
    }

    /// A perspective camera that looks along −z of its transform, with y up.
    #[derive(Copy)]
    camera: Camera, Shown {
        /// Full vertical angle of view.
        fov_y: f32 = FRAC_PI_3, "rad", (0.001, 3.14);
        /// Distance of the near plane.
        near: f32 = 0.1, "m", (1e-6, f32::INFINITY);
        /// Distance of the far plane; infinity is allowed.
        far: f32 = 1000.0, "m", (1e-6, f32::INFINITY);
        /// Whether the view is drawn from this camera. The first active one wins.
        active: bool = true, "", ANY;
    }

    /// A name by which scripts, files and people find the entity.
    name: Name, Shown {
        /// The name. Several entities may share one.
        text: String = String::new(), "", ANY;
    }

    /// The entity's place in the tree: a list of siblings under each parent.
    /// Written through [`World::set_parent`](crate::World::set_parent).
    #[derive(Copy)]
    family: Family, Computed {
        /// The parent, or none.
        parent: Entity = Entity::NONE, "", ANY;
        /// The first child, or none.
        first_child: Entity = Entity::NONE, "", ANY;
        /// The last child, or none.
        last_child: Entity = Entity::NONE, "", ANY;
        /// The sibling before this one, or none.
        previous: Entity = Entity::NONE, "", ANY;
        /// The sibling after this one, or none.
        next: Entity = Entity::NONE, "", ANY;
    }
}
