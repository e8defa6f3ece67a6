//! Numbers, vectors and rotations.
//!
//! Rhai's own functions take `1.0` where a person writes `1`; here every one of them takes both.
//! `sin` and its kin work in radians, as in mathematics; what turns entities takes degrees.

use lightbench_world::glam::dcamera::rh::view::look_to_quat;
use lightbench_world::glam::{DQuat, DVec3, EulerRot};
use rhai::Engine;

use crate::api::{Api, Arguments, Mistake, ScriptType};

impl ScriptType for DVec3 {
    const NAME: &'static str = "vec3";
}

impl ScriptType for DQuat {
    const NAME: &'static str = "quat";
}

pub(crate) fn register(api: &mut Api) {
    numbers(api);
    vectors(api);
    quaternions(api);
}

impl Arguments<'_, '_, '_, '_> {
    /// A vector from the arguments at `index`: one vector, or three numbers.
    pub(crate) fn vector(&self, index: usize) -> Result<DVec3, Mistake> {
        if self.len() >= index + 3 {
            return Ok(DVec3::new(
                self.number(index)?,
                self.number(index + 1)?,
                self.number(index + 2)?,
            ));
        }
        let vector: DVec3 = self.object(index)?;
        if vector.is_finite() {
            Ok(vector)
        } else {
            Err(Mistake::new("the vector is infinite or not a number")
                .with_hint("did something divide by zero?"))
        }
    }
}

/// A function of one number, by name.
pub(crate) type Unary = (&'static str, &'static str, fn(f64) -> f64);

/// The functions of one number.
pub(crate) const UNARY: [Unary; 20] = [
    ("sin(angle)", "The sine of an angle in radians.", f64::sin),
    ("cos(angle)", "The cosine of an angle in radians.", f64::cos),
    (
        "tan(angle)",
        "The tangent of an angle in radians.",
        f64::tan,
    ),
    (
        "asin(x)",
        "The angle in radians whose sine is x.",
        f64::asin,
    ),
    (
        "acos(x)",
        "The angle in radians whose cosine is x.",
        f64::acos,
    ),
    (
        "atan(x)",
        "The angle in radians whose tangent is x.",
        f64::atan,
    ),
    ("sinh(x)", "The hyperbolic sine.", f64::sinh),
    ("cosh(x)", "The hyperbolic cosine.", f64::cosh),
    ("tanh(x)", "The hyperbolic tangent.", f64::tanh),
    ("sqrt(x)", "The square root.", f64::sqrt),
    ("exp(x)", "e to the power of x.", f64::exp),
    ("ln(x)", "The natural logarithm.", f64::ln),
    ("log(x)", "The logarithm to the base 10.", f64::log10),
    ("log2(x)", "The logarithm to the base 2.", f64::log2),
    ("floor(x)", "The next whole number below.", f64::floor),
    ("ceiling(x)", "The next whole number above.", f64::ceil),
    ("round(x)", "The nearest whole number.", f64::round),
    ("fraction(x)", "What stands behind the point.", f64::fract),
    (
        "to_radians(degrees)",
        "Degrees to radians.",
        f64::to_radians,
    ),
    (
        "to_degrees(radians)",
        "Radians to degrees.",
        f64::to_degrees,
    ),
];

