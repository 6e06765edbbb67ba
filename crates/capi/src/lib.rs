//! The C interface of Spiral Atlas. `include/spiral_atlas.h` is made of these items by cbindgen.
//!
//! Each function is a thin, checked layer over the library: it turns pointers into references and slices, calls, and
//! turns the result into a status. `guard` holds panics back.

mod answer;
mod atlas;
mod cells;
mod curve;
mod path;
mod question;
mod status;

pub use answer::*;
pub use atlas::*;
pub use cells::*;
pub use curve::*;
pub use path::*;
pub use question::*;
pub use status::*;

use std::ffi::{CStr, c_char};
use std::path::PathBuf;

/// What stops a call: a status and its sentence.
pub(crate) struct Fault(SpiralStatus, String);

/// What the inside of a call gives.
pub(crate) type Result<T = ()> = std::result::Result<T, Fault>;

/// The referent of a pointer that must not be null.
///
/// # Safety
/// The pointer is null, or valid for reads of a `T` for as long as `'a`.
pub(crate) unsafe fn given<'a, T>(pointer: *const T, name: &str) -> Result<&'a T> {
    // SAFETY: the caller's promise.
    unsafe { pointer.as_ref() }
        .ok_or_else(|| Fault(SpiralStatus::SPIRAL_ARGUMENT, format!("`{name}` is a null pointer")))
}

/// Where a result goes, which must not be null.
///
/// # Safety
/// The pointer is null, or valid for writes of a `T` for as long as `'a`, and nothing else refers there meanwhile.
pub(crate) unsafe fn place<'a, T>(pointer: *mut T, name: &str) -> Result<&'a mut T> {
    // SAFETY: the caller's promise.
    unsafe { pointer.as_mut() }
        .ok_or_else(|| Fault(SpiralStatus::SPIRAL_ARGUMENT, format!("`{name}` is a null pointer")))
}

/// `rows` times `columns` numbers.
///
/// # Safety
/// The pointer is null, or valid for reads of so many `T` for as long as `'a`.
pub(crate) unsafe fn numbers<'a, T>(pointer: *const T, rows: usize, columns: usize, name: &str) -> Result<&'a [T]> {
    let count = length::<T>(rows, columns, name)?;
    if count == 0 {
        return Ok(&[]);
    }
    // SAFETY: not null; as long as the caller promises, and that is less than isize::MAX bytes.
    unsafe { given(pointer, name).map(|first| std::slice::from_raw_parts(first, count)) }
}

/// Where `count` results go; none where the caller does not want them (a null pointer).
///
/// # Safety
/// The pointer is null, or valid for writes of so many `T` for as long as `'a`, and nothing else refers there
/// meanwhile.
pub(crate) unsafe fn results<'a, T>(pointer: *mut T, count: usize, name: &str) -> Result<&'a mut [T]> {
    let count = length::<T>(count, 1, name)?;
    if pointer.is_null() || count == 0 {
        return Ok(&mut []);
    }
    // SAFETY: not null; as long as the caller promises, and that is less than isize::MAX bytes.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
}

/// How many items there are, if any memory could hold so many.
fn length<T>(rows: usize, columns: usize, name: &str) -> Result<usize> {
    let count = rows.checked_mul(columns);
    let fits = |count: &usize| count.checked_mul(size_of::<T>()).is_some_and(|bytes| isize::try_from(bytes).is_ok());
    count.filter(fits).ok_or_else(|| {
        Fault(
            SpiralStatus::SPIRAL_ARGUMENT,
            format!("`{name}` cannot have {rows} times {columns} values: no memory holds so many"),
        )
    })
}

/// A text that must be UTF-8.
///
/// # Safety
/// The pointer is null, or a text that ends with a zero byte and is valid for as long as `'a`.
pub(crate) unsafe fn text<'a>(pointer: *const c_char, name: &str) -> Result<&'a str> {
    // SAFETY: not null after `given`; a text, as the caller promises.
    let text = unsafe { CStr::from_ptr(given(pointer, name)?) };
    text.to_str().map_err(|e| Fault(SpiralStatus::SPIRAL_ARGUMENT, format!("`{name}` is no UTF-8: {e}")))
}

/// A path: bytes as they are on Unix, UTF-8 elsewhere.
///
/// # Safety
/// As of [`text`].
pub(crate) unsafe fn path(pointer: *const c_char, name: &str) -> Result<PathBuf> {
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt;
        // SAFETY: not null after `given`; a text, as the caller promises.
        let bytes = unsafe { CStr::from_ptr(given(pointer, name)?) }.to_bytes();
        Ok(std::ffi::OsStr::from_bytes(bytes).into())
    }
    #[cfg(not(unix))]
    // SAFETY: the caller's promise.
    Ok(unsafe { text(pointer, name)? }.into())
}
