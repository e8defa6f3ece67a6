//! What a check says of the work: pictures, numbers, limits and names against what they should be.

use std::sync::Arc;

use lightbench_render::TargetImage;
use rhai::{Array, Dynamic, EvalAltResult, FnPtr, Map};

use super::evidence::{Bound, Evidence, Expected, Told};
use super::mistakes::{bound, mistakes};
use super::work::Work;
use crate::api::{Api, Arguments, Mistake, as_number, spell};
use crate::experiment::images::Image;
use crate::experiment::options::Options;

/// What counts for pictures without options: four times the rounding of 16-bit floating point.
const PICTURES: Bound = Bound {
    absolute: 0.001,
    relative: 0.002,
    share: 0.0,
};
/// What counts for numbers without options.
const NUMBERS: Bound = Bound {
    absolute: 0.0,
    relative: 0.001,
    share: 0.0,
};
/// Points of a closed form along the longer side of a picture, unless told.
const POINTS: u32 = 32;

pub(super) fn register(api: &mut Api) {
    api.section("Judging");
    pictures(api);
    values(api);
    numbers(api);
    limits(api);
    statements(api);
}

fn pictures(api: &mut Api) {
    for form in [
        "same_picture(criterion, found, expected)",
        "same_picture(criterion, found, expected, options)",
    ] {
        api.method(
            form,
            "Whether two images agree, texel by texel, in the values that their targets hold. Options: \
             `absolute` and `relative`, by how much a channel may differ, together `absolute + relative · \
             |expected|` (0.001 and 0.002; where one is given, the other is 0); `share` of the texels that \
             may differ more, as edges of objects may (0); `within: [[x, y], [width, height]]`, the part \
             that is compared; `channels`, how many are compared (3 at most); `mistakes`, a map from names \
             of the lesson's mistakes to the image that each would have given. The message names the \
             mistake that comes near to what was found.",
            |work: Work, arguments| {
                let criterion = arguments.text(0)?;
                let found: Image = arguments.object(1)?;
                let expected: Image = arguments.object(2)?;
                let known = ["absolute", "relative", "share", "within", "channels", "mistakes"];
                let options = Options::read(arguments, 3, "same_picture", &known)?;
                let found = found.texels();
                let area = area(&options, found)?;
                let channels = channels(&options, found)?;
                let whole = |image: &TargetImage| {
                    same_size(found, image)?;
                    Ok::<_, Mistake>(expected_where(image, channels, area))
                };
                let read = |value: &Dynamic| {
                    let image = value.read_lock::<Image>().map(|image| image.clone());
                    image.map(|image| whole(image.texels())).transpose()
                };
                let evidence = Evidence::Picture {
                    expected: whole(expected.texels())?,
                    mistakes: mistakes(&options, "images", read)?,
                    bound: bound(&options, PICTURES)?,
                    found: Arc::clone(found),
                };
                work.judge(&criterion, evidence)
            },
        );
    }
}

fn values(api: &mut Api) {
    for form in [
        "same_values(criterion, found, expected)",
        "same_values(criterion, found, expected, options)",
    ] {
        api.calling_method(
            form,
            "Whether an image holds what a function says: `expected` is called with the whole coordinates \
             x and y of texels and gives a number, an array with one for each channel that is compared, or \
             `()` where nothing is expected. Options as of `same_picture` except `channels`; a mistake is such a \
             function; and `every`, each how many texels along both axes is looked at, unless given so many \
             that the longer side has 32.",
            |work: Work, arguments| {
                let criterion = arguments.text(0)?;
                let found: Image = arguments.object(1)?;
                let known = ["absolute", "relative", "share", "within", "every", "mistakes"];
                let options = Options::read(arguments, 3, "same_values", &known)?;
                let found = found.texels();
                let area = area(&options, found)?;
                let every = found.width.max(found.height).div_ceil(POINTS);
                let every = options.whole("every", 1, 4096)?.map_or(every, |every| every as u32);
                let form = |function: &Dynamic| {
                    let function = function.read_lock::<FnPtr>().map(|function| function.clone());
                    let Some(function) = function else {
                        return Ok(None);
                    };
                    closed_form(arguments, found, area, every, &function).map(Some)
                };
                let expected = form(arguments.value(2))?.ok_or_else(|| {
                    arguments.wrong(2, "a function of x and y, as in `|x, y| …`")
                })?;
                let evidence = Evidence::Picture {
                    expected,
                    mistakes: mistakes(&options, "functions of x and y", form)?,
                    bound: bound(&options, PICTURES)?,
                    found: Arc::clone(found),
                };
                Ok(work.judge(&criterion, evidence)?)
            },
        );
    }
}

