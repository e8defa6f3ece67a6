//! One picture of a material, a mesh or a texture.

use std::collections::HashSet;

use lightbench::assets::cache::Reuse;
use lightbench::assets::color::encode_srgb8;
use lightbench::assets::files::Files;
use lightbench::assets::images::{Purpose, shared_texture};
use lightbench::assets::{
    AssetCounts, Material, Progress, Shared, Texture, TextureFormat, TextureId,
};
use lightbench::lab::capture::{CaptureError, CaptureOptions, capture};
use lightbench::render::{
    Compiler, Gpu, GpuOptions, Pipeline, PipelineDesc, RenderError, Renderer, Variants,
};
use lightbench::script::{Scene, Settings, load_pipeline, load_scene};
use lightbench::world::glam::Vec3;
use lightbench::world::{Entity, MeshRenderer, Transform, WorldBounds};

use super::Pixels;
use super::order::{Order, Subject, Through};
use crate::ui::messages::say;

/// What is drawn: a ball on a floor.
const SCENE: &str = "scripts/previews/ball.rhai";

/// What of it shows the mesh and the material.
const THING: &str = "thing";

/// Pipelines that are held: that of small pictures, and some through which a material is looked at.
const PIPELINES: usize = 4;

/// How often a pipeline is built for what a frame turned out to need: its meshes, and what passes
/// before them lead to.
const ATTEMPTS: usize = 4;

/// A pipeline with what builds it for more variants.
struct Built {
    through: Through,
    version: u64,
    desc: PipelineDesc,
    compiler: Compiler,
    pipeline: Pipeline,
    variants: Variants,
}

/// The scene of the pictures.
struct Stage {
    scene: Scene,
    /// What it has before something is shown.
    counts: AssetCounts,
    thing: Entity,
    own: MeshRenderer,
    material: Material,
    version: u64,
}

/// A device and what it has drawn with.
pub(super) struct Studio {
    files: Files,
    renderer: Renderer,
    stage: Option<Stage>,
    /// The last one used is at the end.
    built: Vec<Built>,
}

impl Studio {
    pub(super) fn open(files: &Files, gpu: &GpuOptions) -> Result<Self, String> {
        let gpu = Gpu::open(gpu).map_err(|error| error.to_string())?;
        let mut renderer = Renderer::new(gpu);
        renderer.enable_queries(false);
        Ok(Self {
            files: files.clone(),
            renderer,
            stage: None,
            built: Vec::new(),
        })
    }

    pub(super) fn draw(&mut self, order: &Order, version: u64) -> Result<Pixels, String> {
        if let Subject::Texture(texture) = &order.subject {
            return Ok(flat(texture, order.side));
        }
        if let Subject::PictureFile(path) = &order.subject {
            let bytes = self.files.read(path).map_err(|error| error.to_string())?;
            let texture = shared_texture(&Reuse::default(), path, &bytes, Purpose::Color);
            let texture = texture.map_err(|error| error.to_string())?;
            return Ok(flat(&texture, order.side));
        }
        let mut stage = match self.stage.take().filter(|stage| stage.version == version) {
            Some(stage) => stage,
            None => {
                self.renderer.reset_scene();
                Stage::open(&self.files, version)?
            }
        };
        let mut built = self.built(&order.through, version)?;
        if let Subject::ModelFile(path) = &order.subject {
            stage.load(path)?;
        } else {
            stage.show(&order.subject);
        }
        let drawn = self.capture(&mut stage, &mut built, order.side);
        // What a model brings stays in its scene.
        if !matches!(order.subject, Subject::ModelFile(_)) {
            self.stage = Some(stage);
        }
        self.built.push(built);
        drawn
    }

    /// The pipeline, built before or anew.
    fn built(&mut self, through: &Through, version: u64) -> Result<Built, String> {
        self.built.retain(|built| built.version == version);
        let known = self.built.iter().position(|one| one.through == *through);
        if let Some(known) = known {
            return Ok(self.built.remove(known));
        }
        if self.built.len() >= PIPELINES {
            self.built.remove(0);
        }
        // A compiler that has compiled before would not read again what it knows.
        let mut compiler = self.renderer.compiler();
        let desc = load_pipeline(&self.files, &through.pipeline, &through.settings);
        let desc = desc.map_err(|problems| problems.to_string())?;
        let variants = Variants::default();
        let pipeline = compiler
            .compile_for(&self.files, &desc, variants)
            .map_err(|problems| problems.to_string())?;
        Ok(Built {
            through: through.clone(),
            version,
            desc,
            compiler,
            pipeline,
            variants,
        })
    }

    fn capture(
        &mut self,
        stage: &mut Stage,
        built: &mut Built,
        side: u32,
    ) -> Result<Pixels, String> {
        let options = CaptureOptions {
            size: (side, side),
            frame: 0,
        };
        let progress = Progress::new();
        for _ in 0..ATTEMPTS {
            let drawn = capture(
                &mut self.renderer,
                &mut stage.scene,
                &mut built.pipeline,
                options,
                &progress,
            );
            match drawn {
                Ok(drawn) => {
                    let output = drawn.output;
                    return Ok(Pixels {
                        size: [output.width as usize, output.height as usize],
                        rgba: output.pixels.as_flattened().to_vec(),
                    });
                }
                Err(CaptureError::Render(RenderError::NotBuilt(missing))) => {
                    built.variants = built.variants.or(missing);
                    let more = built
                        .compiler
                        .compile_for(&self.files, &built.desc, built.variants);
                    built.pipeline = more.map_err(|problems| problems.to_string())?;
                }
                Err(error) => return Err(error.to_string()),
            }
        }
        Err(say!("assets.more_and_more_shaders").to_owned())
    }
}

