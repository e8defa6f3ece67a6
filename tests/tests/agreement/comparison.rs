//! Pictures of pipelines beside each other, and how far apart they may be.

use lightbench::assets::ReflectionModels;
use lightbench::render::TargetImage;
use lightbench::script::load_pipeline;
use lightbench_tests::compare::{
    flip_mean, mean_difference, order_bound, relative_difference, share_beyond,
};
use lightbench_tests::{Studio, gpu, settings};

use crate::SIZE;

/// How a pipeline keeps surfaces between passes, which decides what it must agree with, and how
/// closely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surfaces {
    /// In registers: agrees with forward shading but for the order of additions.
    Exact,
    /// In registers, and light is added in passes that draw where depth is equal: where two
    /// surfaces touch, so that a pixel has both at the same depth, both are added.
    Added,
    /// In the G-buffer of shaders/lib/g_buffer.wgsl: agrees so with deferred shading, and with
    /// forward shading within the quantisation.
    GBuffer,
    /// Normal and gloss in textures, colours in registers: agrees within the quantisation.
    Thin,
    /// Fetched for each pixel: agrees with forward shading but for the rounding of what is
    /// interpolated, and for the gradients of textures, which the rasteriser takes as differences
    /// over two pixels.
    Fetched,
}

/// Each pipeline, what its surfaces are, and the settings under which no list overflows in the
/// scenes of this file.
pub const PIPELINES: [(&str, Surfaces, &[&str]); 13] = [
    ("forward_single_pass", Surfaces::Exact, &[]),
    ("forward_multi_pass", Surfaces::Added, &[]),
    ("tiled_forward", Surfaces::Exact, &["capacity=1024"]),
    ("clustered_forward", Surfaces::Exact, &[]),
    ("world_indexed_forward", Surfaces::Exact, &["capacity=1024"]),
    ("deferred_shading", Surfaces::GBuffer, &[]),
    ("tiled_deferred", Surfaces::GBuffer, &[]),
    ("clustered_deferred", Surfaces::GBuffer, &[]),
    ("deferred_lighting", Surfaces::Thin, &[]),
    ("light_indexed_forward", Surfaces::Exact, &[]),
    ("light_indexed_deferred", Surfaces::GBuffer, &[]),
    (
        "inferred_lighting",
        Surfaces::Thin,
        &["scale=1", "transparency=forward"],
    ),
    ("visibility_buffer", Surfaces::Fetched, &[]),
];

/// Whether pixels may need more lights than they have room for. Pipelines with such a limit mark
/// those in a target `over_capacity`; they are left out of the comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Room {
    /// Some may.
    Short,
    /// None does.
    Enough,
    /// All lights reach one pixel.
    OnePoint,
}

/// The lights of the case `one_point`.
const POINT_LIGHTS: f64 = 1000.0;

/// Whether a pipeline adds light in a target, one light after the other, and not in registers.
fn blends(pipeline: &str) -> bool {
    [
        "forward_multi_pass",
        "deferred_shading",
        "deferred_lighting",
        "inferred_lighting",
    ]
    .contains(&pipeline)
}

/// The share of the pixels in which two surfaces touch: edges of the atrium's stones.
const TOUCHING: f64 = 3e-4;

/// What the G-buffer's rounding does to the light of a whole picture: base colour within 1/255 of
/// its root, twice that squared, power within 1.5 %, normals within 0.004°. The scenes here stay below
/// 0.0034, and one lost light of 64 is 0.0053.
pub const QUANTISATION: f64 = 0.0045;
/// The same as people see it: FLIP rates a picture of which every value is one step of eight bits
/// too bright at about this.
const FLIP: f64 = 0.012;

/// What gradients that are not differences over two pixels do to textures, in the mean. The scenes here
/// stay below 0.0005; gradients that forget perspective have 0.004.
const GRADIENTS: f64 = 0.001;
/// What other rounding of positions and normals does to a pixel, where there are no textures: normals
/// differ by some 2⁻²⁰, which highlights of power 300 raise. The scenes here stay below 0.00014.
const INTERPOLATION: f32 = 4e-4;

/// A pipeline's picture of a scene.
struct Picture {
    name: &'static str,
    surfaces: Surfaces,
    linear: TargetImage,
    output: Vec<u8>,
    /// Pixels that lost lights for lack of room.
    marked: Vec<bool>,
}

