//! What is proved of all spirals over boxes of both charts.
//!
//! In the cubic's frame, `φ0 = -α`, `φ1 = β`, a spiral of rising curvature exists exactly when `ω = (φ1 - φ0)/2 > 0`,
//! `u = sin φ0 - κ0 > 0`, `v = κ1 - sin φ1 > 0` and `f = u v - sin² ω > 0` (`outer.rs`; κ0 < κ1 follows). One of
//! falling curvature exists exactly when this is so of the mirror image, all four numbers with the other sign. Both
//! exclude each other by the sign of ω.
//!
//! Their signs are proved over a box by forms (`family/outer_region.rs`). Where ω has one sign all over the box, its
//! kind of spiral decides. Where it changes the sign, or touches 0, EXISTS can only be refuted, by refuting both kinds.
//!
//! RISING is a comparison of k1 and k2, and INFLECTION is EXISTS where their signs differ.

use super::{AnySpiral, EXISTS, INFLECTION, RISING};
use crate::family::outer_region::rising;
use crate::family::region::{Facts, MOST_SIDES, Region, clip_side, sides};
use crate::num::Form;
use crate::num::Verdict;
use std::f64::consts::PI;

/// A form in φ0, φ1, κ0, κ1.
type Four = Form<4, 10>;

fn negative([low, high]: [f64; 2]) -> [f64; 2] {
    [-high, -low]
}

/// Whether a spiral of rising curvature exists, wherever `φ0 < φ1`.
fn side(data: [[f64; 2]; 4], pull: &mut [f64; MOST_SIDES]) -> Verdict {
    let forms: [Four; 4] = std::array::from_fn(|i| Four::centred(data[i], i));
    rising(&forms, pull)
}

/// Whether `a < b`, for every a and b of two ranges.
fn below(a: [f64; 2], b: [f64; 2]) -> Verdict {
    Verdict::proved(a[1] < b[0], a[0] >= b[1])
}

/// Whether two numbers have opposite signs.
fn opposite(a: [f64; 2], b: [f64; 2]) -> Verdict {
    let differ = a[1] < 0.0 && b[0] > 0.0 || a[0] > 0.0 && b[1] < 0.0;
    Verdict::proved(differ, (a[0] >= 0.0 || b[1] <= 0.0) && (a[1] <= 0.0 || b[0] >= 0.0))
}

impl Region for AnySpiral {
    fn covers(&self, chart: &str) -> bool {
        super::CHARTS.iter().any(|c| c.name == chart)
    }

    fn clip(&self, _: usize, low: &mut [f64], high: &mut [f64]) -> bool {
        (0..2).all(|side| clip_side(&mut low[side], &mut high[side], -PI, PI))
    }

    fn facts(&self, chart: usize, low: &[f64], high: &[f64], wanted: u8) -> Facts {
        let mut facts = Facts::default();
        let Some([first, phi1, kappa0, kappa1]) = sides(low, high) else { return facts };
        let within = |side: &[f64; 2], most: f64| side.iter().all(|x| x.abs() <= most);
        // Not for NaN either.
        if ![first, phi1].iter().all(|side| within(side, PI))
            || ![kappa0, kappa1].iter().all(|side| within(side, f64::MAX))
        {
            return facts;
        }
        let phi0 = if chart == 0 { negative(first) } else { first };
        let width = |side: [f64; 2]| side[1] - side[0];
        let order = below(kappa0, kappa1);
        facts.note(wanted & RISING, order);
        let signs = opposite(kappa0, kappa1);
        facts.note(wanted & INFLECTION, signs.only_no());
        if wanted & (EXISTS | INFLECTION) & !facts.outside != 0 {
            let data = [phi0, phi1, kappa0, kappa1];
            let mut pull = [0.0; MOST_SIDES];
            let exists = match (below(phi0, phi1), below(phi1, phi0)) {
                (Verdict::Yes, _) => side(data, &mut pull),
                (_, Verdict::Yes) => side(data.map(negative), &mut pull),
                (up, down) => {
                    let refuted = |sign: Verdict, data, pull: &mut _| sign.is_no() || side(data, pull).is_no();
                    let none = refuted(up, data, &mut pull) && refuted(down, data.map(negative), &mut pull);
                    if !none {
                        // The angles alone may part the two.
                        pull[0] += width(phi0);
                        pull[1] += width(phi1);
                    }
                    Verdict::proved(false, none)
                }
            };
            facts.note(wanted & EXISTS, exists);
            facts.note(wanted & INFLECTION & !facts.outside, exists.and(signs));
            facts.pull = pull;
        }
        if wanted & RISING != 0 && order.is_open() || wanted & INFLECTION != 0 && signs.is_open() {
            let size = [kappa0, kappa1].iter().flatten().fold(f64::MIN_POSITIVE, |size, x| size.max(x.abs()));
            facts.pull[2] += width(kappa0) / size;
            facts.pull[3] += width(kappa1) / size;
        }
        facts
    }
}
