//! Picture metrics: how far a picture is from a reference.
//!
//! Metrics on [`LdrImage`](crate::LdrImage)s see what a display shows, after the tone curve;
//! metrics on [`HdrImage`](crate::HdrImage)s see linear light before it, where a dark estimator
//! can't hide behind the curve. Each says its exact formula, space and constants with
//! [`Metric::definition`]. A picture has R, G, B and A; alpha is never compared.

pub mod colour;
mod definition;
mod distribution;
pub mod flip;
pub mod linear;
mod location;
mod plane;
pub mod srgb;
mod ssim;

pub use definition::Metric;
pub use distribution::{
    DEFAULT_BOUND, HISTOGRAM_BINS, MapStatistics, percentile, weighted_percentile,
};
pub use flip::{FlipOptions, HdrFlip, hdr_flip, ldr_flip};
pub use linear::{LinearErrors, linear_errors};
pub use location::ErrorLocation;
pub use plane::Plane;
pub use srgb::{SrgbErrors, srgb_errors};
pub use ssim::ssim;

/// `serde` form of numbers that may be infinite or undefined, which JSON has no word for.
pub(crate) mod number_or_null {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(crate) fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        value.is_finite().then_some(*value).serialize(serializer)
    }

    /// `null` is read as NaN: "no number".
    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
    }
}

/// As [`number_or_null`], for a PSNR: `null` means equal pictures, an infinite PSNR.
pub(crate) mod infinite_or_null {
    use serde::{Deserialize, Deserializer};

    pub(crate) use super::number_or_null::serialize;

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
    }
}
