//! Entities: making, finding, placing, joining and removing them.

use lightbench_assets::{MaterialId, MeshId};
use lightbench_render::problem::suggestion;
use lightbench_world::glam::{DQuat, DVec3, Mat4, Quat, Vec3};
use lightbench_world::{Entity, MeshRenderer, Name, Transform};
use rhai::{Array, Dynamic};

use super::data::{Data, Stage};
use super::{materials, shapes};
use crate::api::{Api, Arguments, Mistake};
use crate::math::from_degrees;

/// Registers a method of an entity that gives the entity back, for chains.
pub(super) fn method(
    api: &mut Api,
    stage: &Stage,
    form: &str,
    about: &'static str,
    body: impl Fn(&mut Data, Entity, &Arguments) -> Result<(), Mistake> + Send + Sync + 'static,
) {
    let stage = stage.clone();
    api.method(form, about, move |entity: Entity, arguments| {
        body(&mut stage.lock(), entity, arguments)?;
        Ok(entity)
    });
}

/// Registers a property of an entity that can only be read.
pub(super) fn getter<R: rhai::Variant + Clone>(
    api: &mut Api,
    stage: &Stage,
    name: &str,
    about: &'static str,
    body: impl Fn(&mut Data, Entity) -> Result<R, Mistake> + Send + Sync + 'static,
) {
    let stage = stage.clone();
    api.getter(name, about, move |entity: Entity, _| {
        body(&mut stage.lock(), entity)
    });
}

/// Registers writing to a property of an entity.
pub(super) fn setter(
    api: &mut Api,
    stage: &Stage,
    name: &str,
    body: impl Fn(&mut Data, Entity, &Arguments) -> Result<(), Mistake> + Send + Sync + 'static,
) {
    let stage = stage.clone();
    api.handle_setter(name, move |entity: &Entity, arguments| {
        body(&mut stage.lock(), *entity, arguments)
    });
}

/// Registers a function that makes an entity, with and without a name.
pub(super) fn maker(
    api: &mut Api,
    stage: &Stage,
    name: &str,
    about: &'static str,
    body: impl Fn(&mut Data, Entity) -> Result<(), Mistake> + Send + Sync + Clone + 'static,
) {
    for form in [format!("{name}()"), format!("{name}(name)")] {
        let (stage, body) = (stage.clone(), body.clone());
        api.function(&form, about, move |arguments| {
            let name = match arguments.len() {
                0 => String::new(),
                _ => arguments.text(0)?,
            };
            let mut data = stage.lock();
            let entity = data.spawn(&name)?;
            body(&mut data, entity)?;
            Ok(entity)
        });
    }
}

pub(super) fn register(api: &mut Api, stage: &Stage) {
    api.object::<Entity>();
    maker(
        api,
        stage,
        "spawn",
        "Makes an entity: something that has a place in the scene.",
        |_, _| Ok(()),
    );
    find(api, stage);
    drawing(api, stage);
    placing(api, stage);
    reading(api, stage);
    family(api, stage);
}

fn find(api: &mut Api, stage: &Stage) {
    let searched = stage.clone();
    api.function("entity(name)", "Finds the entity of that name.", move |a| {
        let name = a.text(0)?;
        let mut data = searched.lock();
        data.find(&name).ok_or_else(|| {
            let names: Vec<&str> = data
                .world
                .columns::<Name>()
                .slices()
                .text
                .iter()
                .map(String::as_str)
                .collect();
            let mistake = Mistake::new(format!("there is no entity `{name}`"));
            match suggestion(&name, names) {
                Some(hint) => mistake.with_hint(hint),
                None => mistake,
            }
        })
    });
    let searched = stage.clone();
    api.function(
        "has_entity(name)",
        "Whether there is an entity of that name.",
        move |a| Ok(searched.lock().find(&a.text(0)?).is_some()),
    );
}

fn drawing(api: &mut Api, stage: &Stage) {
    method(
        api,
        stage,
        "mesh(mesh)",
        "Draws the entity as a mesh, or as a shape.",
        |data, entity, a| {
            let mesh = shapes::mesh_argument(data, a, 0)?;
            draw(data, entity, |renderer| renderer.mesh = mesh)
        },
    );
    method(
        api,
        stage,
        "material(material)",
        "Draws the entity with a material.",
        |data, entity, a| {
            let material = a.object::<materials::Material>(0)?.id;
            draw(data, entity, |renderer| renderer.material = material)
        },
    );
    method(
        api,
        stage,
        "visible(on)",
        "Whether the entity's mesh is drawn.",
        |data, entity, a| {
            let on = a.switch(0)?;
            let mut renderer: MeshRenderer = data.get(entity, "mesh")?;
            renderer.visible = on;
            data.insert(entity, renderer)
        },
    );
}