fn numbers(api: &mut Api) {
    for form in [
        "same_number(criterion, found, expected)",
        "same_number(criterion, found, expected, options)",
    ] {
        api.method(
            form,
            "Whether a number is what it should be. Options: `absolute` and `relative`, by how much it may \
             differ (0 and 0.001); `unit`, a text; `mistakes`, a map from names of the lesson's mistakes to \
             the number that each would have given.",
            |work: Work, arguments| {
                let criterion = arguments.text(0)?;
                let known = ["absolute", "relative", "unit", "mistakes"];
                let options = Options::read(arguments, 3, "same_number", &known)?;
                let read = |value: &Dynamic| Ok::<_, Mistake>(as_number(value));
                let evidence = Evidence::Number {
                    found: any_number(arguments, 1)?,
                    expected: arguments.number(2)?,
                    mistakes: mistakes(&options, "numbers", read)?,
                    bound: bound(&options, NUMBERS)?,
                    unit: options.text("unit")?.unwrap_or_default(),
                };
                work.judge(&criterion, evidence)
            },
        );
    }
}

fn limits(api: &mut Api) {
    for (name, at_least, about) in [
        (
            "at_most",
            false,
            "Whether a number is not above a limit, as light that is sent back is not above what arrives. \
             Options: `margin`, how far drivers may be apart there, as a share of the limit (0); `unit`, a \
             text; `mistake`, the one that is meant where it is above.",
        ),
        (
            "at_least",
            true,
            "Whether a number is not below a limit. Options as of `at_most`.",
        ),
    ] {
        for more in ["", ", options"] {
            api.method(
                &format!("{name}(criterion, found, limit{more})"),
                about,
                move |work: Work, arguments| {
                    let criterion = arguments.text(0)?;
                    let options =
                        Options::read(arguments, 3, name, &["margin", "unit", "mistake"])?;
                    let evidence = Evidence::Limit {
                        found: any_number(arguments, 1)?,
                        limit: arguments.number(2)?,
                        at_least,
                        margin: options.number("margin", 0.0, 1.0)?.unwrap_or(0.0),
                        unit: options.text("unit")?.unwrap_or_default(),
                        mistake: options.text("mistake")?,
                    };
                    work.judge(&criterion, evidence)
                },
            );
        }
    }
}

fn statements(api: &mut Api) {
    for form in [
        "same(criterion, found, expected)",
        "same(criterion, found, expected, options)",
    ] {
        api.method(
            form,
            "Whether two values are the same: names of passes, formats of targets, counts. Option: \
             `mistake`, the one that is meant where they are not.",
            |work: Work, arguments| {
                let criterion = arguments.text(0)?;
                let options = Options::read(arguments, 3, "same", &["mistake"])?;
                let (found, expected) = (arguments.value(1), arguments.value(2));
                let evidence = Evidence::Statement {
                    holds: equal(found, expected),
                    found: told(found),
                    expected: told(expected),
                    mistake: options.text("mistake")?,
                };
                work.judge(&criterion, evidence)
            },
        );
    }
    for form in [
        "holds(criterion, condition, found, expected)",
        "holds(criterion, condition, found, expected, options)",
    ] {
        api.method(
            form,
            "Whether a condition holds, with what was found and what was expected, to be shown: values, or \
             words as `#{ en: \"no lamp\", es: \"ninguna lámpara\" }`. Option: `mistake`, the one that is \
             meant where it does not hold.",
            |work: Work, arguments| {
                let criterion = arguments.text(0)?;
                let options = Options::read(arguments, 4, "holds", &["mistake"])?;
                let evidence = Evidence::Statement {
                    holds: arguments.switch(1)?,
                    found: told(arguments.value(2)),
                    expected: told(arguments.value(3)),
                    mistake: options.text("mistake")?,
                };
                work.judge(&criterion, evidence)
            },
        );
    }
}

/// A rectangle of texels: where it begins, and where it ends.
type Area = [[u32; 2]; 2];

/// The option `within`.
fn area(options: &Options, image: &TargetImage) -> Result<Area, Mistake> {
    let wanted = "the first texel and the size, as in `[[0, 0], [64, 32]]`";
    let pair = |value: &Dynamic| {
        let items = value.read_lock::<Array>()?;
        let [a, b] = items.as_slice() else {
            return None;
        };
        let side = |value| crate::experiment::options::whole(value, 0, i64::from(u32::MAX));
        Some([side(a)? as u32, side(b)? as u32])
    };
    let Some([first, size]) = options.pair("within", wanted, pair)? else {
        return Ok([[0, 0], [image.width, image.height]]);
    };
    let last = [0, 1].map(|axis| first[axis].saturating_add(size[axis]));
    if size.contains(&0) || last[0] > image.width || last[1] > image.height {
        return Err(options.wrong("within", &format!("{wanted}, inside of the image")));
    }
    Ok([first, last])
}

