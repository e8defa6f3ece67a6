//! The graphics device: choosing an adapter, opening it, and saying what it is.

use std::sync::{Arc, Mutex};

use wgpu::{Backends, DeviceType, Features, Limits};

use crate::heap;

/// How to choose and open an adapter.
#[derive(Clone, Debug, Default)]
pub struct GpuOptions {
    /// Part of an adapter's name, ignoring case, or its number in [`adapters`]. `None` takes the
    /// first hardware adapter, else the first software one.
    pub adapter: Option<String>,
    /// Open the device with the default limits of WebGPU and no optional features except
    /// timestamps: what every adapter offers. Tests use it to show that pipelines are portable.
    pub portable: bool,
}

/// What an adapter is.
#[derive(Clone, Debug, PartialEq)]
pub struct AdapterSummary {
    /// Name as the driver reports it.
    pub name: String,
    /// Driver name.
    pub driver: String,
    /// Driver version and build.
    pub driver_info: String,
    /// `Vulkan`, `Metal`, `Dx12` or `Gl`.
    pub backend: String,
    /// `discrete`, `integrated`, `virtual`, `software` or `other`.
    pub kind: &'static str,
    /// Whether the processor draws: times are then no measure of a graphics card.
    pub software: bool,
    /// Optional features that Lightbench uses and the adapter lacks, each with what is lost.
    pub missing: Vec<String>,
}

/// Why no device could be opened.
#[derive(Clone, Debug, thiserror::Error)]
pub enum GpuError {
    /// There is no driver at all.
    #[error(
        "no graphics driver was found. On Debian or Ubuntu, `sudo apt-get install \
         mesa-vulkan-drivers libvulkan1` installs one that needs no graphics card; \
         `lightbench doctor` says more"
    )]
    NoAdapter,
    /// No adapter has that name.
    #[error("no adapter is called `{wanted}`; there is: {available}")]
    UnknownAdapter {
        /// What was asked for.
        wanted: String,
        /// What there is.
        available: String,
    },
    /// The adapter refused.
    #[error("`{adapter}` could not be opened: {reason}. `lightbench doctor` lists the others")]
    Device {
        /// The adapter's name.
        adapter: String,
        /// The driver's words.
        reason: String,
    },
    /// The device stopped working.
    #[error("the graphics device was lost: {0}. Restart the program; what was saved is safe")]
    Lost(String),
    /// The device did not answer in time.
    #[error("the graphics device did not finish within {0} s: a shader may loop for ever")]
    Timeout(u64),
    /// The driver reported an error that nobody expected.
    #[error("the graphics driver reports: {0}")]
    Driver(String),
}

/// What went wrong on the device since it was opened; filled by the driver's callbacks.
#[derive(Debug, Default)]
struct Health {
    lost: Option<String>,
    error: Option<String>,
}

/// An open device. Clones share it.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// The adapter that it came from.
    pub adapter: wgpu::Adapter,
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// What it is.
    pub summary: AdapterSummary,
    health: Arc<Mutex<Health>>,
}

/// Optional features, and what is lost without each.
const WANTED: [(Features, &str); 9] = [
    (
        Features::TIMESTAMP_QUERY,
        "timestamp queries: no GPU time per pass",
    ),
    (
        Features::PIPELINE_STATISTICS_QUERY,
        "pipeline statistics: no count of fragments",
    ),
    (
        Features::DEPTH32FLOAT_STENCIL8,
        "32-bit depth with stencil: no stencil in deferred light volumes",
    ),
    (
        Features::FLOAT32_BLENDABLE,
        "blending of 32-bit floats: light is accumulated in 16 bits",
    ),
    (Features::FLOAT32_FILTERABLE, "filtering of 32-bit floats"),
    (
        Features::DEPTH_CLIP_CONTROL,
        "clamping of depth: lights are not confined to clip volumes that the far plane cuts",
    ),
    (
        Features::RG11B10UFLOAT_RENDERABLE,
        "rendering to rg11b10ufloat",
    ),
    (
        Features::TEXTURE_FORMAT_16BIT_NORM,
        "normalised 16-bit formats such as rg16unorm",
    ),
    (
        Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES,
        "formats beyond WebGPU's guarantees",
    ),
];

fn instance(backends: Backends) -> wgpu::Instance {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    wgpu::Instance::new(descriptor.with_env())
}

/// The adapters of this machine, best first.
///
/// OpenGL is looked at only where there is nothing better, or where the environment variable
/// `WGPU_BACKEND` asks for it: starting it takes time, and without a desktop it complains.
fn enumerate() -> Vec<wgpu::Adapter> {
    let adapters = enumerate_in(&instance(Backends::PRIMARY));
    if adapters.is_empty() {
        return enumerate_in(&instance(Backends::GL));
    }
    adapters
}

