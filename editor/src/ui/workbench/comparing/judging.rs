//! Numbers of a pair of pictures: FLIP and pointwise errors, on a thread, from pixels that were read
//! without waiting for them.

use std::sync::Arc;
use std::time::{Duration, Instant};

use lightbench::assets::Task;
use lightbench::lab::LdrImage;
use lightbench::lab::colormap::ColorMap;
use lightbench::lab::diff::{DiffOptions, LdrDifference, diff_ldr};
use lightbench::lab::heatmap::heat_map;
use lightbench::render::Gpu;
use lightbench::render::description::Slice;
use lightbench::render::readback::Reading;

use crate::ui::messages::say;
use crate::ui::workbench::Workbench;

/// How long nothing must move before a pair is judged.
const REST: Duration = Duration::from_millis(300);

/// How often a pair is judged while time runs.
const EVERY: Duration = Duration::from_millis(1000);

/// What is known of one pair.
#[derive(Clone, Debug)]
pub struct Judged {
    /// The numbers, with A as the reference.
    pub difference: LdrDifference,
    /// Width and height of the pictures.
    pub size: (u32, u32),
    /// FLIP of each pixel, painted with magma from 0 to 1.
    painted: Arc<LdrImage>,
    /// Which pair it was.
    pub(super) pair: u64,
}

/// A judgement as it stands beside the picture.
#[derive(Clone, Debug)]
pub struct Judgement<'a> {
    /// What was found.
    pub judged: &'a Judged,
    /// How many frames ago the pictures were on the screen; 0 for those that are.
    pub frames_ago: u64,
}

/// Two pictures on their way.
struct Reads {
    pair: u64,
    size: (u32, u32),
    pictures: [Reading; 2],
}

/// Judges one pair at a time.
#[derive(Default)]
pub(super) struct Judge {
    reads: Option<Reads>,
    task: Option<Task<Result<Judged, String>>>,
    last: Option<Judged>,
    began: Option<Instant>,
    /// The newest pair that was begun with.
    taken: Option<u64>,
    texture: Option<(u64, wgpu::Texture)>,
}

impl Judge {
    pub fn is_busy(&self) -> bool {
        self.reads.is_some() || self.task.is_some()
    }

    pub fn last(&self) -> Option<&Judged> {
        self.last.as_ref()
    }

    /// Forgets all, also what is under way.
    pub fn give_up(&mut self) {
        *self = Self::default();
    }

    /// Begins with a pair, unless another one is under way.
    fn begin(&mut self, gpu: &Gpu, pair: u64, pictures: [&wgpu::Texture; 2], now: Instant) {
        if self.is_busy() || self.taken == Some(pair) {
            return;
        }
        self.taken = Some(pair);
        self.began = Some(now);
        let [a, b] = pictures.map(|picture| Reading::begin(gpu, picture, Slice::default()));
        // Pictures for a display can be read; where the device fails, its own check says so.
        if let (Ok(a), Ok(b)) = (a, b) {
            self.reads = Some(Reads {
                pair,
                size: (pictures[0].width(), pictures[0].height()),
                pictures: [a, b],
            });
        }
    }

    /// Takes in what has come. Returns what went wrong.
    fn poll(&mut self, wake: &crate::ui::workbench::Wake) -> Option<String> {
        if let Some(reads) = self
            .reads
            .take_if(|reads| reads.pictures.iter().all(Reading::is_over))
        {
            match start(&reads, wake) {
                Ok(task) => self.task = Some(task),
                Err(error) => return Some(error),
            }
        }
        let result = match self.task.as_ref()?.poll() {
            Ok(None) => return None,
            Ok(Some(result)) => result,
            Err(lost) => Err(lost.to_string()),
        };
        self.task = None;
        match result {
            Ok(judged) => {
                self.last = Some(judged);
                None
            }
            Err(error) => Some(error),
        }
    }

    /// The map of the last pair as a texture.
    pub fn painted(&mut self, gpu: &Gpu) -> Option<wgpu::Texture> {
        let judged = self.last.as_ref()?;
        if let Some((pair, texture)) = &self.texture
            && *pair == judged.pair
        {
            return Some(texture.clone());
        }
        let texture = upload(gpu, &judged.painted);
        self.texture = Some((judged.pair, texture.clone()));
        Some(texture)
    }
}

