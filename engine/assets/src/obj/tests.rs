#![allow(clippy::unwrap_used)]
use std::fs;
use std::path::Path;

use glam::{Vec2, Vec3};
use rand::seq::IndexedRandom;
use rand::{Rng, SeedableRng};
use tempfile::TempDir;

use super::*;
use crate::images::save_png;

struct Fixture {
    folder: TempDir,
    files: Files,
}

impl Fixture {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let files = Files::with_project(folder.path()).unwrap();
        Self { folder, files }
    }

    fn write(&self, path: &str, content: impl AsRef<[u8]>) {
        let path = self.folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap_or(Path::new(""))).unwrap();
        fs::write(path, content).unwrap();
    }

    fn png(&self, path: &str, pixel: impl Fn(u32, u32) -> [u8; 4]) {
        let bytes: Vec<u8> = (0..64).flat_map(|i| pixel(i % 8, i / 8)).collect();
        save_png(self.folder.path().join(path), 8, 8, &bytes).unwrap();
    }

    fn load(&self, path: &str) -> Result<Model, ModelError> {
        load(&self.files, path, &Options::default(), &Progress::new())
    }

    /// Loads a file of the given content.
    fn model(&self, content: impl AsRef<[u8]>) -> Model {
        self.write("x.obj", content);
        let model = self.load("x.obj").unwrap();
        check(&model);
        model
    }

    /// The message for a file that can't be loaded.
    fn refused(&self, content: impl AsRef<[u8]>) -> String {
        self.write("x.obj", content);
        let message = self.load("x.obj").unwrap_err().to_string();
        assert!(!message.contains('\n'), "{message}");
        message
    }
}

/// What must hold of every model.
fn check(model: &Model) {
    assert!(!model.meshes.is_empty());
    for (mesh, material) in &model.meshes {
        mesh.validate().unwrap();
        assert!(mesh.triangle_count() > 0);
        assert!(material.0 as usize <= model.materials.len());
        for (normal, tangent) in mesh.normals.iter().zip(&mesh.tangents) {
            assert!((normal.length() - 1.0).abs() < 1e-4, "{normal}");
            assert!(
                (tangent.truncate().length() - 1.0).abs() < 1e-4,
                "{tangent}"
            );
            assert!(normal.dot(tangent.truncate()).abs() < 1e-3);
        }
    }
    for warning in &model.warnings {
        assert!(!warning.to_string().contains('\n'));
    }
}

