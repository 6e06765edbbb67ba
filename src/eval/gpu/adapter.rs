//! Which GPUs there are, which one to use, and how to open it.

use crate::error::{Error, Result};
use pollster::block_on;
use serde::Serialize;
use std::sync::{Arc, Mutex, PoisonError};

/// What is known about an adapter before it is opened.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct AdapterFacts {
    /// The device's name.
    pub name: String,
    /// `discrete`, `integrated`, `virtual`, `software` or `other`.
    pub kind: &'static str,
    /// `vulkan`, `metal`, `dx12` or `gl`.
    pub backend: &'static str,
    /// The driver's name.
    pub driver: String,
    /// The driver's version.
    pub driver_info: String,
    /// Largest storage buffer a shader may see, bytes.
    pub max_storage_bytes: u64,
    /// Largest buffer, bytes.
    pub max_buffer_bytes: u64,
    /// Most workgroups along one dimension of a dispatch.
    pub max_groups: u32,
    /// Most invocations of a workgroup.
    pub max_group_size: u32,
    /// Whether runs can be timed on the device itself.
    pub timestamps: bool,
    /// Why it cannot be used, if it cannot.
    pub unusable: Option<String>,
}

impl AdapterFacts {
    /// Name, backend, kind and driver in a line; what `--adapter SUBSTRING` is compared with.
    pub fn label(&self) -> String {
        let driver = format!("{} {}", self.driver, self.driver_info);
        format!("{} [{}, {}; {}]", self.name, self.backend, self.kind, driver.trim())
    }

    /// Preference of `auto`, smaller first; `None` for what it never takes.
    fn rank(&self) -> Option<u32> {
        match self.kind {
            _ if self.unusable.is_some() => None,
            "discrete" => Some(0),
            "integrated" => Some(1),
            _ => None,
        }
    }
}

/// How to get an adapter where there is none.
const HINT: &str = "a software Vulkan driver serves too (Debian, Ubuntu: `apt-get install -y --no-install-recommends \
                    libvulkan1 mesa-vulkan-drivers`), when named with `--adapter llvmpipe`";

/// Every adapter of the native backends (Vulkan, Metal, DX12); of GL, where these have none.
pub fn adapters() -> Vec<AdapterFacts> {
    enumerate().into_iter().map(|(facts, _)| facts).collect()
}

/// The adapter of a choice: with `Some(part)` the first whose [`AdapterFacts::label`] contains it, in any case of
/// letters; with `None` the best hardware adapter, discrete before integrated, never a software one.
///
/// # Errors
/// [`Error::Gpu`], listing what exists, when nothing fits or what fits cannot compute.
pub fn select(choice: Option<&str>) -> Result<AdapterFacts> {
    pick(choice).map(|(facts, _)| facts)
}

/// An opened adapter.
pub(super) struct Gpu {
    pub facts: AdapterFacts,
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    pub limits: wgpu::Limits,
    health: Health,
}

/// The first error that no call returned: wgpu reports most of them through callbacks, and panics without.
#[derive(Clone, Default)]
struct Health(Arc<Mutex<Option<String>>>);

impl Health {
    fn report(&self, what: String) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(what);
    }
}

impl Drop for Gpu {
    /// A device that failed is left to the system. wgpu's own teardown waits for it and looks for things that a failed
    /// call left behind, and panics on either; a panic while another one unwinds would even end the process. There is
    /// one such device a run at most.
    fn drop(&mut self) {
        if self.check().is_err() {
            std::mem::forget((self.device.clone(), self.queue.clone()));
        }
    }
}

