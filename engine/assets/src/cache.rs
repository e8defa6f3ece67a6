//! What was made before, by what it was made of.
//!
//! A scene that is loaded again asks for nearly everything that the load before it has made. A
//! [`Cache`] keeps those things between loads, and [`Reuse`] is how one load takes them out and puts
//! new ones in:
//!
//! ```
//! use lightbench_assets::cache::Cache;
//! use lightbench_assets::{Mesh, Shared, procedural};
//!
//! let cache = Cache::default();
//! let load = || {
//!     let reuse = cache.begin();
//!     let ball = reuse.get("ball", &1.5, || Shared::shared(procedural::icosphere(1.5, 3)));
//!     reuse.finish();
//!     ball
//! };
//! let (first, again): (Shared<Mesh>, Shared<Mesh>) = (load(), load());
//! assert_eq!(first.revision, again.revision);
//! assert_eq!(cache.statistics().made["ball"], 1);
//! ```
//!
//! A [`Key`] must name everything that a thing depends on: all parameters, and for files the
//! [`Digest`] of their bytes. A file's date says nothing: copies keep it, and two saves in one tick
//! of the clock share it. Then a thing that is taken out is bit for bit the one that would be made.

use std::any::Any;
use std::collections::{BTreeMap, HashMap};
use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::{Digest, Mesh, Shared, Texture};

/// After so many loads in which nobody asked for it, a thing is dropped.
const UNUSED_LOADS: u64 = 3;

/// The most bytes that all things may take unless told. Those of the scene on screen are shared with
/// it, and take no memory of their own.
const USUAL_LIMIT: usize = 1 << 30;

/// What the bookkeeping of one thing takes, roughly.
const BYTES_OF_AN_ITEM: usize = 256;

/// Something that a cache can keep. Every use gets a clone, so it should be cheap to clone, as an
/// [`Arc`] is.
pub trait Kept: Clone + Send + Sync + 'static {
    /// The bytes of memory that it holds, roughly.
    fn bytes(&self) -> usize;
}

impl Kept for Shared<Mesh> {
    fn bytes(&self) -> usize {
        self.byte_count()
    }
}

impl Kept for Shared<Texture> {
    fn bytes(&self) -> usize {
        self.byte_count()
    }
}

/// What a thing was made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Key {
    kind: &'static str,
    of: Digest,
}

impl Key {
    /// The key of a thing of some kind, with everything that it depends on. Values of one kind have
    /// one type.
    #[must_use]
    pub fn new(kind: &'static str, of: &(impl fmt::Debug + ?Sized)) -> Self {
        Self {
            kind,
            of: Digest::of_value(of),
        }
    }
}

/// What a cache holds and has done, for tests and for the curious.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CacheStatistics {
    /// How many things of each kind had to be made.
    pub made: BTreeMap<&'static str, u64>,
    /// How many things of each kind were there.
    pub found: BTreeMap<&'static str, u64>,
    /// Things in the cache.
    pub items: usize,
    /// The bytes that they hold, roughly.
    pub bytes: usize,
}

struct Item {
    value: Box<dyn Any + Send + Sync>,
    bytes: usize,
    /// The latest load that used it.
    used: u64,
}

struct Shelf {
    items: HashMap<Key, Item>,
    /// How many things each load was the latest to use.
    latest: BTreeMap<u64, usize>,
    limit: usize,
    /// The latest load that was finished, counted from 1.
    finished: u64,
    statistics: CacheStatistics,
}

impl Shelf {
    /// Notes that a load uses a thing.
    fn touch(&mut self, key: &Key, load: u64) -> Option<&Item> {
        let item = self.items.get_mut(key)?;
        let before = item.used;
        if before < load {
            item.used = load;
            self.count(before, -1);
            self.count(load, 1);
        }
        self.items.get(key)
    }

    fn put(&mut self, key: Key, item: Item) {
        self.take(&key);
        self.count(item.used, 1);
        self.statistics.bytes += item.bytes;
        self.items.insert(key, item);
    }

    fn take(&mut self, key: &Key) {
        if let Some(item) = self.items.remove(key) {
            self.count(item.used, -1);
            self.statistics.bytes -= item.bytes;
        }
    }

    fn count(&mut self, load: u64, change: isize) {
        let count = self.latest.entry(load).or_default();
        *count = count.saturating_add_signed(change);
        if *count == 0 {
            self.latest.remove(&load);
        }
    }

    /// Drops everything that was last used by one of these loads.
    fn drop_used_by(&mut self, loads: std::ops::RangeInclusive<u64>) {
        if self.latest.range(loads.clone()).next().is_none() {
            return;
        }
        let used = |item: &Item| loads.contains(&item.used);
        let gone: Vec<Key> = self
            .items
            .iter()
            .filter_map(|(key, item)| used(item).then_some(*key))
            .collect();
        gone.iter().for_each(|key| self.take(key));
    }

