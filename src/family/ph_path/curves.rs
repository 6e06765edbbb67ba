//! The solutions of a datum: at most four pre-images, mirror images left out.
//!
//! With `w0 = √l0 e^(iθ0/2)`, `w2 = ±√l1 e^(iθ1/2)` the ends leave `w1 = (±√Z - 3(w0 + w2))/4`, `Z = 120 - 15w0² - 15w2² + 10w0w2`. A given
//! arc length with equal end speeds z is the same with `l0 = l1 = z`, where z and √Z follow from (10)-(13): see `path/equal.rs`.

use super::Kind;
use super::arc::{Arc, Complex};
use super::datum::{Datum, Symmetry, Turned};
use super::straight;
use crate::num::Real;
use std::cmp::Ordering::{Equal, Greater, Less};

/// A solution.
#[derive(Debug, Clone)]
pub(super) struct Curve<N> {
    /// All of it.
    pub whole: Arc<N>,
    /// Its second half is an image of the first: what is asked of |κ| may be asked of that.
    pub folded: bool,
    /// One of the paper's: `w2` with the positive sign.
    pub paper: bool,
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

/// The solutions; `None` where the precision does not suffice.
pub(super) fn curves<N: Turned>(datum: &Datum, bits: usize) -> Option<Curves<N>> {
    let half = datum.theta.map(|theta| N::half_turn(theta, bits));
    let symmetry = datum.symmetry();
    let mut all = Curves { bent: Vec::with_capacity(4), straight: false };
    for paper in [true, false] {
        let [first, last] = half.clone();
        let last = if paper { last } else { last.map(|x| x.times(-1.0)) };
        let ends = match datum.kind {
            Kind::EqualLength => of_length(datum, [first, last], symmetry, bits)?,
            Kind::Hermite => of_speeds(datum, [first, last], symmetry, paper, bits)?,
        };
        // With both angles 0 a real w1 makes a line that runs along the chord.
        if let (Symmetry::Line, Root::Real(_)) = (symmetry, &ends.root) {
            all.straight |= paper && straight::moves_on(datum.size, bits)?;
            continue;
        }
        all.bent.extend(solutions(&ends, symmetry, datum, paper));
    }
    Some(all)
}

/// The solutions with either sign of √Z, of two mirror images the first.
fn solutions<N: Real>(ends: &Ends<N>, symmetry: Symmetry, datum: &Datum, paper: bool) -> impl Iterator<Item = Curve<N>> {
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
        Symmetry::Line => (datum.size[0] == datum.size[1], true),
    };
    let [w0, w2] = ends.w.clone();
    let signs: &[f64] = if mirrored { &[0.25] } else { &[0.25, -0.25] };
    signs.iter().map(move |sign| {
        let w1 = [0, 1].map(|i| root[i].times(*sign).sub(&w0[i].add(&w2[i]).times(0.75)));
        Curve { whole: Arc { w: [w0.clone(), w1, w2.clone()], width: 1.0 }, folded, paper }
    })
}

impl<N: Real> Curve<N> {
    /// What is looked at for |κ|: half of a symmetric curve.
    pub fn part(&self) -> Arc<N> {
        if self.folded {
            self.whole.halves().into_iter().next().unwrap_or_else(|| self.whole.clone())
        } else {
            self.whole.clone()
        }
    }
}

