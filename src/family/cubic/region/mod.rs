//! What is proved of the cubic over boxes of (φ0, φ1, κ0, κ1) or of (φ0, φ1, a, k).
//!
//! # How it is done
//! Everything is a form of second order in the four coordinates of the box (`num/form.rs`), which holds its own
//! rounding errors and what it cuts off. So a form with only positive numbers is a proof for every real point of the
//! closed box. Outside the domain nothing is said, and a datum is judged by the module `cubic`: no root where a or k
//! is not positive, no spiral where ANY_SPIRAL fails.
//!
//! - ANY_SPIRAL: closed forms (`family/outer_region.rs`).
//! - SOLVABLE: the signs of 3k - 1, 3a - 1 and Δ, as in the module `cubic`.
//! - A flag that asks for *some* root with a property (SPIRAL, THEOREM31_ANY) holds over the box when one enclosed
//!   root (`root.rs`) lies in the open square and has it, over the whole box. Which root that is does not matter.
//! - It fails over the box when *every* root of every datum fails. For that, all roots must be accounted for.
//!
//! # All roots
//! Of a datum with a, k > 0 take the roots in the square (0, 3)². F' is -1 at x = 0 and at y = 0, and positive on one
//! interval around 1/√a at most. A root with F' > 0 is the *middle* one; there is one at most. A root with F' < 0 and
//! `a x² < 1` is the *left* one: F falls from x = 0 to it, so there is one at most, and it needs F(0) > 0, that is k
//! < 1/3. The *right* one has F' < 0 and `k y² < 1`; it is the left one with x and y exchanged, and needs a < 1/3.
//!
//! An enclosure of F' < 0 and `a x² < 1` may reach below x = 0. Where k < 1/3 it still holds the left root and no
//! other: F is negative far to the left and positive at 0, so its one negative root is met rising. Where k >= 1/3
//! there is no left root, and nothing is said of what the enclosure holds.
//!
//! - Δ > 0, or a and k above 1/3: these three are all roots. A double root has Δ = 0. A root with F' < 0, `a x² >= 1`
//!   and `k y² >= 1` would have a larger x and a larger y than the middle root, which exists here; but y falls with
//!   x.
//! - Δ < 0 and not both above 1/3: no root, or one where a and k are below 1/3. F has two real roots then, one of
//!   them negative and met rising. So a root with F' < 0 is the one.
//! - Δ = 0 inside the box: the roots are the left one and those of a span (`root.rs`), or the same with x and y
//!   exchanged. In the span x itself, within its range, takes the place of the symbol of κ1, on which `y = 3 - a x²`
//!   does not depend (κ0, when exchanged).
//!
//! THEOREM31 is about the smaller root of a solvable datum. k > 1/3 there, so that is the middle one (or the double
//! one, which lies in the span).

mod angles;
mod root;

use super::poly::side;
use super::{ANY_SPIRAL, Cubic, SOLVABLE, SPIRAL, THEOREM31, THEOREM31_ANY};
use crate::family::hermite::clip;
use crate::family::outer_region::{any, facts, rising};
use crate::family::region::{Facts, MOST_SIDES, Region, add_pull, positive, unit_sign};
use crate::num::{Number, Verdict, formula};
use angles::{Angles, Four};
use root::{Root, span};
use std::cell::Cell;

/// Whether a root exists, and Theorem 3.1 and the exact test at it, wherever it exists.
#[derive(Clone, Copy)]
struct Branch {
    exists: Verdict,
    theorem: Verdict,
    spiral: Verdict,
}

impl Branch {
    const ABSENT: Branch = Branch { exists: Verdict::No, theorem: Verdict::No, spiral: Verdict::No };
    const OPEN: Branch = Branch { exists: Verdict::Undecided, theorem: Verdict::Undecided, spiral: Verdict::Undecided };
}

thread_local! {
    /// The last angles: neighbouring boxes share them.
    static LAST: Cell<Option<([[f64; 2]; 2], Angles)>> = const { Cell::new(None) };
}

fn angles_of(phi0: [f64; 2], phi1: [f64; 2]) -> Option<Angles> {
    match LAST.get() {
        Some((key, angles)) if key == [phi0, phi1] => Some(angles),
        _ => {
            let angles = Angles::new(phi0, phi1)?;
            LAST.set(Some(([phi0, phi1], angles)));
            Some(angles)
        }
    }
}

impl Region for Cubic {
    fn covers(&self, chart: &str) -> bool {
        super::CHARTS.iter().any(|c| c.name == chart)
    }

    fn clip(&self, _: usize, low: &mut [f64], high: &mut [f64]) -> bool {
        clip(low, high)
    }

    fn facts(&self, chart: usize, low: &[f64], high: &[f64], wanted: u8) -> Facts {
        // Nothing follows for a and k from the corner that bounds the curvatures.
        let none = if chart == 0 { wanted & (ANY_SPIRAL | SPIRAL | THEOREM31 | THEOREM31_ANY) } else { 0 };
        facts(low, high, none, |sides| prove(chart == 1, sides, wanted))
    }
}

