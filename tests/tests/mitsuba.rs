//! What `lightbench export` writes for Mitsuba: the XML is sound, everything it names is there, and what
//! has no counterpart is told.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeSet;
use std::path::Path;

use lightbench::assets::Progress;
use lightbench::assets::files::Files;
use lightbench::lab::mitsuba::{Exported, export};
use lightbench::render::View;
use lightbench::script::{Settings, load_scene};
use lightbench_tests::{project, settings};

/// An element with its attributes.
#[derive(Clone, Debug)]
struct Element {
    name: String,
    attributes: Vec<(String, String)>,
    /// Indices of the elements around it, the outermost first.
    around: Vec<usize>,
}

impl Element {
    fn attribute(&self, wanted: &str) -> Option<&str> {
        let found = self.attributes.iter().find(|(name, _)| name == wanted);
        found.map(|(_, value)| value.as_str())
    }

    fn is(&self, name: &str, kind: &str) -> bool {
        self.name == name && self.attribute("type") == Some(kind)
    }
}

/// Reads the file, and stops where elements do not nest.
fn elements(text: &str) -> Vec<Element> {
    let mut found: Vec<Element> = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        let after = &rest[start..];
        if after.starts_with("<!--") {
            rest = &after[after.find("-->").unwrap() + 3..];
            continue;
        }
        // Attributes hold no bare `<`, but may hold `>`.
        let mut quoted = false;
        let end = after.find(|c| {
            quoted ^= c == '"';
            c == '>' && !quoted
        });
        let end = end.unwrap();
        let tag = &after[1..end];
        rest = &after[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            let last = open.pop().unwrap();
            assert_eq!(found[last].name, name, "{tag}");
            continue;
        }
        let closed = tag.ends_with('/');
        let tag = tag.trim_end_matches('/');
        let (name, values) = tag.split_once(' ').unwrap_or((tag, ""));
        let parts: Vec<&str> = values.split('"').collect();
        let attributes = parts.chunks_exact(2).map(|pair| {
            let name = pair[0].trim().trim_end_matches('=');
            (name.to_owned(), pair[1].to_owned())
        });
        found.push(Element {
            name: name.to_owned(),
            attributes: attributes.collect(),
            around: open.clone(),
        });
        if !closed {
            open.push(found.len() - 1);
        }
    }
    assert!(open.is_empty(), "{open:?} stay open");
    found
}

struct Written {
    elements: Vec<Element>,
    exported: Exported,
    _folder: tempfile::TempDir,
}

impl Written {
    fn of(files: &Files, scene: &str, settings: &Settings) -> Self {
        let scene = load_scene(files, scene, settings, &Progress::default());
        let mut scene = scene.unwrap_or_else(|e| panic!("{e}"));
        scene.refresh();
        let view = View::from_world(&scene.world).unwrap_or_default();
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        let exported = export(&scene.world, &scene.assets, &view, (64, 36), &out).unwrap();
        let text = std::fs::read_to_string(&exported.scene).unwrap();
        let elements = elements(&text);
        names_are_there(&elements, &out);
        Self {
            elements,
            exported,
            _folder: folder,
        }
    }

    fn count(&self, name: &str, kind: &str) -> usize {
        self.elements.iter().filter(|e| e.is(name, kind)).count()
    }

    /// The value of a named element within one of a kind.
    fn value(&self, within: (&str, &str), name: &str) -> String {
        let inside = |element: &Element| {
            let mut around = element.around.iter();
            around.any(|&index| self.elements[index].is(within.0, within.1))
        };
        let mut named = self
            .elements
            .iter()
            .filter(|element| element.attribute("name") == Some(name) && inside(element));
        let value = named.next().and_then(|element| element.attribute("value"));
        value
            .unwrap_or_else(|| panic!("{within:?} has no {name}"))
            .to_owned()
    }
}

/// Each file and each material that is named exists.
fn names_are_there(elements: &[Element], folder: &Path) {
    let ids: BTreeSet<&str> = elements
        .iter()
        .filter_map(|e| (e.name == "bsdf").then(|| e.attribute("id"))?)
        .collect();
    for element in elements {
        if element.name == "ref" {
            let id = element.attribute("id").unwrap();
            assert!(ids.contains(id), "{id}");
        }
        if element.attribute("name") == Some("filename") {
            let file = element.attribute("value").unwrap();
            assert!(folder.join(file).is_file(), "{file}");
        }
    }
}

