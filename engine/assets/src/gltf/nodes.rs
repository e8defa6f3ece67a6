//! Nodes of glTF files, with their lights and cameras.

use std::ops::Range;

use glam::{Mat4, Quat, Vec3};
use lightbench_world::{Camera, Light, LightKind, Transform};

use super::{Document, Node};
use crate::obj::Problem;

/// Lumens of a watt of light at the eye's most sensitive wavelength (BIPM 2019): candela and lux
/// over it are W/sr and W/m².
const LUMENS_PER_WATT: f32 = 683.0;

/// The irradiance below which a light without a range counts as nothing, in W/m².
const LEAST_IRRADIANCE: f32 = 0.001;

/// The farthest that a light without a range reaches, in metres.
const FARTHEST: f32 = 1000.0;

/// Nodes by their number in the file.
pub(super) type Numbered = Vec<(usize, Node)>;

/// The nodes of the default scene, else of the first, else all; parents before their children.
pub(super) fn load(document: &mut Document, meshes: &[Range<usize>]) -> Result<Numbered, Problem> {
    let gltf = document.gltf.clone();
    let scene = gltf.default_scene().or_else(|| gltf.scenes().next());
    let mut open: Vec<(::gltf::Node, Option<usize>)> = match scene {
        Some(scene) => scene.nodes().map(|node| (node, None)).collect(),
        None => {
            let mut child = vec![false; gltf.nodes().len()];
            for node in gltf.nodes() {
                node.children()
                    .for_each(|below| child[below.index()] = true);
            }
            let top = gltf.nodes().filter(|node| !child[node.index()]);
            top.map(|node| (node, None)).collect()
        }
    };
    open.reverse();
    let mut seen = vec![false; gltf.nodes().len()];
    let mut nodes = Numbered::new();
    while let Some((source, parent)) = open.pop() {
        let number = source.index();
        if std::mem::replace(&mut seen[number], true) {
            return Err(document.problem(format!(
                "node {number} stands in the tree twice: it has two parents, or lies below itself"
            )));
        }
        let mut node = node(document, &source)?;
        node.parent = parent;
        node.meshes = source
            .mesh()
            .map_or(0..0, |mesh| meshes[mesh.index()].clone());
        let here = nodes.len();
        nodes.push((number, node));
        let children: Vec<_> = source.children().collect();
        open.extend(children.into_iter().rev().map(|child| (child, Some(here))));
    }
    Ok(nodes)
}

fn node(document: &mut Document, source: &::gltf::Node) -> Result<Node, Problem> {
    let number = source.index();
    if source.skin().is_some() {
        document.warn("skins are not supported; a skinned mesh stands as it was modelled");
    }
    let (translation, rotation, scale) = source.transform().decomposed();
    let transform = Transform {
        translation: Vec3::from(translation),
        rotation: Quat::from_array(rotation).normalize(),
        scale: Vec3::from(scale),
    };
    let finite = transform.translation.is_finite()
        && transform.rotation.is_finite()
        && transform.scale.is_finite();
    if !finite {
        let message = format!("the place of node {number} is infinite or not a number");
        return Err(document.problem(message));
    }
    let given = Mat4::from_cols_array_2d(&source.transform().matrix());
    let largest = given
        .to_cols_array()
        .into_iter()
        .fold(1.0, |a: f32, b| a.max(b.abs()));
    if !given.abs_diff_eq(Mat4::from(transform.matrix()), 1e-4 * largest) {
        document.warn(format!("the shear of node {number} is lost"));
    }
    let name = source.name().filter(|name| !name.is_empty());
    Ok(Node {
        name: name.map_or_else(|| format!("node {number}"), str::to_owned),
        transform,
        light: light(document, source)?,
        camera: camera(document, source)?,
        ..Node::default()
    })
}

fn light(document: &Document, source: &::gltf::Node) -> Result<Option<Light>, Problem> {
    use ::gltf::json::extensions::scene::khr_lights_punctual::Type;
    use ::gltf::json::validation::Checked;
    let Some(light) = source.light() else {
        return Ok(None);
    };
    let number = light.index();
    let problem = |what: &str| document.problem(format!("light {number} {what}"));
    let root = document.gltf.as_json();
    let listed = root
        .extensions
        .as_ref()
        .and_then(|e| e.khr_lights_punctual.as_ref());
    let json = listed.and_then(|listed| listed.lights.get(number));
    let json = json.ok_or_else(|| problem("is not there"))?;
    let intensity = light.intensity() / LUMENS_PER_WATT;
    let color = Vec3::from(light.color());
    let reach = (intensity.max(0.0) / LEAST_IRRADIANCE)
        .sqrt()
        .clamp(0.01, FARTHEST);
    let mut made = Light {
        kind: match json.type_ {
            Checked::Valid(Type::Directional) => LightKind::Directional,
            Checked::Valid(Type::Spot) => LightKind::Spot,
            Checked::Valid(Type::Point) => LightKind::Point,
            Checked::Invalid => return Err(problem("is of no known kind")),
        },
        color,
        intensity,
        range: light.range().unwrap_or(reach),
        ..Light::default()
    };
    if made.kind == LightKind::Spot {
        let cone = json
            .spot
            .as_ref()
            .ok_or_else(|| problem("is a spot without a cone"))?;
        made.inner_angle = 2.0 * cone.inner_cone_angle;
        made.outer_angle = 2.0 * cone.outer_cone_angle;
    }
    let angles = 0.0..=std::f32::consts::PI;
    let sound = color.is_finite()
        && color.min_element() >= 0.0
        && made.intensity.is_finite()
        && made.intensity >= 0.0
        && made.range.is_finite()
        && made.range > 0.0
        && angles.contains(&made.inner_angle)
        && angles.contains(&made.outer_angle);
    match sound {
        true => Ok(Some(made)),
        false => Err(problem("has a number that no light can have")),
    }
}

fn camera(document: &mut Document, source: &::gltf::Node) -> Result<Option<Camera>, Problem> {
    let Some(camera) = source.camera() else {
        return Ok(None);
    };
    let number = camera.index();
    let root = document.gltf.as_json();
    let json = root
        .cameras
        .get(number)
        .and_then(|camera| camera.perspective.as_ref());
    let Some(lens) = json else {
        document.warn("orthographic cameras are not supported");
        return Ok(None);
    };
    let made = Camera {
        fov_y: lens.yfov,
        near: lens.znear,
        far: lens.zfar.unwrap_or(f32::INFINITY),
        active: false,
    };
    let sound = made.fov_y > 0.001
        && made.fov_y < std::f32::consts::PI - 0.001
        && made.near > 0.0
        && made.near < made.far;
    match sound {
        true => Ok(Some(made)),
        false => {
            let message = format!("camera {number} has a number that no camera can have");
            Err(document.problem(message))
        }
    }
}
