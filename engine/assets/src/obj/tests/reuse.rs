//! Loads after loads: the same as fresh ones, and no work done twice.

use std::collections::BTreeMap;

use super::*;
use crate::cache::Cache;

const MTL: &str = "newmtl a\nKd 0.5 0.5 0.5\nmap_Kd wood.png\nmap_d mask.png\nnewmtl b\nKd 0 1 0\n\
                   map_Bump bump.png\nnewmtl c\nmap_Kd gone.png\nKd oops\n";
const FACES: &str = "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\nusemtl c\nf 2 3 4\n";

struct Loads {
    fixture: Fixture,
    cache: Cache,
    made: BTreeMap<&'static str, u64>,
}

/// A model whose parts can be compared bit by bit.
#[derive(Debug, PartialEq)]
struct Parts {
    meshes: Vec<(Mesh, MaterialId)>,
    materials: Vec<Material>,
    textures: Vec<Texture>,
    warnings: Vec<Warning>,
}

impl From<Model> for Parts {
    fn from(model: Model) -> Self {
        let meshes = model.meshes.iter();
        let textures = model.textures.iter();
        Self {
            meshes: meshes.map(|(mesh, id)| (Mesh::clone(mesh), *id)).collect(),
            materials: model.materials,
            textures: textures.map(|texture| Texture::clone(texture)).collect(),
            warnings: model.warnings,
        }
    }
}

fn revisions(model: &Model) -> (Vec<u64>, Vec<u64>) {
    let meshes = model.meshes.iter();
    let textures = model.textures.iter();
    (
        meshes.map(|(mesh, _)| mesh.revision).collect(),
        textures.map(|texture| texture.revision).collect(),
    )
}

impl Loads {
    fn new() -> Self {
        let fixture = Fixture::new();
        fixture.write("x.obj", format!("mtllib x.mtl\n{SQUARE}{FACES}"));
        fixture.write("x.mtl", MTL);
        fixture.png("wood.png", |x, y| [x as u8 * 30, y as u8 * 30, 9, 255]);
        fixture.png("mask.png", |x, _| [x as u8 * 30; 4]);
        fixture.png("bump.png", |_, y| {
            [[y as u8 * 30; 3], [255; 3]].concat()[..4]
                .try_into()
                .unwrap()
        });
        Self {
            fixture,
            cache: Cache::default(),
            made: BTreeMap::new(),
        }
    }

