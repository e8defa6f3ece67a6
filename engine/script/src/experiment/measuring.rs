//! `measure(…)`: what frames cost.

use rhai::{Array, Dynamic, Map};

use super::bench::Bench;
use super::laboratory::{Cost, Task, TimeSpan};
use super::options::Options;
use crate::api::{Api, Arguments, Mistake};
use crate::settings::Settings;

/// Frames that are measured, and drawn before, unless told.
const FRAMES: i64 = 15;
const WARMUP: i64 = 2;
/// The most frames of one measurement.
const MOST_FRAMES: i64 = 100_000;
/// The most pipelines of one measurement: all are held at once.
const MOST_PIPELINES: usize = 64;

pub(super) fn register(api: &mut Api, bench: &Bench, path: &str) {
    api.section("Measuring");
    for form in [
        "measure(scene, pipelines)",
        "measure(scene, pipelines, options)",
    ] {
        let (bench, path) = (bench.clone(), path.to_owned());
        api.function(
            form,
            "Measures what frames of a scene cost in some pipelines, which draw each frame in turn. `pipelines` \
             is an array of names, or of `[name, values]` with values for parameters. Options: `frames`, 15 \
             unless given; `warmup`, 2, drawn before; `size: [width, height]` in pixels, [640, 360]; `scene`, \
             a map of values for its parameters. Gives an array with a map for each pipeline: `pipeline`; \
             `gpu`, `gpu_low` and `gpu_high`, the median time of a frame in milliseconds and its 95 % interval \
             (`()` where the adapter has no timestamps; on a software driver it is processor time); `cpu`, \
             `cpu_low` and `cpu_high` for preparing and recording it; `draws`, `triangles`, `bytes` read and \
             written, `memory` in bytes, and `counters`, a map of what its shaders counted.",
            move |arguments| {
                bench.begin_draw(&path)?;
                let measured = measured(&bench, arguments)?;
                Ok(measured.into_iter().map(Dynamic::from).collect::<Array>())
            },
        );
    }
}

/// Measures what the arguments of a `measure` say: a map for each pipeline.
pub(super) fn measured(bench: &Bench, arguments: &Arguments) -> Result<Vec<Map>, Mistake> {
    let task = task(arguments)?;
    let costs = bench.work(|laboratory| laboratory.measure(&task))?;
    let names = task.pipelines.iter().map(|(name, _)| name);
    Ok(names
        .zip(costs)
        .map(|(name, cost)| of_cost(name, cost))
        .collect())
}

fn task(arguments: &Arguments) -> Result<Task, Mistake> {
    let options = Options::read(
        arguments,
        2,
        "measure",
        &["frames", "warmup", "size", "scene"],
    )?;
    let frames = options.whole("frames", 1, MOST_FRAMES)?;
    let warmup = options.whole("warmup", 0, MOST_FRAMES)?;
    Ok(Task {
        scene: arguments.text(0)?,
        scene_settings: options.settings("scene")?,
        pipelines: pipelines(arguments)?,
        size: options.size()?,
        warmup: warmup.unwrap_or(WARMUP) as u32,
        frames: frames.unwrap_or(FRAMES) as u32,
    })
}

/// The pipelines with their values.
fn pipelines(arguments: &Arguments) -> Result<Vec<(String, Settings)>, Mistake> {
    let given = arguments.array(1)?;
    named(
        arguments,
        "measure",
        "pipelines",
        "tiled_forward\", #{ tile_size: \"8\"",
        &given,
    )
}

/// Names, or pairs of a name and a map of values. `example` is what a pair may hold.
pub(super) fn named(
    arguments: &Arguments,
    call: &'static str,
    what: &str,
    example: &str,
    given: &Array,
) -> Result<Vec<(String, Settings)>, Mistake> {
    if given.is_empty() || given.len() > MOST_PIPELINES {
        return Err(Mistake::new(format!(
            "`{what}` of `{call}` must have 1 to {MOST_PIPELINES} entries, not {}",
            given.len()
        )));
    }
    let wrong = |value: &Dynamic| {
        Mistake::new(format!(
            "an entry of `{what}` must be a name, not {}",
            arguments.describe(value)
        ))
        .with_hint(format!("or a name and values: `[\"{example} }}]`"))
    };
    let read = |entry: &Dynamic| {
        if let Ok(name) = entry.clone().into_string() {
            return Ok((name, Settings::new()));
        }
        let pair = entry.read_lock::<Array>().ok_or_else(|| wrong(entry))?;
        let [name, values] = pair.as_slice() else {
            return Err(wrong(entry));
        };
        let name = name.clone().into_string().map_err(|_| wrong(name))?;
        let map = Map::from_iter([("values".into(), values.clone())]);
        let options = Options::of(arguments, call, map);
        Ok((name, options.settings("values")?))
    };
    given.iter().map(read).collect()
}

pub(super) fn of_cost(pipeline: &str, cost: Cost) -> Map {
    let mut map = Map::new();
    let mut set = |name: &str, value: Dynamic| map.insert(name.into(), value);
    set("pipeline", pipeline.to_owned().into());
    for (name, time) in [("gpu", cost.gpu), ("cpu", Some(cost.cpu))] {
        let part = |part: fn(TimeSpan) -> f64| time.map_or(Dynamic::UNIT, |t| part(t).into());
        set(name, part(|time| time.median));
        set(&format!("{name}_low"), part(|time| time.low));
        set(&format!("{name}_high"), part(|time| time.high));
    }
    let counts = [
        ("draws", cost.draws),
        ("triangles", cost.triangles),
        ("bytes", cost.bytes),
        ("memory", cost.memory),
    ];
    for (name, count) in counts {
        set(
            name,
            Dynamic::from(i64::try_from(count).unwrap_or(i64::MAX)),
        );
    }
    let counters = cost.counters.into_iter();
    let counters = counters.map(|(name, value)| (name.into(), Dynamic::from(value)));
    set("counters", Dynamic::from(counters.collect::<Map>()));
    map
}
