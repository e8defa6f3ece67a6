//! Models from OBJ files.

use std::sync::Arc;

use lightbench_assets::obj::{self, ModelError, Options};
use lightbench_world::{Entity, MeshRenderer, Transform};

use super::data::{Data, Stage};
use crate::api::{Api, Arguments, Mistake};

pub(super) fn register(api: &mut Api, stage: &Stage) {
    for form in ["load_obj(path)", "load_obj(path, crease)"] {
        let stage = stage.clone();
        api.function(
            form,
            "Reads a model with its materials and pictures, and makes an entity of it; each \
             material is a child. Faces that meet at more than `crease` degrees (60 unless told) \
             keep an edge where the file has no normals.",
            move |a| {
                let path = a.text(0)?;
                let mut options = Options::default();
                if a.len() == 2 {
                    options.crease_angle = a.number_in(1, 0.0, 180.0)?.to_radians() as f32;
                }
                load(&mut stage.lock(), a, &path, &options)
            },
        );
    }
}

fn load(data: &mut Data, a: &Arguments, path: &str, options: &Options) -> Result<Entity, Mistake> {
    data.read.insert(path.to_owned());
    let watch = Arc::clone(&data.watch);
    let (files, progress) = (data.files.clone(), data.progress.clone());
    let model = watch
        .free_of_charge(|| obj::load(&files, path, options, &progress))
        .map_err(|error| match error {
            ModelError::Cancelled(_) => Mistake::new("the script was stopped"),
            error => Mistake::new(error.to_string()),
        })?;
    for warning in &model.warnings {
        data.log.add(a.place(), warning.to_string());
    }
    data.count_triangles(model.triangle_count())?;
    let shown = files.display(path);
    let name = shown.rsplit(['/', '\\']).next().unwrap_or(&shown);
    let name = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let root = data.spawn(name)?;
    for (index, (mesh, material)) in model.add_to(&mut data.assets).into_iter().enumerate() {
        let part = data.spawn(&format!("{name} {}", index + 1))?;
        data.insert(part, Transform::default())?;
        data.insert(
            part,
            MeshRenderer {
                mesh,
                material,
                visible: true,
            },
        )?;
        data.world
            .set_parent(part, Some(root))
            .map_err(|error| Mistake::new(error.to_string()))?;
    }
    Ok(root)
}