impl Gpu {
    /// Opens the adapter of a choice; see [`select`].
    pub(super) fn open(choice: Option<&str>) -> Result<Gpu> {
        let (facts, adapter) = pick(choice)?;
        // The default limits suffice; where an adapter has less, take what it has: `unusable` has checked the rest.
        let limits = wgpu::Limits::downlevel_defaults().or_worse_values_from(&adapter.limits());
        let features = adapter.features() & wgpu::Features::TIMESTAMP_QUERY;
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("spiral-atlas"),
            required_features: features,
            required_limits: limits.clone(),
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            ..Default::default()
        };
        let closed = |what: &str| Error::Gpu(format!("{} does not open: {what}", facts.label()));
        // wgpu compiles shaders of its own here, and panics as it clears up after a driver that refuses them.
        let opened = super::caught(|| block_on(adapter.request_device(&descriptor)));
        let opened =
            opened.ok_or_else(|| closed("its driver failed; restart the machine, or use the CPU (`--backend cpu`)"))?;
        let (device, queue) = opened.map_err(|e| closed(&e.to_string()))?;
        let health = Health::default();
        let (uncaptured, lost) = (health.clone(), health.clone());
        device.on_uncaptured_error(Arc::new(move |e| uncaptured.report(e.to_string())));
        device.set_device_lost_callback(move |_, message| {
            lost.report(format!("the device was lost: {message}; run again, or use the CPU (`--backend cpu`)"));
        });
        Ok(Gpu { facts, device, queue, limits, health })
    }

    /// Fails, now and ever after, once anything went wrong.
    pub(super) fn check(&self) -> Result<()> {
        let error = self.health.0.lock().unwrap_or_else(PoisonError::into_inner).clone();
        error.map_or(Ok(()), |what| Err(self.error(&what)))
    }

    /// An error that names the adapter.
    pub(super) fn error(&self, what: &str) -> Error {
        Error::Gpu(format!("{}: {what}", self.facts.label()))
    }
}

fn pick(choice: Option<&str>) -> Result<(AdapterFacts, wgpu::Adapter)> {
    let all = enumerate();
    let labels: Vec<String> = all.iter().map(|(facts, _)| facts.label()).collect();
    let found = match choice {
        Some(part) => all.into_iter().find(|(facts, _)| matches(facts, part)),
        None => all.into_iter().filter(|(f, _)| f.rank().is_some()).min_by_key(|(f, _)| f.rank()),
    };
    let Some((facts, adapter)) = found else { return Err(Error::Gpu(nothing_fits(choice, &labels))) };
    match &facts.unusable {
        Some(why) => Err(Error::Gpu(format!("{} cannot be used: {why}", facts.label()))),
        None => Ok((facts, adapter)),
    }
}

fn matches(facts: &AdapterFacts, part: &str) -> bool {
    facts.label().to_lowercase().contains(&part.to_lowercase())
}

fn nothing_fits(choice: Option<&str>, labels: &[String]) -> String {
    if labels.is_empty() {
        return format!("there is no adapter; {HINT}");
    }
    let what = match choice {
        Some(part) => format!("no adapter matches `{part}`"),
        None => "there is no hardware adapter; name a software one with `--adapter`".to_owned(),
    };
    format!("{what}; there are:\n  {}", labels.join("\n  "))
}

/// The adapters of native backends or, where there is none, of GL: the same devices again, and merely asking for
/// them makes some systems complain on the terminal. The environment can narrow the backends, as with every wgpu
/// program: `WGPU_BACKEND=gl`.
fn enumerate() -> Vec<(AdapterFacts, wgpu::Adapter)> {
    let allowed = wgpu::Backends::all().with_env();
    let stages = [allowed - wgpu::Backends::GL, allowed & wgpu::Backends::GL];
    let found = stages.into_iter().filter(|backends| !backends.is_empty()).map(|backends| {
        let descriptor =
            wgpu::InstanceDescriptor { backends, ..wgpu::InstanceDescriptor::new_without_display_handle_from_env() };
        block_on(wgpu::Instance::new(descriptor).enumerate_adapters(backends))
    });
    let all = found.into_iter().find(|adapters| !adapters.is_empty()).unwrap_or_default();
    all.into_iter().map(|adapter| (facts(&adapter), adapter)).collect()
}

