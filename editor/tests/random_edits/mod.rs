//! Random changes of a scene by hand, through the editor's model: what was saved at the beginning is
//! there again once all were taken back, and what was saved at the end once all were done again.

#![allow(clippy::unwrap_used)]

mod assets;

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::render::{Gpu, GpuOptions};
use lightbench::script::overlays::NewKind;
use lightbench::script::{Settings, load_scene};
use lightbench::world::glam::Vec3;
use lightbench::world::{Camera, ComponentKind, Entity, Transform, Value};
use lightbench_editor::ui::EditorOptions;
use lightbench_editor::ui::workbench::Workbench;
use lightbench_editor::ui::workbench::log::Level;
use tempfile::TempDir;

/// A scene that stands still: a tree, tags, names that several share, one that is kept turned to a
/// point, a light with a clip volume, textures, and cameras whose order counts.
const SCENE: &str = r#"
let clay = material("clay").color(0.5, 0.2, 0.1);
let tiles = material("tiles").texture(tiles_texture());
spawn("floor").mesh(plane(9, 9)).material(tiles);
spawn("table").mesh(box(2)).at(1, 0, 0).tag("furniture").rotate(0, 30, 0);
for i in 0..6 {
    spawn(`cup ${i}`).mesh(sphere(0.5)).material(clay).parent(entity("table")).at(i, 1, 0).scale(0.5);
}
spawn("saucer").parent(entity("cup 2")).at(0, -0.1, 0).tag("furniture").tag("flat");
for i in 0..3 { spawn("twin").at(i, 0, 4); }
spawn().mesh(box(1)).at(5, 0, 0);
point_light("lamp").intensity(12).range(6).at(0, 2, 0).clip_volume(box(9));
spot_light("spot").intensity(30).at(2, 4, 1).look_at(0, 0, 0);
spawn("sledge").velocity(1, 0, 0).spin(0, 90, 0);
camera("eye").at(0, 3, 6).look_at(0, 0, 0);
camera("other").at(8, 3, 0).active(false);
"#;

/// Entities that a scene has at most.
const MOST: usize = 90;

/// Longer than a load may take.
const PATIENCE: Duration = Duration::from_secs(60);

/// Numbers that look random, by Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number
/// Generators".
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }

    fn number(&mut self, from: f32, to: f32) -> f32 {
        from + (to - from) * (self.next() >> 40) as f32 / (1_u64 << 24) as f32
    }
}

/// How often each thing was done.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Changes that were made.
    pub changes: usize,
    /// Changes that were refused.
    pub refused: usize,
    /// Steps that were taken back.
    pub undone: usize,
    /// Steps that were done again.
    pub redone: usize,
    /// Saves, each read again.
    pub saved: usize,
    /// Loads of the scene's script.
    pub loaded: usize,
    /// Steps that were there to be taken back at the end.
    pub steps: usize,
}

struct Desk {
    workbench: Workbench,
    random: Random,
    counts: Counts,
    files: Files,
    // Last, so that the watcher ends before the folder does.
    _folder: TempDir,
}

/// Does so many random things, then takes all back and does all again. A load of the script comes
/// every `load_every` things.
///
/// # Panics
/// Where a scene is not what it should be.
pub fn run(seed: u64, operations: usize, load_every: usize) -> Counts {
    let mut desk = Desk::open(seed);
    let first = desk.text();
    for done in 1..=operations {
        desk.do_something();
        if done % load_every == 0 {
            desk.load();
        } else if done % (load_every / 2).max(1) == 0 {
            desk.save();
        }
    }
    // What the last operations took back is part of what can be done again.
    while desk.workbench.redo() {}
    desk.counts.steps = desk.workbench.undo.done().len();
    // Both ways go through the same scenes; of many, through some hundreds is enough.
    let every = (desk.counts.steps / 300).max(1);
    let mut scenes = BTreeMap::new();
    loop {
        let steps = desk.workbench.undo.done().len();
        if steps.is_multiple_of(every) || steps == desk.counts.steps {
            scenes.insert(steps, desk.text());
        }
        if !desk.workbench.undo() {
            break;
        }
    }
    assert_same(&desk.text(), &first, "all was taken back");
    loop {
        let done = desk.workbench.undo.done();
        let (steps, last) = (done.len(), done.last().map(|step| step.what.clone()));
        if let Some(wanted) = scenes.get(&steps) {
            assert_same(&desk.text(), wanted, &format!("{last:?} was done again"));
        }
        if !desk.workbench.redo() {
            break;
        }
    }
    assert_eq!(desk.workbench.undo.done().len(), desk.counts.steps);
    // And once more from a scene that was loaded anew.
    desk.load();
    while desk.workbench.undo() {}
    assert_same(&desk.text(), &first, "all was taken back after a load");
    let wrong = desk.workbench.log.lines();
    let wrong: Vec<_> = wrong.filter(|line| line.level == Level::Error).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
    desk.counts
}

