//! Which camera a study looks through, where it is not the scene's first.

use lightbench_render::{Place, Problem, Problems, View};
use lightbench_script::Scene;
use lightbench_world::{Camera, Entity, Name, Transform};

use super::worker::StudyError;

/// Makes one camera the only one that is active.
pub(super) fn look_through(scene: &mut Scene, name: &str) -> Result<(), StudyError> {
    let wanted = scene.world.find(name);
    let wanted = wanted.filter(|entity| scene.world.get::<Camera>(*entity).is_some());
    let Some(wanted) = wanted else {
        let names = scene.world.columns::<Name>();
        let named = names.text().iter().zip(names.entities());
        let cameras: Vec<String> = named
            .filter(|(_, entity)| scene.world.get::<Camera>(**entity).is_some())
            .map(|(name, _)| format!("`{name}`"))
            .collect();
        let place = Place::new(scene.path.as_str(), 0, 0);
        let mut problem = Problem::new(place, format!("the scene has no camera `{name}`"));
        problem.hint = Some(match &cameras[..] {
            [] => "none of its cameras has a name".to_owned(),
            cameras => format!("its cameras are {}", cameras.join(", ")),
        });
        return Err(Problems::from(problem).into());
    };
    only_active(scene, wanted);
    Ok(())
}

/// Puts a camera of its own into a scene, and makes it the only one that is active.
pub(super) fn stand(scene: &mut Scene, view: &View) -> Result<(), StudyError> {
    let to_world = view.view.inverse();
    let (scale, rotation, translation) = to_world.to_scale_rotation_translation();
    let entity = scene.world.spawn();
    let transform = Transform {
        translation,
        rotation,
        scale,
    };
    let camera = Camera {
        fov_y: view.fov_y,
        near: view.near,
        far: view.far,
        active: true,
    };
    let placed = scene.world.insert(entity, transform);
    let placed = placed.and_then(|()| scene.world.insert(entity, camera));
    if let Err(error) = placed {
        let place = Place::new(scene.path.as_str(), 0, 0);
        let text = format!("the camera of the view can't stand in the scene: {error}");
        return Err(Problems::from(Problem::new(place, text)).into());
    }
    only_active(scene, entity);
    Ok(())
}

/// Makes one camera the only one that is active.
fn only_active(scene: &mut Scene, wanted: Entity) {
    let cameras: Vec<_> = scene.world.columns::<Camera>().entities().to_vec();
    for entity in cameras {
        if let Some(camera) = scene.world.get::<Camera>(entity) {
            let active = entity == wanted;
            // It is there, so it can be written.
            let _ = scene.world.set(entity, Camera { active, ..camera });
        }
    }
}
