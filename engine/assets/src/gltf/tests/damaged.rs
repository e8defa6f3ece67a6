//! Files that contradict themselves, or are damaged.

use super::*;

#[test]
fn what_contradicts_itself_is_refused_with_its_path() {
    let mut far = triangle();
    far.0[36] = 9;
    let mut nan = triangle();
    nan.0[..4].copy_from_slice(&f32::NAN.to_le_bytes());
    let with = |bytes: &Bytes| embedded("").replace(&triangle().uri(), &bytes.uri());
    let light = |light: &str| {
        let more = format!(
            r#", "extensionsUsed": ["KHR_lights_punctual"], "extensions": {{"KHR_lights_punctual":
            {{"lights": [{light}]}}}}"#
        );
        let list = r#"{"extensions": {"KHR_lights_punctual": {"light": 0}}}"#;
        embedded(&format!("{}{more}", nodes(list)))
    };
    let cases = [
        (String::new(), "is empty"),
        ("{".to_owned(), "can't be understood"),
        ("glTF".to_owned(), "can't be understood"),
        (with(&far), "`leaf` names vertex 9 of 3"),
        (with(&nan), "infinite or not a number"),
        (
            embedded("").replace("\"byteLength\": 44", "\"byteLength\": 4400"),
            "44 bytes long, and the file says 4400",
        ),
        (with_triangle(", \"uri\": \"gone.bin\"", ""), "gone.bin"),
        (with_triangle(", \"uri\": \"../../x.bin\"", ""), "leads out"),
        (
            with_triangle(", \"uri\": \"https://example.org/x.bin\"", ""),
            "relative",
        ),
        (with_triangle(", \"uri\": \"data:,x\"", ""), "base64"),
        (with_triangle("", ""), "no binary part"),
        (
            embedded("").replace(
                "\"count\": 3, \"type\": \"VEC3\"",
                "\"count\": 30, \"type\": \"VEC3\"",
            ),
            "reaches beyond its buffer view",
        ),
        (
            embedded("").replace(
                "\"count\": 3, \"type\": \"VEC3\"",
                "\"count\": 9000000000000, \"type\": \"VEC3\"",
            ),
            "9000000000000 elements",
        ),
        (
            embedded("").replace("\"byteLength\": 36", "\"byteLength\": 3600"),
            "leaves its buffer",
        ),
        (
            embedded("").replace("\"indices\": 1", "\"indices\": 7"),
            "can't be understood",
        ),
        (
            embedded(&nodes(r#"{"children": [1]}, {"children": [0]}"#)),
            "stands in the tree twice",
        ),
        (
            embedded(&nodes(r#"{"children": [1, 1]}, {}"#)),
            "stands in the tree twice",
        ),
        (
            embedded(&nodes(r#"{"rotation": [0, 0, 0, 0]}"#)),
            "the place of node 0",
        ),
        (light(r#"{"type": "spot"}"#), "lights[0].spot"),
        (light(r#"{"type": "point", "intensity": -1}"#), "light 0"),
        (
            embedded(", \"extensionsRequired\": [\"KHR_draco_mesh_compression\"]"),
            "can't be understood",
        ),
        (
            animated(
                &[1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
                &[accessor(0, 2, "SCALAR"), accessor(2, 2, "VEC3")].join(","),
                r#"{"samplers": [{"input": 0, "output": 1}],
                    "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}]}"#,
            ),
            "animation 0, channel 0",
        ),
    ];
    for (text, expected) in cases {
        let error = read(&text).unwrap_err().to_string();
        assert!(error.contains(expected), "{expected}: {error}\n{text}");
        assert!(
            error.contains("x.gltf") || error.contains("gone.bin"),
            "{error}"
        );
    }
    let binary = glb(&with_triangle("", ""), &triangle().0);
    for length in 0..binary.len() {
        let (_folder, files) = files(&[("x.glb", &binary[..length])]);
        let error = load(&files, &Reuse::default(), "x.glb", &Progress::new()).unwrap_err();
        assert!(error.to_string().contains("x.glb"), "{length}: {error}");
    }
}

/// Damaged files are refused or read, and never break the program.
#[test]
fn no_damage_is_fatal() {
    use rand::{Rng, SeedableRng};
    let mut random = rand_pcg::Pcg64::seed_from_u64(5);
    let list = r#"{"mesh": 0, "children": [1]}, {"camera": 0}"#;
    let more = r#", "cameras": [{"type": "perspective", "perspective": {"yfov": 0.9, "znear": 0.2}}],
        "materials": [{"pbrMetallicRoughness": {}}]"#;
    let text = with_triangle("", &format!("{}{more}", nodes(list)));
    let whole = glb(&text, &triangle().0);
    let (folder, files) = files(&[]);
    let mut read = 0;
    for _ in 0..3000 {
        let mut damaged = whole.clone();
        for _ in 0..random.random_range(1..4) {
            let at = random.random_range(20..damaged.len());
            damaged[at] = match random.random_range(0..3) {
                0 => random.random(),
                1 => b"0123456789-"[random.random_range(0..11)],
                _ => damaged[random.random_range(20..damaged.len())],
            };
        }
        std::fs::write(folder.path().join("x.glb"), &damaged).unwrap();
        match load(&files, &Reuse::default(), "x.glb", &Progress::new()) {
            Ok(scene) => {
                read += 1;
                for (mesh, _) in &scene.model.meshes {
                    assert_eq!(mesh.validate(), Ok(()));
                }
            }
            Err(error) => assert!(error.to_string().contains("x.glb")),
        }
    }
    assert!(read > 100, "only {read} were read");
}
