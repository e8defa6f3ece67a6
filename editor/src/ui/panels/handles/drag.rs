//! One drag of a handle, from where it began.

use egui::{PointerButton, Pos2, Response, Ui};
use lightbench::script::Scene;
use lightbench::world::glam::{Affine3A, Quat, Vec3};
use lightbench::world::{Entity, Transform, Value, WorldMatrix};

use super::keys::{self, Pressed};
use super::{Frame, LENGTH, Part, Tool};
use crate::ui::editor::Editor;
use crate::ui::lens::Lens;
use crate::ui::messages::say;
use crate::ui::workbench::structure::is_locked;
use crate::ui::workbench::viewports::Viewport;

/// An entity as it was when the drag began.
struct Start {
    entity: Entity,
    transform: Transform,
    /// From its parent's space to the world's.
    above: Affine3A,
}

/// How far a handle was dragged.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Amount {
    /// Metres along an axis, radians about one, or a factor.
    Along(f32),
    /// Metres across the view.
    Across(Vec3),
}

/// A drag of a handle.
pub struct Drag {
    /// The handles as they lay when it began.
    pub frame: Frame,
    /// Which one is dragged.
    pub part: Part,
    /// In which viewport.
    pub viewport: Viewport,
    from: Pos2,
    last: Pos2,
    /// Radians that the pointer has gone around the middle, against the clock.
    turned: f32,
    starts: Vec<Start>,
    amount: Amount,
    typed: String,
}

impl Drag {
    /// Takes hold of what is chosen.
    ///
    /// # Errors
    /// A sentence, where something of it can't be changed by hand.
    pub fn begin(
        editor: &Editor,
        frame: Frame,
        part: Part,
        at: Pos2,
        viewport: Viewport,
    ) -> Result<Self, String> {
        let workbench = &editor.workbench;
        let scene = workbench.scenes.scene();
        let scene = scene.ok_or_else(|| say!("handles.no_scene_is_loaded").to_owned())?;
        let mut starts = Vec::new();
        let mut locked = false;
        for entity in workbench.selection.entities() {
            // What hangs on something that is chosen goes along with it.
            let goes_along =
                ancestors(scene, entity).any(|above| workbench.selection.contains(above));
            let transform = scene.world.get::<Transform>(entity);
            let (Some(transform), false) = (transform, goes_along) else {
                continue;
            };
            if is_locked(&scene.world, entity) {
                locked = true;
                continue;
            }
            scene.keeps_by_name(entity)?;
            let parent = scene.world.parent(entity);
            let above = parent.and_then(|parent| scene.world.get::<WorldMatrix>(parent));
            starts.push(Start {
                entity,
                transform,
                above: above.map_or(Affine3A::IDENTITY, |above| above.matrix),
            });
        }
        if locked && starts.is_empty() {
            return Err(say!("handles.what_is_chosen_is_locked_unlock").to_owned());
        }
        let amount = match editor.viewport.handles.tool {
            Tool::Scale => Amount::Along(1.0),
            Tool::Move | Tool::Turn => Amount::Along(0.0),
        };
        Ok(Self {
            frame,
            part,
            viewport,
            from: at,
            last: at,
            turned: 0.0,
            starts,
            amount,
            typed: String::new(),
        })
    }

    /// The amount for people.
    pub fn words(&self, tool: Tool) -> String {
        let number = match self.amount {
            Amount::Across(by) => return format!("{:.3} {:.3} {:.3} m", by.x, by.y, by.z),
            Amount::Along(number) => number,
        };
        let axis = match self.part {
            Part::Axis(index) => ["x ", "y ", "z "][index],
            Part::Middle => "",
        };
        let typed = if self.typed.is_empty() {
            ""
        } else {
            say!("handles.typed")
        };
        match tool {
            Tool::Move => format!("{axis}{number:.3} m{typed}"),
            Tool::Turn => format!("{axis}{:.2}°{typed}", number.to_degrees()),
            Tool::Scale => format!("{axis}{number:.3} x{typed}"),
        }
    }

    fn axis(&self) -> Vec3 {
        match self.part {
            Part::Axis(index) => self.frame.axes[index],
            Part::Middle => Vec3::ZERO,
        }
    }

    /// How far the pointer went along the axis, metres.
    fn along(&self, lens: &Lens, at: Pos2) -> f32 {
        along(lens, self.frame.at, self.axis(), at)
            .zip(along(lens, self.frame.at, self.axis(), self.from))
            .map_or(0.0, |(to, from)| to - from)
    }

    /// How far the pointer went across the view, metres.
    fn across(&self, lens: &Lens, at: Pos2) -> Vec3 {
        let back = lens.view.view.inverse().z_axis.truncate();
        let plane = |at| meet(lens, self.frame.at, back, at);
        plane(at)
            .zip(plane(self.from))
            .map_or(Vec3::ZERO, |(to, from)| to - from)
    }

    /// Radians about the axis since the drag began.
    fn turn(&mut self, lens: &Lens, at: Pos2) -> f32 {
        if let Some(center) = lens.point(self.frame.at) {
            let (a, b) = (self.last - center, at - center);
            // On the screen y goes down.
            self.turned -= (a.x * b.y - a.y * b.x).atan2(a.dot(b));
        }
        self.last = at;
        let towards = lens.ray(at).direction.dot(self.axis()) < 0.0;
        if towards { self.turned } else { -self.turned }
    }