    /// Drops what the oldest loads have left, until there is room. What this load uses itself stays:
    /// a scene that is too large for the cache finds at least a part of it the next time, always the
    /// same part.
    fn make_room(&mut self, bytes: usize, load: u64) -> bool {
        while self.statistics.bytes.saturating_add(bytes) > self.limit {
            match self.latest.keys().next() {
                Some(&oldest) if oldest < load && bytes <= self.limit => {
                    self.drop_used_by(oldest..=oldest);
                }
                _ => return false,
            }
        }
        true
    }
}

/// Keeps what loads have made for the loads to come. Clones share it.
#[derive(Clone)]
pub struct Cache(Arc<Mutex<Shelf>>);

impl Default for Cache {
    fn default() -> Self {
        Self::with_limit(USUAL_LIMIT)
    }
}

impl fmt::Debug for Cache {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Cache({:?})", self.statistics())
    }
}

impl Cache {
    /// An empty cache that holds so many bytes at most.
    #[must_use]
    pub fn with_limit(bytes: usize) -> Self {
        Self(Arc::new(Mutex::new(Shelf {
            items: HashMap::new(),
            latest: BTreeMap::new(),
            limit: bytes,
            finished: 0,
            statistics: CacheStatistics::default(),
        })))
    }

    /// Begins a load.
    #[must_use]
    pub fn begin(&self) -> Reuse {
        Reuse {
            cache: self.clone(),
            load: self.lock().finished + 1,
        }
    }

    /// Drops everything.
    pub fn clear(&self) {
        self.lock().drop_used_by(0..=u64::MAX);
    }

    /// What it holds and has done.
    #[must_use]
    pub fn statistics(&self) -> CacheStatistics {
        let shelf = self.lock();
        CacheStatistics {
            items: shelf.items.len(),
            ..shelf.statistics.clone()
        }
    }

    fn lock(&self) -> MutexGuard<'_, Shelf> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// One load's use of a cache. Clones are the same load; the default one has a cache of its own.
#[derive(Clone, Debug)]
pub struct Reuse {
    cache: Cache,
    load: u64,
}

impl Default for Reuse {
    fn default() -> Self {
        Cache::default().begin()
    }
}

impl Reuse {
    /// The thing that was made before of the same, or else a new one.
    pub fn get<T: Kept>(
        &self,
        kind: &'static str,
        of: &(impl fmt::Debug + ?Sized),
        make: impl FnOnce() -> T,
    ) -> T {
        let key = Key::new(kind, of);
        self.find(&key).unwrap_or_else(|| self.keep(key, make()))
    }

    /// As [`Reuse::get`] for what can fail. A failure is not kept.
    ///
    /// # Errors
    /// Those of `make`.
    pub fn try_get<T: Kept, E>(
        &self,
        kind: &'static str,
        of: &(impl fmt::Debug + ?Sized),
        make: impl FnOnce() -> Result<T, E>,
    ) -> Result<T, E> {
        let key = Key::new(kind, of);
        match self.find(&key) {
            Some(found) => Ok(found),
            None => make().map(|made| self.keep(key, made)),
        }
    }

    /// The thing that was made before of the same.
    #[must_use]
    pub fn find<T: Kept>(&self, key: &Key) -> Option<T> {
        let mut shelf = self.cache.lock();
        let item = shelf.touch(key, self.load)?;
        let value = item.value.downcast_ref::<T>()?.clone();
        *shelf.statistics.found.entry(key.kind).or_default() += 1;
        Some(value)
    }

    /// Keeps a new thing, if there is room. Where another thread was faster, gives the other's, so
    /// that both go on with the same.
    pub fn keep<T: Kept>(&self, key: Key, value: T) -> T {
        let mut shelf = self.cache.lock();
        *shelf.statistics.made.entry(key.kind).or_default() += 1;
        let there = shelf.touch(&key, self.load);
        if let Some(there) = there.and_then(|item| item.value.downcast_ref::<T>()) {
            return there.clone();
        }
        let bytes = value.bytes().saturating_add(BYTES_OF_AN_ITEM);
        if shelf.make_room(bytes, self.load) {
            let item = Item {
                value: Box::new(value.clone()),
                bytes,
                used: self.load,
            };
            shelf.put(key, item);
        }
        value
    }

    /// Ends a load that went well: what several loads have not used is dropped. A load that fails
    /// is not ended so, because it may not have come to what it wanted to use.
    pub fn finish(&self) {
        let mut shelf = self.cache.lock();
        shelf.finished = shelf.finished.max(self.load);
        if let Some(oldest) = self.load.checked_sub(UNUSED_LOADS) {
            shelf.drop_used_by(0..=oldest);
        }
    }
}

#[cfg(test)]
mod tests;
