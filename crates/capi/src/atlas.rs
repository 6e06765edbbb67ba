//! Atlases of nodes.

use crate::{Fault, Result, SpiralStatus, given, numbers, path, place, results, status::guard, text};
use spiral_atlas::atlas::Atlas;
use std::ffi::{CString, c_char};

/// An atlas file, mapped into memory.
pub struct SpiralAtlas {
    atlas: Atlas,
    family: CString,
    names: Vec<CString>,
}

/// Opens an atlas file and checks its header and axes.
///
/// # Safety
/// `path` is a text that ends with a zero byte; `atlas` is valid for a write. Both may be null, which is
/// SPIRAL_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_atlas_open(path: *const c_char, atlas: *mut *mut SpiralAtlas) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (path, slot) = unsafe { (self::path(path, "path")?, place(atlas, "atlas")?) };
        let atlas = Atlas::open(path)?;
        let family = c_text(atlas.family_name());
        let names = atlas.grid().axes().iter().map(|axis| c_text(axis.name())).collect();
        *slot = Box::into_raw(Box::new(SpiralAtlas { atlas, family, names }));
        Ok(())
    })
}

/// Names in files are letters, digits and underscores: no zero byte among them.
pub(crate) fn c_text(name: &str) -> CString {
    CString::new(name).unwrap_or_default()
}

/// Closes an atlas. Null is allowed.
///
/// # Safety
/// `atlas` comes from spiral_atlas_open and is not used any more, nor are pointers that it gave.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_atlas_close(atlas: *mut SpiralAtlas) {
    if !atlas.is_null() {
        // SAFETY: made by Box::into_raw, and closed once, as the caller promises.
        drop(unsafe { Box::from_raw(atlas) });
    }
}

/// The family's name; null for a null pointer. It lives as long as the atlas.
///
/// # Safety
/// `atlas` is null or open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_atlas_family(atlas: *const SpiralAtlas) -> *const c_char {
    // SAFETY: the caller's promise.
    unsafe { atlas.as_ref() }.map_or(std::ptr::null(), |atlas| atlas.family.as_ptr())
}

/// The number of axes; 0 for a null pointer.
///
/// # Safety
/// `atlas` is null or open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_atlas_axes(atlas: *const SpiralAtlas) -> usize {
    // SAFETY: the caller's promise.
    unsafe { atlas.as_ref() }.map_or(0, |atlas| atlas.names.len())
}

/// Name and values of an axis, slowest first. All live as long as the atlas.
///
/// # Safety
/// `atlas` is null or open; each of the others is null, when it is not wanted, or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_atlas_axis(
    atlas: *const SpiralAtlas,
    index: usize,
    name: *mut *const c_char,
    values: *mut *const f64,
    count: *mut usize,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promise.
        let atlas = unsafe { given(atlas, "atlas")? };
        let axes = atlas.atlas.grid().axes();
        let axis =
            axes.get(index).ok_or_else(|| Fault::domain(format!("axis {index}: the atlas has {}", axes.len())))?;
        // SAFETY: the caller's promises; one value each.
        unsafe {
            results(name, 1, "name")?.fill(atlas.names[index].as_ptr());
            results(values, 1, "values")?.fill(axis.values().as_ptr());
            results(count, 1, "count")?.fill(axis.values().len());
        }
        Ok(())
    })
}

/// The mask of a flag, by name.
///
/// # Safety
/// `atlas` is null or open; `name` is null or a text that ends with a zero byte; `mask` is null or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_atlas_flag(
    atlas: *const SpiralAtlas,
    name: *const c_char,
    mask: *mut u8,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (atlas, name, slot) = unsafe { (given(atlas, "atlas")?, text(name, "name")?, place(mask, "mask")?) };
        *slot = self::mask(atlas.atlas.flag_names(), name)?;
        Ok(())
    })
}

/// The mask of a flag among names, bit 0 first.
pub(crate) fn mask<'a>(names: impl Iterator<Item = &'a str>, name: &str) -> Result<u8> {
    let names: Vec<&str> = names.collect();
    let bit = names.iter().position(|n| *n == name);
    bit.map(|bit| 1 << bit)
        .ok_or_else(|| Fault::domain(format!("no flag is named `{name}`; there are: {}", names.join(", "))))
}

/// The `flags` and `solutions` bytes of all nodes, in flat order, and their number. All live as long as the atlas.
///
/// # Safety
/// `atlas` is null or open; each of the others is null, when it is not wanted, or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_atlas_data(
    atlas: *const SpiralAtlas,
    flags: *mut *const u8,
    solutions: *mut *const u8,
    count: *mut usize,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises; one value each.
        unsafe {
            let SpiralAtlas { atlas, .. } = given(atlas, "atlas")?;
            results(flags, 1, "flags")?.fill(atlas.flags().as_ptr());
            results(solutions, 1, "solutions")?.fill(atlas.solutions().as_ptr());
            results(count, 1, "count")?.fill(atlas.flags().len());
        }
        Ok(())
    })
}

/// The nearest node of each of `count` points: its flat index, flags and solutions. A point outside the grid by more
/// than half a step has the index -1, and 0 in both bytes. A verdict holds at its node.
///
/// # Safety
/// `atlas` is null or open; `points` holds `count` rows of as many numbers as there are axes; each of the others is
/// null, when it is not wanted, or has room for `count` values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_atlas_lookup(
    atlas: *const SpiralAtlas,
    points: *const f64,
    count: usize,
    nodes: *mut i64,
    flags: *mut u8,
    solutions: *mut u8,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (atlas, points, nodes, flags, solutions) = unsafe {
            let atlas = given(atlas, "atlas")?;
            let points = numbers(points, count, atlas.names.len(), "points")?;
            (
                atlas,
                points,
                results(nodes, count, "nodes")?,
                results(flags, count, "flags")?,
                results(solutions, count, "solutions")?,
            )
        };
        for (i, point) in points.chunks_exact(atlas.names.len()).enumerate() {
            let found = atlas.atlas.nearest(point);
            let (node, flag, solution) =
                found.map_or((-1, 0, 0), |(node, entry)| (node as i64, entry.flags, entry.solutions));
            nodes.get_mut(i).into_iter().for_each(|slot| *slot = node);
            flags.get_mut(i).into_iter().for_each(|slot| *slot = flag);
            solutions.get_mut(i).into_iter().for_each(|slot| *slot = solution);
        }
        Ok(())
    })
}

/// Reads the whole file and checks the hash of every array: SPIRAL_FILE names the first that is damaged.
///
/// # Safety
/// `atlas` is null or open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_atlas_check(atlas: *const SpiralAtlas) -> SpiralStatus {
    // SAFETY: the caller's promise.
    guard(|| Ok(unsafe { given(atlas, "atlas")? }.atlas.check_hashes()?))
}