fn numbers(api: &mut Api) {
    for (form, about, function) in UNARY {
        api.overload(form, about, move |arguments| {
            Ok(function(arguments.number(0)?))
        });
    }
    api.overload(
        "atan(y, x)",
        "The angle of the direction (x, y), in radians.",
        |a| Ok(a.number(0)?.atan2(a.number(1)?)),
    );
    api.overload("hypot(x, y)", "The length of (x, y).", |a| {
        Ok(a.number(0)?.hypot(a.number(1)?))
    });
    api.function("pow(x, exponent)", "x to the power of an exponent.", |a| {
        Ok(a.number(0)?.powf(a.number(1)?))
    });
    api.function(
        "lerp(a, b, t)",
        "Goes from a (t = 0) to b (t = 1) evenly.",
        |arguments| {
            let t = arguments.number(2)?;
            if let Some(a) = arguments.try_object::<DVec3>(0) {
                return Ok(rhai::Dynamic::from(a.lerp(arguments.object(1)?, t)));
            }
            if let Some(a) = arguments.try_object::<DQuat>(0) {
                return Ok(rhai::Dynamic::from(a.slerp(arguments.object(1)?, t)));
            }
            if let Some(a) = arguments.try_object::<crate::color::Color>(0) {
                return Ok(rhai::Dynamic::from(a.lerp(arguments.object(1)?, t)));
            }
            let (a, b) = (arguments.number(0)?, arguments.number(1)?);
            Ok(rhai::Dynamic::from(a + (b - a) * t))
        },
    );
    api.function(
        "clamp(x, min, max)",
        "Keeps a number between two others.",
        |a| {
            let (x, min, max) = (a.number(0)?, a.number(1)?, a.number(2)?);
            if min > max {
                return Err(Mistake::new(format!(
                    "`min` ({min}) is larger than `max` ({max})"
                )));
            }
            Ok(x.clamp(min, max))
        },
    );
    api.function(
        "smoothstep(from, to, x)",
        "0 below `from`, 1 above `to`, and a soft way between.",
        |a| {
            let (from, to, x) = (a.number(0)?, a.number(1)?, a.number(2)?);
            Ok(smoothstep(from, to, x))
        },
    );
    api.function(
        "modulo(x, period)",
        "What remains of x, from 0 up to the period.",
        |a| {
            let period = a.number_in(1, f64::MIN_POSITIVE, f64::INFINITY)?;
            Ok(a.number(0)?.rem_euclid(period))
        },
    );
}

