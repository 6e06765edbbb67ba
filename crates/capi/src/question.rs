//! Questions beyond yes and no: ranges, the nearest datum, outlines.

use crate::answer::known;
use crate::{Fault, Result, SpiralStatus, given, numbers, place, results, status::guard, text};
use spiral_atlas::family::MOST_SIDES;
use spiral_atlas::question::{self, Boundary, Property, Range, Ranges};
use std::ffi::c_char;

/// An interval of a coordinate in which a property holds.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SpiralRange {
    /// The property holds at these numbers. At their neighbours outside it does not, unless the range is cut there.
    pub ends: [f64; 2],
    /// It holds at each number from the first to the second: proved.
    pub inner: [f64; 2],
    /// Below the first and above the second it fails up to the next range or open interval, or to the end of the
    /// interval that was asked about: proved.
    pub outer: [f64; 2],
    /// 1 for an end that is none of the property: the interval that was asked about ends there, and the property goes
    /// on beyond. Otherwise 0.
    pub cut: [u8; 2],
}

/// All that is known of a property along one coordinate.
pub struct SpiralRanges {
    ranges: Vec<SpiralRange>,
    open: Vec<[f64; 2]>,
}

/// The outline of a property in a slice.
pub struct SpiralBoundary(Boundary);

/// A property of a family, and the datum. A null `flag` is the one that says that a spiral exists.
///
/// # Safety
/// The texts are null or end with a zero byte; `datum` is null or holds as many numbers as the chart has axes, for as
/// long as `'a`.
unsafe fn asked<'a>(
    family: *const c_char,
    chart: *const c_char,
    flag: *const c_char,
    datum: *const f64,
) -> Result<(Property, &'a [f64])> {
    // SAFETY: the caller's promises.
    unsafe {
        let (family, chart) = known(family, chart)?;
        let about = family.about();
        let axes = about.charts[chart].axes;
        let flag = match about.yes {
            _ if !flag.is_null() => text(flag, "flag")?,
            [only] => only,
            several => return Err(Fault::domain(format!("name a flag, such as {}", several.join(" or ")))),
        };
        Ok((Property::new(about.name, axes, flag)?, numbers(datum, 1, axes.len(), "datum")?))
    }
}

/// All intervals of the coordinate number `axis`, from `from` to `to`, in which a property holds; in `datum` that
/// coordinate does not matter. `flag` is the property's name; null stands for the flag that says that a spiral exists.
/// All families answer. Close the ranges with spiral_ranges_close.
///
/// # Safety
/// `family`, `chart` and `flag` are null or texts that end with a zero byte (a null `chart` is the family's first);
/// `datum` holds as many numbers as the chart has axes; `ranges` is null or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_ranges(
    family: *const c_char,
    chart: *const c_char,
    flag: *const c_char,
    datum: *const f64,
    axis: usize,
    from: f64,
    to: f64,
    ranges: *mut *mut SpiralRanges,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let ((property, datum), slot) = unsafe { (asked(family, chart, flag, datum)?, place(ranges, "ranges")?) };
        let Ranges { ranges, open, .. } = question::ranges(&property, datum, axis, [from, to])?;
        let range = |r: Range| SpiralRange { ends: r.ends, inner: r.inner, outer: r.outer, cut: r.cut.map(u8::from) };
        let ranges = ranges.into_iter().map(range).collect();
        *slot = Box::into_raw(Box::new(SpiralRanges { ranges, open }));
        Ok(())
    })
}

/// Closes ranges. Null is allowed.
///
/// # Safety
/// `ranges` comes from spiral_ranges and is not used any more, nor are pointers that it gave.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_ranges_close(ranges: *mut SpiralRanges) {
    if !ranges.is_null() {
        // SAFETY: made by Box::into_raw, and closed once, as the caller promises.
        drop(unsafe { Box::from_raw(ranges) });
    }
}

/// The ranges in increasing order, and the intervals of which it is not known whether the property holds there; outside
/// of both it is proved to fail. All live as long as the handle.
///
/// # Safety
/// `ranges` is null or open; each of the others is null, when it is not wanted, or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_ranges_data(
    ranges: *const SpiralRanges,
    all: *mut *const SpiralRange,
    count: *mut usize,
    open: *mut *const [f64; 2],
    open_count: *mut usize,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises; one value each.
        unsafe {
            let found = given(ranges, "ranges")?;
            results(all, 1, "all")?.fill(found.ranges.as_ptr());
            results(count, 1, "count")?.fill(found.ranges.len());
            results(open, 1, "open")?.fill(found.open.as_ptr());
            results(open_count, 1, "open_count")?.fill(found.open.len());
        }
        Ok(())
    })
}

