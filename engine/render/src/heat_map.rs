//! Heat maps: a pipeline changed so that its picture shows how much work each pixel made.
//!
//! Lights are counted by the pipeline's own passes, in which each light adds 1 in place of its
//! radiance (see `shaders/lib/lighting.wgsl`), so the count is of what the pipeline does and not of
//! what it should do. Fragments are counted by a twin of each geometry pass, which runs before it and
//! adds 1 to a target of counts in place of what the pass writes (see `fragment_counts`).

use std::collections::BTreeSet;

use crate::description::{
    Blend, ColorAttachment, Define, DrawList, Load, Named, Parameter, ParameterKind,
    ParameterValue, PassDesc, PassKind, PipelineDesc, Read, ShaderDesc, Shape, Slice, StencilClear,
    TargetDesc, TargetSize,
};
use crate::format::Format;
use crate::fragment_counts::COUNT_FRAGMENTS;
use crate::life;
use crate::problem::{Place, Problem};

/// The parameter that every pipeline has: which heat map takes the place of the picture.
pub const PARAMETER: &str = "heat_map";
/// Another that every pipeline has: the count that a heat map shows brightest.
pub const MOST: &str = "heat_map_most";

/// The define that makes shaders count lights; its value says which.
const COUNT_LIGHTS: &str = "COUNT_LIGHTS";
const PICTURE: &str = "heat_map_picture";
const OVERDRAW: &str = "heat_map_overdraw";
const SHOW_SHADER: &str = "shaders/heat_map/show.wgsl";
const ADD_SHADER: &str = "shaders/heat_map/add_counts.wgsl";

/// What a heat map counts in each pixel. Half floats hold the counts: exactly up to 2048.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeatMap {
    /// Fragments that geometry passes shade and keep: those of opaque and transparent objects that
    /// pass the depth test, in all passes that write colours. 1 is a pixel shaded once.
    Overdraw,
    /// Lights evaluated for the opaque surface that the pixel shows, ambient and directional ones
    /// included. In a tiled pipeline that is the length of the tile's list, in a clustered one of
    /// the cluster's.
    LightsEvaluated,
    /// Those of them in whose range and cone the surface lies.
    LightsReaching,
    /// Those of them that do not reach it: what a tighter culling would save.
    LightsInVain,
}

impl HeatMap {
    /// The names of the values of the parameter; with none the picture is shown.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("overdraw", Self::Overdraw),
        ("lights_evaluated", Self::LightsEvaluated),
        ("lights_reaching", Self::LightsReaching),
        ("lights_in_vain", Self::LightsInVain),
    ];

    /// What is counted, for legends.
    pub fn title(self) -> &'static str {
        match self {
            Self::Overdraw => "Fragments shaded",
            Self::LightsEvaluated => "Lights evaluated",
            Self::LightsReaching => "Lights that reach",
            Self::LightsInVain => "Lights evaluated in vain",
        }
    }

    /// The heat map that a pipeline shows in place of its picture.
    pub fn of(desc: &PipelineDesc) -> Option<Self> {
        let ParameterValue::Choice(name) = &desc.parameter(PARAMETER)?.value else {
            return None;
        };
        let found = Self::NAMES.iter().find(|(known, _)| known == name);
        found.map(|(_, map)| *map)
    }

    /// The declaration of [`PARAMETER`].
    pub fn parameter(at: Place) -> Parameter {
        let options = std::iter::once("off").chain(Self::NAMES.iter().map(|(name, _)| *name));
        let off = ParameterValue::Choice("off".to_owned());
        Parameter {
            name: PARAMETER.to_owned(),
            at,
            description: "Show how much work each pixel makes, in place of the picture".to_owned(),
            unit: String::new(),
            kind: ParameterKind::Choice {
                options: options.map(str::to_owned).collect(),
            },
            default: off.clone(),
            value: off,
            tunable: false,
        }
    }

    /// The declaration of [`MOST`].
    pub fn most_parameter(at: Place) -> Parameter {
        Parameter {
            name: MOST.to_owned(),
            at,
            description: "The count that a heat map shows brightest; pixels with more are white"
                .to_owned(),
            unit: String::new(),
            kind: ParameterKind::Number {
                min: 1.0,
                max: 2048.0,
            },
            default: ParameterValue::Number(16.0),
            value: ParameterValue::Number(16.0),
            tunable: false,
        }
    }

    /// Changes a pipeline so that its picture is this heat map, and its linear target holds the
    /// counts.
    ///
    /// # Errors
    /// A pipeline that names no linear target to count lights in, or one that can't count.
    pub fn apply(self, desc: &mut PipelineDesc) -> Result<(), Problem> {
        let counts = match self.lights_define() {
            Some(value) => count_lights(desc, value)?,
            None => count_fragments(desc),
        };
        show(desc, &counts);
        Ok(())
    }

    /// The value of the define, as `shaders/lib/light_counts.wgsl` reads it.
    fn lights_define(self) -> Option<i32> {
        match self {
            Self::Overdraw => None,
            Self::LightsEvaluated => Some(0),
            Self::LightsReaching => Some(1),
            Self::LightsInVain => Some(2),
        }
    }
}