#[test]
fn the_cornell_box_has_its_walls_its_lamp_and_its_camera() {
    let written = Written::of(&Files::shipped(), "cornell_box", &settings(&["lamps=1"]));
    assert_eq!(written.count("shape", "ply"), 8);
    assert_eq!(written.count("emitter", "area"), 1);
    assert_eq!(written.count("emitter", "spot"), 1);
    assert_eq!(written.count("emitter", "constant"), 1);
    assert_eq!(
        written.value(("emitter", "area"), "radiance"),
        "68.8 46 12.24"
    );
    let fov: f64 = written
        .value(("sensor", "perspective"), "fov")
        .parse()
        .unwrap();
    let expected = 2.0 * f64::atan(0.0125 / 0.035).to_degrees();
    assert!((fov - expected).abs() < 1e-4, "{fov}");
    assert_eq!(written.value(("film", "hdrfilm"), "width"), "64");
    // All its materials are matt: the spot alone has no full counterpart, and the lamp's own surface
    // may hide it.
    let left_out = &written.exported.left_out;
    let of_spot = left_out
        .iter()
        .filter(|what| what.contains("light `light 0 0`"));
    assert_eq!(of_spot.count(), 2, "{left_out:?}");
    assert!(
        left_out.iter().any(|what| what.contains("hides them")),
        "{left_out:?}"
    );
    assert_eq!(left_out.len(), 3, "{left_out:?}");
}

