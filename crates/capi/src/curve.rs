//! Curves between two ends in the user's units.

use crate::atlas::c_text;
use crate::{Fault, Result, SpiralStatus, given, place, results, status::guard, text};
use spiral_atlas::Error;
use spiral_atlas::transition::join::{Family, Objective, Request, State, join};
use spiral_atlas::transition::{Ends, Piece, fit, fitted, stations};
use std::ffi::{CString, c_char};

/// A curve of one or more pieces.
pub struct SpiralCurve {
    /// At least one.
    pieces: Vec<Piece>,
    kind: CString,
    json: CString,
}

/// Several pieces in JSON.
#[derive(serde::Serialize)]
struct Pieces<'a> {
    pieces: &'a [Piece],
}

impl SpiralCurve {
    fn new(pieces: Vec<Piece>) -> Result<SpiralCurve> {
        let (kind, json) = match &pieces[..] {
            [piece] => (piece.kind().name(), serde_json::to_string(piece)),
            pieces => ("path", serde_json::to_string(&Pieces { pieces })),
        };
        let json = json.map_err(|e| Fault(SpiralStatus::SPIRAL_INTERNAL, e.to_string()))?;
        Ok(SpiralCurve { kind: c_text(kind), json: c_text(&json), pieces })
    }
}

/// One end of a curve, in the user's unit of length.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SpiralEnd {
    /// Place along the x axis.
    pub x: f64,
    /// Place along the y axis.
    pub y: f64,
    /// Direction of travel: angle from the x axis, radians, counter-clockwise.
    pub direction: f64,
    /// Signed curvature, 1 / length, positive where the curve turns left.
    pub curvature: f64,
}

/// A point of a curve.
#[repr(C)]
#[derive(Clone, Copy, Default)]
pub struct SpiralStation {
    /// Arc length from the start.
    pub station: f64,
    /// Place along the x axis.
    pub x: f64,
    /// Place along the y axis.
    pub y: f64,
    /// Direction of travel, radians, in [-pi, pi].
    pub heading: f64,
    /// Signed curvature.
    pub curvature: f64,
}

/// What spiral_fit and spiral_join are given: both ends, the name of a kind, and where the curve goes.
///
/// # Safety
/// All are null or valid for as long as `'a`; `kind` ends with a zero byte.
unsafe fn asked<'a>(
    start: *const SpiralEnd,
    end: *const SpiralEnd,
    kind: *const c_char,
    curve: *mut *mut SpiralCurve,
) -> Result<(&'a SpiralEnd, &'a SpiralEnd, &'a str, &'a mut *mut SpiralCurve)> {
    // SAFETY: the caller's promises.
    unsafe { Ok((given(start, "start")?, given(end, "end")?, text_or(kind, "kind", "cubic")?, place(curve, "curve")?)) }
}

/// A text, or what a null pointer stands for.
///
/// # Safety
/// As of [`text`].
unsafe fn text_or<'a>(pointer: *const c_char, name: &str, usual: &'a str) -> Result<&'a str> {
    // SAFETY: the caller's promise.
    if pointer.is_null() { Ok(usual) } else { unsafe { text(pointer, name) } }
}

/// The curve of monotone curvature between two ends anywhere in the plane.
///
/// `kind` is "cubic" (of several spirals the one with the largest margin), "ph-quintic" (that of least bending energy)
/// or "involute" (the image of an involute of a circle, which exists whenever any spiral does); null stands for
/// "cubic". A curve longer than `longest` counts as none; infinity is no limit. SPIRAL_NONE where there is no spiral:
/// the last error says which condition fails.
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
        let (start, end, name, slot) = unsafe { asked(start, end, kind, curve)? };
        let kind = fitted("kind", name)?;
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
        *slot = Box::into_raw(Box::new(SpiralCurve::new(vec![found.solutions.swap_remove(chosen)])?));
        Ok(())
    })
}

