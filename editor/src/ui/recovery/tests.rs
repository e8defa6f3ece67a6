#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;

use lightbench::script::Settings;
use lightbench::script::overlays::{Edit, KeptEdit, KeptOverlays, NewKind, Who};
use lightbench::world::glam::{Quat, Vec2, Vec3};
use lightbench::world::{ComponentKind, Transform, Value as Field};

use super::*;
use crate::ui::workbench::comparing::Mode;
use crate::ui::workbench::typed::Typed;
use crate::ui::workbench::undo::Dials;

/// A session with one of everything.
fn session() -> Session {
    let who = |name: &str| Who {
        name: name.to_owned(),
        nth: 3,
    };
    let field = |path: &str, value| ("a \"lamp\"\n".to_owned(), path.to_owned(), value);
    let fields = vec![
        field("light.intensity", Field::Float(0.1)),
        field("a", Field::Bool(true)),
        field("b", Field::Int(i64::MIN)),
        field("c", Field::Vec2(Vec2::new(1e-40, f32::MAX))),
        field("d", Field::Vec3(Vec3::new(1.0 / 3.0, -0.0, 16_777_217.0))),
        field("e", Field::Vec4(Vec3::ONE.extend(0.7))),
        field("f", Field::Quat(Quat::from_xyzw(0.1, 0.2, 0.3, 0.4))),
        field("g", Field::Text("ä %20".to_owned())),
    ];
    let of = vec![who("a"), who("")];
    let component = ComponentKind::Velocity;
    let edits = [
        Edit::Create {
            kind: NewKind::SpotLight,
            name: "spot light".to_owned(),
            number: 7,
            place: Transform {
                translation: Vec3::new(0.1, 0.2, 0.3),
                rotation: Quat::from_rotation_y(1.0),
                scale: Vec3::splat(1.1),
            },
        },
        Edit::Copy {
            of: of.clone(),
            names: vec![("a".to_owned(), "a 2".to_owned())],
            number: 9,
        },
        Edit::Delete { of: of.clone() },
        Edit::Rename {
            of: vec![(who("a"), "b".to_owned())],
        },
        Edit::Parent {
            of: of.clone(),
            to: Some(who("b")),
        },
        Edit::Parent {
            of: of.clone(),
            to: None,
        },
        Edit::Add {
            of: of.clone(),
            component,
        },
        Edit::Drop {
            of: of.clone(),
            component,
        },
        Edit::Tag {
            of,
            tag: "locked".to_owned(),
            on: true,
        },
    ];
    let edits = edits.into_iter().zip(1..).map(|(edit, greatest)| KeptEdit {
        edit,
        fields: fields[..1].to_vec(),
        greatest,
    });
    let overlays = KeptOverlays {
        edits: edits.collect(),
        fields: fields.clone(),
    };
    let settings = Settings::new()
        .with("lights", 256.0)
        .with("on", true)
        .with("model", "a=b");
    let typed = Typed {
        line: "spawn(\"ä\");\n".to_owned(),
        time: 0.1,
        edits: 3,
        changes: true,
    };
    Session {
        project: Some("/tmp/a project".into()),
        on_purpose: false,
        view: "lightbench-view-1 scene=a pipeline=b".to_owned(),
        plays: true,
        view_b: None,
        dials: Dials {
            mode: Mode::Flip,
            split: 0.3,
            automatic: false,
            rate: 1.5,
            gain: 8.0,
            false_colors: true,
            opacity: 0.5,
            speed: 0.1,
            steps: Some(60),
        },
        scenes: BTreeMap::from([("a".to_owned(), settings.clone())]),
        pipelines: BTreeMap::from([("b".to_owned(), settings)]),
        overlays: BTreeMap::from([("a".to_owned(), overlays)]),
        typed: BTreeMap::from([("a".to_owned(), vec![typed])]),
    }
}

#[test]
fn a_session_is_read_as_it_was_written() {
    let session = session();
    let text = session.to_json();
    let read = Session::from_json(&text).unwrap();
    assert_eq!(read, session);
    // The sign of a zero counts too.
    let fields = &read.overlays["a"].fields;
    let Field::Vec3(d) = fields[4].2 else {
        panic!("{:?}", fields[4])
    };
    assert!(d.y.is_sign_negative());
}

#[test]
fn what_is_damaged_is_no_session() {
    let text = session().to_json();
    for end in 0..text.len() {
        if text.is_char_boundary(end) {
            assert_eq!(Session::from_json(&text[..end]), None, "{end}");
        }
    }
    for (old, new) in [
        ("\"version\":1", "\"version\":2"),
        ("spot light\",\"name", "spotlight\",\"name"),
        ("Velocity", "Speed"),
    ] {
        assert!(text.contains(old), "{old} in {text}");
        assert_eq!(Session::from_json(&text.replace(old, new)), None, "{old}");
    }
}

fn open(root: &Path) -> Recovery {
    Recovery::open(Some(root.to_owned()), |_| true)
}

#[test]
fn a_session_is_kept_after_a_pause_and_left_to_the_next_run_alone() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("recovery");
    let mut first = open(&root);
    let now = Instant::now();
    first.note((0, 7), now, || panic!("nothing was changed"));
    assert_eq!(first.next_due(now), None);
    first.note((1, 7), now, || panic!("it is too soon"));
    assert!(first.next_due(now).is_some_and(|due| due <= PAUSE));
    first.note((2, 7), now + PAUSE, || Some(session()));
    first.note((2, 7), now + PAUSE * 2, || panic!("it is kept"));
    first.wait();
    assert!(open(&root).left.is_empty(), "it is being worked on");
    drop(first);
    let mut second = open(&root);
    assert_eq!(second.left.len(), 1);
    assert!(open(&root).left.is_empty(), "one run offers it");
    assert_eq!(second.take_over(), Some(session()));
    drop(second);
    // It went over into the file of the second run, which ended in the same way.
    let mut third = open(&root);
    assert_eq!(third.left.len(), 1);
    third.throw_away();
    drop(third);
    assert!(open(&root).left.is_empty());
    assert_eq!(fs::read_dir(&root).unwrap().count(), 0);
}

#[test]
fn what_was_given_up_is_not_offered() {
    let folder = tempfile::tempdir().unwrap();
    let mut first = open(folder.path());
    first.keep_now(session()).unwrap();
    first.forget();
    drop(first);
    assert!(open(folder.path()).left.is_empty());
    let mut first = open(folder.path());
    first.keep_now(session()).unwrap();
    drop(first);
    let other = Recovery::open(Some(folder.path().to_owned()), |_| false);
    assert!(other.left.is_empty());
    drop(other);
    assert_eq!(
        open(folder.path()).left.len(),
        1,
        "it waits for its project"
    );
}

#[test]
fn a_folder_that_cannot_be_made_is_told_once_and_tried_again() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("recovery");
    fs::write(&root, "a file").unwrap();
    let mut first = open(&root);
    let began = Instant::now();
    let mut told = Vec::new();
    for round in 0..40_u32 {
        let now = began + PAUSE * round;
        first.note((u64::from(round) + 1, 0), now, || Some(session()));
        first.wait();
        told.extend(first.take_news());
        if round == 20 {
            fs::remove_file(&root).unwrap();
        }
    }
    assert_eq!(told.len(), 2, "{told:?}");
    assert!(told[0].as_ref().is_err_and(|why| why.contains("not kept")));
    assert!(told[1].is_ok());
    drop(first);
    assert_eq!(open(&root).left.len(), 1);
}