/// Makes all shaders count lights. Gives the target with the counts.
fn count_lights(desc: &mut PipelineDesc, value: i32) -> Result<String, Problem> {
    let Some(hdr) = desc.hdr.clone() else {
        return Err(Problem::new(
            desc.file.clone(),
            "lights can't be counted, since no target is named that holds linear radiance",
        )
        .with_hint("name it with `.hdr(target)`"));
    };
    if let Some(target) = desc.target(&hdr.name)
        && !can_count(target.format)
    {
        return Err(Problem::new(
            target.at.clone(),
            format!(
                "lights can't be counted in `{}`: {} does not hold all whole numbers up to 2048",
                target.name, target.format
            ),
        )
        .with_hint("a format that does is `rgba16float`"));
    }
    // What is blended over the surface would mix its counts with those of the surface.
    desc.passes
        .retain(|pass| !draws(pass, DrawList::Transparent));
    drop_orphans(desc);
    for pass in &mut desc.passes {
        if let Some(shader) = &mut pass.shader {
            shader.defines.push(Define {
                name: COUNT_LIGHTS.to_owned(),
                value: Some(value),
            });
        }
    }
    Ok(hdr.name)
}

/// Takes out the passes that read a target which no pass writes any more, and those that need them.
fn drop_orphans(desc: &mut PipelineDesc) {
    loop {
        let written: BTreeSet<String> = desc
            .passes
            .iter()
            .flat_map(life::writes)
            .map(str::to_owned)
            .collect();
        let is_orphan = |name: &str| !written.contains(name) && desc.target(name).is_some();
        let orphans: Vec<bool> = desc
            .passes
            .iter()
            .map(|pass| life::reads(pass).any(is_orphan))
            .collect();
        if !orphans.contains(&true) {
            return;
        }
        let mut orphans = orphans.into_iter();
        desc.passes.retain(|_| !orphans.next().unwrap_or(false));
    }
}

fn draws(pass: &PassDesc, list: DrawList) -> bool {
    matches!(&pass.kind, PassKind::Geometry(geometry) if geometry.list == list)
}

fn can_count(format: Format) -> bool {
    let name = format.name();
    name.ends_with("16float") || name.ends_with("32float")
}

/// Puts before each geometry pass one that counts its fragments. Gives the target with the counts.
fn count_fragments(desc: &mut PipelineDesc) -> String {
    let at = desc.file.clone();
    // Targets of counts, one for each size and number of samples of a picture.
    let mut groups: Vec<(TargetSize, u32)> = Vec::new();
    for mut pass in std::mem::take(&mut desc.passes) {
        if let Some(group) = pictured(&pass, &desc.targets) {
            let known = groups.iter().position(|known| *known == group);
            let index = known.unwrap_or(groups.len());
            if known.is_none() {
                groups.push(group);
            }
            let load = match known {
                Some(_) => Load::Keep,
                None => Load::Clear([0.0; 4]),
            };
            desc.passes
                .push(counting(&pass, &name_of(index), load, group.1 > 1));
            // What it cleared is cleared.
            if let Some(depth) = &mut pass.depth {
                depth.load = Load::Keep;
                if let Some(stencil) = &mut depth.stencil {
                    stencil.load = StencilClear::Keep;
                }
            }
        }
        desc.passes.push(pass);
    }
    for (index, (size, samples)) in groups.iter().enumerate() {
        let mut target = TargetDesc::new(name_of(index), at.clone(), half_float());
        target.size = *size;
        if *samples > 1 {
            let mut sampled = target.clone();
            sampled.name = samples_of(&target.name);
            sampled.samples = *samples;
            desc.targets.push(sampled);
        }
        desc.targets.push(target);
    }
    // A pipeline's linear target has four channels.
    let total = Format(wgpu::TextureFormat::Rgba16Float);
    desc.targets
        .push(TargetDesc::new(OVERDRAW, at.clone(), total));
    let mut clear = PassDesc::new(OVERDRAW, at.clone(), PassKind::Clear);
    clear.colors.push(ColorAttachment {
        load: Load::Clear([0.0; 4]),
        ..ColorAttachment::new(OVERDRAW, at.clone())
    });
    desc.passes.push(clear);
    for index in 0..groups.len() {
        let name = name_of(index);
        let mut add = PassDesc::new(format!("add_{name}"), at.clone(), PassKind::Fullscreen);
        add.shader = Some(plain_shader(ADD_SHADER, &at));
        add.reads.push(Read {
            variable: "counts".to_owned(),
            ..Read::new(name, at.clone())
        });
        add.colors.push(ColorAttachment {
            blend: Blend::Add,
            ..ColorAttachment::new(OVERDRAW, at.clone())
        });
        desc.passes.push(add);
    }
    OVERDRAW.to_owned()
}