/// The adapters in the order of preference: hardware before software, Vulkan, Metal and DirectX
/// before OpenGL.
fn enumerate_in(instance: &wgpu::Instance) -> Vec<wgpu::Adapter> {
    let mut adapters = pollster::block_on(instance.enumerate_adapters(Backends::all()));
    adapters.sort_by_key(|adapter| {
        let info = adapter.get_info();
        let kind = match info.device_type {
            DeviceType::DiscreteGpu => 0,
            DeviceType::IntegratedGpu => 1,
            DeviceType::VirtualGpu => 2,
            DeviceType::Other => 3,
            DeviceType::Cpu => 4,
        };
        (info.backend == wgpu::Backend::Gl, kind)
    });
    adapters
}

/// All adapters of this machine, best first. Empty where no driver is installed.
pub fn adapters() -> Vec<AdapterSummary> {
    enumerate().iter().map(summarize).collect()
}

fn summarize(adapter: &wgpu::Adapter) -> AdapterSummary {
    let info = adapter.get_info();
    let features = adapter.features();
    let kind = match info.device_type {
        DeviceType::DiscreteGpu => "discrete",
        DeviceType::IntegratedGpu => "integrated",
        DeviceType::VirtualGpu => "virtual",
        DeviceType::Cpu => "software",
        DeviceType::Other => "other",
    };
    AdapterSummary {
        name: info.name,
        driver: info.driver,
        driver_info: info.driver_info,
        backend: format!("{:?}", info.backend),
        kind,
        software: info.device_type == DeviceType::Cpu,
        missing: WANTED
            .iter()
            .filter(|(feature, _)| !features.contains(*feature))
            .map(|(_, loss)| (*loss).to_owned())
            .collect(),
    }
}

impl Gpu {
    /// Opens a device without a window.
    ///
    /// # Errors
    /// [`GpuError`] with the way to mend it.
    pub fn open(options: &GpuOptions) -> Result<Self, GpuError> {
        let adapter = Self::choose(enumerate(), options.adapter.as_deref())?;
        Self::from_adapter(adapter, options)
    }

    /// Opens a device that can draw to a window's surface, chosen as [`Gpu::open`] does.
    ///
    /// # Errors
    /// [`GpuError`] with the way to mend it.
    pub fn open_for(
        instance: &wgpu::Instance,
        surface: &wgpu::Surface<'_>,
        options: &GpuOptions,
    ) -> Result<Self, GpuError> {
        let mut adapters = enumerate_in(instance);
        adapters.retain(|adapter| adapter.is_surface_supported(surface));
        let adapter = Self::choose(adapters, options.adapter.as_deref())?;
        Self::from_adapter(adapter, options)
    }

    /// Chooses among adapters by part of a name or by number.
    fn choose(
        mut adapters: Vec<wgpu::Adapter>,
        wanted: Option<&str>,
    ) -> Result<wgpu::Adapter, GpuError> {
        if adapters.is_empty() {
            return Err(GpuError::NoAdapter);
        }
        let index = match wanted {
            None => 0,
            Some(wanted) => {
                let lower = wanted.to_lowercase();
                let by_name = |a: &wgpu::Adapter| a.get_info().name.to_lowercase().contains(&lower);
                let by_number = wanted.parse::<usize>().ok().filter(|&n| n < adapters.len());
                by_number
                    .or_else(|| adapters.iter().position(by_name))
                    .ok_or_else(|| GpuError::UnknownAdapter {
                        wanted: wanted.to_owned(),
                        available: adapters
                            .iter()
                            .map(|a| a.get_info().name)
                            .collect::<Vec<_>>()
                            .join(", "),
                    })?
            }
        };
        Ok(adapters.swap_remove(index))
    }

    /// Opens a device on an adapter, as the editor does with the one that suits its window.
    ///
    /// # Errors
    /// [`GpuError::Device`] when the driver refuses.
    pub fn from_adapter(adapter: wgpu::Adapter, options: &GpuOptions) -> Result<Self, GpuError> {
        let summary = summarize(&adapter);
        if summary.software {
            heap::keep_freed_memory();
        }
        let wanted = if options.portable {
            Features::TIMESTAMP_QUERY
        } else {
            WANTED
                .iter()
                .fold(Features::empty(), |all, (feature, _)| all | *feature)
        };
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("lightbench"),
            required_features: adapter.features() & wanted,
            required_limits: if options.portable {
                Limits::default()
            } else {
                adapter.limits()
            },
            ..Default::default()
        };
        let (device, queue) =
            pollster::block_on(adapter.request_device(&descriptor)).map_err(|error| {
                GpuError::Device {
                    adapter: summary.name.clone(),
                    reason: error.to_string(),
                }
            })?;

