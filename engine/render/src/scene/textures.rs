//! Material textures in 2D arrays, of which only new textures travel.
//!
//! Not every adapter can index an array of textures, so textures of one size and format are the
//! layers of one texture array, a bucket, and a material holds the number of the bucket and the
//! layer. A texture keeps its layer as long as a scene wants it; when it comes again after that, and
//! no other has taken the layer, it is still there.

use std::collections::{HashMap, HashSet};

use lightbench_assets::{Assets, Shared, Texture, TextureFormat, TextureId};

use super::Uploads;
use super::buckets::{BucketKey, choose};
use super::resample::resample;
use crate::gpu::Gpu;
use crate::gpu_data::{NO_TEXTURE, TEXTURE_BUCKETS};

/// A texture array, and the revision of the texture in each layer.
struct Bucket {
    key: BucketKey,
    texture: wgpu::Texture,
    view: wgpu::TextureView,
    layers: Vec<Option<u64>>,
}

/// All textures on the device.
pub struct TexturePool {
    gpu: Gpu,
    buckets: Vec<Bucket>,
    /// One white texel, for buckets that are not used: every binding needs a texture.
    blank: wgpu::TextureView,
    /// The view of every bucket.
    views: Vec<wgpu::TextureView>,
    slots: Vec<u32>,
    revisions: Option<Vec<u64>>,
    /// Textures of which this scene has been told that they do not fit.
    warned: HashSet<u64>,
}

impl TexturePool {
    /// A pool without textures: every bucket holds one white texel.
    pub fn new(gpu: &Gpu) -> Self {
        let key = BucketKey {
            width: 1,
            height: 1,
            format: TextureFormat::Rgba8Linear,
        };
        let blank = Bucket::new(gpu, key, 1);
        blank.write(gpu, 0, 0, (1, 1), &[255; 4]);
        Self {
            gpu: gpu.clone(),
            buckets: Vec::new(),
            views: vec![blank.view.clone(); TEXTURE_BUCKETS],
            blank: blank.view,
            slots: Vec::new(),
            revisions: None,
            warned: HashSet::new(),
        }
    }

    /// The view of every bucket.
    pub fn views(&self) -> &[wgpu::TextureView] {
        &self.views
    }

    /// Bucket and layer of a texture, as materials hold them.
    pub fn slot(&self, id: TextureId) -> u32 {
        // Texture 0 is the placeholder.
        self.slots
            .get(id.0 as usize)
            .or(self.slots.first())
            .copied()
            .unwrap_or(NO_TEXTURE)
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        let bytes = |bucket: &Bucket| bucket.key.layer_bytes() * bucket.layers.len() as u64;
        self.buckets.iter().map(bytes).sum()
    }

    /// Another scene comes: at the next [`TexturePool::sync`] it is told what does not fit, whether
    /// or not that is on the device already.
    pub fn warn_again(&mut self) {
        self.revisions = None;
        self.warned.clear();
    }

    /// Uploads the textures that are not on the device yet. Returns whether views are new.
    ///
    /// Buckets are chosen from this scene's textures alone, so that nothing depends on the scenes
    /// before.
    pub fn sync(
        &mut self,
        assets: &Assets,
        uploads: &mut Uploads,
        warnings: &mut Vec<String>,
    ) -> bool {
        let revisions = || assets.textures().iter().map(|entry| entry.revision);
        let known = self.revisions.as_ref();
        if known.is_some_and(|known| revisions().eq(known.iter().copied())) {
            return false;
        }
        let mut seen = HashSet::new();
        let distinct: Vec<&Shared<Texture>> = assets
            .textures()
            .iter()
            .filter(|entry| seen.insert(entry.revision))
            .collect();
        let textures: Vec<&Texture> = distinct.iter().map(|entry| &*entry.value).collect();
        let most_layers = self.gpu.device.limits().max_texture_array_layers as usize;
        let (keys, places) = choose(&textures, most_layers);

        let mut before = std::mem::take(&mut self.buckets);
        let mut slots: HashMap<u64, u32> = HashMap::new();
        for (number, key) in keys.into_iter().enumerate() {
            let members: Vec<&Shared<Texture>> = distinct
                .iter()
                .zip(&places)
                .filter_map(|(entry, place)| (*place == Some(number)).then_some(*entry))
                .collect();
            let mut bucket = Bucket::with_room(&self.gpu, key, &members, most_layers, &mut before);
            bucket.fill(&self.gpu, &members, uploads);
            let layers = bucket.layers.iter().enumerate();
            slots.extend(layers.filter_map(|(layer, revision)| {
                let slot = (number as u32) << 16 | layer as u32;
                revision.map(|revision| (revision, slot))
            }));
            self.buckets.push(bucket);
        }
        for (entry, place) in distinct.iter().zip(&places) {
            self.warn(entry, *place, warnings);
        }
        let placeholder = distinct
            .first()
            .and_then(|first| slots.get(&first.revision));
        let placeholder = placeholder.copied().unwrap_or(NO_TEXTURE);
        let slot = |revision| slots.get(&revision).copied().unwrap_or(placeholder);
        self.slots = revisions().map(slot).collect();
        self.revisions = Some(revisions().collect());

        let mut views: Vec<wgpu::TextureView> =
            self.buckets.iter().map(|b| b.view.clone()).collect();
        views.resize(TEXTURE_BUCKETS, self.blank.clone());
        let new = views != self.views;
        self.views = views;
        new
    }

