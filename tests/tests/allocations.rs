//! A frame takes no memory from the heap, but for what wgpu and rayon take for themselves.
#![allow(clippy::unwrap_used)]
// An allocator is unsafe by its nature. This one passes everything on.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::backtrace::Backtrace;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use lightbench::render::{Pipeline, View};
use lightbench::script::{Settings, list_pipelines};
use lightbench::world::glam::Vec3;
use lightbench_tests::{Studio, Workshop};

/// The system's allocator, which notes who asks while somebody listens.
struct Listening;

static LISTENS: AtomicBool = AtomicBool::new(false);
static HEARD: Mutex<Vec<String>> = Mutex::new(Vec::new());

thread_local! {
    // Constant and without a destructor, so that reading it allocates nothing.
    static NOTING: Cell<bool> = const { Cell::new(false) };
}

/// Notes the stack of an allocation; not those that the noting itself makes.
fn note() {
    if !LISTENS.load(Ordering::Relaxed) || NOTING.replace(true) {
        return;
    }
    let stack = Backtrace::force_capture().to_string();
    HEARD.lock().unwrap().push(stack);
    NOTING.set(false);
}

// SAFETY: every call goes unchanged to `System`, which keeps the contract.
unsafe impl GlobalAlloc for Listening {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        note();
        // SAFETY: the caller keeps the contract of `GlobalAlloc::alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of `GlobalAlloc::dealloc`.
        unsafe { System.dealloc(memory, layout) };
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        note();
        // SAFETY: the caller keeps the contract of `GlobalAlloc::realloc`.
        unsafe { System.realloc(memory, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Listening = Listening;

/// Whose code asked for memory: the innermost on the stack that is neither the standard library nor a
/// container. Each entry of a stack is a number and a symbol, and a file below it where the crate was
/// built with debug information, as the engine is; what is inlined has no path in its symbol.
fn owner(stack: &str) -> &'static str {
    const OWNERS: [(&str, &str); 8] = [
        ("wgpu", "wgpu"),
        ("naga", "wgpu"),
        ("ash", "wgpu"),
        ("gpu_allocator", "wgpu"),
        ("gpu-allocator", "wgpu"),
        ("rayon", "rayon"),
        ("crossbeam", "rayon"),
        ("rhai", "scripts"),
    ];
    let root = env!("CARGO_MANIFEST_DIR").trim_end_matches("tests");
    let own = |file: &str| {
        file.strip_prefix(root)
            .is_some_and(|f| f.starts_with("engine/"))
    };
    let mut lines = stack.lines().map(str::trim_start).peekable();
    while let Some(line) = lines.next() {
        let Some((number, symbol)) = line.split_once(": ") else {
            continue;
        };
        if number.parse::<u32>().is_err() {
            continue;
        }
        let file = lines.peek().and_then(|next| next.strip_prefix("at "));
        if file.is_some_and(own) {
            return "the engine";
        }
        let symbol = symbol.trim_start_matches(['<', '&', '(', '[', '*', '_']);
        let in_registry = file.and_then(|file| file.split("/registry/src/").nth(1));
        let of_crate = in_registry.and_then(|file| file.split_once('/'));
        let name = of_crate.map_or(symbol, |(_, file)| file);
        if let Some((_, owner)) = OWNERS.iter().find(|(part, _)| name.starts_with(part)) {
            return owner;
        }
    }
    "others"
}

/// The sizes of the pictures of each frame: those of the viewports that are open. Each is a series.
const VIEWPORTS: [(u32, u32); 2] = [(96, 64), (61, 83)];

/// Draws frames in some viewports, and gives the stacks of what they allocate.
fn frames(
    studio: &mut Studio,
    pipeline: &mut Pipeline,
    viewports: usize,
    frames: Range<u32>,
) -> Vec<String> {
    // From above; the other one is the scene's camera.
    let eye = Vec3::new(1.0, 9.0, 5.0);
    let above = View::look_at(eye, Vec3::ZERO, 1.0, 0.1, 100.0);
    let views = [studio.view, above];
    for frame in frames {
        let time = f64::from(frame) / 60.0;
        studio.scene.update(time, 1.0 / 60.0).unwrap();
        let (world, assets) = (&mut studio.scene.world, &studio.scene.assets);
        for (series, (view, size)) in views.iter().zip(VIEWPORTS).take(viewports).enumerate() {
            studio
                .renderer
                .render_in(series, world, assets, pipeline, view, size, time)
                .unwrap();
            studio.renderer.poll().unwrap();
        }
    }
    std::mem::take(&mut *HEARD.lock().unwrap())
}

/// Things that move without a script: systems move them.
const MOVING: &str = "
camera().at(0, 6, 14).look_at(0, 0, 0);
spawn().mesh(plane(30, 30));
let ball = mesh(sphere(0.4).segments(12, 8));
let glass = material(\"glass\").opacity(0.5);
let leaf = material(\"leaf\").texture(checker_texture(4).size(16)).cutoff(0.5);
for i in 0..60 {
    let it = spawn().mesh(ball).at(i % 10 - 5, 0.5, i / 10 - 3).velocity(0.1, 0, 0).spin(0, 30, 0);
    if i % 7 == 0 { it.material(glass); }
    if i % 7 == 1 { it.material(leaf); }
}
for i in 0..40 {
    point_light().range(3).intensity(2).at(i % 8 - 4, 1, i / 8 - 2).velocity(0, 0, 0.2);
}
ambient_light().intensity(0.1);
directional_light().aim(-1, -1, -1);
";

/// The same where nothing moves but time.
fn still() -> String {
    let words = MOVING.replace(".velocity(0.1, 0, 0).spin(0, 30, 0)", "");
    words.replace(".velocity(0, 0, 0.2)", "")
}

#[test]
fn no_frame_of_any_pipeline_allocates() {
    let workshop = Workshop::new();
    workshop.write("scripts/scenes/moving.rhai", MOVING);
    let still = still();
    assert!(!still.contains("velocity") && !still.contains("spin"));
    workshop.write("scripts/scenes/still.rhai", &still);
    let mut studio = Studio::new("cornell_box", &Settings::new());
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(2)
        .build()
        .unwrap();
    let mut faults = String::new();
    let pipelines = list_pipelines(&studio.files).unwrap();
    for (scene, viewports) in [("moving", 1), ("moving", 2), ("still", 2)] {
        studio.show(workshop.files.clone(), scene);
        for entry in &pipelines {
            let mut pipeline = studio.compile(&entry.name, &Settings::new());
            let heard = pool.install(|| {
                frames(&mut studio, &mut pipeline, viewports, 0..12);
                LISTENS.store(true, Ordering::Relaxed);
                let heard = frames(&mut studio, &mut pipeline, viewports, 12..15);
                LISTENS.store(false, Ordering::Relaxed);
                heard
            });
            let name = format!("{} of {scene} in {viewports}", entry.name);
            let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
            for stack in &heard {
                let owner = owner(stack);
                *counts.entry(owner).or_default() += 1;
                if owner != "wgpu" && owner != "rayon" {
                    faults.push_str(&format!("--- {name}, {owner}\n{stack}\n"));
                }
            }
            println!("{name}: in three frames {counts:?}");
            assert!(counts.contains_key("wgpu"), "nothing was heard");
        }
    }
    assert!(faults.is_empty(), "{faults}");
}
