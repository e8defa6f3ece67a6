#![allow(clippy::unwrap_used)]

use lightbench_assets::{Material, Progress, Reflection, TextureId};
use lightbench_world::glam::Vec3;
use lightbench_world::{MeshRenderer, Name, Transform};

use super::super::{Edit, Overlays, Who};
use super::{AssetEdit, Picture, SurfaceField, SurfaceValue};
use crate::scene::Scene;
use crate::testing::project;
use crate::{Settings, load_scene};

/// Things of three materials, one of which a function of the script paints.
const ROOM: &str = r#"
let clay = material("clay").color(0.5, 0.2, 0.1);
spawn("cup").mesh(sphere(0.5)).material(clay);
spawn("jug").mesh(sphere(0.7)).material(clay);
spawn("wall").mesh(box(2)).material(material("wall").texture(brick_texture()));
spawn("sign").mesh(box(1)).material(material("sign").texture(painted_texture(8, |u, v| rgb(u, v, 0))));
spawn().mesh(box(3)).material(material("nameless"));
camera("eye").at(0, 3, 6);
"#;

fn scene_of(script: &str) -> (tempfile::TempDir, Scene) {
    let (folder, files) = project(&[
        ("scripts/scenes/test.rhai", script),
        ("model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    ]);
    let scene = load_scene(&files, "test", &Settings::new(), &Progress::new());
    (folder, scene.unwrap())
}

fn who(name: &str) -> Who {
    Who {
        name: name.to_owned(),
        nth: 0,
    }
}

fn paint(name: &str, field: SurfaceField, value: SurfaceValue) -> AssetEdit {
    AssetEdit::Paint {
        field,
        of: vec![(who(name), Some(value))],
    }
}

fn make(name: &str, like: Option<&str>) -> AssetEdit {
    AssetEdit::NewMaterial {
        name: name.to_owned(),
        like: like.map(who),
    }
}

fn dress(of: &[&str], material: Option<&str>) -> AssetEdit {
    AssetEdit::Dress {
        of: of.iter().map(|name| who(name)).collect(),
        material: material.map(who),
    }
}

/// An entity's name, the calls of its mesh, and its material, whose textures stand as the calls that make them.
type Drawn = (String, Option<(String, Material, [Option<String>; 2])>);

/// What each entity that has a name is drawn with.
fn drawn(scene: &Scene) -> Vec<Drawn> {
    let names = scene.world.columns::<Name>();
    let mut all: Vec<_> = names
        .text()
        .iter()
        .zip(names.entities())
        .map(|(name, entity)| {
            let renderer: Option<MeshRenderer> = scene.world.get(*entity);
            let drawn = renderer.map(|renderer| {
                let data = scene.stage.lock();
                let mesh = data.recipes.meshes[&renderer.mesh].spelled();
                let material = scene.assets.material(renderer.material).unwrap().clone();
                let recipe = |id: Option<TextureId>| data.recipes.textures.get(&id?).cloned();
                let textures = [material.base_color_texture, material.normal_texture].map(recipe);
                let material = Material {
                    base_color_texture: None,
                    normal_texture: None,
                    ..material
                };
                (mesh, material, textures)
            });
            (name.clone(), drawn)
        })
        .collect();
    all.sort_by(|a, b| a.0.cmp(&b.0));
    all
}

#[test]
fn lines_of_changed_assets_make_the_same_world() {
    let edits = vec![
        make("", None),
        make("", Some("clay")),
        paint(
            "clay",
            SurfaceField::Color,
            SurfaceValue::Color(Vec3::new(0.9, 0.123_456_7, 0.0)),
        ),
        dress(&["cup"], Some("clay 2")),
        paint("clay 2", SurfaceField::Opacity, SurfaceValue::Share(0.3)),
        paint(
            "clay 2",
            SurfaceField::Cutoff,
            SurfaceValue::Cutoff(Some(0.6)),
        ),
        paint("clay 2", SurfaceField::TwoSided, SurfaceValue::Switch(true)),
        paint(
            "clay 2",
            SurfaceField::Emissive,
            SurfaceValue::Color(Vec3::new(0.0, 2.5, 7.0)),
        ),
        paint(
            "clay",
            SurfaceField::Texture,
            SurfaceValue::Picture(Picture::Made("tiles_texture().pieces(3)".to_owned())),
        ),
        paint(
            "clay",
            SurfaceField::Normals,
            SurfaceValue::Picture(Picture::Made("stone_texture()".to_owned())),
        ),
        paint(
            "clay",
            SurfaceField::Reflection,
            SurfaceValue::Reflection(Reflection::Ward {
                along: 0.5,
                across: 0.1,
            }),
        ),
        AssetEdit::RenameMaterial {
            of: who("clay 2"),
            name: "porcelain".to_owned(),
        },
        AssetEdit::NewMesh {
            recipe: "torus(1, 0.25)".to_owned(),
        },
        AssetEdit::Reshape {
            of: vec![who("wall"), who("jug")],
            mesh: Some(who("torus")),
        },
        AssetEdit::AddModel {
            path: "model.obj".to_owned(),
            name: String::new(),
            number: 0,
            place: Transform::from_translation(Vec3::ONE),
        },
        dress(&["jug", "wall"], Some("material")),
        dress(&["cup", "sign"], Some("clay")),
        make("glass", None),
        dress(&["wall"], Some("glass")),
        AssetEdit::DeleteMaterial {
            of: vec![who("glass")],
        },
    ];
    let (_folder, mut scene) = scene_of(ROOM);
    let mut overlays = Overlays::default();
    let before = drawn(&scene);
    let mut script = ROOM.to_owned();
    for edit in edits {
        let name = format!("{edit:?}");
        overlays.edit(&mut scene, Edit::Assets(edit)).unwrap();
        let (_, lines) = overlays.edit_lines(&scene).next_back().unwrap();
        script += &lines.unwrap_or_else(|why| panic!("{name}: {why}"));
        script += "\n";
        // After each of them, not only after all.
        let (_other, again) = scene_of(&script);
        assert_eq!(drawn(&again), drawn(&scene), "{name}\n{script}");
    }
    assert_ne!(drawn(&scene), before);
}

#[test]
fn where_scripts_have_no_words_a_sentence_says_what_to_do() {
    let (_folder, mut scene) = scene_of(ROOM);
    let mut overlays = Overlays::default();
    for (edit, words) in [
        (make("spare", None), ""),
        (
            AssetEdit::DeleteMaterial {
                of: vec![who("spare")],
            },
            "leave out the call",
        ),
        (
            paint("sign", SurfaceField::Opacity, SurfaceValue::Share(0.5)),
            "made by a function",
        ),
        (
            paint("nameless", SurfaceField::Opacity, SurfaceValue::Share(0.5)),
            "by a name of their own",
        ),
        (
            AssetEdit::NewTexture {
                recipe: "marble_texture()".to_owned(),
            },
            ".texture(marble_texture())",
        ),
        (dress(&["cup"], Some("wall")), ""),
        (dress(&["cup"], None), "the script itself gives"),
    ] {
        overlays.edit(&mut scene, Edit::Assets(edit)).unwrap();
        let (_, lines) = overlays.edit_lines(&scene).next_back().unwrap();
        match words {
            "" => assert!(lines.is_ok()),
            words => assert!(lines.unwrap_err().contains(words), "{words}"),
        }
    }
}
