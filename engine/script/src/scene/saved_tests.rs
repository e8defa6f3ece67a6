//! Scenes that are saved and read again.
#![allow(clippy::unwrap_used)]

use lightbench_world::{Entity, MeshRenderer};

use super::*;
use crate::settings::Settings;
use crate::testing::project;

/// A square of two triangles, its material and its picture.
const OBJ: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                   usemtl paint\nf 1/1 2/2 3/3 4/4\n";
const MTL: &str = "newmtl paint\nKd 0.2 0.4 0.6\nNs 12.5\nmap_Kd p.bmp\n";

/// A scene of everything that scripts can make.
const SCENE: &str = r#"
    let floor = material("floor").surface(tiles_texture().size(32).pieces(2).seed(3)).power(120);
    let wall = material("wall").color(hsv(30, 0.5, 0.7)).normals(brick_texture().size(16)).two_sided();
    let glow = material("wall").emissive(kelvin(4000)).cutoff(0.3).phong(7.5);
    let gold = material("gold").color(0, 0, 0).specular(1, 0.77, 0.34).ggx(0.0263);
    let brushed = material("brushed").specular(0.9).ward(0.4, 0.1);
    spawn("ring").mesh(torus(1, 0.25).segments(8, 4)).material(gold);
    spawn("drum").mesh(cylinder(1, 2).segments(8)).material(brushed);
    spawn("slate").mesh(box(1)).material(material("slate").beckmann(0.3));
    spawn("floor").mesh(plane(2.5, 4).segments(2, 3).repeat(0.1, 3)).material(floor);
    let ball = sphere(0.75).segments(8, 4);
    for i in 0..3 {
        spawn("ball " + i).mesh(ball).material(wall).at(i * 0.1, 1e-7, -2).turn(10, 20, 30);
    }
    spawn("round").mesh(ball.segments(6)).material(glow).parent(entity("ball 1"));
    spawn("vase \"one\"").mesh(lathe([[0, 0], [0.5, 0.25], [0.25, 1]])).spin(0, 45, 0);
    spawn("faces").mesh(faces([[vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1.5, 0)]]));
    spawn("tuscan").mesh(column(0.25, 3).flutes(4).taper(0.8)).velocity(1, 0, 0);
    spawn("arch").mesh(arch(1, 1.2, 0.5).voussoirs(7)).material(glow);
    spawn("cloth").mesh(cloth(1, 2).waves(3, 0.1).segments(4, 4)).material(wall);
    spawn("lift").animate_position([[0, vec3(0, 0, 0)], [2, vec3(0, 4, 0)]], "smooth");
    load_obj("models/square.obj", 30).at(3, 0, 0);
    spot_light("spot").inner(20).outer(35).at(0, 5, 0).aim(0, 0, 0);
    camera("main").at(0, 1.6, 5).look_at(0, 1.6, 0);
"#;

fn bmp() -> Vec<u8> {
    let mut picture = b"BM".to_vec();
    for number in [58_u32, 0, 54, 40, 1, 1, 0x0018_0001, 0, 4, 0, 0, 0, 0] {
        picture.extend(number.to_le_bytes());
    }
    picture.extend([10, 200, 90, 0]);
    picture
}

fn folder(scene: &str) -> (tempfile::TempDir, Files) {
    let (folder, files) = project(&[
        ("scripts/scenes/test.rhai", scene),
        ("models/square.obj", OBJ),
        ("models/m.mtl", MTL),
    ]);
    std::fs::write(folder.path().join("models/p.bmp"), bmp()).unwrap();
    (folder, files)
}

fn open(files: &Files, name: &str) -> Result<Scene, Problems> {
    load_scene(files, name, &Settings::new(), &Progress::new())
}

/// The mesh and the material of each entity that is drawn, by the entity's place among all.
fn drawn(scene: &Scene) -> Vec<(usize, lightbench_assets::Mesh, lightbench_assets::Material)> {
    let entities: Vec<Entity> = scene.world.entities().collect();
    let renderer = |entity: &Entity| scene.world.get::<MeshRenderer>(*entity);
    let mut found = Vec::new();
    for (place, renderer) in entities.iter().map(renderer).enumerate() {
        let Some(MeshRenderer { mesh, material, .. }) = renderer else {
            continue;
        };
        let mesh = scene.assets.mesh(mesh).unwrap().as_ref().clone();
        let mut material = scene.assets.material(material).unwrap().clone();
        // Their numbers may differ; what they show is compared beside them.
        material.base_color_texture = None;
        material.normal_texture = None;
        found.push((place, mesh, material));
    }
    found
}

