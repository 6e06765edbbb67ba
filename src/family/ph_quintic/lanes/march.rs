//! Counting the solutions of a vector of nodes between common knots.

use super::knot::{Equations, Knot};
use crate::family::ph_quintic::factors::ROOM;
use crate::family::ph_quintic::knot::length;
use crate::num::{Ball, Lanes, Real};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, SimdBase};

/// Looks at intervals for one vector: what is open then is cheaper node by node.
const MOST_LOOKS: usize = 48;
/// The outermost knots are at `2^±4` to `2^±32`.
const OUTERMOST: std::ops::RangeInclusive<i32> = 2..=5;

/// Between which t one solution of each lane lies, and what is known there.
#[derive(Clone, Copy)]
pub(super) struct Bracket<S: Simd> {
    /// Lanes that have it.
    pub lanes: u64,
    pub from: S::f64s,
    pub to: S::f64s,
    /// A height and a gap at both ends, for guesses.
    pub z: [S::f64s; 2],
    pub gap: [S::f64s; 2],
    /// |D'| is at least this throughout.
    pub pace: S::f64s,
    /// The first curve's slope is at most this.
    pub steepest: S::f64s,
}

/// All solutions of a vector of nodes.
pub(super) struct Brackets<S: Simd> {
    /// By increasing t.
    pub slots: [Bracket<S>; 3],
    /// How many there are, two bits a lane.
    pub count: [u64; 2],
    /// Lanes where that could not be proved.
    pub open: u64,
}

/// What the certificates prove between two knots.
struct Meeting<S: Simd> {
    once: u64,
    never: u64,
    pace: S::f64s,
}

/// All solutions of the lanes in `posed`. `bent` says that κ0 > 0.
#[inline(always)]
pub(super) fn brackets<S: Simd>(equations: &Equations<S>, posed: u64, bent: bool) -> Brackets<S> {
    let zero = equations.splat(0.0);
    let none = Bracket { lanes: 0, from: zero, to: zero, z: [zero; 2], gap: [zero; 2], pace: zero, steepest: zero };
    let mut found = Brackets { slots: [none; 3], count: [0; 2], open: 0 };
    // From the left: the intervals that reach a lane's first solution, then all between, then those up to its last.
    let (mut waiting, mut a) = outermost(equations, posed, bent, &mut found.open);
    let mut looks = 0;
    while let Some((b, lanes)) = waiting.pop() {
        let lanes = lanes & !found.open;
        let mut open = lanes;
        if lanes != 0 {
            let meeting = meets(equations, &a, &b);
            add(equations, &mut found, &a, &b, &meeting, meeting.once & lanes);
            open = lanes & !(meeting.once | meeting.never);
        }
        if open == 0 {
            a = b;
            continue;
        }
        looks += 1;
        if looks > MOST_LOOKS {
            found.open |= open;
            a = b;
            continue;
        }
        let middle = between(equations, &a, &b, open);
        waiting.push((b, open));
        waiting.push((middle, open));
    }
    found
}

/// The intervals outside of `2^±4`, for those lanes that need them, and the one inside; the last is looked at first.
/// Also the first knot.
///
/// The curves are bounded by their limits: with t falling to 0 both heights rise to those at 0, and so do those of b²
/// with t rising.
#[inline(always)]
fn outermost<S: Simd>(
    equations: &Equations<S>,
    posed: u64,
    bent: bool,
    open: &mut u64,
) -> (Vec<(Knot<S>, u64)>, Knot<S>) {
    let zero = Lanes(equations.splat(0.0));
    let mut intervals = Vec::with_capacity(12);
    // The right side first, from its far end.
    let (mut right, mut reaching) = ([None; 4], posed);
    let reversed = equations.curves.reversed();
    let at_end = reversed.at(&zero);
    let turned = posed & reversed.bend[0].0.simd_gt(zero.0).to_bitmask();
    let limits = [
        equations.lone_height(&at_end[0], reversed.right[0].0, turned),
        equations.lone_height(&at_end[1], reversed.right[1].0, posed),
    ];
    for (exponent, place) in OUTERMOST.zip(&mut right) {
        let t = 2f64.powi(1 << exponent);
        let knot = equations.knot(t, None, reaching);
        let squares = [knot.z[1] * (t * t), knot.z[0] * (t * t)];
        let clear = beyond::<S>(squares, knot.off, &limits);
        *place = Some((knot, reaching));
        reaching &= !clear;
        if reaching == 0 {
            break;
        }
    }
    *open |= reaching;
    intervals.extend(right.into_iter().flatten().rev());
    let at_start = equations.curves.at(&zero);
    let limits = [
        equations.lone_height(&at_start[0], equations.curves.right[0].0, if bent { posed } else { 0 }),
        equations.lone_height(&at_start[1], equations.curves.right[1].0, posed),
    ];
    let (mut first, mut reaching): (Option<Knot<S>>, u64) = (None, posed);
    for exponent in OUTERMOST {
        let knot = equations.knot(2f64.powi(-(1 << exponent)), None, reaching);
        let clear = beyond::<S>(knot.z, knot.off, &limits);
        // The interval from this knot to the one before it, which those lanes need that were not clear there.
        if let Some(before) = first {
            intervals.push((before, reaching));
        }
        first = Some(knot);
        reaching &= !clear;
        if reaching == 0 {
            break;
        }
    }
    *open |= reaching;
    let first = first.expect("there are exponents");
    (intervals, first)
}

