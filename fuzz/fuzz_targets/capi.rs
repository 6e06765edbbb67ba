//! The C interface: any texts and numbers give a status that is no internal fault, and handles whose every part can be
//! read.
#![no_main]

use libfuzzer_sys::arbitrary::{Result, Unstructured};
use libfuzzer_sys::fuzz_target;
use spiral_atlas::transition::join;
use spiral_atlas::{family, tools};
use spiral_atlas_c::*;
use std::ffi::{CString, c_char};
use std::ptr::{null, null_mut};

/// No family has more axes.
const AXES: usize = 8;

/// One of the names, any bytes, or a null pointer.
struct Text(Option<CString>);

impl Text {
    fn one(given: &mut Unstructured, names: &[&str]) -> Result<Text> {
        Ok(Text(match given.int_in_range(0..=15)? {
            0 => None,
            1 => Some(Text::any(given)?),
            _ => CString::new(*given.choose(names)?).ok(),
        }))
    }

    fn any(given: &mut Unstructured) -> Result<CString> {
        let bytes: Vec<u8> = given.arbitrary::<Vec<u8>>()?.into_iter().filter(|byte| *byte != 0).collect();
        Ok(CString::new(bytes).unwrap_or_default())
    }

    fn pointer(&self) -> *const c_char {
        self.0.as_ref().map_or(null(), |text| text.as_ptr())
    }
}

/// A number of ordinary size, or any double.
fn number(given: &mut Unstructured) -> Result<f64> {
    Ok(if given.ratio(3, 4)? { f64::from(given.arbitrary::<i16>()?) / 8192.0 } else { given.arbitrary()? })
}

fn fine(status: SpiralStatus) -> bool {
    assert!(status != SpiralStatus::SPIRAL_INTERNAL, "an internal fault");
    status == SpiralStatus::SPIRAL_OK
}

fn call(given: &mut Unstructured) -> Result<()> {
    let families: Vec<&str> = family::all().iter().map(|family| family.about().name).collect();
    let family = Text::one(given, &families)?;
    let mut datum = [0.0; AXES];
    for x in &mut datum {
        *x = number(given)?;
    }
    // SAFETY: all pointers are null or valid for what is said of them, and handles are closed once.
    unsafe {
        match given.int_in_range(0..=4)? {
            0 => {
                let (mut flags, mut solutions, mut points) = (0, 0, [[0.0; 2]; 8]);
                let room = if given.arbitrary()? { points.as_mut_ptr() } else { null_mut() };
                let (chart, threads) = (Text::one(given, &["paper", "standard"])?, given.int_in_range(0..=2)?);
                fine(spiral_solve_batch(
                    family.pointer(),
                    chart.pointer(),
                    datum.as_ptr(),
                    1,
                    threads,
                    &mut flags,
                    &mut solutions,
                    room,
                ));
            }
            1 => {
                let mut answer = null_mut();
                if fine(spiral_solve(family.pointer(), null(), datum.as_ptr(), &mut answer)) {
                    let (mut number, mut count, mut points) = (0.0, 0, [[0.0; 2]; 8]);
                    let (name, which) = (Text::one(given, &["length", "f0", "curve"])?, given.arbitrary()?);
                    fine(spiral_answer_number(answer, which, name.pointer(), &mut number));
                    fine(spiral_answer_points(answer, which, name.pointer(), points.as_mut_ptr(), 8, &mut count));
                }
                spiral_answer_close(answer);
            }
            2 => {
                let end = |i: usize| SpiralEnd {
                    x: datum[i],
                    y: datum[i + 1],
                    direction: datum[i + 2],
                    curvature: datum[i + 3],
                };
                let (kind, mut curve) = (Text::one(given, &join::Family::ALL.map(join::Family::name))?, null_mut());
                let (joined, limit, longest) = (given.arbitrary()?, number(given)?, number(given)?);
                let least = Text::one(given, &join::Objective::ALL.map(join::Objective::name))?;
                let pieces = given.arbitrary()?;
                let status = if joined {
                    let (kind, least) = (kind.pointer(), least.pointer());
                    spiral_join(&end(0), &end(4), limit, kind, least, longest, pieces, &mut curve)
                } else {
                    spiral_fit(&end(0), &end(4), kind.pointer(), longest, &mut curve)
                };
                if fine(status) {
                    assert!(spiral_curve_length(curve) >= 0.0 && !spiral_curve_json(curve).is_null());
                    let mut stations = vec![SpiralStation::default(); given.int_in_range(0..=64)?];
                    fine(spiral_curve_stations(curve, stations.as_mut_ptr(), stations.len()));
                }
                spiral_curve_close(curve);
            }
            3 => {
                let mut ranges = null_mut();
                let (flag, axis) = (Text::one(given, &["SPIRAL", "EXISTS"])?, given.int_in_range(0..=8)?);
                let (from, to) = (number(given)?, number(given)?);
                let property = (family.pointer(), null(), flag.pointer());
                let (family, chart, flag) = property;
                if fine(spiral_ranges(family, chart, flag, datum.as_ptr(), axis, from, to, &mut ranges)) {
                    let (mut all, mut count) = (null(), 0);
                    assert!(fine(spiral_ranges_data(ranges, &mut all, &mut count, null_mut(), null_mut())));
                }
                spiral_ranges_close(ranges);
            }
            _ => {
                let (tool, request, mut report) = (Text::one(given, &tools::NAMES)?, Text::any(given)?, null_mut());
                if fine(spiral_path(tool.pointer(), request.as_ptr(), &mut report)) {
                    assert!(!spiral_report_json(report).is_null());
                }
                spiral_report_close(report);
            }
        }
    }
    Ok(())
}

fuzz_target!(|bytes: &[u8]| {
    // What runs out of bytes calls nothing.
    let _ = call(&mut Unstructured::new(bytes));
});
