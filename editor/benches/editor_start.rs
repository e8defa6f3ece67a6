//! What a person waits for: the time from the start of the program to the first picture of the scene on
//! the screen, and the processor time that a window takes in which nothing happens. The program runs under
//! a virtual display, which needs Xvfb.
//!
//! ```sh
//! cargo bench -p lightbench-editor --bench editor_start
//! ```
#![allow(clippy::unwrap_used)]

#[cfg(target_os = "linux")]
#[path = "../tests/real_window/screen.rs"]
mod screen;

#[cfg(not(target_os = "linux"))]
fn main() {
    println!("this benchmark needs Linux, for the virtual display and /proc");
}

#[cfg(target_os = "linux")]
fn main() {
    linux::main();
}

#[cfg(target_os = "linux")]
mod linux {
    use std::fs;
    use std::path::Path;
    use std::process::{Child, Command, Stdio};
    use std::time::{Duration, Instant};

    use super::screen::{Key, Screen};

    /// How often the program is started, after a first time that fills the caches.
    const STARTS: usize = 5;

    /// How long nothing happens.
    const IDLE: Duration = Duration::from_secs(10);

    /// What is asked of the software driver on two cores: seconds, and a share of one core.
    const BARS: (f64, f64) = (3.0, 0.02);

    /// The middle of the viewport of a first start, in pixels of the screen, and how many different
    /// colours make it a picture: before the first one there are words on a ground of one colour.
    const PLACE: ((i16, i16), (u16, u16)) = ((350, 350), (200, 100));
    const COLORS: usize = 500;

    /// The program, which is ended at the latest with this.
    struct Program(Child);

    impl Program {
        fn start(screen: &Screen, root: &Path) -> Self {
            let child = Command::new(env!("CARGO_BIN_EXE_lightbench"))
                .args(["edit", "atrium"])
                .current_dir(root)
                .env("DISPLAY", screen.name())
                .env("XDG_CONFIG_HOME", root.join("settings"))
                .env("XDG_CACHE_HOME", root.join("caches"))
                .env_remove("WAYLAND_DISPLAY")
                .env_remove("DBUS_SESSION_BUS_ADDRESS")
                .env_remove("XDG_RUNTIME_DIR")
                .spawn();
            Self(child.unwrap())
        }

        /// Processor time of all its threads (proc(5): the first number of schedstat, nanoseconds).
        fn used(&self) -> Duration {
            let threads = fs::read_dir(format!("/proc/{}/task", self.0.id())).unwrap();
            // A thread may end meanwhile.
            let texts = threads
                .flatten()
                .filter_map(|thread| fs::read_to_string(thread.path().join("schedstat")).ok());
            let times = texts.map(|text| text.split(' ').next().unwrap().parse::<u64>().unwrap());
            Duration::from_nanos(times.sum())
        }
    }

    /// Processor time of all threads of a program, also of those that have ended (proc(5): the 14th and
    /// 15th number of stat, hundredths of a second).
    fn used_in_all(program: &Program) -> f64 {
        let text = fs::read_to_string(format!("/proc/{}/stat", program.0.id())).unwrap();
        // The second field may have spaces, and ends with the last parenthesis.
        let (_, rest) = text.rsplit_once(')').unwrap();
        let ticks = rest.split_whitespace().skip(11).take(2);
        ticks
            .map(|ticks| ticks.parse::<f64>().unwrap())
            .sum::<f64>()
            / 100.0
    }

    impl Drop for Program {
        fn drop(&mut self) {
            let _ = self.0.kill();
            let _ = self.0.wait();
        }
    }

    /// Starts the program, and gives the time to the first picture in seconds, with the processor time that
    /// went into it: the first is longer where the machine has other things to do.
    fn start(screen: &Screen, root: &Path) -> (Program, f64, f64) {
        let began = Instant::now();
        let program = Program::start(screen, root);
        while screen.colors(PLACE.0, PLACE.1) < COLORS {
            let waited = began.elapsed();
            assert!(waited < Duration::from_secs(60), "no picture came");
            std::thread::sleep(Duration::from_millis(10));
        }
        let time = began.elapsed().as_secs_f64();
        let used = used_in_all(&program);
        (program, time, used)
    }

    fn verdict(is_met: bool) -> &'static str {
        if is_met { "met" } else { "missed" }
    }

    /// Whether there is a virtual display. Other benchmarks are to run without one.
    fn has_display() -> bool {
        let mut server = Command::new("Xvfb");
        server.arg("-help").stdout(Stdio::null());
        server.stderr(Stdio::null()).status().is_ok()
    }

    pub fn main() {
        if !has_display() {
            println!("this benchmark needs Xvfb: `./x setup` installs it");
            return;
        }
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        let settings = root.join("settings/lightbench/editor.json");
        fs::create_dir_all(settings.parent().unwrap()).unwrap();
        // Not the first start, whose welcome lies over the picture.
        fs::write(settings, "{}").unwrap();
        let screen = Screen::open(1440, 900);

        let (first, time, used) = start(&screen, root);
        // It goes on to fill its caches behind the picture.
        std::thread::sleep(Duration::from_secs(5));
        drop(first);
        println!("start to first picture, empty caches: {time:.2} s, processor time {used:.2} s");
        let starts = (0..STARTS).map(|_| {
            let (_, time, used) = start(&screen, root);
            (time, used)
        });
        let (mut times, mut used): (Vec<f64>, Vec<f64>) = starts.unzip();
        times.sort_unstable_by(f64::total_cmp);
        used.sort_unstable_by(f64::total_cmp);
        let median = times[STARTS / 2];
        println!(
            "start to first picture: {median:.2} s, median of {STARTS}, {:.2} to {:.2}; bar {} s: {}; \
             processor time {:.2} s",
            times[0],
            times[STARTS - 1],
            BARS.0,
            verdict(median <= BARS.0),
            used[STARTS / 2]
        );

        let (program, ..) = start(&screen, root);
        std::thread::sleep(Duration::from_secs(2));
        screen.focus("Lightbench");
        screen.point(450.0, 400.0);
        // Stop time, and let the picture become as fine as it gets.
        screen.key(Key::Space, &[]);
        std::thread::sleep(Duration::from_secs(10));
        let (before, picture) = (program.used(), screen.pixels());
        std::thread::sleep(IDLE);
        let share = (program.used() - before).as_secs_f64() / IDLE.as_secs_f64();
        assert!(
            picture == screen.pixels(),
            "the window changes while nothing happens"
        );
        println!(
            "processor time while nothing happens: {:.2} % of a core; bar {} %: {}",
            share * 100.0,
            BARS.1 * 100.0,
            verdict(share <= BARS.1)
        );
    }
}