/// Lanes where the first curve is above the limit of the second, or the second above that of the first.
#[inline(always)]
fn beyond<S: Simd>(heights: [S::f64s; 2], off: S::f64s, limits: &[(S::f64s, S::f64s); 2]) -> u64 {
    let [low, high] = limits;
    let least = |z: S::f64s| z - z * off * ROOM;
    let most = |(z, off): &(S::f64s, S::f64s)| *z + *z * *off * ROOM;
    (least(heights[0]).simd_gt(most(high)) | least(heights[1]).simd_gt(most(low))).to_bitmask()
}

/// A knot between two, near the middle of their logarithms, where symmetric data have no solution.
#[inline(always)]
fn between<S: Simd>(equations: &Equations<S>, a: &Knot<S>, b: &Knot<S>, open: u64) -> Knot<S> {
    let t = if b.t > 1.2 * a.t { (a.t * b.t).sqrt() * 1.037 } else { a.t + 0.469 * (b.t - a.t) };
    // The middle of a cubic with these heights and slopes, in logarithms.
    let eighth = 0.125 * (b.t / a.t - 1.0).min(4.0);
    equations.knot(t, Some([height::<S>(a, b, 0, eighth), height::<S>(a, b, 1, eighth)]), open)
}

/// A height between two knots, about.
#[inline(always)]
fn height<S: Simd>(a: &Knot<S>, b: &Knot<S>, i: usize, eighth: f64) -> S::f64s {
    let bend = (b.s[i] - a.s[i]) * eighth;
    (a.z[i] * b.z[i]).sqrt() * (bend * (bend * 0.5 + 1.0) + 1.0)
}

/// The certificates of the march, for each lane.
#[inline(always)]
fn meets<S: Simd>(equations: &Equations<S>, a: &Knot<S>, b: &Knot<S>) -> Meeting<S> {
    let zero = equations.splat(0.0);
    let quarter = 0.25 * length(&Ball::of(a.t, 53), &Ball::of(b.t, 53));
    let (error_a, error_b) = (equations.gap_error(a), equations.gap_error(b));
    let (slope_a, slope_b) = (equations.slope_error(a), equations.slope_error(b));
    // Gaps above 0, then below.
    let (over_a, over_b) = (a.gap - error_a, b.gap - error_b);
    let (under_a, under_b) = (zero - a.gap - error_a, zero - b.gap - error_b);
    // The tent of the lower curve.
    let reach = |i: usize| (b.s[i] - a.s[i] + (b.s[i] * slope_b + a.s[i] * slope_a) * ROOM) * quarter;
    let (reach0, reach1) = (reach(0), reach(1));
    let above = (over_a.simd_gt(zero), over_b.simd_gt(zero));
    let below = (under_a.simd_gt(zero), under_b.simd_gt(zero));
    let never = (above.0 & above.1 & over_a.simd_gt(reach1) & over_b.simd_gt(reach1))
        | (below.0 & below.1 & under_a.simd_gt(reach0) & under_b.simd_gt(reach0));
    // How much D rises or falls at least.
    let pace = |i: usize, k: usize| a.s[i] - b.s[k] - (a.s[i] * slope_a + b.s[k] * slope_b) * ROOM;
    let pace = pace(1, 0).max(pace(0, 1));
    let monotone = pace.simd_gt(zero);
    let once = monotone & ((above.0 & below.1) | (below.0 & above.1));
    let never = never | (monotone & ((above.0 & above.1) | (below.0 & below.1)));
    Meeting { once: once.to_bitmask(), never: never.to_bitmask(), pace }
}

/// Stores a bracket in the next slot of each lane.
#[inline(always)]
fn add<S: Simd>(
    equations: &Equations<S>,
    found: &mut Brackets<S>,
    a: &Knot<S>,
    b: &Knot<S>,
    meeting: &Meeting<S>,
    lanes: u64,
) {
    if lanes == 0 {
        return;
    }
    let [low, high] = found.count;
    let (from, to) = (equations.splat(a.t), equations.splat(b.t));
    for (slot, here) in found.slots.iter_mut().zip([!low & !high, low & !high, !low & high]) {
        let lanes = lanes & here;
        if lanes == 0 {
            continue;
        }
        let mask = S::mask64s::from_bitmask(equations.simd, lanes);
        slot.lanes |= lanes;
        slot.from = mask.select(from, slot.from);
        slot.to = mask.select(to, slot.to);
        slot.z = [mask.select(a.z[0], slot.z[0]), mask.select(b.z[0], slot.z[1])];
        slot.gap = [mask.select(a.gap.abs(), slot.gap[0]), mask.select(b.gap.abs(), slot.gap[1])];
        slot.pace = mask.select(meeting.pace, slot.pace);
        slot.steepest = mask.select(b.s[0] + b.s[0] * equations.slope_error(b) * ROOM, slot.steepest);
    }
    // A fourth has no room.
    found.open |= lanes & low & high;
    found.count = [low ^ lanes, high | (low & lanes)];
}
