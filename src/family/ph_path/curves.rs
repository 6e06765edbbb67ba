//! The solutions of a datum: at most four pre-images, mirror images left out.
//!
//! With `w0 = √l0 e^(iθ0/2)`, `w2 = ±√l1 e^(iθ1/2)` the ends leave `w1 = (±√Z - 3(w0 + w2))/4`,
//! `Z = 120 - 15w0² - 15w2² + 10w0w2`. A given arc length with equal end speeds z is the same with `l0 = l1 = z`, where
//! z and √Z follow from Farouki et al., (10)-(13): see `curve/equal_length.rs`.

use super::Kind;
use super::datum::{Datum, Symmetry, Turned};
use super::straight;
use crate::curve::hodograph::{Complex, Hodograph};
use crate::num::{Real, formula};
use std::cmp::Ordering::{Equal, Greater, Less};

/// A solution.
#[derive(Debug, Clone)]
pub(super) struct Curve<N> {
    /// All of it.
    pub whole: Hodograph<N>,
    /// Its second half is an image of the first: what is asked of |κ| may be asked of that.
    pub folded: bool,
    /// One of the paper's: `w2` with the positive sign.
    pub paper: bool,
    /// The slope of the curvature is exactly 0 at the end that bends more.
    pub flat: bool,
    /// And that end's curvature, the greatest, is attained once more inside.
    pub tied: bool,
}

/// All solutions that bend, and whether a straight line that stands still nowhere is another.
#[derive(Debug, Clone)]
pub(super) struct Curves<N> {
    pub bent: Vec<Curve<N>>,
    pub straight: bool,
}

/// √Z, and of a symmetric datum on which axis it lies.
enum Root<N> {
    Anywhere(Complex<N>),
    Real(N),
    Imaginary(N),
}

/// The two ends with one sign of w2, and √Z.
struct Ends<N> {
    w: [Complex<N>; 2],
    root: Root<N>,
}

/// A datum in numbers.
struct Given<N> {
    kind: Kind,
    /// Cosine and sine of half of each angle.
    half: [Complex<N>; 2],
    size: [N; 2],
    symmetry: Symmetry,
}

/// The solutions; `None` where the precision does not suffice.
pub(super) fn curves<N: Turned>(datum: &Datum, bits: usize) -> Option<Curves<N>> {
    let half = datum.theta.map(|theta| N::half_turn(theta, bits));
    let size = datum.size.map(|l| N::of(l, bits));
    let given = Given { kind: datum.kind, half, size, symmetry: datum.symmetry() };
    let [l0, l1] = datum.size;
    let equal = l0 == l1;
    let mut all = Curves { bent: Vec::with_capacity(4), straight: false };
    for paper in [true, false] {
        let ends = given.ends(paper)?;
        // With both angles 0 a real w1 makes a line that runs along the chord.
        if let (Symmetry::Line, Root::Real(_)) = (given.symmetry, &ends.root) {
            all.straight |= paper && straight::moves_on(datum.size, bits).decided()?;
            continue;
        }
        // With w0 = a, w2 = -b and w1 = (iv - 3(a - b))/4 the slope at the end of b is in proportion to `a - 2b`.
        let flat = given.symmetry == Symmetry::Line && !paper && (l0 == 4.0 * l1 || l1 == 4.0 * l0);
        // With speeds 4 and 16 it is symmetric about t = 1/3: with p = (t - 1/3)² κ is in proportion to
        // `(3p + 2/3) / (90p² - 14p + 40/9)²`, which rises up to p = 1/9, the start and t = 2/3, and falls from there.
        let tied = flat && l0.max(l1) == 16.0;
        all.bent.extend(solutions(&ends, given.symmetry, equal, paper).map(|curve| Curve { flat, tied, ..curve }));
    }
    Some(all)
}