fn pictures(scene: &Scene) -> Vec<lightbench_assets::Texture> {
    let mut pictures = Vec::new();
    for &material in scene.world.columns::<MeshRenderer>().material() {
        let material = scene.assets.material(material).unwrap();
        let both = [material.base_color_texture, material.normal_texture];
        for id in both.into_iter().flatten() {
            pictures.push(scene.assets.texture(id).unwrap().as_ref().clone());
        }
    }
    pictures
}

#[test]
fn a_saved_scene_is_the_scene() {
    let (folder, files) = folder(SCENE);
    let mut scene = open(&files, "test").unwrap();
    let path = folder.path().join("kept.scene");
    scene.save(&path).unwrap();
    let mut again = open(&files, "kept.scene").unwrap();
    assert_eq!(again.world.len(), scene.world.len());
    assert_eq!(drawn(&again), drawn(&scene));
    assert_eq!(pictures(&again), pictures(&scene));
    let text = std::fs::read_to_string(&path).unwrap();
    assert_eq!(again.to_text().unwrap(), text);
    assert_eq!(text, scene.to_text().unwrap());
    assert!(
        text.contains("material \"wall 2\" = material(\"wall\")"),
        "{text}"
    );
    assert!(
        text.contains("model_mesh(\"models/square.obj\", 0, 30"),
        "{text}"
    );
    for read in ["kept.scene", "models/square.obj"] {
        assert!(again.files().iter().any(|file| file == read), "{read}");
    }
    // Both go on alike, because what moves is in the file.
    for scene in [&mut scene, &mut again] {
        for frame in 1..=20 {
            scene.update(f64::from(frame) / 60.0, 1.0 / 60.0).unwrap();
        }
    }
    assert_eq!(scene.to_text().unwrap(), again.to_text().unwrap());
}

#[test]
fn every_shipped_scene_can_be_saved() {
    let files = Files::shipped();
    for entry in list_scenes(&files).unwrap() {
        let mut scene = open(&files, &entry.name).unwrap();
        if entry.name == "solar_system" {
            // Its planets are painted by functions, of which a file of entities knows nothing.
            let problem = scene.to_text().unwrap_err();
            assert!(
                problem.message.contains("painted by a function"),
                "{problem}"
            );
            continue;
        }
        let text = scene.to_text().unwrap();
        let (_folder, files) = project(&[("s.scene", &text)]);
        let mut again = open(&files, "s.scene").unwrap_or_else(|e| panic!("{}: {e}", entry.name));
        assert_eq!(again.to_text().unwrap(), text, "{}", entry.name);
        assert_eq!(drawn(&again).len(), drawn(&scene).len());
    }
}

#[test]
fn mistakes_in_saved_scenes_have_a_line() {
    let fails = |lines: &str| {
        let text = format!("lightbench scene 2\n{lines}");
        let (_folder, files) = project(&[("s.scene", &text)]);
        open(&files, "s.scene").unwrap_err().to_string()
    };
    for (lines, expected) in [
        ("mesh \"a\" = spere(1)", "spere"),
        ("mesh \"a\" = 12", "this makes no mesh"),
        (
            "mesh \"a\" = sphere(1)\nmesh \"a\" = box(1)",
            "defined twice",
        ),
        (
            "texture \"a\" = picture(\"../../etc/passwd\")",
            "etc/passwd",
        ),
        (
            "material \"a\" = material(\"a\").texture(texture(\"b\"))",
            "there is no texture `b`",
        ),
        (
            "mesh \"a\" = { let x = 1; while true { x += 1 } }",
            "s.scene:2",
        ),
        (
            "entity #1\n  MeshRenderer\n    mesh = mesh \"gone\"",
            "defines no mesh `gone`",
        ),
        ("mesh \"a\" = model_mesh(\"gone.obj\", 0)", "gone.obj"),
    ] {
        let error = fails(lines);
        assert!(error.contains(expected), "{lines}: {error}");
        assert!(error.contains("s.scene"), "{lines}: {error}");
    }
    let (_folder, files) = folder("");
    let error = load_scene(&files, "gone.scene", &Settings::new(), &Progress::new());
    assert!(error.unwrap_err().to_string().contains("gone.scene"));
}

