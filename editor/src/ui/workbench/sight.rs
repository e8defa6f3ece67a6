//! What the viewport looks through: the scene's first camera or another one, a camera that a
//! person moves, or none with a perspective.

use lightbench::render::View;
use lightbench::script::Scene;
use lightbench::world::glam::Vec3;
use lightbench::world::{Camera, Entity, Name};

use super::Workbench;
use super::flat::Side;
use super::viewports::Viewport;

/// Half of what is shown from a side of a scene that has nothing in it, metres.
const EMPTY: Vec3 = Vec3::splat(2.0);

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
    /// What the viewport that has the focus looks through now.
    pub fn sight(&self) -> Sight {
        self.sight_of(self.focus())
    }

    /// What a viewport looks through now.
    pub fn sight_of(&self, viewport: Viewport) -> Sight {
        let camera = self.camera_of(viewport);
        if let Some(flat) = camera.flat() {
            return Sight::Side(flat.side);
        }
        if camera.is_moved() {
            return Sight::Perspective;
        }
        let watched = self.watched_camera_of(viewport).clone();
        let name = watched.or_else(|| self.first_camera());
        name.map_or(Sight::Perspective, Sight::Camera)
    }

    /// Whether the viewport that has the focus looks through anything but the scene's first camera.
    pub fn is_camera_away(&self) -> bool {
        let camera = self.camera_of(self.focus());
        let watched = self.watched_camera_of(self.focus());
        camera.is_moved() || camera.flat().is_some() || watched.is_some()
    }

    /// Has the viewport that has the focus look through something else.
    pub fn look_through(&mut self, sight: Sight) {
        self.look_through_in(self.focus(), sight);
    }

    /// Has a viewport look through something else.
    pub fn look_through_in(&mut self, viewport: Viewport, sight: Sight) {
        match sight {
            Sight::Perspective => self.camera_of_mut(viewport).let_go(),
            Sight::Camera(name) => {
                self.watch_camera(viewport, Some(name));
                self.camera_of_mut(viewport).reset();
            }
            Sight::Side(side) => {
                let bounds = self.scene_bounds().unwrap_or((-EMPTY, EMPTY));
                let aspect = self.aspect_of(viewport);
                self.camera_of_mut(viewport).flatten(side, bounds, aspect);
            }
        }
    }

    /// Cameras that nobody has moved go along with those of the scene.
    pub(super) fn follow_camera(&mut self) {
        let Some(scene) = self.scenes.scene_mut() else {
            return;
        };
        scene.refresh();
        let first = View::from_world(&scene.world).unwrap_or_default();
        for viewport in Viewport::ALL {
            let home = self.watched_view(viewport).unwrap_or(first);
            self.camera_of_mut(viewport).follow(home);
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
    pub(super) fn watched_view(&self, viewport: Viewport) -> Option<View> {
        let scene = self.scenes.scene()?;
        let name = self.watched_camera_of(viewport).as_deref()?;
        let entity = scene.world.find(name)?;
        View::from_camera(&scene.world, entity)
    }
}

fn name(scene: &Scene, entity: Entity) -> String {
    let name: Option<Name> = scene.world.get(entity);
    name.map_or_else(String::new, |name| name.text)
}
