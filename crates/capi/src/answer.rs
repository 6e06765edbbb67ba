//! Exact answers for one datum or many.

use crate::atlas::mask;
use crate::{Fault, Result, SpiralStatus, given, numbers, place, results, status::guard, text};
use spiral_atlas::family::{self, Answer, Family, Solved, Value, Values, solve_batch, verdicts};
use std::ffi::c_char;

/// All that a family knows of a datum.
pub struct SpiralAnswer(Answer);

/// The family of a name, and its chart: the first where `chart` is null.
///
/// # Safety
/// Both are null or texts that end with a zero byte.
pub(crate) unsafe fn known(family: *const c_char, chart: *const c_char) -> Result<(&'static dyn Family, usize)> {
    // SAFETY: the caller's promise.
    let name = unsafe { text(family, "family")? };
    let family = family::by_name(name)?;
    if chart.is_null() {
        return Ok((family, 0));
    }
    // SAFETY: the caller's promise.
    let name = unsafe { text(chart, "chart")? };
    let chart = family.about().charts.iter().position(|c| c.name == name).ok_or_else(|| {
        let all: Vec<&str> = family.about().charts.iter().map(|c| c.name).collect();
        Fault::domain(format!("`{}` has no chart `{name}`; it has: {}", family.about().name, all.join(", ")))
    })?;
    Ok((family, chart))
}

/// The number of coordinates of a datum. `chart` may be null: the family's first.
///
/// # Safety
/// `family` and `chart` are null or texts that end with a zero byte; `count` is null or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_family_axes(
    family: *const c_char,
    chart: *const c_char,
    count: *mut usize,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let ((family, chart), slot) = unsafe { (known(family, chart)?, place(count, "count")?) };
        *slot = family.about().charts[chart].axes.len();
        Ok(())
    })
}

/// The number of control points of a family's curves; 0 where its curves have none.
///
/// # Safety
/// `family` is null or a text that ends with a zero byte; `count` is null or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_family_control_points(family: *const c_char, count: *mut usize) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let ((family, _), slot) = unsafe { (known(family, std::ptr::null())?, place(count, "count")?) };
        *slot = family.about().control_points;
        Ok(())
    })
}

/// The mask of a family's flag, by name.
///
/// # Safety
/// `family` and `name` are null or texts that end with a zero byte; `mask` is null or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_family_flag(family: *const c_char, name: *const c_char, mask: *mut u8) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let ((family, _), name, slot) =
            unsafe { (known(family, std::ptr::null())?, text(name, "name")?, place(mask, "mask")?) };
        *slot = self::mask(family.about().flags.iter().map(|flag| flag.name), name)?;
        Ok(())
    })
}

/// The proved verdicts of `count` data: flags and packed counts, as an atlas has them at its nodes.
///
/// `threads` are the workers; 0 stands for as many as the machine has cores. A datum outside the family's domain is
/// SPIRAL_DOMAIN and one that is not decided SPIRAL_UNDECIDED; the last error names the first such row, and no result
/// is written.
///
/// `control_points` receives the curves: for each datum as many points as spiral_family_control_points says, those of
/// the chosen curve in the family's frame, or NaN where there is none.
///
/// # Safety
/// `family` and `chart` are null or texts that end with a zero byte (a null `chart` is the family's first); `data`
/// holds `count` rows of as many numbers as the chart has axes; `flags` and `solutions` are null, when they are not
/// wanted, or have room for `count` values; `control_points` is null, when no curves are wanted, or has room for
/// `count` times the family's number of points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_solve_batch(
    family: *const c_char,
    chart: *const c_char,
    data: *const f64,
    count: usize,
    threads: usize,
    flags: *mut u8,
    solutions: *mut u8,
    control_points: *mut [f64; 2],
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (family, chart, data, flags, solutions) = unsafe {
            let (family, chart) = known(family, chart)?;
            let data = numbers(data, count, family.about().charts[chart].axes.len(), "data")?;
            (family, chart, data, results(flags, count, "flags")?, results(solutions, count, "solutions")?)
        };
        let wanted = !control_points.is_null();
        // SAFETY: the caller's promise.
        let points =
            unsafe { results(control_points, count.saturating_mul(family.about().control_points), "control_points")? };
        let cores = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let threads = if threads == 0 { cores() } else { threads.min(4096) };
        let found = if wanted {
            solve_batch(family, chart, data, threads)
        } else {
            verdicts(family, chart, data, threads).map(|codes| Solved { codes, control_points: Vec::new() })
        };
        let Solved { codes, control_points } = found.map_err(|fault| Fault::of_row(fault.row, fault.error))?;
        points.copy_from_slice(&control_points);
        flags.iter_mut().zip(&codes).for_each(|(slot, code)| *slot = code.flags());
        solutions.iter_mut().zip(&codes).for_each(|(slot, code)| *slot = code.counts());
        Ok(())
    })
}

