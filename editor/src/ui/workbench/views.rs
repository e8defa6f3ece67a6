//! What was looked at: the camera, what was chosen and how the window was arranged, with a way back and
//! forth of its own.
//!
//! Who changes something, turns the view to look at it and takes the change back wants the view to stay.
//! So views are no steps among changes, as in most programs of the kind. They are those of the first
//! viewport.

use std::sync::Arc;
use std::time::{Duration, Instant};

use lightbench::world::{Entity, Name};

use super::Workbench;
use super::sight::Sight;
use super::viewports::Viewport;
use crate::ui::messages::say;
use crate::ui::window_view::WindowView;
use crate::viewpoint::Eye;

/// A camera that moves on within this time is in the same gesture, as when a wheel is turned.
const GESTURE: Duration = Duration::from_millis(700);

/// Views that are kept.
const CAPACITY: usize = 1_000;

/// What was looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Looked {
    /// What led there, in words.
    pub what: String,
    /// What was seen of the scene; `None` where it was another one than that on screen.
    seen: Option<Seen>,
    window: Arc<WindowView>,
}

/// What was seen of a scene.
#[derive(Clone, Debug, PartialEq)]
struct Seen {
    eye: Eye,
    chosen: Vec<Entity>,
    names: Vec<String>,
}

/// What was looked at, oldest first.
#[derive(Debug, Default)]
pub struct Views {
    all: Vec<Looked>,
    /// The present one.
    at: usize,
    /// When the camera moved last.
    moved: Option<Instant>,
    /// Whether a button or a key was held when it was looked last.
    held: bool,
    /// Whether a change counts as made by the program.
    absorbs: bool,
    /// How the window is to be arranged, until it is.
    wanted: Option<Arc<WindowView>>,
    revision: u64,
}

impl Views {
    /// All views, oldest first.
    pub fn all(&self) -> &[Looked] {
        &self.all
    }

    /// Which of them is the present one.
    pub fn at(&self) -> usize {
        self.at
    }

    /// How often it was another one.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// How the window is to be arranged, where another view was gone to.
    pub fn take_window(&mut self) -> Option<Arc<WindowView>> {
        self.wanted.take()
    }

    /// Another scene is on screen: of the old one nothing can be looked at any more, but the window can be
    /// arranged as it was.
    fn leave_scene(&mut self) {
        let mut at = 0;
        let mut kept: Vec<Looked> = Vec::new();
        for (index, looked) in std::mem::take(&mut self.all).into_iter().enumerate() {
            if kept
                .last()
                .is_none_or(|last| !Arc::ptr_eq(&last.window, &looked.window))
            {
                let seen = None;
                kept.push(Looked { seen, ..looked });
            }
            if index <= self.at {
                at = kept.len() - 1;
            }
        }
        self.absorbs = !kept.is_empty();
        (self.all, self.at, self.moved) = (kept, at, None);
    }

    /// The next change of the camera begins a gesture of its own.
    fn seal(&mut self) {
        self.moved = None;
    }

    fn note(&mut self, new: Looked, now: Instant, held: bool) {
        let Some(last) = self.all.get_mut(self.at) else {
            self.all.push(new);
            return;
        };
        if std::mem::take(&mut self.absorbs) {
            let what = std::mem::take(&mut last.what);
            *last = Looked { what, ..new };
            return;
        }
        let eye = |looked: &Looked| looked.seen.as_ref().map(|seen| seen.eye.clone());
        let turned = eye(last) != eye(&new);
        let same_window = Arc::ptr_eq(&last.window, &new.window);
        if last.seen == new.seen && same_window {
            return;
        }
        self.revision += 1;
        let goes_on = self
            .moved
            .is_some_and(|moved| held || now.saturating_duration_since(moved) < GESTURE);
        let chosen = |looked: &Looked| looked.seen.as_ref().map(|seen| seen.chosen.clone());
        let eye_alone = turned && same_window && chosen(last) == chosen(&new);
        if eye_alone && goes_on {
            let what = std::mem::take(&mut last.what);
            *last = Looked { what, ..new };
        } else {
            self.all.truncate(self.at + 1);
            self.all.push(new);
            if self.all.len() > CAPACITY {
                self.all.remove(0);
            }
            self.at = self.all.len() - 1;
        }
        self.moved = turned.then_some(now);
    }
}