/// ANY_SPIRAL of the chart (a, k): κ0 and κ1 follow from a, k and the angles.
fn any_normalised(sides: &[[f64; 2]; 4]) -> (Verdict, [f64; MOST_SIDES]) {
    let [phi0, phi1, a, k] = *sides;
    let mut pull = [0.0; MOST_SIDES];
    if phi0[0] >= phi1[1] {
        return (Verdict::No, pull);
    }
    let forms = || {
        let angles = angles_of(phi0, phi1)?;
        let (kappa0, kappa1) = (angles.curve0.inverse()?, angles.curve1.inverse()?);
        let [first, second, a, k]: [Four; 4] = std::array::from_fn(|i| Four::centred([phi0, phi1, a, k][i], i));
        Some([first, second, formula!(a * kappa0), formula!(k * kappa1)])
    };
    let known = forms().map_or(Verdict::Undecided, |forms| rising(&forms, &mut pull));
    if phi0[1] < phi1[0] {
        return (known, pull);
    }
    pull[0] += phi0[1] - phi0[0];
    pull[1] += phi1[1] - phi1[0];
    (known.only_no(), pull)
}

fn prove(normalised: bool, sides: &[[f64; 2]; 4], wanted: u8) -> Facts {
    let mut facts = Facts::default();
    let (any, pull) = if normalised { any_normalised(sides) } else { any(sides) };
    facts.note(wanted & ANY_SPIRAL, any);
    if any.is_open() && wanted & ANY_SPIRAL != 0 {
        facts.pull = pull;
    }
    let curves = THEOREM31 | THEOREM31_ANY | SPIRAL;
    if any.is_no() {
        facts.note(wanted & curves, Verdict::No);
    }
    let [phi0, phi1, kappa0, kappa1] = *sides;
    if kappa0[1] <= 0.0 || kappa1[1] <= 0.0 {
        facts.note(wanted & (curves | SOLVABLE), Verdict::No);
    }
    let open = wanted & !(facts.inside | facts.outside);
    if open & (curves | SOLVABLE) == 0 {
        return facts;
    }
    let Some(angles) = angles_of(phi0, phi1) else {
        // Nothing is known of what matters: halve what is widest for its size.
        facts.pull[..4].copy_from_slice(&sides.map(|[low, high]| (high - low) / (low.abs() + high.abs())));
        return facts;
    };
    let ends = [Four::centred(kappa0, 2), Four::centred(kappa1, 3)];
    let data = Data::new(
        angles,
        if normalised { ends } else { [formula!(angles.curve0 * ends[0]), formula!(angles.curve1 * ends[1])] },
    );
    let solvable = data.solvable();
    // What holds of some datum only where it has roots needs both curvatures positive.
    let rooted = kappa0[0] > 0.0 && kappa1[0] > 0.0;
    let sure = |known: Verdict| if rooted { known } else { known.only_no() };
    facts.note(wanted & SOLVABLE, sure(solvable));
    if open & SOLVABLE != 0 && solvable.is_open() {
        data.pull_edges(&mut facts.pull);
    }
    if open & curves != 0 {
        let branches = data.branches(open, any, &mut facts.pull);
        let some = |of: fn(&Branch) -> Verdict| {
            let [left, middle, right] = branches.map(|b| b.exists.and(of(&b)));
            left.or(middle).or(right)
        };
        let first = solvable.and(branches[1].exists).and(branches[1].theorem);
        facts.note(wanted & SPIRAL, sure(any.and(some(|b| b.spiral))));
        facts.note(wanted & THEOREM31_ANY, sure(any.and(some(|b| b.theorem))));
        facts.note(wanted & THEOREM31, sure(any.and(first)));
    }
    facts
}

/// A box, ready for proofs.
struct Data {
    angles: Angles,
    a: Four,
    k: Four,
    /// Whether a and k are above 1/3.
    above: [Verdict; 2],
    /// Whether the middle root exists: Δ > 0, or a and k above 1/3.
    wedge: Verdict,
    delta: Four,
}

impl Data {
    fn new(angles: Angles, [a, k]: [Four; 2]) -> Data {
        let above = [&a, &k].map(|x| positive(&formula!(3.0 * x - 1.0)));
        let ak = formula!(a * k);
        let delta = formula!(ak * (768.0 * ak - 256.0 * (a + k) + 96.0) - 1.0);
        let wedge = if above == [Verdict::Yes; 2] { Verdict::Yes } else { positive(&delta) };
        Data { angles, a, k, above, wedge, delta }
    }

    fn solvable(&self) -> Verdict {
        self.above[1].and(self.wedge)
    }

    /// How much the coordinates move what is open of the case.
    fn pull_edges(&self, pull: &mut [f64; MOST_SIDES]) {
        let edges = [(self.wedge, &self.delta), (self.above[0], &self.a), (self.above[1], &self.k)];
        for (_, form) in edges.iter().filter(|(known, _)| known.is_open()) {
            add_pull(pull, form);
        }
    }

