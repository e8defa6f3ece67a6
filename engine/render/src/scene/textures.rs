//! Material textures in 2D arrays, bucketed by size and format.
//!
//! Not every adapter can index an array of textures, so textures of one size and format are the
//! layers of one texture array, and a material holds the number of the array and the layer.

use lightbench_assets::{Assets, Texture, TextureFormat, TextureId};

use crate::gpu::Gpu;
use crate::gpu_data::TEXTURE_BUCKETS;

/// What the textures of a bucket have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct BucketKey {
    width: u32,
    height: u32,
    format: TextureFormat,
}

/// All textures on the device.
pub struct TexturePool {
    gpu: Gpu,
    views: Vec<wgpu::TextureView>,
    slots: Vec<u32>,
    revisions: Option<Vec<u64>>,
    bytes: u64,
}

impl TexturePool {
    /// A pool without textures: every bucket holds one white texel.
    pub fn new(gpu: &Gpu) -> Self {
        let mut pool = Self {
            gpu: gpu.clone(),
            views: Vec::new(),
            slots: Vec::new(),
            revisions: None,
            bytes: 0,
        };
        pool.fill_up();
        pool
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
            .unwrap_or(crate::gpu_data::NO_TEXTURE)
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Uploads again at the next [`TexturePool::sync`].
    pub fn forget(&mut self) {
        self.revisions = None;
    }

    /// Uploads all textures if any changed. Returns whether the views are new.
    pub fn sync(&mut self, assets: &Assets, warnings: &mut Vec<String>) -> bool {
        let revisions: Vec<u64> = assets
            .textures()
            .iter()
            .map(|entry| entry.revision)
            .collect();
        if self.revisions.as_ref() == Some(&revisions) {
            return false;
        }
        let textures: Vec<&Texture> = assets
            .textures()
            .iter()
            .map(|entry| &*entry.value)
            .collect();
        let layers = self.gpu.device.limits().max_texture_array_layers as usize;
        let (buckets, places) = bucket(&textures, layers);
        self.views.clear();
        self.bytes = 0;
        for (number, key) in buckets.iter().enumerate() {
            let members: Vec<&Texture> = textures
                .iter()
                .zip(&places)
                .filter(|(_, (bucket, _))| *bucket == number)
                .map(|(texture, _)| *texture)
                .collect();
            self.upload(*key, &members, warnings);
        }
        self.slots = places
            .iter()
            .map(|(bucket, layer)| (*bucket as u32) << 16 | *layer as u32)
            .collect();
        self.fill_up();
        self.revisions = Some(revisions);
        true
    }

    /// Gives the unused buckets a texel, since every binding needs a texture.
    fn fill_up(&mut self) {
        while self.views.len() < TEXTURE_BUCKETS {
            let key = BucketKey {
                width: 1,
                height: 1,
                format: TextureFormat::Rgba8Linear,
            };
            let (texture, view) = self.create(key, 1, 1);
            self.write(&texture, 0, 0, (1, 1), 4, &[255; 4]);
            self.views.push(view);
        }
    }

    fn create(
        &mut self,
        key: BucketKey,
        layers: u32,
        mips: u32,
    ) -> (wgpu::Texture, wgpu::TextureView) {
        let texture = self.gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("material textures"),
            size: wgpu::Extent3d {
                width: key.width,
                height: key.height,
                depth_or_array_layers: layers,
            },
            mip_level_count: mips,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: match key.format {
                TextureFormat::Rgba8Srgb => wgpu::TextureFormat::Rgba8UnormSrgb,
                TextureFormat::Rgba8Linear => wgpu::TextureFormat::Rgba8Unorm,
                TextureFormat::Rgba16Float => wgpu::TextureFormat::Rgba16Float,
            },
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        (texture, view)
    }

    fn upload(&mut self, key: BucketKey, members: &[&Texture], warnings: &mut Vec<String>) {
        let mips = 32 - key.width.max(key.height).leading_zeros();
        let (texture, view) = self.create(key, members.len().max(1) as u32, mips);
        let pixel = key.format.bytes_per_pixel() as u32;
        for (layer, member) in members.iter().enumerate() {
            let fitted;
            let source = if (member.width, member.height) == (key.width, key.height) {
                *member
            } else {
                warnings.push(format!(
                    "the texture `{}` is drawn at {} × {} instead of {} × {}: a scene has room for {} different \
                     sizes and formats; make its textures alike",
                    member.name, key.width, key.height, member.width, member.height, TEXTURE_BUCKETS
                ));
                fitted = resample(member, key.width, key.height);
                fitted.as_ref().unwrap_or(member)
            };
            for (level, bytes) in source.mips.iter().enumerate().take(mips as usize) {
                let size = source.level_size(level);
                self.write(&texture, layer as u32, level as u32, size, pixel, bytes);
                self.bytes += bytes.len() as u64;
            }
        }
        self.views.push(view);
    }

    fn write(
        &self,
        texture: &wgpu::Texture,
        layer: u32,
        level: u32,
        size: (u32, u32),
        pixel: u32,
        bytes: &[u8],
    ) {
        self.gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                texture,
                mip_level: level,
                origin: wgpu::Origin3d {
                    x: 0,
                    y: 0,
                    z: layer,
                },
                aspect: wgpu::TextureAspect::All,
            },
            bytes,
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(size.0 * pixel),
                rows_per_image: None,
            },
            wgpu::Extent3d {
                width: size.0,
                height: size.1,
                depth_or_array_layers: 1,
            },
        );
    }
}

