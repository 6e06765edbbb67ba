//! The adapters that GPU tests run on.

use spiral_atlas::eval::gpu::adapters;

/// The labels of all adapters that can compute, or of those that `SPIRAL_ATLAS_TEST_ADAPTER` is part of, so that a job
/// meant for one adapter cannot pass on another. There must be one: a GPU test that is skipped proves nothing.
pub(crate) fn labels() -> Vec<String> {
    let part = std::env::var("SPIRAL_ATLAS_TEST_ADAPTER").unwrap_or_default();
    let all = adapters();
    let usable = all.iter().filter(|a| a.unusable.is_none()).map(|a| a.label());
    let wanted: Vec<String> = usable.filter(|label| label.to_lowercase().contains(&part.to_lowercase())).collect();
    assert!(
        !wanted.is_empty(),
        "no GPU adapter `{part}`, so nothing can be tested (there are: {all:?}); install software Vulkan: \
         apt-get install -y --no-install-recommends libvulkan1 mesa-vulkan-drivers"
    );
    wanted
}
