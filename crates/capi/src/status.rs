//! How a call went, in a number and in words.

use crate::{Fault, Result};
use spiral_atlas::Error;
use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// How a call went.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Eq)]
#[allow(non_camel_case_types, reason = "names as C has them")]
pub enum SpiralStatus {
    /// It succeeded.
    SPIRAL_OK = 0,
    /// There is no such curve or value: an answer, not a mistake. The last error is the reason.
    SPIRAL_NONE = 1,
    /// An argument is a null pointer, no UTF-8, or the like.
    SPIRAL_ARGUMENT = 2,
    /// A number lies outside its domain, or a name is unknown.
    SPIRAL_DOMAIN = 3,
    /// The system refuses to read.
    SPIRAL_IO = 4,
    /// A file is not a valid atlas.
    SPIRAL_FILE = 5,
    /// A verdict is not proved at the precision cap.
    SPIRAL_UNDECIDED = 6,
    /// A fault in the library itself. Please report it.
    SPIRAL_INTERNAL = 7,
}

impl From<Error> for Fault {
    fn from(error: Error) -> Fault {
        let status = match &error {
            Error::NoPath(_) => SpiralStatus::SPIRAL_NONE,
            Error::Io { .. } => SpiralStatus::SPIRAL_IO,
            Error::Atlas { .. } => SpiralStatus::SPIRAL_FILE,
            Error::Undecided { .. } => SpiralStatus::SPIRAL_UNDECIDED,
            _ => SpiralStatus::SPIRAL_DOMAIN,
        };
        Fault(status, error.to_string())
    }
}

impl Fault {
    /// The same of one row of an array.
    pub(crate) fn of_row(row: usize, error: Error) -> Fault {
        let Fault(status, what) = error.into();
        Fault(status, format!("row {row}: {what}"))
    }

    /// A number outside its domain, or an unknown name.
    pub(crate) fn domain(what: impl Into<String>) -> Fault {
        Fault(SpiralStatus::SPIRAL_DOMAIN, what.into())
    }
}

thread_local! {
    static LAST: RefCell<CString> = RefCell::new(CString::default());
}

/// Runs a call: its fault becomes the thread's last error, and a panic stops here.
pub(crate) fn guard(call: impl FnOnce() -> Result) -> SpiralStatus {
    // What a panic leaves behind is never used again but for handles, which are read only.
    let outcome = catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|panic| {
        let what =
            panic.downcast_ref::<String>().cloned().or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned()));
        Err(Fault(SpiralStatus::SPIRAL_INTERNAL, format!("internal fault: {}", what.unwrap_or_default())))
    });
    match outcome {
        Ok(()) => SpiralStatus::SPIRAL_OK,
        Err(Fault(status, what)) => {
            let what = CString::new(what.replace('\0', "\\0")).unwrap_or_default();
            LAST.with(|last| *last.borrow_mut() = what);
            status
        }
    }
}

/// In a sentence, what was wrong with the last call of this thread that did not return SPIRAL_OK. It stays valid until
/// the thread's next such call; it is never null.
#[unsafe(no_mangle)]
pub extern "C" fn spiral_last_error() -> *const c_char {
    LAST.with(|last| last.borrow().as_ptr())
}

/// The library's version, such as "0.1.0".
#[unsafe(no_mangle)]
pub extern "C" fn spiral_version() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    VERSION.as_ptr().cast()
}
