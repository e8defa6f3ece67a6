//! The light at the probed pixel, lamp by lamp.
//!
//! It is computed on the CPU, by the twins of the shaders' formulas, from the scene as it stands: a line
//! of sight through the middle of the pixel finds the surface, with its textures. Pipelines take no part,
//! so that the sum says what they should draw. Shadows are left out. All happens on a thread.

use lightbench::assets::Task;
use lightbench::lab::tracer::{LightAtPixel, Reach, TracedScene};
use lightbench::world::glam::DVec3;
use lightbench::world::{Entity, Light, LightKind, Name};

use super::Workbench;
use crate::ui::messages::say;

/// What one lamp adds to the pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    /// The entity.
    pub entity: Entity,
    /// The entity's name, or which light it is.
    pub name: String,
    /// What kind of light.
    pub kind: &'static str,
    /// Metres from the surface; none for lights without a place.
    pub distance: Option<f64>,
    /// Radiance that it adds.
    pub radiance: DVec3,
}

/// The light at one pixel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lit {
    /// The pixel, and the size of the picture.
    pub pixel: (u32, u32),
    /// Width and height of the picture.
    pub size: (u32, u32),
    /// Whether the line of sight meets a surface.
    pub meets: bool,
    /// Lamps that reach the surface, the one that adds most first.
    pub lamps: Vec<Lamp>,
    /// Lamps that the surface faces away from, that have it outside of their cone, and that are too far
    /// off.
    pub others: [usize; 3],
    /// What the surface emits.
    pub emitted: DVec3,
    /// What shows of the sky.
    pub sky: DVec3,
    /// All of it together.
    pub sum: DVec3,
    /// What of the scene is left out, in sentences.
    pub warnings: Vec<String>,
}

/// What is computed, and what was.
#[derive(Default)]
pub struct Lighting {
    /// Whether each probed pixel's light is computed.
    pub on: bool,
    /// The last result.
    pub last: Option<Lit>,
    task: Option<Task<Lit>>,
    /// The pixel that was asked for while another one was computed.
    next: bool,
}

impl Lighting {
    /// Whether a result is on its way.
    pub fn is_waiting(&self) -> bool {
        self.task.is_some()
    }
}

impl Workbench {
    /// Begins to take the light at the probed pixel apart.
    pub fn light_pixel(&mut self) {
        if self.lighting.task.is_some() {
            self.lighting.next = true;
            return;
        }
        let (Some(pixel), Some(size)) = (self.probing.pixel, self.probing.size) else {
            return;
        };
        let view = self.camera.view();
        let Some(scene) = self.scenes.scene() else {
            return;
        };
        // The thread has a world of its own, since this one goes on.
        let (world, assets, wake) = (scene.world.clone(), scene.assets.clone(), self.wake.clone());
        let task = Task::start(move |_| {
            let traced = TracedScene::new(&world, &assets);
            let found = traced.light_at(&view, size, pixel);
            let lights = world.columns::<Light>();
            let lamp = |row: usize| {
                let entity = lights.entities()[row];
                let name: Option<Name> = world.get(entity);
                let name = name.filter(|name| !name.text.is_empty());
                let name = name.map_or_else(|| format!("light {row}"), |name| name.text);
                (entity, name, kind(lights.row(row).kind))
            };
            let lit = in_order(found, lamp, traced.warnings().to_vec(), pixel, size);
            wake();
            lit
        });
        match task {
            Ok(task) => self.lighting.task = Some(task),
            Err(error) => self
                .log
                .error(say!("lighting.the_light_at_the_pixel_is", error = error)),
        }
    }

    /// Takes in a result.
    pub(super) fn take_lighting(&mut self) {
        let Some(task) = &self.lighting.task else {
            return;
        };
        match task.poll() {
            Ok(None) => return,
            Ok(Some(lit)) => self.lighting.last = Some(lit),
            Err(lost) => self.log.error(lost.to_string()),
        }
        self.lighting.task = None;
        if std::mem::take(&mut self.lighting.next) {
            self.light_pixel();
        }
    }

    /// The light at the pixel that is probed; none while it is of another one.
    pub fn lit(&self) -> Option<&Lit> {
        let probing = &self.probing;
        let is_of = |lit: &&Lit| (Some(lit.pixel), Some(lit.size)) == (probing.pixel, probing.size);
        self.lighting.last.as_ref().filter(is_of)
    }
}

fn kind(kind: LightKind) -> &'static str {
    match kind {
        LightKind::Point => "point",
        LightKind::Spot => "spot",
        LightKind::Directional => "directional",
        LightKind::Ambient => "ambient",
    }
}

fn in_order(
    found: LightAtPixel,
    lamp: impl Fn(usize) -> (Entity, String, &'static str),
    warnings: Vec<String>,
    pixel: (u32, u32),
    size: (u32, u32),
) -> Lit {
    let count = |reach: Reach| {
        let lights = found.lights.iter();
        lights.filter(|light| light.reach == reach).count()
    };
    let reaches = found
        .lights
        .iter()
        .filter(|light| light.reach == Reach::Reaches || light.radiance != DVec3::ZERO);
    let mut lamps: Vec<Lamp> = reaches
        .map(|light| {
            let (entity, name, kind) = lamp(light.row);
            Lamp {
                entity,
                name,
                kind,
                distance: light.distance,
                radiance: light.radiance,
            }
        })
        .collect();
    let luminance = |lamp: &Lamp| lamp.radiance.dot(DVec3::new(0.2126, 0.7152, 0.0722));
    lamps.sort_by(|a, b| luminance(b).total_cmp(&luminance(a)));
    Lit {
        pixel,
        size,
        meets: found.position.is_some(),
        lamps,
        others: [Reach::Behind, Reach::OutsideCone, Reach::BeyondRange].map(count),
        emitted: found.emitted,
        sky: found.sky,
        sum: found.sum,
        warnings,
    }
}
