#![allow(clippy::unwrap_used)]

use lightbench_assets::Progress;
use lightbench_world::glam::Vec3;
use lightbench_world::{
    Camera, ComponentKind, Entity, Light, MeshRenderer, Name, Transform, Value, Velocity,
};

use super::super::Overlays;
use super::*;
use crate::scene::Scene;
use crate::testing::project;
use crate::{Settings, load_scene};

/// A table with things on it, two of one name, one without, and a camera.
const ROOM: &str = r#"
spawn("table").mesh(box(2)).at(1, 0, 0).tag("furniture");
spawn("cup").mesh(sphere(0.5)).material(material("clay").color(0.5, 0.2, 0.1)).parent(entity("table")).at(0, 1, 0);
point_light("lamp").intensity(12).range(6).at(0, 2, 0).parent(entity("table"));
spawn("saucer").parent(entity("cup"));
spawn("twin").at(3, 0, 0);
spawn("twin").at(4, 0, 0);
spawn().at(5, 0, 0);
camera("eye").at(0, 3, 6).look_at(0, 0, 0);
"#;

fn scene(script: &str) -> Scene {
    let (_folder, files) = project(&[("scripts/scenes/test.rhai", script)]);
    load_scene(&files, "test", &Settings::new(), &Progress::new()).unwrap()
}

fn who(name: &str) -> Who {
    Who {
        name: name.to_owned(),
        nth: 0,
    }
}

fn find(scene: &Scene, name: &str) -> Entity {
    scene.world.find(name).unwrap()
}

fn create(kind: NewKind) -> Edit {
    Edit::Create {
        kind,
        name: String::new(),
        number: 0,
        place: Transform::from_translation(Vec3::new(0.0, 0.0, 2.0)),
    }
}

/// One of each kind.
fn all_edits() -> Vec<Edit> {
    vec![
        create(NewKind::Box),
        create(NewKind::Sphere),
        Edit::Copy {
            of: vec![who("table")],
            names: Vec::new(),
            number: 0,
        },
        Edit::Rename {
            of: vec![(who("lamp"), "desk lamp".to_owned())],
        },
        Edit::Parent {
            of: vec![who("desk lamp"), who("twin")],
            to: Some(who("cup")),
        },
        Edit::Parent {
            of: vec![who("saucer")],
            to: None,
        },
        Edit::Add {
            of: vec![who("saucer"), who("box")],
            component: ComponentKind::Light,
        },
        Edit::Drop {
            of: vec![who("cup")],
            component: ComponentKind::MeshRenderer,
        },
        Edit::Tag {
            of: vec![who("table"), who("eye")],
            tag: LOCKED.to_owned(),
            on: true,
        },
        Edit::Rename {
            of: vec![(
                Who {
                    name: String::new(),
                    nth: 0,
                },
                "named".to_owned(),
            )],
        },
        Edit::Delete {
            of: vec![
                who("table"),
                Who {
                    name: "twin".to_owned(),
                    nth: 1,
                },
            ],
        },
        create(NewKind::Box),
    ]
}

#[test]
fn every_kind_of_change_is_taken_back_exactly_and_done_again_exactly() {
    let (mut scene, mut overlays) = (scene(ROOM), Overlays::new());
    let mut texts = vec![scene.to_text().unwrap()];
    let mut rows = vec![format!("{:?}", scene.world.columns::<Camera>().entities())];
    let mut done = Vec::new();
    for edit in all_edits() {
        done.push(overlays.edit(&mut scene, edit).unwrap());
        texts.push(scene.to_text().unwrap());
        rows.push(format!("{:?}", scene.world.columns::<Camera>().entities()));
    }
    for pair in texts.windows(2) {
        assert_ne!(pair[0], pair[1]);
    }
    for _ in 0..2 {
        for at in (0..done.len()).rev() {
            assert_eq!(overlays.undo_edit(&mut scene), Some(done[at].clone()));
            assert_eq!(scene.to_text().unwrap(), texts[at], "{:?}", done[at]);
            assert_eq!(
                format!("{:?}", scene.world.columns::<Camera>().entities()),
                rows[at]
            );
        }
        assert!(overlays.is_empty() && overlays.undo_edit(&mut scene).is_none());
        for (edit, text) in done.iter().zip(&texts[1..]) {
            assert_eq!(&overlays.edit(&mut scene, edit.clone()).unwrap(), edit);
            assert_eq!(&scene.to_text().unwrap(), text, "{edit:?}");
        }
    }
    // The same on a scene that was loaded anew, and back from there.
    let mut again = self::scene(ROOM);
    overlays.lay_on(&mut again);
    assert_eq!(again.to_text().unwrap(), texts[done.len()]);
    for at in (0..done.len()).rev() {
        overlays.undo_edit(&mut again);
        assert_eq!(again.to_text().unwrap(), texts[at], "{:?}", done[at]);
    }
}