fn facts(adapter: &wgpu::Adapter) -> AdapterFacts {
    let info = adapter.get_info();
    let limits = adapter.limits();
    AdapterFacts {
        name: info.name,
        kind: match info.device_type {
            wgpu::DeviceType::DiscreteGpu => "discrete",
            wgpu::DeviceType::IntegratedGpu => "integrated",
            wgpu::DeviceType::VirtualGpu => "virtual",
            wgpu::DeviceType::Cpu => "software",
            wgpu::DeviceType::Other => "other",
        },
        backend: info.backend.to_str(),
        driver: info.driver,
        driver_info: info.driver_info,
        max_storage_bytes: limits.max_storage_buffer_binding_size,
        max_buffer_bytes: limits.max_buffer_size,
        max_groups: limits.max_compute_workgroups_per_dimension,
        max_group_size: limits.max_compute_invocations_per_workgroup,
        timestamps: adapter.features().contains(wgpu::Features::TIMESTAMP_QUERY),
        unusable: unusable(adapter, &limits),
    }
}

fn unusable(adapter: &wgpu::Adapter, limits: &wgpu::Limits) -> Option<String> {
    let flags = adapter.get_downlevel_capabilities().flags;
    if !flags.contains(wgpu::DownlevelFlags::COMPUTE_SHADERS) {
        return Some("it has no compute shaders".into());
    }
    let needs = [
        ("storage buffers per shader", limits.max_storage_buffers_per_shader_stage.into(), 2),
        ("invocations per workgroup", limits.max_compute_invocations_per_workgroup.into(), super::GROUP_SIZE.into()),
        ("workgroup width", limits.max_compute_workgroup_size_x.into(), super::GROUP_SIZE.into()),
        ("workgroups per dimension", limits.max_compute_workgroups_per_dimension.into(), 1024),
        ("bytes per storage buffer", limits.max_storage_buffer_binding_size, 1 << 20),
    ];
    let (what, has, least) = needs.into_iter().find(|(_, has, least): &(_, u64, u64)| has < least)?;
    Some(format!("it has {has} {what}; at least {least} are needed"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facts(name: &str, kind: &'static str) -> AdapterFacts {
        AdapterFacts {
            name: name.into(),
            kind,
            backend: "vulkan",
            driver: "drv".into(),
            driver_info: "1.2".into(),
            max_storage_bytes: 1 << 27,
            max_buffer_bytes: 1 << 28,
            max_groups: 65535,
            max_group_size: 256,
            timestamps: true,
            unusable: None,
        }
    }

    #[test]
    fn auto_takes_hardware_only() {
        assert_eq!(facts("a", "discrete").rank(), Some(0));
        assert_eq!(facts("a", "integrated").rank(), Some(1));
        assert_eq!(facts("a", "software").rank(), None);
        assert_eq!(facts("a", "other").rank(), None);
        assert_eq!(AdapterFacts { unusable: Some("old".into()), ..facts("a", "discrete") }.rank(), None);
    }

    #[test]
    fn a_part_of_the_label_in_any_case_names_an_adapter() {
        let mesa = facts("llvmpipe (LLVM 15)", "software");
        assert_eq!(mesa.label(), "llvmpipe (LLVM 15) [vulkan, software; drv 1.2]");
        assert!(matches(&mesa, "LLVMpipe") && matches(&mesa, "[vulkan") && !matches(&mesa, "radeon"));
    }

    #[test]
    fn errors_say_what_there_is_or_how_to_get_it() {
        assert!(nothing_fits(None, &[]).contains("mesa-vulkan-drivers"));
        let text = nothing_fits(Some("radeon"), &["llvmpipe [vulkan]".into()]);
        assert!(text.contains("`radeon`") && text.contains("llvmpipe [vulkan]"), "{text}");
    }
}