/// All four solutions of data that numbers enclose, symmetric or not.
///
/// # Arguments
/// - `half`: cosine and sine of half of each angle.
/// - `size`: as of a [`Datum`].
pub(super) fn boxed<N: Real>(kind: Kind, half: [Complex<N>; 2], size: [N; 2]) -> Option<Vec<Curve<N>>> {
    let given = Given { kind, half, size, symmetry: Symmetry::None };
    let mut all = Vec::with_capacity(4);
    for paper in [true, false] {
        all.extend(solutions(&given.ends(paper)?, Symmetry::None, false, paper));
    }
    Some(all)
}

/// The solutions with either sign of √Z, of two mirror images the first.
fn solutions<N: Real>(
    ends: &Ends<N>,
    symmetry: Symmetry,
    equal: bool,
    paper: bool,
) -> impl Iterator<Item = Curve<N>> + use<N> {
    let zero = || N::of(0.0, ends.w[0][0].bits());
    let root = match &ends.root {
        Root::Anywhere(root) => root.clone(),
        Root::Real(u) => [u.clone(), zero()],
        Root::Imaginary(v) => [zero(), v.clone()],
    };
    // Either both are their own images or each is the other's.
    let (folded, mirrored) = match symmetry {
        Symmetry::None => (false, false),
        Symmetry::Arch => {
            let own = paper == matches!(ends.root, Root::Real(_));
            (own, !own)
        }
        Symmetry::Wave => (paper, !paper),
        Symmetry::Line => (equal, true),
    };
    let [w0, w2] = ends.w.clone();
    let signs: &[f64] = if mirrored { &[0.25] } else { &[0.25, -0.25] };
    signs.iter().map(move |sign| {
        let w1 = [0, 1].map(|i| formula!(root[i] * { *sign } - 0.75 * (w0[i] + w2[i])));
        Curve { whole: Hodograph::new([w0.clone(), w1, w2.clone()]), folded, paper, flat: false, tied: false }
    })
}

impl<N: Real> Curve<N> {
    /// What is looked at for |κ|: half of a symmetric curve.
    pub(super) fn part(&self) -> Hodograph<N> {
        if self.folded {
            self.whole.halves().into_iter().next().unwrap_or_else(|| self.whole.clone())
        } else {
            self.whole.clone()
        }
    }
}

impl<N: Real> Given<N> {
    fn ends(&self, paper: bool) -> Option<Ends<N>> {
        let [first, last] = self.half.clone();
        let last = if paper { last } else { last.map(|x| x.times(-1.0)) };
        match self.kind {
            Kind::EqualLength => self.of_length([first, last]),
            Kind::Hermite => self.of_speeds([first, last], paper),
        }
    }

    /// Given end speeds.
    fn of_speeds(&self, half: [Complex<N>; 2], paper: bool) -> Option<Ends<N>> {
        let [l0, l1] = &self.size;
        let (a, b) = (l0.sqrt()?, l1.sqrt()?);
        let [first, last] = half;
        let w = [first.map(|x| formula!(x * a)), last.map(|x| formula!(x * b))];
        let [re, im] = square(&w);
        // Z is real in these cases, exactly.
        let root = match self.symmetry {
            Symmetry::Arch => on_axis(re)?,
            Symmetry::Line => {
                // From the speeds: where their product is a square, the root is exact, and a zero is recognised.
                let across = formula!(l0 * l1).sqrt()?.times(if paper { 10.0 } else { -10.0 });
                on_axis(formula!(across - 15.0 * (l0 + l1) + 120.0))?
            }
            _ => Root::Anywhere(root(&re, &im)),
        };
        Some(Ends { w, root })
    }

