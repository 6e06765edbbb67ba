//! Whether this thread computes as every proof here assumes.

use crate::error::{Error, Result};
use std::hint::black_box;

/// Refuses to compute where doubles do not follow IEEE 754 with subnormal numbers and rounding to nearest, ties to
/// even. All error bounds rest on that, and a host program may have changed it: some compilers' fast modes do, and
/// plugins for sound.
///
/// Two subnormal numbers have a subnormal sum unless either is taken or given as 0. Of the four directions of rounding
/// only the nearest leaves 1 where a half of its last unit is added, and rounds the same tie up at the next double.
///
/// It takes four loads and three additions: a nanosecond or two.
///
/// # Errors
/// [`Error::Domain`].
#[inline]
pub(crate) fn demand_ieee() -> Result<()> {
    let (least, half) = (black_box(f64::from_bits(1)), black_box(0.5 * f64::EPSILON));
    let (one, next) = (black_box(1.0), black_box(1.0 + f64::EPSILON));
    if least + least > 0.0 && one + half == one && next + half > next { Ok(()) } else { Err(refusal()) }
}

#[cold]
fn refusal() -> Error {
    Error::invalid(
        "this thread's floating-point mode flushes subnormal numbers to zero or does not round to nearest, so that \
         nothing would be proved; reset the mode before the call (fesetenv(FE_DFL_ENV) in C), or call from another \
         thread",
    )
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;
    use std::arch::asm;

    #[test]
    fn other_modes_are_refused() {
        let mut usual = 0u32;
        // SAFETY: the control register of this thread is stored.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut usual) };
        // As it is; flush to zero, denormals are zero, down, up, towards zero.
        for bits in [0, 0x8000, 0x0040, 0x2000, 0x4000, 0x6000] {
            let changed = usual | bits;
            // SAFETY: only documented bits for rounding and subnormal numbers change, and change back.
            unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const changed) };
            let refused = demand_ieee().is_err();
            // SAFETY: as it was.
            unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const usual) };
            assert_eq!(refused, bits != 0, "{bits:#x}");
        }
    }
}
