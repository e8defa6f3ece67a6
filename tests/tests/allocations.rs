//! A frame takes no memory from the heap, but for what wgpu and rayon take for themselves.
#![allow(clippy::unwrap_used)]
// An allocator is unsafe by its nature. This one passes everything on.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::backtrace::Backtrace;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use lightbench::render::Pipeline;
use lightbench::script::{Settings, list_pipelines};
use lightbench_tests::{Studio, settings};

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

/// The crate whose code asked for memory: the innermost on the stack that is no container.
fn owner(stack: &str) -> &'static str {
    const OWNERS: [(&str, &str); 6] = [
        ("lightbench", "the engine"),
        ("wgpu", "wgpu"),
        ("naga", "wgpu"),
        ("rayon", "rayon"),
        ("crossbeam", "rayon"),
        ("gpu_allocator", "wgpu"),
    ];
    for line in stack.lines() {
        // As in `  12: <wgpu_core::device::Device as …>::method`.
        let Some((number, symbol)) = line.trim_start().split_once(": ") else {
            continue;
        };
        if number.parse::<u32>().is_err() || symbol.contains("allocations::") {
            continue;
        }
        let symbol = symbol.trim_start_matches(['<', '&', '(', '[']);
        let path = symbol.trim_start_matches("dyn ");
        let found = OWNERS.iter().find(|(name, _)| path.starts_with(name));
        if let Some((_, owner)) = found {
            return owner;
        }
    }
    "others"
}

/// Draws frames, and gives the stacks of what they allocate.
fn frames(studio: &mut Studio, pipeline: &mut Pipeline, first: u32, count: u32) -> Vec<String> {
    for frame in first..first + count {
        let time = f64::from(frame) / 60.0;
        studio.scene.update(time, 1.0 / 60.0).unwrap();
        let (world, assets) = (&mut studio.scene.world, &studio.scene.assets);
        studio
            .renderer
            .render(world, assets, pipeline, &studio.view, (96, 64), time)
            .unwrap();
        studio.renderer.poll().unwrap();
    }
    std::mem::take(&mut *HEARD.lock().unwrap())
}

#[test]
fn no_frame_of_any_pipeline_allocates() {
    let mut studio = Studio::new("many_lights", &settings(&["lights=40", "spheres=60"]));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(2)
        .build()
        .unwrap();
    let mut faults = String::new();
    for entry in list_pipelines(&studio.files).unwrap() {
        let mut pipeline = studio.compile(&entry.name, &Settings::new());
        let heard = pool.install(|| {
            frames(&mut studio, &mut pipeline, 0, 12);
            LISTENS.store(true, Ordering::Relaxed);
            let heard = frames(&mut studio, &mut pipeline, 12, 3);
            LISTENS.store(false, Ordering::Relaxed);
            heard
        });
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        for stack in &heard {
            let owner = owner(stack);
            *counts.entry(owner).or_default() += 1;
            if owner != "wgpu" && owner != "rayon" {
                faults.push_str(&format!("--- {}, {owner}\n{stack}\n", entry.name));
            }
        }
        println!("{}: in three frames {counts:?}", entry.name);
        assert!(counts.contains_key("wgpu"), "nothing was heard");
    }
    assert!(faults.is_empty(), "{faults}");
}
