//! In a thread that does not compute as IEEE 754 says, every entry refuses instead of answering wrongly.

use spiral_atlas::curve::PhQuintic;
use spiral_atlas::family::{self, any_spiral, cubic, ph_quintic, reach, trig_quintic};
use spiral_atlas::path::{Directions, Free, Motion, least_curvature, separation};
use spiral_atlas::question::{Property, boundary, nearest, ranges};
use spiral_atlas::{Error, Result};
use std::arch::asm;

/// Runs something with bits of the control register set, which is restored.
fn with_mode<T>(bits: u32, work: impl FnOnce() -> T) -> T {
    let mut usual = 0u32;
    // SAFETY: the control register of this thread is stored.
    unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut usual) };
    let changed = usual | bits;
    // SAFETY: only documented bits for rounding and subnormal numbers change, and change back.
    unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const changed) };
    let result = work();
    // SAFETY: as it was.
    unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const usual) };
    result
}

#[test]
fn every_entry_refuses_other_modes() {
    let (phi0, phi1, kappa0, kappa1) = (0.7, 1.4, 0.4, 4.0);
    let property = Property::new("cubic", &["phi0", "phi1", "kappa0", "kappa1"], "SPIRAL").unwrap();
    let point = [phi0, phi1, kappa0, kappa1];
    let chord = any_spiral::Datum { alpha: -0.7, beta: 1.4, k1: -0.3, k2: 4.0 };
    let shape = trig_quintic::Shape { ratio: 3.0, theta: 1.0, m: 1.0, p: 0.5, q: 0.5 };
    let line = |y: f64| Motion::new([PhQuintic::straight([0.0, y], [1.0, y])], 1.0, 0.0).unwrap();
    let motions = [line(0.0), line(1.0)];
    let directions = Directions {
        start: [0.0, 0.0],
        end: [1.0, 0.0],
        start_direction: 1.0,
        end_direction: -2.0,
        greatest_length: 2.0,
        free: Free::Length,
    };
    let entries: [&dyn Fn() -> Result<()>; 10] = [
        &|| family::verdict(&cubic::Cubic, 0, &point).map(drop),
        &|| cubic::solve(&cubic::Datum { phi0, phi1, kappa0, kappa1 }).map(drop),
        &|| ph_quintic::solve(&ph_quintic::Datum { phi0, phi1, kappa0, kappa1 }).map(drop),
        &|| any_spiral::involute(&chord, [0, 0]).map(drop),
        &|| reach::level_of_shape(reach::Kind::Cubic, 0.7, 0.5, 0.5).map(drop),
        &|| trig_quintic::least_ratio(&shape).map(drop),
        &|| ranges(&property, &point, 3, [1.0, 9.0]).map(drop),
        &|| nearest(&property, &point, &[1.0; 4]).map(drop),
        &|| boundary(&property, &point, [2, 3], [[0.1, 0.5], [1.0, 9.0]], 16).map(drop),
        &|| separation(&motions[0], &motions[1], 0.5).map(drop),
    ];
    // Flush to zero, denormals are zero, down, up, towards zero.
    for (i, entry) in entries.iter().enumerate() {
        for bits in [0x8000, 0x0040, 0x2000, 0x4000, 0x6000] {
            let refused = with_mode(bits, || matches!(entry(), Err(Error::Domain(_))));
            assert!(refused, "entry {i}, {bits:#x}");
        }
        assert!(entry().is_ok(), "entry {i}");
    }
    assert!(with_mode(0x8000, || least_curvature(&directions)).is_err());
}
