//! All components, each declared once.
//!
//! A field reads `name: Type = default, "unit", RANGE;`. To add a component, add
//! it here: columns, insertion, removal, change ticks, files, scripts and the
//! editor follow from the declaration.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_3, PI};

use glam::{Affine2, Affine3A, Quat, Vec2, Vec3};

use crate::component_macro::components;
use crate::curve::Curve;
use crate::entity::Entity;
use crate::reflect::{ANY, POSITIVE};
use crate::value::{MaterialId, MeshId, Parameters, choice};

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

choice! {
    /// What an animation does at its end.
    Repeat {
        /// Stays at the last key.
        Once = "once",
        /// Starts again from the first key.
        Loop = "loop",
        /// Goes back and forth.
        PingPong = "ping_pong",
    }
}

choice! {
    /// Where a text stands in relation to its origin.
    Align {
        /// The origin is at its left end.
        Left = "left",
        /// The origin is in its middle.
        Center = "center",
        /// The origin is at its right end.
        Right = "right",
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
        /// Whether it shines at all.
        visible: bool = true, "", ANY;
    }

    /// A perspective camera that looks along −z of its transform, with y up.
    #[derive(Copy)]
    camera: Camera, Shown {
        /// Full vertical angle of view.
        fov_y: f32 = FRAC_PI_3, "rad", (0.001, PI - 0.001);
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

    /// Moves the entity evenly, in its parent's space.
    #[derive(Copy)]
    velocity: Velocity, Shown {
        /// Change of the translation.
        linear: Vec3 = Vec3::ZERO, "m/s", ANY;
        /// Axis of the turn in the parent's space, as long as the turn is fast.
        angular: Vec3 = Vec3::ZERO, "rad/s", ANY;
    }

    /// Moves the entity along keyframed curves. A curve without keys leaves its
    /// part of the Transform alone.
    rigid_animation: RigidAnimation, Shown {
        /// Translation over time, in metres.
        translation: Curve<Vec3> = Curve::default(), "m", ANY;
        /// Rotation over time.
        rotation: Curve<Quat> = Curve::default(), "", ANY;
        /// Scale over time.
        scale: Curve<Vec3> = Curve::default(), "", ANY;
        /// Time in the curves at the start of the scene.
        offset: f32 = 0.0, "s", ANY;
        /// Time in the curves for each second of the scene; negative runs
        /// backwards.
        speed: f32 = 1.0, "", ANY;
        /// What happens at the end.
        repeat: Repeat = Repeat::Loop, "", ANY;
    }

    /// Runs a script for the entity.
    behaviour: Behaviour, Hidden {
        /// Path of the script within the project.
        script: String = String::new(), "", ANY;
        /// Values that the script gets by name.
        parameters: Parameters = Parameters::default(), "", ANY;
        /// Whether it runs.
        enabled: bool = true, "", ANY;
    }

    /// How a light casts shadows. A light without it casts none.
    #[derive(Copy)]
    shadow: Shadow, Hidden {
        /// Side of the square shadow map.
        resolution: u32 = 1024, "texels", (16.0, 16384.0);
        /// Offset along the light's direction against false shadows.
        depth_bias: f32 = 0.002, "m", POSITIVE;
        /// Offset along the surface's normal, in shadow map texels.
        normal_bias: f32 = 1.0, "texels", POSITIVE;
        /// Distance of the shadow map's near plane.
        near: f32 = 0.05, "m", (1e-6, f32::INFINITY);
        /// Radius of the light's disc, which makes shadows soft.
        source_radius: f32 = 0.0, "m", POSITIVE;
    }

    /// Confines a light to the inside of a closed mesh, so that it does not shine
    /// through walls. Pipelines that draw lights as volumes can do it; the others
    /// say that they can't.
    #[derive(Copy)]
    clip_volume: ClipVolume, Shown {
        /// The mesh; it may have any shape, but no holes.
        mesh: MeshId = MeshId(0), "", ANY;
        /// Position of the mesh in the entity's own space.
        offset: Vec3 = Vec3::ZERO, "m", ANY;
        /// Scale of the mesh along the entity's own axes.
        scale: Vec3 = Vec3::ONE, "", ANY;
    }

    /// Draws a line through points.
    line_renderer: LineRenderer, Hidden {
        /// The points in the entity's own space.
        points: Vec<Vec3> = Vec::new(), "m", ANY;
        /// Colour in linear Rec. 709.
        color: Vec3 = Vec3::ONE, "", POSITIVE;
        /// Width on the screen.
        width: f32 = 1.0, "px", POSITIVE;
    }

    /// Draws text.
    text_renderer: TextRenderer, Hidden {
        /// The text.
        text: String = String::new(), "", ANY;
        /// Height of a line.
        size: f32 = 16.0, "px", POSITIVE;
        /// Colour in linear Rec. 709.
        color: Vec3 = Vec3::ONE, "", POSITIVE;
        /// Where the text stands in relation to its origin.
        align: Align = Align::Left, "", ANY;
    }

    /// Draws a picture that faces the viewer.
    #[derive(Copy)]
    sprite_renderer: SpriteRenderer, Hidden {
        /// The material whose base colour is the picture.
        material: MaterialId = MaterialId(0), "", ANY;
        /// Size on the screen, or in the world for an entity in space.
        size: Vec2 = Vec2::ONE, "px or m", POSITIVE;
        /// Colour in linear Rec. 709; multiplies the picture.
        color: Vec3 = Vec3::ONE, "", POSITIVE;
        /// Sprites of a higher layer cover those of a lower one.
        layer: u32 = 0, "", ANY;
    }

    /// Draws particles.
    #[derive(Copy)]
    particle_renderer: ParticleRenderer, Hidden {
        /// The material of each particle.
        material: MaterialId = MaterialId(0), "", ANY;
        /// Particles that start each second.
        rate: f32 = 50.0, "1/s", POSITIVE;
        /// Life of a particle.
        lifetime: f32 = 2.0, "s", POSITIVE;
        /// Speed at the start, along the entity's y axis.
        speed: f32 = 1.0, "m/s", ANY;
        /// Full angle of the cone in which particles start.
        spread: f32 = 0.5, "rad", (0.0, 2.0 * PI);
        /// Acceleration in world space.
        acceleration: Vec3 = Vec3::new(0.0, -9.81, 0.0), "m/s²", ANY;
        /// Diameter of a particle.
        size: f32 = 0.05, "m", POSITIVE;
        /// Colour in linear Rec. 709.
        color: Vec3 = Vec3::ONE, "", POSITIVE;
        /// Start of the random numbers.
        seed: u32 = 0, "", ANY;
    }

    /// The entity's number in its scene file.
    #[derive(Copy)]
    scene_number: SceneNumber, Hidden {
        /// The number, from 1. Zero stands for none.
        number: u32 = 0, "", ANY;
    }

    /// Components of a scene file that this version does not know, as they stood
    /// there.
    kept_text: KeptText, Hidden {
        /// Lines of the file.
        lines: Vec<String> = Vec::new(), "", ANY;
    }
}
