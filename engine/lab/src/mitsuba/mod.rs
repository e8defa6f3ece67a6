//! A scene for Mitsuba 3 (Jakob et al. 2022, "Mitsuba 3 renderer"), another path tracer.
//!
//! The scene's XML has meshes as PLY files, textures as PNG or EXR, camera and lights. Mitsuba has other
//! reflection models and other falloffs; what has no counterpart is left out or replaced, and listed by
//! name in [`Exported::left_out`] and in the file.

mod lights;
mod materials;
mod ply;
mod xml;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use glam::{Affine3A, DVec3};
use lightbench_assets::{Assets, Mesh};
use lightbench_render::View;
use lightbench_world::{MaterialId, MeshId, MeshRenderer, World, WorldMatrix};

use crate::LabError;
use crate::files::write_atomically;
use xml::Xml;

/// What was written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Exported {
    /// The scene's file.
    pub scene: PathBuf,
    /// How many files lie beside it.
    pub files: usize,
    /// What Mitsuba's scene does not have, a sentence each without its end.
    pub left_out: Vec<String>,
}

/// Writes `scene.xml` and what it needs into a folder. The world's matrices must be up to date.
///
/// # Errors
/// A folder that can't be written.
pub fn export(
    world: &World,
    assets: &Assets,
    view: &View,
    size: (u32, u32),
    folder: &Path,
) -> Result<Exported, LabError> {
    let mut export = Export {
        assets,
        folder,
        files: 0,
        meshes: BTreeMap::new(),
        left_out: BTreeSet::new(),
        shines: false,
        xml: Xml::default(),
    };
    export.xml.open("scene", &[("version", "3.0.0")]);
    export.integrator();
    export.camera(view, size);
    let objects = objects(world, assets);
    let used: BTreeSet<u32> = objects.iter().map(|object| object.material.0).collect();
    for material in used {
        export.material(MaterialId(material))?;
    }
    for object in &objects {
        export.object(object)?;
    }
    export.lights(world);
    export.finish()
}

/// An object that is drawn.
struct Object {
    mesh: MeshId,
    material: MaterialId,
    matrix: Affine3A,
}

fn objects(world: &World, assets: &Assets) -> Vec<Object> {
    let renderers = world.columns::<MeshRenderer>();
    let rows = renderers.entities().iter().enumerate();
    rows.filter_map(|(row, entity)| {
        let renderer = renderers.row(row);
        let has_triangles = assets
            .mesh(renderer.mesh)
            .is_some_and(|mesh| mesh.triangle_count() > 0);
        let known = assets.material(renderer.material).is_some();
        (renderer.visible && has_triangles).then(|| Object {
            mesh: renderer.mesh,
            material: if known {
                renderer.material
            } else {
                MaterialId(0)
            },
            matrix: world.get::<WorldMatrix>(*entity).unwrap_or_default().matrix,
        })
    })
    .collect()
}

/// A scene on its way out.
struct Export<'a> {
    assets: &'a Assets,
    folder: &'a Path,
    files: usize,
    /// Names of the files of meshes.
    meshes: BTreeMap<u32, String>,
    left_out: BTreeSet<String>,
    /// Whether a surface shines.
    shines: bool,
    xml: Xml,
}

impl Export<'_> {
    fn integrator(&mut self) {
        self.xml.open("integrator", &[("type", "path")]);
        self.xml.value("integer", "max_depth", "-1");
        self.xml.close();
    }

    fn camera(&mut self, view: &View, (width, height): (u32, u32)) {
        let to_world = view.view.as_dmat4().inverse();
        let axis = |axis: glam::DVec4| axis.truncate();
        let eye = axis(to_world.w_axis);
        let (ahead, up) = (-axis(to_world.z_axis), axis(to_world.y_axis));
        self.xml.open("sensor", &[("type", "perspective")]);
        self.xml.value("string", "fov_axis", "y");
        self.xml.number("fov", f64::from(view.fov_y).to_degrees());
        self.xml.number("near_clip", view.near.into());
        // Its depth is finite.
        let far = if view.far.is_finite() { view.far } else { 1e6 };
        self.xml.number("far_clip", far.into());
        self.xml.look_at(eye, eye + ahead, up);
        self.xml.open("sampler", &[("type", "independent")]);
        self.xml.value("integer", "sample_count", "64");
        self.xml.close();
        self.xml.open("film", &[("type", "hdrfilm")]);
        self.xml.value("integer", "width", &width.to_string());
        self.xml.value("integer", "height", &height.to_string());
        self.xml.empty("rfilter", &[("type", "box")]);
        self.xml.close();
        self.xml.close();
    }

    fn object(&mut self, object: &Object) -> Result<(), LabError> {
        let assets = self.assets;
        let Some(mesh) = assets.mesh(object.mesh) else {
            return Ok(());
        };
        // Mitsuba does not turn the winding of mirrored meshes round.
        let mirrored = object.matrix.matrix3.determinant() < 0.0;
        let file = if mirrored {
            let mut turned = Mesh::default();
            turned.append(mesh, object.matrix);
            self.write(
                &format!("meshes/turned_{}.ply", self.files),
                &ply::encode(&turned),
            )?
        } else if let Some(file) = self.meshes.get(&object.mesh.0) {
            file.clone()
        } else {
            let name = format!("meshes/{}.ply", object.mesh.0);
            let file = self.write(&name, &ply::encode(mesh))?;
            self.meshes.insert(object.mesh.0, file.clone());
            file
        };
        self.xml.open("shape", &[("type", "ply")]);
        self.xml.value("string", "filename", &file);
        if !mirrored {
            self.xml.transform(&object.matrix);
        }
        self.xml
            .empty("ref", &[("id", &materials::id(object.material))]);
        self.emission(object.material);
        self.xml.close();
        Ok(())
    }

    /// Writes a file beside the scene. Gives its name.
    fn write(&mut self, name: &str, bytes: &[u8]) -> Result<String, LabError> {
        write_atomically(&self.folder.join(name), bytes)?;
        self.files += 1;
        Ok(name.to_owned())
    }

    fn leave_out(&mut self, what: String) {
        self.left_out.insert(what);
    }

    fn finish(mut self) -> Result<Exported, LabError> {
        for what in &self.left_out {
            self.xml.comment(&format!("not here: {what}"));
        }
        let scene = self.folder.join("scene.xml");
        write_atomically(&scene, self.xml.finish().as_bytes())?;
        Ok(Exported {
            scene,
            files: self.files,
            left_out: self.left_out.into_iter().collect(),
        })
    }
}

/// Whether a colour is black.
fn is_black(color: DVec3) -> bool {
    color.max_element() <= 0.0
}
