//! Mistakes in pipelines and shaders: each is found before anything is drawn, at its place, with
//! the way to mend it.
#![allow(clippy::unwrap_used)]

mod support;

use std::path::Path;

use lightbench_assets::files::Files;
use lightbench_render::description::*;
use lightbench_render::{Compiler, Gpu, PipelineDesc, Problems, Renderer};
use support::{at, deferred, forward, gpu, named, pass, read, target, writes};

/// Compiles on a device with the files of a project folder.
struct Workshop {
    compiler: Compiler,
    files: Files,
    folder: tempfile::TempDir,
}

impl Workshop {
    fn new() -> Self {
        let gpu: Gpu = gpu(false);
        let folder = tempfile::tempdir().unwrap();
        let compiler = Renderer::new(gpu).compiler();
        Self {
            compiler,
            files: Files::with_project(folder.path()).unwrap(),
            folder,
        }
    }

    fn write(&self, path: &str, text: &str) {
        let path = self.folder.path().join(Path::new(path));
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }

    fn problems(&mut self, desc: &PipelineDesc) -> Problems {
        match self.compiler.compile(&self.files, desc) {
            Err(problems) => problems,
            Ok(_) => panic!("the mistake was not found"),
        }
    }
}

fn ability(name: &str, supported: bool) -> Ability {
    Ability {
        name: name.to_owned(),
        at: at(),
        supported,
        text: "for a test".to_owned(),
    }
}