/// The nearest datum that has a property, of those with coordinates up to 1e6: the datum, its distance, and a proved
/// bound: no datum with the property is nearer than `at_least`. The distance is the root of the sum of squares of
/// weight times difference; null `weights` are 1, and an infinite one keeps its coordinate. SPIRAL_NONE where no datum
/// was found; then `at_least` alone is written, infinite where there is none at all.
///
/// # Safety
/// `family`, `chart`, `flag` and `datum` as for spiral_ranges; `weights` is null or holds as many numbers as the datum;
/// `nearest` is null, when it is not wanted, or has room for as many; `distance` and `at_least` are null, when they are
/// not wanted, or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_nearest(
    family: *const c_char,
    chart: *const c_char,
    flag: *const c_char,
    datum: *const f64,
    weights: *const f64,
    nearest: *mut f64,
    distance: *mut f64,
    at_least: *mut f64,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let ((property, datum), weights, nearest, distance, at_least) = unsafe {
            let asked = asked(family, chart, flag, datum)?;
            let count = asked.1.len();
            let given =
                if weights.is_null() { &[1.0; MOST_SIDES][..count] } else { numbers(weights, 1, count, "weights")? };
            let distance = results(distance, 1, "distance")?;
            (asked, given, results(nearest, count, "nearest")?, distance, results(at_least, 1, "at_least")?)
        };
        let found = question::nearest(&property, datum, weights)?;
        at_least.fill(found.at_least);
        let (Some(point), Some(far)) = (found.point, found.distance) else {
            let what = format!("no datum with {} was found; none is nearer than {:?}", property.name(), found.at_least);
            return Err(Fault(SpiralStatus::SPIRAL_NONE, what));
        };
        nearest.iter_mut().zip(point).for_each(|(slot, x)| *slot = x);
        distance.fill(far);
        Ok(())
    })
}

/// The outline of a property in a slice: the coordinates with the numbers `axes[0]` and `axes[1]` vary, each from
/// `within[i][0]` to `within[i][1]`, in `cells` cells along each side: a power of two up to 4096. In `datum` these two
/// do not matter. Close the outline with spiral_boundary_close.
///
/// # Safety
/// `family`, `chart`, `flag` and `datum` as for spiral_ranges; `axes` and `within` are null or hold two numbers and two
/// pairs; `boundary` is null or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_boundary(
    family: *const c_char,
    chart: *const c_char,
    flag: *const c_char,
    datum: *const f64,
    axes: *const usize,
    within: *const [f64; 2],
    cells: usize,
    boundary: *mut *mut SpiralBoundary,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let ((property, datum), axes, within, slot) = unsafe {
            let asked = asked(family, chart, flag, datum)?;
            (asked, numbers(axes, 1, 2, "axes")?, numbers(within, 1, 2, "within")?, place(boundary, "boundary")?)
        };
        let found = question::boundary(&property, datum, [axes[0], axes[1]], [within[0], within[1]], cells)?;
        *slot = Box::into_raw(Box::new(SpiralBoundary(found)));
        Ok(())
    })
}

/// Closes an outline. Null is allowed.
///
/// # Safety
/// `boundary` comes from spiral_boundary and is not used any more, nor are pointers that it gave.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_boundary_close(boundary: *mut SpiralBoundary) {
    if !boundary.is_null() {
        // SAFETY: made by Box::into_raw, and closed once, as the caller promises.
        drop(unsafe { Box::from_raw(boundary) });
    }
}

/// How many polylines the outline has; 0 for a null pointer.
///
/// # Safety
/// `boundary` is null or open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_boundary_lines(boundary: *const SpiralBoundary) -> usize {
    // SAFETY: the caller's promise.
    unsafe { boundary.as_ref() }.map_or(0, |found| found.0.outlines.len())
}

/// A polyline of the outline: its points, and 1 where the last joins the first, 0 where it ends at the border of the
/// slice. The points live as long as the handle.
///
/// # Safety
/// `boundary` is null or open; each of the others is null, when it is not wanted, or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_boundary_line(
    boundary: *const SpiralBoundary,
    index: usize,
    xy: *mut *const [f64; 2],
    count: *mut usize,
    closed: *mut u8,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises; one value each.
        unsafe {
            let all = &given(boundary, "boundary")?.0.outlines;
            let line = all.get(index).ok_or_else(|| Fault::domain(format!("line {index}: there are {}", all.len())))?;
            results(xy, 1, "xy")?.fill(line.points.as_ptr());
            results(count, 1, "count")?.fill(line.points.len());
            results(closed, 1, "closed")?.fill(u8::from(line.closed));
        }
        Ok(())
    })
}

/// Cells, as their least and greatest corners, in which the property may change although no line passes; and the sides
/// of a cell, two numbers. It is proved to change in no other cell but those that a line passes. The cells live as long
/// as the handle.
///
/// # Safety
/// `boundary` is null or open; `open` and `count` are null, when they are not wanted, or valid for a write; `cell` is
/// null, when it is not wanted, or has room for two numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_boundary_open(
    boundary: *const SpiralBoundary,
    open: *mut *const [[f64; 2]; 2],
    count: *mut usize,
    cell: *mut f64,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises; one value each, but two sides of a cell.
        unsafe {
            let found = &given(boundary, "boundary")?.0;
            results(open, 1, "open")?.fill(found.open.as_ptr());
            results(count, 1, "count")?.fill(found.open.len());
            results(cell, 2, "cell")?.iter_mut().zip(found.cell).for_each(|(slot, side)| *slot = side);
        }
        Ok(())
    })
}
