//! Certified cells.

use crate::atlas::mask;
use crate::{Fault, SpiralStatus, given, numbers, path, place, results, status::guard, text};
use spiral_atlas::cells::Cells;
use std::ffi::c_char;

/// A file of certified cells, mapped into memory.
pub struct SpiralCells(Cells);

/// Opens a file of cells and checks its header, axes and trees.
///
/// # Safety
/// `path` is null or a text that ends with a zero byte; `cells` is null or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_cells_open(path: *const c_char, cells: *mut *mut SpiralCells) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (path, slot) = unsafe { (self::path(path, "path")?, place(cells, "cells")?) };
        *slot = Box::into_raw(Box::new(SpiralCells(Cells::open(path)?)));
        Ok(())
    })
}

/// Closes a file of cells. Null is allowed.
///
/// # Safety
/// `cells` comes from spiral_cells_open and is not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_cells_close(cells: *mut SpiralCells) {
    if !cells.is_null() {
        // SAFETY: made by Box::into_raw, and closed once, as the caller promises.
        drop(unsafe { Box::from_raw(cells) });
    }
}

/// The number of coordinates of a point; 0 for a null pointer.
///
/// # Safety
/// `cells` is null or open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_cells_axes(cells: *const SpiralCells) -> usize {
    // SAFETY: the caller's promise.
    unsafe { cells.as_ref() }.map_or(0, |cells| cells.0.grid().axes().len())
}

/// The mask of a flag, by name.
///
/// # Safety
/// `cells` is null or open; `name` is null or a text that ends with a zero byte; `mask` is null or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_cells_flag(
    cells: *const SpiralCells,
    name: *const c_char,
    mask: *mut u8,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (cells, name, slot) = unsafe { (given(cells, "cells")?, text(name, "name")?, place(mask, "mask")?) };
        *slot = self::mask(cells.0.about().flags.iter().map(|flag| &flag.name[..]), name)?;
        Ok(())
    })
}

/// What the cell of each of `count` points says, as two masks: flags that hold at every point of the cell, and flags
/// that hold at none. A flag in neither is not known; outside the box of the file none is.
///
/// # Safety
/// `cells` is null or open; `points` holds `count` rows of as many numbers as there are axes; `inside` and `outside`
/// are null, when they are not wanted, or have room for `count` values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_cells_lookup(
    cells: *const SpiralCells,
    points: *const f64,
    count: usize,
    inside: *mut u8,
    outside: *mut u8,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (cells, axes, points, inside, outside) = unsafe {
            let cells = &given(cells, "cells")?.0;
            let axes = cells.grid().axes().len();
            let points = numbers(points, count, axes, "points")?;
            (cells, axes, points, results(inside, count, "inside")?, results(outside, count, "outside")?)
        };
        for (i, point) in points.chunks_exact(axes).enumerate() {
            let known = cells.lookup(point).unwrap_or_default();
            inside.get_mut(i).into_iter().for_each(|slot| *slot = known.inside);
            outside.get_mut(i).into_iter().for_each(|slot| *slot = known.outside);
        }
        Ok(())
    })
}

/// The truth about the wanted flags at each of `count` points: from its cell where that says it, or else from the
/// family itself, also outside the box. A point outside the family's domain is SPIRAL_DOMAIN, naming the row.
///
/// # Safety
/// `cells` is null or open; `points` holds `count` rows of as many numbers as there are axes; `holds` has room for
/// `count` values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_cells_verdict(
    cells: *const SpiralCells,
    points: *const f64,
    count: usize,
    wanted: u8,
    holds: *mut u8,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (cells, axes, points, holds) = unsafe {
            let cells = &given(cells, "cells")?.0;
            let axes = cells.grid().axes().len();
            (cells, axes, numbers(points, count, axes, "points")?, results(holds, count, "holds")?)
        };
        for (i, point) in points.chunks_exact(axes).enumerate() {
            let held = cells.verdict(point, wanted).map_err(|e| Fault::of_row(i, e))?;
            holds.get_mut(i).into_iter().for_each(|slot| *slot = held);
        }
        Ok(())
    })
}
