//! A scene as rays need it: triangles in a tree, materials, lights, and what shines by itself.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{Affine3A, DVec3, Vec3A};
use lightbench_assets::{Assets, Entry, Material, MaterialId, Mesh, TextureId};
use lightbench_render::gpu_data::{LightData, VertexAttributes, matrix_rows};
use lightbench_render::scene::light_data;
use lightbench_world::{ClipVolume, Light, MeshRenderer, World, WorldMatrix};

use super::emitters::Emitters;
use super::geometry::{Corners, Geometry, Instance, Loose, Traits};
use super::joined::Joined;
use super::lights::Lights;
use super::texture::Filtered;
use crate::reference::lighting::AMBIENT;
use crate::reference::transform::Rows;

/// A material with its textures at hand.
pub struct TracedMaterial {
    /// As the scene has it.
    pub material: Material,
    /// The picture of its base colour.
    pub base_color: Option<Filtered>,
    /// Its normal map.
    pub normals: Option<Filtered>,
    /// Both, where they can stand beside each other.
    pub joined: Option<Arc<Joined>>,
    /// What rays must know of its triangles.
    pub traits: Traits,
}

/// A scene that rays can be sent through. It does not follow changes of the world that it was made
/// from.
pub struct TracedScene {
    pub(super) geometry: Geometry,
    pub(super) materials: Vec<TracedMaterial>,
    /// All lights in the order of their rows, ambient ones too.
    pub(super) all_lights: Vec<LightData>,
    /// Those that shine from somewhere.
    pub(super) lights: Lights,
    /// Radiance of all ambient lights together.
    pub(super) sky: DVec3,
    pub(super) emitters: Emitters,
    warnings: Vec<String>,
}

impl TracedScene {
    /// Takes a scene as it stands. The world's matrices must be up to date, as
    /// [`Scene::refresh`](lightbench_script::Scene::refresh) makes them.
    pub fn new(world: &World, assets: &Assets) -> Self {
        let materials = materials(assets);
        let geometry = gather(world, assets, &materials);
        let all_lights = lights(world);
        let sky = all_lights.iter().filter(|light| light.kind == AMBIENT);
        Self {
            sky: sky.map(|light| light.intensity.as_dvec3()).sum(),
            lights: Lights::new(&all_lights),
            emitters: Emitters::new(&geometry, &materials),
            all_lights,
            geometry,
            materials,
            warnings: warnings(world),
        }
    }

    /// How many triangles there are.
    pub fn triangles(&self) -> usize {
        self.geometry.len()
    }

    /// How many lights shine from somewhere.
    pub fn lights(&self) -> usize {
        self.lights.len()
    }

    /// How many triangles shine.
    pub fn emitters(&self) -> usize {
        self.emitters.len()
    }

    /// What of the scene is not traced, one sentence each.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The material of a triangle.
    pub(super) fn material(&self, triangle: u32) -> &TracedMaterial {
        &self.materials[self.geometry.instance(triangle).material as usize]
    }
}

impl TracedMaterial {
    /// With the textures of a table.
    pub fn new(material: &Material, assets: &Assets) -> Self {
        let texture = |id| assets.texture(id).map(Filtered::new);
        let set = |condition, traits| if condition { traits } else { Traits::default() };
        let base_color = material.base_color_texture.and_then(texture);
        Self {
            traits: set(!material.two_sided, Traits::ONE_SIDED)
                .with(set(
                    material.alpha_cutoff.is_some() && base_color.is_some(),
                    Traits::HOLES,
                ))
                .with(set(material.is_transparent(), Traits::TRANSPARENT))
                .with(set(material.emissive.max_element() > 0.0, Traits::EMISSIVE)),
            base_color,
            normals: material.normal_texture.and_then(texture),
            joined: None,
            material: material.clone(),
        }
    }
}

