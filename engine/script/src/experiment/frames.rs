//! `draw(…)`, and looking into the frame that it gives.

use std::sync::Arc;

use lightbench_render::PipelineDesc;
use lightbench_render::description::Slice;
use lightbench_render::inspect::{Aspect, Part, PixelValue, TexelValue, find_pass, last_writer};
use rhai::{Array, Dynamic, Map};

use super::bench::Bench;
use super::images::Image;
use super::laboratory::Shot;
use super::options::Options;
use crate::api::{Api, Arguments, Mistake, ScriptType};
use crate::math::text;

/// The last frame: more than four hours.
const LAST_FRAME: i64 = 1_000_000;

/// A frame that was drawn.
#[derive(Clone)]
pub(super) struct Frame {
    bench: Bench,
    shot: Arc<Shot>,
    desc: Arc<PipelineDesc>,
}

impl ScriptType for Frame {
    const NAME: &'static str = "frame";
}

pub(super) fn register(api: &mut Api, bench: &Bench, path: &str) {
    api.section("Drawing");
    api.object::<Frame>();
    text(api.engine(), |frame: &Frame| {
        let Shot { scene, size, .. } = &*frame.shot;
        let (pipeline, number) = (&frame.desc.name, frame.shot.frame);
        let (width, height) = size;
        format!("frame {number} of {scene} through {pipeline}, {width} x {height}")
    });
    for form in ["draw(scene, pipeline)", "draw(scene, pipeline, options)"] {
        let (bench, path) = (bench.clone(), path.to_owned());
        api.function(
            form,
            "Draws one frame of a scene through a pipeline, both by name or by path. Options: \
             `size: [width, height]` in pixels, [640, 360] unless given; `frame`, from 0, of 60 a \
             second; `scene` and `pipeline`, maps of values for their parameters. What was loaded \
             for one frame serves the next, and the same call always gives the same frame.",
            move |arguments| {
                bench.begin_draw(&path)?;
                drawn(&bench, arguments)
            },
        );
    }
    describe(api);
    look(api);
}

/// Draws the frame that the arguments of a `draw` say.
pub(super) fn drawn(bench: &Bench, arguments: &Arguments) -> Result<Frame, Mistake> {
    let shot = shot(arguments)?;
    let desc = bench.work(|laboratory| laboratory.draw(&shot))?;
    Ok(Frame {
        bench: bench.clone(),
        shot: Arc::new(shot),
        desc: Arc::new(desc),
    })
}

fn shot(arguments: &Arguments) -> Result<Shot, Mistake> {
    let (scene, pipeline) = (arguments.text(0)?, arguments.text(1)?);
    let options = Options::read(
        arguments,
        2,
        "draw",
        &["size", "frame", "scene", "pipeline"],
    )?;
    Ok(Shot {
        scene,
        scene_settings: options.settings("scene")?,
        pipeline,
        pipeline_settings: options.settings("pipeline")?,
        size: options.size()?,
        frame: options.whole("frame", 0, LAST_FRAME)?.unwrap_or(0) as u32,
    })
}

