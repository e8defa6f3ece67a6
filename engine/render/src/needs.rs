//! What a pipeline needs of an adapter beyond what every adapter has.

use wgpu::{Features, TextureFormatFeatureFlags, TextureUsages};

use crate::description::{Blend, PipelineDesc};

/// The optional features that widen what a format can do.
const FEATURES: [(Features, &str); 3] = [
    (Features::DEPTH32FLOAT_STENCIL8, "depth32float-stencil8"),
    (Features::FLOAT32_BLENDABLE, "float32-blendable"),
    (
        Features::RG11B10UFLOAT_RENDERABLE,
        "rg11b10ufloat-renderable",
    ),
];

impl PipelineDesc {
    /// The optional features of WebGPU that it needs, by their names in the standard: those
    /// without which one of its targets could not be drawn to or blended.
    pub fn features_needed(&self) -> Vec<String> {
        let all = FEATURES
            .iter()
            .fold(Features::empty(), |all, (feature, _)| all | *feature);
        FEATURES
            .iter()
            .filter(|(feature, _)| !self.works_with(all - *feature))
            .map(|(_, name)| (*name).to_owned())
            .collect()
    }

    fn works_with(&self, features: Features) -> bool {
        self.targets.iter().all(|target| {
            let format = target.format.0;
            let offered = format.guaranteed_format_features(features);
            let mut attachments = self.passes.iter().flat_map(|pass| &pass.colors);
            let blended = attachments
                .any(|color| color.target == target.name && color.blend != Blend::Replace);
            features.contains(format.required_features())
                && offered
                    .allowed_usages
                    .contains(TextureUsages::RENDER_ATTACHMENT)
                && (!blended || offered.flags.contains(TextureFormatFeatureFlags::BLENDABLE))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::description::{ColorAttachment, PassDesc, PassKind, TargetDesc};
    use crate::{Format, Place};

    /// One pass that draws to a target of that format.
    fn needs(format: &str, blend: Blend) -> Vec<String> {
        let format = Format::from_name(format).unwrap_or(Format(wgpu::TextureFormat::R8Uint));
        let at = Place::default();
        let desc = PipelineDesc {
            targets: vec![TargetDesc::new("hdr", at.clone(), format)],
            passes: vec![PassDesc {
                colors: vec![ColorAttachment {
                    blend,
                    ..ColorAttachment::new("hdr", at.clone())
                }],
                ..PassDesc::new("light", at.clone(), PassKind::Fullscreen)
            }],
            ..PipelineDesc::default()
        };
        desc.features_needed()
    }

    #[test]
    fn only_what_the_targets_use_is_needed() {
        // The formats that WebGPU guarantees, and its three exceptions.
        assert!(needs("rgba16float", Blend::Add).is_empty());
        assert!(needs("rgba32float", Blend::Replace).is_empty());
        assert_eq!(needs("rgba32float", Blend::Add), ["float32-blendable"]);
        assert_eq!(
            needs("rg11b10ufloat", Blend::Add),
            ["rg11b10ufloat-renderable"]
        );
        assert_eq!(
            needs("depth32float-stencil8", Blend::Replace),
            ["depth32float-stencil8"]
        );
    }
}
