//! Pipelines and scenes built by hand, for tests of the renderer alone.
#![allow(dead_code, clippy::unwrap_used)]

use glam::{Quat, Vec3};
use lightbench_assets::files::Files;
use lightbench_assets::{Assets, Material, Reflection, procedural};
use lightbench_render::description::*;
use lightbench_render::{Format, Gpu, GpuOptions, Pipeline, Place, Renderer, TargetImage, View};
use lightbench_world::{Light, LightKind, MaterialId, MeshId, MeshRenderer, Transform, World};

pub struct Bench {
    pub renderer: Renderer,
    pub files: Files,
    pub world: World,
    pub assets: Assets,
}

pub fn gpu(portable: bool) -> Gpu {
    Gpu::open(&GpuOptions {
        adapter: None,
        portable,
    })
    .expect("a Vulkan driver: run `./x setup`")
}

impl Bench {
    pub fn new() -> Self {
        Self::on(gpu(false))
    }

    pub fn on(gpu: Gpu) -> Self {
        Self {
            renderer: Renderer::new(gpu),
            files: Files::shipped(),
            world: World::new(),
            assets: Assets::new(),
        }
    }

    pub fn material(&mut self, base_color: Vec3, specular: f32, power: f32) -> MaterialId {
        self.assets.add_material(Material {
            base_color,
            specular: Vec3::splat(specular),
            reflection: Reflection::BlinnPhong { power },
            ..Material::default()
        })
    }

    pub fn object(&mut self, mesh: MeshId, material: MaterialId, transform: Transform) {
        let entity = self.world.spawn();
        self.world.insert(entity, transform).unwrap();
        self.world
            .insert(
                entity,
                MeshRenderer {
                    mesh,
                    material,
                    visible: true,
                },
            )
            .unwrap();
    }

    pub fn light(&mut self, position: Vec3, forward: Vec3, light: Light) {
        let entity = self.world.spawn();
        let rotation = Quat::from_rotation_arc(Vec3::NEG_Z, forward.normalize());
        self.world
            .insert(
                entity,
                Transform {
                    translation: position,
                    rotation,
                    scale: Vec3::ONE,
                },
            )
            .unwrap();
        self.world.insert(entity, light).unwrap();
    }

    pub fn point(&mut self, position: Vec3, intensity: f32, range: f32) {
        let light = Light {
            kind: LightKind::Point,
            intensity,
            range,
            ..Light::default()
        };
        self.light(position, Vec3::NEG_Z, light);
    }

    /// A floor and a field of spheres.
    pub fn field(&mut self) {
        let floor = self.assets.add_mesh(procedural::plane(
            glam::Vec2::splat(12.0),
            glam::UVec2::splat(8),
        ));
        let ball = self.assets.add_mesh(procedural::uv_sphere(0.5, 24, 12));
        let grey = self.material(Vec3::splat(0.6), 0.1, 40.0);
        let red = self.material(Vec3::new(0.8, 0.2, 0.1), 0.3, 120.0);
        self.object(floor, grey, Transform::default());
        for x in -3..=3 {
            for z in -3..=3 {
                let at = Vec3::new(x as f32 * 1.5, 0.5, z as f32 * 1.5);
                self.object(ball, red, Transform::from_translation(at));
            }
        }
    }

    pub fn draw(&mut self, desc: &PipelineDesc, view: &View, size: (u32, u32)) -> Pipeline {
        let mut pipeline = self
            .renderer
            .compiler()
            .compile(&self.files, desc)
            .unwrap_or_else(|e| panic!("{e}"));
        self.renderer
            .render(
                &mut self.world,
                &self.assets,
                &mut pipeline,
                view,
                size,
                0.0,
            )
            .unwrap();
        pipeline
    }

    pub fn hdr(&mut self, desc: &PipelineDesc, view: &View, size: (u32, u32)) -> TargetImage {
        let pipeline = self.draw(desc, view, size);
        let image = self.renderer.read_hdr(&pipeline).unwrap().unwrap();
        self.renderer.finish(60).unwrap();
        image
    }
}

pub fn at() -> Place {
    Place::new("test.rhai", 1, 1)
}

pub fn named(name: &str) -> Option<Named> {
    Some(Named {
        name: name.into(),
        at: at(),
    })
}

pub fn target(name: &str, format: &str) -> TargetDesc {
    TargetDesc::new(name, at(), Format::from_name(format).unwrap())
}