fn warnings(model: &Model) -> Vec<String> {
    model.warnings.iter().map(ToString::to_string).collect()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn a_square_with_everything() {
    let model = Fixture::new().model(format!(
        "{SQUARE}vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 2\nf 1/1/1 2/2/1 3/3/1 4/4/1\n"
    ));
    let (mesh, material) = &model.meshes[0];
    assert_eq!(
        (mesh.vertex_count(), mesh.triangle_count(), material.0),
        (4, 2, 0)
    );
    assert_eq!(mesh.name, "x");
    assert_eq!(mesh.normals, [Vec3::Z; 4]);
    // The file's v runs up, ours down.
    assert_eq!(mesh.uvs[0], Vec2::new(0.0, 1.0));
    assert!(
        mesh.tangents
            .iter()
            .all(|tangent| tangent.to_array() == [1.0, 0.0, 0.0, 1.0])
    );
    assert_eq!(model.bounds.center, Vec3::new(0.5, 0.5, 0.0));
    assert!(!model.made_uvs && model.warnings.is_empty());
}

#[test]
fn negative_indices_comments_line_ends_and_joined_lines() {
    let plain = Fixture::new().model(format!("{SQUARE}f 1 2 3 4\n"));
    for text in [
        format!("{SQUARE}f -4 -3 -2 -1"),
        format!("\u{feff}{SQUARE}f 1 2 \\\n 3 4 # the face\n"),
        format!(
            "# a square\n  {}\tf 1// 2// 3/ 4\n",
            SQUARE.replace("v 1 1 0", "v 1 1 0 # corner")
        ),
        format!("{SQUARE}f 1 2 3 4\n").replace('\n', "\r\n"),
        format!("{SQUARE}f 1 2 3 4\n").replace('\n', "\r"),
        // A weight, and colours.
        SQUARE
            .replace("v 1 1 0", "v 1 1 0 2.0")
            .replace("v 0 1 0", "v 0 1 0 1 0 0")
            + "f 1 2 3 4",
        // Faces before their vertices.
        format!("f 1 2 3 4\n{SQUARE}"),
        format!("o thing\ng a b\ns off\nvp 0 1\ncstype bezier\n{SQUARE}f 1 2 3 4\n"),
    ] {
        let model = Fixture::new().model(&text);
        assert_eq!(model.meshes, plain.meshes, "{text:?}");
        assert!(model.warnings.is_empty(), "{:?}", warnings(&model));
    }
}

#[test]
fn corners_that_lack_something_keep_the_rest_in_order() {
    // Only the second face has texture coordinates and normals.
    let model = Fixture::new().model(format!(
        "{SQUARE}vt 0.25 0.75\nvn 0 0 1\nf 1 2 3\nf 1/1/1 3/1/1 4/1/1\n"
    ));
    let mesh = &model.meshes[0].0;
    let uv = Vec2::new(0.25, 0.25);
    assert!(model.made_uvs);
    assert_eq!(mesh.uvs.iter().filter(|&&found| found == uv).count(), 3);
    assert_eq!(mesh.normals, vec![Vec3::Z; mesh.vertex_count()]);
    // The projection covers the longest side once, upright from the front.
    assert_eq!(mesh.uvs[0], Vec2::new(0.0, 1.0));
}

#[test]
fn concave_faces_are_covered_once() {
    let model = Fixture::new().model("v 0 0 0\nv 2 -1 0\nv 0.5 0 0\nv 2 1 0\nf 1 2 3 4\n");
    let mesh = &model.meshes[0].0;
    assert_eq!(mesh.triangle_count(), 2);
    assert!((mesh.area() - 0.5).abs() < 1e-7, "{}", mesh.area());
    assert!(mesh.normals.iter().all(|&normal| normal == Vec3::Z));
}

#[test]
fn scale_does_not_matter() {
    for scale in [1e-6, 1.0, 1e6_f32] {
        let sphere = crate::procedural::uv_sphere(scale, 32, 16);
        let mut text = String::new();
        for p in &sphere.positions {
            text += &format!("v {} {} {}\n", p.x, p.y, p.z);
        }
        for [a, b, c] in sphere.triangles() {
            text += &format!("f {} {} {}\n", a + 1, b + 1, c + 1);
        }
        let model = Fixture::new().model(text);
        let mesh = &model.meshes[0].0;
        assert_eq!(mesh.triangle_count(), sphere.triangle_count());
        assert!((model.bounds.radius / scale - 1.0).abs() < 1e-5);
        for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
            assert!(position.normalize().dot(*normal) > 0.999, "{scale}");
        }
        assert!(
            mesh.uvs
                .iter()
                .all(|uv| uv.min_element() >= -1e-6 && uv.max_element() <= 1.0 + 1e-6)
        );
    }
}