#[test]
fn what_is_made_and_copied_is_what_was_asked_for() {
    let (mut scene, mut overlays) = (scene(ROOM), Overlays::new());
    for kind in NewKind::ALL {
        overlays.edit(&mut scene, create(kind)).unwrap();
        let name = match kind {
            NewKind::Camera => "camera",
            other => other.name(),
        };
        let made = find(&scene, name);
        assert_eq!(overlays.made_last(), [made]);
        let place: Transform = scene.world.get(made).unwrap();
        assert_eq!(place.translation.z, 2.0);
        let has = [
            scene.world.has::<MeshRenderer>(made),
            scene.world.has::<Light>(made),
            scene.world.has::<Camera>(made),
        ];
        let wanted = match kind {
            NewKind::Empty => [false, false, false],
            NewKind::PointLight
            | NewKind::SpotLight
            | NewKind::DirectionalLight
            | NewKind::AmbientLight => [false, true, false],
            NewKind::Camera => [false, false, true],
            _ => [true, false, false],
        };
        assert_eq!(has, wanted, "{kind:?}");
    }
    // Two boxes share a mesh, and the second has a name of its own.
    overlays.edit(&mut scene, create(NewKind::Box)).unwrap();
    let mesh = |name: &str| {
        let renderer: MeshRenderer = scene.world.get(find(&scene, name)).unwrap();
        renderer.mesh
    };
    assert_eq!(mesh("box"), mesh("box 2"));
    assert_ne!(mesh("box"), mesh("sphere"));
    // Scripts find them.
    assert_eq!(
        scene.evaluate("entity(\"box 2\").name").unwrap().as_deref(),
        Some("\"box 2\"")
    );

    overlays
        .edit(
            &mut scene,
            Edit::Copy {
                of: vec![who("table")],
                names: Vec::new(),
                number: 0,
            },
        )
        .unwrap();
    let copy = find(&scene, "table 2");
    assert_eq!(overlays.made_last(), [copy]);
    let children: Vec<String> = scene
        .world
        .children(copy)
        .map(|child| scene.world.get::<Name>(child).unwrap().text)
        .collect();
    assert_eq!(children, ["cup 2", "lamp 2"]);
    let saucer = find(&scene, "saucer 2");
    assert_eq!(scene.world.parent(saucer), Some(find(&scene, "cup 2")));
    assert!(scene.world.tags().contains("furniture", copy));
    let lamp: Light = scene.world.get(find(&scene, "lamp 2")).unwrap();
    assert_eq!(lamp.intensity, 12.0);
}

