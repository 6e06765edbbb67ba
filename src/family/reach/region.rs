//! What is proved of reachable end points over boxes of (θ, ξ, η).
//!
//! Everything is a form of second order in the three coordinates (`num/form.rs`), so its sign is a proof for every
//! real point of the box. (a, b), L, g, m, u and c0..c5 are those of `poly.rs`.
//!
//! **The cubic.** With `u = L²/(3a)` and `m = 2bL²/(3a²) - 1`, for a > 0 a segment exists exactly when `2bL² - 3a² >
//! 0`, and c0 has the sign of `27ga³ - L²(9a² + 2bL²)`. Both need no quotient, so they are known where a comes near 0.
//!
//! **The PH quintic.** For a > 0, m rises with u where it is above -3, and `G/u³` rises where `m > -0.37` (`poly.rs`).
//! So a segment exists exactly when `G < 0` at the u0 > 0 of m = 0, that is `αu0² = 24gu0 + 3`. There is none where b
//! is not positive, because G > 0 then for m, u > 0. For c0 >= 0 with m > 0, u is below 1/3 and `α = (3 + m + 24gu)/u²`
//! above 27: c0 fails where `60a <= 27L²`, also where a comes near 0.
//!
//! The root u of G is a form U, a guess, and a number e: where `U - e > 0`, `m > -0.35` and `G < 0` at U - e, and `G >
//! 0` at U + e, all over the box, the one root lies between them at each place of it. U comes from Newton's method in
//! forms with a constant slope, which gains an order with each step.
//!
//! What is said of c0..c3 and of the quintic belongs to a segment, so it counts together with a > 0 and m > 0.

use super::angle::{check, greatest};
use super::filter::least_drawn_m;
use super::poly::{BERNSTEIN, LEAST_M, MONOTONE_M, coefficients, ph_m, ph_sides};
use super::{CASE_BITS, EXACT, EXISTS, Kind, PAPER, Reach, THEOREM};
use crate::family::region::{Facts, MOST_SIDES, Region, add_pull, clip_side, positive, sides, unit_sign};
use crate::num::{Ball, Form, Number, Real, Verdict, formula};

/// A form in θ, ξ, η.
type Three = Form<3, 6>;

/// What depends on the angle alone.
struct Angle {
    g: Three,
    /// L² times a positive number, which for the cubic is 1.
    square: Three,
    /// That number: `cos²(θ/2)` for the PH quintic.
    over: Three,
}

impl Angle {
    fn new(kind: Kind, theta: &Three) -> Angle {
        match kind {
            Kind::Cubic => {
                let sine = theta.sine();
                Angle { g: theta.cosine(), square: formula!(sine * sine), over: Three::of(1.0, 53) }
            }
            Kind::Ph => {
                let half = theta.times(0.5);
                let (sine, cosine) = (half.sine(), half.cosine());
                let g = formula!(cosine * cosine);
                Angle { g, square: formula!(sine * sine), over: g }
            }
        }
    }
}

/// What is known of a case.
struct Case {
    exists: Verdict,
    /// c0 >= 0.
    first: Verdict,
    /// m and u of the segment, where they are known.
    shape: Option<[Three; 2]>,
}

fn cubic(angle: &Angle, a: &Three, b: &Three, pull: &mut [f64; MOST_SIDES]) -> Case {
    let Angle { g, square, .. } = angle;
    let a2 = formula!(a * a);
    let side = formula!(2.0 * (b * square));
    let room = formula!(side - 3.0 * a2);
    let first = formula!(27.0 * (g * (a2 * a)) - square * (9.0 * a2 + side));
    let exists = positive(a).and(positive(&room));
    if exists.is_open() {
        [a, &room].into_iter().filter(|form| positive(form).is_open()).for_each(|form| add_pull(pull, form));
    }
    let first = positive(&first);
    let shape = a.times(3.0).inverse().map(|inverse| {
        let m = formula!(3.0 * (side * inverse * inverse) - 1.0);
        [m, formula!(square * inverse)]
    });
    Case { exists, first, shape: shape.filter(|_| a.low() > 0.0) }
}

fn ph(angle: &Angle, a: &Three, b: &Three, pull: &mut [f64; MOST_SIDES]) -> Case {
    let Angle { g, square, over } = angle;
    let above = positive(a);
    let bound = positive(&formula!(60.0 * (a * over) - 27.0 * square)).only_no();
    if above.is_no() || positive(b).is_no() {
        return Case { exists: Verdict::No, first: Verdict::No, shape: None };
    }
    let whole = || {
        above.is_yes().then_some(())?;
        let scale = over.over(square)?;
        let (alpha, beta) = (formula!(60.0 * (a * scale)), formula!(120.0 * (b * scale)));
        let twelve = g.times(12.0);
        let u0 = formula!(twelve * twelve + 3.0 * alpha).sqrt()?.add(&twelve).over(&alpha)?;
        let (left, right) = ph_sides(&beta, &Three::of(0.0, 53), &u0);
        let room = formula!(right - left);
        let shape = ph_root(&alpha, &beta, g).map(|u| [ph_m(&alpha, g, &u), u]);
        Some((room, shape))
    };
    let Some((room, shape)) = whole() else {
        add_pull(pull, a);
        add_pull(pull, square);
        return Case { exists: Verdict::Undecided, first: bound, shape: None };
    };
    let exists = positive(&room);
    if exists.is_open() || shape.is_none() {
        add_pull(pull, &room);
    }
    let first = match &shape {
        Some([m, u]) if bound.is_open() => positive(&formula!(2.0 - (m + 6.0) * u)),
        _ => bound,
    };
    Case { exists, first, shape }
}

