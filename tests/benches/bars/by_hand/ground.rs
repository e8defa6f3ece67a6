//! What both pipelines by hand stand on: the scene, uploaded once, and their textures and buffers.

use std::borrow::Cow;
use std::collections::HashMap;

use lightbench::assets::files::Files;
use lightbench::render::description::{
    Define, DrawList, DrawOrder, Lights, ObjectLights, PassDesc, PassKind,
};
use lightbench::render::frame::{Frame, FrameRequest, ListKey};
use lightbench::render::layout::SceneLayout;
use lightbench::render::scene::Scene;
use lightbench::render::shader::ShaderComposer;
use lightbench::render::{Gpu, PipelineDesc};
use lightbench_tests::Studio;

/// The scene on the device and what passes read and write.
pub struct Ground {
    pub gpu: Gpu,
    pub size: (u32, u32),
    /// Formats and defines are taken from it, so that both sides do the same work.
    pub desc: PipelineDesc,
    /// Meshes.
    pub scene: Scene,
    /// What is drawn, extracted once.
    pub frame: Frame,
    /// Group 0.
    pub scene_group: wgpu::BindGroup,
    pub scene_layout: SceneLayout,
    pub textures: HashMap<String, wgpu::Texture>,
    pub buffers: HashMap<String, wgpu::Buffer>,
    files: Files,
    composer: ShaderComposer,
}

/// The group in which a shader finds textures and buffers.
pub struct Bound {
    pub layout: wgpu::BindGroupLayout,
    pub group: wgpu::BindGroup,
}

impl Ground {
    /// Uploads the scene and extracts its frame.
    pub fn new(studio: &mut Studio, desc: PipelineDesc, size: (u32, u32)) -> Self {
        let gpu = studio.renderer.gpu().clone();
        let scene_layout = SceneLayout::new(&gpu);
        let mut scene = Scene::new(&gpu, &scene_layout);
        let (world, assets) = (&studio.scene.world, &studio.scene.assets);
        scene.sync_assets(assets, desc.reflection_models()).unwrap();
        scene.sync_world(world);
        let lists = [ListKey {
            list: DrawList::Opaque,
            order: DrawOrder::State,
            lights: ObjectLights::Nothing,
            repeat: None,
            layers: 0,
        }];
        let light_lists: Vec<Lights> = desc.passes.iter().filter_map(lights_of).collect();
        let request = FrameRequest {
            view: studio.view,
            size,
            time: 0.0,
            index: 0,
            models: desc.reflection_models(),
            previous: None,
            lists: &lists,
            light_lists: &light_lists,
            shadow_lists: &[],
            clamps_depth: gpu.clamps_depth(),
        };
        let mut frame = Frame::default();
        frame.extract(world, assets, scene.instances(), scene.lights(), &request);
        let scene_group = scene.upload(&frame).clone();
        Self {
            size,
            scene,
            frame,
            scene_group,
            scene_layout,
            textures: HashMap::new(),
            buffers: HashMap::new(),
            files: studio.files.clone(),
            composer: ShaderComposer::new(&studio.files, gpu.capabilities()).unwrap(),
            gpu,
            desc,
        }
    }

    /// Records and submits a frame, and waits until the device is idle.
    pub fn draw(&self, record: impl FnOnce(&mut wgpu::CommandEncoder)) {
        let device = &self.gpu.device;
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        record(&mut encoder);
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.wait(60).unwrap();
    }

    /// A pass of the description.
    pub fn pass(&self, name: &str) -> &PassDesc {
        self.desc
            .passes
            .iter()
            .find(|pass| pass.name == name)
            .unwrap()
    }

    /// The format of a target.
    pub fn format(&self, target: &str) -> wgpu::TextureFormat {
        self.desc.target(target).unwrap().format.0
    }

