//! A plane of scalars and separable filters over it.

use rayon::prelude::*;

/// One `f32` a pixel, rows from top to bottom.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// Width in pixels, at least 1.
    pub width: usize,
    /// Height in pixels, at least 1.
    pub height: usize,
    /// `width · height` values.
    pub values: Vec<f32>,
}

impl Plane {
    /// A plane from a value per pixel index, in parallel.
    pub(crate) fn from_index(
        width: usize,
        height: usize,
        f: impl Fn(usize) -> f32 + Sync + Send,
    ) -> Self {
        let values = (0..width * height).into_par_iter().map(f).collect();
        Self {
            width,
            height,
            values,
        }
    }

    /// `N` planes from `N` values per pixel index, in parallel.
    pub(crate) fn split<const N: usize>(
        width: usize,
        height: usize,
        f: impl Fn(usize) -> [f32; N] + Sync + Send,
    ) -> [Self; N] {
        let pixels: Vec<[f32; N]> = (0..width * height).into_par_iter().map(f).collect();
        std::array::from_fn(|n| {
            let values = pixels.par_iter().map(|pixel| pixel[n]).collect();
            Self {
                width,
                height,
                values,
            }
        })
    }

    /// The value at a pixel.
    pub fn at(&self, x: usize, y: usize) -> f32 {
        self.values[y * self.width + x]
    }

    /// Mean of all values, summed in double precision in a fixed order, so that
    /// the result does not depend on the number of threads.
    pub fn mean(&self) -> f64 {
        let rows: Vec<f64> = self
            .values
            .par_chunks(self.width)
            .map(|row| row.iter().map(|&v| f64::from(v)).sum())
            .collect();
        rows.iter().sum::<f64>() / self.values.len() as f64
    }

    /// Convolves each row with an odd kernel; beyond the border the edge value repeats.
    pub(crate) fn filter_rows(&self, kernel: &[f32]) -> Self {
        let (width, radius) = (self.width, kernel.len() / 2);
        let mut values = vec![0.0; self.values.len()];
        values
            .par_chunks_mut(width)
            .zip(self.values.par_chunks(width))
            .for_each_init(
                || vec![0.0; width + 2 * radius],
                |padded, (out, row)| {
                    padded[..radius].fill(row[0]);
                    padded[radius..radius + width].copy_from_slice(row);
                    padded[radius + width..].fill(row[width - 1]);
                    for (tap, &weight) in kernel.iter().enumerate() {
                        accumulate(out, &padded[tap..tap + width], weight);
                    }
                },
            );
        Self {
            width,
            height: self.height,
            values,
        }
    }

    /// Convolves each column with an odd kernel; beyond the border the edge value repeats.
    pub(crate) fn filter_columns(&self, kernel: &[f32]) -> Self {
        let (width, height, radius) = (self.width, self.height, kernel.len() / 2);
        let mut values = vec![0.0; self.values.len()];
        values
            .par_chunks_mut(width)
            .enumerate()
            .for_each(|(y, out)| {
                for (tap, &weight) in kernel.iter().enumerate() {
                    let row = (y + tap).saturating_sub(radius).min(height - 1);
                    accumulate(out, &self.values[row * width..(row + 1) * width], weight);
                }
            });
        Self {
            width,
            height,
            values,
        }
    }
}

/// `out += weight · source`, the inner loop of every filter; it vectorises.
#[inline]
fn accumulate(out: &mut [f32], source: &[f32], weight: f32) {
    for (o, &s) in out.iter_mut().zip(source) {
        *o += weight * s;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same convolution from its definition, one pixel at a time.
    fn direct(plane: &Plane, kx: &[f32], ky: &[f32], x: usize, y: usize) -> f64 {
        let clamp = |i: usize, tap: usize, r: usize, n: usize| {
            (i as i64 + tap as i64 - r as i64).clamp(0, n as i64 - 1) as usize
        };
        let mut sum = 0.0;
        for (j, wy) in ky.iter().enumerate() {
            for (i, wx) in kx.iter().enumerate() {
                let sx = clamp(x, i, kx.len() / 2, plane.width);
                let sy = clamp(y, j, ky.len() / 2, plane.height);
                sum += f64::from(*wx) * f64::from(*wy) * f64::from(plane.at(sx, sy));
            }
        }
        sum
    }

    #[test]
    fn separable_filter_equals_its_definition() {
        for (width, height) in [(1, 1), (1, 9), (9, 1), (13, 7)] {
            let plane = Plane::from_index(width, height, |i| ((i * 37) % 11) as f32);
            let (kx, ky) = ([0.1, -0.7, 0.3, 0.9, 0.2], [0.5, 0.25, -1.5]);
            let filtered = plane.filter_rows(&kx).filter_columns(&ky);
            for y in 0..height {
                for x in 0..width {
                    let expected = direct(&plane, &kx, &ky, x, y);
                    assert!((f64::from(filtered.at(x, y)) - expected).abs() < 1e-4);
                }
            }
        }
    }

    #[test]
    fn split_gives_each_channel() {
        let [a, b] = Plane::split(3, 2, |i| [i as f32, -(i as f32)]);
        assert_eq!(a.values, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
        assert_eq!(b.at(2, 1), -5.0);
        assert!((a.mean() - 2.5).abs() < 1e-12);
    }
}