/// What there is to look at.
fn describe(api: &mut Api) {
    api.section("What a frame has");
    api.getter("width", "Pixels across.", |frame: Frame, _| {
        Ok(i64::from(frame.shot.size.0))
    });
    api.getter("height", "Pixels down.", |frame: Frame, _| {
        Ok(i64::from(frame.shot.size.1))
    });
    api.getter(
        "passes",
        "The names of the pipeline's passes, in their order.",
        |frame: Frame, _| {
            let names = frame.desc.passes.iter().map(|pass| pass.name.clone());
            Ok(names.map(Dynamic::from).collect::<Array>())
        },
    );
    api.getter(
        "targets",
        "The names of the pipeline's targets.",
        |frame: Frame, _| {
            let names = frame.desc.targets.iter().map(|target| target.name.clone());
            Ok(names.map(Dynamic::from).collect::<Array>())
        },
    );
    api.getter(
        "kinds",
        "What kind each pass is of, as `geometry` or `fullscreen`, in their order.",
        |frame: Frame, _| {
            let kinds = frame
                .desc
                .passes
                .iter()
                .map(|pass| pass.kind.name().to_owned());
            Ok(kinds.map(Dynamic::from).collect::<Array>())
        },
    );
    api.getter(
        "formats",
        "A map from the names of the pipeline's targets to their formats, as `rgba16float`.",
        |frame: Frame, _| {
            let targets = frame.desc.targets.iter();
            let formats =
                targets.map(|target| (target.name.as_str().into(), target.format.name().into()));
            Ok(formats.collect::<Map>())
        },
    );
    api.method(
        "pixel_bytes(name)",
        "How many bytes a target takes for each of its texels, with all samples.",
        |frame: Frame, arguments| {
            let name = arguments.text(0)?;
            let target = frame.desc.target(&name).ok_or_else(|| {
                let names = frame.desc.targets.iter().map(|target| target.name.as_str());
                let mistake = Mistake::new(format!("there is no target `{name}`"));
                match lightbench_render::problem::suggestion(&name, names) {
                    Some(hint) => mistake.with_hint(hint),
                    None => mistake,
                }
            })?;
            Ok(i64::from(target.format.bytes_per_texel() * target.samples))
        },
    );
    api.getter(
        "hdr",
        "The name of the target that holds the picture in linear light, or the counts of a heat \
         map; `()` where the pipeline names none.",
        |frame: Frame, _| {
            let hdr = frame.desc.hdr.as_ref();
            Ok(hdr.map_or(Dynamic::UNIT, |hdr| hdr.name.clone().into()))
        },
    );
    api.getter(
        "output",
        "The name of the target that holds the picture as a display shows it.",
        |frame: Frame, _| {
            let output = frame.desc.output.as_ref();
            Ok(output.map_or(Dynamic::UNIT, |output| output.name.clone().into()))
        },
    );
}

fn look(api: &mut Api) {
    api.section("Looking into a frame");
    for form in ["target(name)", "target(name, options)"] {
        api.method(
            form,
            "What a target holds, as an image. Options: `after`, the pass after which to look, by \
             its name or its number from 0 (the last one that writes the target, unless given); \
             `mip` and `layer`, from 0; `sample`, one of a target with several (their mean, unless \
             given); `stencil: true` for the stencil beside depth.",
            target,
        );
    }
    api.method(
        "pixel(x, y)",
        "What each pass did to a pixel, counted from 0 at the upper left: an array with a map for \
         each target that a pass wrote, in the order of the passes. The map has `pass`, `target`, \
         `mip`, `layer`, `sample` (`()` for targets with one), `stencil` (whether that is what it \
         tells of), `before` and `after`: arrays with a number for each channel. `before` is `()` \
         where the frame had not written the target yet. In targets of another size it is the texel \
         at the same place of the picture.",
        |frame: Frame, arguments| {
            let pixel = pixel(arguments, frame.shot.size)?;
            let values = frame
                .bench
                .work(|laboratory| laboratory.pixel(&frame.shot, pixel))?;
            let steps = values.iter().map(|value| step(&frame.desc, value).into());
            Ok(steps.collect::<Array>())
        },
    );
    api.method(
        "values(name)",
        "What the scene's scripts plotted under a name, from the start of the scene to this frame, as \
         an array of numbers: one for each step in which they called `plot(name, value)`, the last \
         2000 of them. Empty where nothing was plotted under that name.",
        |frame: Frame, arguments| {
            let name = arguments.text(0)?;
            let values = frame
                .bench
                .work(|laboratory| laboratory.values(&frame.shot, &name))?;
            Ok(values.into_iter().map(Dynamic::from).collect::<Array>())
        },
    );
    api.method(
        "first_invalid()",
        "The first pass that leaves a value that is no number, or infinite, as a map with `pass`, \
         `target`, `mip`, `layer`, `x` and `y` of the first such texel, its `value`, and how many \
         `texels` there are; `()` where all values are numbers.",
        |frame: Frame, _| {
            let found = frame
                .bench
                .work(|laboratory| laboratory.first_invalid(&frame.shot))?;
            let Some(found) = found else {
                return Ok(Dynamic::UNIT);
            };
            let place = &found.place;
            let mut map = place_of(&found.pass, &place.target, place.slice);
            map.insert("x".into(), i64::from(place.first.0).into());
            map.insert("y".into(), i64::from(place.first.1).into());
            map.insert("texels".into(), i64::from(place.texels).into());
            let value = found.value.map(|channel| Dynamic::from(f64::from(channel)));
            map.insert("value".into(), value.to_vec().into());
            Ok(map.into())
        },
    );
}

