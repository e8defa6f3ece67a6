//! The program is killed while somebody works in its window, and started again.
//!
//! `LIGHTBENCH_SOAK` kills it as often as `./x soak` does, and `LIGHTBENCH_SEED` chooses the moments.

use std::collections::BTreeSet;
use std::hash::{BuildHasher as _, RandomState};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use super::program::{
    PATIENCE, Program, alone, choose, give_up, save_as, see, write, write_project,
};
use super::screen::{Key, Screen};

/// How often the program is killed, in a usual run and in a long one.
const KILLED: (u64, u64) = (1, 20);

/// What a kill may take at most.
const MOST: Duration = Duration::from_secs(10);

/// When it comes: after so long that work of more than `MOST` could be lost, and at any moment of what the
/// program does every few seconds to keep it.
const FIRST_MOMENT: Duration = Duration::from_secs(11);
const LAST_MOMENT: Duration = Duration::from_secs(17);

/// Of the changes each of this number is a drag of the handles to the right; the others are copies.
const DRAGGED: usize = 4;

/// How far each drag goes, pixels: less than a ball is wide, and further than its handles reach.
const STEP: f32 = 30.0;

/// After how long a person who sees nothing happen tries again.
const AGAIN: Duration = Duration::from_secs(4);

/// A pipeline that adds up the balls that lie over each other, so that each copy is seen.
const ADDING: &str = r#"// Counts the layers of things.
let p = pipeline("Adding");
p.target("output", "rgba8unorm");
p.geometry("draw").shader("shaders/adding.wgsl")
    .writes("output").clear(0, 0, 0, 1).blend("add");
p.show("output");
p
"#;

const SHADER: &str = "@fragment
fn fragment_main() -> @location(0) vec4f {
    return vec4f(1.0, 0.0, 10.0 / 255.0, 1.0);
}
";

/// The colour of so many balls over each other.
fn layers(count: usize) -> [u8; 3] {
    [255, 0, u8::try_from(10 * count).unwrap()]
}

/// One ball behind a question, where all is darker.
const BEHIND: [u8; 3] = [155, 0, 6];

fn seed() -> u64 {
    let seed = match std::env::var("LIGHTBENCH_SEED") {
        Ok(seed) => seed.parse().unwrap(),
        // Small enough to be typed.
        Err(_) => RandomState::new().hash_one(0) >> 24,
    };
    println!("LIGHTBENCH_SEED={seed}");
    seed
}

/// When the program is killed: all moments are alike likely (splitmix64, Steele and others 2014).
fn moment(seed: u64) -> Duration {
    let mut bits = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^= bits >> 31;
    let share = (bits >> 11) as f64 / (1_u64 << 53) as f64;
    FIRST_MOMENT + (LAST_MOMENT - FIRST_MOMENT).mul_f64(share)
}

/// How many changes are in a saved scene, where it is what somebody had at one moment.
fn changes(text: &str) -> usize {
    let of_balls = |entity: &&str| entity.contains("MeshRenderer");
    let balls: Vec<&str> = text.split("\n\n").filter(of_balls).collect();
    let places = balls.iter().map(|ball| {
        let place = ball.split_once("translation = (").unwrap().1;
        let x: f32 = place.split(',').next().unwrap().parse().unwrap();
        (x * 1000.0).round() as i32
    });
    let places: BTreeSet<i32> = places.collect();
    let (copies, drags) = (balls.len() - 1, places.len() - 1);
    let changes = copies + drags;
    assert_eq!(
        drags,
        changes / DRAGGED,
        "{copies} copies and {drags} drags were never there together:\n{text}"
    );
    changes
}

/// What came of a change that was asked for.
enum Fate {
    Seen,
    /// It is not there after a while. Where a frame takes longer than a drag does, that is none.
    Missed,
    Killed,
}

/// Waits until a colour is seen, beyond so many pixels from the left.
fn look_for(screen: &Screen, is_killed: &AtomicBool, color: [u8; 3], left: f32) -> Fate {
    let began = Instant::now();
    while began.elapsed() < AGAIN {
        if is_killed.load(Ordering::Acquire) {
            return Fate::Killed;
        }
        let blot = screen.blot_beyond(left.round() as usize, color);
        if blot.is_some_and(|blot| blot.count > 500) {
            return Fate::Seen;
        }
        thread::sleep(Duration::from_millis(30));
    }
    Fate::Missed
}