#[test]
fn what_has_no_counterpart_is_named() {
    let script = "
        let shiny = material(\"shiny & <new>\").color(0.4, 0.5, 0.6).specular(0.3).ggx(0.2);
        let glass = material(\"glass\").opacity(0.25).specular(0);
        let bumpy = material(\"bumpy\").surface(tiles_texture()).specular(0).two_sided();
        spawn(\"a\").mesh(sphere(1)).material(shiny);
        spawn(\"b\").mesh(plane(1, 1)).material(glass).at(0, 2, 0);
        spawn(\"c\").mesh(plane(1, 1)).material(bumpy).at(0, 3, 0).scale(-1, 1, 1);
        point_light(\"lamp\").at(1, 2, 3).range(9).intensity(2).color(1, 0.5, 0.25);
        directional_light(\"sun\").at(0, 5, 0).look_at(0, 0, 0.5).intensity(3);
        camera(\"eye\").at(0, 1, 6).look_at(0, 1, 0);";
    let (_folder, files) = project(&[("scripts/scenes/odd.rhai", script)]);
    let written = Written::of(&files, "odd", &settings(&[]));
    for expected in [
        "material `shiny & <new>`: its highlights (ggx)",
        "light `lamp`: that it fades to nothing at its range",
    ] {
        let left_out = &written.exported.left_out;
        assert!(
            left_out.iter().any(|what| what == expected),
            "{expected}: {left_out:?}"
        );
    }
    assert_eq!(written.exported.left_out.len(), 2);
    assert_eq!(written.count("bsdf", "mask"), 1);
    assert_eq!(written.value(("bsdf", "mask"), "opacity"), "0.25");
    assert_eq!(written.count("bsdf", "normalmap"), 1);
    assert_eq!(written.count("bsdf", "twosided"), 1);
    assert_eq!(written.value(("emitter", "point"), "intensity"), "2 1 0.5");
    assert_eq!(
        written.value(("emitter", "directional"), "irradiance"),
        "3 3 3"
    );
    // The mirrored plane has a mesh of its own and no transform.
    let turned = written.elements.iter().filter(|element| {
        let value = element.attribute("value").unwrap_or_default();
        value.contains("turned_")
    });
    assert_eq!(turned.count(), 1);
    assert_eq!(written.count("shape", "ply"), 3);
}

#[test]
fn every_shipped_scene_is_written() {
    for scene in [
        "atrium",
        "brdf_spheres",
        "hard_cases",
        "layers",
        "many_lights",
        "showroom",
    ] {
        let written = Written::of(&Files::shipped(), scene, &settings(&[]));
        assert!(written.exported.files > 0, "{scene}");
    }
}

/// Renders an exported scene with the Python package `mitsuba` and prints the means of its channels.
const RENDER: &str = r#"
import sys
import mitsuba as mi
import numpy
mi.set_variant("scalar_rgb")
picture = numpy.array(mi.render(mi.load_file(sys.argv[1]), spp=int(sys.argv[2])))
print(*[picture[:, :, channel].mean() for channel in range(3)])
"#;

/// The means that Mitsuba 3.9.1 gave with 4,096 samples a pixel.
const MITSUBA_MEANS: [f64; 3] = [0.423_94, 0.276_95, 0.066_05];

/// The Python that has the package: what `LIGHTBENCH_PYTHON` names, or the system's.
fn python_with_mitsuba() -> Option<std::ffi::OsString> {
    let named = std::env::var_os("LIGHTBENCH_PYTHON");
    let python = named.unwrap_or_else(|| "python3".into());
    let asked = std::process::Command::new(&python)
        .args(["-c", "import mitsuba, numpy"])
        .output();
    asked
        .is_ok_and(|asked| asked.status.success())
        .then_some(python)
}

/// The scene with its lamp alone: the spots imitate the lamp where no path is traced.
fn without_spots(text: &str) -> String {
    let mut parts = text.split("<emitter type=\"spot\">");
    let mut kept = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        kept += part.split_once("</emitter>").unwrap().1;
    }
    kept
}

/// A renderer that nobody here wrote agrees with the path tracer on the Cornell box. Where the Python
/// package is not installed, the tracer alone is held to what Mitsuba 3.9.1 gave on another machine.
#[test]
fn mitsuba_renders_what_the_path_tracer_traces() {
    use lightbench::lab::tracer::{Options, Sources, TracedScene, trace};

    let (size, samples) = ((64, 36), 1024);
    let settings = settings(&["bounces=false"]);
    let files = Files::shipped();
    let loaded = load_scene(&files, "cornell_box", &settings, &Progress::new());
    let mut scene = loaded.unwrap_or_else(|e| panic!("{e}"));
    scene.refresh();
    let view = View::from_world(&scene.world).unwrap();
    let options = Options {
        size,
        samples,
        sources: Sources {
            surfaces: true,
            ..Sources::NONE
        },
        ..Options::default()
    };
    let traced = TracedScene::new(&scene.world, &scene.assets);
    let traced = trace(&traced, &view, &options, &Progress::new()).unwrap();
    let count = traced.picture.pixels.len() as f64;
    let mean = |channel: usize, of: &lightbench::lab::HdrImage| {
        of.pixels.iter().map(|p| f64::from(p[channel])).sum::<f64>() / count
    };
    let ours = [0, 1, 2].map(|channel| mean(channel, &traced.picture));
    let theirs = match python_with_mitsuba() {
        Some(python) => {
            let folder = tempfile::tempdir().unwrap();
            let exported = export(&scene.world, &scene.assets, &view, size, folder.path()).unwrap();
            let text = std::fs::read_to_string(&exported.scene).unwrap();
            std::fs::write(&exported.scene, without_spots(&text)).unwrap();
            let script = folder.path().join("render.py");
            std::fs::write(&script, RENDER).unwrap();
            let ran = std::process::Command::new(python)
                .arg(&script)
                .arg(exported.scene)
                .arg(samples.to_string())
                .output()
                .unwrap();
            let said = String::from_utf8_lossy(&ran.stdout).into_owned();
            assert!(
                ran.status.success(),
                "{}",
                String::from_utf8_lossy(&ran.stderr)
            );
            let means: Vec<f64> = said
                .split_whitespace()
                .map(|n| n.parse().unwrap())
                .collect();
            [means[0], means[1], means[2]]
        }
        None => MITSUBA_MEANS,
    };
    println!("traced {ours:?}, Mitsuba {theirs:?}");
    for channel in 0..3 {
        // Both means have some 0.1 % of noise.
        let ratio = ours[channel] / theirs[channel];
        assert!(
            (ratio - 1.0).abs() < 0.005,
            "channel {channel}: {ours:?} {theirs:?}"
        );
    }
}
