//! Rows of materials, with the reflection models that a pipeline carries.

use std::fmt;

use lightbench_assets::{Assets, ReflectionModel, ReflectionModels, TextureId};

use super::RowBuffer;
use crate::gpu_data::{MaterialData, NO_TEXTURE};

/// The number of reflection models.
const MODELS: usize = ReflectionModel::ALL.len();

/// How many materials of a scene a pipeline draws with another reflection model than they ask for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ReplacedModels {
    /// By the model that was asked for, then by the one that took its place.
    counts: [[u32; MODELS]; MODELS],
}

impl ReplacedModels {
    /// How many materials.
    pub fn total(&self) -> u32 {
        self.counts.iter().flatten().sum()
    }
}

/// A sentence without its end, as in "3 materials are drawn with another reflection model: 2 of
/// `ggx` as `ward`, 1 of `beckmann` as `ward`".
impl fmt::Display for ReplacedModels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (total, verb) = match self.total() {
            1 => ("1 material".to_owned(), "is"),
            total => (format!("{total} materials"), "are"),
        };
        write!(f, "{total} {verb} drawn with another reflection model")?;
        let mut separator = ": ";
        for wanted in ReflectionModel::ALL {
            for drawn in ReflectionModel::ALL {
                let count = self.counts[wanted as usize][drawn as usize];
                if count > 0 {
                    write!(f, "{separator}{count} of `{wanted}` as `{drawn}`")?;
                    separator = ", ";
                }
            }
        }
        Ok(())
    }
}

/// The table of materials on the GPU.
pub(super) struct MaterialRows {
    pub rows: RowBuffer<MaterialData>,
    /// What it was made of: the assets' revision, and the models that the pipeline carries.
    made_of: Option<(u64, ReflectionModels)>,
    /// Whether a material is drawn with a model beside the default one.
    pub other_models: bool,
    /// What became of models that the pipeline does not carry.
    pub replaced: ReplacedModels,
}

impl MaterialRows {
    pub fn new(rows: RowBuffer<MaterialData>) -> Self {
        Self {
            rows,
            made_of: None,
            other_models: false,
            replaced: ReplacedModels::default(),
        }
    }

    /// Fills the rows anew if the assets have changed, or the models that may be drawn. `slot` gives
    /// a texture's place.
    pub fn sync(
        &mut self,
        assets: &Assets,
        carried: ReflectionModels,
        slot: impl Fn(TextureId) -> u32,
    ) {
        let made_of = Some((assets.revision(), carried));
        if self.made_of == made_of {
            return;
        }
        self.made_of = made_of;
        self.other_models = false;
        self.replaced = ReplacedModels::default();
        let slot = |texture: Option<TextureId>| texture.map_or(NO_TEXTURE, &slot);
        self.rows.replace(assets.materials().iter().map(|entry| {
            let material = &entry.value;
            let reflection = material.reflection.nearest(carried);
            let (wanted, drawn) = (material.reflection.model(), reflection.model());
            self.other_models |= drawn != ReflectionModel::BlinnPhong;
            if drawn != wanted {
                self.replaced.counts[wanted as usize][drawn as usize] += 1;
            }
            MaterialData {
                base_color: material.base_color,
                model: drawn as u32,
                specular: material.specular,
                alpha_cutoff: material.alpha_cutoff.unwrap_or(0.0),
                emissive: material.emissive,
                opacity: material.opacity,
                lobe: reflection.lobe(),
                base_color_texture: slot(material.base_color_texture),
                normal_texture: slot(material.normal_texture),
            }
        }));
    }

    /// Forgets what the rows were made of.
    pub fn forget(&mut self) {
        self.made_of = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sentence_counts_each_replacement() {
        use ReflectionModel::{Beckmann, BlinnPhong, Ggx, Ward};
        let mut replaced = ReplacedModels::default();
        replaced.counts[Ggx as usize][Ward as usize] = 1;
        assert_eq!(
            replaced.to_string(),
            "1 material is drawn with another reflection model: 1 of `ggx` as `ward`"
        );
        replaced.counts[Beckmann as usize][BlinnPhong as usize] = 2;
        assert_eq!(
            replaced.to_string(),
            "3 materials are drawn with another reflection model: 2 of `beckmann` as \
             `blinn_phong`, 1 of `ggx` as `ward`"
        );
    }
}
