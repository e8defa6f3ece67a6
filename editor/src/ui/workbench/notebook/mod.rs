//! The laboratory notebook: measurements that a person has kept, in the project's folder.
//!
//! An entry that can't be written stays in memory until it can.

mod changing;
mod disk;
mod entry;
mod markdown;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use lightbench::assets::Task;
use lightbench::lab::LdrImage;
use lightbench::lab::report::{Adapter, Machine};
use lightbench::render::description::Slice;
use lightbench::render::readback::Reading;

use super::Workbench;
use crate::ui::messages::say;

pub use self::changing::Deleted;
pub use self::entry::{Difference, Entry};

/// The folder of the notebook in a project.
pub const NOTEBOOK: &str = "notebook";

/// The file that an export writes into it.
pub const EXPORT: &str = "notebook.md";

/// An entry as the panel shows it.
#[derive(Clone, Debug)]
pub struct Kept {
    /// What was kept.
    pub entry: Entry,
    /// Its picture, small.
    pub thumbnail: Option<Arc<LdrImage>>,
    /// Its picture as a file; only of entries that are not on the disk.
    png: Option<Arc<Vec<u8>>>,
    /// Why it is not on the disk.
    pub unsaved: Option<String>,
}

impl Kept {
    fn png(&self) -> Option<&[u8]> {
        self.png.as_deref().map(Vec::as_slice)
    }
}

/// A picture that is on its way to a new entry.
struct Coming {
    reading: Reading,
    size: (u32, u32),
    entry: Entry,
}

/// What a thread has done.
enum Done {
    /// The folder was read.
    Read(Vec<Kept>, Vec<String>),
    /// An entry was made, and written or not; whether it is new.
    Wrote(Box<Kept>, bool),
}

/// The notebook of the project.
#[derive(Default)]
pub struct Notebook {
    /// The entries, the newest first.
    entries: Vec<Kept>,
    coming: Option<Coming>,
    tasks: Vec<Task<Done>>,
    /// Whether the folder was read.
    is_read: bool,
    /// What went well or wrong last, in a sentence.
    pub said: Option<Result<String, String>>,
}

impl Notebook {
    /// The entries, the newest first.
    pub fn entries(&self) -> &[Kept] {
        &self.entries
    }

    /// Whether something is read or written.
    pub fn is_busy(&self) -> bool {
        self.coming.is_some() || !self.tasks.is_empty()
    }

    fn add(&mut self, kept: Kept) {
        self.entries
            .retain(|known| known.entry.name != kept.entry.name);
        self.entries.push(kept);
        self.sort();
    }

    /// Entries that are in memory alone.
    pub fn unsaved(&self) -> impl Iterator<Item = &Kept> {
        self.entries.iter().filter(|kept| kept.unsaved.is_some())
    }

    fn sort(&mut self) {
        self.entries
            .sort_by(|a, b| (&b.entry.time, &b.entry.name).cmp(&(&a.entry.time, &a.entry.name)));
    }
}

impl Workbench {
    fn notebook_folder(&self) -> Result<PathBuf, String> {
        let project = self.files.project();
        project
            .map(|project| project.join(NOTEBOOK))
            .ok_or_else(|| say!("notebook.the_notebook_lies_in_a_project").to_owned())
    }

    /// Reads the notebook, unless it is known.
    pub fn open_notebook(&mut self) {
        if std::mem::replace(&mut self.notebook.is_read, true) {
            return;
        }
        if let Ok(folder) = self.notebook_folder() {
            self.in_background(move || {
                let (entries, problems) = disk::read(&folder);
                Done::Read(entries, problems)
            });
        }
    }

    fn in_background(&mut self, work: impl FnOnce() -> Done + Send + 'static) {
        let wake = self.wake.clone();
        let task = Task::start(move |_| {
            let done = work();
            wake();
            done
        });
        match task {
            Ok(task) => self.notebook.tasks.push(task),
            Err(error) => {
                let text = say!("notebook.no_thread_for_the_notebook", error = error);
                self.notebook.said = Some(Err(text));
            }
        }
    }

    /// Keeps what is on the screen: the picture, the views, and what is known of both sides.
    ///
    /// # Errors
    /// A sentence, where there is nothing to keep.
    pub fn keep(&mut self, note: &str) -> Result<(), String> {
        self.open_notebook();
        if self.notebook.coming.is_some() {
            return Err(say!("notebook.the_entry_before_is_still_being").to_owned());
        }
        let Some(view) = self.viewpoint() else {
            return Err(say!("notebook.there_is_no_picture_yet").to_owned());
        };
        let picture = self.shown_picture();
        let Some(picture) = picture else {
            return Err(say!("notebook.there_is_no_picture_yet").to_owned());
        };
        let now = jiff::Timestamp::now();
        let name = now.strftime("%Y-%m-%dT%H-%M-%SZ").to_string();
        let used = |name: &str| self.notebook.entries.iter().any(|k| k.entry.name == name);
        let name = std::iter::once(name.clone())
            .chain((2..).map(|number| format!("{name}-{number}")))
            .find(|name| !used(name))
            .unwrap_or(name);
        let comparing = &self.comparing;
        let entry = Entry {
            name,
            time: now.strftime("%Y-%m-%dT%H:%M:%SZ").to_string(),
            note: note.to_owned(),
            view: view.to_string(),
            view_b: self.other_viewpoint().map(|view| view.to_string()),
            shown: if comparing.is_on() {
                comparing.mode.title().to_owned()
            } else {
                "A".to_owned()
            },
            costs: self.costs().into_iter().flatten().collect(),
            difference: self
                .judgement()
                .filter(|judgement| judgement.frames_ago == 0)
                .map(|judgement| Difference::of(&judgement.judged.difference)),
            machine: None,
            adapter: Adapter::from(&self.gpu().summary),
        };
        let reading = Reading::begin(self.gpu(), &picture, Slice::default());
        self.notebook.coming = Some(Coming {
            reading: reading.map_err(|error| error.to_string())?,
            size: (picture.width(), picture.height()),
            entry,
        });
        Ok(())
    }