fn target(frame: Frame, arguments: &mut Arguments) -> Result<Image, Mistake> {
    let name = arguments.text(0)?;
    let known = ["after", "mip", "layer", "sample", "stencil"];
    let options = Options::read(arguments, 1, "target", &known)?;
    let unknown = |unknown: lightbench_render::inspect::Unknown| {
        Mistake::new(unknown.message).with_hint(unknown.hint)
    };
    // The target first: a misspelt name is told as such, whatever the pass.
    let last = last_writer(&frame.desc, &name).map_err(unknown)?;
    let pass = match options.text_or_number("after")? {
        Some(after) => find_pass(&frame.desc, &after).map_err(unknown)?,
        None => last,
    };
    let number = |name: &str| {
        let number = options.whole(name, 0, i64::from(u32::MAX))?;
        Ok::<_, Mistake>(number.map(|number| number as u32))
    };
    let part = Part {
        slice: Slice {
            mip: number("mip")?.unwrap_or(0),
            layer: number("layer")?.unwrap_or(0),
        },
        sample: number("sample")?,
        aspect: match options.switch("stencil")? {
            true => Aspect::Stencil,
            false => Aspect::Main,
        },
    };
    let image = frame
        .bench
        .work(|laboratory| laboratory.target(&frame.shot, pass, &name, part))?;
    let after = &frame.desc.passes[pass].name;
    let title = format!("{name} after {after}");
    Ok(Image::new(&frame.bench, image, title, part.aspect))
}

/// Two arguments that name a pixel inside a size.
pub(super) fn pixel(
    arguments: &Arguments,
    (width, height): (u32, u32),
) -> Result<(u32, u32), Mistake> {
    let one = |index, length: u32| {
        let number = arguments.whole(index, 0, i64::from(length) - 1);
        number.map(|number| number as u32).map_err(|mistake| {
            mistake.with_hint(format!(
                "it has {width} x {height} pixels, counted from 0 at the upper left"
            ))
        })
    };
    Ok((one(0, width)?, one(1, height)?))
}

/// A map that names a pass, and a part of a target.
fn place_of(pass: &str, target: &str, slice: Slice) -> Map {
    let mut map = Map::new();
    map.insert("pass".into(), pass.into());
    map.insert("target".into(), target.into());
    map.insert("mip".into(), i64::from(slice.mip).into());
    map.insert("layer".into(), i64::from(slice.layer).into());
    map
}

fn step(desc: &PipelineDesc, value: &PixelValue) -> Map {
    let mut map = place_of(&desc.passes[value.pass].name, &value.target, value.slice);
    let sample = value.sample.map(i64::from);
    map.insert("sample".into(), sample.map_or(Dynamic::UNIT, Dynamic::from));
    map.insert("stencil".into(), (value.aspect == Aspect::Stencil).into());
    let numbers = |texel| Dynamic::from_array(numbers(texel, value.channels));
    map.insert("before".into(), value.before.map_or(Dynamic::UNIT, numbers));
    map.insert("after".into(), numbers(value.after));
    map
}

/// The first so many channels as scripts see them: integers as whole numbers.
fn numbers(texel: TexelValue, channels: u32) -> Array {
    let mut all: Array = match texel {
        TexelValue::Float(values) => values.map(|v| Dynamic::from(f64::from(v))).to_vec(),
        TexelValue::Uint(values) => values.map(|v| Dynamic::from(i64::from(v))).to_vec(),
        TexelValue::Sint(values) => values.map(|v| Dynamic::from(i64::from(v))).to_vec(),
    };
    all.truncate(channels as usize);
    all
}
