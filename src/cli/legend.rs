//! What files of either kind say about themselves, in lines.

use spiral_atlas::atlas::About;
use spiral_atlas::grid::{Axis, Spacing};
use std::fmt::Display;
use std::path::Path;

/// How an axis was asked for.
pub(super) fn spacing(axis: &Axis) -> &'static str {
    match axis.spacing() {
        Spacing::Linear { .. } => "linear",
        Spacing::Log { .. } => "log",
        Spacing::Values(_) => "values",
    }
}

/// The lines that every file begins with.
pub(super) fn head(path: &Path, about: &About, id: &str) -> String {
    let mut text = format!("{}\n", path.display());
    for (key, value) in [
        ("name", &about.name[..]),
        ("id", id),
        ("generator", &about.generator),
        ("family", &about.family),
        ("conventions", &about.conventions),
    ] {
        text += &format!("  {key:<12} {value}\n");
    }
    text
}

/// The flags by bit.
pub(super) fn flags(about: &About) -> String {
    about.flags.iter().enumerate().map(|(bit, flag)| format!("  bit {bit} {:<14} {}\n", flag.name, flag.doc)).collect()
}

/// The lines that every file ends with.
pub(super) fn tail<'a>(about: &About, hashes: impl Iterator<Item = (&'a str, impl Display)>) -> String {
    let mut text = "BLAKE3 of each tensor, checked\n".to_owned();
    for (name, hash) in hashes {
        text += &format!("  {name:<12} {hash}\n");
    }
    text += "recipe\n";
    for line in about.recipe.lines() {
        text += format!("  {line}").trim_end();
        text += "\n";
    }
    text
}

/// The lines that every verification begins with.
pub(crate) fn faults(path: &Path, id: &str, faults: &[String]) -> String {
    let mut text = format!("{}\n  id {id}\n", path.display());
    text += if faults.is_empty() { "  hashes, legend and recipe are sound\n" } else { "" };
    for fault in faults {
        text += &format!("  FAULT: {fault}\n");
    }
    text
}