#[test]
fn materials_become_what_the_table_says() {
    let fixture = Fixture::new();
    fixture.png("wood grain.png", |x, _| [x as u8 * 30, 90, 30, 255]);
    fixture.png(
        "mask.png",
        |x, _| if x < 4 { [255; 4] } else { [0, 0, 0, 255] },
    );
    fixture.png("heights.png", |x, _| {
        [x as u8 * 20, x as u8 * 20, x as u8 * 20, 255]
    });
    fixture.png("normals.png", |_, _| [128, 128, 255, 255]);
    fixture.write(
        "my lib.mtl",
        "newmtl oak wood\r\nKd 0.5 0.25 0.125\r\nKs 0.5 0.5 0.5\r\nNs 5000\r\nKe 0 0 3\r\n\
         map_Kd wood grain.png\r\nmap_d mask.png\r\nmap_Bump -bm 2 heights.png\r\n\
         newmtl gold\nKd 0 0 0\nKs 0.9 0.8 0.2\nNs 0\nnorm normals.png\nd 0.5\n",
    );
    let model = fixture.model(format!(
        "mtllib my lib.mtl\n{SQUARE}usemtl oak wood\nf 1 2 3\nusemtl gold\nf 1 3 4\nusemtl oak wood\nf 2 3 4\n"
    ));
    assert_eq!(model.meshes.len(), 2);
    assert_eq!(model.meshes[0].0.name, "x: oak wood");
    assert_eq!(model.meshes[0].0.triangle_count(), 2);
    let oak = &model.materials[0];
    assert_eq!(oak.base_color, Vec3::new(0.5, 0.25, 0.125));
    assert!((oak.specular - 0.04).abs() < 1e-6);
    assert_eq!(
        (oak.power, oak.emissive),
        (1448.0, Vec3::new(0.0, 0.0, 3.0))
    );
    assert_eq!((oak.alpha_cutoff, oak.two_sided), (Some(0.5), true));
    let gold = &model.materials[1];
    assert!((gold.specular - 0.777_94).abs() < 1e-4, "{}", gold.specular);
    assert_eq!(
        (gold.power, gold.alpha_cutoff, gold.base_color_texture),
        (1.0, None, None)
    );
    assert_eq!(
        warnings(&model),
        [
            "x.obj, line 8: the material `gold` is transparent; without a mask (map_d) it is drawn opaque"
        ]
    );

    let texture = |id: Option<TextureId>| &model.textures[id.unwrap().0 as usize - 1];
    let wood = texture(oak.base_color_texture);
    assert_eq!(&wood.mips[0][..4], [0, 90, 30, 255]);
    assert_eq!(&wood.mips[0][7 * 4..8 * 4], [210, 90, 30, 0]);
    let slope = texture(oak.normal_texture).pixel(0, 3, 3).unwrap();
    assert!(slope.x < 0.5 && (slope.y - 0.5).abs() < 0.01 && slope.z > 0.9);
    let flat = texture(gold.normal_texture);
    assert_eq!(
        (flat.format, &flat.mips[3][..]),
        (crate::TextureFormat::Rgba8Linear, &[128, 128, 255, 255][..])
    );

    let mut assets = Assets::new();
    assets.add_material(Material::default());
    let drawn = model.clone().add_to(&mut assets);
    assert_eq!(drawn.len(), 2);
    assert_eq!(assets.material(drawn[0].1).unwrap().name, "oak wood");
    let texture = assets
        .material(drawn[0].1)
        .unwrap()
        .base_color_texture
        .unwrap();
    assert_eq!(assets.texture(texture).unwrap().name, "wood grain.png");
}

#[test]
fn each_missing_thing_is_told_once() {
    let fixture = Fixture::new();
    fixture.write(
        "a.mtl",
        "newmtl a\nmap_Kd gone.png\nbump gone.png\nnewmtl b\nmap_Kd gone.png\nmap_d gone2.png\n",
    );
    let faces = "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\nusemtl c\nf 2 3 4\nusemtl c\nf 1 2 4\n";
    let model = fixture.model(format!("mtllib a.mtl\n{SQUARE}{faces}"));
    let mut found = warnings(&model);
    found.sort();
    assert_eq!(
        found,
        [
            "a.mtl: the picture `gone.png` is not there; put it beside the model",
            "a.mtl: the picture `gone2.png` is not there; put it beside the model",
            "x.obj, line 10: the material `c` is in no material file; it is drawn in the default one",
        ]
    );
    assert_eq!(
        model.materials[0].base_color_texture,
        Some(TextureId::PLACEHOLDER)
    );
    assert_eq!(model.materials[0].normal_texture, None);
    assert_eq!(model.materials[1].alpha_cutoff, None);
    assert_eq!(model.meshes[2].1, MaterialId(0));
    // No library, or none that is there.
    let model = fixture.model(format!("mtllib no.mtl\n{SQUARE}{faces}"));
    assert_eq!(
        warnings(&model),
        ["x.obj, line 1: the material file `no.mtl` is not there; put it beside the model"]
    );
    let model = fixture.model(format!("{SQUARE}{faces}"));
    assert_eq!(
        warnings(&model),
        ["x.obj, line 5: materials are used, but no material file is named"]
    );
}