/// Chooses the buckets and gives each texture a bucket and a layer.
///
/// The first sizes and formats that turn up get a bucket each. When those are used up, a texture
/// goes to the bucket of its own format with the nearest size; the last buckets are kept for
/// formats that have none yet, so that every format finds one.
fn bucket(textures: &[&Texture], max_layers: usize) -> (Vec<BucketKey>, Vec<(usize, usize)>) {
    let mut buckets: Vec<(BucketKey, usize)> = Vec::new();
    let mut places = Vec::with_capacity(textures.len());
    for texture in textures {
        let key = BucketKey {
            width: texture.width,
            height: texture.height,
            format: texture.format,
        };
        let exact = buckets
            .iter()
            .position(|(other, used)| *other == key && *used < max_layers);
        let chosen = exact.unwrap_or_else(|| {
            let has = |format| buckets.iter().any(|(other, _)| other.format == format);
            let formats = [
                TextureFormat::Rgba8Srgb,
                TextureFormat::Rgba8Linear,
                TextureFormat::Rgba16Float,
            ];
            let reserved = formats
                .into_iter()
                .filter(|&f| f != key.format && !has(f))
                .count();
            if buckets.len() + reserved < TEXTURE_BUCKETS {
                buckets.push((key, 0));
                return buckets.len() - 1;
            }
            let area = |k: &BucketKey| f64::from(k.width) * f64::from(k.height);
            let distance = |k: &BucketKey| (area(k) / area(&key)).ln().abs();
            let same = buckets
                .iter()
                .enumerate()
                .filter(|(_, (k, used))| k.format == key.format && *used < max_layers);
            same.min_by(|(_, (a, _)), (_, (b, _))| distance(a).total_cmp(&distance(b)))
                .map_or(0, |(i, _)| i)
        });
        places.push((chosen, buckets[chosen].1));
        buckets[chosen].1 += 1;
    }
    (buckets.into_iter().map(|(key, _)| key).collect(), places)
}

/// A texture at another size: bilinear, from the level whose size is just above.
fn resample(texture: &Texture, width: u32, height: u32) -> Option<Texture> {
    let fits = |level: &usize| {
        let (w, h) = texture.level_size(*level);
        w >= width && h >= height
    };
    let level = (0..texture.mips.len()).rev().find(fits).unwrap_or(0);
    let (from_width, from_height) = texture.level_size(level);
    let texel = |x: i64, y: i64| {
        // Materials repeat, so the texel beyond the edge is the one on the other side.
        let x = x.rem_euclid(i64::from(from_width)) as u32;
        let y = y.rem_euclid(i64::from(from_height)) as u32;
        texture.pixel(level, x, y).unwrap_or_default()
    };
    let mut pixels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        for x in 0..width {
            let u = (x as f32 + 0.5) / width as f32 * from_width as f32 - 0.5;
            let v = (y as f32 + 0.5) / height as f32 * from_height as f32 - 0.5;
            let (left, top) = (u.floor(), v.floor());
            let (s, t) = (u - left, v - top);
            let (left, top) = (left as i64, top as i64);
            let upper = texel(left, top).lerp(texel(left + 1, top), s);
            let lower = texel(left, top + 1).lerp(texel(left + 1, top + 1), s);
            pixels.push(upper.lerp(lower, t));
        }
    }
    Texture::from_linear(
        texture.name.as_str(),
        width,
        height,
        texture.format,
        &pixels,
    )
    .ok()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use glam::Vec4;

    fn plain(width: u32, height: u32, format: TextureFormat) -> Texture {
        let pixels = vec![Vec4::new(0.5, 0.25, 1.0, 1.0); (width * height) as usize];
        Texture::from_linear("plain", width, height, format, &pixels).unwrap()
    }

    #[test]
    fn textures_of_one_size_share_a_bucket_and_every_format_finds_one() {
        use TextureFormat::{Rgba8Linear, Rgba8Srgb, Rgba16Float};
        let sizes = [4, 8, 16, 32, 64, 128, 256];
        let mut textures: Vec<Texture> = sizes.iter().map(|&s| plain(s, s, Rgba8Srgb)).collect();
        textures.push(plain(8, 8, Rgba8Linear));
        textures.push(plain(8, 8, Rgba16Float));
        textures.push(plain(8, 8, Rgba8Srgb));
        let (buckets, places) = bucket(&textures.iter().collect::<Vec<_>>(), 256);
        assert!(buckets.len() <= TEXTURE_BUCKETS);
        for (texture, (number, _)) in textures.iter().zip(&places) {
            assert_eq!(buckets[*number].format, texture.format);
        }
        assert_eq!(
            places[9],
            (1, 1),
            "the second 8 × 8 texture is layer 1 of the first one's bucket"
        );
        // 64, 128 and 256 found no bucket of their own and went to the nearest.
        assert_eq!(buckets[places[6].0].width, 32);
        let mut slots = places.clone();
        slots.sort_unstable();
        slots.dedup();
        assert_eq!(slots.len(), textures.len(), "no two textures share a layer");
    }

    #[test]
    fn resampling_keeps_a_plain_colour_and_the_mean_of_a_ramp() {
        let texture = plain(5, 3, TextureFormat::Rgba16Float);
        let fitted = resample(&texture, 8, 8).unwrap();
        let pixel = fitted.pixel(0, 7, 3).unwrap();
        assert!((pixel - Vec4::new(0.5, 0.25, 1.0, 1.0)).length() < 1e-3);
    }
}
