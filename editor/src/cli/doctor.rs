//! `lightbench doctor`: what is here, what is missing, and how to mend it.

use std::env;

use lightbench::assets::files::Files;
use lightbench::lab::LdrImage;
use lightbench::lab::report::Machine;
use lightbench::render::gpu::{AdapterSummary, adapters};
use lightbench::render::{Gpu, GpuError, GpuOptions};

use super::report::{Said, say};

/// Runs the command.
///
/// # Errors
/// When nothing here can draw.
pub fn run(files: &Files) -> anyhow::Result<()> {
    let machine = Machine::this();
    say(format!(
        "program   lightbench {}",
        env!("CARGO_PKG_VERSION")
    ))?;
    let memory = machine.memory_bytes as f64 / f64::from(1 << 30);
    say(format!(
        "machine   {}, {} cores, {memory:.1} GiB, {}",
        machine.cpu, machine.cores, machine.os
    ))?;

    let adapters = adapters();
    let mut draws = false;
    for (number, adapter) in adapters.iter().enumerate() {
        draws |= describe(number, adapter)?;
    }
    if adapters.is_empty() {
        say("adapter   none: there is no graphics driver")?;
    } else if adapters.iter().all(|adapter| adapter.software) {
        say("          All adapters are software drivers: pictures are right, times are those of")?;
        say("          the processor. For a graphics card, install its maker's Vulkan driver.")?;
    }
    if !draws {
        for line in MENDING.lines() {
            say(format!("          {line}").trim_end())?;
        }
    }

    match display() {
        Ok(display) => say(format!(
            "display   {display}: `lightbench edit` opens a window"
        ))?,
        Err(why) => {
            say(format!("display   {why}"))?;
            say("          `lightbench render`, `compare` and `diff` need none.")?;
        }
    }
    match files.project() {
        Some(folder) => say(format!("project   {}", folder.display()))?,
        None => say("project   none here; `lightbench new DIR` makes one")?,
    }
    if draws { Ok(()) } else { Err(Said.into()) }
}

/// How to get a driver, with root and without.
const MENDING: &str = "\
How to mend it: install a Vulkan driver. One that needs no graphics card is enough.
  Debian, Ubuntu   sudo apt-get install mesa-vulkan-drivers libvulkan1
  Fedora           sudo dnf install mesa-vulkan-drivers vulkan-loader
  Arch             sudo pacman -S vulkan-swrast vulkan-icd-loader
  openSUSE         sudo zypper install libvulkan_lvp libvulkan1
Without root: `./x setup --user` in the source folder puts the driver into your home; by hand,
unpack the two Debian packages (`apt-get download mesa-vulkan-drivers libvulkan1`, `dpkg -x`) and
set VK_DRIVER_FILES to the unpacked lvp_icd.*.json and LD_LIBRARY_PATH to its library folder.
On Windows and macOS the driver belongs to the system: update the system or the graphics driver.";

/// The error of a machine without a driver, with the way out.
pub fn no_driver() -> anyhow::Error {
    GpuError::NoAdapter.into()
}

/// Prints one adapter and whether it draws.
fn describe(number: usize, adapter: &AdapterSummary) -> anyhow::Result<bool> {
    let driver = format!("{} {}", adapter.driver, adapter.driver_info);
    say(format!(
        "adapter {number} {} ({}, {}), driver {}",
        adapter.name,
        adapter.kind,
        adapter.backend,
        driver.trim()
    ))?;
    let options = GpuOptions {
        adapter: Some(number.to_string()),
        portable: false,
    };
    let draws = match Gpu::open(&options)
        .map_err(anyhow::Error::from)
        .and_then(try_it)
    {
        Ok(()) => {
            say("          draws: a test picture came out right")?;
            true
        }
        Err(error) => {
            say(format!("          does not draw: {error:#}"))?;
            false
        }
    };
    for missing in &adapter.missing {
        say(format!("          lacks {missing}"))?;
    }
    if !adapter.missing.is_empty() {
        let way = if adapter.backend == "Gl" {
            "Choose a Vulkan adapter, if one is listed, with --adapter."
        } else {
            "A newer driver may have them; pipelines that need one name it, others run without."
        };
        say(format!("          {way}"))?;
    }
    Ok(draws)
}

/// Draws the smallest scene there is and looks at the picture.
fn try_it(gpu: Gpu) -> anyhow::Result<()> {
    let picture: LdrImage = super::load::test_picture(gpu)?;
    let sky = picture.pixels.first().copied().unwrap_or_default();
    anyhow::ensure!(
        sky[3] == 255 && picture.pixels.iter().all(|&pixel| pixel == sky),
        "the picture of an empty scene has patterns in it; update or change the driver"
    );
    Ok(())
}

/// The display for a window, or why there is none.
///
/// # Errors
/// A sentence.
pub fn display() -> Result<String, String> {
    if cfg!(any(windows, target_os = "macos")) {
        return Ok("the system's".to_owned());
    }
    let set = |name: &str| env::var(name).ok().filter(|value| !value.is_empty());
    let found = ["WAYLAND_DISPLAY", "DISPLAY"]
        .into_iter()
        .find_map(|name| set(name).map(|value| format!("{name}={value}")));
    found.ok_or_else(|| {
        "none: neither DISPLAY nor WAYLAND_DISPLAY is set; log in at a desktop, or use ssh -X"
            .to_owned()
    })
}