#[test]
fn what_nobody_can_make_again_is_refused() {
    let (_folder, files) = folder("spawn(\"a\").mesh(box(1));");
    let mut scene = open(&files, "test").unwrap();
    let mesh = scene.assets.add_mesh(
        lightbench_assets::procedural::cuboid(lightbench_world::glam::Vec3::ONE).named("x"),
    );
    let entity = scene.world.find("a").unwrap();
    let renderer = MeshRenderer {
        mesh,
        ..MeshRenderer::default()
    };
    scene.world.insert(entity, renderer).unwrap();
    let error = scene.to_text().unwrap_err().to_string();
    assert!(error.contains("the mesh `x` can't be saved"), "{error}");
}

/// A carrier with two cards, one of which swings, and a lamp; all in one text.
const GLTF: &str = r#"{"asset": {"version": "2.0"},
    "buffers": [{"byteLength": 88, "uri": "cards.bin"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 52}],
    "accessors": [
        {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
        {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
        {"bufferView": 1, "byteOffset": 8, "componentType": 5126, "count": 2, "type": "VEC3"}],
    "materials": [{"name": "card", "pbrMetallicRoughness": {"metallicFactor": 0.25}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]},
        {"primitives": [{"attributes": {"POSITION": 0}}, {"attributes": {"POSITION": 0}, "material": 0}]}],
    "nodes": [{"name": "carrier", "children": [1, 2, 3], "translation": [0, 1, 0]},
        {"name": "one", "mesh": 0}, {"name": "two", "mesh": 1},
        {"name": "bulb", "extensions": {"KHR_lights_punctual": {"light": 0}}}],
    "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 683}]}},
    "animations": [{"samplers": [{"input": 1, "output": 2}],
        "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]}],
    "scenes": [{"nodes": [0]}], "scene": 0}"#;

fn with_cards() -> (tempfile::TempDir, Files) {
    let script = "load_gltf(\"models/cards.gltf\").at(5, 0, 0);";
    let (folder, files) = folder(script);
    std::fs::write(folder.path().join("models/cards.gltf"), GLTF).unwrap();
    let numbers: [f32; 9 + 2 + 6] = [
        0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, // a triangle
        0.0, 1.0, // times
        0.0, 0.0, 0.0, 0.0, 3.0, 0.0, // places
    ];
    let mut bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
    bytes.resize(88, 0);
    std::fs::write(folder.path().join("models/cards.bin"), bytes).unwrap();
    (folder, files)
}

#[test]
fn a_gltf_scene_is_built_moved_and_saved() {
    let (folder, files) = with_cards();
    let mut scene = open(&files, "test").unwrap();
    let entity = |scene: &Scene, name: &str| scene.world.find(name).unwrap();
    let root = entity(&scene, "cards");
    assert_eq!(scene.world.parent(entity(&scene, "carrier")), Some(root));
    assert_eq!(scene.world.children(entity(&scene, "two")).count(), 2);
    let bulb: lightbench_world::Light = scene.world.get(entity(&scene, "bulb")).unwrap();
    assert_eq!(bulb.intensity, 1.0);
    assert!(scene.moves());
    scene.update(0.5, 0.5).unwrap();
    let one: lightbench_world::Transform = scene.world.get(entity(&scene, "one")).unwrap();
    assert_eq!(one.translation.y, 1.5);
    let matrix: lightbench_world::WorldMatrix = scene.world.get(entity(&scene, "one")).unwrap();
    assert_eq!(matrix.matrix.translation.to_array(), [5.0, 2.5, 0.0]);

    scene.save(&folder.path().join("cards.scene")).unwrap();
    let mut again = open(&files, "cards.scene").unwrap();
    assert_eq!(again.to_text().unwrap(), scene.to_text().unwrap());
    assert_eq!(drawn(&again), drawn(&scene));
}

#[test]
fn a_broken_gltf_is_told_with_its_path_and_line() {
    let (folder, files) = with_cards();
    std::fs::write(folder.path().join("models/cards.bin"), [0; 12]).unwrap();
    let error = open(&files, "test").unwrap_err().to_string();
    assert!(error.contains("test.rhai:1"), "{error}");
    assert!(
        error.contains("cards.gltf") && error.contains("buffer 0 is 12 bytes"),
        "{error}"
    );
}
