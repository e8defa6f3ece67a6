//! A laboratory of known numbers.

use std::sync::{Arc, Mutex};

use lightbench_render::description::{PassDesc, PassKind, Slice, TargetDesc};
use lightbench_render::inspect::{
    Aspect, FirstInvalid, Invalid, Part, PixelValue, Shown, TexelValue,
};
use lightbench_render::{Format, PipelineDesc, Place, RenderError, TargetImage};

use crate::experiment::{
    Chart, Cost, Laboratory, LaboratoryError, Shot, StudyRow, StudyTask, Task, TimeSpan,
};
use crate::settings::Settings;

/// A laboratory whose frames are made of numbers that the tests know: red is x, green y, blue the
/// pass, alpha the mip level.
#[derive(Clone, Default)]
pub(super) struct Numbers {
    pub(super) asked: Arc<Mutex<Vec<String>>>,
}

impl Numbers {
    fn note(&self, what: String) {
        self.asked.lock().unwrap().push(what);
    }
}

fn settings(settings: &Settings) -> String {
    let all = settings
        .iter()
        .map(|(name, value)| format!("{name}={value}"));
    all.collect::<Vec<_>>().join(" ")
}

impl Laboratory for Numbers {
    fn draw(&mut self, shot: &Shot) -> Result<PipelineDesc, LaboratoryError> {
        self.note(format!(
            "{} [{}] {} [{}] {:?} {}",
            shot.scene,
            settings(&shot.scene_settings),
            shot.pipeline,
            settings(&shot.pipeline_settings),
            shot.size,
            shot.frame
        ));
        let mut desc = PipelineDesc {
            name: shot.pipeline.clone(),
            ..PipelineDesc::default()
        };
        for (name, format) in [("hdr", "rgba16float"), ("ids", "r32uint")] {
            let format = Format::from_name(format).unwrap();
            desc.targets
                .push(TargetDesc::new(name, Place::default(), format));
        }
        for pass in ["g_buffer", "lights"] {
            let mut pass = PassDesc::new(pass, Place::default(), PassKind::Clear);
            for target in ["hdr", "ids"] {
                let clear =
                    lightbench_render::description::ColorAttachment::new(target, Place::default());
                pass.colors.push(clear);
            }
            desc.passes.push(pass);
        }
        Ok(desc)
    }

    fn target(
        &mut self,
        shot: &Shot,
        pass: usize,
        target: &str,
        part: Part,
    ) -> Result<TargetImage, LaboratoryError> {
        self.note(format!("{target} {pass} {part:?}"));
        if part.slice.mip > 2 {
            return Err(RenderError::NoSlice {
                target: target.to_owned(),
                mips: 3,
                layers: 1,
            }
            .into());
        }
        let (width, height) = shot.size;
        let texel = |index: u32| {
            let (x, y) = (index % width, index / width);
            [x as f32, y as f32, pass as f32, part.slice.mip as f32]
        };
        let single = target == "ids";
        Ok(TargetImage {
            width,
            height,
            format: Format::from_name(if single { "r32uint" } else { "rgba16float" }).unwrap(),
            channels: if single { 1 } else { 4 },
            texels: (0..width * height).map(texel).collect(),
        })
    }

    fn pixel(&mut self, _: &Shot, (x, y): (u32, u32)) -> Result<Vec<PixelValue>, LaboratoryError> {
        let value = |pass, before| PixelValue {
            pass,
            target: "ids".to_owned(),
            slice: Slice { mip: 0, layer: 3 },
            sample: None,
            aspect: Aspect::Main,
            channels: 2,
            before,
            after: TexelValue::Uint([x, y, 0, 1]),
        };
        let before = TexelValue::Float([0.5, 0.25, 0.0, 1.0]);
        Ok(vec![value(0, None), value(1, Some(before))])
    }

    fn study(&mut self, task: &StudyTask) -> Result<Vec<StudyRow>, LaboratoryError> {
        let named = |all: &[(String, Settings)]| {
            let all = all
                .iter()
                .map(|(name, values)| format!("{name} [{}]", settings(values)));
            all.collect::<Vec<_>>().join(" ")
        };
        self.note(format!(
            "{}: {} | {} | {:?} | {:?} {:?} {} {}+{} {} {:?} {} {} {}",
            task.title,
            named(&task.scenes),
            named(&task.pipelines),
            task.sweep,
            task.size,
            task.reference,
            task.samples,
            task.warmup,
            task.frames,
            task.start,
            task.step,
            task.processes,
            task.seconds,
            task.out
        ));
        let span = TimeSpan {
            median: 2.0,
            low: 1.0,
            high: 3.0,
        };
        Ok(vec![StudyRow {
            point: vec![("lights".to_owned(), "4".to_owned())],
            pipeline: "mine".to_owned(),
            cost: Cost {
                gpu: Some(span),
                cpu: span,
                draws: 1,
                triangles: 2,
                bytes: 3,
                memory: 4,
                counters: Vec::new(),
            },
            flip: Some(0.25),
            verdict: "faster",
        }])
    }

    fn measure(&mut self, task: &Task) -> Result<Vec<Cost>, LaboratoryError> {
        let pipelines = task.pipelines.iter();
        let names = pipelines.map(|(name, values)| format!("{name} [{}]", settings(values)));
        self.note(format!(
            "{} [{}] {} {:?} {}+{}",
            task.scene,
            settings(&task.scene_settings),
            names.collect::<Vec<_>>().join(" "),
            task.size,
            task.warmup,
            task.frames
        ));
        let lights = task.scene_settings.get("lights").map(ToString::to_string);
        let lights = lights.map_or(1.0, |lights| lights.parse().unwrap());
        let cost = |(index, _)| {
            let median = lights * (index + 1) as f64;
            let span = TimeSpan {
                median,
                low: median - 0.5,
                high: median + 0.5,
            };
            Cost {
                gpu: (index == 0).then_some(span),
                cpu: span,
                draws: 7,
                triangles: 8,
                bytes: 9,
                memory: 10,
                counters: vec![("lost".to_owned(), 2.0)],
            }
        };
        Ok(task.pipelines.iter().enumerate().map(cost).collect())
    }

    fn compare(
        &self,
        reference: &TargetImage,
        image: &TargetImage,
    ) -> Result<Vec<(&'static str, f64)>, LaboratoryError> {
        let first = |image: &TargetImage| f64::from(image.texels[0][2]);
        Ok(vec![("mse", first(image) - first(reference))])
    }

    fn plot(&self, chart: &Chart) -> Vec<u8> {
        format!("{chart:?}").into_bytes()
    }

    fn values(&mut self, shot: &Shot, name: &str) -> Result<Vec<f64>, LaboratoryError> {
        self.note(format!("values {name} {}", shot.frame));
        Ok(vec![1.0, 2.5])
    }

    fn first_invalid(&mut self, shot: &Shot) -> Result<Option<FirstInvalid>, LaboratoryError> {
        let place = Invalid {
            pass: 1,
            target: "hdr".to_owned(),
            slice: Slice::default(),
            sample: None,
            texels: 7,
            first: (5, 2),
        };
        let found = FirstInvalid {
            pass: "lights".to_owned(),
            place,
            value: [f32::NAN, 1.0, 2.0, 1.0],
        };
        Ok((shot.frame == 1).then_some(found))
    }

    fn encode(
        &self,
        path: &str,
        image: &TargetImage,
        shown: Shown,
    ) -> Result<Vec<u8>, LaboratoryError> {
        Ok(format!("{path} {} {shown:?}", image.width).into_bytes())
    }
}
