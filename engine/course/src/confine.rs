//! What a process gives up before it reads what a stranger wrote.
//!
//! Scripts and shaders can't name files outside of their project, nor reach the network, by the way in
//! which the engine runs them. This is the second wall, for the day when the first one has a hole: the
//! process asks the kernel to take these rights away from it, and nothing gives them back.
//!
//! On Linux: resource limits (`setrlimit`), namespaces of users and of networks (`unshare`), and
//! Landlock for files. Elsewhere [`Confinement::enforce`] says what it can't enforce.

use std::path::PathBuf;

/// What a process may still do.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Confinement {
    /// Files and folders that it may read, besides those of the system.
    pub read: Vec<PathBuf>,
    /// Folders that it may write into.
    pub write: Vec<PathBuf>,
    /// Bytes of address space; much more than the memory that it uses. `None` leaves it unlimited.
    pub address_space: Option<u64>,
    /// Seconds of the processor, over all threads.
    pub processor_seconds: u64,
    /// Bytes of a file that it writes.
    pub file_bytes: u64,
}

/// What the kernel enforces from now on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Enforced {
    /// In words.
    pub enforced: Vec<&'static str>,
    /// What it does not, and why.
    pub not_enforced: Vec<String>,
}

impl Enforced {
    #[cfg(unix)]
    fn note<E: std::fmt::Display>(&mut self, what: &'static str, done: Result<(), E>) {
        match done {
            Ok(()) => self.enforced.push(what),
            Err(error) => self.not_enforced.push(format!("{what}: {error}")),
        }
    }
}

/// Folders of the system that a driver and its libraries are read from.
#[cfg(target_os = "linux")]
const SYSTEM: [&str; 10] = [
    "/usr", "/lib", "/lib64", "/bin", "/etc", "/opt", "/proc", "/sys", "/run", "/var/lib",
];
/// Devices and shared memory that drivers write to.
#[cfg(target_os = "linux")]
const DEVICES: [&str; 1] = ["/dev"];

impl Confinement {
    /// Gives up the rights. To be called first of all, while the process has one thread: threads that
    /// were there before would keep some of theirs.
    pub fn enforce(&self) -> Enforced {
        let mut enforced = Enforced::default();
        #[cfg(unix)]
        self.limit_resources(&mut enforced);
        #[cfg(target_os = "linux")]
        {
            enforced.note("ends with the process that started it", die_with_parent());
            enforced.note("no network", leave_network());
            enforced.note("no files outside of its folders", self.restrict_files());
        }
        #[cfg(not(target_os = "linux"))]
        for what in ["no network", "no files outside of its folders"] {
            enforced
                .not_enforced
                .push(format!("{what}: only Linux can be asked for it"));
        }
        #[cfg(not(unix))]
        enforced
            .not_enforced
            .push("limits of the processor and of files: only Unix has them".to_owned());
        enforced
    }

    #[cfg(unix)]
    fn limit_resources(&self, enforced: &mut Enforced) {
        use nix::sys::resource::{Resource, setrlimit};
        let limit = |resource, value: u64| setrlimit(resource, value, value);
        // A crash shall leave no image of the memory behind.
        enforced.note("no core files", limit(Resource::RLIMIT_CORE, 0));
        enforced.note(
            "limited processor time",
            limit(Resource::RLIMIT_CPU, self.processor_seconds),
        );
        enforced.note(
            "limited size of files",
            limit(Resource::RLIMIT_FSIZE, self.file_bytes),
        );
        if let Some(bytes) = self.address_space {
            enforced.note("limited address space", limit(Resource::RLIMIT_AS, bytes));
        }
    }

    #[cfg(target_os = "linux")]
    fn restrict_files(&self) -> Result<(), String> {
        use landlock::{
            ABI, Access, AccessFs, CompatLevel, Compatible, Ruleset, RulesetAttr,
            RulesetCreatedAttr, RulesetStatus, Scope, path_beneath_rules,
        };
        // The newest whose rights this list was written for; what an older kernel lacks is left out.
        const KNOWN: ABI = ABI::V6;
        let all = AccessFs::from_all(KNOWN);
        let reading = AccessFs::from_read(KNOWN);
        let system = SYSTEM.iter().map(PathBuf::from);
        let existing = |path: &PathBuf| path.exists();
        let read: Vec<PathBuf> = system
            .chain(self.read.iter().cloned())
            .filter(existing)
            .collect();
        let devices = DEVICES.iter().map(PathBuf::from).filter(existing);
        let write: Vec<PathBuf> = devices.chain(self.write.iter().cloned()).collect();
        let status = Ruleset::default()
            .set_compatibility(CompatLevel::BestEffort)
            .handle_access(all)
            .and_then(|rules| rules.scope(Scope::from_all(KNOWN)))
            .and_then(Ruleset::create)
            .and_then(|rules| rules.add_rules(path_beneath_rules(read, reading)))
            .and_then(|rules| rules.add_rules(path_beneath_rules(write, all)))
            .and_then(|rules| rules.restrict_self())
            .map_err(|error| error.to_string())?;
        match status.ruleset {
            RulesetStatus::NotEnforced => Err("this kernel has no Landlock".to_owned()),
            _ => Ok(()),
        }
    }
}

#[cfg(target_os = "linux")]
fn die_with_parent() -> nix::Result<()> {
    nix::sys::prctl::set_pdeathsig(nix::sys::signal::Signal::SIGKILL)
}

/// A namespace of its own has no network but a loopback that is down. Making one needs a namespace of
/// users, which any user may make where the system allows it.
#[cfg(target_os = "linux")]
fn leave_network() -> nix::Result<()> {
    use nix::sched::{CloneFlags, unshare};
    unshare(CloneFlags::CLONE_NEWUSER | CloneFlags::CLONE_NEWNET)
}