#[test]
fn changed_fields_go_and_come_with_their_entities() {
    let (mut scene, mut overlays) = (scene(ROOM), Overlays::new());
    let set = |overlays: &mut Overlays, scene: &mut Scene, name: &str, value: f32| {
        let lamp = find(scene, name);
        let value = Value::Float(value);
        overlays.set(scene, lamp, "light.intensity", value).unwrap();
    };
    let intensity = |scene: &Scene, name: &str| {
        let lamp: Light = scene.world.get(find(scene, name)).unwrap();
        lamp.intensity
    };
    set(&mut overlays, &mut scene, "lamp", 40.0);
    // A copy has the change too, over the script's own value.
    let copy = Edit::Copy {
        of: vec![who("lamp")],
        names: Vec::new(),
        number: 0,
    };
    overlays.edit(&mut scene, copy).unwrap();
    assert_eq!(intensity(&scene, "lamp 2"), 40.0);
    let script = |overlays: &Overlays, name: &str| {
        let overlay = overlays.get(name, "light.intensity").unwrap();
        overlay.script.clone()
    };
    assert_eq!(script(&overlays, "lamp 2"), Some(Value::Float(12.0)));
    assert_eq!(script(&overlays, "lamp"), Some(Value::Float(12.0)));
    // A new name.
    let rename = Edit::Rename {
        of: vec![
            (who("lamp"), "lamp 2".to_owned()),
            (who("lamp 2"), "lamp".to_owned()),
        ],
    };
    set(&mut overlays, &mut scene, "lamp 2", 50.0);
    overlays.edit(&mut scene, rename).unwrap();
    assert_eq!(intensity(&scene, "lamp"), 50.0);
    assert_eq!(intensity(&scene, "lamp 2"), 40.0);
    assert!(overlays.reset(&mut scene, "lamp", "light.intensity"));
    assert_eq!(intensity(&scene, "lamp"), 12.0);
    // Removed with its entity, or with its component, and back with it.
    for edit in [
        Edit::Delete {
            of: vec![who("table")],
        },
        Edit::Drop {
            of: vec![who("lamp 2")],
            component: ComponentKind::Light,
        },
    ] {
        overlays.edit(&mut scene, edit).unwrap();
        assert_eq!(overlays.iter().count(), 0);
        overlays.undo_edit(&mut scene);
        assert_eq!(intensity(&scene, "lamp 2"), 40.0);
        assert_eq!(script(&overlays, "lamp 2"), Some(Value::Float(12.0)));
    }
    overlays.undo_edit(&mut scene);
    assert_eq!(intensity(&scene, "lamp"), 40.0);
    assert_eq!(script(&overlays, "lamp"), Some(Value::Float(12.0)));
    overlays.undo_edit(&mut scene);
    assert_eq!(overlays.iter().count(), 1, "the copy's are gone");
}

#[test]
fn changes_that_were_kept_lie_on_the_scene_of_another_run_as_they_did() {
    let (mut first, mut overlays) = (scene(ROOM), Overlays::new());
    let lamp = find(&first, "lamp");
    let value = Value::Float(0.1);
    overlays
        .set(&mut first, lamp, "light.intensity", value)
        .unwrap();
    for edit in all_edits() {
        overlays.edit(&mut first, edit).unwrap();
    }
    let kept = overlays.kept();
    assert_eq!(kept.edits.len(), all_edits().len());
    let fields = kept.edits.iter().map(|edit| edit.fields.len());
    assert_eq!(fields.sum::<usize>(), 1, "the lamp went with its table");

    let (mut second, mut again) = (scene(ROOM), Overlays::from_kept(kept.clone()));
    again.lay_on(&mut second);
    assert_eq!(second.to_text().unwrap(), first.to_text().unwrap());
    assert_eq!(again.kept(), kept);
    // And both are taken back alike, the changed fields of what was removed included.
    while let Some(edit) = overlays.undo_edit(&mut first) {
        assert_eq!(again.undo_edit(&mut second), Some(edit));
        assert_eq!(second.to_text().unwrap(), first.to_text().unwrap());
    }
    let lamp: Light = second.world.get(find(&second, "lamp")).unwrap();
    assert_eq!(lamp.intensity, 0.1);
}