impl Workbench {
    /// Takes note of where the camera is, what is chosen and how the window is arranged. `held` says that a
    /// mouse button or a key is held down: until it is let go a gesture goes on.
    pub fn note_view(&mut self, now: Instant, held: bool, window: &Arc<WindowView>) {
        let was_held = std::mem::replace(&mut self.views.held, held);
        if held && !was_held {
            self.views.seal();
        }
        self.note_present_view(now, held, window);
        if was_held && !held {
            self.views.seal();
        }
    }

    fn note_present_view(&mut self, now: Instant, held: bool, window: &Arc<WindowView>) {
        if self.is_between_scenes() || self.scenes.scene().is_none() {
            return;
        }
        let eye = self.eye(Viewport::First);
        let chosen: Vec<Entity> = self.selection.entities().collect();
        let last = self.views.all.get(self.views.at);
        let rearranged = last.filter(|last| !Arc::ptr_eq(&last.window, window));
        let seen = last.and_then(|last| last.seen.as_ref());
        let turned = seen.is_none_or(|seen| seen.eye != eye);
        let same = !turned && seen.is_some_and(|seen| seen.chosen == chosen);
        if same && rearranged.is_none() && !self.views.absorbs {
            return;
        }
        let names = self.names_of(&chosen);
        let what = match (rearranged, turned) {
            (Some(last), _) => window.words_since(&last.window),
            (None, true) => self.words_for_eye(&eye),
            (None, false) => match names.as_slice() {
                [] => say!("history.nothing_chosen").to_owned(),
                [one] if one.is_empty() => {
                    say!("history.chosen", name = say!("entities.what_has_no_name"))
                }
                [one] => say!("history.chosen", name = one),
                all => say!("history.several_chosen", count = all.len()),
            },
        };
        let looked = Looked {
            what,
            seen: Some(Seen { eye, chosen, names }),
            window: Arc::clone(window),
        };
        self.views.note(looked, now, held);
    }

    /// Takes a change of camera or choice as the program's own, which is no view of a person.
    pub(super) fn absorb_view(&mut self) {
        self.views.absorbs = true;
    }

    /// Forgets what was seen of the scene, as where another one is on screen.
    pub(super) fn forget_views(&mut self) {
        self.views.leave_scene();
    }

    /// Back to the view before. Returns whether there was one.
    pub fn view_back(&mut self) -> bool {
        let there = self.views.at > 0;
        if there {
            self.go_to_view(self.views.at - 1);
        }
        there
    }

    /// Forth to the view after. Returns whether there was one.
    pub fn view_forth(&mut self) -> bool {
        let there = self.views.at + 1 < self.views.all.len();
        if there {
            self.go_to_view(self.views.at + 1);
        }
        there
    }

    /// Goes to one of the views.
    pub fn go_to_view(&mut self, index: usize) {
        let Some(looked) = self.views.all.get(index).cloned() else {
            return;
        };
        self.views.at = index;
        self.views.revision += 1;
        self.views.seal();
        self.views.wanted = Some(looked.window);
        if let Some(seen) = &looked.seen {
            self.look_with(Viewport::First, seen.eye.clone());
        }
        if let (Some(scene), Some(seen)) = (self.scenes.scene(), &looked.seen) {
            // In a scene that was loaded anew the same names stand for other entities.
            let now = seen.chosen.iter().zip(&seen.names);
            let found = now.filter_map(|(entity, name)| match name.as_str() {
                "" => scene.world.contains(*entity).then_some(*entity),
                name => scene.world.find(name),
            });
            let found: Vec<Entity> = found.collect();
            self.selection.set(scene, found);
        }
        self.absorb_view();
        self.canvas.invalidate();
    }

    /// Has a viewport see from where somebody was.
    pub(super) fn look_with(&mut self, viewport: Viewport, eye: Eye) {
        match eye {
            Eye::Scene => self.reset_camera_of(viewport),
            Eye::Named(name) => self.look_through_in(viewport, Sight::Camera(name)),
            Eye::Free(free) => self.camera_of_mut(viewport).stand(free),
            Eye::Side(flat) => self.camera_of_mut(viewport).show_flat(flat),
        }
    }

