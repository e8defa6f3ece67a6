#![allow(clippy::unwrap_used)]
use super::*;
use crate::components::{Behaviour, Repeat, RigidAnimation};
use crate::curve::{Curve, Interpolation};
use crate::value::{Parameters, Value};
use crate::{
    Camera, ComponentKind, Entity, Light, MeshRenderer, Name, Transform, Velocity, WorldError,
};
use glam::{Quat, Vec3};
use rand::{Rng, SeedableRng};

/// Assets called `mesh 0`, `mesh 1` and so on, up to nine.
struct Numbered;

impl AssetNames for Numbered {
    fn mesh_name(&self, mesh: MeshId) -> Option<String> {
        (mesh.0 < 10).then(|| format!("mesh {}", mesh.0))
    }
    fn material_name(&self, material: MaterialId) -> Option<String> {
        (material.0 < 10).then(|| format!("stone \"{}\"", material.0))
    }
    fn mesh(&mut self, name: &str) -> Result<MeshId, String> {
        let number = name.strip_prefix("mesh ").and_then(|n| n.parse().ok());
        number
            .map(MeshId)
            .ok_or_else(|| format!("there is no mesh `{name}`"))
    }
    fn material(&mut self, name: &str) -> Result<MaterialId, String> {
        let number = name
            .strip_prefix("stone \"")
            .and_then(|n| n.strip_suffix('"'));
        number
            .and_then(|n| n.parse().ok())
            .map(MaterialId)
            .ok_or_else(|| format!("there is no material `{name}`"))
    }
}

fn error(text: &str) -> String {
    read(text, &mut Numbered).unwrap_err().to_string()
}

fn odd_number(random: &mut impl Rng) -> f32 {
    // Any bits at all, so that every digit counts.
    f32::from_bits(random.random())
}

fn sample(seed: u64) -> World {
    let mut random = rand_pcg::Pcg64::seed_from_u64(seed);
    let mut world = World::new();
    let entities: Vec<Entity> = (0..40).map(|_| world.spawn()).collect();
    for (i, &entity) in entities.iter().enumerate() {
        let vector = Vec3::from_array(std::array::from_fn(|_| odd_number(&mut random)));
        let place = Transform {
            translation: vector,
            rotation: Quat::from_xyzw(vector.x, -0.0, f32::MIN_POSITIVE, 1e-40),
            scale: vector.zxy(),
        };
        world.insert(entity, place).unwrap();
        let text = [
            "",
            "a \"b\" \\ c",
            "two\nlines",
            "práctica ñ 日本",
            "\u{7}\t\r",
        ][i % 5];
        world.insert(entity, Name::new(text)).unwrap();
        if i % 3 == 0 {
            let renderer = MeshRenderer {
                mesh: MeshId(i as u32 / 2),
                material: MaterialId(i as u32 / 2),
                visible: i % 2 == 0,
            };
            world.insert(entity, renderer).unwrap();
            world.add_tag(entity, "drawn").unwrap();
        }
        if i > 0 {
            let parent = entities[random.random_range(0..i)];
            world.set_parent(entity, Some(parent)).unwrap();
        }
        if i % 4 == 1 {
            let parameters = vec![
                ("target".to_owned(), Value::Entity(entities[(i * 7) % 40])),
                (
                    "speeds".to_owned(),
                    Value::List(vec![Value::Int(-3), Value::Float(2.0)]),
                ),
                ("empty".to_owned(), Value::Map(Vec::new())),
                ("on".to_owned(), Value::Bool(true)),
            ];
            let behaviour = Behaviour {
                script: "spin.rhai".to_owned(),
                parameters: Parameters(parameters),
                enabled: false,
            };
            world.insert(entity, behaviour).unwrap();
            world.set_group(entity, Some("moving")).unwrap();
        }
    }
    let times = vec![0.0, 0.1, 2.5];
    let values = vec![Quat::IDENTITY, Quat::from_rotation_x(1.0), Quat::IDENTITY];
    let animation = RigidAnimation {
        rotation: Curve::new(times, values, Interpolation::Step).unwrap(),
        repeat: Repeat::PingPong,
        ..RigidAnimation::default()
    };
    world.insert(entities[3], animation).unwrap();
    world.insert(entities[4], Camera::default()).unwrap();
    let far = Camera {
        far: f32::INFINITY,
        ..Camera::default()
    };
    world.insert(entities[5], far).unwrap();
    world.insert(entities[6], Velocity::default()).unwrap();
    world.insert(entities[7], Light::default()).unwrap();
    world.despawn(entities[39]);
    world
}