pub fn writes(target: &str, load: Load, blend: Blend) -> ColorAttachment {
    ColorAttachment {
        load,
        blend,
        ..ColorAttachment::new(target, at())
    }
}

pub fn depth(clear: bool) -> DepthAttachment {
    DepthAttachment {
        load: if clear {
            Load::Clear([0.0; 4])
        } else {
            Load::Keep
        },
        write: clear,
        ..DepthAttachment::new("depth", at())
    }
}

pub fn pass(name: &str, kind: PassKind, shader: &str) -> PassDesc {
    PassDesc {
        shader: Some(ShaderDesc {
            path: shader.into(),
            at: at(),
            defines: Vec::new(),
            define_places: Vec::new(),
        }),
        ..PassDesc::new(name, at(), kind)
    }
}

pub fn read(target: &str) -> Read {
    Read::new(target, at())
}

const CLEAR: Load = Load::Clear([0.0; 4]);

fn output(desc: &mut PipelineDesc) {
    let number = |name: &str| Parameter {
        name: name.into(),
        at: at(),
        description: String::new(),
        unit: String::new(),
        kind: ParameterKind::Number {
            min: -10.0,
            max: 10.0,
        },
        default: ParameterValue::Number(0.0),
        value: ParameterValue::Number(0.0),
        tunable: false,
    };
    let curves = ["hable", "reinhard", "hejl", "linear"]
        .map(String::from)
        .to_vec();
    desc.parameters = vec![
        number("exposure"),
        Parameter {
            kind: ParameterKind::Choice { options: curves },
            default: ParameterValue::Choice("linear".into()),
            value: ParameterValue::Choice("linear".into()),
            ..number("tone_curve")
        },
    ];
    let mut output = pass("output", PassKind::Fullscreen, "shaders/output.wgsl");
    output.reads = vec![read("hdr")];
    output.colors = vec![writes("output", Load::Keep, Blend::Replace)];
    desc.targets.push(target("output", "rgba8unorm"));
    desc.passes.push(output);
    desc.hdr = named("hdr");
    desc.output = named("output");
}

/// Forward, single pass.
pub fn forward(accumulation: &str, gather_lights: bool) -> PipelineDesc {
    let kind = PassKind::Geometry(Geometry {
        lights: if gather_lights {
            ObjectLights::Gathered
        } else {
            ObjectLights::All
        },
        ..Geometry::default()
    });
    let mut shade = pass("shade", kind, "shaders/forward/single_pass.wgsl");
    shade.colors = vec![writes("hdr", CLEAR, Blend::Replace)];
    shade.depth = Some(depth(true));
    let mut desc = PipelineDesc {
        name: "forward".into(),
        file: at(),
        targets: vec![target("depth", "depth32float"), target("hdr", accumulation)],
        passes: vec![shade],
        ..Default::default()
    };
    output(&mut desc);
    desc
}

/// Deferred shading.
pub fn deferred(accumulation: &str, volumes: bool) -> PipelineDesc {
    let kind = PassKind::Geometry(Geometry::default());
    let mut g_buffer = pass("g_buffer", kind, "shaders/deferred_shading/g_buffer.wgsl");
    let names = ["hdr", "g_albedo", "g_normal", "g_specular", "g_model"];
    g_buffer.colors = names
        .map(|name| writes(name, CLEAR, Blend::Replace))
        .to_vec();
    g_buffer.depth = Some(depth(true));
    let mut lights = pass(
        "lights",
        PassKind::Lights(Lights {
            volumes,
            ..Lights::default()
        }),
        "shaders/deferred_shading/light.wgsl",
    );
    lights.reads = ["depth", "g_albedo", "g_normal", "g_specular", "g_model"]
        .map(read)
        .to_vec();
    lights.colors = vec![writes("hdr", Load::Keep, Blend::Add)];
    lights.depth = Some(depth(false));
    let mut desc = PipelineDesc {
        name: "deferred".into(),
        file: at(),
        targets: vec![
            target("depth", "depth32float"),
            target("hdr", accumulation),
            target("g_albedo", "rgba8unorm"),
            target("g_normal", "rg16uint"),
            target("g_specular", "rgba8uint"),
            target("g_model", "r8uint"),
        ],
        passes: vec![g_buffer, lights],
        ..Default::default()
    };
    output(&mut desc);
    desc
}
