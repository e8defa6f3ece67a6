//! Each cell of the table of pipelines and abilities: what a pipeline says that it can do it does, and
//! for what it can't do it gives one reason.
#![allow(clippy::unwrap_used)]

use lightbench::assets::files::Files;
use lightbench::script::abilities::{ABILITIES, AbilityCell, abilities};
use lightbench::script::{PipelineEntry, list_pipelines, load_pipeline};
use lightbench_tests::{Studio, project, settings};

const SIZE: (u32, u32) = (64, 48);

/// What 8 bits of a square root make of a base colour, and 16 bits of a sum: relative.
const ROUNDING: f32 = 0.012;

/// A pane before a wall, in ambient light alone, whose every reflection is a product: what arrives is
/// the radiance of the light times the base colour.
const AMBIENT: &str = "
let wall = material(\"wall\").color(rgb(0.5, 0.25, 0.75)).specular(0);
spawn(\"wall\").mesh(plane(40, 40)).material(wall).at(0, 0, -4).turn(90, 0, 0);
ambient_light(\"sky\").intensity(0.8);
camera(\"eye\").at(0, 0, 4).look_at(0, 0, 0).fov(50).near(0.1).far(40);
";
const WALL: [f32; 3] = [0.5 * 0.8, 0.25 * 0.8, 0.75 * 0.8];

/// Half of what it shows is its own light, half that of the wall.
const PANE: &str = "
let glass = material(\"glass\").color(rgb(0.2, 0.6, 0.4)).specular(0).opacity(0.5);
spawn(\"pane\").mesh(plane(3, 3)).material(glass).turn(90, 0, 0);
";
const PANE_COLOR: [f32; 3] = [0.2 * 0.8, 0.6 * 0.8, 0.4 * 0.8];

/// A slanted edge of a bright board before black.
const EDGE: &str = "
let board = material(\"board\").color(rgb(0, 0, 0)).specular(0).emissive(rgb(1, 1, 1));
spawn(\"board\").mesh(box(3, 3, 0.1)).material(board).turn(0, 0, 17);
camera(\"eye\").at(0, 0, 6).look_at(0, 0, 0).fov(50).near(0.1).far(40);
";

/// Ambient light that is confined to a box: it reaches the left half of a wall.
const CONFINED: &str = "
let wall = material(\"wall\").color(rgb(0.5, 0.25, 0.75)).specular(0);
spawn(\"wall\").mesh(plane(40, 40)).material(wall).at(0, 0, -4).turn(90, 0, 0);
ambient_light(\"in\").intensity(0.8).at(-10, 0, -4).clip_volume(box(20, 30, 2));
camera(\"eye\").at(0, 0, 4).look_at(0, 0, 0).fov(50).near(0.1).far(40);
";

/// A ball of a model, with a lamp beside the eye.
const BALL: &str = "
let ball = material(\"ball\").color(rgb(0.3, 0.2, 0.1)).specular(0.4).MODEL;
spawn(\"ball\").mesh(sphere(1.4).segments(64, 32)).material(ball);
point_light(\"lamp\").at(2, 3, 4).range(20).intensity(30);
camera(\"eye\").at(0, 0, 4).look_at(0, 0, 0).fov(50).near(0.1).far(40);
";

/// The scenes, by name.
fn scenes() -> Vec<(String, String)> {
    let models = [
        ("blinn_phong", "power(40)"),
        ("phong", "phong(40)"),
        ("beckmann", "beckmann(0.3)"),
        ("ggx", "ggx(0.3)"),
        ("ward", "ward(0.2, 0.4)"),
    ];
    let mut scenes = vec![
        ("ambient".to_owned(), AMBIENT.to_owned()),
        ("transparency".to_owned(), format!("{AMBIENT}{PANE}")),
        ("msaa".to_owned(), EDGE.to_owned()),
        ("clip_volumes".to_owned(), CONFINED.to_owned()),
    ];
    scenes.extend(models.map(|(name, call)| (format!("brdf_{name}"), BALL.replace("MODEL", call))));
    scenes
}

/// Draws what shows an ability, and stops where it does not.
struct Check<'a> {
    studio: &'a mut Studio,
    pipeline: &'a str,
    settings: Vec<String>,
}

impl Check<'_> {
    fn draw(&mut self, more: &[&str]) -> Vec<[f32; 4]> {
        let texts: Vec<&str> = self.settings.iter().map(String::as_str).collect();
        let texts = settings(&[&texts[..], more].concat());
        self.studio.hdr(self.pipeline, &texts, SIZE).texels
    }

    /// A pixel has a light, in all channels.
    fn is(&self, found: [f32; 4], expected: [f32; 3], what: &str) {
        for channel in 0..3 {
            let (found, expected) = (found[channel], expected[channel]);
            assert!(
                (found - expected).abs() <= ROUNDING * expected + 1e-4,
                "{} {what}: {found} instead of {expected}",
                self.pipeline
            );
        }
    }

    fn ambient(&mut self) {
        let texels = self.draw(&[]);
        for texel in texels {
            self.is(texel, WALL, "ambient light");
        }
    }

    fn transparency(&mut self) {
        let texels = self.draw(&[]);
        let middle = texels[middle()];
        let mixed = [0, 1, 2].map(|c| 0.5 * (WALL[c] + PANE_COLOR[c]));
        self.is(middle, mixed, "pane");
        self.is(texels[0], WALL, "beside the pane");
    }

    /// Without samples a pixel is black or white; with four it may be a quarter of each.
    fn msaa(&mut self) {
        let between = |texels: &[[f32; 4]]| {
            let values = texels.iter().map(|texel| texel[0] * 4.0);
            let mut between = 0;
            for quarters in values {
                assert!((quarters - quarters.round()).abs() < 0.01, "{quarters}");
                between += usize::from(quarters > 0.5 && quarters < 3.5);
            }
            between
        };
        assert_eq!(between(&self.draw(&[])), 0, "{}", self.pipeline);
        let smooth = between(&self.draw(&["antialiasing=msaa"]));
        assert!(smooth > 40, "{}: {smooth} smooth pixels", self.pipeline);
    }

    fn clip_volumes(&mut self) {
        let texels = self.draw(&[]);
        let row = (SIZE.1 / 2 * SIZE.0) as usize;
        for x in 0..SIZE.0 as usize {
            let inside = x < SIZE.0 as usize / 2;
            let expected = if inside { WALL } else { [0.0; 3] };
            self.is(texels[row + x], expected, "confined light");
        }
    }

    /// As in forward shading, whose models `brdf` holds to the CPU; and not as the default model.
    fn reflection(&mut self, name: &str) {
        let files = &self.studio.files;
        let desc = load_pipeline(files, self.pipeline, &settings(&[])).unwrap();
        // Light from buffers of half the size is soft.
        let scale = desc.parameter("scale").map(|_| "scale=1");
        let found = self.draw(scale.as_slice());
        let mut of_forward = |scene: &str| {
            let files = self.studio.files.clone();
            self.studio.show(files, scene);
            self.studio
                .hdr("forward_single_pass", &settings(&[]), SIZE)
                .texels
        };
        let expected = of_forward(name);
        let default = of_forward("brdf_blinn_phong");
        let off = |from: &[[f32; 4]]| {
            let pairs = from.iter().zip(&found);
            let away: f32 = pairs.map(|(a, b)| (a[0] - b[0]).abs()).sum();
            away / from.iter().map(|texel| texel[0]).sum::<f32>()
        };
        let what = self.pipeline;
        // Gloss is kept in steps of 3 %.
        assert!(off(&expected) < 0.015, "{what} {name}: {}", off(&expected));
        if name != "brdf_blinn_phong" {
            assert!(off(&default) > 0.03, "{what} {name} is the default model");
        }
    }
}

fn middle() -> usize {
    (SIZE.1 / 2 * SIZE.0 + SIZE.0 / 2) as usize
}

fn pipelines() -> Vec<(PipelineEntry, Vec<AbilityCell>)> {
    let files = Files::shipped();
    let listed = list_pipelines(&files).unwrap();
    let row = |entry: PipelineEntry| {
        let cells = abilities(&files, &entry).unwrap();
        (entry, cells)
    };
    listed.into_iter().map(row).collect()
}

#[test]
fn what_a_pipeline_says_that_it_can_do_it_does() {
    let written = scenes();
    let paths: Vec<(String, &str)> = written
        .iter()
        .map(|(name, text)| (format!("scripts/scenes/{name}.rhai"), text.as_str()))
        .collect();
    let paths: Vec<(&str, &str)> = paths.iter().map(|(path, text)| (&**path, *text)).collect();
    let (_folder, files) = project(&paths);
    let mut studio = Studio::new("hard_cases", &settings(&["case=no_objects"]));
    let pipelines = pipelines();
    let mut checked = 0;
    for (ability, title) in ABILITIES {
        for (entry, cells) in &pipelines {
            let cell = cells.iter().find(|cell| cell.ability == ability).unwrap();
            if !cell.supported {
                continue;
            }
            studio.show(files.clone(), ability);
            let mut check = Check {
                studio: &mut studio,
                pipeline: &entry.name,
                settings: cell.setting.iter().cloned().collect(),
            };
            match ability {
                "ambient" => check.ambient(),
                "transparency" => check.transparency(),
                "msaa" => check.msaa(),
                "clip_volumes" => check.clip_volumes(),
                model => check.reflection(model),
            }
            checked += 1;
        }
        println!("{title}: checked up to {checked} cells");
    }
    assert!(checked > 90, "{checked} cells");
}

#[test]
fn what_a_pipeline_cannot_do_has_one_reason() {
    for (entry, cells) in pipelines() {
        for cell in cells {
            let text = &cell.text;
            let what = format!("{} {}: `{text}`", entry.name, cell.ability);
            assert!(text.ends_with('.'), "{what} is no sentence");
            let sentences = text.matches(". ").count() + 1;
            assert!(
                cell.supported || sentences == 1,
                "{what} has {sentences} reasons"
            );
        }
    }
}

/// A pipeline that says it lacks an ability has no parameter for it either.
#[test]
fn what_a_pipeline_cannot_do_it_does_not_offer() {
    for (entry, cells) in pipelines() {
        let desc = load_pipeline(&Files::shipped(), &entry.path, &settings(&[])).unwrap();
        let offers = desc.parameter("antialiasing").is_some();
        let msaa = cells.iter().find(|cell| cell.ability == "msaa").unwrap();
        assert_eq!(offers, msaa.supported, "{}", entry.name);
    }
}