    /// Loads, compares with a load that has nothing to reuse, and gives the model with the kinds of
    /// things that had to be made, and how many.
    fn load(&mut self) -> (Model, Vec<(&'static str, u64)>) {
        let reuse = self.cache.begin();
        let (files, options) = (&self.fixture.files, Options::default());
        let model = load(files, &reuse, "x.obj", &options, &Progress::new()).unwrap();
        reuse.finish();
        let fresh = self.fixture.load("x.obj").unwrap();
        assert_eq!(Parts::from(model.clone()), Parts::from(fresh));
        let made = self.cache.statistics().made;
        let mut new: Vec<(&'static str, u64)> = Vec::new();
        for (kind, count) in &made {
            let before = self.made.get(kind).copied().unwrap_or(0);
            if *count > before {
                new.push((*kind, *count - before));
            }
        }
        self.made = made;
        (model, new)
    }
}

#[test]
fn a_model_that_did_not_change_is_taken_as_it_is() {
    let mut loads = Loads::new();
    let (first, made) = loads.load();
    let expected = [
        ("mesh", 3),
        ("meshes of an obj", 1),
        ("mtl", 1),
        ("obj", 1),
        ("picture of an obj", 2),
    ];
    assert_eq!(made, expected);
    assert_eq!(first.warnings.len(), 2, "{:?}", first.warnings);
    for _ in 0..10 {
        let (again, made) = loads.load();
        assert_eq!(made, []);
        assert_eq!(revisions(&again), revisions(&first));
        assert_eq!(again.warnings, first.warnings);
    }
}

#[test]
fn only_what_hangs_on_a_changed_file_is_made_again() {
    let mut loads = Loads::new();
    let (first, _) = loads.load();
    let (meshes, textures) = revisions(&first);

    // A colour.
    loads.fixture.write("x.mtl", MTL.replace("0 1 0", "1 0 0"));
    let (model, made) = loads.load();
    assert_eq!(made, [("mtl", 1)]);
    assert_eq!(revisions(&model), (meshes.clone(), textures.clone()));
    assert_eq!(model.materials[1].base_color, Vec3::X);

    // The picture of a material.
    loads.fixture.png("wood.png", |x, _| [x as u8, 0, 0, 255]);
    let (model, made) = loads.load();
    assert_eq!(made, [("picture of an obj", 1)]);
    let (same, changed) = revisions(&model);
    assert_eq!(same, meshes);
    assert_ne!(changed[0], textures[0]);
    assert_eq!(changed[1], textures[1]);

    // Its mask.
    loads.fixture.png("mask.png", |_, y| [y as u8 * 30; 4]);
    let (_, made) = loads.load();
    assert_eq!(made, [("picture of an obj", 1)]);

    // A picture that is broken, with its warning each time, and mended.
    loads.fixture.write("mask.png", "no picture");
    for made_of in [1, 0] {
        let (model, made) = loads.load();
        let count: u64 = made.iter().map(|(_, count)| count).sum();
        assert_eq!(count, made_of);
        assert!(model.warnings.iter().any(|w| w.path == "mask.png"));
    }
    loads.fixture.png("mask.png", |_, y| [y as u8 * 30; 4]);
    let (model, made) = loads.load();
    assert_eq!(made, [], "this content was there before");
    assert_eq!(model.warnings.len(), 2);

    // A picture that was missing.
    loads.fixture.png("gone.png", |_, _| [1, 2, 3, 255]);
    let (model, made) = loads.load();
    assert_eq!(made, [("picture of an obj", 1)]);
    assert_eq!((model.textures.len(), model.warnings.len()), (3, 1));

    // One corner of the second mesh alone. It stays in the plane and in the bounds, on which normals
    // and projected texture coordinates of all of them hang.
    let moved = FACES.replace("f 1 3 4", "f 1 3 5");
    loads.fixture.write(
        "x.obj",
        format!("mtllib x.mtl\n{SQUARE}v 0.25 0.75 0\n{moved}"),
    );
    let (model, made) = loads.load();
    let expected = [("mesh", 1), ("meshes of an obj", 1), ("obj", 1)];
    assert_eq!(made, expected);
    let (changed, _) = revisions(&model);
    assert_eq!([changed[0], changed[2]], [meshes[0], meshes[2]]);
    assert_ne!(changed[1], meshes[1]);
}

#[test]
fn a_copy_with_the_dates_of_the_original_is_told_apart() {
    let mut loads = Loads::new();
    let path = loads.fixture.folder.path().join("x.mtl");
    let date = fs::metadata(&path).unwrap().modified().unwrap();
    loads.load();
    loads.fixture.write("x.mtl", MTL.replace("0 1 0", "0 0 1"));
    let file = fs::File::options().write(true).open(&path).unwrap();
    file.set_modified(date).unwrap();
    let (model, _) = loads.load();
    assert_eq!(model.materials[1].base_color, Vec3::Z);
    // And a new date alone changes nothing.
    let later = date + std::time::Duration::from_secs(100);
    file.set_modified(later).unwrap();
    assert_eq!(loads.load().1, []);
}

#[test]
fn options_and_names_are_part_of_what_a_model_is() {
    let mut loads = Loads::new();
    loads.load();
    let reuse = loads.cache.begin();
    let sharp = Options { crease_angle: 0.1 };
    let files = &loads.fixture.files;
    let model = load(files, &reuse, "x.obj", &sharp, &Progress::new()).unwrap();
    let fresh = load(files, &Reuse::default(), "x.obj", &sharp, &Progress::new());
    assert_eq!(Parts::from(model), Parts::from(fresh.unwrap()));

    let copy = fs::read(loads.fixture.folder.path().join("x.obj")).unwrap();
    loads.fixture.write("y.obj", copy);
    let files = &loads.fixture.files;
    let model = load(
        files,
        &reuse,
        "y.obj",
        &Options::default(),
        &Progress::new(),
    )
    .unwrap();
    assert_eq!(model.meshes[0].0.name, "y: a");
    let shown: Vec<_> = model.warnings.iter().map(|warning| &warning.path).collect();
    assert_eq!(shown, ["x.mtl", "x.mtl"]);
}