impl Stage {
    fn open(files: &Files, version: u64) -> Result<Self, String> {
        let (settings, progress) = (Settings::new(), Progress::new());
        let scene = load_scene(files, SCENE, &settings, &progress);
        let scene = scene.map_err(|problems| problems.to_string())?;
        let thing = scene.world.find(THING);
        let found = thing.and_then(|thing| {
            let own: MeshRenderer = scene.world.get(thing)?;
            let material = scene.assets.material(own.material)?.clone();
            Some((thing, own, material))
        });
        let (thing, own, material) =
            found.ok_or_else(|| say!("assets.no_thing", scene = SCENE, thing = THING))?;
        Ok(Self {
            counts: scene.assets.counts(),
            scene,
            thing,
            own,
            material,
            version,
        })
    }

    /// Puts a model of a file in the place of the thing.
    fn load(&mut self, path: &str) -> Result<(), String> {
        let before: HashSet<Entity> = self.scene.world.entities().collect();
        let loaded = self.scene.evaluate(&format!("load_model({path:?})"));
        loaded.map_err(|problem| problem.message)?;
        let world = &mut self.scene.world;
        world.despawn(self.thing);
        let new: Vec<Entity> = world
            .entities()
            .filter(|entity| !before.contains(entity))
            .collect();
        let boxes = new
            .iter()
            .filter_map(|part| world.get::<WorldBounds>(*part));
        let corners = boxes.map(|own| {
            let (center, half) = (own.center(), own.half_extents());
            (center - half, center + half)
        });
        let whole = corners.reduce(|(low, high), (a, b)| (low.min(a), high.max(b)));
        let (low, high) = whole.unwrap_or_default();
        let place = fitted((low + high) * 0.5, (high - low).length() * 0.5);
        for entity in new {
            if world.parent(entity).is_none() {
                // It was made just now.
                let _placed = world.insert(entity, place);
            }
        }
        Ok(())
    }

    /// Puts something in the place of the thing.
    fn show(&mut self, subject: &Subject) {
        let assets = &mut self.scene.assets;
        assets.truncate(self.counts);
        let mut renderer = self.own;
        let mut place = Transform::default();
        let mut material = self.material.clone();
        match subject {
            Subject::Material {
                material: shown,
                color,
                normals,
            } => {
                let mut add = |texture: &Option<Shared<Texture>>| -> Option<TextureId> {
                    Some(assets.add_shared_texture(texture.clone()?))
                };
                material = Material {
                    base_color_texture: add(color),
                    normal_texture: add(normals),
                    ..(**shown).clone()
                };
            }
            Subject::Mesh(mesh) => {
                renderer.mesh = assets.add_shared_mesh(mesh.clone());
                let bounds = mesh.bounds();
                place = fitted(bounds.center, bounds.radius);
            }
            Subject::Texture(_) | Subject::PictureFile(_) | Subject::ModelFile(_) => {}
        }
        // Both were there when the scene was loaded.
        let _shown = assets.replace_material(self.own.material, material);
        let _drawn = self.scene.world.insert(self.thing, renderer);
        let _placed = self.scene.world.insert(self.thing, place);
    }
}

/// Where a thing of that middle and radius fills the place of the ball, seen a little from above and the
/// side.
fn fitted(center: Vec3, radius: f32) -> Transform {
    let scale = 1.1 / radius.max(f32::MIN_POSITIVE);
    let seen_from = Transform::looking_at(Vec3::ZERO, Vec3::new(0.55, 0.0, -1.0), Vec3::Y);
    Transform {
        translation: seen_from.rotation * (-center * scale),
        rotation: seen_from.rotation,
        scale: Vec3::splat(scale),
    }
}

/// A texture as it is, at about the size of the picture.
fn flat(texture: &Texture, side: u32) -> Pixels {
    let mut level = 0;
    while texture.level_size(level).0.max(texture.level_size(level).1) > side
        && texture.pixel(level + 1, 0, 0).is_some()
    {
        level += 1;
    }
    let (width, height) = texture.level_size(level);
    let mut rgba = Vec::with_capacity(width as usize * height as usize * 4);
    for y in 0..height {
        for x in 0..width {
            let pixel = texture.pixel(level, x, y).unwrap_or_default();
            // Data are shown as the file has them.
            let shown = |value: f32| match texture.format {
                TextureFormat::Rgba8Linear => (value * 255.0 + 0.5) as u8,
                _ => encode_srgb8(value),
            };
            rgba.extend([shown(pixel.x), shown(pixel.y), shown(pixel.z), 255]);
        }
    }
    Pixels {
        size: [width as usize, height as usize],
        rgba,
    }
}