#[test]
fn what_can_not_be_done_says_why_and_changes_nothing() {
    let (mut scene, mut overlays) = (scene(ROOM), Overlays::new());
    let before = scene.to_text().unwrap();
    let rename = |from: &str, to: &str| Edit::Rename {
        of: vec![(who(from), to.to_owned())],
    };
    let parent = |of: &str, to: &str| Edit::Parent {
        of: vec![who(of)],
        to: Some(who(to)),
    };
    let add = |of: &str, component| Edit::Add {
        of: vec![who(of)],
        component,
    };
    for (edit, why) in [
        (rename("lamp", "cup"), "another entity is called `cup`"),
        (rename("lamp", " "), "at least one letter"),
        (rename("nobody", "a"), "nothing is called `nobody`"),
        (parent("table", "saucer"), "table can't be put below saucer"),
        (parent("table", "table"), "table can't be put below table"),
        (parent("table", "nobody"), "nothing is called `nobody`"),
        (add("lamp", ComponentKind::Light), "all have Light already"),
        (add("lamp", ComponentKind::WorldBounds), "no component for"),
        (add("lamp", ComponentKind::ClipVolume), "needs a mesh"),
        (
            Edit::Drop {
                of: vec![who("lamp")],
                component: ComponentKind::Camera,
            },
            "none has Camera",
        ),
        (
            Edit::Drop {
                of: vec![who("lamp")],
                component: ComponentKind::Name,
            },
            "a name is changed",
        ),
        (Edit::Delete { of: Vec::new() }, "no entity is chosen"),
        (
            Edit::Delete {
                of: vec![who("lamp"), who("nobody")],
            },
            "nothing is called `nobody`",
        ),
    ] {
        let said = overlays.edit(&mut scene, edit.clone()).unwrap_err();
        assert!(said.contains(why), "{edit:?}: {said}");
        assert_eq!(scene.to_text().unwrap(), before, "{edit:?}");
    }
    assert!(overlays.is_empty());
    // The camera that no script made.
    let mut scene = self::scene("spawn(\"thing\");");
    let edit = Edit::Delete {
        of: vec![who("camera")],
    };
    let why = overlays.edit(&mut scene, edit).unwrap_err();
    assert!(why.contains("makes no camera"), "{why}");
}

#[test]
fn changes_wait_for_entities_that_the_script_does_not_make_any_more() {
    let (mut scene, mut overlays) = (scene(ROOM), Overlays::new());
    let delete = Edit::Delete {
        of: vec![who("lamp")],
    };
    overlays.edit(&mut scene, delete).unwrap();
    overlays.edit(&mut scene, create(NewKind::Cone)).unwrap();
    let waits = |overlays: &Overlays| overlays.edits().map(|(_, waits)| waits).collect::<Vec<_>>();
    assert_eq!(waits(&overlays), [false, false]);
    let mut other = self::scene(&ROOM.replace("\"lamp\"", "\"light\""));
    overlays.lay_on(&mut other);
    assert_eq!(waits(&overlays), [true, false]);
    assert!(other.world.find("cone").is_some());
    // It comes while time runs.
    other.evaluate("spawn(\"lamp\");").unwrap();
    overlays.follow(&mut other);
    assert_eq!(waits(&overlays), [false, false]);
    assert!(other.world.find("lamp").is_none());
    overlays.undo_edit(&mut other);
    overlays.undo_edit(&mut other);
    assert!(other.world.find("lamp").is_some());
}

#[test]
fn a_scene_that_is_taken_back_has_the_changes_that_were_made_since() {
    let (mut scene, mut overlays) = (scene(ROOM), Overlays::new());
    overlays.edit(&mut scene, create(NewKind::Box)).unwrap();
    let cut = Edit::Delete {
        of: vec![who("cup")],
    };
    overlays.edit(&mut scene, cut.clone()).unwrap();
    let (snapshot, before) = (scene.snapshot(), overlays.clone());
    // One less and two more, while time runs.
    overlays.undo_edit(&mut scene);
    let velocity = Edit::Add {
        of: vec![who("box")],
        component: ComponentKind::Velocity,
    };
    overlays.edit(&mut scene, velocity).unwrap();
    overlays.edit(&mut scene, create(NewKind::Torus)).unwrap();
    let lamp = find(&scene, "lamp");
    let value = Value::Float(40.0);
    overlays
        .set(&mut scene, lamp, "light.intensity", value)
        .unwrap();
    let wanted = scene.to_text().unwrap();
    scene.restore(&snapshot);
    overlays.taken_back(&mut scene, &before);
    assert_eq!(scene.to_text().unwrap(), wanted);
    assert!(scene.world.has::<Velocity>(find(&scene, "box")));
    assert!(scene.world.find("cup").is_some());
    // And everything is taken back from there.
    while overlays.undo_edit(&mut scene).is_some() {}
    overlays.reset_all(&mut scene);
    let mut first = self::scene(ROOM);
    assert_eq!(scene.to_text().unwrap(), first.to_text().unwrap());
    overlays.edit(&mut scene, cut).unwrap();
}
