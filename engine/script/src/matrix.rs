//! Matrices of four rows and four columns, which place, turn, scale and project.
//!
//! A matrix stands left of what it is applied to, and of two the right one is applied first:
//! `parent * child * point`.

use lightbench_world::glam::dcamera::rh::proj::directx;
use lightbench_world::glam::dcamera::rh::view::look_to_mat4;
use lightbench_world::glam::{DMat4, DQuat, DVec3};

use crate::api::{Api, Mistake, ScriptType, as_number};
use crate::math::text;

impl ScriptType for DMat4 {
    const NAME: &'static str = "matrix";
}

pub(crate) fn register(api: &mut Api) {
    api.object::<DMat4>();
    makers(api);
    parts(api);
    api.method(
        "inverse()",
        "The matrix that takes everything back.",
        |m: DMat4, _| {
            let inverse = m.inverse();
            if inverse.is_finite() && m.determinant() != 0.0 {
                Ok(inverse)
            } else {
                Err(Mistake::new("the matrix has no inverse: it flattens space")
                    .with_hint("is one of the scales 0?"))
            }
        },
    );
    api.method("transpose()", "Rows become columns.", |m: DMat4, _| {
        Ok(m.transpose())
    });
    for form in ["point(x, y, z)", "point(point)"] {
        api.method(
            form,
            "Where the matrix takes a point, divided by its fourth coordinate as perspective needs.",
            |m: DMat4, a| Ok(m.project_point3(a.vector(0)?)),
        );
    }
    for form in ["direction(x, y, z)", "direction(vector)"] {
        api.method(
            form,
            "Where the matrix takes a direction, which has no place.",
            |m: DMat4, a| Ok(m.transform_vector3(a.vector(0)?)),
        );
    }
    let engine = api.engine();
    engine
        .register_fn("*", |a: DMat4, b: DMat4| a * b)
        .register_fn("*", |m: DMat4, point: DVec3| m.project_point3(point))
        .register_fn("+", |a: DMat4, b: DMat4| a + b)
        .register_fn("-", |a: DMat4, b: DMat4| a - b)
        .register_fn("==", |a: DMat4, b: DMat4| a == b)
        .register_fn("!=", |a: DMat4, b: DMat4| a != b);
    crate::math::scaling(engine, |m: DMat4, factor| m * factor);
    text(engine, |m: &DMat4| {
        let row = |index: usize| m.row(index).to_array().map(|v| v.to_string()).join(", ");
        format!("[{}]", [0, 1, 2, 3].map(row).join("; "))
    });
}

fn makers(api: &mut Api) {
    api.function("matrix()", "The matrix that changes nothing.", |_| {
        Ok(DMat4::IDENTITY)
    });
    for form in ["translation(x, y, z)", "translation(by)"] {
        api.function(form, "A matrix that moves, in metres.", |a| {
            a.vector(0).map(DMat4::from_translation)
        });
    }
    api.function(
        "rotation(turn)",
        "A matrix that turns, as `turn` says.",
        |a| Ok(DMat4::from_quat(a.object::<DQuat>(0)?)),
    );
    for form in ["scaling(factor)", "scaling(x, y, z)"] {
        api.function(form, "A matrix that scales along x, y and z.", |a| {
            let factors = match as_number(a.value(0)) {
                Some(_) if a.len() == 1 => DVec3::splat(a.number(0)?),
                _ => a.vector(0)?,
            };
            Ok(DMat4::from_scale(factors))
        });
    }
    api.function(
        "view_matrix(eye, target)",
        "From the world to the space of a camera at `eye` that looks at `target`: x to the right, y up, and \
         what is seen at negative z.",
        |a| {
            let (eye, target): (DVec3, DVec3) = (a.object(0)?, a.object(1)?);
            let toward = (target - eye).try_normalize().ok_or_else(|| {
                Mistake::new("`eye` and `target` of `view_matrix` are the same point")
            })?;
            // Straight up and down there is no horizon to keep level.
            let up = if toward.y.abs() > 0.999_999 { DVec3::Z } else { DVec3::Y };
            Ok(look_to_mat4(eye, toward, up))
        },
    );
    api.function(
        "perspective(degrees, aspect, near, far)",
        "From a camera's space to the picture: x and y from -1 to 1, depth from 0 at `near` to 1 at `far`. \
         `degrees` is the angle of view from bottom to top, `aspect` width over height.",
        |a| {
            let degrees = a.number_in(0, 1.0, 179.0)?;
            let aspect = a.number_in(1, 1e-3, 1e3)?;
            let near = a.number_in(2, 1e-6, f64::INFINITY)?;
            let far = a.number(3)?;
            if far <= near {
                return Err(Mistake::new(format!(
                    "`far` of `perspective` must be beyond `near`, {near}, not {far}"
                )));
            }
            Ok(directx::perspective(degrees.to_radians(), aspect, near, far))
        },
    );
}

fn parts(api: &mut Api) {
    api.getter("position", "Where it takes the origin.", |m: DMat4, _| {
        Ok(m.w_axis.truncate())
    });
    api.getter(
        "rotation",
        "How it turns, where it only moves, turns and scales.",
        |m: DMat4, _| Ok(m.to_scale_rotation_translation().1.normalize()),
    );
    api.getter(
        "size",
        "How it scales, where it only moves, turns and scales.",
        |m: DMat4, _| Ok(m.to_scale_rotation_translation().0),
    );
    api.getter(
        "determinant",
        "By how much it multiplies volumes; negative where it mirrors.",
        |m: DMat4, _| Ok(m.determinant()),
    );
    api.method(
        "at(row, column)",
        "One of its numbers; row and column from 0 to 3.",
        |m: DMat4, a| {
            let (row, column) = (a.whole(0, 0, 3)?, a.whole(1, 0, 3)?);
            Ok(m.row(row as usize)[column as usize])
        },
    );
}

#[cfg(test)]
mod tests {
    use crate::testing::{printed, value};

    #[test]
    fn the_right_matrix_comes_first() {
        let script = "
            let m = translation(1, 2, 3) * rotation(turn(0, 90, 0)) * scaling(2);
            let p = m * vec3(1, 0, 0);
            print(p.x); print(p.y); print(p.z);
            print(m.at(1, 3)); print(m.determinant); print(m.size.y); print(m.rotation.angles.y);
            let back = m.inverse() * p;
            print(back.x); print(back.y);
            print(m.direction(0, 0, 1).x);";
        // x turned by 90 degrees about y is -z (right-handed), doubled: (1, 2, 3 - 2).
        let expected = [1.0, 2.0, 1.0, 2.0, 8.0, 2.0, 90.0, 1.0, 0.0, 2.0];
        for (found, expected) in printed(script).into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
    }

    #[test]
    fn perspective_takes_near_to_0_and_far_to_1() {
        let seen = "perspective(90, 2, 0.5, 10) * view_matrix(vec3(0, 0, 4), vec3(0, 0, 0))";
        let depth = |z: f64| value(&format!("({seen} * vec3(0, 0, {z:?})).z"));
        assert!(depth(3.5).abs() < 1e-12);
        assert!((depth(-6.0) - 1.0).abs() < 1e-12);
        // At 2 m, 90 degrees see 2 m up and 4 m to the right.
        assert!((value(&format!("({seen} * vec3(4, 0, 2)).x")) - 1.0).abs() < 1e-12);
        assert!((value(&format!("({seen} * vec3(0, 2, 2)).y")) - 1.0).abs() < 1e-12);
    }
}