/// Changes what is drawn. A material may come before the mesh.
fn draw(
    data: &mut Data,
    entity: Entity,
    change: impl FnOnce(&mut MeshRenderer),
) -> Result<(), Mistake> {
    let mut renderer = data.world.get(entity).unwrap_or(MeshRenderer {
        mesh: MeshId::default(),
        material: MaterialId::default(),
        visible: true,
    });
    change(&mut renderer);
    data.insert(entity, renderer)
}

fn placing(api: &mut Api, stage: &Stage) {
    for form in ["at(x, y, z)", "at(position)"] {
        method(
            api,
            stage,
            form,
            "Puts the entity at a point, in metres, in its parent's space.",
            |data, entity, a| {
                let point = a.vector(0)?.as_vec3();
                data.place(entity, |t| t.translation = point)
            },
        );
    }
    for form in ["move(x, y, z)", "move(by)"] {
        method(
            api,
            stage,
            form,
            "Moves the entity on, in metres, in its parent's space.",
            |data, entity, a| {
                let by = a.vector(0)?.as_vec3();
                data.place(entity, |t| t.translation += by)
            },
        );
    }
    for form in ["turn(x, y, z)", "turn(rotation)"] {
        method(
            api,
            stage,
            form,
            "Turns the entity from its first position by degrees about y (left and right), then x \
             (up and down), then z (roll); or by a rotation.",
            |data, entity, a| {
                let rotation = rotation(a)?;
                data.aims.remove(&entity);
                data.place(entity, |t| t.rotation = rotation)
            },
        );
    }
    for form in ["rotate(x, y, z)", "rotate(rotation)"] {
        method(
            api,
            stage,
            form,
            "Turns the entity further, as `turn` would, about its own axes.",
            |data, entity, a| {
                let rotation = rotation(a)?;
                data.aims.remove(&entity);
                data.place(entity, |t| t.rotation = (t.rotation * rotation).normalize())
            },
        );
    }
    for form in ["scale(factor)", "scale(x, y, z)"] {
        method(
            api,
            stage,
            form,
            "Makes the entity larger or smaller along its own axes.",
            |data, entity, a| {
                let scale = match a.len() {
                    3 => a.vector(0)?.as_vec3(),
                    _ => match a.try_object::<DVec3>(0) {
                        Some(scale) => scale.as_vec3(),
                        None => Vec3::splat(a.float(0)?),
                    },
                };
                data.place(entity, |t| t.scale = scale)
            },
        );
    }
    for form in [
        "look_at(x, y, z)",
        "look_at(point)",
        "aim(x, y, z)",
        "aim(point)",
    ] {
        method(
            api,
            stage,
            form,
            "Turns a camera, a light or any entity to a point in its parent's space, and keeps it \
             turned there when it moves.",
            |data, entity, a| {
                let point = match a.try_object::<Entity>(0) {
                    Some(other) if a.len() == 1 => data.transform(other)?.translation,
                    _ => a.vector(0)?.as_vec3(),
                };
                data.aims.insert(entity, point);
                data.place(entity, |_| {})
            },
        );
    }
}

/// A rotation from the arguments: one rotation, three angles in degrees, or a vector of them.
fn rotation(a: &Arguments) -> Result<Quat, Mistake> {
    let rotation = match a.try_object::<DQuat>(0) {
        Some(rotation) => rotation,
        None => from_degrees(a.vector(0)?),
    };
    rotation
        .as_quat()
        .try_normalize()
        .ok_or_else(|| Mistake::new("this is no rotation"))
}

trait TryNormalize: Sized {
    fn try_normalize(self) -> Option<Self>;
}

impl TryNormalize for Quat {
    fn try_normalize(self) -> Option<Self> {
        let length = self.length();
        (length.is_finite() && length > 1e-6).then(|| self / length)
    }
}

