//! The path tools: JSON in, JSON out.

use crate::{Fault, Result, SpiralStatus, given, place, status::guard, text};
use spiral_atlas::tools;
use std::ffi::{CString, c_char};

/// What a path tool answered.
pub struct SpiralReport(CString);

/// Answers a request to a path tool: "hermite", "equal-length", "least-curvature", "spline", "plan", "separation" or
/// "measure". `request` is a JSON object with the fields of docs/path.md; the options of the commands are fields too:
/// `minimum` of separation, `samples` and `offset` of measure, `paper` of equal-length. The answer is what the command
/// prints; where there is no path such as was asked for, its `paths` is empty, and its `reason` says why. Close the
/// report with spiral_report_close.
///
/// # Safety
/// `tool` and `request` are null or texts that end with a zero byte; `report` is null or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_path(
    tool: *const c_char,
    request: *const c_char,
    report: *mut *mut SpiralReport,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (tool, request, slot) =
            unsafe { (text(tool, "tool")?, text(request, "request")?, place(report, "report")?) };
        let answer = written(tools::answer(tool, request)?)?;
        *slot = Box::into_raw(Box::new(SpiralReport(answer)));
        Ok(())
    })
}

/// JSON has no zero byte: it is written as \u0000.
fn written(json: String) -> Result<CString> {
    CString::new(json).map_err(|e| Fault(SpiralStatus::SPIRAL_INTERNAL, e.to_string()))
}

/// The answer in JSON. It lives as long as the report, and is null for a null report.
///
/// # Safety
/// `report` is null or comes from spiral_path and is not closed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_report_json(report: *const SpiralReport) -> *const c_char {
    // SAFETY: the caller's promise.
    unsafe { given(report, "report") }.map_or(std::ptr::null(), |report| report.0.as_ptr())
}

/// Closes a report. Null is allowed.
///
/// # Safety
/// `report` comes from spiral_path and is not used any more, nor is its text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_report_close(report: *mut SpiralReport) {
    if !report.is_null() {
        // SAFETY: made by Box::into_raw, and closed once, as the caller promises.
        drop(unsafe { Box::from_raw(report) });
    }
}
