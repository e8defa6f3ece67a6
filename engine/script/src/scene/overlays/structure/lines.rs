//! Changes of the structure as lines of a scene script that do the same.

use lightbench_world::ComponentKind;

use super::super::lines::{degrees_of, spell_point};
use super::{Done, Edit, NewKind, Overlays, Who};
use crate::scene::{Scene, tables};
use crate::spelling::{spell_number, spell_text};

impl Overlays {
    /// All changes of the structure, oldest first, each with the lines of a scene script that do the same,
    /// or a sentence that says why scripts have no words for it, or what to write instead.
    pub fn edit_lines<'a>(
        &'a self,
        scene: &'a Scene,
    ) -> impl DoubleEndedIterator<Item = (&'a Edit, Result<String, String>)> {
        let all = self.edits.iter();
        all.map(|done| (&done.edit, done.lines(scene)))
    }
}

impl Done {
    fn lines(&self, scene: &Scene) -> Result<String, String> {
        match &self.edit {
            Edit::Assets(edit) => edit.lines(scene, self.inverse.as_ref()),
            Edit::Copy { .. } => Err(
                "scripts don't copy entities: write the lines that make them once more, with other names"
                    .to_owned(),
            ),
            edit => edit.line().ok_or_else(|| {
                "a script finds entities by a name of their own, and one of these has none: give it one in \
                 the scene's script"
                    .to_owned()
            }),
        }
    }
}

impl Edit {
    /// The lines of a scene script that do the same. `None` where scripts have no words for it: copies,
    /// changes of assets, which need the scene, and entities that can't be found by a name of their own.
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
            Self::Copy { .. } | Self::Assets(_) => None,
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

/// The call that finds an entity, where one does.
pub(super) fn find(who: &Who) -> Option<String> {
    let can = who.nth == 0 && !who.name.is_empty();
    can.then(|| format!("entity({})", spell_text(&who.name)))
}

fn name_of(component: ComponentKind) -> Option<String> {
    let known = tables::components().iter();
    let named = known.clone().find(|known| known.kind == component)?;
    Some(spell_text(&named.name))
}
