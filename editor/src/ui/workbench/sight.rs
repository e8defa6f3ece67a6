//! What the viewport looks through: the scene's first camera or another one, a camera that a
//! person moves, or none with a perspective.

use lightbench::render::View;
use lightbench::script::Scene;
use lightbench::world::{Camera, Entity, Name};

use super::Workbench;
use super::flat::Side;

/// What the viewport looks through.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sight {
    /// A perspective that a person moves.
    Perspective,
    /// A camera of the scene, by its name.
    Camera(String),
    /// An orthographic view.
    Side(Side),
}

impl Workbench {
    /// What the viewport looks through now.
    pub fn sight(&self) -> Sight {
        if let Some(flat) = self.camera.flat() {
            return Sight::Side(flat.side);
        }
        if self.camera.is_moved() {
            return Sight::Perspective;
        }
        let name = self.watched_camera.clone().or_else(|| self.first_camera());
        name.map_or(Sight::Perspective, Sight::Camera)
    }

    /// Whether the viewport looks through anything but the scene's first camera.
    pub fn is_camera_away(&self) -> bool {
        self.camera.is_moved() || self.camera.flat().is_some() || self.watched_camera.is_some()
    }

    /// Looks through something else.
    pub fn look_through(&mut self, sight: Sight) {
        match sight {
            Sight::Perspective => self.camera.let_go(),
            Sight::Camera(name) => {
                self.watched_camera = Some(name);
                self.camera.reset();
            }
            Sight::Side(side) => {
                if let Some((min, max)) = self.scene_bounds() {
                    self.camera.flatten(side, min, max);
                }
            }
        }
    }

    /// The names of the scene's cameras.
    pub fn cameras(&self) -> Vec<String> {
        let Some(scene) = self.scenes.scene() else {
            return Vec::new();
        };
        let cameras = scene.world.columns::<Camera>();
        let names = cameras.entities().iter().map(|camera| name(scene, *camera));
        names.filter(|name| !name.is_empty()).collect()
    }

    /// The name of the camera through which the scene is drawn.
    fn first_camera(&self) -> Option<String> {
        let scene = self.scenes.scene()?;
        let cameras = scene.world.columns::<Camera>();
        let mut all = cameras.entities().iter().enumerate();
        let first = all.find(|(row, _)| cameras.row(*row).active)?;
        Some(name(scene, *first.1))
    }

    /// The view of the camera that a person has chosen, while it is there.
    pub(super) fn watched_view(&self) -> Option<View> {
        let scene = self.scenes.scene()?;
        let entity = scene.world.find(self.watched_camera.as_deref()?)?;
        View::from_camera(&scene.world, entity)
    }
}

fn name(scene: &Scene, entity: Entity) -> String {
    let name: Option<Name> = scene.world.get(entity);
    name.map_or_else(String::new, |name| name.text)
}
