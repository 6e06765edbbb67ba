//! Curves between two ends in the user's units.

use crate::{Fault, SpiralStatus, given, place, results, status::guard, text};
use spiral_atlas::Error;
use spiral_atlas::transition::{Ends, Kind, Piece, fit, stations};
use std::ffi::{CString, c_char};

/// A curve between two points.
pub struct SpiralCurve {
    piece: Piece,
    kind: CString,
    json: CString,
}

/// One end of a curve, in the user's unit of length.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SpiralEnd {
    pub x: f64,
    pub y: f64,
    /// Direction of travel: angle from the x axis, radians, counter-clockwise.
    pub direction: f64,
    /// Signed curvature, 1 / length, positive where the curve turns left.
    pub curvature: f64,
}

/// A point of a curve.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SpiralStation {
    /// Arc length from the start.
    pub station: f64,
    pub x: f64,
    pub y: f64,
    /// Direction of travel, radians, in [-pi, pi].
    pub heading: f64,
    /// Signed curvature.
    pub curvature: f64,
}

/// The curve of monotone curvature between two ends anywhere in the plane.
///
/// `kind` is "cubic" (of several spirals the one with the largest margin), "ph-quintic" (that of least bending energy) or
/// "involute" (the image of an involute of a circle, which exists whenever any spiral does); null stands for "cubic". A
/// curve longer than `longest` counts as none; infinity is no limit. SPIRAL_NONE where there is no spiral: the last error
/// says which condition fails.
///
/// # Safety
/// `start`, `end`, `kind` and `curve` are null or valid; `kind` ends with a zero byte.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_fit(
    start: *const SpiralEnd,
    end: *const SpiralEnd,
    kind: *const c_char,
    longest: f64,
    curve: *mut *mut SpiralCurve,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (start, end, slot) = unsafe { (given(start, "start")?, given(end, "end")?, place(curve, "curve")?) };
        // SAFETY: the caller's promise.
        let name = if kind.is_null() { "cubic" } else { unsafe { text(kind, "kind")? } };
        let kind = Kind::by_name(name)
            .ok_or_else(|| Fault::domain(format!("the kind is `{name}`; it must be cubic, ph-quintic or involute")))?;
        let ends = Ends {
            start: [start.x, start.y],
            end: [end.x, end.y],
            start_direction: start.direction,
            end_direction: end.direction,
            start_curvature: start.curvature,
            end_curvature: end.curvature,
        };
        let mut found = fit(&ends, kind, longest)?;
        let chosen = found.outcome.map_err(|why| Fault(SpiralStatus::SPIRAL_NONE, why))?;
        let piece = found.solutions.swap_remove(chosen);
        let json = serde_json::to_string(&piece).map_err(|e| Fault(SpiralStatus::SPIRAL_INTERNAL, e.to_string()))?;
        let json = CString::new(json).unwrap_or_default();
        let kind = CString::new(piece.kind().name()).unwrap_or_default();
        *slot = Box::into_raw(Box::new(SpiralCurve { piece, kind, json }));
        Ok(())
    })
}

/// Closes a curve. Null is allowed.
///
/// # Safety
/// `curve` comes from spiral_fit and is not used any more, nor are pointers that it gave.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_curve_close(curve: *mut SpiralCurve) {
    if !curve.is_null() {
        // SAFETY: made by Box::into_raw, and closed once, as the caller promises.
        drop(unsafe { Box::from_raw(curve) });
    }
}

/// "cubic", "ph-quintic" or "involute"; null for a null pointer. It lives as long as the curve.
///
/// # Safety
/// `curve` is null or open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_curve_kind(curve: *const SpiralCurve) -> *const c_char {
    // SAFETY: the caller's promise.
    unsafe { curve.as_ref() }.map_or(std::ptr::null(), |curve| curve.kind.as_ptr())
}

/// All that rebuilds the curve exactly, in JSON, as `curve --json` has it under `pieces`; null for a null pointer. It
/// lives as long as the curve.
///
/// # Safety
/// `curve` is null or open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_curve_json(curve: *const SpiralCurve) -> *const c_char {
    // SAFETY: the caller's promise.
    unsafe { curve.as_ref() }.map_or(std::ptr::null(), |curve| curve.json.as_ptr())
}

/// Arc length; NaN for a null pointer.
///
/// # Safety
/// `curve` is null or open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_curve_length(curve: *const SpiralCurve) -> f64 {
    // SAFETY: the caller's promise.
    unsafe { curve.as_ref() }.map_or(f64::NAN, |curve| curve.piece.length())
}

/// Control points: writes at most `room` of them, and always how many there are: 0 for an involute, which has none.
///
/// # Safety
/// `curve` is null or open; `xy` is null or has room for `room` points; `count` is null or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_curve_control_points(
    curve: *const SpiralCurve,
    xy: *mut [f64; 2],
    room: usize,
    count: *mut usize,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (curve, xy, slot) = unsafe { (given(curve, "curve")?, results(xy, room, "xy")?, place(count, "count")?) };
        let points = curve.piece.control_points().unwrap_or_default();
        *slot = points.len();
        xy.iter_mut().zip(points).for_each(|(slot, point)| *slot = point);
        Ok(())
    })
}

/// `count` points at equal arc lengths, both ends included; at least 2.
///
/// # Safety
/// `curve` is null or open; `out` has room for `count` stations.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_curve_stations(curve: *const SpiralCurve, out: *mut SpiralStation, count: usize) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (curve, out) = unsafe {
            place(out, "out")?;
            (given(curve, "curve")?, results(out, count, "out")?)
        };
        let found = stations(std::slice::from_ref(&curve.piece), count).map_err(|e: Error| Fault::from(e))?;
        for (slot, at) in out.iter_mut().zip(found) {
            *slot = SpiralStation { station: at.station, x: at.x, y: at.y, heading: at.heading, curvature: at.curvature };
        }
        Ok(())
    })
}
