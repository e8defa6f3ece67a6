//! What a person can make in a scene.

use lightbench_world::{Camera, Entity, Light, LightKind, MeshId, MeshRenderer, Transform};
use rhai::Scope;

use crate::scene::Scene;
use crate::scene::data::Data;
use crate::scene::shapes::Shape;

/// What a person can make in a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NewKind {
    /// Something that has a place and no more, to put others below it.
    Empty,
    /// A box of 1 m.
    Box,
    /// A sphere with a diameter of 1 m.
    Sphere,
    /// An upright cylinder, 1 m wide and high.
    Cylinder,
    /// An upright cone, 1 m wide and high.
    Cone,
    /// A ring, 1 m wide.
    Torus,
    /// A horizontal square of 2 m.
    Plane,
    /// A light that shines in all directions.
    PointLight,
    /// A light that shines into a cone.
    SpotLight,
    /// A light from infinitely far away.
    DirectionalLight,
    /// Light from everywhere alike.
    AmbientLight,
    /// A camera.
    Camera,
}

/// The strength of a new point or spot light, W/sr: it can be seen beside others.
const STRENGTH: f32 = 10.0;

impl NewKind {
    /// All, in the order of menus.
    pub const ALL: [Self; 12] = [
        Self::Empty,
        Self::Box,
        Self::Sphere,
        Self::Cylinder,
        Self::Cone,
        Self::Torus,
        Self::Plane,
        Self::PointLight,
        Self::SpotLight,
        Self::DirectionalLight,
        Self::AmbientLight,
        Self::Camera,
    ];

    /// What new entities of the kind are called.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Empty => "empty",
            Self::Box => "box",
            Self::Sphere => "sphere",
            Self::Cylinder => "cylinder",
            Self::Cone => "cone",
            Self::Torus => "torus",
            Self::Plane => "plane",
            Self::PointLight => "point light",
            Self::SpotLight => "spot light",
            Self::DirectionalLight => "directional light",
            Self::AmbientLight => "ambient light",
            Self::Camera => "camera",
        }
    }

    /// The call that makes its mesh.
    pub(super) fn shape(self) -> Option<&'static str> {
        Some(match self {
            Self::Box => "box(1)",
            Self::Sphere => "sphere(0.5)",
            Self::Cylinder => "cylinder(0.5, 1)",
            Self::Cone => "cone(0.5, 1)",
            Self::Torus => "torus(0.375, 0.125)",
            Self::Plane => "plane(2, 2)",
            Self::Empty
            | Self::PointLight
            | Self::SpotLight
            | Self::DirectionalLight
            | Self::AmbientLight
            | Self::Camera => return None,
        })
    }

    fn light(self) -> Option<Light> {
        let (kind, intensity) = match self {
            Self::PointLight => (LightKind::Point, STRENGTH),
            Self::SpotLight => (LightKind::Spot, STRENGTH),
            Self::DirectionalLight => (LightKind::Directional, 1.0),
            Self::AmbientLight => (LightKind::Ambient, 1.0),
            _ => return None,
        };
        Some(Light {
            kind,
            intensity,
            ..Light::default()
        })
    }

    /// Makes an entity of the kind.
    pub(super) fn make(
        self,
        data: &mut Data,
        meshes: &[MeshId],
        name: &str,
        place: Transform,
    ) -> Result<Entity, String> {
        let entity = data.spawn(name).map_err(|mistake| mistake.message)?;
        let mut done = data.insert(entity, place);
        if let Some(mesh) = self.mesh(meshes) {
            let renderer = MeshRenderer {
                mesh,
                ..MeshRenderer::default()
            };
            done = done.and_then(|()| data.insert(entity, renderer));
        }
        if let Some(light) = self.light() {
            done = done.and_then(|()| data.insert(entity, light));
        }
        if self == Self::Camera {
            done = done.and_then(|()| data.insert(entity, Camera::default()));
        }
        done.map_err(|mistake| mistake.message)?;
        Ok(entity)
    }

    /// Its mesh among those of all kinds that have one.
    pub(super) fn mesh(self, meshes: &[MeshId]) -> Option<MeshId> {
        let mut with_mesh = Self::ALL.into_iter().filter(|kind| kind.shape().is_some());
        let place = with_mesh.position(|kind| kind == self)?;
        meshes.get(place).copied()
    }
}

impl Scene {
    /// The meshes of all kinds that have one. All are made at once and in one order, so that it does
    /// not matter for a file which was needed first. Those that are there already are taken.
    pub(super) fn new_meshes(&mut self) -> Result<Vec<MeshId>, String> {
        self.host.watch.start(self.host.compiler.limits.update_time);
        let mut shapes = Vec::new();
        for call in NewKind::ALL.iter().filter_map(|kind| kind.shape()) {
            let engine = &self.host.engine;
            let made = engine
                .compile_expression(call)
                .map_err(|error| error.to_string())
                .and_then(|ast| {
                    let made = engine.eval_ast_with_scope::<Shape>(&mut Scope::new(), &ast);
                    made.map_err(|error| error.to_string())
                })?;
            shapes.push(made);
        }
        self.on_data(|data| {
            let meshes = shapes.iter().map(|shape| {
                let known = shape.known_mesh(data).map(Ok);
                known.unwrap_or_else(|| shape.mesh(data).map_err(|mistake| mistake.message))
            });
            meshes.collect()
        })
    }
}