    /// Goes on with what comes to the notebook.
    pub(super) fn take_notes(&mut self) {
        let is_over = |coming: &mut Coming| coming.reading.is_over();
        if let Some(coming) = self.notebook.coming.take_if(is_over) {
            self.make_entry(coming);
        }
        let mut index = 0;
        while index < self.notebook.tasks.len() {
            match self.notebook.tasks[index].poll() {
                Ok(None) => {
                    index += 1;
                    continue;
                }
                Ok(Some(Done::Read(entries, problems))) => {
                    for problem in problems {
                        self.log.warn(problem);
                    }
                    for kept in entries {
                        self.notebook.add(kept);
                    }
                }
                Ok(Some(Done::Wrote(kept, is_new))) => self.wrote(*kept, is_new),
                Err(lost) => self.notebook.said = Some(Err(lost.to_string())),
            }
            self.notebook.tasks.remove(index);
        }
    }

    fn make_entry(&mut self, coming: Coming) {
        let Coming {
            reading,
            size,
            mut entry,
        } = coming;
        let folder = self.notebook_folder();
        let bytes = match reading.bytes() {
            Ok(bytes) => bytes,
            Err(error) => {
                self.notebook.said = Some(Err(say!(
                    "notebook.the_picture_was_not_kept",
                    error = error
                )));
                return;
            }
        };
        self.in_background(move || {
            entry.machine = Some(Machine::this());
            let pixels = bytes.as_chunks::<4>().0.to_vec();
            let picture = LdrImage::new(size.0, size.1, pixels);
            let thumbnail = picture.as_ref().ok().map(disk::thumbnail);
            let png = picture.and_then(|picture| picture.to_png());
            let (png, encoded) = match png {
                Ok(png) => (Some(Arc::new(png)), Ok(())),
                Err(error) => (None, Err(error.to_string())),
            };
            let mut kept = Kept {
                entry,
                thumbnail: thumbnail.map(Arc::new),
                png,
                unsaved: None,
            };
            let written = encoded
                .and(folder)
                .and_then(|folder| disk::write(&folder, &kept.entry, kept.png()));
            kept.unsaved = written.err();
            Done::Wrote(Box::new(kept), true)
        });
    }

    fn wrote(&mut self, mut kept: Kept, is_new: bool) {
        self.notebook.said = Some(match &kept.unsaved {
            None => {
                kept.png = None;
                Ok(say!(
                    "notebook.kept_as_json",
                    notebook = NOTEBOOK,
                    name = kept.entry.name
                ))
            }
            Some(why) => Err(say!("notebook.the_entry_is_in_memory_alone", why = why)),
        });
        let name = kept.entry.name.clone();
        self.notebook.add(kept);
        if is_new {
            self.note_entry(&name);
        }
    }

    /// Tries again to write an entry that is in memory alone.
    pub fn save_again(&mut self, name: &str) {
        let folder = self.notebook_folder();
        let found = self.notebook.entries.iter().find(|k| k.entry.name == name);
        let Some(mut kept) = found.cloned() else {
            return;
        };
        self.in_background(move || {
            let written = folder.and_then(|folder| disk::write(&folder, &kept.entry, kept.png()));
            kept.unsaved = written.err();
            Done::Wrote(Box::new(kept), false)
        });
    }

    /// Goes to where an entry was kept: the view of A, and B beside it where there was one.
    ///
    /// # Errors
    /// A sentence, where a view can't be read.
    pub fn restore(&mut self, name: &str) -> Result<(), String> {
        let found = self.notebook.entries.iter().find(|k| k.entry.name == name);
        let Some(entry) = found.map(|kept| kept.entry.clone()) else {
            return Err(say!("notebook.there_is_no_entry_any_more", name = name));
        };
        let read = |text: &str| {
            let view = text.parse::<crate::viewpoint::Viewpoint>();
            view.map_err(|error| {
                say!(
                    "notebook.the_view_of_cant_be_read",
                    name = name,
                    error = error
                )
            })
        };
        let view = read(&entry.view)?;
        let other = entry.view_b.as_deref().map(read).transpose()?;
        let what = say!("history.entry", name = name);
        self.as_place("view", &what, true, |this| {
            this.go_to(&view)?;
            match other {
                Some(other) => this.set_other(&other.pipeline, other.pipeline_settings),
                None => this.compare(false),
            }
            Ok(())
        })
    }

    /// Writes all entries as a page of Markdown beside their pictures. Gives its path.
    ///
    /// # Errors
    /// A sentence, where it can't be written.
    pub fn export_notebook(&mut self) -> Result<PathBuf, String> {
        let folder = self.notebook_folder()?;
        let saved = self
            .notebook
            .entries
            .iter()
            .filter(|kept| kept.unsaved.is_none());
        let text = markdown::page(saved.map(|kept| &kept.entry));
        let path: &Path = &folder.join(EXPORT);
        disk::write_file(path, text.as_bytes())?;
        Ok(path.to_owned())
    }
}