fn reading(api: &mut Api, stage: &Stage) {
    getter(
        api,
        stage,
        "name",
        "The entity's name, or an empty text.",
        |data, entity| {
            data.check(entity)?;
            let name: Option<Name> = data.world.get(entity);
            Ok(name.unwrap_or_default().text)
        },
    );
    setter(api, stage, "name", |data, entity, a| {
        let name = a.text(0)?;
        data.insert(entity, Name::new(name.as_str()))?;
        data.note_name(entity, &name);
        Ok(())
    });
    getter(
        api,
        stage,
        "position",
        "Where it is, in its parent's space.",
        |data, entity| Ok(data.transform(entity)?.translation.as_dvec3()),
    );
    setter(api, stage, "position", |data, entity, a| {
        let point = a.vector(0)?.as_vec3();
        data.place(entity, |t| t.translation = point)
    });
    getter(
        api,
        stage,
        "rotation",
        "How it is turned, in its parent's space.",
        |data, entity| Ok(data.transform(entity)?.rotation.as_dquat()),
    );
    setter(api, stage, "rotation", |data, entity, a| {
        let rotation = rotation(a)?;
        data.aims.remove(&entity);
        data.place(entity, |t| t.rotation = rotation)
    });
    getter(
        api,
        stage,
        "size",
        "Its scale along its own axes.",
        |data, entity| Ok(data.transform(entity)?.scale.as_dvec3()),
    );
    setter(api, stage, "size", |data, entity, a| {
        let scale = match a.try_object::<DVec3>(0) {
            Some(scale) => scale.as_vec3(),
            None => Vec3::splat(a.float(0)?),
        };
        data.place(entity, |t| t.scale = scale)
    });
    getter(
        api,
        stage,
        "world_position",
        "Where it is in the world.",
        |data, entity| {
            data.check(entity)?;
            let matrix = super::bounds::world_matrix(&data.world, entity);
            Ok(Vec3::from(matrix.translation).as_dvec3())
        },
    );
    getter(
        api,
        stage,
        "world_matrix",
        "The matrix from its own space to that of the world: its place, rotation and scale, and those of \
         all that it stands below.",
        |data, entity| {
            data.check(entity)?;
            let matrix = super::bounds::world_matrix(&data.world, entity);
            Ok(Mat4::from(matrix).as_dmat4())
        },
    );
    getter(
        api,
        stage,
        "exists",
        "Whether it has not been removed.",
        |data, entity| Ok(data.world.contains(entity)),
    );
    let engine = api.engine();
    engine
        .register_fn("==", |a: Entity, b: Entity| a == b)
        .register_fn("!=", |a: Entity, b: Entity| a != b);
    crate::math::text(engine, |entity: &Entity| entity.to_string());
}

fn family(api: &mut Api, stage: &Stage) {
    method(
        api,
        stage,
        "parent(entity)",
        "Puts the entity below another one, whose movements it follows from then on.",
        |data, entity, a| {
            let parent: Entity = a.object(0)?;
            data.check(parent)?;
            data.check(entity)?;
            let (child_name, parent_name) = (data.called(entity), data.called(parent));
            data.world.set_parent(entity, Some(parent)).map_err(|_| {
                Mistake::new(format!(
                    "{child_name} can't be put below {parent_name}, which is itself or lies below it"
                ))
            })
        },
    );
    method(
        api,
        stage,
        "detach()",
        "Takes the entity away from its parent.",
        |data, entity, _| {
            data.check(entity)?;
            let detached = data.world.set_parent(entity, None);
            detached.map_err(|error| Mistake::new(error.to_string()))
        },
    );
    getter(
        api,
        stage,
        "parent",
        "Its parent, or nothing.",
        |data, entity| {
            data.check(entity)?;
            Ok(data
                .world
                .parent(entity)
                .map_or(Dynamic::UNIT, Dynamic::from))
        },
    );
    getter(
        api,
        stage,
        "children",
        "An array of its children.",
        |data, entity| {
            data.check(entity)?;
            let children: Array = data.world.children(entity).map(Dynamic::from).collect();
            Ok(children)
        },
    );
    let stage = stage.clone();
    api.method(
        "remove()",
        "Removes the entity and everything below it.",
        move |entity: Entity, _| {
            let mut data = stage.lock();
            data.check(entity)?;
            data.world.despawn(entity);
            data.aims.remove(&entity);
            Ok(())
        },
    );
}

/// The place of a camera or a light that a script has not placed.
pub(super) fn start(data: &mut Data, entity: Entity, transform: Transform) -> Result<(), Mistake> {
    data.insert(entity, transform)
}