fn assert_same(text: &str, wanted: &str, when: &str) {
    if text != wanted {
        let pairs = text.lines().zip(wanted.lines()).enumerate();
        let mut different = pairs
            .filter(|(_, (a, b))| a != b)
            .map(|(line, (a, b))| format!("line {}: `{a}` instead of `{b}`", line + 1));
        let first = different.next();
        let entity = text.lines().zip(wanted.lines()).take_while(|(a, b)| a == b);
        let entity = entity.filter(|(a, _)| a.starts_with("entity")).last();
        let lines = [text, wanted].map(|text| text.lines().count());
        panic!("{when}: {first:?} in {entity:?}; lines: {lines:?}");
    }
}

impl Desk {
    fn open(seed: u64) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let scenes = folder.path().join("scripts/scenes");
        std::fs::create_dir_all(&scenes).unwrap();
        std::fs::write(scenes.join("room.rhai"), SCENE).unwrap();
        std::fs::write(folder.path().join("leaf.obj"), assets::MODEL).unwrap();
        let files = Files::with_project(folder.path()).unwrap();
        let gpu = Gpu::open(&GpuOptions::default()).unwrap();
        let options = EditorOptions {
            scene: "room".to_owned(),
            ..EditorOptions::new(files.clone())
        };
        let workbench = Workbench::new(gpu, options, Arc::new(|| {}));
        let mut desk = Self {
            workbench,
            random: Random(seed),
            counts: Counts::default(),
            files,
            _folder: folder,
        };
        desk.settle(0);
        desk.workbench.clock.playing = false;
        desk
    }

    /// Ticks until a load after so many swaps is there.
    fn settle(&mut self, swaps: u64) {
        let began = Instant::now();
        // Time stands still.
        let now = Instant::now();
        loop {
            self.workbench.clock.playing = false;
            self.workbench.tick(now);
            let scenes = &self.workbench.scenes;
            if scenes.swaps() > swaps && !scenes.is_busy() {
                return;
            }
            let problems: Vec<String> =
                self.workbench.problems().map(ToString::to_string).collect();
            assert!(problems.is_empty(), "{problems:?}");
            assert!(began.elapsed() < PATIENCE, "the scene does not load");
            std::thread::sleep(Duration::from_micros(200));
        }
    }

    fn text(&mut self) -> String {
        let scene = self.workbench.scenes.scene_mut().unwrap();
        scene.to_text().unwrap()
    }

    /// Loads the script anew: all changes lie over it as before.
    fn load(&mut self) {
        let before = self.text();
        let swaps = self.workbench.scenes.swaps();
        self.workbench.scenes.reload();
        self.settle(swaps);
        assert_same(&self.text(), &before, "the script was loaded anew");
        self.counts.loaded += 1;
    }

    /// Saves the scene and reads the file: it holds the same.
    fn save(&mut self) {
        let text = self.text();
        self.workbench.save_scene("saved").unwrap();
        let nothing = (Settings::new(), Progress::new());
        let saved = load_scene(
            &self.files,
            "scripts/scenes/saved.scene",
            &nothing.0,
            &nothing.1,
        );
        let mut saved = saved.unwrap();
        // A scene without a camera gets one.
        if !saved.world.columns::<Camera>().is_empty() && text.contains("  Camera\n") {
            assert_same(&saved.to_text().unwrap(), &text, "the file was read");
        }
        self.counts.saved += 1;
    }

    fn entities(&self) -> Vec<Entity> {
        let scene = self.workbench.scenes.scene().unwrap();
        scene.world.entities().collect()
    }

    fn any(&mut self) -> Option<Entity> {
        let all = self.entities();
        let place = self.random.below(all.len());
        all.get(place).copied()
    }

    /// Chooses one to three entities.
    fn choose(&mut self) -> Vec<Entity> {
        let count = 1 + self.random.below(3);
        let chosen: Vec<Entity> = (0..count).filter_map(|_| self.any()).collect();
        let scene = self.workbench.scenes.scene().unwrap();
        self.workbench.selection.set(scene, chosen);
        self.workbench.selection.entities().collect()
    }

    fn do_something(&mut self) {
        let result = match self.random.below(130) {
            0..12 if self.entities().len() < MOST => {
                let kind = NewKind::ALL[self.random.below(NewKind::ALL.len())];
                self.workbench.create(kind)
            }
            12..20 if self.entities().len() < MOST => {
                self.choose();
                self.workbench.duplicate_chosen()
            }
            0..28 => {
                self.choose();
                self.workbench.delete_chosen()
            }
            28..42 => {
                let chosen = self.choose();
                let to = match self.random.below(4) {
                    0 => None,
                    _ => self.any(),
                };
                self.workbench.put_below(&chosen, to)
            }
            42..50 => {
                self.choose();
                let name = format!("name {}", self.random.below(40));
                self.workbench.rename_chosen(&name)
            }
            50..68 => self.change_a_field(),
            68..73 => {
                self.choose();
                let kind = self.component();
                self.workbench.add_component(kind)
            }
            73..78 => {
                self.choose();
                let kind = self.component();
                self.workbench.drop_component(kind)
            }
            78..81 => {
                let chosen = self.choose();
                let on = self.random.below(2) == 0;
                self.workbench.show_entities(&chosen, on)
            }
            81..84 => {
                let chosen = self.choose();
                let on = self.random.below(2) == 0;
                self.workbench.lock_entities(&chosen, on)
            }
            84..86 => {
                self.reset_something();
                Ok(())
            }
            86 if self.random.below(20) == 0 => {
                self.workbench.reset_all_fields();
                Ok(())
            }
            100..130 => self.change_assets(),
            86..94 => {
                for _ in 0..1 + self.random.below(6) {
                    self.counts.undone += usize::from(self.workbench.undo());
                }
                return;
            }
            _ => {
                for _ in 0..1 + self.random.below(4) {
                    self.counts.redone += usize::from(self.workbench.redo());
                }
                return;
            }
        };
        match result {
            Ok(()) => self.counts.changes += 1,
            Err(_) => self.counts.refused += 1,
        }
    }

    fn component(&mut self) -> ComponentKind {
        let all = [
            ComponentKind::Transform,
            ComponentKind::MeshRenderer,
            ComponentKind::Light,
            ComponentKind::Camera,
            ComponentKind::Velocity,
            ComponentKind::RigidAnimation,
            ComponentKind::ClipVolume,
        ];
        all[self.random.below(all.len())]
    }

    fn change_a_field(&mut self) -> Result<(), String> {
        let chosen = self.choose();
        let a = Vec3::from_array([0; 3].map(|_| self.random.number(-4.0, 4.0)));
        let (path, value) = match self.random.below(7) {
            0 => ("transform.translation", Value::Vec3(a)),
            1 => ("transform.scale", Value::Vec3(a.abs() + Vec3::splat(0.1))),
            2 => {
                let turn = Transform::looking_at(Vec3::ZERO, a, Vec3::Y).rotation;
                ("transform.rotation", Value::Quat(turn))
            }
            3 => ("light.intensity", Value::Float(a.x.abs())),
            4 => ("light.color", Value::Vec3(a.abs())),
            5 => ("camera.fov_y", Value::Float(0.5 + a.x.abs() * 0.2)),
            _ => ("velocity.linear", Value::Vec3(a)),
        };
        let fields: Vec<(Entity, &str, Value)> = chosen
            .into_iter()
            .map(|entity| (entity, path, value.clone()))
            .collect();
        let result = self.workbench.set_fields("a field", &fields);
        self.workbench.undo.seal();
        result
    }

    fn reset_something(&mut self) {
        let overlays = self.workbench.overlays_now();
        let mut all: Vec<String> = overlays
            .into_iter()
            .flat_map(|all| all.iter().map(|(name, ..)| name.to_owned()))
            .collect();
        all.dedup();
        let place = self.random.below(all.len());
        if let Some(name) = all.get(place) {
            self.workbench
                .reset_fields(std::slice::from_ref(name), None);
        }
    }
}
