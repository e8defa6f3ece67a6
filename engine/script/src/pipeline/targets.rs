//! Targets of a pipeline.

use lightbench_render::Format;
use lightbench_render::description::{Mips, Shape, TargetDesc, TargetSize};
use lightbench_render::problem::suggestion;

use super::builder::{Pipeline, not_taken, problem, shader_name};
use crate::api::{Api, Arguments, Mistake, ScriptType};

/// The largest side of a target, which every adapter can do.
const MAX_SIDE: i64 = 8192;

/// A target, as scripts hold it.
#[derive(Clone, Debug)]
struct Target {
    pipeline: Pipeline,
    /// Its name; `None` where its declaration has a mistake.
    name: Option<String>,
}

impl ScriptType for Target {
    const NAME: &'static str = "target";
}

pub(super) fn register(api: &mut Api) {
    api.object::<Target>();
    api.section("Targets");
    api.method(
        "target(name, format)",
        "Declares a texture that passes write and read: flat, as large as the output, with one mip \
         level and one sample a texel. The methods below change that. The format is a WebGPU name, \
         as in `rgba16float`. Shaders use the target by its name.",
        |pipeline: Pipeline, arguments| {
            let mut declared = None;
            pipeline.note(arguments, |builder, at| {
                let name = arguments.text(0)?;
                shader_name(&name, "a target")?;
                not_taken(builder, &name)?;
                let asked = arguments.text(1)?;
                let mut format = Format::from_name(&asked);
                if format.is_none() {
                    let names: Vec<String> = Format::names().collect();
                    let mistake = Mistake::new(format!("there is no format `{asked}`"));
                    let hint = suggestion(&asked, names.iter().map(String::as_str))
                        .unwrap_or_else(|| format!("there are {}", names.join(", ")));
                    let problem = problem(at.clone(), mistake.with_hint(hint));
                    builder.problems.push(problem);
                    // The target is declared all the same, so that its uses are no mistakes too.
                    format = names.first().and_then(|name| Format::from_name(name));
                }
                if let Some(format) = format {
                    declared = Some(name.clone());
                    builder.desc.targets.push(TargetDesc::new(name, at, format));
                }
                Ok(())
            });
            let name = declared;
            Ok(Target { pipeline, name })
        },
    );
    change(
        api,
        "scale(factor)",
        "Makes the target smaller or larger than the output, along each side. The size is rounded \
         to whole texels, at least one. Default: `1`.",
        |target, arguments| {
            let factor = arguments.number_in(0, 1.0 / 64.0, 4.0)?;
            target.size = TargetSize::Relative(factor as f32);
            Ok(())
        },
    );
    change(
        api,
        "size(width, height)",
        "Gives the target a fixed size in texels, whatever the output's.",
        |target, arguments| {
            let width = arguments.whole(0, 1, MAX_SIDE)? as u32;
            let height = arguments.whole(1, 1, MAX_SIDE)? as u32;
            target.size = TargetSize::Absolute(width, height);
            Ok(())
        },
    );
    change(
        api,
        "per_tile(size)",
        "Gives the target one texel for each tile of that many by that many pixels. Tiles at the \
         edge may be cut.",
        |target, arguments| {
            target.size = TargetSize::Tiles(arguments.whole(0, 1, 1024)? as u32);
            Ok(())
        },
    );
    change(
        api,
        "array(layers)",
        "Makes the target an array; shaders read a `texture_2d_array`.",
        |target, arguments| shape(target, Shape::Array(arguments.whole(0, 1, 256)? as u32)),
    );
    change(
        api,
        "cube()",
        "Makes the target a cube of six sides: +x, -x, +y, -y, +z, -z; shaders read a \
         `texture_cube`. Give it a `.size` of equal sides.",
        |target, _| shape(target, Shape::Cube),
    );
    change(
        api,
        "volume(depth)",
        "Makes the target a box of so many slices; shaders read a `texture_3d`.",
        |target, arguments| shape(target, Shape::Volume(arguments.whole(0, 1, 2048)? as u32)),
    );
    change(
        api,
        "mips()",
        "Gives the target all mip levels down to one texel. A `mips` pass fills them, or passes that \
         write them one by one with `.mip`.",
        |target, _| {
            target.mips = Mips::All;
            Ok(())
        },
    );
    change(
        api,
        "mips(count)",
        "Gives the target so many mip levels, with the largest. Default: `1`.",
        |target, arguments| {
            target.mips = Mips::Count(arguments.whole(0, 1, 16)? as u32);
            Ok(())
        },
    );
    change(
        api,
        "samples(count)",
        "Gives each texel 1 or 4 samples; with 4, shaders read a `texture_multisampled_2d`. \
         Default: `1`.",
        |target, arguments| {
            target.samples = match arguments.whole(0, 1, 4)? {
                1 => 1,
                4 => 4,
                other => {
                    return Err(Mistake::new(format!(
                        "a texel has 1 or 4 samples, not {other}"
                    )));
                }
            };
            Ok(())
        },
    );
    change(
        api,
        "fallback(format)",
        "Names a format to take instead where the adapter can't do the first. Called again, it names \
         the next to try. Without it, such an adapter can't run the pipeline.",
        |target, arguments| {
            let asked = arguments.text(0)?;
            let names: Vec<String> = Format::names().collect();
            let format = Format::from_name(&asked).ok_or_else(|| {
                let mistake = Mistake::new(format!("there is no format `{asked}`"));
                match suggestion(&asked, names.iter().map(String::as_str)) {
                    Some(hint) => mistake.with_hint(hint),
                    None => mistake,
                }
            })?;
            target.fallbacks.push(format);
            Ok(())
        },
    );
}

fn shape(target: &mut TargetDesc, shape: Shape) -> Result<(), Mistake> {
    if target.shape != Shape::Flat {
        return Err(Mistake::new(format!(
            "the target is {} already",
            target.shape.in_words()
        )));
    }
    target.shape = shape;
    Ok(())
}

/// Registers a method of a target that gives the target back.
fn change(
    api: &mut Api,
    form: &str,
    about: &'static str,
    body: impl Fn(&mut TargetDesc, &Arguments) -> Result<(), Mistake> + Send + Sync + 'static,
) {
    api.method(form, about, move |target: Target, arguments| {
        target.pipeline.note(arguments, |builder, _| {
            // A target that could not be declared has its mistake already.
            let mut targets = builder.desc.targets.iter_mut();
            targets
                .find(|found| Some(&found.name) == target.name.as_ref())
                .map_or(Ok(()), |found| body(found, arguments))
        });
        Ok(target)
    });
}