#[test]
fn a_scene_round_trips_bit_for_bit() {
    for seed in 0..20 {
        let mut world = sample(seed);
        let text = write(&mut world, &Numbered);
        let mut again = read(&text, &mut Numbered).unwrap();
        assert_eq!(write(&mut again, &Numbered), text);
        assert_eq!(again.len(), world.len());
        // Not the text alone: every field of every component, by its bits.
        for (old, new) in world.entities().zip(again.entities()) {
            assert!(world.components_of(old).eq(again.components_of(new)));
            let (old_place, new_place): (Transform, Transform) =
                (world.get(old).unwrap(), again.get(new).unwrap());
            let bits = |place: Transform| {
                let numbers = [place.translation.to_array(), place.scale.to_array()];
                // All NaNs are written alike.
                let bits = |n: f32| if n.is_nan() { 0 } else { n.to_bits() };
                (
                    numbers.map(|v| v.map(bits)),
                    place.rotation.to_array().map(bits),
                )
            };
            assert_eq!(bits(old_place), bits(new_place));
            assert_eq!(world.get::<Name>(old), again.get::<Name>(new));
            assert_eq!(
                world.get::<RigidAnimation>(old),
                again.get::<RigidAnimation>(new)
            );
            assert_eq!(world.group_of(old), again.group_of(new));
            assert!(world.tags().of(old).eq(again.tags().of(new)));
        }
    }
}

#[test]
fn a_change_changes_only_its_own_lines() {
    let mut world = sample(1);
    let text = write(&mut world, &Numbered);
    let mut world = read(&text, &mut Numbered).unwrap();
    let third = world.entities().nth(2).unwrap();
    let new = world.spawn();
    world.insert(new, Name::new("new")).unwrap();
    let leaf = world
        .entities()
        .find(|&e| e != third && world.children(e).next().is_none() && world.parent(e).is_some());
    world.despawn(leaf.unwrap());
    world.insert(third, Name::new("renamed")).unwrap();
    let changed = write(&mut world, &Numbered);
    let lines: std::collections::HashSet<_> = text.lines().collect();
    let fresh: Vec<_> = changed.lines().filter(|l| !lines.contains(l)).collect();
    // The name, the parent's list of children, and the new entity with its name.
    assert!(fresh.len() <= 5, "{fresh:#?}");
    assert!(changed.contains("entity #40"));
}

#[test]
fn unknown_components_are_kept() {
    let text = "lightbench scene 2\n\nentity #7\n  Name\n    text = \"x\"\n  Wobble\n    \
                speed = 3 per second\n      deeper still\n";
    let mut world = read(text, &mut Numbered).unwrap();
    assert_eq!(write(&mut world, &Numbered), text);
    let windows = text.replace('\n', "\r\n");
    let mut world = read(&windows, &mut Numbered).unwrap();
    assert_eq!(write(&mut world, &Numbered), text);
}

#[test]
fn a_missing_field_has_its_default() {
    let text = "lightbench scene 1\nentity #1\n  Light\n    range = 3\n  Camera\n";
    let world = read(text, &mut Numbered).unwrap();
    let entity = world.entities().next().unwrap();
    let light = Light {
        range: 3.0,
        ..Light::default()
    };
    assert_eq!(world.get::<Light>(entity), Some(light));
    assert_eq!(world.get::<Camera>(entity), Some(Camera::default()));
}

#[test]
fn errors_name_the_line_and_what_would_do() {
    assert_eq!(
        error(""),
        "line 1: a scene file begins with `lightbench scene 2`"
    );
    assert!(error("lightbench scene 3\n").contains("written by a newer program"));
    let at = |lines: &str| error(&format!("lightbench scene 1\n{lines}"));
    assert!(at("entity 4").starts_with("line 2: expected `entity #` and a number"));
    assert_eq!(
        at("entity #1\nentity #1"),
        "line 3: entity #1 stands twice in this file"
    );
    assert_eq!(
        at("entity #1\n  Light\n    size = 1"),
        "line 4: Light has no field `size`; it has kind, color, intensity, range, \
         inner_angle, outer_angle, visible"
    );
    assert_eq!(
        at("entity #1\n  Light\n    range = \"far\""),
        "line 4: Light.range: expected a number, found text"
    );
    assert_eq!(
        at("entity #1\n  children = [#9]"),
        "line 3: there is no entity #9 in this file"
    );
    assert!(at("entity #1\n  children = [#1]").contains("cannot become a child"));
    assert!(at("entity #1\n  MeshRenderer\n    mesh = mesh \"x\"").contains("no mesh `x`"));
    assert!(at("entity #1\n    range = 1").contains("below a component"));
    assert!(at("  Light").contains("an entity must come first"));
    assert!(at("entity #1\n  Name\n    text = \"x").contains("no closing quotation mark"));
    assert!(at("entity #1\n  Light\n    color = (1, 2, 3").contains("found the end of the line"));
    let deep = format!(
        "entity #1\n  Behaviour\n    parameters = {}",
        "[".repeat(5000)
    );
    assert!(at(&deep).contains("more than 32 deep"));
}

/// No text may make the reader panic.
#[test]
fn broken_files_are_refused() {
    let mut random = rand_pcg::Pcg64::seed_from_u64(4);
    let text = write(&mut sample(2), &Numbered);
    let mut refused = 0;
    for _ in 0..2000 {
        let mut bytes = text.clone().into_bytes();
        for _ in 0..random.random_range(1..4) {
            let at = random.random_range(0..bytes.len());
            match random.random_range(0..3) {
                0 => bytes.truncate(at.max(1)),
                1 => drop(bytes.remove(at)),
                _ => bytes[at] = b" #=\"()[]{},\n\\x9-"[random.random_range(0..16)],
            }
        }
        let broken = String::from_utf8_lossy(&bytes);
        refused += usize::from(read(&broken, &mut Numbered).is_err());
    }
    assert!(refused > 500);
}