    /// A given arc length: (10)-(13), with sums where the paper has differences.
    fn of_length(&self, half: [Complex<N>; 2]) -> Option<Ends<N>> {
        let [[c0, s0], [c1, s1]] = &half;
        let length = &self.size[0];
        let (p0, q0) = (formula!(60.0 * (length + 1.0)), formula!(60.0 * (length - 1.0)));
        // 15x² + 15y² - 10xy.
        let form = |x: &N, y: &N| {
            let apart = formula!(x - y);
            formula!(5.0 * (apart * apart) + 10.0 * (x * x + y * y))
        };
        let g = formula!(5.0 * (c0 * s1 + c1 * s0 - 3.0 * (c0 * s0 + c1 * s1)));
        let (a, b) = (p0.mul(&form(s0, s1)), q0.mul(&form(c0, c1)));
        let (sum, apart, product) = (formula!(a + b), formula!(a - b), formula!(p0 * q0));
        // g = 0 in these cases, exactly.
        let aligned = matches!(self.symmetry, Symmetry::Arch | Symmetry::Line);
        let above = if aligned { apart.certain_sign(0.0)? == Greater } else { apart.approx() >= 0.0 };
        let over = if above { apart } else { apart.times(-1.0) };
        let mixed = if aligned { over.clone() } else { loose_root(&formula!(over * over + 4.0 * (g * g * product))) };
        let whole = formula!(sum + mixed);
        let z = product.times(2.0).over(&whole)?;
        let size = z.sqrt()?;
        let w = half.clone().map(|unit| unit.map(|x| formula!(x * size)));
        let safe = formula!(over + mixed).mul(if above { &p0 } else { &q0 }).over(&whole)?.sqrt();
        let root = match (aligned, above, safe) {
            (true, true, safe) => Root::Real(safe?),
            (true, false, safe) => Root::Imaginary(safe?),
            (false, _, safe) => {
                let parts = safe.and_then(|safe| Some([formula!(g * z).over(&safe)?, safe]));
                Root::Anywhere(match parts {
                    Some([other, safe]) if above => [safe, other],
                    Some(both) => both,
                    None => {
                        let [re, im] = square(&w);
                        root(&re, &im)
                    }
                })
            }
        };
        Some(Ends { w, root })
    }
}

/// Z.
fn square<N: Real>([w0, w2]: &[Complex<N>; 2]) -> Complex<N> {
    let own = |z: &Complex<N>| [formula!(z[0] * z[0] - z[1] * z[1]), formula!(2.0 * (z[0] * z[1]))];
    let across = [formula!(w0[0] * w2[0] - w0[1] * w2[1]), formula!(w0[0] * w2[1] + w0[1] * w2[0])];
    let (s0, s2) = (own(w0), own(w2));
    let [re, im] = [0, 1].map(|i| formula!(10.0 * across[i] - 15.0 * (s0[i] + s2[i])));
    [re.plus(120.0), im]
}

fn on_axis<N: Real>(square: N) -> Option<Root<N>> {
    Some(match square.certain_sign(0.0)? {
        Less => Root::Imaginary(square.times(-1.0).sqrt()?),
        Greater => Root::Real(square.sqrt()?),
        Equal => Root::Real(square),
    })
}

/// A square root of a complex number: of its parts the safe one first. Of numbers around 0, where there is none, all
/// that are small enough.
fn root<N: Real>(re: &N, im: &N) -> Complex<N> {
    let tight = || {
        let size = formula!(re * re + im * im).sqrt()?;
        let real = re.approx() >= 0.0;
        let safe = if real { formula!(size + re) } else { formula!(size - re) }.times(0.5).sqrt()?;
        let other = im.over(&safe.times(2.0))?;
        Some(if real { [safe, other] } else { [other, safe] })
    };
    tight().unwrap_or_else(|| {
        let most = N::of((re.most() + im.most()).sqrt() * (1.0 + 1e-9), re.bits()).size();
        [most.clone(), most]
    })
}

/// The square root of a number that is at least 0, also where that is not certain.
fn loose_root<N: Real>(x: &N) -> N {
    x.sqrt().unwrap_or_else(|| {
        let half = N::of(0.5 * x.most().sqrt() * (1.0 + 1e-9), x.bits());
        half.add(&half.size())
    })
}