    /// The names of entities; empty for one without.
    pub(super) fn names_of(&self, entities: &[Entity]) -> Vec<String> {
        let world = self.scenes.scene().map(|scene| &scene.world);
        let name = |entity: &Entity| {
            let name: Option<Name> = world.and_then(|world| world.get(*entity));
            name.map_or_else(String::new, |name| name.text)
        };
        entities.iter().map(name).collect()
    }

    fn words_for_eye(&self, eye: &Eye) -> String {
        match eye {
            Eye::Scene => say!("history.scene_camera").to_owned(),
            Eye::Named(name) => say!("history.named_camera", name = name),
            Eye::Free(_) => say!("history.camera_moved").to_owned(),
            Eye::Side(flat) => say!("history.side", side = flat.side.title()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn looked_in(window: &Arc<WindowView>, name: &str, chosen: &[Entity]) -> Looked {
        Looked {
            what: name.to_owned(),
            seen: Some(Seen {
                eye: Eye::Named(name.to_owned()),
                chosen: chosen.to_vec(),
                names: vec![String::new(); chosen.len()],
            }),
            window: Arc::clone(window),
        }
    }

    fn words(views: &Views) -> Vec<&str> {
        views.all().iter().map(|view| view.what.as_str()).collect()
    }

    #[test]
    fn a_gesture_is_one_view_and_a_new_one_ends_the_way_forth() {
        let window = Arc::default();
        let looked = |name: &str, chosen: &[Entity]| looked_in(&window, name, chosen);
        let mut views = Views::default();
        let began = Instant::now();
        let after = |ms: u64| began + Duration::from_millis(ms);
        views.note(looked("home", &[]), began, false);
        views.note(looked("a", &[]), after(100), false);
        views.note(looked("b", &[]), after(600), false);
        assert_eq!(words(&views), ["home", "a"], "the wheel turns on");
        views.note(looked("c", &[]), after(2000), false);
        views.note(looked("d", &[]), after(9000), true);
        assert_eq!(words(&views), ["home", "a", "c"], "the button is held");
        views.note(looked("d", &[Entity::NONE]), after(9001), false);
        assert_eq!(views.all().len(), 4, "another choice");
        views.at = 1;
        views.note(looked("e", &[]), after(20_000), false);
        assert_eq!(words(&views), ["home", "a", "e"]);
        assert_eq!(views.at(), 2);
        views.absorbs = true;
        views.note(looked("f", &[]), after(40_000), false);
        assert_eq!(words(&views), ["home", "a", "e"], "the program did it");
        assert_eq!(views.all()[2].seen, looked("f", &[]).seen);
        for number in 0..CAPACITY as u64 + 9 {
            let name = number.to_string();
            views.note(looked(&name, &[]), after(50_000 + number * 1000), false);
        }
        assert_eq!(views.all().len(), CAPACITY);
    }
    #[test]
    fn of_another_scene_the_window_alone_stays() {
        let windows: [Arc<WindowView>; 2] = std::array::from_fn(|_| Arc::default());
        let began = Instant::now();
        let after = |seconds: u64| began + Duration::from_secs(seconds);
        let mut views = Views::default();
        for (seconds, (name, window)) in [("a", 0), ("b", 0), ("c", 1), ("d", 1)]
            .into_iter()
            .enumerate()
        {
            let looked = looked_in(&windows[window], name, &[]);
            views.note(looked, after(seconds as u64 * 9), false);
        }
        assert_eq!((words(&views).len(), views.at()), (4, 3));
        views.leave_scene();
        assert_eq!(words(&views), ["a", "c"]);
        assert_eq!(views.at(), 1);
        assert!(views.all().iter().all(|looked| looked.seen.is_none()));
        let home = looked_in(&windows[1], "home", &[]);
        views.note(home, after(99), false);
        assert_eq!(words(&views), ["a", "c"], "the scene came by itself");
        assert!(views.all()[1].seen.is_some());
    }
}