    /// Makes a texture as large as the picture.
    pub fn texture(&mut self, name: &str) {
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC;
        let texture = self.gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(name),
            size: wgpu::Extent3d {
                width: self.size.0,
                height: self.size.1,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: self.format(name),
            usage,
            view_formats: &[],
        });
        self.textures.insert(name.to_owned(), texture);
    }

    /// Makes a buffer of so many 32-bit words.
    pub fn buffer(&mut self, name: &str, words: u32) {
        let buffer = self.gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(name),
            size: u64::from(words) * 4,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.buffers.insert(name.to_owned(), buffer);
    }

    /// The view of a texture.
    pub fn view(&self, name: &str) -> wgpu::TextureView {
        self.textures[name].create_view(&wgpu::TextureViewDescriptor::default())
    }

    /// A shipped shader, and what it finds in group 1.
    pub fn shader(
        &mut self,
        path: &str,
        defines: &[Define],
        stage: wgpu::ShaderStages,
    ) -> (wgpu::ShaderModule, Option<Bound>) {
        let shader = self.composer.compose(&self.files, path, defines).unwrap();
        let bound = self.bind(&shader.module, stage);
        let descriptor = wgpu::ShaderModuleDescriptor {
            label: Some(path),
            source: wgpu::ShaderSource::Naga(Cow::Owned(shader.module)),
        };
        (self.gpu.device.create_shader_module(descriptor), bound)
    }

    /// The shader of a pass of the description, with its defines.
    pub fn shader_of(
        &mut self,
        pass: &str,
        stage: wgpu::ShaderStages,
    ) -> (wgpu::ShaderModule, Option<Bound>) {
        let shader = self.pass(pass).shader.clone().unwrap();
        self.shader(&shader.path, &shader.defines, stage)
    }

    /// Binds textures and buffers by the names that the shader has for them.
    fn bind(&self, module: &naga::Module, visibility: wgpu::ShaderStages) -> Option<Bound> {
        let mut entries = Vec::new();
        let mut views = Vec::new();
        let mut buffers = Vec::new();
        for (_, variable) in module.global_variables.iter() {
            let Some(binding) = variable.binding.filter(|binding| binding.group == 1) else {
                continue;
            };
            // The composer adds the module to names that are not the shader's own.
            let name = variable.name.as_deref().unwrap();
            let name = name.split("X_naga_oil_mod_X").next().unwrap();
            let ty = match self.textures.get(name) {
                Some(texture) => {
                    views.push((binding.binding, self.view(name)));
                    wgpu::BindingType::Texture {
                        sample_type: texture.format().sample_type(None, None).unwrap(),
                        view_dimension: wgpu::TextureViewDimension::D2,
                        multisampled: false,
                    }
                }
                None => {
                    buffers.push((binding.binding, &self.buffers[name]));
                    let written = matches!(
                        variable.space,
                        naga::AddressSpace::Storage { access } if access.contains(naga::StorageAccess::STORE)
                    );
                    wgpu::BindingType::Buffer {
                        ty: wgpu::BufferBindingType::Storage {
                            read_only: !written,
                        },
                        has_dynamic_offset: false,
                        min_binding_size: None,
                    }
                }
            };
            entries.push(wgpu::BindGroupLayoutEntry {
                binding: binding.binding,
                visibility,
                ty,
                count: None,
            });
        }
        if entries.is_empty() {
            return None;
        }
        let device = &self.gpu.device;
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &entries,
        });
        let views = views.iter().map(|(binding, view)| wgpu::BindGroupEntry {
            binding: *binding,
            resource: wgpu::BindingResource::TextureView(view),
        });
        let buffers = buffers
            .iter()
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: buffer.as_entire_binding(),
            });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &layout,
            entries: &views.chain(buffers).collect::<Vec<_>>(),
        });
        Some(Bound { layout, group })
    }
}

fn lights_of(pass: &PassDesc) -> Option<Lights> {
    match &pass.kind {
        PassKind::Lights(lights) => Some(lights.clone()),
        _ => None,
    }
}
