#![allow(clippy::unwrap_used)]
mod hostile;
mod reuse;

use std::fs;
use std::path::Path;

use glam::{Vec2, Vec3};
use tempfile::TempDir;

use super::*;
use crate::Reflection;
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
        // Some file systems wait for the disk when a file is cut and rewritten.
        let _ = fs::remove_file(&path);
        fs::write(path, content).unwrap();
    }

    fn png(&self, path: &str, pixel: impl Fn(u32, u32) -> [u8; 4]) {
        let bytes: Vec<u8> = (0..64).flat_map(|i| pixel(i % 8, i / 8)).collect();
        save_png(self.folder.path().join(path), 8, 8, &bytes).unwrap();
    }

    fn load(&self, path: &str) -> Result<Model, ModelError> {
        let (reuse, options) = (Reuse::default(), Options::default());
        load(&self.files, &reuse, path, &options, &Progress::new())
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
        let values = |model: &Model| {
            let meshes = model.meshes.iter();
            meshes
                .map(|(mesh, material)| (Mesh::clone(mesh), *material))
                .collect::<Vec<_>>()
        };
        assert_eq!(values(&model), values(&plain), "{text:?}");
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
    assert_eq!(oak.specular, Vec3::splat(0.08));
    assert_eq!(oak.reflection, Reflection::BlinnPhong { power: 1448.0 });
    assert_eq!(oak.emissive, Vec3::new(0.0, 0.0, 3.0));
    assert_eq!((oak.alpha_cutoff, oak.two_sided), (Some(0.5), true));
    let gold = &model.materials[1];
    assert_eq!(gold.specular, Vec3::new(0.9, 0.8, 0.2));
    assert_eq!(gold.reflection, Reflection::BlinnPhong { power: 1.0 });
    assert_eq!((gold.alpha_cutoff, gold.base_color_texture), (None, None));
    assert!(gold.is_transparent() && !oak.is_transparent());
    assert_eq!(warnings(&model), [] as [&str; 0]);

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

/// Metals take the colour of their textures point by point for what they scatter only.
#[test]
fn roughness_and_metal_choose_ggx() {
    let fixture = Fixture::new();
    fixture.png("rust.png", |_, _| [90, 40, 20, 255]);
    fixture.write(
        "a.mtl",
        "newmtl brass\nKd 0.9 0.7 0.3\nKs 1 1 1\nNs 900\nPr 0.5\nPm 1\nmap_Kd rust.png\n\
         newmtl clay\nKd 0.6 0.4 0.3\nPr 0.1\nnewmtl half\nKd 0.5 0.5 0.5\npm 0.5\n",
    );
    let faces = "usemtl brass\nf 1 2 3\nusemtl clay\nf 1 3 4\nusemtl half\nf 2 3 4\n";
    let model = fixture.model(format!("mtllib a.mtl\n{SQUARE}{faces}"));
    let [brass, clay, half] = model.materials.as_slice() else {
        panic!("{:?}", model.materials);
    };
    assert_eq!(brass.base_color, Vec3::ZERO);
    assert_eq!(brass.specular, Vec3::new(0.9, 0.7, 0.3));
    assert_eq!(brass.reflection, Reflection::Ggx { roughness: 0.25 });
    assert_eq!(clay.base_color, Vec3::new(0.6, 0.4, 0.3));
    assert_eq!(clay.specular, Vec3::splat(0.04));
    // The square of 0.1 is below the range.
    let least = *Reflection::ROUGHNESS_RANGE.start();
    assert_eq!(clay.reflection, Reflection::Ggx { roughness: least });
    assert!(half.specular.abs_diff_eq(Vec3::splat(0.27), 1e-6));
    assert_eq!(half.base_color, Vec3::splat(0.25));
    let found = warnings(&model);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("the metal `brass`"), "{found:?}");
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
            "a.mtl, line 2: the picture `gone.png` is not there; put it beside the model",
            "a.mtl, line 6: the picture `gone2.png` is not there; put it beside the model",
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
fn pictures_are_found_by_foreign_paths_but_not_outside() {
    let fixture = Fixture::new();
    fs::create_dir(fixture.folder.path().join("maps")).unwrap();
    fixture.png("maps/a.png", |_, _| [1, 2, 3, 255]);
    fixture.write("m/x.mtl", "newmtl a\nmap_Kd ..\\maps\\a.png\nnewmtl b\nmap_Kd C:\\Users\\me\\b.png\nnewmtl c\nmap_Kd ../../../etc/passwd\n");
    // Other capitals are no other file, wherever the model comes from.
    fixture.png("m/B.PNG", |_, _| [4, 5, 6, 255]);
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
        [
            "m/x.mtl, line 6: the picture `../../../etc/passwd` is not there; put it beside the model"
        ]
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
    let (reuse, options) = (Reuse::default(), Options::default());
    let model = load(&files, &reuse, &path, &options, &Progress::new()).unwrap();
    assert!(model.warnings.is_empty(), "{:?}", warnings(&model));
    assert_eq!(model.materials[0].base_color, Vec3::X);
}

#[test]
fn loading_stops_when_asked() {
    let fixture = Fixture::new();
    fixture.write("x.obj", format!("{SQUARE}f 1 2 3\n"));
    let progress = Progress::new();
    progress.cancel();
    let (reuse, options) = (Reuse::default(), Options::default());
    let result = load(&fixture.files, &reuse, "x.obj", &options, &progress);
    assert!(matches!(result, Err(ModelError::Cancelled(_))));
    let progress = Progress::new();
    load(&fixture.files, &reuse, "x.obj", &options, &progress).unwrap();
    assert_eq!(progress.fraction(), 1.0);
}