#[test]
fn files_are_replaced_as_a_whole() {
    let folder = std::env::temp_dir().join(format!("lightbench-scene-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("práctica 1 ñ.scene");
    let mut world = sample(3);
    save(&path, &mut world, &Numbered).unwrap();
    save(&path, &mut world, &Numbered).unwrap();
    let mut loaded = load(&path, &mut Numbered).unwrap();
    assert_eq!(write(&mut loaded, &Numbered), write(&mut world, &Numbered));
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1);
    std::fs::write(&path, "lightbench scene 1\nx").unwrap();
    let message = load(&path, &mut Numbered).unwrap_err().to_string();
    assert!(message.contains("1 ñ.scene, line 2: expected"), "{message}");
    let missing = folder.join("nowhere").join("a.scene");
    assert!(save(&missing, &mut world, &Numbered).is_err());
    std::fs::remove_dir_all(&folder).unwrap();
}

/// What version 1 wrote must be read for ever.
#[test]
fn version_1_is_read() {
    let text = include_str!("version_1.scene");
    let mut world = read(text, &mut Numbered).unwrap();
    let [room, lamp] = [1, 2].map(|i| world.entities().nth(i - 1).unwrap());
    assert_eq!(world.parent(lamp), Some(room));
    assert_eq!(world.get::<Light>(lamp).unwrap().intensity, 40.5);
    assert_eq!(world.get::<Name>(room), Some(Name::new("room")));
    assert_eq!(world.get::<MeshRenderer>(room).unwrap().mesh, MeshId(3));
    assert!(world.tags().contains("lit", lamp));
    // What is written is the same, but for the version and a field that lights have got since.
    let newer = text.replacen("scene 1", "scene 2", 1);
    let newer = newer.replacen("angle = 0.75\n", "angle = 0.75\n    visible = true\n", 1);
    assert_eq!(write(&mut world, &Numbered), newer);
    // Computed components are refused by name, not taken for unknown ones.
    let set = world.set_field(room, "WorldMatrix", "matrix", &Value::Bool(true));
    assert_eq!(set, Err(WorldError::Computed("WorldMatrix")));
    assert!(ComponentKind::from_name("Light").is_some());
}

use glam::Vec3Swizzles;

/// Keeps what it is told to make.
#[derive(Default)]
struct Kept(Vec<(String, String, String)>);

impl AssetNames for Kept {
    fn definitions(&self) -> Vec<Definition> {
        let definition = |(_, name, recipe): &(String, String, String)| Definition {
            kind: "mesh",
            name: name.clone(),
            recipe: recipe.clone(),
        };
        self.0.iter().map(definition).collect()
    }
    fn define(&mut self, kind: &str, name: &str, recipe: &str) -> Result<(), String> {
        if recipe == "bad" {
            return Err("it is bad".to_owned());
        }
        self.0.push((kind.into(), name.into(), recipe.into()));
        Ok(())
    }
    fn mesh_name(&self, mesh: MeshId) -> Option<String> {
        self.0.get(mesh.0 as usize).map(|(_, name, _)| name.clone())
    }
    fn material_name(&self, _: MaterialId) -> Option<String> {
        None
    }
    fn mesh(&mut self, name: &str) -> Result<MeshId, String> {
        let at = self.0.iter().position(|(_, known, _)| known == name);
        at.map(|at| MeshId(at as u32))
            .ok_or_else(|| format!("there is no mesh `{name}`"))
    }
    fn material(&mut self, name: &str) -> Result<MaterialId, String> {
        Err(format!("there is no material `{name}`"))
    }
}

#[test]
fn assets_are_defined_before_they_are_named() {
    let text = "lightbench scene 2\n\nmesh \"a \\\"b\\\" = c\" = sphere(1) + \"x = y\"\nmesh \"two\" = box(1)\n\n\
                entity #1\n  MeshRenderer\n    mesh = mesh \"two\"\n    material = material 0\n    visible = true\n";
    let mut assets = Kept::default();
    let mut world = read(text, &mut assets).unwrap();
    assert_eq!(assets.0[0].1, "a \"b\" = c");
    assert_eq!(assets.0[0].2, "sphere(1) + \"x = y\"");
    assert_eq!(write(&mut world, &assets), text);
    let fails = |lines: &str| {
        let text = format!("lightbench scene 2\n{lines}");
        read(&text, &mut Kept::default()).unwrap_err().to_string()
    };
    assert_eq!(fails("mesh \"a\" = bad"), "line 2: it is bad");
    assert!(fails("mesh \"a\" box").contains("expected ` = `"));
    assert!(fails("mesh a = box").starts_with("line 2"));
    assert!(fails("entity #1\nmesh \"a\" = box").contains("before the first entity"));
    // Where nobody makes assets, a file that defines some is refused.
    assert!(error("lightbench scene 2\nmesh \"a\" = b").contains("can't be made here"));
}
