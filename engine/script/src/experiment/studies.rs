//! `study(…)`: a report over all combinations of some values.

use rhai::{Array, Dynamic, Map};

use super::bench::Bench;
use super::images::OUT;
use super::laboratory::{StudyRow, StudyTask};
use super::measuring::{named, of_cost};
use super::options::Options;
use crate::api::{Api, Arguments, Mistake, as_number};

/// What `lightbench compare` has too.
const FRAMES: i64 = 4;
const WARMUP: i64 = 1;
const PROCESSES: i64 = 5;
const SECONDS: f64 = 5.0;
/// The most frames, samples and processes.
const MOST: i64 = 100_000;

pub(super) fn register(api: &mut Api, bench: &Bench, path: &str) {
    api.section("Studies");
    let (bench, path) = (bench.clone(), path.to_owned());
    api.function(
        "study(title, options)",
        "Measures pipelines at all combinations of some values, as `lightbench compare` does: in fresh \
         processes, with a report. What is measured already is not measured again, so a script that was \
         stopped goes on. Options: `scenes` and `pipelines`, arrays of names, or of `[name, values]` with \
         values for parameters; `sweep`, a map from a name to an array of values: a parameter of the scenes, \
         of a pipeline as `\"tiled_deferred.tile_size\"`, of all as `\"*.tile_size\"`, or `size` with values as \
         `\"640x360\"`, `start` or `camera`; `out`, the folder of the report, as `\"out/lights\"`; \
         `size: [width, height]` in pixels, [640, 360]; `reference`, a pipeline or `\"traced\"`, the first \
         pipeline; `samples` a pixel of a traced one, 0; `frames` a process, 4; `warmup`, 1; `start`, the \
         frame at which the scene is drawn first, 0; `step`, seconds between two frames, a sixtieth; \
         `processes`, 5; `seconds` for a pipeline at a point, 5. Gives an array with a map for each pipeline \
         at each point: as `measure` gives, with `point`, a map of the values there; `flip`, the mean FLIP \
         against the reference; and `verdict`, `\"faster\"`, `\"slower\"` or `\"same\"` as the reference, or \
         `\"undecided\"` where the intervals support none of these.",
        move |arguments| {
            bench.begin_draw(&path)?;
            let task = task(arguments)?;
            let rows = bench.work(|laboratory| laboratory.study(&task))?;
            Ok(rows.into_iter().map(|row| Dynamic::from(of_row(row))).collect::<Array>())
        },
    );
}

fn task(arguments: &Arguments) -> Result<StudyTask, Mistake> {
    let options = Options::read(
        arguments,
        1,
        "study",
        &[
            "scenes",
            "pipelines",
            "sweep",
            "out",
            "size",
            "reference",
            "samples",
            "frames",
            "warmup",
            "start",
            "step",
            "processes",
            "seconds",
        ],
    )?;
    let whole = |name: &str, least: i64, default: i64| -> Result<u32, Mistake> {
        Ok(options.whole(name, least, MOST)?.unwrap_or(default) as u32)
    };
    let list = |name: &'static str, example: &str| {
        let wanted = "an array of names";
        let value = options
            .value(name)
            .ok_or_else(|| options.wrong(name, wanted))?;
        let given = value
            .clone()
            .into_array()
            .map_err(|_| options.wrong(name, wanted))?;
        named(arguments, "study", name, example, &given)
    };
    Ok(StudyTask {
        title: arguments.text(0)?,
        scenes: list("scenes", "atrium\", #{ lights: 64")?,
        pipelines: list("pipelines", "tiled_forward\", #{ tile_size: \"8\"")?,
        sweep: sweep(&options)?,
        size: options.size()?,
        reference: options.text("reference")?,
        samples: whole("samples", 0, 0)?,
        warmup: whole("warmup", 0, WARMUP)?,
        frames: whole("frames", 1, FRAMES)?,
        start: whole("start", 0, 0)?,
        step: positive(&options, "step")?,
        processes: whole("processes", 1, PROCESSES)?,
        seconds: positive(&options, "seconds")?.unwrap_or(SECONDS),
        out: out(&options)?,
    })
}

fn positive(options: &Options, name: &str) -> Result<Option<f64>, Mistake> {
    let Some(value) = options.value(name) else {
        return Ok(None);
    };
    let number = as_number(value).filter(|number| number.is_finite() && *number > 0.0);
    number
        .map(Some)
        .ok_or_else(|| options.wrong(name, "a number above 0"))
}

fn out(options: &Options) -> Result<String, Mistake> {
    let wanted = "a folder below `out`, as in `\"out/lights\"`";
    let Some(path) = options.text("out")? else {
        return Err(options.wrong("out", wanted));
    };
    let inside = path.strip_prefix(OUT).is_some_and(|below| {
        !below.is_empty()
            && below
                .split('/')
                .all(|part| !["", ".", ".."].contains(&part))
    });
    if inside && !path.contains('\\') {
        Ok(path)
    } else {
        Err(options.wrong("out", wanted))
    }
}

fn sweep(options: &Options) -> Result<Vec<(String, Vec<String>)>, Mistake> {
    let Some(value) = options.value("sweep") else {
        return Ok(Vec::new());
    };
    let wanted = "a map from names to arrays of values, as in `#{ lights: [16, 64] }`";
    let wrong = || options.wrong("sweep", wanted);
    let map = value.clone().try_cast::<Map>().ok_or_else(wrong)?;
    let mut sweep = Vec::new();
    for (name, values) in map {
        let values = values.into_array().map_err(|_| wrong())?;
        let text = |value: Dynamic| -> Result<String, Mistake> {
            if value.is_string() || value.is_bool() || as_number(&value).is_some() {
                Ok(match value.as_bool() {
                    Ok(on) => if on { "on" } else { "off" }.to_owned(),
                    Err(_) => value.to_string(),
                })
            } else {
                Err(wrong())
            }
        };
        let values: Result<Vec<String>, Mistake> = values.into_iter().map(text).collect();
        sweep.push((name.to_string(), values?));
    }
    Ok(sweep)
}

fn of_row(row: StudyRow) -> Map {
    let mut map = of_cost(&row.pipeline, row.cost);
    let point: Map = row
        .point
        .into_iter()
        .map(|(name, value)| (name.into(), value.into()))
        .collect();
    map.insert("point".into(), Dynamic::from(point));
    map.insert("flip".into(), row.flip.map_or(Dynamic::UNIT, Dynamic::from));
    map.insert("verdict".into(), row.verdict.into());
    map
}