    fn follow(&mut self, lens: &Lens, tool: Tool, at: Pos2, snap: Option<f32>) {
        let turn = self.turn(lens, at);
        let snapped = |number: f32| snap.map_or(number, |step| (number / step).round() * step);
        self.amount = match (tool, self.part) {
            (Tool::Move, Part::Middle) => {
                let by = self.across(lens, at);
                Amount::Across(Vec3::from_array(by.to_array().map(snapped)))
            }
            (Tool::Move, Part::Axis(_)) => Amount::Along(snapped(self.along(lens, at))),
            (Tool::Turn, _) => Amount::Along(snapped(turn)),
            (Tool::Scale, Part::Axis(_)) => {
                Amount::Along(snapped(1.0 + self.along(lens, at) / self.frame.length))
            }
            (Tool::Scale, Part::Middle) => {
                Amount::Along(snapped(1.0 + (at.x - self.from.x) / LENGTH))
            }
        };
        if let Ok(number) = self.typed.parse::<f32>()
            && (tool, self.part) != (Tool::Move, Part::Middle)
        {
            self.amount = Amount::Along(match tool {
                Tool::Turn => number.to_radians(),
                Tool::Move | Tool::Scale => number,
            });
        }
    }

    /// What the fields of an entity are after the drag.
    fn fields(&self, tool: Tool, start: &Start) -> Vec<(&'static str, Value)> {
        const TRANSLATION: &str = "transform.translation";
        let Start {
            transform, above, ..
        } = start;
        match (tool, self.amount) {
            (Tool::Move, amount) => {
                let by = match amount {
                    Amount::Along(metres) => self.axis() * metres,
                    Amount::Across(by) => by,
                };
                let at = transform.translation + above.inverse().transform_vector3(by);
                vec![(TRANSLATION, Value::Vec3(at))]
            }
            (Tool::Turn, Amount::Along(angle)) => {
                let turn = Quat::from_axis_angle(self.axis(), angle);
                let at = above.transform_point3(transform.translation);
                let at = self.frame.at + turn * (at - self.frame.at);
                let at = above.inverse().transform_point3(at);
                let (_, parent, _) = above.to_scale_rotation_translation();
                let rotation = parent.inverse() * turn * parent * transform.rotation;
                let rotation = ("transform.rotation", Value::Quat(rotation.normalize()));
                // What turns about its own middle stays where it is.
                if at.abs_diff_eq(transform.translation, 1e-5) {
                    return vec![rotation];
                }
                vec![rotation, (TRANSLATION, Value::Vec3(at))]
            }
            (Tool::Scale, Amount::Along(factor)) => {
                let mut scale = transform.scale;
                match self.part {
                    Part::Axis(index) => scale[index] *= factor,
                    Part::Middle => scale *= factor,
                }
                vec![("transform.scale", Value::Vec3(scale))]
            }
            (Tool::Turn | Tool::Scale, Amount::Across(_)) => Vec::new(),
        }
    }
}

fn ancestors(scene: &Scene, entity: Entity) -> impl Iterator<Item = Entity> + '_ {
    std::iter::successors(scene.world.parent(entity), |above| {
        scene.world.parent(*above)
    })
}

/// Where a line of sight meets a plane.
fn meet(lens: &Lens, in_plane: Vec3, across: Vec3, at: Pos2) -> Option<Vec3> {
    let ray = lens.ray(at);
    let slope = ray.direction.dot(across);
    let distance = (in_plane - ray.origin).dot(across) / slope;
    (slope.abs() > 1e-4 && distance.is_finite()).then(|| ray.origin + ray.direction * distance)
}

/// Where on an axis the pointer is: in the plane through the axis that faces the eye most.
fn along(lens: &Lens, center: Vec3, axis: Vec3, at: Pos2) -> Option<f32> {
    let sight = lens.ray(lens.point(center)?).direction;
    let across = axis.cross(sight).cross(axis).try_normalize()?;
    let met = meet(lens, center, across, at)?;
    Some((met - center).dot(axis))
}

/// Goes on with the drag, and ends it.
pub fn go_on(editor: &mut Editor, ui: &Ui, response: &Response, lens: &Lens) {
    let handles = &mut editor.viewport.handles;
    let Some(mut drag) = handles.drag.take() else {
        return;
    };
    let (at, control) = ui.input(|input| (input.pointer.latest_pos(), input.modifiers.command));
    let pressed = keys::read(ui, &mut drag.typed);
    if pressed == Pressed::Escape {
        editor.workbench.give_up_step();
        return;
    }
    let tool = handles.tool;
    let step = match tool {
        Tool::Move => handles.snap.distance,
        Tool::Turn => handles.snap.angle.to_radians(),
        Tool::Scale => handles.snap.scale,
    };
    drag.follow(lens, tool, at.unwrap_or(drag.last), control.then_some(step));
    let changes: Vec<(Entity, &str, Value)> = drag
        .starts
        .iter()
        .flat_map(|start| {
            let fields = drag.fields(tool, start).into_iter();
            fields.map(|(path, value)| (start.entity, path, value))
        })
        .collect();
    let what = match drag.starts.len() {
        1 => tool.title().to_owned(),
        count => say!("handles.entities", title = tool.title(), count = count),
    };
    if let Err(why) = editor.workbench.set_fields(&what, &changes) {
        editor.viewport.handles.refused = Some(why);
        return;
    }
    let goes_on = response.dragged_by(PointerButton::Primary) && pressed != Pressed::Enter;
    if goes_on {
        editor.viewport.handles.drag = Some(drag);
    }
}