#[test]
fn damaged_pictures_become_the_placeholder() {
    let fixture = Fixture::new();
    fixture.png("whole.png", |x, y| [x as u8, y as u8, 7, 255]);
    let whole = fs::read(fixture.folder.path().join("whole.png")).unwrap();
    fixture.write("cut.png", &whole[..whole.len() / 2]);
    fixture.write("empty.png", "");
    fixture.write("text.png", "I am a picture");
    let names = ["whole", "cut", "empty", "text"];
    let library: String = names
        .iter()
        .map(|name| format!("newmtl {name}\nmap_Kd {name}.png\n"))
        .collect();
    fixture.write("a.mtl", library);
    let faces: String = names
        .iter()
        .map(|name| format!("usemtl {name}\nf 1 2 3\n"))
        .collect();
    let model = fixture.model(format!("mtllib a.mtl\n{SQUARE}{faces}"));
    assert_eq!(model.textures.len(), 1);
    let placeholders = model
        .materials
        .iter()
        .map(|material| material.base_color_texture);
    let placeholder = Some(TextureId::PLACEHOLDER);
    assert_eq!(
        placeholders.collect::<Vec<_>>(),
        [Some(TextureId(1)), placeholder, placeholder, placeholder]
    );
    let found = warnings(&model);
    assert_eq!(found.len(), 3, "{found:?}");
    assert!(found[0].starts_with("cut.png: "), "{found:?}");
    assert_eq!(
        found[1],
        "empty.png: the file is empty; save or copy it again"
    );
    assert!(
        found[2].starts_with("text.png: this is no picture"),
        "{found:?}"
    );
}

#[test]
fn pictures_are_found_by_foreign_paths_but_not_outside() {
    let fixture = Fixture::new();
    fs::create_dir(fixture.folder.path().join("maps")).unwrap();
    fixture.png("maps/a.png", |_, _| [1, 2, 3, 255]);
    fixture.write("m/x.mtl", "newmtl a\nmap_Kd ..\\maps\\a.png\nnewmtl b\nmap_Kd C:\\Users\\me\\b.png\nnewmtl c\nmap_Kd ../../../etc/passwd\n");
    fixture.png("m/b.png", |_, _| [4, 5, 6, 255]);
    fixture.write(
        "m/x.obj",
        format!(
            "mtllib ./x.mtl\n{SQUARE}usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\nusemtl c\nf 1 2 4\n"
        ),
    );
    let model = fixture.load("m/x.obj").unwrap();
    assert_eq!(model.textures.len(), 2);
    assert_eq!(
        warnings(&model),
        ["m/x.mtl: the picture `../../../etc/passwd` is not there; put it beside the model"]
    );
}

