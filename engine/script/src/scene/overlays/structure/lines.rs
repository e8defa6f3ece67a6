//! Changes of the structure as lines of a scene script that do the same.

use lightbench_world::ComponentKind;

use super::super::lines::{degrees_of, spell_point};
use super::{Edit, NewKind, Who};
use crate::scene::tables;
use crate::spelling::{spell_number, spell_text};

impl Edit {
    /// The lines of a scene script that do the same. `None` where scripts have no words for it: copies,
    /// and entities that can't be found by a name of their own.
    #[must_use]
    pub fn line(&self) -> Option<String> {
        let each = |of: &[Who], call: &dyn Fn(String) -> String| {
            let lines: Option<Vec<String>> = of.iter().map(|who| Some(call(find(who)?))).collect();
            Some(lines?.join("\n"))
        };
        match self {
            Self::Create {
                kind, name, place, ..
            } => {
                let name = spell_text(name);
                let made = match kind {
                    NewKind::PointLight => format!("point_light({name}).intensity(10.0)"),
                    NewKind::SpotLight => format!("spot_light({name}).intensity(10.0)"),
                    NewKind::DirectionalLight => format!("directional_light({name})"),
                    NewKind::AmbientLight => format!("ambient_light({name})"),
                    NewKind::Camera => format!("camera({name})"),
                    _ => match kind.shape() {
                        Some(shape) => format!("spawn({name}).mesh({shape})"),
                        None => format!("spawn({name})"),
                    },
                };
                let turned = degrees_of(place.rotation).to_array().map(spell_number);
                Some(format!(
                    "{made}.at({}).turn({});",
                    spell_point(place.translation),
                    turned.join(", ")
                ))
            }
            Self::Copy { .. } => None,
            Self::Assets(edit) => edit.line(),
            Self::Delete { of } => each(of, &|entity| format!("{entity}.remove();")),
            Self::Rename { of } => {
                let lines: Option<Vec<String>> = of
                    .iter()
                    .map(|(who, name)| {
                        let (entity, name) = (find(who)?, spell_text(name));
                        Some(format!("{{ let it = {entity}; it.name = {name}; }}"))
                    })
                    .collect();
                Some(lines?.join("\n"))
            }
            Self::Parent { of, to: None } => each(of, &|entity| format!("{entity}.detach();")),
            Self::Parent { of, to: Some(to) } => {
                let to = find(to)?;
                each(of, &|entity| format!("{entity}.parent({to});"))
            }
            Self::Add {
                component: ComponentKind::MeshRenderer,
                of,
            } => {
                let shape = NewKind::Box.shape()?;
                each(of, &|entity| format!("{entity}.mesh({shape});"))
            }
            Self::Add { of, component } => {
                let name = name_of(*component)?;
                each(of, &|entity| format!("{entity}.add({name});"))
            }
            Self::Drop { of, component } => {
                let name = name_of(*component)?;
                each(of, &|entity| format!("{entity}.drop({name});"))
            }
            Self::Tag { of, tag, on } => {
                let call = if *on { "tag" } else { "untag" };
                let tag = spell_text(tag);
                each(of, &|entity| format!("{entity}.{call}({tag});"))
            }
        }
    }
}

fn find(who: &Who) -> Option<String> {
    let can = who.nth == 0 && !who.name.is_empty();
    can.then(|| format!("entity({})", spell_text(&who.name)))
}

fn name_of(component: ComponentKind) -> Option<String> {
    let known = tables::components().iter();
    let named = known.clone().find(|known| known.kind == component)?;
    Some(spell_text(&named.name))
}
