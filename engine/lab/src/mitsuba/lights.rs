//! Lights: points, spots, directions and the sky.

use glam::DVec3;
use lightbench_world::{Light, LightKind, Name, World, WorldMatrix};

use super::xml::short;
use super::{Export, is_black};

impl Export<'_> {
    /// Writes all lights of a world.
    pub(super) fn lights(&mut self, world: &World) {
        let lights = world.columns::<Light>();
        let mut sky = DVec3::ZERO;
        for (row, entity) in lights.entities().iter().enumerate() {
            let light = lights.row(row);
            let strength = light.color.as_dvec3() * f64::from(light.intensity);
            if is_black(strength) || !light.visible {
                continue;
            }
            let name = world
                .get::<Name>(*entity)
                .map_or_else(String::new, |name| name.text);
            let matrix = world.get::<WorldMatrix>(*entity).unwrap_or_default().matrix;
            let position = matrix.translation.as_dvec3();
            let forward = -matrix.matrix3.z_axis.as_dvec3();
            let forward = forward.normalize_or(DVec3::NEG_Z);
            match light.kind {
                LightKind::Ambient => sky += strength,
                LightKind::Point => self.point_light(&name, position, strength),
                LightKind::Spot => self.spot_light(&name, &light, position, forward, strength),
                LightKind::Directional => self.directional_light(forward, strength),
            }
        }
        let shines = self.shines;
        let has_lamps = (0..lights.len()).any(|row| lights.row(row).kind != LightKind::Ambient);
        if shines && has_lamps {
            self.leave_out(
                "lamps behind surfaces that shine, such as their own glass: it hides them"
                    .to_owned(),
            );
        }
        if !is_black(sky) {
            self.xml.open("emitter", &[("type", "constant")]);
            self.xml.color("radiance", sky);
            self.xml.close();
        }
    }

    fn point_light(&mut self, name: &str, position: DVec3, intensity: DVec3) {
        self.leave_out(format!(
            "light `{name}`: that it fades to nothing at its range"
        ));
        self.xml.open("emitter", &[("type", "point")]);
        self.xml.point("position", position);
        self.xml.color("intensity", intensity);
        self.xml.close();
    }

    fn spot_light(
        &mut self,
        name: &str,
        light: &Light,
        position: DVec3,
        forward: DVec3,
        intensity: DVec3,
    ) {
        self.leave_out(format!(
            "light `{name}`: that it fades to nothing at its range"
        ));
        self.leave_out(format!(
            "light `{name}`: how its cone fades; Mitsuba's falls evenly with the angle"
        ));
        self.xml.open("emitter", &[("type", "spot")]);
        self.xml.look_at(
            position,
            position + forward,
            forward.any_orthonormal_vector(),
        );
        self.xml.color("intensity", intensity);
        let half = |angle: f32| f64::from(angle).to_degrees() * 0.5;
        let outer = half(light.outer_angle);
        self.xml.number("cutoff_angle", outer);
        self.xml
            .number("beam_width", half(light.inner_angle).min(outer));
        self.xml.close();
    }

    fn directional_light(&mut self, forward: DVec3, irradiance: DVec3) {
        self.xml.open("emitter", &[("type", "directional")]);
        let [x, y, z] = forward.to_array().map(short);
        let direction = [("name", "direction"), ("x", &x), ("y", &y), ("z", &z)];
        self.xml.empty("vector", &direction);
        self.xml.color("irradiance", irradiance);
        self.xml.close();
    }
}
