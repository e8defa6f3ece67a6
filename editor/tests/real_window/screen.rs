//! A virtual display (Xvfb) with a pointer and keys that come from the server, as those of a person do
//! (XTEST extension).

// The benchmark of the start uses a part of it.
#![allow(dead_code)]

use std::collections::HashSet;
use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use x11rb::connection::Connection as _;
use x11rb::protocol::xproto::{
    BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, ConnectionExt as _, ImageFormat, InputFocus,
    KEY_PRESS_EVENT, KEY_RELEASE_EVENT, MOTION_NOTIFY_EVENT, Window,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

/// A key of the keyboard.
#[derive(Clone, Copy)]
pub enum Key {
    /// A letter or a digit, as it is written on the key, in small letters.
    Letter(char),
    Return,
    Tab,
    Space,
    Escape,
    Control,
    Shift,
}

impl Key {
    /// Its number in the X protocol, appendix A (KEYSYM encoding).
    fn symbol(self) -> u32 {
        match self {
            Self::Letter(letter) => u32::from(letter),
            Self::Return => 0xff0d,
            Self::Tab => 0xff09,
            Self::Space => 0x20,
            Self::Escape => 0xff1b,
            Self::Control => 0xffe3,
            Self::Shift => 0xffe1,
        }
    }
}

/// Where a colour is on the screen: the middle of its pixels, and how many there are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blot {
    pub x: f32,
    pub y: f32,
    pub count: usize,
}

/// The display. It ends with the test.
pub struct Screen {
    server: Child,
    connection: RustConnection,
    name: String,
    size: (u16, u16),
}

impl Screen {
    /// Starts a display of that many pixels.
    pub fn open(width: u16, height: u16) -> Self {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-nolisten", "tcp", "-screen", "0"])
            .arg(format!("{width}x{height}x24"))
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("this test needs Xvfb: `./x setup` installs it");
        let mut number = String::new();
        let out = server.stdout.take().unwrap();
        BufReader::new(out).read_line(&mut number).unwrap();
        let name = format!(":{}", number.trim());
        let (connection, _) = x11rb::connect(Some(&name)).unwrap();
        Self {
            server,
            connection,
            name,
            size: (width, height),
        }
    }

    /// Its name, for `DISPLAY`.
    pub fn name(&self) -> &str {
        &self.name
    }

    fn root(&self) -> Window {
        self.connection.setup().roots[0].root
    }

    /// Gives the keys to the window of that title, as a window manager would.
    pub fn focus(&self, title: &str) {
        let tree = self.connection.query_tree(self.root()).unwrap();
        let windows = tree.reply().unwrap().children;
        let named = windows.into_iter().find(|window| {
            let name = x11rb::protocol::xproto::AtomEnum::WM_NAME;
            let property = self.connection.get_property(
                false,
                *window,
                name,
                x11rb::protocol::xproto::AtomEnum::ANY,
                0,
                64,
            );
            property.unwrap().reply().unwrap().value == title.as_bytes()
        });
        let window = named.expect("no window of that title");
        self.connection
            .set_input_focus(InputFocus::PARENT, window, 0_u32)
            .unwrap();
        self.connection.flush().unwrap();
        std::thread::sleep(Duration::from_millis(200));
    }

    fn fake(&self, kind: u8, detail: u8, (x, y): (i16, i16)) {
        self.connection
            .xtest_fake_input(kind, detail, 0, self.root(), x, y, 0)
            .unwrap();
        self.connection.flush().unwrap();
        // A person is no faster, and a frame takes the events of several times as one.
        std::thread::sleep(Duration::from_millis(30));
    }

    /// Moves the pointer.
    pub fn point(&self, x: f32, y: f32) {
        self.fake(MOTION_NOTIFY_EVENT, 0, (x.round() as i16, y.round() as i16));
    }

    /// Clicks with the left button.
    pub fn click(&self, x: f32, y: f32) {
        self.point(x, y);
        self.fake(BUTTON_PRESS_EVENT, 1, (0, 0));
        self.fake(BUTTON_RELEASE_EVENT, 1, (0, 0));
    }

