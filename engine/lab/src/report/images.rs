//! The pictures of a report as PNG files in memory.

use rayon::prelude::*;

use super::model::Comparison;
use crate::{LabError, LdrImage};

/// The PNG files of one pipeline.
pub(super) struct Encoded {
    /// The picture.
    pub picture: Option<Vec<u8>>,
    /// The FLIP heat map.
    pub heat_map: Option<Vec<u8>>,
}

/// Encodes the pictures of all pipelines, in their order.
pub(super) fn encode(comparison: &Comparison) -> Result<Vec<Encoded>, LabError> {
    let png = |image: &Option<LdrImage>| image.as_ref().map(LdrImage::to_png).transpose();
    comparison
        .pipelines
        .par_iter()
        .map(|p| {
            Ok(Encoded {
                picture: png(&p.picture)?,
                heat_map: png(&p.heat_map)?,
            })
        })
        .collect()
}
