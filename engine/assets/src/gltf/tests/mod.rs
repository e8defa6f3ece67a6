#![allow(clippy::unwrap_used)]
use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::{Quat, Vec2, Vec3, Vec4};
use lightbench_world::curve::Interpolation;
use lightbench_world::{LightKind, MaterialId};

use super::*;
use crate::{MeshError, Reflection, TextureId};

mod damaged;

/// Bytes of numbers, one behind the other.
#[derive(Clone, Default)]
struct Bytes(Vec<u8>);

impl Bytes {
    fn floats(mut self, numbers: &[f32]) -> Self {
        self.0.extend(numbers.iter().flat_map(|n| n.to_le_bytes()));
        self
    }
    fn shorts(mut self, numbers: &[u16]) -> Self {
        self.0.extend(numbers.iter().flat_map(|n| n.to_le_bytes()));
        self
    }
    fn uri(&self) -> String {
        let data = STANDARD.encode(&self.0);
        format!("data:application/octet-stream;base64,{data}")
    }
}

/// A triangle: three positions from byte 0, three indices from byte 36, padded to 44.
fn triangle() -> Bytes {
    Bytes::default()
        .floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0])
        .shorts(&[0, 1, 2, 0])
}

const VIEWS: &str = r#"{"buffer": 0, "byteOffset": 0, "byteLength": 36},
    {"buffer": 0, "byteOffset": 36, "byteLength": 6}"#;
const ACCESSORS: &str = r#"
    {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
     "min": [0, 0, 0], "max": [1, 1, 0]},
    {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}"#;

/// A file with one triangle as `triangle`, and more on the top level.
fn with_triangle(buffer: &str, more: &str) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "buffers": [{{"byteLength": 44{buffer}}}],
        "bufferViews": [{VIEWS}], "accessors": [{ACCESSORS}],
        "meshes": [{{"name": "leaf", "primitives": [
            {{"attributes": {{"POSITION": 0}}, "indices": 1{} }}]}}]{more}}}"#,
        if more.contains("\"materials\"") {
            ", \"material\": 0"
        } else {
            ""
        }
    )
}

fn embedded(more: &str) -> String {
    with_triangle(&format!(", \"uri\": \"{}\"", triangle().uri()), more)
}

fn files(list: &[(&str, &[u8])]) -> (tempfile::TempDir, Files) {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in list {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }
    let files = Files::with_project(folder.path()).unwrap();
    (folder, files)
}

fn read(text: &str) -> Result<GltfScene, ModelError> {
    let (_folder, files) = files(&[("a/x.gltf", text.as_bytes())]);
    load(&files, &Reuse::default(), "a/x.gltf", &Progress::new())
}

fn good(text: &str) -> GltfScene {
    read(text).unwrap_or_else(|error| panic!("{error}"))
}

/// A binary file of a text and a buffer (glTF 2.0, section 4.4).
fn glb(text: &str, binary: &[u8]) -> Vec<u8> {
    let mut text = text.as_bytes().to_vec();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut binary = binary.to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let mut file = b"glTF".to_vec();
    let length = 12 + 8 + text.len() + 8 + binary.len();
    for number in [2, length as u32, text.len() as u32, 0x4e4f_534a] {
        file.extend(number.to_le_bytes());
    }
    file.extend(&text);
    file.extend((binary.len() as u32).to_le_bytes());
    file.extend(0x004e_4942_u32.to_le_bytes());
    file.extend(binary);
    file
}