fn channels(options: &Options, image: &TargetImage) -> Result<usize, Mistake> {
    let all = image.channels.clamp(1, 4);
    let given = options.whole("channels", 1, i64::from(all))?;
    Ok(given.map_or(all.min(3) as usize, |given| given as usize))
}

fn same_size(found: &TargetImage, other: &TargetImage) -> Result<(), Mistake> {
    let size = |image: &TargetImage| (image.width, image.height);
    if size(found) == size(other) {
        return Ok(());
    }
    Err(Mistake::new(format!(
        "images of {} x {} and {} x {} texels can't be compared",
        found.width, found.height, other.width, other.height
    )))
}

fn inside([first, last]: Area, x: u32, y: u32) -> bool {
    (first[0]..last[0]).contains(&x) && (first[1]..last[1]).contains(&y)
}

/// The texels of an image that lie in an area.
fn expected_where(image: &TargetImage, channels: usize, area: Area) -> Expected {
    let texels = image.texels.iter().zip(0..);
    let texels = texels.map(|(texel, index): (_, u32)| {
        inside(area, index % image.width, index / image.width).then_some(*texel)
    });
    Expected {
        channels,
        texels: texels.collect(),
    }
}

/// What a function says of the texels of a grid in an area.
fn closed_form(
    arguments: &Arguments,
    image: &TargetImage,
    area: Area,
    every: u32,
    function: &FnPtr,
) -> Result<Expected, Box<EvalAltResult>> {
    let [first, last] = area;
    let mut texels = vec![None; image.texels.len()];
    let mut channels = 1;
    // The grid begins in the middle of its first cell, or of an area that is smaller than that.
    let begin = |axis: usize| first[axis] + (every / 2).min((last[axis] - first[axis]) / 2);
    for y in (begin(1)..last[1]).step_by(every as usize) {
        for x in (begin(0)..last[0]).step_by(every as usize) {
            let place = (i64::from(x), i64::from(y));
            let value: Dynamic = function.call_within_context(arguments.context, place)?;
            if value.is_unit() {
                continue;
            }
            let mut texel = [0.0; 4];
            channels = numbers_of(&value, &mut texel).ok_or_else(|| {
                Mistake::new(format!(
                    "the function must give a number, an array of up to four, or `()`, not {}",
                    arguments.describe(&value)
                ))
            })?;
            texels[(y * image.width + x) as usize] = Some(texel);
        }
    }
    Ok(Expected { channels, texels })
}

/// Reads one number or several, and gives how many.
fn numbers_of(value: &Dynamic, texel: &mut [f32; 4]) -> Option<usize> {
    if let Some(number) = as_number(value) {
        texel[0] = number as f32;
        return Some(1);
    }
    let items = value.read_lock::<Array>()?;
    if items.is_empty() || items.len() > texel.len() {
        return None;
    }
    for (place, item) in texel.iter_mut().zip(items.iter()) {
        *place = as_number(item)? as f32;
    }
    Some(items.len())
}

/// A number of the work, which may be none or infinite.
fn any_number(arguments: &Arguments, index: usize) -> Result<f64, Mistake> {
    as_number(arguments.value(index)).ok_or_else(|| arguments.wrong(index, "a number"))
}

fn equal(a: &Dynamic, b: &Dynamic) -> bool {
    match (as_number(a), as_number(b)) {
        (Some(a), Some(b)) => a == b,
        _ => shown(a) == shown(b),
    }
}

/// What a value says in each language: a map has words for them, anything else is the same in all.
fn told(value: &Dynamic) -> Told {
    let words = value.read_lock::<Map>().and_then(|map| {
        let word = |language: &str| map.get(language)?.clone().into_string().ok();
        let (en, es) = (word("en")?, word("es")?);
        (map.len() == 2).then_some(Told { en, es })
    });
    words.unwrap_or_else(|| Told {
        en: shown(value),
        es: shown(value),
    })
}

/// A value as a person reads it: texts without quotes, others as a script writes them.
fn shown(value: &Dynamic) -> String {
    let text = value.clone().into_string().ok();
    text.or_else(|| spell(value))
        .unwrap_or_else(|| value.to_string())
}
