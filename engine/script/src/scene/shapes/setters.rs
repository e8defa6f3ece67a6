//! The methods that change the numbers of shapes.

use lightbench_world::glam::{UVec2, Vec2};

use super::{Kind, Shape, count, length};
use crate::api::{Api, Arguments, Mistake};

/// Registers a setter of some kinds of shape. `change` says whether the kind has it.
fn setter(
    api: &mut Api,
    form: &'static str,
    about: &'static str,
    change: impl Fn(&mut Kind, &Arguments) -> Result<bool, Mistake> + Send + Sync + 'static,
) {
    let name = form.split('(').next().unwrap_or(form);
    api.method(form, about, move |shape: Shape, a| {
        let mut plan = shape.lock();
        if !change(&mut plan.kind, a)? {
            return Err(Mistake::new(format!(
                "the shape `{}` has no `{name}`",
                plan.kind.name()
            )));
        }
        plan.changed(a);
        drop(plan);
        Ok(shape)
    });
}

pub(super) fn register(api: &mut Api) {
    api.method(
        "repeat(across, up)",
        "How often a texture repeats where it would be seen once: on flat and built shapes, in \
         each metre; on round ones and cloths, on the whole. Numbers below 1 stretch it.",
        |shape: Shape, a| {
            let times = [a.number_in(0, 1e-6, 1e6)?, a.number_in(1, 1e-6, 1e6)?];
            let mut plan = shape.lock();
            plan.repeat = Vec2::from(times.map(|times| times as f32));
            plan.changed(a);
            drop(plan);
            Ok(shape)
        },
    );
    setter(
        api,
        "segments(around)",
        "Pieces around the axis, or along each wedge of an arch, to 1024.",
        |kind, a| {
            let value = count(a, 0, 1)?;
            match kind {
                Kind::Sphere { segments, .. }
                | Kind::Cylinder { segments, .. }
                | Kind::Cone { segments, .. }
                | Kind::Torus { segments, .. }
                | Kind::Lathe { segments, .. } => *segments = value,
                Kind::Column(column) => column.segments = value,
                Kind::Arch(arch) => arch.segments = value,
                Kind::ArchedWall(wall) => wall.segments = value,
                _ => return Ok(false),
            }
            Ok(true)
        },
    );
    setter(
        api,
        "segments(first, second)",
        "Pieces in both directions, to 1024: around and from pole to pole of a sphere, around and \
         along of a column, around the axis and around the tube of a torus, along the sides of a \
         plane or a cloth.",
        |kind, a| {
            let (first, second) = (count(a, 0, 1)?, count(a, 1, 1)?);
            match kind {
                Kind::Plane { cells, .. } => *cells = UVec2::new(first, second),
                Kind::Sphere {
                    segments, rings, ..
                } => (*segments, *rings) = (first, second),
                Kind::Torus {
                    segments, sides, ..
                } => (*segments, *sides) = (first, second),
                Kind::Column(column) => (column.segments, column.rings) = (first, second),
                Kind::Cloth(cloth) => cloth.segments = [first, second],
                _ => return Ok(false),
            }
            Ok(true)
        },
    );
    setter(
        api,
        "subdivisions(times)",
        "How often each triangle of an icosphere is cut in four, 0 to 7.",
        |kind, a| {
            let times = a.whole(0, 0, 7)? as u32;
            let Kind::Icosphere { subdivisions, .. } = kind else {
                return Ok(false);
            };
            *subdivisions = times;
            Ok(true)
        },
    );
    setter(
        api,
        "span(degrees)",
        "The angle that an arch spans, 1 to 360.",
        |kind, a| {
            let angle = a.number_in(0, 1.0, 360.0)?.to_radians() as f32;
            let Kind::Arch(arch) = kind else {
                return Ok(false);
            };
            arch.span = angle;
            Ok(true)
        },
    );
    setter(
        api,
        "voussoirs(count)",
        "The wedges of an arch; odd for a keystone.",
        |kind, a| {
            let wedges = count(a, 0, 1)?;
            let Kind::Arch(arch) = kind else {
                return Ok(false);
            };
            arch.voussoirs = wedges;
            Ok(true)
        },
    );
    setter(
        api,
        "joint(metres)",
        "The joints between the wedges of an arch; 0 for none.",
        |kind, a| {
            let joint = length(a, 0)?;
            let Kind::Arch(arch) = kind else {
                return Ok(false);
            };
            arch.joint = joint;
            Ok(true)
        },
    );
    setter(
        api,
        "taper(share)",
        "The upper radius of a column as a share of the lower one, 0.1 to 1.",
        |kind, a| {
            let share = a.number_in(0, 0.1, 1.0)? as f32;
            let Kind::Column(column) = kind else {
                return Ok(false);
            };
            column.taper = share;
            Ok(true)
        },
    );
    setter(
        api,
        "flutes(count)",
        "The flutes of a column, 0 to 64; Doric 20.",
        |kind, a| {
            let flutes = a.whole(0, 0, 64)? as u32;
            let Kind::Column(column) = kind else {
                return Ok(false);
            };
            column.flutes = flutes;
            Ok(true)
        },
    );
    setter(
        api,
        "waves(count, depth)",
        "Waves across a cloth, and how deep they are at its lower edge, in metres.",
        |kind, a| {
            let (waves, depth) = (a.number_in(0, 0.0, 1000.0)? as f32, length(a, 1)?);
            let Kind::Cloth(cloth) = kind else {
                return Ok(false);
            };
            (cloth.waves, cloth.depth) = (waves, depth);
            Ok(true)
        },
    );
    setter(
        api,
        "sag(metres)",
        "How far the middle of a cloth's lower edge hangs below its ends.",
        |kind, a| {
            let sag = length(a, 0)?;
            let Kind::Cloth(cloth) = kind else {
                return Ok(false);
            };
            cloth.sag = sag;
            Ok(true)
        },
    );
    setter(
        api,
        "seed(number)",
        "Makes each cloth wave in its own way.",
        |kind, a| {
            let seed = a.whole(0, 0, i64::from(u32::MAX))? as u32;
            let Kind::Cloth(cloth) = kind else {
                return Ok(false);
            };
            cloth.seed = seed;
            Ok(true)
        },
    );
}