fn nodes(list: &str) -> String {
    format!(r#", "nodes": [{list}], "scenes": [{{"nodes": [0]}}], "scene": 0"#)
}

#[test]
fn buffers_lie_inside_beside_and_in_the_text() {
    let expected = good(&embedded(&nodes(r#"{"mesh": 0}"#))).model.meshes;
    assert_eq!(expected.len(), 1);
    let (mesh, material) = &expected[0];
    assert_eq!((mesh.name.as_str(), *material), ("leaf", MaterialId(0)));
    assert_eq!(mesh.indices, [0, 1, 2]);
    // Flat normals where the file has none.
    assert_eq!(mesh.normals, [Vec3::Z; 3]);
    assert_eq!(mesh.validate(), Ok::<(), MeshError>(()));

    let beside = with_triangle(r#", "uri": "bin/the%20data.bin""#, &nodes(r#"{"mesh": 0}"#));
    let binary = glb(&with_triangle("", &nodes(r#"{"mesh": 0}"#)), &triangle().0);
    let (_folder, files) = files(&[
        ("a/x.gltf", beside.as_bytes()),
        ("a/bin/the data.bin", &triangle().0),
        ("x.glb", &binary),
    ]);
    for path in ["a/x.gltf", "x.glb"] {
        let scene = load(&files, &Reuse::default(), path, &Progress::new()).unwrap();
        let [(read, number)] = scene.model.meshes.as_slice() else {
            panic!("{path}: {:?}", scene.model.meshes);
        };
        assert_eq!((&read.value, number), (&mesh.value, material), "{path}");
        assert_eq!(scene.nodes[0].meshes, 0..1);
    }
}

#[test]
fn nodes_keep_their_tree_and_places() {
    let list = r#"
        {"name": "root", "translation": [1, 2, 3], "children": [2, 1]},
        {"name": "second", "rotation": [0, 0.70710678, 0, 0.70710678], "mesh": 0},
        {"scale": [2, 2, 2], "children": [3]},
        {"matrix": [0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 5, 6, 7, 1]}"#;
    let scene = good(&embedded(&nodes(list)));
    let names: Vec<_> = scene
        .nodes
        .iter()
        .map(|node| (&*node.name, node.parent))
        .collect();
    let expected = [
        ("root", None),
        ("node 2", Some(0)),
        ("node 3", Some(1)),
        ("second", Some(0)),
    ];
    assert_eq!(names, expected);
    assert_eq!(
        scene.nodes[0].transform.translation,
        Vec3::new(1.0, 2.0, 3.0)
    );
    let turned = scene.nodes[3].transform.rotation;
    assert!(turned.abs_diff_eq(Quat::from_rotation_y(FRAC_PI_2), 1e-6));
    // A quarter turn about y, twice as large.
    let matrix = scene.nodes[2].transform;
    assert!(matrix.scale.abs_diff_eq(Vec3::splat(2.0), 1e-5));
    assert!((matrix.rotation * Vec3::X).abs_diff_eq(Vec3::NEG_Z, 1e-5));
    assert_eq!(matrix.translation, Vec3::new(5.0, 6.0, 7.0));
    assert!(
        scene.model.warnings.is_empty(),
        "{:?}",
        scene.model.warnings
    );
}

#[test]
fn attributes_are_read_in_every_form() {
    // Interleaved positions and normals, normalised texture coordinates, given tangents, a strip.
    let mut bytes = Bytes::default();
    for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
        bytes = bytes.floats(&[x, y, 0.0, 0.0, 0.0, 4.0]);
    }
    for _ in 0..4 {
        bytes = bytes.floats(&[2.0, 0.0, 0.0, -1.0]);
    }
    bytes = bytes.shorts(&[0, 0, 65535, 0, 0, 65535, 65535, 65535]);
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "buffers": [{{"byteLength": {}, "uri": "{}"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 96, "byteStride": 24}},
            {{"buffer": 0, "byteOffset": 96, "byteLength": 64}},
            {{"buffer": 0, "byteOffset": 160, "byteLength": 16}}],
        "accessors": [
            {{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}},
            {{"bufferView": 0, "byteOffset": 12, "componentType": 5126, "count": 4, "type": "VEC3"}},
            {{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC4"}},
            {{"bufferView": 2, "componentType": 5123, "normalized": true, "count": 4, "type": "VEC2"}}],
        "meshes": [{{"primitives": [{{"mode": 5, "attributes":
            {{"POSITION": 0, "NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3}} }}]}}]}}"#,
        bytes.0.len(),
        bytes.uri()
    );
    let scene = good(&text);
    let mesh = &scene.model.meshes[0].0;
    assert_eq!(mesh.indices, [0, 1, 2, 2, 1, 3]);
    assert_eq!(mesh.normals, [Vec3::Z; 4]);
    assert_eq!(mesh.tangents, [Vec4::new(1.0, 0.0, 0.0, -1.0); 4]);
    assert_eq!(mesh.uvs[3], Vec2::ONE);
    assert!((mesh.area() - 1.0).abs() < 1e-6);
}

#[test]
fn sparse_accessors_overwrite() {
    let bytes = triangle().floats(&[0.0, 0.0, 9.0]);
    let text = embedded("").replace(&triangle().uri(), &bytes.uri());
    let text = text
        .replace("\"byteLength\": 44", "\"byteLength\": 56")
        .replace(
            r#""max": [1, 1, 0]}"#,
            r#""max": [1, 1, 9], "sparse": {"count": 1,
            "indices": {"bufferView": 1, "byteOffset": 4, "componentType": 5123},
            "values": {"bufferView": 2}}}"#,
        );
    let views = format!("{VIEWS}, {{\"buffer\": 0, \"byteOffset\": 44, \"byteLength\": 12}}");
    let scene = good(&text.replace(VIEWS, &views));
    assert_eq!(
        scene.model.meshes[0].0.positions[2],
        Vec3::new(0.0, 0.0, 9.0)
    );
}

/// A picture of one pixel.
fn png(rgba: [u8; 4]) -> Vec<u8> {
    crate::images::encode_png("x.png", 1, 1, &rgba).unwrap()
}

#[test]
fn materials_are_mapped_as_the_table_says() {
    let metal = png([0, 128, 255, 255]);
    let data = format!("data:image/png;base64,{}", STANDARD.encode(&metal));
    let more = format!(
        r#", "materials": [
            {{"name": "paint", "pbrMetallicRoughness": {{"baseColorFactor": [0.8, 0.4, 0.2, 1],
                "metallicFactor": 0, "roughnessFactor": 0.5, "baseColorTexture": {{"index": 0}} }},
              "normalTexture": {{"index": 0}}, "doubleSided": true,
              "alphaMode": "MASK", "alphaCutoff": 0.25}},
            {{"pbrMetallicRoughness": {{"baseColorFactor": [0.5, 0.4, 0.3, 1],
                "metallicRoughnessTexture": {{"index": 1}} }},
              "emissiveFactor": [1, 0.5, 0],
              "extensions": {{"KHR_materials_emissive_strength": {{"emissiveStrength": 4}} }} }},
            {{"alphaMode": "BLEND", "pbrMetallicRoughness": {{"roughnessFactor": 0, "metallicFactor": 0}} }}],
          "extensionsUsed": ["KHR_materials_emissive_strength"],
          "textures": [{{"source": 0}}, {{"source": 1}}],
          "images": [{{"uri": "p.png"}}, {{"uri": "{data}"}}]"#
    );
    let text = embedded(&more);
    let (_folder, files) = files(&[
        ("a/x.gltf", text.as_bytes()),
        ("a/p.png", &png([255, 0, 0, 255])),
    ]);
    let scene = load(&files, &Reuse::default(), "a/x.gltf", &Progress::new()).unwrap();
    let [paint, metal, glass] = scene.model.materials.as_slice() else {
        panic!("{:?}", scene.model.materials);
    };
    assert_eq!((paint.name.as_str(), paint.two_sided), ("paint", true));
    assert_eq!(paint.base_color, Vec3::new(0.8, 0.4, 0.2));
    assert_eq!(paint.specular, Vec3::splat(0.04));
    assert_eq!(paint.alpha_cutoff, Some(0.25));
    assert_eq!(paint.reflection, Reflection::Ggx { roughness: 0.25 });
    // Once as colours, once as numbers.
    assert_eq!(paint.base_color_texture, Some(TextureId(1)));
    assert_eq!(paint.normal_texture, Some(TextureId(2)));
    assert_eq!(scene.model.textures.len(), 2);
    // The mean of blue is full metal: it scatters nothing and mirrors its base colour.
    assert_eq!(metal.base_color, Vec3::ZERO);
    assert!(metal.specular.abs_diff_eq(Vec3::new(0.5, 0.4, 0.3), 1e-6));
    let Reflection::Ggx { roughness } = metal.reflection else {
        panic!("{:?}", metal.reflection);
    };
    assert!((roughness - (128.0_f32 / 255.0).powi(2)).abs() < 1e-6);
    assert_eq!(metal.emissive, Vec3::new(4.0, 2.0, 0.0));
    let least = *Reflection::ROUGHNESS_RANGE.start();
    assert_eq!(glass.reflection, Reflection::Ggx { roughness: least });
    let warnings: Vec<_> = scene.model.warnings.iter().map(|w| w.to_string()).collect();
    assert!(
        warnings.iter().any(|w| w.contains("drawn opaque")),
        "{warnings:?}"
    );
    assert!(
        warnings.iter().any(|w| w.contains("with their mean")),
        "{warnings:?}"
    );
    assert_eq!(scene.model.meshes[0].1, MaterialId(1));
}

/// Of 188 and 188 the mean is 0.503 in linear light; of the values as stored it would be 0.737.
#[test]
fn metals_mirror_the_mean_colour_of_their_texture() {
    let checks: Vec<u8> = [[188, 0, 0, 255], [188, 255, 255, 255]].concat();
    let picture = crate::images::encode_png("x.png", 2, 1, &checks).unwrap();
    let data = format!("data:image/png;base64,{}", STANDARD.encode(&picture));
    let more = format!(
        r#", "materials": [
            {{"pbrMetallicRoughness": {{"baseColorFactor": [1, 0.5, 1, 1],
                "baseColorTexture": {{"index": 0}} }} }},
            {{"pbrMetallicRoughness": {{"metallicFactor": 0, "baseColorTexture": {{"index": 0}} }} }}],
          "textures": [{{"source": 0}}], "images": [{{"uri": "{data}"}}]"#
    );
    let model = good(&embedded(&more)).model;
    let [metal, paint] = model.materials.as_slice() else {
        panic!("{:?}", model.materials);
    };
    assert!(
        metal
            .specular
            .abs_diff_eq(Vec3::new(0.502_886, 0.25, 0.5), 1e-5),
        "{}",
        metal.specular
    );
    assert_eq!(paint.specular, Vec3::splat(0.04));
    let warnings: Vec<_> = model.warnings.iter().map(|w| w.to_string()).collect();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(warnings[0].contains("mean colour"), "{warnings:?}");
}

#[test]
fn a_missing_picture_is_a_warning() {
    let more = r#", "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}], "images": [{"uri": "../../secret.png"}]"#;
    let scene = good(&embedded(more));
    let material = &scene.model.materials[0];
    assert_eq!(material.base_color_texture, Some(TextureId::PLACEHOLDER));
    let warning = scene.model.warnings[0].to_string();
    assert!(
        warning.contains("x.gltf") && warning.contains("image 0"),
        "{warning}"
    );
}

#[test]
fn lights_and_cameras_change_their_units() {
    let list = r#"
        {"children": [1, 2, 3, 4]},
        {"extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"extensions": {"KHR_lights_punctual": {"light": 1}}},
        {"extensions": {"KHR_lights_punctual": {"light": 2}}},
        {"camera": 0}"#;
    let more = r#", "extensionsUsed": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual":
        {"lights": [{"type": "point", "intensity": 683, "color": [1, 0.5, 0]},
            {"type": "spot", "intensity": 1366, "range": 7,
             "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.785398}},
            {"type": "directional", "intensity": 68.3}]}},
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.2}}]"#;
    let scene = good(&embedded(&format!("{}{more}", nodes(list))));
    let [point, spot, sun] = [1, 2, 3].map(|node: usize| scene.nodes[node].light.unwrap());
    assert_eq!((point.kind, point.intensity), (LightKind::Point, 1.0));
    // 1 W/sr lays 0.001 W/m² at √1000 m.
    assert!((point.range - 1000_f32.sqrt()).abs() < 1e-3);
    assert_eq!(point.color, Vec3::new(1.0, 0.5, 0.0));
    assert_eq!(
        (spot.kind, spot.range, spot.inner_angle),
        (LightKind::Spot, 7.0, 0.5)
    );
    assert!((spot.outer_angle - 2.0 * FRAC_PI_4).abs() < 1e-5);
    assert_eq!(sun.kind, LightKind::Directional);
    assert!((sun.intensity - 0.1).abs() < 1e-6);
    let camera = scene.nodes[4].camera.unwrap();
    assert_eq!(
        (camera.fov_y, camera.near, camera.far),
        (0.9, 0.2, f32::INFINITY)
    );
    assert!(!camera.active);
}

/// A file whose node 0 is animated by these samplers and channels over one buffer of floats.
fn animated(floats: &[f32], accessors: &str, animation: &str) -> String {
    let bytes = Bytes::default().floats(floats);
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "nodes": [{{"name": "a"}}, {{"name": "b"}}],
        "scenes": [{{"nodes": [0, 1]}}],
        "buffers": [{{"byteLength": {length}, "uri": "{}"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": {length}}}],
        "accessors": [{accessors}], "animations": [{animation}]}}"#,
        bytes.uri(),
        length = bytes.0.len()
    )
}

fn accessor(first: usize, count: usize, kind: &str) -> String {
    format!(
        r#"{{"bufferView": 0, "byteOffset": {}, "componentType": 5126, "count": {count},
            "type": "{kind}", "min": [0], "max": [9]}}"#,
        4 * first
    )
}

#[test]
fn animations_run_as_their_samplers_say() {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let mut floats = vec![0.0, 1.0, 2.0];
    floats.extend([0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 4.0, 2.0, 0.0]);
    floats.extend([0.0, 0.0, 0.0, 1.0, 0.0, half, 0.0, half]);
    // In tangent, value, out tangent: p(t) = t² with its slopes.
    floats.extend([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    floats.extend([2.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
    let accessors = [
        accessor(0, 3, "SCALAR"),
        accessor(3, 3, "VEC3"),
        accessor(0, 2, "SCALAR"),
        accessor(12, 2, "VEC4"),
        accessor(20, 6, "VEC3"),
    ];
    let animation = r#"{"samplers": [
            {"input": 0, "output": 1, "interpolation": "STEP"},
            {"input": 2, "output": 3},
            {"input": 2, "output": 4, "interpolation": "CUBICSPLINE"}],
        "channels": [
            {"sampler": 0, "target": {"node": 0, "path": "translation"}},
            {"sampler": 1, "target": {"node": 1, "path": "rotation"}},
            {"sampler": 2, "target": {"node": 1, "path": "scale"}}]}"#;
    let scene = good(&animated(&floats, &accessors.join(","), animation));
    let [a, b] = [0, 1].map(|node: usize| scene.nodes[node].animation.clone().unwrap());
    assert_eq!(a.translation.interpolation(), Interpolation::Step);
    assert_eq!(a.translation.sample(1.9), Some(Vec3::new(4.0, 0.0, 0.0)));
    let quarter = b.rotation.sample(0.5).unwrap();
    assert!(quarter.abs_diff_eq(Quat::from_rotation_y(FRAC_PI_4), 1e-5));
    for t in [0.25, 0.5, 0.75_f32] {
        let found = b.scale.sample(t).unwrap();
        assert!(
            found.abs_diff_eq(Vec3::new(t * t, 0.0, 0.0), 1e-5),
            "{found} at {t}"
        );
    }
    // Both nodes repeat together, and the shorter one waits at its end.
    assert_eq!(b.rotation.times(), [0.0, 1.0, 2.0]);
    assert_eq!(b.scale.sample(1.5), Some(Vec3::X));
}