/// Copies the ball at `x` and drags the copy, again and again, until the program is killed. Each change
/// waits for the one before, as a person does who looks at the screen. Gives when each was asked for: it was
/// made no earlier.
fn work(screen: &Screen, is_killed: &AtomicBool, (mut x, y): (f32, f32)) -> Vec<Instant> {
    let mut asked = Vec::new();
    // How many balls lie where the last one is. Right of their middle a part of them is beside all others.
    let mut here = 1;
    loop {
        let drags = (asked.len() + 1).is_multiple_of(DRAGGED);
        let (to, there) = if drags { (x + STEP, 1) } else { (x, here + 1) };
        let began = Instant::now();
        if drags {
            screen.drag((x, y), (to, y));
            // While a handle is held, keys are for its amount.
            thread::sleep(Duration::from_millis(300));
        } else {
            screen.key(Key::Letter('d'), &[Key::Control]);
        }
        match look_for(screen, is_killed, layers(there), to) {
            Fate::Seen => {
                asked.push(began);
                (x, here) = (to, there);
            }
            Fate::Missed => {}
            Fate::Killed => {
                asked.push(began);
                return asked;
            }
        }
    }
}

/// Kills the program while somebody works, and gives the age of the oldest change that is missing then.
fn work_until_killed(wait: Duration) -> Duration {
    let screen = Screen::open(1440, 900);
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    write_project(root);
    let project = root.join("project");
    write(&project, "shaders/adding.wgsl", SHADER);
    write(&project, "scripts/pipelines/a_first.rhai", ADDING);
    let mut program = Program::start(&screen, root, "ball");
    let first = see(&screen, "the ball", layers(1), |_| true);
    screen.focus("Lightbench");
    screen.key(Key::Letter('m'), &[]);
    choose(&screen, &first, layers(1));

    let is_killed = AtomicBool::new(false);
    let (mut asked, killed) = thread::scope(|scope| {
        let killer = scope.spawn(|| {
            thread::sleep(wait);
            program.kill();
            let now = Instant::now();
            is_killed.store(true, Ordering::Release);
            now
        });
        let asked = work(&screen, &is_killed, (first.x, first.y));
        (asked, killer.join().unwrap())
    });
    asked.retain(|asked| *asked < killed);

    let program = Program::start(&screen, root, "ball");
    see(&screen, "the question", BEHIND, |_| true);
    screen.focus("Lightbench");
    // The first answer is to restore.
    screen.key(Key::Tab, &[]);
    screen.key(Key::Return, &[]);
    let began = Instant::now();
    while screen.blot(BEHIND).is_some() {
        if began.elapsed() > PATIENCE {
            give_up(&screen, "the answer");
        }
        thread::sleep(Duration::from_millis(30));
    }
    // What is on its way comes before keys do.
    thread::sleep(Duration::from_secs(1));
    let made = changes(&save_as(&screen, root, "restored"));
    screen.key(Key::Letter('q'), &[Key::Control]);
    program.ended();

    let lost = asked.get(made).map_or(Duration::ZERO, |at| killed - *at);
    println!(
        "killed after {:.2} s: {made} of {} changes are there, the last {:.2} s are lost",
        wait.as_secs_f64(),
        asked.len(),
        lost.as_secs_f64()
    );
    assert!(made <= asked.len());
    lost
}

#[test]
fn work_in_the_window_is_lost_for_ten_seconds_at_most_when_the_program_is_killed() {
    let _alone = alone();
    let count = match std::env::var("LIGHTBENCH_SOAK") {
        Ok(_) => KILLED.1,
        Err(_) => KILLED.0,
    };
    let first = seed();
    for seed in first..first + count {
        let lost = work_until_killed(moment(seed));
        assert!(lost < MOST, "LIGHTBENCH_SEED={seed}: {lost:?} are lost");
    }
}
