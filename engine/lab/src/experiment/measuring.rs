//! What experiments measure and compare.

use std::sync::Arc;

use lightbench_assets::color::encode_srgb8;
use lightbench_render::{Format, TargetImage};
use lightbench_script::{Cost, LaboratoryError, Shot, Task, TimeSpan};

use super::{Workbench, lock};
use crate::diff::{DiffOptions, diff_ldr};
use crate::measure::{MeasureError, MeasureOptions, measure};
use crate::metrics::linear_errors;
use crate::report::PipelineResult;
use crate::statistics::Summary;
use crate::{HdrImage, LabError, LdrImage};

impl Workbench {
    /// Measures pipelines on a scene that begins anew.
    pub(super) fn measure_task(&mut self, task: &Task) -> Result<Vec<Cost>, LaboratoryError> {
        self.open()?;
        let shots = task.pipelines.iter().map(|(name, settings)| Shot {
            scene: task.scene.clone(),
            scene_settings: task.scene_settings.clone(),
            pipeline: name.clone(),
            pipeline_settings: settings.clone(),
            size: task.size,
            frame: 0,
        });
        let shots: Vec<Shot> = shots.collect();
        let Some(first) = shots.first() else {
            return Ok(Vec::new());
        };
        let mut scene = self.load_scene(first)?.scene;
        let mut pipelines = Vec::new();
        for shot in &shots {
            pipelines.push(self.build_pipeline(shot)?.pipeline);
        }
        let options = MeasureOptions {
            size: task.size,
            warmup: task.warmup,
            frames: task.frames,
            ..MeasureOptions::default()
        };
        let device = Arc::clone(&self.device);
        let mut device = lock(&device);
        let Some(renderer) = device.as_mut() else {
            return Err(LaboratoryError::Other("no device is open".to_owned()));
        };
        renderer.reset_scene();
        let measured = measure(
            renderer,
            &mut scene,
            &mut pipelines,
            options,
            &self.progress,
        );
        renderer.reset_scene();
        let warnings = renderer.take_warnings();
        self.tell_warnings(warnings);
        let measurement = measured.map_err(|error| match error {
            MeasureError::Render(error) => error.into(),
            MeasureError::Script(problem) => LaboratoryError::Files(problem.into()),
            other => LaboratoryError::Other(other.to_string()),
        })?;
        if measurement.frames < task.frames {
            return Err(LaboratoryError::Other("stopped".to_owned()));
        }
        measurement.pipelines.iter().map(cost).collect()
    }
}

pub(super) fn cost(result: &PipelineResult) -> Result<Cost, LaboratoryError> {
    let cpu = span(&result.frame_cpu_ms);
    let cpu = cpu.ok_or_else(|| LaboratoryError::Other("no frame was measured".to_owned()))?;
    let passes = || result.passes.iter();
    let counters = result.counters.iter();
    Ok(Cost {
        gpu: result.frame_gpu_ms.as_deref().and_then(span),
        cpu,
        draws: passes().map(|pass| pass.draws).sum(),
        triangles: passes().map(|pass| pass.triangles).sum(),
        bytes: passes()
            .map(|pass| pass.bytes_read + pass.bytes_written)
            .sum(),
        memory: result.target_bytes_total,
        counters: counters
            .filter_map(|counter| Some((counter.name.clone(), *counter.values.last()?)))
            .collect(),
    })
}

fn span(samples: &[f64]) -> Option<TimeSpan> {
    let summary = Summary::of(samples)?;
    let interval = summary.median_interval;
    let (low, high) = interval.map_or((summary.min, summary.max), |i| (i.low, i.high));
    Some(TimeSpan {
        median: summary.median,
        low,
        high,
    })
}

/// How far an image is from a reference: as a display shows both, where their format is one of 8 bits,
/// else in linear light.
pub(super) fn compare(
    reference: &TargetImage,
    image: &TargetImage,
) -> Result<Vec<(&'static str, f64)>, LaboratoryError> {
    let other = |error: LabError| LaboratoryError::Other(error.to_string());
    let [eight, linear] = [shown_by_a_display, is_floating]
        .map(|is| [reference, image].iter().all(|image| is(image.format)));
    if eight {
        let [reference, image] = [reference, image].map(as_shown);
        let found = diff_ldr(&reference?, &image?, DiffOptions::default()).map_err(other)?;
        let difference = found.difference;
        return Ok(vec![
            ("mse", difference.srgb.mse),
            ("rmse", difference.srgb.rmse),
            ("psnr", difference.srgb.psnr_db),
            ("ssim", difference.ssim),
            ("flip", difference.flip.mean),
        ]);
    }
    if !linear {
        return Err(LaboratoryError::Other(format!(
            "`{}` and `{}` can't be compared: both must hold 8-bit colours, or both floating-point numbers",
            image.format.name(),
            reference.format.name()
        )));
    }
    let [reference, image] = [reference, image]
        .map(|image| HdrImage::new(image.width, image.height, image.texels.clone()));
    let (reference, image) = (reference.map_err(other)?, image.map_err(other)?);
    let errors = linear_errors(&reference, &image).map_err(other)?;
    Ok(vec![
        ("mse", errors.mse),
        ("rmse", errors.rmse),
        ("relative_mse", errors.rel_mse),
        ("psnr", errors.psnr_db),
        ("smape", errors.smape),
        ("energy_ratio", errors.energy_ratio),
    ])
}

/// Whether a format holds what a display shows.
fn shown_by_a_display(format: Format) -> bool {
    let name = format.name();
    name.starts_with("rgba8unorm") || name.starts_with("bgra8unorm")
}

fn is_floating(format: Format) -> bool {
    let name = format.name();
    name.ends_with("float") && !name.starts_with("depth")
}

/// The bytes that a display gets.
fn as_shown(image: &TargetImage) -> Result<LdrImage, LaboratoryError> {
    // Texels of sRGB formats are read as linear light.
    let srgb = image.format.name().ends_with("-srgb");
    let byte = |value: f32| match srgb {
        true => encode_srgb8(value),
        false => (value.clamp(0.0, 1.0) * 255.0).round() as u8,
    };
    let pixels = image.texels.iter().map(|texel| texel.map(byte)).collect();
    LdrImage::new(image.width, image.height, pixels)
        .map_err(|error| LaboratoryError::Other(error.to_string()))
}
