//! The twin of `shaders/lib/g_buffer.wgsl`: surfaces in the texels of a G-buffer.

use std::f64::consts::PI;

use glam::DVec3;
use lightbench_assets::{Reflection, ReflectionModel};

use super::brdf::LEAST_ROUGHNESS;
use super::lighting::Surface;
use super::normals::{decode_octahedral, encode_octahedral};
use super::surface::surface_tangent;

/// Steps of the tangent's angle in half a turn.
const STEPS: f64 = 252.0;

/// One pixel of the G-buffer, as the targets hold it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texel {
    /// `g_albedo`: roots of the base colour, and gloss; 0 to 1 in steps of 1/255.
    pub albedo: [f64; 4],
    /// `g_normal`: octahedral.
    pub normal: [u16; 2],
    /// `g_specular`: roots of the specular colour, and gloss across the tangent.
    pub specular: [u8; 4],
    /// `g_model`: the number of the model; from Ward's on, the angle of the tangent.
    pub model: u8,
}

/// The texel of a surface.
pub fn pack(surface: &Surface) -> Texel {
    let normal = encode_octahedral(surface.normal);
    let code = |value: f64| (255.0 * value).round() as u8;
    let gloss = surface.reflection.lobe().map(|parameter| {
        let parameter = f64::from(parameter);
        match surface.reflection.model() {
            ReflectionModel::BlinnPhong | ReflectionModel::Phong => {
                parameter.clamp(1.0, 1448.0).log2() / 10.5
            }
            _ => parameter.clamp(LEAST_ROUGHNESS, 1.0).log2() / -5.25,
        }
    });
    let base = surface.base_color.to_array().map(f64::sqrt);
    let specular = surface.specular.to_array().map(f64::sqrt);
    let root = |value: f64| f64::from(code(value)) / 255.0;
    Texel {
        albedo: [base[0], base[1], base[2], gloss[0]].map(root),
        normal,
        specular: [specular[0], specular[1], specular[2], gloss[1]].map(code),
        model: pack_model(surface, normal),
    }
}

/// The surface of a texel, with its position and what it emits, which the G-buffer does not hold.
pub fn unpack(texel: &Texel, position: DVec3, emissive: DVec3) -> Surface {
    let normal = decode_octahedral(texel.normal);
    let root = |code: u8| f64::from(code) / 255.0;
    let gloss = [texel.albedo[3], root(texel.specular[3])];
    let power = (10.5 * gloss[0]).exp2() as f32;
    let [along, across] = gloss.map(|gloss| (-5.25 * gloss).exp2() as f32);
    let squared = |roots: [f64; 3]| DVec3::from_array(roots.map(|root| root * root));
    let [red, green, blue, _] = texel.albedo;
    let [specular @ .., _] = texel.specular;
    Surface {
        position,
        normal,
        base_color: squared([red, green, blue]),
        specular: squared(specular.map(root)),
        reflection: match texel.model {
            0 => Reflection::BlinnPhong { power },
            1 => Reflection::Phong { power },
            2 => Reflection::Beckmann { roughness: along },
            3 => Reflection::Ggx { roughness: along },
            _ => Reflection::Ward { along, across },
        },
        tangent: unpack_tangent(texel.model, normal),
        emissive,
    }
}

fn pack_model(surface: &Surface, normal: [u16; 2]) -> u8 {
    let model = surface.reflection.model();
    if model != ReflectionModel::Ward {
        return model as u8;
    }
    let kept = decode_octahedral(normal);
    let zero = surface_tangent(DVec3::ZERO, kept);
    let angle = surface
        .tangent
        .dot(kept.cross(zero))
        .atan2(surface.tangent.dot(zero));
    let step = ((angle / PI).rem_euclid(1.0) * STEPS).round() % STEPS;
    ReflectionModel::Ward as u8 + step as u8
}

