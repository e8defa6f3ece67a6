//! What is on the screen, as one line of text: scene, pipeline, their parameters, camera, time and size.
//!
//! The editor copies and pastes such lines, `lightbench render --view` draws them and `lightbench compare
//! --view` measures them. `text` has the format.

pub mod moment;
pub mod plan;
mod text;

use lightbench::render::View;
use lightbench::script::{Scene, Settings};
use lightbench::world::glam::{Quat, Vec3};

use crate::ui::workbench::flat::Flat;

pub use text::{MARK, VERSION, ViewpointError};

/// What is on the screen.
#[derive(Clone, Debug, PartialEq)]
pub struct Viewpoint {
    /// Name or path of the scene.
    pub scene: String,
    /// Values for its parameters.
    pub scene_settings: Settings,
    /// Name or path of the pipeline.
    pub pipeline: String,
    /// Values for its parameters.
    pub pipeline_settings: Settings,
    /// From where it is seen.
    pub camera: Eye,
    /// Seconds since the scene began.
    pub time: f64,
    /// Width and height in pixels.
    pub size: (u32, u32),
}

/// From where a scene is seen.
#[derive(Clone, Debug, PartialEq)]
pub enum Eye {
    /// The scene's first active camera.
    Scene,
    /// A camera of the scene, by its name.
    Named(String),
    /// A camera that a person has moved.
    Free(Free),
    /// A view from a side, without perspective.
    Side(Flat),
}

/// A camera without roll.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Free {
    /// Where it is.
    pub eye: Vec3,
    /// Turn about y, radians; 0 looks along −z.
    pub yaw: f32,
    /// Radians above the horizon.
    pub pitch: f32,
    /// Metres to the point about which it orbits.
    pub orbit: f32,
    /// Full vertical angle, radians.
    pub fov_y: f32,
    /// Near plane, metres.
    pub near: f32,
    /// Far plane, metres.
    pub far: f32,
}

impl Free {
    /// From its axes to the world's.
    pub fn rotation(&self) -> Quat {
        Quat::from_rotation_y(self.yaw) * Quat::from_rotation_x(self.pitch)
    }

    /// What it sees.
    pub fn view(&self) -> View {
        let forward = self.rotation() * Vec3::NEG_Z;
        let target = self.eye + forward;
        View::look_at(self.eye, target, self.fov_y, self.near, self.far)
    }
}

impl Eye {
    /// What it sees of a scene as it stands.
    ///
    /// # Errors
    /// A sentence, where the scene has no such camera.
    pub fn view(&self, scene: &mut Scene) -> Result<View, String> {
        scene.refresh();
        match self {
            Self::Scene => Ok(View::from_world(&scene.world).unwrap_or_default()),
            Self::Named(name) => {
                let entity = scene.world.find(name);
                entity
                    .and_then(|entity| View::from_camera(&scene.world, entity))
                    .ok_or_else(|| {
                        format!(
                            "the scene has no camera `{name}`: write camera=scene for its own, or \
                             copy the view again"
                        )
                    })
            }
            Self::Free(free) => Ok(free.view()),
            Self::Side(flat) => Ok(flat.view()),
        }
    }
}

impl Viewpoint {
    /// The values as `lightbench render` takes them with `--set`.
    pub fn sets(&self) -> Vec<String> {
        let owned = |owner: &'static str, settings: &Settings| -> Vec<String> {
            let all = settings.iter();
            all.map(|(name, value)| format!("{owner}.{name}={value}"))
                .collect()
        };
        let mut sets = owned("scene", &self.scene_settings);
        sets.extend(owned("pipeline", &self.pipeline_settings));
        sets
    }
}