#[test]
fn hostile_files_give_one_line_each() {
    let fixture = Fixture::new();
    for (content, expected) in [
        ("", "x.obj: the file is empty; save or copy it again"),
        (
            "hello\n",
            "x.obj: there are no vertices in it; is it an OBJ file, and complete?",
        ),
        (
            SQUARE,
            "x.obj: there are no faces in it; export the model with its faces",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n",
            "x.obj: no face has an area, so there is nothing to draw; export the model again",
        ),
        (
            "v 0 0 0\nv 1 nan 0\n",
            "x.obj, line 2: a vertex has the coordinate nan; export the model again",
        ),
        (
            "v 0 0 1e999\n",
            "x.obj, line 1: a vertex has the coordinate 1e999; export the model again",
        ),
        (
            "v 0 0 1e30\n",
            "x.obj, line 1: the coordinate 1e30 is too large; scale the model down",
        ),
        (
            "v 0 0 0\nv 1 0",
            "x.obj, line 2: a vertex needs three numbers; is the file complete?",
        ),
        ("v 1,5 0 0\n", "x.obj, line 1: `1,5` is no number"),
        (
            "v 0 0 0\nf 1 1 x\n",
            "x.obj, line 2: `x` is no number of a vertex",
        ),
        (
            "v 0 0 0\nf 1 1 1/1/1/1\n",
            "x.obj, line 2: `1/1/1/1` is no corner of a face",
        ),
        (
            "v 0 0 0\nf 1 1 /1\n",
            "x.obj, line 2: a face names texture coordinate 1, and the file has 0; is the file complete?",
        ),
        ("v 0 0 0\nf 1 1 //\n", "x.obj, line 2: `//` names no vertex"),
        (
            "v 0 0 0\n\nf 1 1 2\nf 1 1 3\n",
            "x.obj, line 3: a face names vertex 2, and the file has 1; is the file complete?",
        ),
        (
            "v 0 0 0\nf 1 1 0\n",
            "x.obj, line 2: a face names vertex 0, and the file has 1; is the file complete?",
        ),
        (
            "v 0 0 0\nf 1 1 -2\n",
            "x.obj, line 2: a face names vertex -2, and the file has 1; is the file complete?",
        ),
        (
            "v 0 0 0\nf 1 1 99999999999999999999\n",
            "x.obj, line 2: `99999999999999999999` is no number of a vertex",
        ),
        (
            "v 0 0 0\nf 1 1 1//7\n",
            "x.obj, line 2: a face names normal 7, and the file has 0; is the file complete?",
        ),
    ] {
        let found = fixture.refused(content);
        // What is named first may be checked in another order.
        if content.contains(" /1\n") {
            assert!(
                found == expected || found == "x.obj, line 2: `/1` names no vertex",
                "{found}"
            );
        } else {
            assert_eq!(found, expected, "{content:?}");
        }
    }
    fixture.png("p.png", |_, _| [9; 4]);
    let png = fs::read(fixture.folder.path().join("p.png")).unwrap();
    let message = "x.obj: this is a binary file, no OBJ or MTL text; export the model as OBJ";
    assert_eq!(fixture.refused(png), message);
    fs::create_dir(fixture.folder.path().join("folder.obj")).unwrap();
    let message = fixture.load("folder.obj").unwrap_err().to_string();
    assert!(
        message.ends_with("folder.obj is a folder; name a file in it"),
        "{message}"
    );
    let message = fixture.load("gone.obj").unwrap_err().to_string();
    assert!(
        message.starts_with("there is no file `gone.obj`"),
        "{message}"
    );
}

#[test]
fn faces_with_two_corners_and_lines_are_passed_over() {
    let model = Fixture::new().model(format!(
        "{SQUARE}vt nan 0\nvn 0 0 0\nvn 1 2\nf 1 2\nf 3\nf\nl 1 2 3\nf 1/1/1 2/1/1 3/1/2\n"
    ));
    assert_eq!(model.triangle_count(), 1);
    assert_eq!(model.meshes[0].0.normals, [Vec3::Z; 3]);
    assert_eq!(
        warnings(&model),
        [
            "x.obj, line 5: a texture coordinate that is no set of numbers was left out",
            "x.obj, line 7: a normal that is no set of numbers was left out",
            "x.obj, line 8: a face with fewer than three corners was left out",
            "x.obj, line 11: lines and points are not drawn",
        ]
    );
}

#[cfg(unix)]
#[test]
fn names_in_old_encodings_and_unicode_folders() {
    let folder = tempfile::tempdir().unwrap();
    let inside = folder.path().join("práctica 1 ñ");
    fs::create_dir(&inside).unwrap();
    // Latin-1, as old programs write it.
    let text = [
        b"mtllib se\xf1al.mtl\n".as_slice(),
        SQUARE.as_bytes(),
        b"usemtl \xe1\nf 1 2 3\n",
    ]
    .concat();
    fs::write(inside.join("señal.obj"), text).unwrap();
    fs::write(inside.join("señal.mtl"), "newmtl á\nKd 1 0 0\n").unwrap();
    let mut files = Files::shipped();
    let path = files.grant(inside.join("señal.obj")).unwrap();
    let model = load(&files, &path, &Options::default(), &Progress::new()).unwrap();
    assert!(model.warnings.is_empty(), "{:?}", warnings(&model));
    assert_eq!(model.materials[0].base_color, Vec3::X);
}