    /// Tells once in each scene of a texture that is not drawn as it is.
    fn warn(&mut self, entry: &Shared<Texture>, place: Option<usize>, warnings: &mut Vec<String>) {
        let texture = &entry.value;
        let (name, width, height) = (&texture.name, texture.width, texture.height);
        let warning = match place {
            Some(number) => {
                let key = self.buckets[number].key;
                if (key.width, key.height) == (width, height) {
                    return;
                }
                format!(
                    "the texture `{name}` is drawn at {} × {} instead of {width} × {height}: a scene has room \
                     for {TEXTURE_BUCKETS} different sizes and formats; make its textures alike",
                    key.width, key.height
                )
            }
            None => format!(
                "the texture `{name}` is drawn as a checker: the device has no room for so many \
                 textures; use fewer"
            ),
        };
        if self.warned.insert(entry.revision) {
            warnings.push(warning);
        }
    }
}

impl Bucket {
    fn new(gpu: &Gpu, key: BucketKey, layers: usize) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("material textures"),
            size: wgpu::Extent3d {
                width: key.width,
                height: key.height,
                depth_or_array_layers: layers as u32,
            },
            mip_level_count: key.mips(),
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: match key.format {
                TextureFormat::Rgba8Srgb => wgpu::TextureFormat::Rgba8UnormSrgb,
                TextureFormat::Rgba8Linear => wgpu::TextureFormat::Rgba8Unorm,
                TextureFormat::Rgba16Float => wgpu::TextureFormat::Rgba16Float,
            },
            usage: wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_DST
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        Self {
            key,
            texture,
            view,
            layers: vec![None; layers],
        }
    }

    /// A bucket that has room for its members: the one of before that holds most of them, if its size
    /// is right, or else a new one to which the device copies what the one of before holds.
    fn with_room(
        gpu: &Gpu,
        key: BucketKey,
        members: &[&Shared<Texture>],
        most_layers: usize,
        before: &mut Vec<Self>,
    ) -> Self {
        let wanted: HashSet<u64> = members.iter().map(|entry| entry.revision).collect();
        let kept = |bucket: &Self| {
            let layers = bucket.layers.iter().flatten();
            layers.filter(|revision| wanted.contains(revision)).count()
        };
        let alike = before.iter().enumerate().filter(|(_, b)| b.key == key);
        let Some((best, _)) = alike.max_by_key(|(_, bucket)| kept(bucket)) else {
            return Self::new(gpu, key, members.len());
        };
        let old = before.swap_remove(best);
        let (room, need) = (old.layers.len(), members.len());
        if need <= room && room <= need.saturating_mul(2) {
            return old;
        }
        // Who adds one texture will add another.
        let new = Self::new(
            gpu,
            key,
            (need + need / 4).clamp(need, most_layers.max(need)),
        );
        new.take_over(gpu, &old, &wanted)
    }

    /// Copies layers from another bucket of the same size and format.
    fn take_over(mut self, gpu: &Gpu, other: &Self, wanted: &HashSet<u64>) -> Self {
        let mut encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let kept = other.layers.iter().enumerate();
        let kept = kept.filter_map(|(from, revision)| Some((from, (*revision)?)));
        let kept = kept.filter(|(_, revision)| wanted.contains(revision));
        for (to, (from, revision)) in kept.enumerate() {
            for level in 0..self.key.mips() {
                encoder.copy_texture_to_texture(
                    place(&other.texture, from, level),
                    place(&self.texture, to, level),
                    extent(self.key.width >> level, self.key.height >> level),
                );
            }
            self.layers[to] = Some(revision);
        }
        gpu.queue.submit([encoder.finish()]);
        self
    }

    /// Uploads the members that are not there to layers that no member has.
    fn fill(&mut self, gpu: &Gpu, members: &[&Shared<Texture>], uploads: &mut Uploads) {
        let wanted: HashSet<u64> = members.iter().map(|entry| entry.revision).collect();
        let there: HashSet<u64> = self.layers.iter().flatten().copied().collect();
        let is_free = |layer: &usize| self.layers[*layer].is_none_or(|old| !wanted.contains(&old));
        let mut free: Vec<usize> = (0..self.layers.len()).filter(is_free).collect();
        // The empty ones first: what was there before may come again.
        free.sort_by_key(|layer| self.layers[*layer].is_some());
        let new = members
            .iter()
            .filter(|entry| !there.contains(&entry.revision));
        for (entry, layer) in new.zip(free) {
            let texture: &Texture = &entry.value;
            let (width, height) = (self.key.width, self.key.height);
            let fitted = match (texture.width, texture.height) == (width, height) {
                true => None,
                false => resample(texture, width, height),
            };
            let source = fitted.as_ref().unwrap_or(texture);
            for (level, bytes) in source.mips.iter().enumerate() {
                self.write(gpu, layer, level as u32, source.level_size(level), bytes);
                uploads.bytes += bytes.len() as u64;
            }
            uploads.textures += 1;
            self.layers[layer] = Some(entry.revision);
        }
    }

    fn write(&self, gpu: &Gpu, layer: usize, level: u32, size: (u32, u32), bytes: &[u8]) {
        let pixel = self.key.format.bytes_per_pixel() as u32;
        gpu.queue.write_texture(
            place(&self.texture, layer, level),
            bytes,
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(size.0 * pixel),
                rows_per_image: None,
            },
            extent(size.0, size.1),
        );
    }
}

fn place(texture: &wgpu::Texture, layer: usize, level: u32) -> wgpu::TexelCopyTextureInfo<'_> {
    wgpu::TexelCopyTextureInfo {
        texture,
        mip_level: level,
        origin: wgpu::Origin3d {
            x: 0,
            y: 0,
            z: layer as u32,
        },
        aspect: wgpu::TextureAspect::All,
    }
}

/// One layer of a level.
fn extent(width: u32, height: u32) -> wgpu::Extent3d {
    wgpu::Extent3d {
        width: width.max(1),
        height: height.max(1),
        depth_or_array_layers: 1,
    }
}
