//! What a script takes to move ten thousand entities: by columns, by one call each, and what plain
//! Rhai takes for the same arithmetic alone.
//!
//! Run with `cargo bench -p lightbench-script --bench moving`. All sides run in turn in one process,
//! and the middle of each is printed with the bars.

use std::time::Duration;

use lightbench_assets::Progress;
use lightbench_assets::files::Files;
use lightbench_script::{CountingAllocator, Scene, Settings, load_scene};
use lightbench_world::SystemTime;
use rhai::{AST, Dynamic, Engine, Scope};

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

const COUNT: usize = 10_000;
const ROUNDS: usize = 60;
/// The bar of the batch form, for script and binding together.
const BATCH_BAR: Duration = Duration::from_millis(2);
/// The bar of one call each, in the time of plain Rhai.
const CALLS_BAR: f64 = 3.0;

/// Ten thousand entities, and where each is on its way.
const SETUP: &str = r#"
for i in 0..COUNT { spawn("mote " + i); }
let chance = random(1);
state.motes = entities().named("mote *");
state.phase = chance.floats(COUNT, 0, 6.28);
state.phases = state.phase.to_array();
state.all = state.motes.to_array();
let flights = [];
for mote in state.motes { flights.push(#{ mote: mote, phase: chance.range(0, 6.28) }); }
state.flights = flights;
"#;

/// The ways to move them. Each puts an entity on a circle.
const WAYS: [(&str, &str); 7] = [
    (
        "columns",
        "let angle = state.phase + time;
         state.motes.set(\"transform.translation\", vec3(cos(angle) * 3, 1, sin(angle) * 3));",
    ),
    (
        "columns, read and changed",
        "let place = state.motes.get(\"transform.translation\");
         place += normalize(vec3(0, 2, 0) - place) * dt + vec3(noise(place.x, time), 0, 0) * dt;
         state.motes.set(\"transform.translation\", place);",
    ),
    (
        "one call each, by selection",
        "let motes = state.motes;
         let phase = state.phase;
         for i in 0..COUNT {
             let angle = phase[i] + time;
             motes[i].at(cos(angle) * 3, 1, sin(angle) * 3);
         }",
    ),
    (
        "one call each, by array",
        "let motes = state.all;
         let phase = state.phases;
         for i in 0..COUNT {
             let angle = phase[i] + time;
             motes[i].at(cos(angle) * 3, 1, sin(angle) * 3);
         }",
    ),
    (
        "one call each, field by name",
        "let motes = state.all;
         let phase = state.phases;
         for i in 0..COUNT {
             let angle = phase[i] + time;
             motes[i].set(\"transform.translation\", vec3(cos(angle) * 3, 1, sin(angle) * 3));
         }",
    ),
    (
        "one call each, map for each",
        "for flight in state.flights {
             let angle = flight.phase + time;
             flight.mote.at(cos(angle) * 3, 1, sin(angle) * 3);
         }",
    ),
    (
        "one call each, found by name",
        "let phase = state.phases;
         for i in 0..COUNT {
             let angle = phase[i] + time;
             entity(\"mote \" + i).at(cos(angle) * 3, 1, sin(angle) * 3);
         }",
    ),
];

/// The loop of one call each, with an array in place of the engine.
const PLAIN: &str = "
for i in 0..COUNT {
    let angle = phases[i] + time;
    places[i] = [cos(angle) * 3, 1, sin(angle) * 3];
}";

fn scene(update: &str) -> Scene {
    let text = format!("const COUNT = {COUNT};\n{SETUP}\nfn update(time, dt) {{ {update} }}");
    let folder = tempfile::tempdir().expect("a folder for the scene");
    let path = folder.path().join("scripts/scenes");
    std::fs::create_dir_all(&path).expect("a folder for the scene");
    std::fs::write(path.join("moving.rhai"), text).expect("a scene on the disk");
    let files = Files::with_project(folder.path()).expect("a project");
    match load_scene(&files, "moving", &Settings::new(), &Progress::new()) {
        Ok(scene) => scene,
        Err(problems) => panic!("{problems}"),
    }
}

/// Time of one frame's script.
fn step(scene: &mut Scene, frame: usize) -> Duration {
    if let Err(problem) = scene.update(frame as f64 / 60.0, 1.0 / 60.0) {
        panic!("{problem}");
    }
    let script = scene.system_times().find(|time| time.name == "script");
    script.map_or(Duration::ZERO, |time| time.thread)
}

struct Plain {
    engine: Engine,
    ast: AST,
    scope: Scope<'static>,
}

impl Plain {
    fn new() -> Self {
        let engine = Engine::new();
        let mut scope = Scope::new();
        let phases: rhai::Array = (0..COUNT).map(|i| Dynamic::from(i as f64 * 1e-3)).collect();
        scope.push("phases", phases);
        scope.push("places", rhai::Array::from(vec![Dynamic::UNIT; COUNT]));
        scope.push_constant("COUNT", COUNT as i64);
        scope.push("time", 0.0);
        let ast = engine.compile_with_scope(&scope, PLAIN).expect("a loop");
        Self { engine, ast, scope }
    }

    fn step(&mut self, frame: usize) -> Duration {
        self.scope.set_value("time", frame as f64 / 60.0);
        let (time, result) = SystemTime::of("plain", || {
            self.engine.run_ast_with_scope(&mut self.scope, &self.ast)
        });
        result.expect("a loop that runs");
        time.thread
    }
}

fn middle(mut times: Vec<Duration>) -> Duration {
    times.sort();
    times[times.len() / 2]
}

fn main() {
    let mut scenes = WAYS.map(|(_, update)| scene(update));
    let mut plain = Plain::new();
    let mut times = vec![Vec::new(); WAYS.len() + 1];
    for frame in 0..ROUNDS {
        times[WAYS.len()].push(plain.step(frame));
        for (scene, times) in scenes.iter_mut().zip(&mut times) {
            times.push(step(scene, frame));
        }
    }
    let times: Vec<Duration> = times.into_iter().map(middle).collect();
    let plain = times[WAYS.len()];
    println!("moving {COUNT} entities in a frame, CPU time of the script and its calls");
    println!("{:32} {:8.3} ms", "plain Rhai, into an array", ms(plain));
    for ((name, _), time) in WAYS.iter().zip(&times) {
        let ratio = time.as_secs_f64() / plain.as_secs_f64();
        let within = if name.starts_with("columns") {
            *time <= BATCH_BAR
        } else {
            ratio <= CALLS_BAR
        };
        let verdict = if within { "within" } else { "OUTSIDE" };
        println!(
            "{name:32} {:8.3} ms  {ratio:6.3} of plain Rhai  {verdict} the bar",
            ms(*time)
        );
    }
}

fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
