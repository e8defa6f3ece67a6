//! Lists of cells of the world: every light that reaches a point is on the list of its cell; a light
//! that moves fills its old and its new cells again and no others; and what is left is what a grid
//! that is filled from nothing would hold.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeSet;

use glam::{DVec3, Vec3};
use lightbench::render::Pipeline;
use lightbench::render::gpu_data::LightData;
use lightbench::world::{Entity, Light, Transform};
use lightbench_tests::buffers::{OPENED, opened, words};
use lightbench_tests::grid::{Grid, ROOM};
use lightbench_tests::lists::{Found, before, of_fixed_room, run, shown};
use lightbench_tests::pixels::Pixels;
use lightbench_tests::{Mistake, Numbers, Studio, project, project_with_mistake, settings};
use tempfile::TempDir;

const SIZE: (u32, u32) = (203, 151);
const GRIDS: [Grid; 3] = [
    Grid {
        cell: 2.0,
        layers: 1,
    },
    Grid {
        cell: 0.75,
        layers: 1,
    },
    Grid {
        cell: 1.5,
        layers: 16,
    },
];

// --- What lists hold -------------------------------------------------------------------------------

fn of_cells(studio: &mut Studio, grid: Grid, mistake: Option<Mistake<'_>>) -> [Found; 2] {
    let texts = grid.texts();
    let texts = texts.each_ref().map(String::as_str);
    let buffers = [("cell_lists", grid.words())];
    let (depth, found, counts) = run(
        studio,
        "world_indexed_forward",
        &texts,
        SIZE,
        &buffers,
        mistake,
    );
    assert_eq!(counts.of("cells_over_capacity"), 0);
    let lists = of_fixed_room(&found[0], ROOM, grid.cells());
    assert!(lists.iter().all(|list| list.is_sorted()));
    let pixels = Pixels::of(&studio.renderer);
    // Lights without a range have a list of their own.
    let lights = studio
        .renderer
        .lights()
        .iter()
        .map(|light| match light.kind {
            0 | 1 => *light,
            _ => LightData {
                range: 0.0,
                kind: 0,
                ..*light
            },
        });
    let lights: Vec<LightData> = lights.collect();
    let in_cell = |asked| grid.cell_of(asked);
    [
        Found::look(&lists, &lights, shown(&pixels, &depth).filter_map(in_cell)),
        Found::look(&lists, &lights, before(&pixels, &depth).filter_map(in_cell)),
    ]
}

#[test]
fn lists_of_cells_hold_every_light_that_reaches_them() {
    for (scene, texts) in [
        ("many_lights", &["lights=120", "range=2"][..]),
        ("atrium", &[]),
        ("hard_cases", &["case=wide_spot"]),
    ] {
        let mut studio = Studio::new(scene, &settings(texts));
        for grid in GRIDS {
            let [surfaces, anywhere] = of_cells(&mut studio, grid, None);
            let what = format!("{scene} {texts:?}, {grid:?}");
            surfaces.print(&what);
            anywhere.print("    before surfaces");
            assert_eq!([surfaces.missing, anywhere.missing], [0; 2], "{what}");
            // Most of a cell is air, which lights reach though they reach no surface there: measured
            // 10 to 51 %.
            assert!(surfaces.in_vain * 5 < surfaces.listed * 3);
        }
    }
}

/// Must-fail twins.
#[test]
fn mistakes_of_cells_are_caught() {
    let mut studio = Studio::new("many_lights", &settings(&["lights=120", "range=2"]));
    for (path, from, to) in [
        (
            "shaders/lib/world_grid.wgsl",
            "coordinates(ball.center + ball.radius, cell_size)",
            "coordinates(ball.center, cell_size)",
        ),
        (
            "shaders/lib/world_grid.wgsl",
            "vec3f(first + ahead) * cell_size",
            "vec3f(first + ahead) * cell_size + 0.5",
        ),
        (
            "shaders/lib/world_grid.wgsl",
            "wrap(cell - first)",
            "cell - first",
        ),
    ] {
        let [found, _] = of_cells(&mut studio, GRIDS[0], Some((path, from, to)));
        println!("`{to}`: {found:?}");
        assert!(found.missing > 0, "`{to}` went unnoticed");
    }
}

// --- Lights that move ------------------------------------------------------------------------------

