//! What scripts call the components and fields that the world describes: `light.range` is the field
//! `range` of the component `Light`. Nothing is listed here; the world's descriptions are the list.

use std::collections::HashMap;
use std::sync::LazyLock;

use lightbench_render::problem::suggestion;
use lightbench_world::ComponentKind;
use lightbench_world::reflect::{FieldInfo, Role};

use crate::api::Mistake;
use crate::names::list;

/// A component, as scripts know it.
#[derive(Debug)]
pub(super) struct Component {
    /// As in `mesh_renderer`.
    pub(super) name: String,
    pub(super) kind: ComponentKind,
}

/// A field, as scripts know it.
#[derive(Debug)]
pub(super) struct Field {
    /// As in `mesh_renderer.visible`.
    pub(super) path: String,
    /// As in `mesh_renderer`.
    pub(super) component: String,
    pub(super) kind: ComponentKind,
    /// Its position in the component's description.
    pub(super) index: usize,
    pub(super) info: &'static FieldInfo,
}

impl Component {
    /// Refuses a component that the engine writes.
    pub(super) fn refuse_computed(&self) -> Result<(), Mistake> {
        refuse_computed(&self.name, self.kind)
    }
}

impl Field {
    /// Refuses a field that the engine writes.
    pub(super) fn refuse_computed(&self) -> Result<(), Mistake> {
        refuse_computed(&self.component, self.kind)
    }
}

fn refuse_computed(name: &str, kind: ComponentKind) -> Result<(), Mistake> {
    match kind.info().role {
        Role::Computed => Err(Mistake::new(format!(
            "`{name}` is computed by the engine: it can be read, but not changed, added or dropped"
        ))),
        Role::Shown | Role::Hidden => Ok(()),
    }
}

static COMPONENTS: LazyLock<Vec<Component>> = LazyLock::new(|| {
    let known = ComponentKind::ALL.iter().copied();
    known
        .filter(|kind| kind.info().role != Role::Hidden)
        .map(|kind| Component {
            name: snake_case(kind.info().name),
            kind,
        })
        .collect()
});

static FIELDS: LazyLock<HashMap<String, Field>> = LazyLock::new(|| {
    let mut fields = HashMap::new();
    for component in components() {
        for (index, info) in component.kind.info().fields.iter().enumerate() {
            let path = format!("{}.{}", component.name, info.name);
            let field = Field {
                path: path.clone(),
                component: component.name.clone(),
                kind: component.kind,
                index,
                info,
            };
            fields.insert(path, field);
        }
    }
    fields
});

/// All components that scripts can name, in the order in which they are declared.
pub(super) fn components() -> &'static [Component] {
    &COMPONENTS
}

/// The component of that name.
pub(super) fn component(name: &str) -> Result<&'static Component, Mistake> {
    let known = components();
    known
        .iter()
        .find(|component| component.name == name)
        .ok_or_else(|| {
            let names = || known.iter().map(|component| component.name.as_str());
            Mistake::new(format!("there is no component `{name}`")).with_hint(
                suggestion(name, names())
                    .unwrap_or_else(|| format!("there are {}", list(names(), "and"))),
            )
        })
}

/// The field of that path.
pub(super) fn field(path: &str) -> Result<&'static Field, Mistake> {
    FIELDS.get(path).ok_or_else(|| no_field(path))
}

/// The field of that name of a component that was found.
pub(super) fn field_of(component: &Component, name: &str) -> Result<&'static Field, Mistake> {
    field(&format!("{}.{name}", component.name))
}

fn no_field(path: &str) -> Mistake {
    let Some((component, name)) = path.split_once('.') else {
        let mistake = Mistake::new(format!("there is no field `{path}`"));
        let mut paths: Vec<&str> = FIELDS.keys().map(String::as_str).collect();
        paths.retain(|known| known.split_once('.').is_some_and(|(_, name)| name == path));
        paths.sort_unstable();
        return mistake.with_hint(match paths.as_slice() {
            [] => "a field is written with its component, as in `light.range`".to_owned(),
            paths => format!("did you mean {}?", list(paths.iter().copied(), "or")),
        });
    };
    let known = match self::component(component) {
        Ok(known) => known,
        Err(mistake) => return mistake,
    };
    let names = || known.kind.info().fields.iter().map(|field| field.name);
    Mistake::new(format!("`{component}` has no field `{name}`")).with_hint(
        suggestion(name, names()).unwrap_or_else(|| format!("it has {}", list(names(), "and"))),
    )
}

/// `MeshRenderer` as scripts spell it: `mesh_renderer`.
fn snake_case(name: &str) -> String {
    let mut snake = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}