/// All materials of a scene. Those of the same textures share them.
fn materials(assets: &Assets) -> Vec<TracedMaterial> {
    let mut known: HashMap<[TextureId; 2], Option<Arc<Joined>>> = HashMap::new();
    let mut join = |entry: &Entry<Material>| {
        let material = &entry.value;
        let mut traced = TracedMaterial::new(material, assets);
        let ids = [material.base_color_texture, material.normal_texture];
        if let [Some(color), Some(normals)] = ids
            && let (Some(first), Some(second)) = (&traced.base_color, &traced.normals)
        {
            let joined = known
                .entry([color, normals])
                .or_insert_with(|| Joined::new(first, second).map(Arc::new));
            traced.joined.clone_from(joined);
        }
        traced
    };
    assets.materials().iter().map(&mut join).collect()
}

/// All lights as shaders see them, in the order of their rows.
fn lights(world: &World) -> Vec<LightData> {
    let lights = world.columns::<Light>();
    let entities = lights.entities().iter().enumerate();
    entities
        .map(|(row, entity)| {
            let matrix = world.get::<WorldMatrix>(*entity).unwrap_or_default().matrix;
            light_data(
                &lights.row(row),
                matrix.translation.into(),
                (-matrix.matrix3.z_axis).into(),
            )
        })
        .collect()
}

fn warnings(world: &World) -> Vec<String> {
    let lights = world.columns::<Light>();
    let volumes = world.columns::<ClipVolume>();
    let clipped = volumes.entities().iter();
    let clipped = clipped
        .filter(|entity| lights.row_of(**entity).is_some())
        .count();
    let mut warnings = Vec::new();
    if clipped > 0 {
        warnings.push(format!(
            "{clipped} lights have a clip volume, which is not traced: they shine past it"
        ));
    }
    warnings
}

/// All triangles of objects that are drawn.
fn gather(world: &World, assets: &Assets, materials: &[TracedMaterial]) -> Geometry {
    let mut loose = Vec::new();
    let mut instances = Vec::new();
    let renderers = world.columns::<MeshRenderer>();
    for (row, entity) in renderers.entities().iter().enumerate() {
        let renderer = renderers.row(row);
        // A mesh that can't be drawn is not traced either.
        let sound = |mesh: &&Arc<Mesh>| renderer.visible && mesh.validate().is_ok();
        let Some(mesh) = assets.mesh(renderer.mesh).filter(sound) else {
            continue;
        };
        let matrix = world.get::<WorldMatrix>(*entity).unwrap_or_default().matrix;
        let known = (renderer.material.0 as usize) < materials.len();
        let MaterialId(material) = if known {
            renderer.material
        } else {
            MaterialId(0)
        };
        let rows = Rows::new(matrix_rows(&matrix));
        let object = Object {
            instance: instances.len() as u32,
            mirrored: rows.is_mirrored(),
            traits: materials[material as usize].traits,
        };
        loose.extend(object.triangles(mesh, &matrix));
        instances.push(Instance { rows, material });
    }
    Geometry::new(&loose, instances)
}

/// A vertex but for its position.
fn attributes(mesh: &Mesh, vertex: usize) -> VertexAttributes {
    VertexAttributes {
        normal: mesh.normals[vertex].to_array(),
        uv: mesh.uvs[vertex].to_array(),
        tangent: mesh.tangents[vertex].to_array(),
    }
}

/// What the triangles of an object have in common.
struct Object {
    instance: u32,
    mirrored: bool,
    traits: Traits,
}

impl Object {
    /// Those that have an area.
    fn triangles<'a>(
        &'a self,
        mesh: &'a Mesh,
        matrix: &'a Affine3A,
    ) -> impl Iterator<Item = Loose> + 'a {
        mesh.triangles().filter_map(|corners| {
            // A mirror turns the winding round.
            let [a, b, c] = corners;
            let corners = if self.mirrored { [a, c, b] } else { [a, b, c] };
            let positions =
                corners.map(|corner| matrix.transform_point3a(Vec3A::from(mesh.positions[corner])));
            let [a, b, c] = positions;
            let area = (b - a).cross(c - a).length_squared();
            (area > 0.0 && area.is_finite()).then_some(Loose {
                positions,
                corners: Corners {
                    instance: self.instance,
                    vertices: corners.map(|corner| attributes(mesh, corner)),
                },
                traits: self.traits,
            })
        })
    }
}