fn start(
    reads: &Reads,
    wake: &crate::ui::workbench::Wake,
) -> Result<Task<Result<Judged, String>>, String> {
    let (width, height) = reads.size;
    let image = |reading: &Reading| {
        let bytes = reading.bytes().map_err(|error| error.to_string())?;
        let pixels = bytes.as_chunks::<4>().0.to_vec();
        LdrImage::new(width, height, pixels).map_err(|error| error.to_string())
    };
    let (a, b) = (image(&reads.pictures[0])?, image(&reads.pictures[1])?);
    let (pair, size, wake) = (reads.pair, reads.size, Arc::clone(wake));
    Task::start(move |_| {
        let judged = diff_ldr(&a, &b, DiffOptions::default()).map(|diff| Judged {
            painted: Arc::new(heat_map(&diff.map, ColorMap::Magma, 1.0)),
            difference: diff.difference,
            size,
            pair,
        });
        wake();
        judged.map_err(|error| error.to_string())
    })
    .map_err(|error| say!("comparing.no_thread_to_compare_the_pictures", error = error))
}

fn upload(gpu: &Gpu, picture: &LdrImage) -> wgpu::Texture {
    let size = wgpu::Extent3d {
        width: picture.width,
        height: picture.height,
        depth_or_array_layers: 1,
    };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("map of FLIP"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    gpu.queue.write_texture(
        texture.as_image_copy(),
        picture.pixels.as_flattened(),
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * picture.width),
            rows_per_image: None,
        },
        size,
    );
    texture
}

impl Workbench {
    /// The numbers of the last pair that was judged.
    pub fn judgement(&self) -> Option<Judgement<'_>> {
        let judged = self.comparing.judge.last()?;
        Some(Judgement {
            judged,
            frames_ago: self.comparing.pairs.saturating_sub(judged.pair),
        })
    }

    /// Whether the pair on screen is being judged, or will be once it stands still.
    pub fn judgement_is_coming(&self) -> bool {
        let judge = &self.comparing.judge;
        self.comparing.is_on && (judge.is_busy() || judge.taken != Some(self.comparing.pairs))
    }

    /// How long it is until the pair on screen is to be judged; `None` where it is or can't be. A
    /// picture that is drawn smaller while something moves is not judged.
    pub(super) fn wants_judgement(&self, now: Instant) -> Option<Duration> {
        let comparing = &self.comparing;
        let judge = &comparing.judge;
        let side = comparing.side.as_ref().filter(|_| comparing.is_on)?;
        let size = self.drawn_size()?;
        let fits = side.size == Some(size) && self.drawn_scale() == Some(1.0);
        let fits = fits && !comparing.is_waiting();
        let is_known = judge.taken == Some(comparing.pairs);
        if !fits || !comparing.is_whole || judge.is_busy() || is_known {
            return None;
        }
        let since = |at: Option<Instant>, least: Duration| match at {
            Some(at) => (at + least).saturating_duration_since(now),
            None => Duration::ZERO,
        };
        Some(if self.clock.playing {
            since(judge.began, EVERY)
        } else {
            since(self.moved_at(), REST)
        })
    }

    /// Goes on with the numbers of the pair on screen.
    pub(in crate::ui::workbench) fn judge(&mut self, now: Instant) {
        if !self.comparing.is_on {
            return;
        }
        if let Some(error) = self.comparing.judge.poll(&self.wake) {
            self.log.error(say!(
                "comparing.the_pictures_were_not_compared",
                error = error
            ));
        }
        if self.wants_judgement(now) != Some(Duration::ZERO) {
            return;
        }
        let Some(first) = self.picture().map(|picture| picture.texture) else {
            return;
        };
        let comparing = &mut self.comparing;
        let Some(second) = comparing.side.as_mut().and_then(|side| side.picture()) else {
            return;
        };
        let gpu = self.renderer.gpu();
        let pair = comparing.pairs;
        comparing.judge.begin(gpu, pair, [&first, &second], now);
    }
}
