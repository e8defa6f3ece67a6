#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use lightbench_assets::{Material, Progress, Reflection};
use lightbench_world::glam::Vec3;
use lightbench_world::{MeshRenderer, Transform};

use super::super::{Edit, Overlays, Who};
use super::*;
use crate::scene::Scene;
use crate::testing::project;
use crate::{Settings, load_scene};

/// Two things of clay, one of brick, and one that the script paints anew in each step.
const ROOM: &str = r#"
let clay = material("clay").color(0.5, 0.2, 0.1);
spawn("cup").mesh(sphere(0.5)).material(clay);
spawn("jug").mesh(sphere(0.7)).material(clay);
spawn("wall").mesh(box(2)).material(material("wall").texture(brick_texture()));
const GLOW = material("glow");
spawn("lamp").mesh(box(1)).material(GLOW);
spawn("plain").mesh(box(3));
camera("eye").at(0, 3, 6);
fn update(time, dt) { GLOW.color(time, 0, 0); }
"#;

fn scene() -> (tempfile::TempDir, Scene) {
    let (folder, files) = project(&[
        ("scripts/scenes/test.rhai", ROOM),
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

fn make(name: &str, like: Option<&str>) -> AssetEdit {
    AssetEdit::NewMaterial {
        name: name.to_owned(),
        like: like.map(who),
    }
}

fn paint(name: &str, field: SurfaceField, value: SurfaceValue) -> AssetEdit {
    AssetEdit::Paint {
        field,
        of: vec![(who(name), Some(value))],
    }
}

fn red(name: &str, red: f32) -> AssetEdit {
    let color = SurfaceValue::Color(Vec3::new(red, 0.0, 0.0));
    paint(name, SurfaceField::Color, color)
}

fn dress(of: &str, material: Option<&str>) -> AssetEdit {
    AssetEdit::Dress {
        of: vec![who(of)],
        material: material.map(who),
    }
}

fn textured(name: &str, field: SurfaceField, recipe: &str) -> AssetEdit {
    let picture = Picture::Made(recipe.to_owned());
    paint(name, field, SurfaceValue::Picture(picture))
}

fn material(scene: &Scene, name: &str) -> Material {
    let id = scene.find_material(&who(name)).unwrap();
    scene.assets.material(id).unwrap().clone()
}

fn worn(scene: &Scene, entity: &str) -> String {
    let entity = scene.world.find(entity).unwrap();
    let renderer: MeshRenderer = scene.world.get(entity).unwrap();
    let material = scene.assets.material(renderer.material).unwrap();
    material.name.clone()
}

/// One of each kind, that each change what is saved or listed.
fn all_edits() -> Vec<AssetEdit> {
    vec![
        make("", None),
        make("", Some("clay")),
        red("clay", 0.9),
        red("clay 2", 0.25),
        red("clay", 0.75),
        dress("cup", Some("clay 2")),
        dress("jug", Some("material")),
        textured("material", SurfaceField::Texture, "tiles_texture()"),
        textured("clay", SurfaceField::Normals, "stone_texture()"),
        textured("clay 2", SurfaceField::Texture, "brick_texture()"),
        paint(
            "material",
            SurfaceField::Reflection,
            SurfaceValue::Reflection(Reflection::Ward {
                along: 0.5,
                across: 0.25,
            }),
        ),
        paint("clay 2", SurfaceField::Opacity, SurfaceValue::Share(0.5)),
        paint(
            "clay 2",
            SurfaceField::Cutoff,
            SurfaceValue::Cutoff(Some(0.5)),
        ),
        paint("clay 2", SurfaceField::TwoSided, SurfaceValue::Switch(true)),
        AssetEdit::RenameMaterial {
            of: who("clay 2"),
            name: "porcelain".to_owned(),
        },
        AssetEdit::NewMesh {
            recipe: "torus(1, 0.25)".to_owned(),
        },
        AssetEdit::Reshape {
            of: vec![who("wall"), who("lamp")],
            mesh: Some(who("torus")),
        },
        AssetEdit::NewMesh {
            recipe: "cone(2, 2)".to_owned(),
        },
        AssetEdit::NewTexture {
            recipe: "marble_texture()".to_owned(),
        },
        AssetEdit::AddModel {
            path: "model.obj".to_owned(),
            name: String::new(),
            number: 0,
            place: Transform::from_translation(Vec3::ONE),
        },
        AssetEdit::Reshape {
            of: vec![who("wall")],
            mesh: None,
        },
        dress("jug", None),
        AssetEdit::Paint {
            field: SurfaceField::Color,
            of: vec![(who("clay"), None)],
        },
        AssetEdit::DeleteMesh { of: who("cone") },
        AssetEdit::DeleteTexture { of: who("marble") },
        AssetEdit::DeleteMaterial {
            of: vec![who("porcelain"), who("wall")],
        },
    ]
}

#[test]
fn every_change_is_taken_back_exactly_lies_over_a_load_and_is_saved() {
    let (folder, mut scene) = scene();
    let mut overlays = Overlays::new();
    let mut texts = vec![(scene.to_text().unwrap(), scene.assets.counts())];
    for edit in all_edits() {
        let words = format!("{edit:?}");
        let before = scene.listed();
        overlays
            .edit(&mut scene, Edit::Assets(edit))
            .unwrap_or_else(|why| panic!("{words}: {why}"));
        let text = scene.to_text().unwrap();
        let same = texts.last().unwrap().0 == text && scene.listed() == before;
        assert!(!same, "{words} changes nothing");
        texts.push((text, scene.assets.counts()));
    }
    let last = texts.last().unwrap().0.clone();
    // The file holds all of it, and is written again as it was.
    std::fs::write(folder.path().join("saved.scene"), &last).unwrap();
    let files = lightbench_assets::files::Files::with_project(folder.path()).unwrap();
    let read = load_scene(&files, "saved.scene", &Settings::new(), &Progress::new());
    assert_eq!(read.unwrap().to_text().unwrap(), last);
    // A load of the script.
    let mut again = load_scene(&files, "test", &Settings::new(), &Progress::new()).unwrap();
    overlays.lay_on(&mut again);
    assert_eq!(again.to_text().unwrap(), last);
    for which in [&mut scene, &mut again] {
        let mut overlays = overlays.clone();
        for (text, counts) in texts.iter().rev().skip(1) {
            let edit = overlays.undo_edit(which).unwrap();
            assert_eq!(&which.to_text().unwrap(), text, "after {edit:?}");
            assert_eq!(which.assets.counts(), *counts, "after {edit:?}");
        }
        assert!(overlays.is_empty());
    }
    // And from there on again.
    let edits: Vec<Edit> = overlays.edits().map(|(edit, _)| edit.clone()).collect();
    let mut overlays = Overlays::new();
    for (edit, (text, counts)) in edits.into_iter().zip(&texts[1..]) {
        let edit = overlays.edit(&mut scene, edit).unwrap();
        assert_eq!(&scene.to_text().unwrap(), text, "{edit:?} again");
        assert_eq!(scene.assets.counts(), *counts, "{edit:?} again");
    }
}

#[test]
fn what_is_drawn_with_a_deleted_material_gets_the_default_one() {
    let (_folder, mut scene) = scene();
    let mut overlays = Overlays::new();
    let delete = AssetEdit::DeleteMaterial {
        of: vec![who("clay")],
    };
    overlays.edit(&mut scene, Edit::Assets(delete)).unwrap();
    assert_eq!(worn(&scene, "cup"), "default");
    assert_eq!(worn(&scene, "jug"), "default");
    assert_eq!(worn(&scene, "wall"), "wall");
    assert!(!scene.to_text().unwrap().contains("\"clay\""));
    let names: Vec<String> = scene
        .listed()
        .all()
        .iter()
        .map(|one| one.who.words())
        .collect();
    assert!(!names.contains(&"clay".to_owned()), "{names:?}");
    overlays.undo_edit(&mut scene);
    assert_eq!(worn(&scene, "cup"), "clay");
    // One that is named twice comes back too.
    overlays
        .edit(&mut scene, Edit::Assets(make("new", None)))
        .unwrap();
    let before = scene.to_text().unwrap();
    let delete = AssetEdit::DeleteMaterial {
        of: vec![who("new"), who("clay"), who("new")],
    };
    overlays.edit(&mut scene, Edit::Assets(delete)).unwrap();
    overlays.undo_edit(&mut scene);
    assert_eq!(scene.to_text().unwrap(), before);
}

#[test]
fn values_win_over_a_script_that_writes_them_and_go_back_to_its_own() {
    let (_folder, mut scene) = scene();
    let mut overlays = Overlays::new();
    let step = |scene: &mut Scene, overlays: &mut Overlays, time: f64| {
        scene.update(time, 0.1).unwrap();
        overlays.follow(scene);
    };
    step(&mut scene, &mut overlays, 0.25);
    overlays
        .edit(&mut scene, Edit::Assets(red("glow", 1.0)))
        .unwrap();
    step(&mut scene, &mut overlays, 0.5);
    assert_eq!(material(&scene, "glow").base_color.x, 1.0);
    let id = scene.find_material(&who("glow")).unwrap();
    let script = overlays.script_surface(&scene, id, SurfaceField::Color);
    assert_eq!(script, Some(SurfaceValue::Color(Vec3::new(0.5, 0.0, 0.0))));
    let back = AssetEdit::Paint {
        field: SurfaceField::Color,
        of: vec![(who("glow"), None)],
    };
    overlays.edit(&mut scene, Edit::Assets(back)).unwrap();
    assert_eq!(material(&scene, "glow").base_color.x, 0.5);
    assert_eq!(
        overlays.script_surface(&scene, id, SurfaceField::Color),
        None
    );
    step(&mut scene, &mut overlays, 0.75);
    assert_eq!(material(&scene, "glow").base_color.x, 0.75);
    overlays.undo_edit(&mut scene);
    assert_eq!(material(&scene, "glow").base_color.x, 1.0);
    overlays.undo_edit(&mut scene);
    assert_eq!(material(&scene, "glow").base_color.x, 0.5);
}

#[test]
fn a_scene_that_is_taken_back_has_what_was_painted_since() {
    let (_folder, mut scene) = scene();
    let mut overlays = Overlays::new();
    overlays
        .edit(&mut scene, Edit::Assets(make("new", None)))
        .unwrap();
    overlays
        .edit(&mut scene, Edit::Assets(red("clay", 0.25)))
        .unwrap();
    let (snapshot, before) = (scene.snapshot(), overlays.clone());
    overlays.undo_edit(&mut scene);
    for edit in [
        make("other", Some("wall")),
        red("clay", 1.0),
        dress("cup", Some("other")),
    ] {
        overlays.edit(&mut scene, Edit::Assets(edit)).unwrap();
    }
    let wanted = scene.to_text().unwrap();
    scene.restore(&snapshot);
    overlays.taken_back(&mut scene, &before);
    assert_eq!(scene.to_text().unwrap(), wanted);
    while overlays.undo_edit(&mut scene).is_some() {}
    let (_folder, mut first) = self::scene();
    assert_eq!(scene.to_text().unwrap(), first.to_text().unwrap());
    assert_eq!(scene.assets.counts(), first.assets.counts());
}

#[test]
fn what_can_not_be_done_says_why_and_changes_nothing() {
    let (_folder, mut scene) = scene();
    let mut overlays = Overlays::new();
    let before = (scene.to_text().unwrap(), scene.assets.counts());
    let recipe = |recipe: &str| AssetEdit::NewMesh {
        recipe: recipe.to_owned(),
    };
    let rename = |of: &str, name: &str| AssetEdit::RenameMaterial {
        of: who(of),
        name: name.to_owned(),
    };
    let power = Reflection::Phong { power: 5000.0 };
    for (edit, why) in [
        (make("clay", None), "another material is called `clay`"),
        (rename("clay", " "), "at least one letter"),
        (rename("clay", "wall"), "another material is called `wall`"),
        (rename("wood", "a"), "there is no material `wood` now"),
        (red("default", 1.0), "duplicate it"),
        (red("clay", 1.5), "more light than it gets"),
        (
            paint("clay", SurfaceField::Opacity, SurfaceValue::Share(2.0)),
            "no value for opacity",
        ),
        (
            paint(
                "clay",
                SurfaceField::Reflection,
                SurfaceValue::Reflection(power),
            ),
            "are 1 to 1448",
        ),
        (
            textured("clay", SurfaceField::Texture, "picture(\"no.png\")"),
            "no.png",
        ),
        (
            textured("clay", SurfaceField::Normals, "marble_texture()"),
            "has no normals",
        ),
        (
            textured("clay", SurfaceField::Texture, "box(1)"),
            "makes no texture",
        ),
        (dress("eye", Some("clay")), "none of them is drawn"),
        (dress("nobody", Some("clay")), "nothing is called `nobody`"),
        (recipe("brick_texture()"), "makes no mesh"),
        (recipe("box("), "box"),
        (recipe("spawn(\"a\").nothing()"), "nothing"),
        (
            AssetEdit::DeleteMesh { of: who("sphere") },
            "cup is drawn with sphere",
        ),
        (
            AssetEdit::DeleteTexture { of: who("brick") },
            "the material wall has brick",
        ),
        (
            AssetEdit::DeleteMaterial { of: Vec::new() },
            "no material is chosen",
        ),
        (
            AssetEdit::AddModel {
                path: "no.obj".to_owned(),
                name: String::new(),
                number: 0,
                place: Transform::default(),
            },
            "no.obj",
        ),
    ] {
        let said = overlays
            .edit(&mut scene, Edit::Assets(edit.clone()))
            .unwrap_err();
        assert!(said.contains(why), "{edit:?}: {said}");
        let now = (scene.to_text().unwrap(), scene.assets.counts());
        assert_eq!(now, before, "{edit:?}");
    }
    assert!(overlays.is_empty());
}

#[test]
fn the_list_is_made_again_where_something_of_it_has_changed_and_only_there() {
    let (_folder, mut scene) = scene();
    let mut overlays = Overlays::new();
    let first = scene.listed();
    let has_clay = |scene: &Scene| {
        let listing = scene.listed();
        let found = listing
            .materials()
            .iter()
            .find(|one| one.who.name == "clay");
        found.map(|one| one.id)
    };
    let Some(AssetId::Material(clay)) = has_clay(&scene) else {
        panic!("no clay in {first:?}");
    };
    assert!(Arc::ptr_eq(&first, &scene.listed()));
    scene.update(0.1, 0.1).unwrap();
    assert!(Arc::ptr_eq(&first, &scene.listed()));
    let kinds = |all: &[Listed], fits: fn(&AssetId) -> bool| all.iter().all(|one| fits(&one.id));
    assert!(kinds(first.meshes(), |id| matches!(id, AssetId::Mesh(_))));
    assert!(kinds(first.materials(), |id| matches!(
        id,
        AssetId::Material(_)
    )));
    assert!(kinds(first.textures(), |id| matches!(
        id,
        AssetId::Texture(_)
    )));
    let parts = [first.meshes(), first.materials(), first.textures()].concat();
    assert_eq!(parts, first.all());

    let new = AssetEdit::NewMesh {
        recipe: "box(4.5)".to_owned(),
    };
    overlays.edit(&mut scene, Edit::Assets(new)).unwrap();
    assert_eq!(scene.listed().meshes().len(), first.meshes().len() + 1);
    overlays.undo_edit(&mut scene).unwrap();
    assert_eq!(scene.listed(), first);

    let delete = AssetEdit::DeleteMaterial {
        of: vec![who("clay")],
    };
    overlays.edit(&mut scene, Edit::Assets(delete)).unwrap();
    assert_eq!(has_clay(&scene), None);
    // What a script draws with it still, or again, brings it back.
    let cup = scene.world.find("cup").unwrap();
    let mut renderer: MeshRenderer = scene.world.get(cup).unwrap();
    let dressed = std::mem::replace(&mut renderer.material, clay);
    scene.world.set(cup, renderer).unwrap();
    assert_eq!(has_clay(&scene), Some(AssetId::Material(clay)));
    renderer.material = dressed;
    scene.world.set(cup, renderer).unwrap();
    assert_eq!(has_clay(&scene), None);
}