/// Given end speeds.
fn of_speeds<N: Real>(datum: &Datum, half: [Complex<N>; 2], symmetry: Symmetry, paper: bool, bits: usize) -> Option<Ends<N>> {
    let [a, b] = datum.size.map(|l| N::of(l, bits).sqrt());
    let (a, b) = (a?, b?);
    let [w0, w2] = [half[0].clone().map(|x| x.mul(&a)), half[1].clone().map(|x| x.mul(&b))];
    let square = |z: &Complex<N>| [z[0].mul(&z[0]).sub(&z[1].mul(&z[1])), z[0].mul(&z[1]).times(2.0)];
    let across = [w0[0].mul(&w2[0]).sub(&w0[1].mul(&w2[1])), w0[0].mul(&w2[1]).add(&w0[1].mul(&w2[0]))];
    let (s0, s2) = (square(&w0), square(&w2));
    let [re, im] = [0, 1].map(|i| across[i].times(10.0).sub(&s0[i].add(&s2[i]).times(15.0)));
    let re = match symmetry {
        // From the speeds, whose product may be a square: then 0 is known as 0.
        Symmetry::Line => {
            let [l0, l1] = datum.size.map(|l| N::of(l, bits));
            let across = l0.mul(&l1).sqrt()?.times(if paper { 10.0 } else { -10.0 });
            across.sub(&l0.add(&l1).times(15.0)).plus(120.0)
        }
        _ => re.plus(120.0),
    };
    // Z is real in these cases, exactly.
    let root = match symmetry {
        Symmetry::Arch | Symmetry::Line => match re.certain_sign(0.0)? {
            Less => Root::Imaginary(re.times(-1.0).sqrt()?),
            Greater => Root::Real(re.sqrt()?),
            Equal => Root::Real(re),
        },
        _ => Root::Anywhere(root(&re, &im)?),
    };
    Some(Ends { w: [w0, w2], root })
}

/// A square root of a complex number: of its parts the safe one first.
fn root<N: Real>(re: &N, im: &N) -> Option<Complex<N>> {
    let size = re.mul(re).add(&im.mul(im)).sqrt()?;
    let part = |sum: N| -> Option<[N; 2]> {
        let safe = sum.times(0.5).sqrt()?;
        let other = im.over(&safe.times(2.0))?;
        Some([safe, other])
    };
    if re.approx() >= 0.0 {
        return part(size.add(re));
    }
    part(size.sub(re)).map(|[v, u]| [u, v])
}

/// A given arc length: (10)-(13), with sums where the paper has differences.
fn of_length<N: Real>(datum: &Datum, half: [Complex<N>; 2], symmetry: Symmetry, bits: usize) -> Option<Ends<N>> {
    let [[c0, s0], [c1, s1]] = &half;
    let length = N::of(datum.size[0], bits);
    let (p0, q0) = (length.plus(1.0).times(60.0), length.plus(-1.0).times(60.0));
    // 15x² + 15y² - 10xy.
    let form = |x: &N, y: &N| {
        let apart = x.sub(y);
        apart.mul(&apart).times(5.0).add(&x.mul(x).add(&y.mul(y)).times(10.0))
    };
    let g = c0.mul(s1).add(&c1.mul(s0)).sub(&c0.mul(s0).add(&c1.mul(s1)).times(3.0)).times(5.0);
    let (a, b) = (p0.mul(&form(s0, s1)), q0.mul(&form(c0, c1)));
    let (sum, apart, product) = (a.add(&b), a.sub(&b), p0.mul(&q0));
    // g = 0 in these cases, exactly.
    let aligned = matches!(symmetry, Symmetry::Arch | Symmetry::Line);
    let above = if aligned { apart.certain_sign(0.0)? == Greater } else { apart.approx() >= 0.0 };
    let over = if above { apart } else { apart.times(-1.0) };
    let root = if aligned { over.clone() } else { over.mul(&over).add(&g.mul(&g).mul(&product).times(4.0)).sqrt()? };
    let whole = sum.add(&root);
    let z = product.times(2.0).over(&whole)?;
    let safe = over.add(&root).mul(if above { &p0 } else { &q0 }).over(&whole)?.sqrt()?;
    let root = match (aligned, above) {
        (true, true) => Root::Real(safe),
        (true, false) => Root::Imaginary(safe),
        (false, _) => {
            let other = g.mul(&z).over(&safe)?;
            Root::Anywhere(if above { [safe, other] } else { [other, safe] })
        }
    };
    let size = z.sqrt()?;
    Some(Ends { w: half.map(|unit| unit.map(|x| x.mul(&size))), root })
}
