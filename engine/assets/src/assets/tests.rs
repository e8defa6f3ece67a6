#![allow(clippy::unwrap_used)]
use super::*;

fn mesh(name: &str) -> Mesh {
    crate::procedural::cuboid(glam::Vec3::ONE).named(name)
}

#[test]
fn the_first_ids_are_the_stand_ins() {
    let assets = Assets::new();
    assert_eq!(assets.material(MaterialId(0)), Some(&Material::default()));
    let texture = assets.texture(TextureId::PLACEHOLDER).unwrap();
    assert_eq!(
        texture.pixel(0, 0, 0).unwrap().to_array(),
        [1.0, 0.0, 1.0, 1.0]
    );
    assert_eq!(
        texture.pixel(0, 8, 0).unwrap().to_array(),
        [0.0, 0.0, 0.0, 1.0]
    );
}

#[test]
fn other_values_of_a_material_leave_the_roster_and_another_name_does_not() {
    let mut assets = Assets::new();
    let id = assets.add_material(Material {
        name: "clay".to_owned(),
        ..Material::default()
    });
    let (all, roster) = (assets.revision(), assets.roster_revision());
    let mut material = assets.material(id).unwrap().clone();
    material.opacity = 0.5;
    assets.replace_material(id, material.clone()).unwrap();
    assert_ne!(assets.revision(), all);
    assert_eq!(assets.roster_revision(), roster);
    material.name = "brick".to_owned();
    assets.replace_material(id, material).unwrap();
    assert_ne!(assets.roster_revision(), roster);
    let roster = assets.roster_revision();
    assets.add_mesh(mesh("a"));
    assert_ne!(assets.roster_revision(), roster);
}

#[test]
fn only_what_changed_has_a_new_revision() {
    let mut assets = Assets::new();
    let first = assets.add_mesh(mesh("a"));
    let second = assets.add_mesh(mesh("b"));
    let before: Vec<u64> = assets.meshes().iter().map(|entry| entry.revision).collect();
    assert!(assets.revision() > before[1]);
    let half = crate::procedural::cuboid(glam::Vec3::splat(0.5)).named("a");
    assets.replace_mesh(first, half).unwrap();
    assert_eq!(assets.meshes()[1].revision, before[1]);
    assert!(assets.meshes()[0].revision > before[1]);
    assert_eq!(
        assets.mesh_bounds()[0].half_extents,
        glam::Vec3::splat(0.25)
    );
    assert_eq!(
        assets.mesh_bounds()[second.0 as usize].half_extents,
        glam::Vec3::splat(0.5)
    );
}

#[test]
fn clones_that_part_never_share_a_new_revision() {
    let mut one = Assets::new();
    let id = one.add_mesh(mesh("a"));
    let mut other = one.clone();
    assert!(Arc::ptr_eq(one.mesh(id).unwrap(), other.mesh(id).unwrap()));
    one.replace_mesh(id, mesh("x")).unwrap();
    other.replace_mesh(id, mesh("y")).unwrap();
    assert_ne!(one.revision(), other.revision());
    assert_ne!(one.meshes()[0].revision, other.meshes()[0].revision);
}

#[test]
fn what_is_shared_has_one_revision_in_all_tables() {
    let (mut one, mut other) = (Assets::new(), Assets::new());
    let placeholder = TextureId::PLACEHOLDER.0 as usize;
    assert_eq!(
        one.textures()[placeholder].revision,
        other.textures()[placeholder].revision
    );
    let shared = Shared::shared(mesh("a"));
    one.add_shared_mesh(shared.clone());
    let before = other.revision();
    other.add_shared_mesh(shared);
    assert_eq!(one.meshes()[0].revision, other.meshes()[0].revision);
    assert_ne!(other.revision(), before);
    assert_ne!(other.revision(), one.revision());
}

#[test]
fn names_find_the_latest_and_follow_replacement() {
    let mut assets = Assets::new();
    let first = assets.add_mesh(mesh("a"));
    let second = assets.add_mesh(mesh("a"));
    assert_eq!(assets.find_mesh("a"), Some(second));
    assets.replace_mesh(second, mesh("b")).unwrap();
    assert_eq!(assets.find_mesh("a"), Some(first));
    assert_eq!(assets.find_mesh("b"), Some(second));
    assets.replace_mesh(first, mesh("b")).unwrap();
    assert_eq!(assets.find_mesh("a"), None);
    assert_eq!(assets.find_mesh("b"), Some(second));
    assert_eq!(assets.find_material("default"), Some(MaterialId(0)));
    assert_eq!(assets.find_texture("placeholder"), Some(TextureId(0)));
}

#[test]
fn what_was_added_last_can_be_dropped() {
    let mut assets = Assets::new();
    let first = assets.add_mesh(mesh("a"));
    let (counts, revision) = (assets.counts(), assets.revision());
    assets.truncate(counts);
    assert_eq!(assets.revision(), revision, "nothing has changed");
    assets.add_mesh(mesh("a"));
    assets.add_mesh(mesh("b"));
    assets.add_material(Material::default());
    assets.truncate(counts);
    assert_eq!(assets.counts(), counts);
    assert_eq!(assets.mesh_bounds().len(), 1);
    assert!(assets.revision() > revision);
    assert_eq!(assets.find_mesh("a"), Some(first));
    assert_eq!(assets.find_mesh("b"), None);
    assert_eq!(assets.find_material("default"), Some(MaterialId(0)));
    let none = AssetCounts {
        meshes: 0,
        materials: 0,
        textures: 0,
    };
    assets.truncate(none);
    assert_eq!(assets.material(MaterialId(0)), Some(&Material::default()));
    assert!(assets.texture(TextureId::PLACEHOLDER).is_some());
}

#[test]
fn unknown_ids_are_refused() {
    let mut assets = Assets::new();
    let error = assets.replace_mesh(MeshId(7), mesh("a")).unwrap_err();
    assert_eq!(error.to_string(), "there is no mesh 7; the scene has 0");
    assert!(assets.material(MaterialId(1)).is_none());
}
