//! A scene as it is at one moment, to go back to.

use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use lightbench_assets::{Assets, MaterialId};
use lightbench_world::glam::Vec3;
use lightbench_world::{Entity, Snapshot};
use rhai::{Map, Scope};

use super::Scene;
use super::behaviours::{BehavioursSnapshot, Message};
use super::data::Data;
use super::materials::Material;
use super::models::Models;
use super::plots::Plots;
use super::recipes::Recipes;
use super::shelf::Shelf;
use crate::random::RowPlaces;

/// A scene at one moment. Made by [`Scene::snapshot`].
pub struct SceneSnapshot {
    world: Snapshot,
    assets: Assets,
    data: DataSnapshot,
    behaviours: BehavioursSnapshot,
    /// Where the rows of random numbers stood.
    rows: RowPlaces,
    /// Variables of the console.
    console: Scope<'static>,
    stopped: bool,
}

impl std::fmt::Debug for SceneSnapshot {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SceneSnapshot").finish_non_exhaustive()
    }
}

/// What the functions of scripts work on, beside the world and the assets.
struct DataSnapshot {
    recipes: Recipes,
    shelf: Shelf,
    models: Models,
    messages: Vec<Message>,
    aims: HashMap<Entity, Vec3>,
    /// Each material with whether it has a colour and a power of its own.
    materials: HashMap<MaterialId, (Material, [bool; 2])>,
    made: Vec<Entity>,
    names: HashMap<String, Entity>,
    triangles: usize,
    state: Map,
    plots: Plots,
}

impl DataSnapshot {
    fn of(data: &Data) -> Self {
        let material = |(id, material): (&MaterialId, &Material)| {
            let flags = material.flags().map(|flag| flag.load(Ordering::Relaxed));
            (*id, (material.clone(), flags))
        };
        Self {
            recipes: data.recipes.clone(),
            shelf: data.shelf.clone(),
            models: data.models.clone(),
            messages: data.messages.clone(),
            aims: data.aims.clone(),
            materials: data.materials.iter().map(material).collect(),
            made: data.made.clone(),
            names: data.names.clone(),
            triangles: data.triangles,
            state: data.state.contents(),
            plots: data.plots.clone(),
        }
    }

    fn give_back(&self, data: &mut Data) {
        data.recipes.clone_from(&self.recipes);
        data.shelf.clone_from(&self.shelf);
        data.models.clone_from(&self.models);
        data.messages.clone_from(&self.messages);
        data.aims.clone_from(&self.aims);
        data.materials.clear();
        for (id, (material, flags)) in &self.materials {
            for (flag, value) in material.flags().into_iter().zip(flags) {
                flag.store(*value, Ordering::Relaxed);
            }
            data.materials.insert(*id, material.clone());
        }
        data.made.clone_from(&self.made);
        data.names.clone_from(&self.names);
        data.triangles = self.triangles;
        data.state.replace(self.state.clone());
        data.plots.clone_from(&self.plots);
        // Keys and clicks that nobody was told of belong to the time that is taken back.
        data.input.take();
    }
}

impl Material {
    fn flags(&self) -> [&Arc<AtomicBool>; 2] {
        [&self.colored, &self.has_power]
    }
}

impl Scene {
    /// Takes note of everything that the scene is: its entities and assets, what its scripts and
    /// behaviours remember, and where their random numbers stand.
    #[must_use]
    pub fn snapshot(&self) -> SceneSnapshot {
        SceneSnapshot {
            world: self.world.snapshot(),
            assets: self.assets.clone(),
            data: DataSnapshot::of(&self.stage.lock()),
            behaviours: self.behaviours.keep(),
            rows: self.host.rows.places(),
            console: self.console.clone(),
            stopped: self.script.stopped,
        }
    }