    /// Drags with the left button.
    pub fn drag(&self, from: (f32, f32), to: (f32, f32)) {
        // A person sees what the pointer is over before pressing, and where it has come to before letting go.
        let look = || std::thread::sleep(Duration::from_millis(300));
        self.point(from.0, from.1);
        look();
        self.fake(BUTTON_PRESS_EVENT, 1, (0, 0));
        look();
        for step in 1..=10 {
            let share = step as f32 / 10.0;
            self.point(
                from.0 + (to.0 - from.0) * share,
                from.1 + (to.1 - from.1) * share,
            );
        }
        look();
        self.fake(BUTTON_RELEASE_EVENT, 1, (0, 0));
        look();
    }

    /// The code by which this display's keyboard knows a key.
    fn code(&self, key: Key) -> u8 {
        let setup = self.connection.setup();
        let (first, last) = (setup.min_keycode, setup.max_keycode);
        let mapping = self
            .connection
            .get_keyboard_mapping(first, last - first + 1)
            .unwrap()
            .reply()
            .unwrap();
        let each = usize::from(mapping.keysyms_per_keycode);
        let place = mapping
            .keysyms
            .chunks(each)
            .position(|symbols| symbols[0] == key.symbol());
        first + u8::try_from(place.expect("the keyboard has no such key")).unwrap()
    }

    /// Presses a key while others are held.
    pub fn key(&self, key: Key, held: &[Key]) {
        let codes: Vec<u8> = held.iter().map(|key| self.code(*key)).collect();
        for code in &codes {
            self.fake(KEY_PRESS_EVENT, *code, (0, 0));
        }
        let code = self.code(key);
        self.fake(KEY_PRESS_EVENT, code, (0, 0));
        self.fake(KEY_RELEASE_EVENT, code, (0, 0));
        for code in codes.iter().rev() {
            self.fake(KEY_RELEASE_EVENT, *code, (0, 0));
        }
    }

    /// Types small letters and digits.
    pub fn type_text(&self, text: &str) {
        for letter in text.chars() {
            self.key(Key::Letter(letter), &[]);
        }
    }

    /// The pixels of a rectangle, row by row: blue, green, red and one byte that means nothing.
    fn read(&self, (x, y): (i16, i16), (width, height): (u16, u16)) -> Vec<u8> {
        let format = ImageFormat::Z_PIXMAP;
        let image = self
            .connection
            .get_image(format, self.root(), x, y, width, height, !0);
        image.unwrap().reply().unwrap().data
    }

    /// All pixels, as [`Self::read`] gives them.
    pub fn pixels(&self) -> Vec<u8> {
        self.read((0, 0), self.size)
    }

    /// How many different colours there are in a rectangle.
    pub fn colors(&self, from: (i16, i16), size: (u16, u16)) -> usize {
        let pixels = self.read(from, size);
        let colors = pixels.chunks_exact(4).map(|p| [p[0], p[1], p[2]]);
        colors.collect::<HashSet<_>>().len()
    }

    /// Where a colour is, if it is anywhere.
    pub fn blot(&self, color: [u8; 3]) -> Option<Blot> {
        self.blot_beyond(0, color)
    }

    /// The same where so many pixels at the left do not count.
    pub fn blot_beyond(&self, left: usize, color: [u8; 3]) -> Option<Blot> {
        let width = usize::from(self.size.0);
        let (mut x, mut y, mut count) = (0_u64, 0_u64, 0_usize);
        for (at, pixel) in self.pixels().chunks_exact(4).enumerate() {
            if at % width >= left && [pixel[2], pixel[1], pixel[0]] == color {
                x += (at % width) as u64;
                y += (at / width) as u64;
                count += 1;
            }
        }
        (count > 0).then(|| Blot {
            x: x as f32 / count as f32,
            y: y as f32 / count as f32,
            count,
        })
    }

    /// Writes what is on the screen as a picture.
    pub fn save(&self, file: &Path) {
        let (width, height) = self.size;
        let bytes = self.pixels();
        let colors = bytes.chunks_exact(4).flat_map(|p| [p[2], p[1], p[0]]);
        image::RgbImage::from_raw(width.into(), height.into(), colors.collect())
            .unwrap()
            .save(file)
            .unwrap();
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