/// A soft step from 0 to 1.
pub(crate) fn smoothstep(from: f64, to: f64, x: f64) -> f64 {
    if from == to {
        return if x < from { 0.0 } else { 1.0 };
    }
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn vectors(api: &mut Api) {
    api.object::<DVec3>();
    api.function("vec3(x, y, z)", "A vector, or a point in metres.", |a| {
        a.vector(0)
    });
    api.function("vec3(all)", "A vector of three equal numbers.", |a| {
        Ok(DVec3::splat(a.number(0)?))
    });
    for (index, name) in ["x", "y", "z"].into_iter().enumerate() {
        api.getter(name, "A part of the vector.", move |v: DVec3, _| {
            Ok(v[index])
        });
        api.setter(name, move |v: &mut DVec3, a| {
            v[index] = a.number(0)?;
            Ok(())
        });
    }
    api.method("dot(other)", "The dot product.", |v: DVec3, a| {
        Ok(v.dot(a.object(0)?))
    });
    api.method("cross(other)", "The cross product.", |v: DVec3, a| {
        Ok(v.cross(a.object(0)?))
    });
    api.method("length()", "The length.", |v: DVec3, _| Ok(v.length()));
    api.method(
        "distance(other)",
        "The distance to another point.",
        |v: DVec3, a| Ok(v.distance(a.object(0)?)),
    );
    api.method(
        "normalize()",
        "The vector of length 1 in the same direction; zero stays zero.",
        |v: DVec3, _| Ok(v.normalize_or_zero()),
    );
    api.method("abs()", "The vector without signs.", |v: DVec3, _| {
        Ok(v.abs())
    });
    api.method("min(other)", "The smaller of each part.", |v: DVec3, a| {
        Ok(v.min(a.object(0)?))
    });
    api.method("max(other)", "The larger of each part.", |v: DVec3, a| {
        Ok(v.max(a.object(0)?))
    });
    let engine = api.engine();
    engine
        .register_fn("+", |a: DVec3, b: DVec3| a + b)
        .register_fn("-", |a: DVec3, b: DVec3| a - b)
        .register_fn("*", |a: DVec3, b: DVec3| a * b)
        .register_fn("/", |a: DVec3, b: DVec3| a / b)
        .register_fn("-", |a: DVec3| -a)
        .register_fn("==", |a: DVec3, b: DVec3| a == b)
        .register_fn("!=", |a: DVec3, b: DVec3| a != b);
    scaling(engine, |a: DVec3, factor| a * factor);
    text(engine, |v: &DVec3| format!("({}, {}, {})", v.x, v.y, v.z));
}

/// `value * number`, `number * value` and `value / number`, for whole numbers too.
pub(crate) fn scaling<T: ScriptType>(engine: &mut Engine, scale: fn(T, f64) -> T) {
    engine
        .register_fn("*", move |a: T, factor: f64| scale(a, factor))
        .register_fn("*", move |a: T, factor: i64| scale(a, factor as f64))
        .register_fn("*", move |factor: f64, a: T| scale(a, factor))
        .register_fn("*", move |factor: i64, a: T| scale(a, factor as f64))
        .register_fn("/", move |a: T, divisor: f64| scale(a, 1.0 / divisor))
        .register_fn("/", move |a: T, divisor: i64| {
            scale(a, 1.0 / divisor as f64)
        });
}

/// How `print` shows a value.
pub(crate) fn text<T: ScriptType>(engine: &mut Engine, show: fn(&T) -> String) {
    engine
        .register_fn("to_string", move |value: &mut T| show(value))
        .register_fn("to_debug", move |value: &mut T| show(value));
}

/// Turns about y, then x, then z, in degrees.
pub(crate) fn from_degrees(angles: DVec3) -> DQuat {
    DQuat::from_euler(
        EulerRot::YXZ,
        angles.y.to_radians(),
        angles.x.to_radians(),
        angles.z.to_radians(),
    )
}

fn quaternions(api: &mut Api) {
    api.object::<DQuat>();
    api.function(
        "turn(x, y, z)",
        "A rotation by angles in degrees: x up and down, y left and right, z roll. They are applied in the order \
         y, x, z. `turn(90, 0, 0)` stands a plane upright, with its face to the viewer.",
        |a| Ok(from_degrees(a.vector(0)?)),
    );
    api.function(
        "turn(axis, degrees)",
        "A rotation about an axis, in degrees.",
        |a| {
            let axis = a.vector(0)?;
            let degrees = a.number(1)?;
            let axis = axis
                .try_normalize()
                .ok_or_else(|| Mistake::new("the axis of a rotation can't be zero"))?;
            Ok(DQuat::from_axis_angle(axis, degrees.to_radians()))
        },
    );
    api.function(
        "turn_toward(direction)",
        "The rotation that points what looks along -z, as cameras and spot lights do, in a direction, with \
         its up side up.",
        |a| {
            let toward: DVec3 = a.object(0)?;
            let toward = toward
                .try_normalize()
                .ok_or_else(|| Mistake::new("there is no turning toward a direction of length 0"))?;
            // Straight up and down no side is up.
            let up = if toward.y.abs() > 0.999_999 { DVec3::Z } else { DVec3::Y };
            Ok(look_to_quat(toward, up).inverse())
        },
    );
    api.getter(
        "axis",
        "The axis about which it turns, of length 1; x where it does not turn.",
        |q: DQuat, _| Ok(q.to_axis_angle().0),
    );
    api.getter(
        "angle",
        "How far it turns about its axis, in degrees from 0 to 360.",
        |q: DQuat, _| Ok(q.to_axis_angle().1.to_degrees()),
    );
    api.method("inverse()", "The rotation back.", |q: DQuat, _| {
        Ok(q.inverse())
    });
    for form in ["apply(x, y, z)", "apply(vector)"] {
        api.method(form, "The vector after the rotation.", |q: DQuat, a| {
            Ok(q * a.vector(0)?)
        });
    }
    api.getter(
        "angles",
        "The rotation as degrees about x, y and z, as `turn` takes them.",
        |q: DQuat, _| {
            let (y, x, z) = q.to_euler(EulerRot::YXZ);
            Ok(DVec3::new(x.to_degrees(), y.to_degrees(), z.to_degrees()))
        },
    );
    let engine = api.engine();
    engine
        .register_fn("*", |a: DQuat, b: DQuat| (a * b).normalize())
        .register_fn("*", |q: DQuat, v: DVec3| q * v)
        .register_fn("==", |a: DQuat, b: DQuat| a == b)
        .register_fn("!=", |a: DQuat, b: DQuat| a != b);
    text(engine, |q: &DQuat| {
        format!("quat({}, {}, {}, {})", q.x, q.y, q.z, q.w)
    });
}