/// The root of G; see the documentation of the module.
fn ph_root(alpha: &Three, beta: &Three, g: &Three) -> Option<Three> {
    let residual = |u: &Three| {
        let (left, right) = ph_sides(beta, &ph_m(alpha, g, u), u);
        formula!(left - right)
    };
    let slope = |u: f64| {
        let m = ph_m(&alpha.value, &g.value, &u);
        let m_slope = 2.0 * alpha.value * u - 24.0 * g.value;
        2.0 * (m + 3.0) - 3.0 * beta.value * u * u + (2.0 * u + 6.0 * m + 3.0) * m_slope
    };
    // In the middle of the box G/u³ rises from m = -1/4 on to the root; so do Newton's steps on G/u³ arrive there.
    let under = 144.0 * g.value * g.value + alpha.value * (3.0 + LEAST_M);
    let mut u = (12.0 * g.value + under.sqrt()) / alpha.value;
    for _ in 0..60 {
        let (left, right) = ph_sides(&beta.value, &ph_m(&alpha.value, &g.value, &u), &u);
        let value = left - right;
        let step = value / (slope(u) - 3.0 * value / u);
        step.is_finite().then_some(())?;
        u = (u - step).clamp(0.5 * u, 2.0 * u);
        if step.abs() < 1e-14 * u {
            break;
        }
    }
    let inverse = 1.0 / slope(u);
    let mut form = Three::ball(Ball { value: u, error: 0.0 });
    for _ in 0..2 {
        // A guess, so what it may be off does not matter.
        form = Form { error: 0.0, ..formula!(form - residual(&form) * { inverse }) };
    }
    let mut reach = 2.0 * residual(&form).most() * inverse.abs() + 1e-15 * u;
    for _ in 0..4 {
        let (low, high) = (form.plus(-reach), form.plus(reach));
        let safe = low.low() > 0.0 && ph_m(alpha, g, &low).low() > MONOTONE_M;
        if safe && residual(&low).high() < 0.0 && residual(&high).low() > 0.0 {
            return Some(form.off(reach));
        }
        reach *= 3.0;
    }
    None
}

/// Whether `m >= m*`. Its double and the sum with the slack are each off by at most a quarter of 2^-52, and the slack
/// is more than half of that.
fn drawn(kind: Kind, m: &Three) -> Verdict {
    let least = least_drawn_m(kind);
    let slack = f64::EPSILON * least;
    Verdict::proved(m.low() > least + slack, m.high() < least - slack)
}

/// The four bits of a case, known to hold and known to fail.
fn judge(kind: Kind, angle: &Angle, a: &Three, b: &Three, wanted: u8, pull: &mut [f64; MOST_SIDES]) -> Facts {
    let mut facts = Facts::default();
    let case = match kind {
        Kind::Cubic => cubic(angle, a, b, pull),
        Kind::Ph => ph(angle, a, b, pull),
    };
    facts.note(wanted & EXISTS, case.exists);
    let rest = wanted & (EXACT | THEOREM | PAPER);
    let first = case.exists.and(case.first);
    if first.is_no() {
        facts.note(rest, first);
        return facts;
    }
    let Some([m, u]) = case.shape.filter(|_| rest != 0) else { return facts };
    let drawn = drawn(kind, &m);
    let c = coefficients(kind, &m, &u, &angle.g, -1.0);
    let signs = [1, 2, 3].map(|i| positive(&c[i]));
    let paper = first.and(drawn);
    // Theorem 2.1 or 3.1 holds in all of the drawn region.
    let theorem = paper.or(first.and(Verdict::all(signs)));
    let quintic = || {
        let mut quintic = c;
        quintic.iter_mut().zip(BERNSTEIN).for_each(|(c, factor)| *c = c.times(factor));
        unit_sign(&quintic)
    };
    let exact = match theorem {
        Verdict::Yes => theorem,
        _ if wanted & EXACT != 0 => first.and(quintic()),
        _ => Verdict::Undecided,
    };
    facts.note(wanted & PAPER, paper);
    // Not exact: no theorem.
    facts.note(wanted & THEOREM, if exact.is_no() { exact } else { theorem });
    facts.note(wanted & EXACT, exact);
    if rest & !(facts.inside | facts.outside) != 0 {
        c.iter().filter(|form| positive(form).is_open()).for_each(|form| add_pull(pull, form));
        add_pull(pull, &m);
        add_pull(pull, &u);
    }
    facts
}

impl Region for Reach {
    fn covers(&self, _: &str) -> bool {
        true
    }

    fn clip(&self, _: usize, low: &mut [f64], high: &mut [f64]) -> bool {
        clip_side(&mut low[0], &mut high[0], f64::from_bits(1), greatest(self.0).0)
    }

    fn facts(&self, _: usize, low: &[f64], high: &[f64], wanted: u8) -> Facts {
        let kind = self.0;
        let within = |sides: &[[f64; 2]; 3]| {
            sides[0].iter().all(|x| check(kind, *x).is_ok()) && sides.iter().flatten().all(|x| x.is_finite())
        };
        let Some(sides) = sides(low, high).filter(within) else { return Facts::default() };
        let [theta, xi, eta]: [Three; 3] = std::array::from_fn(|i| Three::centred(sides[i], i));
        let angle = Angle::new(kind, &theta);
        let h = formula!(xi * theta.sine() - eta * theta.cosine());
        let mut facts = Facts::default();
        for (case, [a, b]) in [[&eta, &h], [&h, &eta]].into_iter().enumerate() {
            let shift = case as u32 * CASE_BITS;
            let wanted = wanted >> shift & ((1 << CASE_BITS) - 1);
            if wanted != 0 {
                let found = judge(kind, &angle, a, b, wanted, &mut facts.pull);
                facts.inside |= found.inside << shift;
                facts.outside |= found.outside << shift;
            }
        }
        facts
    }
}