impl Picture {
    fn draw(
        studio: &mut Studio,
        (name, surfaces, options): (&'static str, Surfaces, &[&str]),
        accumulation: &str,
    ) -> Self {
        let options = settings(&[options, &[accumulation]].concat());
        let desc = load_pipeline(&studio.files, name, &options).unwrap();
        let limited = desc.target("over_capacity").is_some();
        let pipeline = if limited {
            studio.draw_whole(name, &options, SIZE).0
        } else {
            studio.draw(name, &options, SIZE)
        };
        let renderer = &studio.renderer;
        let marked = if limited {
            let target = renderer.read_target(&pipeline, "over_capacity").unwrap();
            target.texels.iter().map(|texel| texel[0] > 0.0).collect()
        } else {
            vec![false; (SIZE.0 * SIZE.1) as usize]
        };
        Self {
            name,
            surfaces,
            linear: renderer.read_hdr(&pipeline).unwrap().unwrap(),
            output: renderer.read_output(&pipeline).unwrap().2,
            marked,
        }
    }

    /// Pixels that are marked.
    fn lost(&self) -> usize {
        self.marked.iter().filter(|marked| **marked).count()
    }

    /// Replaces what is marked by what another picture shows there.
    fn without_marked(&self, other: &Self) -> Self {
        let mut linear = self.linear.clone();
        let mut output = self.output.clone();
        for (index, _) in self
            .marked
            .iter()
            .enumerate()
            .filter(|(_, marked)| **marked)
        {
            linear.texels[index] = other.linear.texels[index];
            let bytes = index * 4..index * 4 + 4;
            output[bytes.clone()].copy_from_slice(&other.output[bytes]);
        }
        Self {
            linear,
            output,
            marked: self.marked.clone(),
            ..*self
        }
    }
}

/// The format in which light is kept: blending of 32-bit floats is not everywhere.
fn accumulation(portable: bool) -> &'static str {
    if portable {
        "accumulation=rgba16float"
    } else {
        "accumulation=rgba32float"
    }
}

/// All pipelines on one scene, with what `portable` leaves of the adapter.
pub fn agree(scene: &str, texts: &[&str], portable: bool, room: Room) {
    let mut studio = studio(portable);
    agree_among(&mut studio, &PIPELINES, scene, texts, portable, room);
}

/// A device for several scenes, so that pipelines are compiled once.
pub fn studio(portable: bool) -> Studio {
    Studio::on(gpu(portable), "hard_cases", &settings(&["case=no_objects"]))
}

pub fn agree_among(
    studio: &mut Studio,
    pipelines: &[(&'static str, Surfaces, &[&str])],
    scene: &str,
    texts: &[&str],
    portable: bool,
    room: Room,
) {
    studio.load(scene, &settings(texts));
    let pictures: Vec<Picture> = pipelines
        .iter()
        .map(|pipeline| Picture::draw(studio, *pipeline, accumulation(portable)))
        .collect();
    let find = |wanted: &str| {
        pictures
            .iter()
            .find(|picture| picture.name == wanted)
            .unwrap()
    };
    let (carrying_all, deferred) = (find("forward_single_pass"), find("deferred_shading"));
    let bound = order_bound(studio.renderer.lights().len());
    println!("{scene} {texts:?} portable={portable}, bound {bound:.2e}");
    for picture in &pictures {
        let (name, surfaces) = (picture.name, picture.surfaces);
        // A pipeline that lacks a reflection model is held to forward shading of what it draws
        // instead.
        let carried = studio.models(name, &settings(&[]));
        let replaced = (carried != ReflectionModels::all()).then(|| {
            let assets = studio.replace_models(carried);
            let forward = ("forward_single_pass", Surfaces::Exact, &[][..]);
            let picture = Picture::draw(studio, forward, accumulation(portable));
            studio.scene.assets = assets;
            picture
        });
        let forward = replaced.as_ref().unwrap_or(carrying_all);
        let reference = match surfaces {
            Surfaces::GBuffer => deferred,
            _ => forward,
        };
        let lost = picture.lost();
        let compared = picture.without_marked(reference);
        let order = relative_difference(&reference.linear, &compared.linear);
        let touching = share_beyond(&reference.linear, &compared.linear, bound);
        let compared = picture.without_marked(forward);
        let mean = mean_difference(&forward.linear, &compared.linear);
        let flip = flip_mean(&forward.output, &compared.output, SIZE);
        println!(
            "  {name:24} {surfaces:?}: order {order:.2e}, mean {mean:.2e}, FLIP {flip:.5}, \
             {lost} pixels masked"
        );
        let what = format!("{scene} {texts:?} {name} {surfaces:?}");
        assert!(
            room != Room::Enough || lost == 0,
            "{what}: {lost} pixels lost lights"
        );
        let mean_bound = match surfaces {
            Surfaces::Fetched => GRADIENTS,
            _ => QUANTISATION,
        };
        // Each of many additions in 16 bits loses up to 2⁻¹² of a sum that is half of all in the mean;
        // where a pixel has few lights that is less than the bounds.
        let lost_light = match (portable, room, blends(name)) {
            (true, Room::OnePoint, true) => POINT_LIGHTS * (-12.0_f64).exp2(),
            _ => 0.0,
        };
        assert!(mean <= mean_bound + lost_light, "{what}: {mean}");
        assert!(flip <= FLIP + lost_light, "{what}: FLIP {flip}");
        match surfaces {
            _ if portable => {}
            Surfaces::Exact | Surfaces::GBuffer => assert!(order <= bound, "{what}: {order}"),
            Surfaces::Added => assert!(touching <= TOUCHING, "{what}: {touching}"),
            Surfaces::Fetched => {
                let textured = !studio.scene.assets.textures().is_empty();
                assert!(textured || order <= INTERPOLATION, "{what}: {order}");
            }
            Surfaces::Thin => {}
        }
    }
}
