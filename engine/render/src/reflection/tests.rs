#![allow(clippy::unwrap_used)]

use lightbench_assets::files::Files;
use naga::{Interpolation, ShaderStage};

use super::*;
use crate::description::Define;
use crate::shader::ShaderComposer;

/// What a shader asks for that imports a module of its own.
fn reflected(shader: &str, module: &str) -> Reflection {
    let folder = tempfile::tempdir().unwrap();
    let write = |path: &str, text: &str| {
        let path = folder.path().join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    write("shaders/a.wgsl", shader);
    write(
        "shaders/lib/own.wgsl",
        &format!("#define_import_path own\n{module}"),
    );
    let files = Files::with_project(folder.path()).unwrap();
    let capabilities = naga::valid::Capabilities::empty();
    let mut composer = ShaderComposer::new(&files, capabilities).unwrap();
    let defines = [Define::flag("SMALL")];
    let shader = composer.compose(&files, "shaders/a.wgsl", &defines);
    reflect(&shader.unwrap_or_else(|problem| panic!("{problem}")))
}

#[test]
fn finds_variables_parameters_and_stages_with_their_places() {
    let found = reflected(
        "#import own
struct Parameters { exposure: f32, curve: u32 }
struct Out { @location(1) b: vec2u, @location(0) a: vec4f }
#ifdef SMALL
@group(1) @binding(3) var g_normal: texture_2d<u32>;
#else
@group(1) @binding(3) var g_normal: texture_2d<f32>;
#endif
@group(1) @binding(0) var depth: texture_depth_2d;
@group(2) @binding(0) var<uniform> parameters: Parameters;
@vertex fn vertex_main(@location(2) uv: vec2f) -> own::Varyings {
    return own::Varyings(vec4f(uv, 0, 1), uv, 7u);
}
@fragment fn fragment_main(in: own::Varyings, @builtin(front_facing) front: bool) -> Out {
    let texel = textureLoad(g_normal, vec2i(0), 0).xy + textureLoad(own::more, vec2i(0), 0).xy;
    return Out(texel, vec4f(parameters.exposure) + own::smooth_color(in.uv));
}",
        "struct Varyings {
    @builtin(position) at: vec4f,
    @location(0) uv: vec2f,
    @location(3) @interpolate(flat) index: u32,
}
@group(1) @binding(5) var more: texture_2d<u32>;
@group(1) @binding(6) var colors: texture_2d<f32>;
@group(1) @binding(7) var linear_sampler: sampler;
fn smooth_color(uv: vec2f) -> vec4f { return textureSample(colors, linear_sampler, uv); }",
    );
    let flat = |kind| {
        BindingKind::Texture(TextureType {
            kind,
            dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        })
    };
    let sampler = BindingKind::Sampler { comparison: false };
    let variables: Vec<_> = found
        .variables
        .iter()
        .map(|v| {
            (
                v.name.as_str(),
                (v.group, v.binding),
                v.kind.clone(),
                v.at.to_string(),
            )
        })
        .collect();
    let expected = [
        (
            "depth",
            (1, 0),
            flat(SampleKind::Depth),
            "shaders/a.wgsl:9:27",
        ),
        (
            "g_normal",
            (1, 3),
            flat(SampleKind::Uint),
            "shaders/a.wgsl:5:27",
        ),
        (
            "more",
            (1, 5),
            flat(SampleKind::Uint),
            "shaders/lib/own.wgsl:7:27",
        ),
        (
            "colors",
            (1, 6),
            flat(SampleKind::Float),
            "shaders/lib/own.wgsl:8:27",
        ),
        (
            "linear_sampler",
            (1, 7),
            sampler,
            "shaders/lib/own.wgsl:9:27",
        ),
        (
            "parameters",
            (2, 0),
            BindingKind::Uniform,
            "shaders/a.wgsl:10:36",
        ),
    ]
    .map(|(name, binding, kind, at)| (name, binding, kind, at.to_owned()));
    assert_eq!(variables, expected);

    let (members, size) = found.parameters.as_ref().unwrap();
    let curve = &members[1];
    assert_eq!((curve.name.as_str(), curve.offset, *size), ("curve", 4, 8));
    assert_eq!(curve.at.to_string(), "shaders/a.wgsl:2:36");

    assert_eq!(found.vertex_inputs, BTreeSet::from([2]));
    let vertex = found.entry(VERTEX_ENTRY, ShaderStage::Vertex).unwrap();
    let output = &vertex.outputs[1];
    assert_eq!(
        (output.location, output.ty.to_string().as_str()),
        (3, "u32")
    );
    assert_eq!(output.interpolation, Some(Interpolation::Flat));
    assert_eq!(output.at.to_string(), "shaders/lib/own.wgsl:5:37");
    assert!(vertex.uses.is_empty());

    let fragment = found.entry(FRAGMENT_ENTRY, ShaderStage::Fragment).unwrap();
    assert_eq!(fragment.inputs.len(), 2);
    assert_eq!(fragment.builtin_inputs, 1, "only front_facing takes room");
    let outputs: Vec<_> = fragment
        .outputs
        .iter()
        .map(|output| {
            (
                output.location,
                output.ty.to_string(),
                output.at.to_string(),
            )
        })
        .collect();
    assert_eq!(
        outputs,
        [
            (0, "vec4f".to_owned(), "shaders/a.wgsl:3:50".to_owned()),
            (1, "vec2u".to_owned(), "shaders/a.wgsl:3:27".to_owned()),
        ]
    );
    assert_eq!(fragment.samples, BTreeSet::from([[(1, 6), (1, 7)]]));
    let used = [(1, 3), (1, 5), (1, 6), (1, 7), (2, 0)];
    assert_eq!(fragment.uses, BTreeSet::from(used), "depth is not used");
}

#[test]
fn counts_workgroups_memory_and_overrides() {
    let found = reflected(
        "override STEPS: u32 = 3;
override SCALE: f32;
var<workgroup> sums: array<vec3f, 9>;
var<workgroup> flag: u32;
var<workgroup> unused: array<u32, 1000>;
@group(1) @binding(0) var<storage, read_write> totals: array<vec2u, 3>;
@compute @workgroup_size(4, 2) fn compute_main() {
    sums[0] = vec3f(SCALE);
    flag = STEPS;
    totals[0] = vec2u(1u);
}",
        "",
    );
    assert_eq!(found.workgroup_size, Some([4, 2, 1]));
    let entry = &found.entry_points[0];
    assert_eq!(entry.workgroup_bytes, 9 * 16 + 16);
    assert_eq!(entry.workgroup_at.to_string(), "shaders/a.wgsl:7:11");
    assert_eq!(found.variables[0].bytes, 24);
    let writable = BindingKind::Buffer { writable: true };
    assert_eq!(found.variables[0].kind, writable);
    let mut overrides: Vec<_> = found
        .overrides
        .iter()
        .map(|constant| (constant.name.as_str(), constant.has_value, constant.at.line))
        .collect();
    overrides.sort_unstable();
    assert_eq!(overrides, [("SCALE", false, 2), ("STEPS", true, 1)]);
}