/// The exact answer for one datum, with its curves. Close it with spiral_answer_close.
///
/// # Safety
/// `family` and `chart` are null or texts that end with a zero byte (a null `chart` is the family's first); `datum`
/// holds as many numbers as the chart has axes; `answer` is null or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_solve(
    family: *const c_char,
    chart: *const c_char,
    datum: *const f64,
    answer: *mut *mut SpiralAnswer,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (family, chart, datum, slot) = unsafe {
            let (family, chart) = known(family, chart)?;
            let datum = numbers(datum, 1, family.about().charts[chart].axes.len(), "datum")?;
            (family, chart, datum, place(answer, "answer")?)
        };
        *slot = Box::into_raw(Box::new(SpiralAnswer(family.answer(chart, datum)?)));
        Ok(())
    })
}

/// Closes an answer. Null is allowed.
///
/// # Safety
/// `answer` comes from spiral_solve and is not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_answer_close(answer: *mut SpiralAnswer) {
    if !answer.is_null() {
        // SAFETY: made by Box::into_raw, and closed once, as the caller promises.
        drop(unsafe { Box::from_raw(answer) });
    }
}

/// Flags, packed counts, number of solutions, and index of the chosen one (-1 where there is none).
///
/// # Safety
/// `answer` is null or open; each of the others is null, when it is not wanted, or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_answer_verdict(
    answer: *const SpiralAnswer,
    flags: *mut u8,
    counts: *mut u8,
    solutions: *mut usize,
    chosen: *mut i64,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises; one value each.
        unsafe {
            let Answer { code, solutions: all, chosen: best, .. } = &given(answer, "answer")?.0;
            results(flags, 1, "flags")?.fill(code.flags());
            results(counts, 1, "counts")?.fill(code.counts());
            results(solutions, 1, "solutions")?.fill(all.len());
            results(chosen, 1, "chosen")?.fill(best.map_or(-1, |i| i as i64));
        }
        Ok(())
    })
}

/// The values of a solution, or what else follows from the datum for the index -1.
fn values(answer: &Answer, solution: i64) -> Result<&Values> {
    let index = usize::try_from(solution).ok().and_then(|i| answer.solutions.get(i));
    if solution == -1 { Some(&answer.derived) } else { index }
        .ok_or_else(|| Fault::domain(format!("solution {solution}: there are {}", answer.solutions.len())))
}

/// A number of a solution by its name, as JSON has it (`query --json`): "f0", "margin", "length", ...; a condition is 0
/// or 1. The index -1 stands for what follows from the datum itself. SPIRAL_NONE where there is no such number.
///
/// # Safety
/// `answer` is null or open; `name` is null or a text that ends with a zero byte; `number` is null or valid for a
/// write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_answer_number(
    answer: *const SpiralAnswer,
    solution: i64,
    name: *const c_char,
    number: *mut f64,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises.
        let (answer, name, slot) = unsafe { (given(answer, "answer")?, text(name, "name")?, place(number, "number")?) };
        let values = values(&answer.0, solution)?;
        *slot = values.iter().filter(|(n, _)| *n == name).find_map(|(_, value)| as_number(value)).ok_or_else(|| {
            let all: Vec<&str> = values.iter().filter(|(_, v)| as_number(v).is_some()).map(|(n, _)| *n).collect();
            Fault(SpiralStatus::SPIRAL_NONE, format!("there is no number `{name}`; there are: {}", all.join(", ")))
        })?;
        Ok(())
    })
}

fn as_number(value: &Value) -> Option<f64> {
    match value {
        Value::Number(x) => Some(*x),
        Value::Whole(n) => Some(f64::from(*n)),
        Value::Holds(holds) => Some(f64::from(*holds)),
        Value::Word(_) | Value::Points(_) => None,
    }
}

/// Points of a solution by their name, "control_points" above all, as x, y, x, y, ...: writes at most `room` points,
/// and always how many there are. SPIRAL_NONE where there are none of that name.
///
/// # Safety
/// `answer` is null or open; `name` is null or a text that ends with a zero byte; `xy` is null or has room for
/// `2 * room` numbers; `count` is null or valid for a write.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn spiral_answer_points(
    answer: *const SpiralAnswer,
    solution: i64,
    name: *const c_char,
    xy: *mut [f64; 2],
    room: usize,
    count: *mut usize,
) -> SpiralStatus {
    guard(|| {
        // SAFETY: the caller's promises; a point is two numbers.
        let (answer, name, xy, slot) = unsafe {
            (given(answer, "answer")?, text(name, "name")?, results(xy, room, "xy")?, place(count, "count")?)
        };
        let points = values(&answer.0, solution)?.iter().find_map(|(n, value)| match value {
            Value::Points(points) if *n == name => Some(points),
            _ => None,
        });
        let points = points
            .ok_or_else(|| Fault(SpiralStatus::SPIRAL_NONE, format!("solution {solution} has no points `{name}`")))?;
        *slot = points.len();
        xy.iter_mut().zip(points).for_each(|(slot, point)| *slot = *point);
        Ok(())
    })
}