/// A path of proved spirals, arcs and lines from one state to another, with continuous curvature that never exceeds
/// `greatest_curvature`, with spirals of the kind "cubic", "ph-quintic", "trig-quintic", "involute" or "clothoid" (null
/// stands for "cubic"): of the joins tried the one that has least of the `objective`, "length", "greatest-curvature",
/// "greatest-rate" (of change of curvature) or "bending-energy" (null stands for "length"). A path longer than
/// `longest`, or of more than `most_pieces` pieces, counts as none; infinity and SIZE_MAX are no limits. SPIRAL_NONE
/// where none was found: the last error says why.
///
/// # Safety
/// `start`, `end`, `kind`, `objective` and `curve` are null or valid; `kind` and `objective` end with a zero byte.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_join(
    start: *const SpiralEnd,
    end: *const SpiralEnd,
    greatest_curvature: f64,
    kind: *const c_char,
    objective: *const c_char,
    longest: f64,
    most_pieces: usize,
    curve: *mut *mut SpiralCurve,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (start, end, name, slot) = unsafe { asked(start, end, kind, curve)? };
        // SAFETY: the caller's promises.
        let objective = Objective::by_name(unsafe { text_or(objective, "objective", "length")? })?;
        let family = Family::by_name(name)?;
        let state = |e: &SpiralEnd| State { point: [e.x, e.y], direction: e.direction, curvature: e.curvature };
        let plain = Request::new(state(start), state(end), greatest_curvature);
        match join(&Request { family, objective, longest, most_pieces, ..plain })? {
            Ok(found) => *slot = Box::into_raw(Box::new(SpiralCurve::new(found.pieces)?)),
            Err(why) => return Err(Fault(SpiralStatus::SPIRAL_NONE, why)),
        }
        Ok(())
    })
}

/// Closes a curve. Null is allowed.
///
/// # Safety
/// `curve` comes from spiral_fit or spiral_join and is not used any more, nor are pointers that it gave.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_curve_close(curve: *mut SpiralCurve) {
    if !curve.is_null() {
        // SAFETY: made by Box::into_raw, and closed once, as the caller promises.
        drop(unsafe { Box::from_raw(curve) });
    }
}

/// "cubic", "ph-quintic", "trig-quintic", "involute", "clothoid", "line" or "arc"; "path" of several pieces; null for a
/// null pointer. It lives as long as the curve.
///
/// # Safety
/// `curve` is null or open.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_curve_kind(curve: *const SpiralCurve) -> *const c_char {
    // SAFETY: the caller's promise.
    unsafe { curve.as_ref() }.map_or(std::ptr::null(), |curve| curve.kind.as_ptr())
}

/// All that rebuilds the curve exactly, in JSON: the piece as `curve` has it, or {"pieces": [..]} of several;
/// null for a null pointer. It lives as long as the curve.
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
    unsafe { curve.as_ref() }.map_or(f64::NAN, |curve| curve.pieces.iter().map(Piece::length).sum())
}

/// Control points: writes at most `room` of them, and always how many there are: 0 for what has none, an involute, a
/// clothoid, a line, an arc, or a curve of several pieces.
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
        let points = match &curve.pieces[..] {
            [piece] => piece.control_points().unwrap_or_default(),
            _ => Vec::new(),
        };
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
pub unsafe extern "C" fn spiral_curve_stations(
    curve: *const SpiralCurve,
    out: *mut SpiralStation,
    count: usize,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (curve, out) = unsafe {
            place(out, "out")?;
            (given(curve, "curve")?, results(out, count, "out")?)
        };
        let found = stations(&curve.pieces, count).map_err(|e: Error| Fault::from(e))?;
        for (slot, at) in out.iter_mut().zip(found) {
            *slot =
                SpiralStation { station: at.station, x: at.x, y: at.y, heading: at.heading, curvature: at.curvature };
        }
        Ok(())
    })
}
