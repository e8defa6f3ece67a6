//! Tiled forward shading: depth, lists of lights, shading, sky, output.

use wgpu::{CompareFunction, Face};

use super::ByHand;
use super::ground::{Bound, Ground};
use super::passes::{Draw, End, State, Streams, begin, compute_pipeline, render_pipeline};

/// The side of a tile and the room of its list: the pipeline's defaults.
const TILE: u32 = 16;
const CAPACITY: u32 = 256;
/// Invocations of a workgroup of `shaders/light_spheres.wgsl`.
const SPHERES_AT_ONCE: u32 = 64;

pub struct Tiled {
    prepass: Draw,
    spheres: (wgpu::ComputePipeline, Bound),
    cull: (wgpu::ComputePipeline, Bound),
    shade: Draw,
    end: End,
    hdr: wgpu::TextureView,
    depth: wgpu::TextureView,
    output: wgpu::Texture,
}

impl Tiled {
    pub fn new(ground: &mut Ground) -> Self {
        ground.texture("hdr");
        ground.texture("depth");
        let tiles = ground.size.0.div_ceil(TILE) * ground.size.1.div_ceil(TILE);
        let lights = ground.scene.lights().len() as u32;
        ground.buffer("tile_lists", (CAPACITY + 1) * tiles);
        ground.buffer("tile_lists_transparent", (CAPACITY + 1) * tiles);
        ground.buffer("tile_totals", 4);
        ground.buffer("light_spheres", 4 * (lights + 1));
        let geometry = "shaders/vertex/geometry.wgsl";
        let prepass = render_pipeline(
            ground,
            &State {
                vertex: (geometry, &["POSITION_ONLY"], Streams::Positions),
                fragment: None,
                cull: Some(Face::Back),
                depth: Some((CompareFunction::GreaterEqual, true)),
                colors: &[],
                blend: None,
                parameters: None,
            },
        );
        let spheres = compute_pipeline(ground, "light_spheres");
        let cull = compute_pipeline(ground, "cull");
        let shade = render_pipeline(
            ground,
            &State {
                vertex: (geometry, &[], Streams::All),
                fragment: Some("shade"),
                cull: Some(Face::Back),
                depth: Some((CompareFunction::Equal, false)),
                colors: &["hdr".to_owned()],
                blend: None,
                parameters: None,
            },
        );
        let end = End::new(ground);
        Self {
            prepass,
            spheres,
            cull,
            shade,
            end,
            hdr: ground.view("hdr"),
            depth: ground.view("depth"),
            output: ground.textures["output"].clone(),
        }
    }
}

impl ByHand for Tiled {
    fn record(&self, ground: &Ground, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = begin(encoder, ground, &[], Some((&self.depth, true)));
        self.prepass.objects(ground, Streams::Positions, &mut pass);
        drop(pass);

        encoder.clear_buffer(&ground.buffers["tile_totals"], 0, None);
        let lights = ground.scene.lights().len() as u32;
        let (across, down) = (ground.size.0.div_ceil(TILE), ground.size.1.div_ceil(TILE));
        let dispatches = [
            (&self.spheres, lights.div_ceil(SPHERES_AT_ONCE), 1),
            (&self.cull, across, down),
        ];
        for ((pipeline, bound), x, y) in dispatches {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &ground.scene_group, &[0]);
            pass.set_bind_group(1, &bound.group, &[]);
            pass.dispatch_workgroups(x, y, 1);
        }

        let mut pass = begin(
            encoder,
            ground,
            &[(&self.hdr, true)],
            Some((&self.depth, false)),
        );
        self.shade.objects(ground, Streams::All, &mut pass);
        drop(pass);
        self.end.record(ground, encoder);
    }

    fn output(&self) -> &wgpu::Texture {
        &self.output
    }
}