/// Lamps and spots all over a field that is wider than some of the grids.
const FIELD: &str = "
spawn(\"floor\").mesh(plane(120, 120));
let chance = random(5);
for i in 0..40 {
    point_light(\"lamp \" + i).at(chance.range(-50, 50), chance.range(0.5, 6), chance.range(-50, 50))
        .range(chance.range(1, 6)).intensity(3);
}
for i in 0..8 {
    spot_light(\"spot \" + i).at(chance.range(-30, 30), 5, chance.range(-30, 30)).look_at(3 * i, 0, i)
        .inner(20 + 15 * i).outer(40 + 15 * i).range(chance.range(3, 9)).intensity(9);
}
directional_light(\"sun\").at(1, 2, 1).look_at(0, 0, 0).intensity(0.2);
ambient_light(\"sky\").intensity(0.1);
camera(\"eye\").at(0, 9, 30).look_at(0, 0, 0).fov(60).near(0.1).far(150);
";

/// A grid that lives from frame to frame.
struct Living {
    /// Its files.
    _folder: TempDir,
    studio: Studio,
    pipeline: Pipeline,
    grid: Grid,
    numbers: Numbers,
}

impl Living {
    fn new(grid: Grid, mistake: Option<Mistake<'_>>) -> Self {
        let [a, b] = opened("world_indexed_forward", &[("cell_lists", grid.words())]);
        let files = [
            (a.0, a.1.as_str()),
            (b.0, b.1.as_str()),
            ("scripts/scenes/field.rhai", FIELD),
        ];
        let (folder, files) = match mistake {
            Some(mistake) => project_with_mistake(&files, mistake),
            None => project(&files),
        };
        let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
        studio.show(files, "field");
        let pipeline = Self::compile(&studio, grid);
        Self {
            _folder: folder,
            studio,
            pipeline,
            grid,
            numbers: Numbers(11),
        }
    }

    fn compile(studio: &Studio, grid: Grid) -> Pipeline {
        let texts = grid.texts();
        let texts = settings(&texts.each_ref().map(String::as_str));
        let mut pipeline = studio.compile(OPENED, &texts);
        pipeline.keep_all_targets(true);
        pipeline
    }

    /// Draws a frame; gives the lists, and how many cells were filled.
    fn frame(&mut self) -> (Vec<Vec<u32>>, u32) {
        draw(&mut self.studio, &mut self.pipeline, self.grid)
    }

    /// Draws the same with a grid that is filled from nothing.
    fn rebuilt(&mut self) -> Vec<Vec<u32>> {
        let mut pipeline = Self::compile(&self.studio, self.grid);
        let (lists, filled) = draw(&mut self.studio, &mut pipeline, self.grid);
        assert_eq!(filled as usize, self.grid.cells());
        lists
    }

    fn light(&self, name: &str) -> Entity {
        self.studio.scene.world.find(name).unwrap()
    }

    /// The lights' places and ranges, one row each; none for those without.
    fn balls(&self) -> Vec<Option<(DVec3, f64)>> {
        let lights = self.studio.renderer.lights().iter();
        let balls = lights.map(|light| {
            (light.kind == 0).then(|| (light.position.as_dvec3(), f64::from(light.range)))
        });
        balls.collect()
    }

    /// A number from a range, random but the same in every run.
    fn number(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.numbers.below(1 << 16) as f32 / 65536.0
    }
}

fn draw(studio: &mut Studio, pipeline: &mut Pipeline, grid: Grid) -> (Vec<Vec<u32>>, u32) {
    let (world, assets) = (&mut studio.scene.world, &studio.scene.assets);
    let renderer = &mut studio.renderer;
    let serial = renderer.next_frame();
    renderer
        .render(world, assets, pipeline, &studio.view, SIZE, 0.0)
        .unwrap();
    let measured = renderer.finish(60).unwrap();
    let measured = measured.into_iter().find(|m| m.frame == serial).unwrap();
    let at = |name: &str| {
        pipeline
            .desc
            .counters
            .iter()
            .position(|c| c.name == name)
            .unwrap()
    };
    let [filled, over] =
        ["cells_filled", "cells_over_capacity"].map(|name| measured.counters[at(name)]);
    assert_eq!(over, 0);
    let words = words(renderer, pipeline, "cell_lists");
    (of_fixed_room(&words, ROOM, grid.cells()), filled)
}

/// Moves a lamp, somewhere near or far, or changes how far it reaches.
fn change_a_lamp(living: &mut Living, step: usize) {
    let lamp = living.light(&format!("lamp {}", 3 * step));
    let world = &living.studio.scene.world;
    let mut place = world.get::<Transform>(lamp).unwrap();
    let mut light = world.get::<Light>(lamp).unwrap();
    match step % 3 {
        0 => {
            place.translation += Vec3::new(living.number(-2.0, 2.0), 0.3, living.number(-2.0, 2.0))
        }
        1 => {
            let x = living.number(-60.0, 60.0);
            place.translation = Vec3::new(x, living.number(0.5, 6.0), living.number(-60.0, 60.0));
        }
        _ => light.range = living.number(0.5, 9.0),
    }
    let world = &mut living.studio.scene.world;
    world.set(lamp, place).unwrap();
    world.set(lamp, light).unwrap();
}

#[test]
fn a_light_that_moves_fills_its_old_and_new_cells_and_no_others() {
    for grid in GRIDS {
        let mut living = Living::new(grid, None);
        let (mut lists, filled) = living.frame();
        assert_eq!(filled as usize, grid.cells());
        assert_eq!(living.frame(), (lists.clone(), 0), "nothing moved");
        for step in 0..12 {
            let before = living.balls();
            change_a_lamp(&mut living, step);
            let (now, filled) = living.frame();
            let mut cells = BTreeSet::new();
            for (old, new) in before
                .iter()
                .zip(&living.balls())
                .filter(|(old, new)| old != new)
            {
                for (center, radius) in [old, new].into_iter().flatten() {
                    cells.extend(grid.reached(*center, *radius));
                }
            }
            println!("{grid:?}, step {step}: {filled} cells filled");
            assert_eq!(filled as usize, cells.len(), "{grid:?}, step {step}");
            for (cell, (old, new)) in lists.iter().zip(&now).enumerate() {
                assert!(old == new || cells.contains(&cell), "cell {cell} changed");
            }
            assert!(lists != now || step % 3 == 0);
            lists = now;
        }
        assert!(lists == living.rebuilt(), "{grid:?}");
    }
}

#[test]
fn lights_that_turn_go_out_or_come_leave_what_a_full_rebuild_holds() {
    let mut living = Living::new(GRIDS[2], None);
    living.frame();
    for step in 0..8 {
        let spot = living.light(&format!("spot {step}"));
        let mut place = living.studio.scene.world.get::<Transform>(spot).unwrap();
        match step % 4 {
            0 => place.rotation = glam::Quat::from_rotation_y(1.0) * place.rotation,
            1 => place.translation.x += 7.0,
            // The last row takes the place of the one that goes.
            2 => assert!(living.studio.scene.world.despawn(spot)),
            _ => {
                let world = &mut living.studio.scene.world;
                let light = world.get::<Light>(spot).unwrap();
                let another = world.spawn();
                let there = Transform::from_translation(Vec3::new(-20.0, 2.0, 5.0 * step as f32));
                world.insert(another, there).unwrap();
                world.insert(another, light).unwrap();
            }
        }
        if living.studio.scene.world.contains(spot) {
            living.studio.scene.world.set(spot, place).unwrap();
        }
        let (lists, filled) = living.frame();
        println!("step {step}: {filled} cells filled");
        assert!(
            filled > 0 && (filled as usize) < GRIDS[2].cells() / 4,
            "step {step}: {filled}"
        );
        assert!(lists == living.rebuilt(), "step {step}");
    }
}

/// Must-fail twins: cells that a light left are not filled again, and all cells are filled always.
#[test]
fn stale_cells_and_needless_work_are_caught() {
    let path = "shaders/world_indexed/update_cells.wgsl";
    let stale = (
        path,
        "|| world_grid::reaches(sphere_before(light), cell, size)",
        "",
    );
    let mut living = Living::new(GRIDS[0], Some(stale));
    living.frame();
    change_a_lamp(&mut living, 1);
    let (lists, _) = living.frame();
    assert!(lists != living.rebuilt());

    let needless = (
        path,
        "var changed = atomicLoad(&grid_totals[2]) != bitcast<u32>(size);",
        "var changed = true;",
    );
    let mut living = Living::new(GRIDS[0], Some(needless));
    living.frame();
    assert_eq!(living.frame().1 as usize, GRIDS[0].cells());
}
