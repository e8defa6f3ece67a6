//! Which textures lie in one texture array: those of one size and format.

use lightbench_assets::{Texture, TextureFormat};

use crate::gpu_data::TEXTURE_BUCKETS;

/// What the textures of a bucket have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BucketKey {
    /// Pixels across, level 0.
    pub width: u32,
    /// Pixels down, level 0.
    pub height: u32,
    /// What the bytes mean.
    pub format: TextureFormat,
}

impl BucketKey {
    /// Mip levels, down to one pixel.
    pub fn mips(&self) -> u32 {
        32 - self.width.max(self.height).leading_zeros()
    }

    /// Bytes of one texture with all its levels.
    pub fn layer_bytes(&self) -> u64 {
        let side = |size: u32, level: u32| u64::from((size >> level).max(1));
        let pixels = (0..self.mips()).map(|n| side(self.width, n) * side(self.height, n));
        pixels.sum::<u64>() * self.format.bytes_per_pixel() as u64
    }
}

/// Chooses the buckets, and for each texture the number of its bucket; none where all are full.
///
/// The first sizes and formats that turn up get a bucket each. When those are used up, a texture
/// goes to the bucket of its own format with the nearest size; the last buckets are kept for
/// formats that have none yet, so that every format finds one.
pub fn choose(textures: &[&Texture], max_layers: usize) -> (Vec<BucketKey>, Vec<Option<usize>>) {
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
        let chosen = exact.or_else(|| {
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
                return Some(buckets.len() - 1);
            }
            let area = |k: &BucketKey| f64::from(k.width) * f64::from(k.height);
            let distance = |k: &BucketKey| (area(k) / area(&key)).ln().abs();
            let same = buckets
                .iter()
                .enumerate()
                .filter(|(_, (k, used))| k.format == key.format && *used < max_layers);
            same.min_by(|(_, (a, _)), (_, (b, _))| distance(a).total_cmp(&distance(b)))
                .map(|(number, _)| number)
        });
        places.push(chosen);
        if let Some(chosen) = chosen {
            buckets[chosen].1 += 1;
        }
    }
    (buckets.into_iter().map(|(key, _)| key).collect(), places)
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
        let (buckets, places) = choose(&textures.iter().collect::<Vec<_>>(), 256);
        assert!(buckets.len() <= TEXTURE_BUCKETS);
        let places: Vec<usize> = places.into_iter().map(Option::unwrap).collect();
        for (texture, number) in textures.iter().zip(&places) {
            assert_eq!(buckets[*number].format, texture.format);
        }
        assert_eq!(places[9], 1, "the second 8 × 8 texture joins the first");
        // 64, 128 and 256 found no bucket of their own and went to the nearest.
        assert_eq!(buckets[places[6]].width, 32);
    }

    #[test]
    fn a_full_bucket_is_joined_by_another_and_beyond_all_of_them_there_is_no_place() {
        let texture = plain(4, 4, TextureFormat::Rgba8Srgb);
        let textures = vec![&texture; 3 * TEXTURE_BUCKETS];
        let (buckets, places) = choose(&textures, 2);
        // Two are kept for the other formats.
        assert_eq!(buckets.len(), TEXTURE_BUCKETS - 2);
        let expected: Vec<Option<usize>> = (0..textures.len())
            .map(|n| (n < 2 * buckets.len()).then_some(n / 2))
            .collect();
        assert_eq!(places, expected);
    }

    #[test]
    fn a_layer_has_the_bytes_of_all_its_levels() {
        let key = BucketKey {
            width: 5,
            height: 2,
            format: TextureFormat::Rgba8Srgb,
        };
        let texture = plain(5, 2, key.format);
        assert_eq!(key.mips() as usize, texture.mips.len());
        assert_eq!(key.layer_bytes(), texture.byte_count() as u64);
    }
}
