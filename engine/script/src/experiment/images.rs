//! Images: what a target held, as numbers.

use std::sync::Arc;

use lightbench_render::TargetImage;
use lightbench_render::inspect::{Aspect, Shown};
use lightbench_render::reflection::SampleKind;
use rhai::{Array, Dynamic};

use super::bench::Bench;
use super::frames::pixel;
use super::options::Options;
use crate::api::{Api, Arguments, Mistake, ScriptType, as_number};
use crate::math::text;
use crate::names::list;

/// The folder of a project that experiments write to.
pub(super) const OUT: &str = "out/";

/// What a part of a target held.
#[derive(Clone)]
pub(super) struct Image {
    bench: Bench,
    image: Arc<TargetImage>,
    title: Arc<str>,
    /// Whether the format holds integers.
    whole: bool,
}

impl ScriptType for Image {
    const NAME: &'static str = "image";
}

impl Image {
    pub(super) fn new(bench: &Bench, image: TargetImage, title: String, aspect: Aspect) -> Self {
        let kind = SampleKind::of_format(image.format.0);
        Self {
            bench: bench.clone(),
            whole: aspect == Aspect::Stencil || matches!(kind, SampleKind::Uint | SampleKind::Sint),
            image: bench.charged(image),
            title: title.into(),
        }
    }

    /// What it holds.
    pub(super) fn texels(&self) -> &Arc<TargetImage> {
        &self.image
    }

    /// One number for each channel of the format.
    fn channels(&self, one: impl Fn(usize) -> f64) -> Array {
        let channels = 0..(self.image.channels as usize).min(4);
        channels
            .map(|channel| Dynamic::from(one(channel)))
            .collect()
    }

    /// As [`Image::channels`], for values that occur in the image: integers are whole numbers.
    fn texel(&self, one: impl Fn(usize) -> f32) -> Array {
        if !self.whole {
            return self.channels(|channel| f64::from(one(channel)));
        }
        let channels = 0..(self.image.channels as usize).min(4);
        let whole = |channel| Dynamic::from(one(channel) as i64);
        channels.map(whole).collect()
    }

    /// The values of one channel.
    fn values(&self, channel: usize) -> impl Iterator<Item = f32> {
        self.image.texels.iter().map(move |texel| texel[channel])
    }
}

pub(super) fn register(api: &mut Api) {
    api.section("Images");
    api.object::<Image>();
    text(api.engine(), |image: &Image| {
        let TargetImage { width, height, .. } = *image.image;
        format!("{}, {width} x {height}", image.title)
    });
    api.getter("width", "Texels across.", |image: Image, _| {
        Ok(i64::from(image.image.width))
    });
    api.getter("height", "Texels down.", |image: Image, _| {
        Ok(i64::from(image.image.height))
    });
    api.getter(
        "channels",
        "How many channels the target's format has. All arrays below have as many numbers.",
        |image: Image, _| Ok(i64::from(image.image.channels)),
    );
    api.method(
        "at(x, y)",
        "The channels of a texel as an array, counted from 0 at the upper left. Formats with \
         integers give whole numbers, normalised ones numbers from 0 to 1, those with sRGB linear \
         ones.",
        |image: Image, arguments| {
            let (width, height) = (image.image.width, image.image.height);
            let (x, y) = pixel(arguments, (width, height))?;
            let texel = image.image.texels[(y * width + x) as usize];
            Ok(image.texel(|channel| texel[channel]))
        },
    );
    api.getter(
        "mean",
        "The mean of all texels, for each channel. It is no number where a texel is none.",
        |image: Image, _| {
            let count = image.image.texels.len() as f64;
            Ok(image.channels(|channel| image.values(channel).map(f64::from).sum::<f64>() / count))
        },
    );
    api.getter(
        "smallest",
        "The smallest value of each channel. What is no number is passed over.",
        |image: Image, _| Ok(image.texel(|channel| image.values(channel).fold(f32::NAN, f32::min))),
    );
    api.getter(
        "largest",
        "The largest value of each channel. What is no number is passed over.",
        |image: Image, _| Ok(image.texel(|channel| image.values(channel).fold(f32::NAN, f32::max))),
    );
    api.method(
        "compare(reference)",
        "How far the image is from a reference of the same size, as a map. Of targets with 8 bits a channel, \
         as a display shows them: `mse`, `rmse`, `psnr` in decibels, `ssim`, and `flip`, the mean of the \
         perceptual error from 0 to 1. Of others, in linear light: `mse`, `rmse`, `relative_mse`, `psnr`, \
         `smape`, and `energy_ratio`, the image's light over the reference's. `lightbench diff --help` has \
         the formulas.",
        |image: Image, arguments| {
            let reference: Image = arguments.object(0)?;
            let found = image
                .bench
                .work(|laboratory| laboratory.compare(&reference.image, &image.image))?;
            let entries = found.into_iter();
            Ok(entries
                .map(|(name, value)| (name.into(), Dynamic::from(value)))
                .collect::<rhai::Map>())
        },
    );
    for form in ["save(path)", "save(path, options)"] {
        api.method(
            form,
            "Writes the image below the project's folder `out`, and gives back the path. An EXR \
             holds the values as they are; a PNG shows those from 0 to 1 as black to white. \
             Options: `channel`, one of `r`, `g`, `b` and `a`, alone; `range: [low, high]`, what a \
             PNG shows as black and as white; `false_colour: true` for one channel of a PNG in \
             colours, from dark blue to yellow.",
            |image: Image, arguments| save(&image, arguments),
        );
    }
}

/// The first argument as a path below the folder `out`, with one of these endings.
pub(super) fn out_path(
    arguments: &Arguments,
    what: &str,
    endings: &[&str],
) -> Result<String, Mistake> {
    let path = arguments.text(0)?;
    let below = path.strip_prefix(OUT).filter(|below| !below.is_empty());
    let Some(below) = below else {
        let name = path.rsplit(['/', '\\']).next().unwrap_or_default();
        return Err(Mistake::new(format!(
            "`{path}` can't be written: experiments write into the project's folder `out`"
        ))
        .with_hint(format!("write `{OUT}{name}`")));
    };
    if !endings.iter().any(|ending| below.ends_with(ending)) {
        return Err(
            Mistake::new(format!("`{path}` is no {what}")).with_hint(format!(
                "name a file that ends in {}",
                list(endings.iter().copied(), "or")
            )),
        );
    }
    Ok(path)
}

fn save(image: &Image, arguments: &Arguments) -> Result<String, Mistake> {
    let path = out_path(arguments, "picture", &[".png", ".exr"])?;
    let options = Options::read(arguments, 1, "save", &["channel", "range", "false_colour"])?;
    let channel = match options.text_or_number("channel")?.as_deref() {
        None => None,
        Some(letter) => match ["r", "g", "b", "a"]
            .iter()
            .position(|known| *known == letter)
        {
            Some(channel) => Some(channel),
            None => return Err(options.wrong("channel", "`r`, `g`, `b` or `a`")),
        },
    };
    let wanted = "two different numbers, as in `[0, 4]`";
    let range = options.pair("range", wanted, |value| {
        as_number(value).filter(|number| number.is_finite())
    })?;
    let range = range.unwrap_or([0.0, 1.0]).map(|end| end as f32);
    if range[0] == range[1] {
        return Err(options.wrong("range", wanted));
    }
    let shown = Shown {
        channel,
        range,
        false_colour: options.switch("false_colour")?,
    };
    image.bench.work(|laboratory| {
        let bytes = laboratory.encode(&path, &image.image, shown)?;
        Ok(image.bench.write(&path, &bytes))
    })??;
    Ok(path)
}