    /// The left, middle and right root; for a lone root the first alone.
    fn branches(&self, open: u8, any: Verdict, pull: &mut [f64; MOST_SIDES]) -> [Branch; 3] {
        let (a, k) = (&self.a, &self.k);
        let below = self.above.map(|above| !above);
        match self.wedge {
            Verdict::Yes => {
                let left = self.branch(below[1], Root::left, open, pull);
                let middle = self.branch(Verdict::Yes, Root::middle, open, pull);
                [left, middle, self.branch(below[0], Root::right, open, pull)]
            }
            Verdict::No => {
                let exists = below[0].and(below[1]);
                [self.branch(exists, Root::lone, open, pull), Branch::ABSENT, Branch::ABSENT]
            }
            // A span proves only that there is no spiral in it.
            Verdict::Undecided if any.is_no() => [Branch::OPEN; 3],
            Verdict::Undecided => {
                let x = span(a, k).map(|range| Four::along(range, 3));
                if let Some(x) = x
                    && self.fails(&x, &formula!(3.0 - a * (x * x)))
                {
                    return [self.branch(below[1], Root::left, open, pull), Branch::ABSENT, Branch::ABSENT];
                }
                let y = span(k, a).map(|range| Four::along(range, 2));
                if let Some(y) = y
                    && self.fails(&formula!(3.0 - k * (y * y)), &y)
                {
                    return [Branch::ABSENT, Branch::ABSENT, self.branch(below[0], Root::right, open, pull)];
                }
                self.pull_edges(pull);
                [Branch::OPEN; 3]
            }
        }
    }

    /// One root: `exists` is what is known of it from the case.
    fn branch(
        &self,
        exists: Verdict,
        find: fn(&Four, &Four) -> Option<Root>,
        open: u8,
        pull: &mut [f64; MOST_SIDES],
    ) -> Branch {
        if exists.is_no() {
            return Branch::ABSENT;
        }
        let Some(root) = find(&self.a, &self.k) else {
            self.pull_edges(pull);
            add_pull(pull, &self.a);
            add_pull(pull, &self.k);
            return Branch { exists, ..Branch::OPEN };
        };
        let [start, end] = self.sides(&root.x, &root.y);
        let theorem = half(&start, &root.y).and(half(&end, &root.x));
        if theorem.is_yes() {
            return Branch { exists, theorem, spiral: Verdict::Yes };
        }
        let spiral = monotone(&start, &end, &root.x, &root.y);
        // Theorem 3.1 is sufficient: no spiral, no theorem.
        let theorem = if spiral.is_no() { spiral } else { theorem };
        let undecided = [(SPIRAL, spiral), (THEOREM31_ANY, theorem), (THEOREM31, theorem)];
        if undecided.iter().any(|(flag, known)| open & flag != 0 && known.is_open()) {
            start.iter().chain(&end).filter(|form| positive(form).is_open()).for_each(|form| add_pull(pull, form));
            add_pull(pull, &root.x);
            add_pull(pull, &root.y);
        }
        if exists.is_open() {
            self.pull_edges(pull);
        }
        Branch { exists, theorem, spiral }
    }

    fn sides(&self, x: &Four, y: &Four) -> [[Four; 3]; 2] {
        let Angles { p, r, g0, g1, .. } = &self.angles;
        [side(x, y, p, g0, r), side(y, x, r, g1, p).map(|form| form.times(-1.0))]
    }

    /// Whether no (x, y) of these numbers, both positive, makes a spiral.
    fn fails(&self, x: &Four, y: &Four) -> bool {
        let [start, end] = self.sides(x, y);
        monotone(&start, &end, x, y).is_no()
    }
}

/// One half of Theorem 3.1: `B0 >= 0, B2 >= 0, B1 >= 0 or B1² <= 8 w B0 B2`.
fn half(b: &[Four; 3], w: &Four) -> Verdict {
    let outer = positive(&b[0]).and(positive(&b[2]));
    if outer.is_no() {
        return outer;
    }
    let middle = match positive(&b[1]) {
        Verdict::Yes => Verdict::Yes,
        known => known.or(positive(&formula!(8.0 * (b[0] * b[2] * w) - b[1] * b[1]))),
    };
    outer.and(middle)
}

/// Whether the spiral polynomial is positive on [0, 1] all over the box, or negative somewhere on [0, 1] at each
/// place of it.
///
/// x and y are positive at the root that is asked about, wherever there is one. So the sign of B0 or C0, H0 and H5
/// without their squares, says it all when it is negative, also where x or y comes near 0.
fn monotone(start: &[Four; 3], end: &[Four; 3], x: &Four, y: &Four) -> Verdict {
    if positive(&start[0]).is_no() || positive(&end[0]).is_no() {
        return Verdict::No;
    }
    let quintic = [
        formula!(5.0 * (y * y * start[0])),
        formula!(y * start[1]),
        formula!(y * start[2]),
        formula!(x * end[2]),
        formula!(x * end[1]),
        formula!(5.0 * (x * x * end[0])),
    ];
    unit_sign(&quintic)
}
