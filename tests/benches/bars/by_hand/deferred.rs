//! Deferred shading with light volumes: G-buffer, lights, sky, output.

use lightbench::render::volumes::Case;
use wgpu::{CompareFunction, Face};

use super::ByHand;
use super::ground::Ground;
use super::passes::{ADD, Draw, End, State, Streams, begin, render_pipeline};

pub struct Deferred {
    g_buffer: Draw,
    /// By back faces, by front faces, on the whole screen.
    lights: [Draw; 3],
    end: End,
    colors: Vec<wgpu::TextureView>,
    hdr: wgpu::TextureView,
    depth: wgpu::TextureView,
    output: wgpu::Texture,
}

impl Deferred {
    pub fn new(ground: &mut Ground) -> Self {
        let colors: Vec<String> = ground
            .pass("g_buffer")
            .colors
            .iter()
            .map(|color| color.target.clone())
            .collect();
        colors.iter().for_each(|name| ground.texture(name));
        ground.texture("depth");
        let g_buffer = render_pipeline(
            ground,
            &State {
                vertex: ("shaders/vertex/geometry.wgsl", &[], Streams::All),
                fragment: Some("g_buffer"),
                cull: Some(Face::Back),
                depth: Some((CompareFunction::GreaterEqual, true)),
                colors: &colors,
                blend: None,
                parameters: None,
            },
        );
        // Depth is reversed, so "less" is farther. A back face lights what lies in front of it.
        let mut lights = |cull, test, defines: &[&str], streams| {
            render_pipeline(
                ground,
                &State {
                    vertex: ("shaders/vertex/light_volume.wgsl", defines, streams),
                    fragment: Some("lights"),
                    cull,
                    depth: Some((test, false)),
                    colors: &["hdr".to_owned()],
                    blend: Some(ADD),
                    parameters: None,
                },
            )
        };
        let positions = Streams::Positions;
        let lights = [
            lights(
                Some(Face::Front),
                CompareFunction::LessEqual,
                &[],
                positions,
            ),
            lights(
                Some(Face::Back),
                CompareFunction::GreaterEqual,
                &[],
                positions,
            ),
            lights(
                None,
                CompareFunction::Always,
                &["FULL_SCREEN"],
                Streams::None,
            ),
        ];
        let end = End::new(ground);
        Self {
            g_buffer,
            lights,
            end,
            colors: colors.iter().map(|name| ground.view(name)).collect(),
            hdr: ground.view("hdr"),
            depth: ground.view("depth"),
            output: ground.textures["output"].clone(),
        }
    }
}

impl ByHand for Deferred {
    fn record(&self, ground: &Ground, encoder: &mut wgpu::CommandEncoder) {
        let colors: Vec<_> = self.colors.iter().map(|view| (view, true)).collect();
        let mut pass = begin(encoder, ground, &colors, Some((&self.depth, true)));
        self.g_buffer.objects(ground, Streams::All, &mut pass);
        drop(pass);

        let mut pass = begin(
            encoder,
            ground,
            &[(&self.hdr, false)],
            Some((&self.depth, false)),
        );
        let meshes = &ground.scene.meshes;
        for draw in &ground.frame.light_lists[0].draws {
            let [back, front, screen] = &self.lights;
            match draw.kind.case {
                Case::Back => back.set(&mut pass),
                Case::Front => front.set(&mut pass),
                Case::Screen => screen.set(&mut pass),
            }
            if draw.kind.case == Case::Screen {
                pass.draw(0..3, draw.volumes.clone());
                continue;
            }
            let shape = meshes.shape(draw.kind.shape).unwrap();
            meshes.bind(&mut pass, false);
            pass.draw_indexed(
                shape.indices.clone(),
                shape.base_vertex,
                draw.volumes.clone(),
            );
        }
        drop(pass);
        self.end.record(ground, encoder);
    }

    fn output(&self) -> &wgpu::Texture {
        &self.output
    }
}