/// The size and samples of what a geometry pass draws colours to, where that is a picture of the
/// output.
fn pictured(pass: &PassDesc, targets: &[TargetDesc]) -> Option<(TargetSize, u32)> {
    let PassKind::Geometry(_) = pass.kind else {
        return None;
    };
    let color = pass.colors.first()?;
    let target = targets.iter().find(|target| target.name == color.target)?;
    let whole = target.shape == Shape::Flat && color.slice == Slice::default();
    let relative = matches!(target.size, TargetSize::Relative(_));
    (whole && relative).then_some((target.size, target.samples))
}

/// The pass that counts the fragments of a geometry pass, which comes after it: it tests and writes
/// the same depth, and discards the same fragments.
fn counting(pass: &PassDesc, target: &str, load: Load, sampled: bool) -> PassDesc {
    let mut counting = pass.clone();
    counting.name = format!("count_{}", pass.name);
    if let Some(shader) = &mut counting.shader {
        shader.defines.push(Define::flag(COUNT_FRAGMENTS));
    }
    let name = if sampled {
        samples_of(target)
    } else {
        target.to_owned()
    };
    counting.colors = vec![ColorAttachment {
        load,
        blend: Blend::Add,
        resolve: sampled.then(|| Named {
            name: target.to_owned(),
            at: pass.at.clone(),
        }),
        ..ColorAttachment::new(name, pass.at.clone())
    }];
    counting
}

fn name_of(group: usize) -> String {
    format!("heat_map_fragments_{group}")
}

fn samples_of(name: &str) -> String {
    format!("{name}_samples")
}

fn half_float() -> Format {
    Format(wgpu::TextureFormat::R16Float)
}

fn plain_shader(path: &str, at: &Place) -> ShaderDesc {
    ShaderDesc {
        path: path.to_owned(),
        at: at.clone(),
        defines: Vec::new(),
        define_places: Vec::new(),
    }
}

/// Shows a target of counts in place of the picture.
fn show(desc: &mut PipelineDesc, counts: &str) {
    let at = desc.file.clone();
    // The passes that made the picture go where nothing else needs them.
    let picture = desc.output.take();
    if let Some(picture) = picture {
        desc.passes
            .retain(|pass| pass.colors.iter().all(|color| color.target != picture.name));
    }
    desc.hdr = Some(Named {
        name: counts.to_owned(),
        at: at.clone(),
    });
    desc.output = Some(Named {
        name: PICTURE.to_owned(),
        at: at.clone(),
    });
    desc.targets.push(TargetDesc::new(
        PICTURE,
        at.clone(),
        Format(wgpu::TextureFormat::Rgba8Unorm),
    ));
    let mut pass = PassDesc::new("heat_map", at.clone(), PassKind::Fullscreen);
    pass.shader = Some(plain_shader(SHOW_SHADER, &at));
    pass.reads.push(Read {
        variable: "counts".to_owned(),
        ..Read::new(counts, at.clone())
    });
    pass.colors.push(ColorAttachment::new(PICTURE, at));
    desc.passes.push(pass);
    let used = |name: &str| desc.passes.iter().any(|pass| life::touches(pass, name));
    let kept: Vec<bool> = desc.targets.iter().map(|t| used(&t.name)).collect();
    let mut kept = kept.into_iter();
    desc.targets.retain(|_| kept.next().unwrap_or(true));
}
