//! Pictures of materials, meshes and textures: drawn by a thread with a device of its own, so that the
//! editor waits for none of them.
//!
//! There are small ones, made one after the other while nobody works, and one large one of the material
//! that is edited, which goes before them and follows each change.

mod draw;
mod order;
mod worker;

use std::collections::BTreeMap;

use egui::{ColorImage, Context, TextureHandle, TextureOptions};
use lightbench::assets::files::Files;
use lightbench::render::GpuOptions;

pub use order::{Order, Subject, Through};
use worker::Worker;

use super::workbench::Wake;

/// How files with pictures end.
pub const PICTURES: [&str; 7] = ["png", "jpg", "jpeg", "tga", "bmp", "hdr", "exr"];

/// How files with models end.
pub const MODELS: [&str; 3] = ["obj", "gltf", "glb"];

/// Small pictures that are held; beyond that all are forgotten, and those in sight asked for again.
const MOST: usize = 600;

/// Pixels of a picture: width, height, RGBA in sRGB.
pub struct Pixels {
    size: [usize; 2],
    rgba: Vec<u8>,
}

/// What is known of a small picture.
pub enum State {
    /// It will be drawn.
    Waiting,
    /// It was drawn and goes to the device when it is shown.
    Drawn(Pixels),
    /// It is there.
    There(TextureHandle),
    /// Why there is none.
    None(String),
}

/// The large picture.
#[derive(Default)]
struct Large {
    /// What was asked for last.
    asked: Option<String>,
    /// What the picture shows.
    shown: Option<String>,
    texture: Option<TextureHandle>,
    problem: Option<String>,
    drawn: Option<(String, Result<Pixels, String>)>,
    /// How often it was drawn.
    count: u64,
}

/// The large picture as it is now.
pub struct Preview<'a> {
    /// The last one, which may be of a state before this one.
    pub texture: Option<&'a TextureHandle>,
    /// Whether it shows what was asked for.
    pub is_current: bool,
    /// Why there is no newer one.
    pub problem: Option<&'a str>,
}

/// All pictures that were asked for.
#[derive(Default)]
pub struct Pictures {
    states: BTreeMap<String, State>,
    large: Large,
    queue: Vec<Order>,
    wanted: Option<Order>,
    worker: Option<Worker>,
    /// Counts changes of files from which pictures may be made.
    version: u64,
}

impl Pictures {
    /// The small picture of something; one that is not there yet is asked for.
    pub fn small(&mut self, ctx: &Context, order: Order) -> &State {
        if self.states.len() > MOST {
            self.states.clear();
        }
        let key = order.key(self.version);
        let queue = &mut self.queue;
        let state = self.states.entry(key.clone()).or_insert_with(|| {
            queue.push(order);
            State::Waiting
        });
        if let State::Drawn(pixels) = state {
            *state = State::There(load(ctx, &key, pixels));
        }
        state
    }

    /// The large picture of something, which is drawn anew where it differs from what was asked for
    /// last.
    pub fn large(&mut self, ctx: &Context, order: Order) -> Preview<'_> {
        let key = order.key(self.version);
        if self.large.asked.as_ref() != Some(&key) {
            self.large.asked = Some(key.clone());
            self.wanted = Some(order);
        }
        let large = &mut self.large;
        if let Some((of, drawn)) = large.drawn.take() {
            match drawn {
                Ok(pixels) => {
                    large.texture = Some(load(ctx, "preview", &pixels));
                    large.problem = None;
                    large.count += 1;
                }
                Err(why) => large.problem = Some(why),
            }
            large.shown = Some(of);
        }
        Preview {
            texture: large.texture.as_ref(),
            is_current: large.shown == large.asked,
            problem: large.problem.as_deref(),
        }
    }

    /// How often the large picture was drawn.
    pub fn drawn(&self) -> u64 {
        self.large.count
    }

    /// Whether pictures are missing that will come.
    pub fn is_busy(&self) -> bool {
        let waits = |state: &State| matches!(state, State::Waiting);
        self.large.shown != self.large.asked || self.states.values().any(waits)
    }

    /// Asks for all pictures again, as for another device, on which they are lost.
    pub fn forget(&mut self) {
        self.states.clear();
        self.large = Large::default();
    }

    /// Files have changed: pictures that are made from such are drawn anew.
    pub fn files_changed(&mut self, paths: &[String]) {
        let shows = |path: &String| {
            let folders = ["shaders/", "scripts/pipelines", "scripts/previews"];
            folders.iter().any(|folder| path.starts_with(folder))
        };
        // What the editor itself writes all the time is none of it.
        let own = |path: &String| path.starts_with("notebook/") || path.starts_with("reports/");
        let is_read = |path: &String| {
            let ending = path.rsplit_once('.').map_or("", |(_, ending)| ending);
            PICTURES
                .iter()
                .chain(&MODELS)
                .any(|known| ending.eq_ignore_ascii_case(known))
                || ["mtl", "bin"].contains(&ending)
        };
        let counts = |path: &String| shows(path) || (is_read(path) && !own(path));
        self.version += u64::from(paths.iter().any(counts));
    }

    /// Somebody works: no small picture is drawn for a moment.
    pub fn hold(&self) {
        if let Some(worker) = &self.worker {
            worker.hold();
        }
    }

    /// Hands out what was asked for and takes in what was drawn. Returns whether something was.
    pub fn tend(&mut self, files: &Files, gpu: &GpuOptions, wake: &Wake) -> bool {
        if let Some(worker) = &self.worker
            && !worker.is_for(files)
        {
            self.worker = None;
            self.forget();
            self.queue.clear();
            self.wanted = None;
        }
        if self.queue.is_empty() && self.wanted.is_none() && self.worker.is_none() {
            return false;
        }
        let worker = self
            .worker
            .get_or_insert_with(|| Worker::start(files.clone(), gpu.clone(), wake.clone()));
        worker.order(self.version, self.queue.drain(..), self.wanted.take());
        let mut came = false;
        for answer in worker.answers() {
            came = true;
            match (answer.is_large, answer.pixels) {
                (true, pixels) => self.large.drawn = Some((answer.key, pixels)),
                (false, Ok(pixels)) => _ = self.states.insert(answer.key, State::Drawn(pixels)),
                (false, Err(why)) => _ = self.states.insert(answer.key, State::None(why)),
            }
        }
        came
    }
}

fn load(ctx: &Context, name: &str, pixels: &Pixels) -> TextureHandle {
    let image = ColorImage::from_rgba_unmultiplied(pixels.size, &pixels.rgba);
    ctx.load_texture(name, image, TextureOptions::LINEAR)
}
