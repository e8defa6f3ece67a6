//! Pictures and targets of the last frame, read back.

use lightbench_assets::files::Files;

use super::{RenderError, Renderer};
use crate::description::Slice;
use crate::inspect::{Aspect, read_any};
use crate::pipeline::Pipeline;
use crate::readback::{TargetImage, read_bytes, read_image};
use crate::targets::Target;

impl Renderer {
    /// The display-ready picture of the last frame, 8 bits a channel, sRGB, rows from the top.
    ///
    /// # Errors
    /// Before the first frame, or when the device failed.
    pub fn read_output(&self, pipeline: &Pipeline) -> Result<(u32, u32, Vec<u8>), RenderError> {
        let name = pipeline
            .desc
            .output
            .as_ref()
            .map_or("output", |output| output.name.as_str());
        let texture = &find(pipeline, name)?.texture;
        Ok((
            texture.width(),
            texture.height(),
            read_bytes(&self.gpu, texture)?,
        ))
    }

    /// The linear HDR picture of the last frame, if the pipeline names one.
    ///
    /// # Errors
    /// As [`Renderer::read_output`].
    pub fn read_hdr(&self, pipeline: &Pipeline) -> Result<Option<TargetImage>, RenderError> {
        match &pipeline.desc.hdr {
            Some(hdr) => self.read_target(pipeline, &hdr.name).map(Some),
            None => Ok(None),
        }
    }

    /// Any target of the last frame, its first layer.
    ///
    /// Targets may share a texture with another, and then hold what that one holds: see
    /// [`Pipeline::keep_all_targets`].
    ///
    /// # Errors
    /// As [`Renderer::read_output`].
    pub fn read_target(&self, pipeline: &Pipeline, name: &str) -> Result<TargetImage, RenderError> {
        self.read_target_slice(pipeline, name, Slice::default())
    }

    /// One mip level of one layer of a target of the last frame.
    ///
    /// # Errors
    /// As [`Renderer::read_output`], and where there is no such level or layer.
    pub fn read_target_slice(
        &self,
        pipeline: &Pipeline,
        name: &str,
        slice: Slice,
    ) -> Result<TargetImage, RenderError> {
        let target = find(pipeline, name)?;
        check_slice(target, slice)?;
        Ok(read_image(&self.gpu, &target.texture, slice)?)
    }

    /// One sample of a mip level and layer of any target of the last frame, or its stencil: also of
    /// targets that [`Renderer::read_target`] can't copy. Its shader comes from `files`.
    ///
    /// # Errors
    /// As [`Renderer::read_target_slice`], and where there is no such sample or no stencil.
    pub fn read_target_any(
        &self,
        pipeline: &Pipeline,
        files: &Files,
        name: &str,
        slice: Slice,
        sample: u32,
        aspect: Aspect,
    ) -> Result<TargetImage, RenderError> {
        let target = find(pipeline, name)?;
        let texture = &target.texture;
        let samples = texture.sample_count();
        if sample >= samples {
            return Err(RenderError::NoSample {
                target: name.to_owned(),
                samples,
            });
        }
        if aspect == Aspect::Stencil && !texture.format().has_stencil_aspect() {
            return Err(RenderError::NoStencil(name.to_owned()));
        }
        check_slice(target, slice)?;
        read_any(&self.gpu, files, target, slice, sample, aspect)
    }
}

fn check_slice(target: &Target, slice: Slice) -> Result<(), RenderError> {
    let mips = target.texture.mip_level_count();
    if slice.mip < mips && slice.layer < target.layers_of_mip(slice.mip) {
        return Ok(());
    }
    Err(RenderError::NoSlice {
        target: target.name.clone(),
        mips,
        layers: target.layers_of_mip(0),
    })
}

fn find<'a>(pipeline: &'a Pipeline, name: &str) -> Result<&'a Target, RenderError> {
    let target = pipeline.targets().and_then(|targets| targets.get(name));
    target.ok_or_else(|| RenderError::NoTarget(name.to_owned()))
}
