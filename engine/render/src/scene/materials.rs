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
    /// The models that it was made for; none if the assets have changed since.
    made_for: Option<ReflectionModels>,
    made: Vec<MaterialData>,
    /// What became of models that the pipeline does not carry.
    pub replaced: ReplacedModels,
}

impl MaterialRows {
    pub fn new(rows: RowBuffer<MaterialData>) -> Self {
        Self {
            rows,
            made_for: None,
            made: Vec::new(),
            replaced: ReplacedModels::default(),
        }
    }

    /// Makes the rows anew if they were forgotten, or if other models may be drawn; those that are
    /// the same as before do not travel. `slot` gives a texture's place.
    pub fn sync(
        &mut self,
        assets: &Assets,
        carried: ReflectionModels,
        slot: impl Fn(TextureId) -> u32,
    ) {
        if self.made_for == Some(carried) {
            return;
        }
        self.made_for = Some(carried);
        self.made.clear();
        self.replaced = ReplacedModels::default();
        let slot = |texture: Option<TextureId>| texture.map_or(NO_TEXTURE, &slot);
        self.made.extend(assets.materials().iter().map(|entry| {
            let material = &entry.value;
            let reflection = material.reflection.nearest(carried);
            let (wanted, drawn) = (material.reflection.model(), reflection.model());
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
        self.rows.replace_if_changed(&self.made);
    }

    /// Forgets what the rows were made for, since the assets have changed.
    pub fn forget(&mut self) {
        self.made_for = None;
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