#[test]
fn loading_stops_when_asked() {
    let fixture = Fixture::new();
    fixture.write("x.obj", format!("{SQUARE}f 1 2 3\n"));
    let progress = Progress::new();
    progress.cancel();
    let result = load(&fixture.files, "x.obj", &Options::default(), &progress);
    assert!(matches!(result, Err(ModelError::Cancelled(_))));
    let progress = Progress::new();
    load(&fixture.files, "x.obj", &Options::default(), &progress).unwrap();
    assert_eq!(progress.fraction(), 1.0);
}

/// Thousands of damaged files: whatever they say, there is a model that can be
/// drawn or one line that says why not.
#[test]
fn damaged_files_never_panic() {
    let mut random = rand_pcg::Pcg64::seed_from_u64(20);
    let fixture = Fixture::new();
    fixture.png("a.png", |x, y| [x as u8 * 9, y as u8, 0, 255]);
    let library = "newmtl a\nKd 1 0.5 0\nKs 0.1 0.1 0.1\nNs 20\nmap_Kd a.png\nnewmtl b c\nKd 0 0 1\nd 0.5\nbump -bm 2 a.png\n";
    let model = "mtllib x.mtl\no thing\nv 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nv 0.5 0.5 2e-3\nvt 0 0\nvt 1 0\nvt 1 1\n\
                 vn 0 0 1\nvn 0.6 0 0.8\nusemtl a\nf 1/1/1 2/2/1 3/3/2 4/1/2\nusemtl b c\nf 1//1 2//2 5//1\n\
                 s 1\nf -5 -4 -3 -1 5\nf 3 4 5 \\\n1\ng x\nl 1 2\n";
    let words = [
        "nan",
        "-1",
        "0",
        "1e38",
        "-1e-45",
        "inf",
        "/",
        "//",
        "1//",
        "v",
        "f",
        "vt",
        "vn",
        "usemtl",
        "mtllib",
        "\\",
        "\n",
        "#",
        "9999999999",
        "-9999999999",
        "1/1/1/1",
        "newmtl",
        "Kd",
        "map_Kd",
        "..",
        "\u{0}",
        "ñ",
        "\t",
        "",
    ];
    let mutate = |random: &mut rand_pcg::Pcg64, text: &str| -> Vec<u8> {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        for _ in 0..random.random_range(1..4) {
            let line = random.random_range(0..lines.len());
            let mut parts: Vec<&str> = lines[line].split(' ').collect();
            let part = random.random_range(0..parts.len());
            match random.random_range(0..6) {
                0 => parts[part] = words.choose(random).unwrap(),
                1 => parts.insert(part, words.choose(random).unwrap()),
                2 => drop(parts.remove(part)),
                3 => parts.truncate(part),
                4 => {
                    let other = random.random_range(0..parts.len());
                    parts.swap(part, other);
                }
                _ => {
                    let other = random.random_range(0..lines.len());
                    lines.swap(line, other);
                    continue;
                }
            }
            lines[line] = parts.join(" ");
        }
        let mut bytes = lines.join("\n").into_bytes();
        if random.random_bool(0.2) {
            let at = random.random_range(0..bytes.len().max(1));
            bytes.truncate(at);
        }
        if random.random_bool(0.2) && !bytes.is_empty() {
            let at = random.random_range(0..bytes.len());
            bytes[at] = random.random();
        }
        bytes
    };
    let (mut drawn, mut refused) = (0, 0);
    for _ in 0..4000 {
        fixture.write("x.obj", mutate(&mut random, model));
        fixture.write("x.mtl", mutate(&mut random, library));
        match fixture.load("x.obj") {
            Ok(model) => {
                check(&model);
                drawn += 1;
            }
            Err(error) => {
                let message = error.to_string();
                assert!(
                    !message.contains('\n') && message.contains("x.obj"),
                    "{message}"
                );
                refused += 1;
            }
        }
    }
    println!("{drawn} drawn, {refused} refused");
    assert!(
        drawn > 1000 && refused > 500,
        "{drawn} drawn, {refused} refused"
    );
}