/// A mistake and what must be said of it.
type Planted = (fn(&mut PipelineDesc), &'static str);

#[test]
fn every_mistake_in_a_description_is_named() {
    let planted: &[Planted] = &[
        (
            |d| d.passes[1].reads[1].target = "g_albdo".into(),
            "there is no target `g_albdo`\n    help: did you mean `g_albedo`?",
        ),
        (
            |d| d.passes[0].colors[1].target = "nothing_like_it".into(),
            "there is no target `nothing_like_it`\n    help: the targets are: ",
        ),
        (
            |d| d.targets.push(target("hdr", "rgba16float")),
            "the target `hdr` was declared already",
        ),
        (
            |d| d.passes[1].name = "g_buffer".into(),
            "the pass `g_buffer` was declared already",
        ),
        (
            |d| d.targets.push(target("unused", "r8unorm")),
            "no pass uses the target `unused`",
        ),
        (
            |d| d.passes.swap(0, 1),
            "`lights` reads `depth`, which nobody wrote yet\n    help: `g_buffer` writes it, but comes later: move it up",
        ),
        (
            |d| d.passes[0].colors[0].load = Load::Keep,
            "`g_buffer` keeps `hdr`, which nobody wrote yet\n    help: add .clear after it",
        ),
        (
            |d| d.passes[1].reads.push(read("hdr")),
            "the pass `lights` reads `hdr` and writes it",
        ),
        (
            |d| d.passes[1].depth.as_mut().unwrap().write = true,
            "the pass `lights` reads the depth `depth` that it writes",
        ),
        (
            |d| d.passes[0].colors[1].target = "depth".into(),
            "`depth` holds depth (depth32float) and can't be a colour target",
        ),
        (
            |d| d.passes[0].depth.as_mut().unwrap().target = "hdr".into(),
            "`hdr` is rgba16float, which holds no depth",
        ),
        (
            |d| d.passes[0].colors[2].blend = Blend::Add,
            "`g_normal` is rg16uint, which can't blend: integers never blend",
        ),
        (
            |d| d.passes[1].depth.as_mut().unwrap().load = Load::Clear([0.0; 4]),
            "`depth` is read-only here and can't be cleared",
        ),
        (
            |d| d.targets[2].size = TargetSize::Relative(0.5),
            "`g_albedo` and `hdr` differ in size, but one pass writes both",
        ),
        (
            |d| d.abilities.push(ability("brdf_gxx", true)),
            "there is no reflection model `gxx`\n    help: did you mean `ggx`?",
        ),
        (
            |d| d.abilities.push(ability("brdf_lambert", false)),
            "there is no reflection model `lambert`\n    help: the models are: blinn_phong, phong,",
        ),
        (
            |d| d.abilities.push(ability("brdf_blinn_phong", false)),
            "every pipeline carries `blinn_phong`",
        ),
        (|d| d.output = None, "the pipeline shows nothing"),
        (
            |d| d.output = named("hdr"),
            "`hdr` is rgba16float; here it must be rgba8unorm",
        ),
        (
            |d| d.passes[1].shader = None,
            "the pass `lights` has no shader",
        ),
        (
            |d| {
                d.passes[1].colors.clear();
                d.passes[1].depth = None;
            },
            "the pass `lights` writes nothing",
        ),
        (
            |d| {
                let twice = d.passes[0].colors[0].clone();
                d.passes[0].colors.push(twice);
            },
            "the pass writes `hdr` twice",
        ),
    ];
    let mut workshop = Workshop::new();
    for (plant, expected) in planted {
        let mut desc = deferred("rgba16float", true);
        plant(&mut desc);
        let text = workshop.problems(&desc).to_string();
        assert!(
            text.contains(expected),
            "expected\n{expected}\nbut found\n{text}"
        );
        assert!(text.starts_with("test.rhai:1:1: "), "{text}");
    }
}

#[test]
fn all_mistakes_of_a_description_are_reported_at_once() {
    let mut desc = deferred("rgba16float", true);
    desc.passes[1].reads[1].target = "g_albdo".into();
    desc.targets.push(target("unused", "r8unorm"));
    desc.output = None;
    assert_eq!(Workshop::new().problems(&desc).0.len(), 3);
}

/// A full-screen pass over `hdr` with a shader of one's own.
fn with_shader(path: &str) -> PipelineDesc {
    let mut desc = forward("rgba16float", false);
    let mut extra = pass("extra", PassKind::Fullscreen, path);
    extra.reads = vec![read("hdr")];
    extra.colors = vec![writes("extra", Load::Keep, Blend::Replace)];
    desc.targets.push(target("extra", "rgba16float"));
    desc.passes.push(extra);
    desc
}

#[test]
fn every_mistake_in_a_shader_is_named_with_line_and_column() {
    const GOOD: &str = "@group(1) @binding(0) var hdr: texture_2d<f32>;\n\
        @fragment\n\
        fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {\n\
        \x20   return vec4f(textureLoad(hdr, vec2i(pixel.xy), 0));\n\
        }\n";
    let planted: &[(&str, &str, &str)] = &[
        ("vec2i(pixel.xy), 0)", "vec2i(pixel.xy), 0", ":4:"),
        ("return vec4f", "let x: i32 = 1.5; return vec4f", ":4:"),
        ("pixel.xy", "pixle.xy", ":4:"),
        (
            "texture_2d<f32>",
            "texture_2d<u32>",
            ":1:27: `hdr` is texture_2d<u32>, but the target `hdr` is rgba16float",
        ),
        ("hdr", "hdt", "the pass `extra` gives the shader no `hdt`"),
        (
            "@fragment\nfn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {\n",
            "@group(1) @binding(1) var<storage, read> mesh_position: array<f32>;\n@fragment\n\
             fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {\n\
             _ = mesh_position[0];\n",
            "help: did you mean `mesh_positions`?",
        ),
        // A layer where the texture has none stands in the place of the depth.
        (
            "@fragment\nfn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {\n",
            "@group(1) @binding(1) var depth: texture_depth_2d;\n\
             @group(1) @binding(2) var depth_sampler: sampler_comparison;\n@fragment\n\
             fn fragment_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {\n\
             _ = textureSampleCompareLevel(depth, depth_sampler, pixel.xy, 1u, 0.5);\n",
            ":6:63: automatic conversions",
        ),
        (
            "fragment_main",
            "fragment_man",
            "the shader has no `fragment_main`",
        ),
        (
            "@location(0)",
            "@location(1)",
            "the shader has no output @location(0) for `extra`",
        ),
        (
            "-> @location(0) vec4f {\n    return vec4f(textureLoad(hdr, vec2i(pixel.xy), 0));",
            "{ _ = textureLoad(hdr, vec2i(pixel.xy), 0);",
            "the shader has no output @location(0)",
        ),
        ("@fragment", "#import lightbench::surfce\n@fragment", ":2:"),
        (
            "@fragment",
            "#import lightbench::surfce\n@fragment",
            "help: did you mean `lightbench::surface`?",
        ),
        (
            "@fragment",
            "struct Parameters { exposre: f32 }\n@group(2) @binding(0) var<uniform> parameters: Parameters;\n@fragment",
            ":2:21: the pipeline has no parameter `exposre`",
        ),
        (
            "@fragment",
            "struct Parameters { exposre: f32 }\n@group(2) @binding(0) var<uniform> parameters: Parameters;\n@fragment",
            "help: did you mean `exposure`?",
        ),
        (
            "@fragment",
            "struct Parameters { exposure: u32 }\n@group(2) @binding(0) var<uniform> parameters: Parameters;\n@fragment",
            "the parameter `exposure` reaches shaders as f32",
        ),
        (
            "@fragment",
            "@group(1) @binding(1) var smooth_sampler: sampler;\n@fragment",
            "there is no sampler `smooth_sampler`",
        ),
        (
            "@fragment",
            "@group(1) @binding(5) var volume: texture_1d<f32>;
@fragment",
            "`volume` is a 1D texture; group 1 holds textures,",
        ),
    ];
    let path = "shaders/mine.wgsl";
    let mut workshop = Workshop::new();
    workshop.write(path, GOOD);
    let good = workshop
        .compiler
        .compile(&workshop.files, &with_shader(path));
    assert!(good.is_ok(), "{}", good.err().unwrap());
    for (from, to, expected) in planted {
        assert!(GOOD.contains(from), "{from}");
        workshop.write(path, &GOOD.replace(from, to));
        workshop.compiler.forget(path);
        let text = workshop.problems(&with_shader(path)).to_string();
        assert!(
            text.contains(expected),
            "{from} → {to}: expected\n{expected}\nbut found\n{text}"
        );
        assert!(text.contains(path), "{text}");
    }
}

#[test]
fn empty_and_missing_shaders_are_explained() {
    let mut workshop = Workshop::new();
    workshop.write("shaders/mine.wgsl", " \n");
    let text = workshop
        .problems(&with_shader("shaders/mine.wgsl"))
        .to_string();
    assert!(
        text.contains("shaders/mine.wgsl: the shader is empty"),
        "{text}"
    );
    let text = workshop
        .problems(&with_shader("shaders/outptu.wgsl"))
        .to_string();
    assert!(
        text.contains("there is no shader `shaders/outptu.wgsl`"),
        "{text}"
    );
    assert!(
        text.contains("did you mean `shaders/output.wgsl`?"),
        "{text}"
    );
}

#[test]
fn a_mistake_in_a_module_names_the_module() {
    let mut workshop = Workshop::new();
    let shipped = workshop
        .files
        .read_text("shaders/lib/lighting.wgsl")
        .unwrap();
    let line = shipped
        .lines()
        .position(|line| line.contains("let n_dot_l = dot("))
        .unwrap()
        + 1;
    workshop.write(
        "shaders/lib/lighting.wgsl",
        &shipped.replace("let n_dot_l = dot(", "let n_dot_l = dto("),
    );
    let text = workshop
        .problems(&forward("rgba16float", false))
        .to_string();
    assert!(
        text.contains(&format!("shaders/lib/lighting.wgsl:{line}:")),
        "{text}"
    );
    assert!(!text.contains("naga_oil"), "{text}");
}

#[test]
fn messages_quote_what_was_written() {
    let mut workshop = Workshop::new();
    let path = "shaders/mine.wgsl";
    let line = "    let x = color::encode_srgb(color::tone_reinhard(vec3f(1.0))) + missing + color::encode_srgb(2);";
    workshop.write(
        path,
        &format!(
            "#import lightbench::color\n@group(1) @binding(0) var hdr: texture_2d<f32>;\n@fragment\n\
             fn fragment_main() -> @location(0) vec4f {{\n{line}\n    return vec4f(x, textureLoad(hdr, vec2i(0), 0).x);\n}}\n"
        ),
    );
    let text = workshop.problems(&with_shader(path)).to_string();
    let column = line.find("missing").unwrap() + 1;
    assert!(text.contains(&format!("{path}:5:{column}: ")), "{text}");
    assert!(text.contains(line), "{text}");
}

#[test]
fn a_reload_after_mending_compiles_again() {
    let mut workshop = Workshop::new();
    let path = "shaders/lib/lighting.wgsl";
    let shipped = workshop.files.read_text(path).unwrap();
    workshop.write(path, "broken");
    workshop.problems(&forward("rgba16float", false));
    workshop.write(path, &shipped);
    workshop.compiler.forget(path);
    assert!(
        workshop
            .compiler
            .compile(&workshop.files, &forward("rgba16float", false))
            .is_ok()
    );
}