        let health = Arc::new(Mutex::new(Health::default()));
        let on_lost = Arc::clone(&health);
        device.set_device_lost_callback(move |reason, message| {
            // Dropping the device is no loss.
            if reason != wgpu::DeviceLostReason::Destroyed
                && let Ok(mut health) = on_lost.lock()
            {
                health.lost.get_or_insert(message);
            }
        });
        let on_error = Arc::clone(&health);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            tracing::error!("{error}");
            if let Ok(mut health) = on_error.lock() {
                health.error.get_or_insert(error.to_string());
            }
        }));
        Ok(Self {
            adapter,
            device,
            queue,
            summary,
            health,
        })
    }

    /// Whether the device still works.
    ///
    /// # Errors
    /// [`GpuError::Lost`] once it is lost; [`GpuError::Driver`] once for an unexpected error.
    pub fn check(&self) -> Result<(), GpuError> {
        let Ok(mut health) = self.health.lock() else {
            return Ok(());
        };
        if let Some(reason) = &health.lost {
            return Err(GpuError::Lost(reason.clone()));
        }
        health
            .error
            .take()
            .map_or(Ok(()), |error| Err(GpuError::Driver(error)))
    }

    /// The optional parts of WGSL that the device has.
    pub fn capabilities(&self) -> naga::valid::Capabilities {
        use naga::valid::Capabilities;
        use wgpu::DownlevelFlags;
        let flags = self.adapter.get_downlevel_capabilities().flags;
        [
            (
                DownlevelFlags::SHADER_F16_IN_F32,
                Capabilities::SHADER_FLOAT16_IN_FLOAT32,
            ),
            (
                DownlevelFlags::MULTISAMPLED_SHADING,
                Capabilities::MULTISAMPLED_SHADING,
            ),
            (
                DownlevelFlags::CUBE_ARRAY_TEXTURES,
                Capabilities::CUBE_ARRAY_TEXTURES,
            ),
        ]
        .into_iter()
        .filter(|(flag, _)| flags.contains(*flag))
        .fold(Capabilities::empty(), |all, (_, capability)| {
            all | capability
        })
    }

    /// Whether the device can clamp depth instead of cutting faces off at the near and far plane.
    pub fn clamps_depth(&self) -> bool {
        self.device
            .features()
            .contains(Features::DEPTH_CLIP_CONTROL)
    }

    /// What the device can do with a format: with its adapter's word where the device was opened
    /// with it, else what WebGPU guarantees. `None` where the format needs a feature that is not there.
    pub fn format_features(
        &self,
        format: wgpu::TextureFormat,
    ) -> Option<wgpu::TextureFormatFeatures> {
        let features = self.device.features();
        if !features.contains(format.required_features()) {
            return None;
        }
        let specific = Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES;
        Some(if features.contains(specific) {
            self.adapter.get_texture_format_features(format)
        } else {
            format.guaranteed_format_features(features)
        })
    }

    /// Whether passes can be timed on the device.
    pub fn has_timestamps(&self) -> bool {
        self.device.features().contains(Features::TIMESTAMP_QUERY)
    }

    /// Whether the device counts fragments.
    pub fn has_pipeline_statistics(&self) -> bool {
        let features = self.device.features();
        features.contains(Features::PIPELINE_STATISTICS_QUERY)
    }

    /// Waits until the device has done all submitted work.
    ///
    /// # Errors
    /// [`GpuError::Timeout`] after `seconds`, or what [`Gpu::check`] finds.
    pub fn wait(&self, seconds: u64) -> Result<(), GpuError> {
        let timeout = Some(std::time::Duration::from_secs(seconds));
        let wait = wgpu::PollType::Wait {
            submission_index: None,
            timeout,
        };
        match self.device.poll(wait) {
            Ok(_) => self.check(),
            Err(wgpu::PollError::Timeout) => Err(GpuError::Timeout(seconds)),
            Err(error) => Err(GpuError::Driver(error.to_string())),
        }
    }

    /// Runs `build` and returns the driver's complaint about it, if any, instead of stopping.
    pub fn guarded<T>(&self, build: impl FnOnce() -> T) -> Result<T, String> {
        let internal = self.device.push_error_scope(wgpu::ErrorFilter::Internal);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let built = build();
        let validation = pollster::block_on(validation.pop());
        let internal = pollster::block_on(internal.pop());
        match validation.or(internal) {
            None => Ok(built),
            Some(error) => Err(error.to_string()),
        }
    }
}