fn unpack_tangent(model: u8, normal: DVec3) -> DVec3 {
    let zero = surface_tangent(DVec3::ZERO, normal);
    let step = model.saturating_sub(ReflectionModel::Ward as u8);
    let (sin, cos) = (f64::from(step) / STEPS * PI).sin_cos();
    cos * zero + sin * normal.cross(zero)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Directions that cover the sphere, and the axes, where frames like to break.
    fn normals() -> impl Iterator<Item = DVec3> {
        let spiral = (0..2000).map(|i| {
            let z = 1.0 - 2.0 * (f64::from(i) + 0.5) / 2000.0;
            let (sin, cos) = (f64::from(i) * 2.399_963_229_728_653).sin_cos();
            let radius = (1.0 - z * z).sqrt();
            DVec3::new(radius * cos, radius * sin, z)
        });
        spiral
            .chain([DVec3::X, DVec3::Y, DVec3::Z].map(|axis| -axis))
            .chain([
                DVec3::X,
                DVec3::Y,
                DVec3::Z,
                DVec3::new(1e-4, 1.0, 0.0).normalize(),
            ])
    }

    #[test]
    fn tangents_come_back_within_half_a_step() {
        let mut worst: f64 = 0.0;
        for (index, normal) in normals().enumerate() {
            let zero = surface_tangent(DVec3::ZERO, normal);
            assert!(zero.dot(normal).abs() < 1e-9 && zero.is_normalized());
            let (sin, cos) = (index as f64 * 0.7).sin_cos();
            let surface = Surface {
                position: DVec3::ZERO,
                normal,
                base_color: DVec3::ZERO,
                specular: DVec3::ONE,
                reflection: Reflection::Ward {
                    along: 0.5,
                    across: 0.1,
                },
                tangent: cos * zero + sin * normal.cross(zero),
                emissive: DVec3::ZERO,
            };
            let found = unpack(&pack(&surface), DVec3::ZERO, DVec3::ZERO);
            let angle = surface.tangent.angle_between(found.tangent);
            worst = worst.max(angle.min(PI - angle).to_degrees());
        }
        // Half of 180°/252, and what the normal's rounding adds.
        assert!(worst < 0.358 + 0.01, "{worst}");
    }

    #[test]
    fn each_model_comes_back_within_half_a_step_of_its_parameters() {
        for (reflection, steps) in [
            (Reflection::BlinnPhong { power: 33.0 }, 10.5),
            (Reflection::Phong { power: 900.0 }, 10.5),
            (Reflection::Beckmann { roughness: 0.0263 }, 5.25),
            (Reflection::Ggx { roughness: 0.31 }, 5.25),
            (
                Reflection::Ward {
                    along: 1.0,
                    across: 0.05,
                },
                5.25,
            ),
        ] {
            let surface = Surface {
                position: DVec3::ONE,
                normal: DVec3::new(0.6, 0.0, 0.8),
                base_color: DVec3::new(0.5, 0.02, 1.0),
                specular: DVec3::new(1.0, 0.04, 0.3),
                reflection,
                tangent: DVec3::Y,
                emissive: DVec3::ZERO,
            };
            let found = unpack(&pack(&surface), DVec3::ONE, DVec3::ZERO);
            assert_eq!(found.reflection.model(), reflection.model());
            let half_step = (steps / 255.0 / 2.0_f64).exp2() * 1.0001;
            let pairs = reflection.lobe().into_iter().zip(found.reflection.lobe());
            for (wanted, found) in pairs {
                let ratio = f64::from(found / wanted);
                assert!(
                    ratio < half_step && ratio > 1.0 / half_step,
                    "{reflection:?}: {ratio}"
                );
            }
            for (wanted, found) in [
                (surface.base_color, found.base_color),
                (surface.specular, found.specular),
            ] {
                let root_error = (wanted.powf(0.5) - found.powf(0.5)).abs().max_element();
                assert!(root_error <= 0.5 / 255.0 + 1e-9, "{wanted} {found}");
            }
        }
    }
}