    /// Makes everything as it was when the snapshot of this scene was taken. Handles that were valid
    /// then are valid again. The same steps from there give the same scene.
    pub fn restore(&mut self, snapshot: &SceneSnapshot) {
        self.world.restore(&snapshot.world);
        self.assets.clone_from(&snapshot.assets);
        snapshot.data.give_back(&mut self.stage.lock());
        self.behaviours
            .restore(&mut self.host, &snapshot.behaviours);
        snapshot.rows.restore();
        self.console.clone_from(&snapshot.console);
        self.script.stopped = snapshot.stopped;
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use lightbench_assets::Progress;

    use crate::testing::project;
    use crate::{Scene, Settings, load_scene};

    /// Remembers in every way that scripts have: `state`, a behaviour's state, a row of random
    /// numbers in a constant, materials, entities that come and go, a point that is looked at.
    const SCENE: &str = r#"
        const ROW = random(7);
        const CLAY = material("clay").color(0.5, 0.5, 0.5);
        state.steps = 0;
        spawn("ball").mesh(sphere(1)).material(CLAY).behave("count");
        spot_light("spot").at(0, 4, 0).look_at(1, 0, 0);
        spawn("sledge").velocity(1, 0, 0).spin(0, 90, 0);
        fn update(time, dt) {
            state.steps += 1;
            CLAY.color(ROW.float(), 0.5, 0.5);
            entity("spot").at(ROW.float(), 4, time);
            if state.steps == 2 { spawn("late").mesh(box(state.steps)).behave("other"); }
            if state.steps == 3 { entity("ball").remove(); let late = entity("late"); late.name = "ball"; }
            plot("steps", state.steps);
        }
    "#;
    const COUNT: &str = "state.seen = 0; fn update() { state.seen += 1; me.at(0, state.seen, 0); }";
    const OTHER: &str = "fn update(time) { me.at(time, 0, 9); }";

    /// The folder is needed while behaviours start.
    fn scene() -> (tempfile::TempDir, Scene) {
        let (folder, files) = project(&[
            ("scripts/scenes/test.rhai", SCENE),
            ("scripts/behaviours/count.rhai", COUNT),
            ("scripts/behaviours/other.rhai", OTHER),
        ]);
        let mut scene = load_scene(&files, "test", &Settings::new(), &Progress::new()).unwrap();
        // The numbers of a saved scene are given once.
        scene.to_text().unwrap();
        (folder, scene)
    }

    /// Everything that a scene shows in the four steps after the given one.
    fn go_on(scene: &mut Scene, from: u32) -> Vec<String> {
        let step = |step: u32| {
            let time = f64::from(step) / 60.0;
            scene.update(time, 1.0 / 60.0).unwrap();
            let mut shown = scene.to_text().unwrap();
            shown += &format!("{:?} {:?}", scene.behaviours(), scene.plots());
            shown
        };
        (from + 1..from + 5).map(step).collect()
    }

    #[test]
    fn the_same_steps_from_a_snapshot_give_the_same_scene_as_often_as_wanted() {
        let (_folder, mut scene) = scene();
        scene.update(1.0 / 60.0, 1.0 / 60.0).unwrap();
        let (snapshot, before) = (scene.snapshot(), scene.to_text().unwrap());
        let first = go_on(&mut scene, 1);
        assert_ne!(first[0], first[1]);
        assert!(first[3].contains("count.rhai") != first[0].contains("count.rhai"));
        for _ in 0..2 {
            scene.restore(&snapshot);
            assert_eq!(scene.to_text().unwrap(), before);
            assert_eq!(go_on(&mut scene, 1), first);
        }
    }

    #[test]
    fn a_script_that_an_error_stopped_goes_on_after_it_was_taken_back() {
        let (_folder, files) = project(&[(
            "scripts/scenes/test.rhai",
            "state.steps = 0; fn update() { state.steps += 1; if state.steps > 1 { nothing(); } }",
        )]);
        let mut scene = load_scene(&files, "test", &Settings::new(), &Progress::new()).unwrap();
        let snapshot = scene.snapshot();
        scene.update(0.0, 0.0).unwrap();
        scene.update(0.0, 0.0).unwrap_err();
        assert!(!scene.has_update());
        scene.restore(&snapshot);
        scene.update(0.0, 0.0).unwrap();
        scene.update(0.0, 0.0).unwrap_err();
    }
}
