//! C² splines through points.

use super::tridiagonal::Tridiagonal;
use super::{complex, finite, pair};
use crate::curve::PhQuintic;
use crate::error::{Error, OTHER_UNIT, Result};
use crate::plain::count;
use num_complex::Complex64;

const ZERO: Complex64 = Complex64::new(0.0, 0.0);
/// Newton steps at most; from a good start it takes less than ten.
const STEPS: usize = 60;
/// Halvings of a step that does not bring the equations nearer, at most.
const HALVINGS: usize = 12;

/// A C² curve of PH quintics, one span between each point and the next, each with the parameter from 0 to 1.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Spline {
    /// In order; each starts exactly at its point.
    pub spans: Vec<PhQuintic>,
    /// Newton steps it took.
    pub steps: usize,
}

/// The C² PH quintic spline through points, in order; open with cubic end spans, or closed.
///
/// Span i has the pre-image `((z₋ + z)/2, z, (z + z₊)/2)`, so neighbours join with C² continuity whatever the z; what
/// remains is `3z₋² + 27z² + 3z₊² + z₋z₊ + 13z₋z + 13zz₊ = 60Δp` for each span, with `z₋ = 2z - z₊` at an open end.
/// Newton's method starts where the middle of each span has the derivative of the ordinary cubic spline.
///
/// # Arguments
/// - `points`: at least 2, or 3 of a closed curve, no two neighbours the same. The last point of a closed curve may
///   repeat the first.
///
/// # Accuracy
/// Through every point exactly; derivatives agree at the joints as far as spans meet their points, to 1e-12 of the
/// span's size.
///
/// # Errors
/// [`Error::Domain`] naming a point that is not finite or coincides with the next, too few points, or that Newton's
/// method did not converge, with the worst span: then there is no curve rather than a wrong one. It is uneven spacing
/// and sharp turns that do this; more points help.
///
/// ```
/// use spiral_atlas::path::spline;
/// let wave = spline(&[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0], [3.0, 1.0]], false)?;
/// assert_eq!((wave.spans.len(), wave.spans[1].start), (3, [1.0, 1.0]));
/// # Ok::<(), spiral_atlas::Error>(())
/// ```
pub fn spline(points: &[[f64; 2]], closed: bool) -> Result<Spline> {
    let points = checked(points, closed)?;
    let chords: Vec<Complex64> = points.windows(2).map(|w| complex(w[1]) - complex(w[0])).collect();
    // In units of the longest chord: nothing overflows or vanishes.
    let unit = chords.iter().map(|c| c.norm()).fold(0.0, f64::max);
    let chords: Vec<Complex64> = chords.iter().map(|c| c / unit).collect();
    let problem = Problem { chords: &chords, close: None };
    let mut z = problem.roots(closed);
    let n = z.len();
    let close = closed.then(|| if (z[n - 1].conj() * z[0]).re < 0.0 { -1.0 } else { 1.0 });
    let problem = Problem { close, ..problem };
    z = problem.smoothed(&z);
    let steps = problem.newton(&mut z)?;
    let root = unit.sqrt();
    let span = |i: usize| {
        let [before, after] = problem.around(&z, i);
        let w = [(before + z[i]) * 0.5, z[i], (z[i] + after) * 0.5];
        PhQuintic::between(points[i], points[i + 1], w.map(|w| pair(w * root)))
    };
    Ok(Spline { spans: (0..n).map(span).collect(), steps })
}

/// The points, of a closed curve with the first again at the end.
fn checked(points: &[[f64; 2]], closed: bool) -> Result<Vec<[f64; 2]>> {
    let fail = |what: String| Err(Error::invalid(format!("spline: {what}")));
    for (i, p) in points.iter().enumerate() {
        finite("spline", &format!("points[{i}]"), p)?;
    }
    let mut all = points.to_vec();
    if closed && points.first() != points.last() {
        all.extend(points.first());
    }
    let (least, kind) =
        if closed { (4, "a closed spline needs at least 3") } else { (2, "an open spline needs at least 2") };
    if all.len() < least {
        return fail(format!("{}; {kind} different ones", count(points.len(), "point")));
    }
    if let Some(i) = all.windows(2).position(|w| w[0] == w[1]) {
        return fail(format!(
            "points[{i}] and points[{}] are both {:?}; drop one of them",
            (i + 1) % points.len(),
            all[i]
        ));
    }
    if let Some(i) = all.windows(2).position(|w| !(w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]).is_finite()) {
        return Err(Error::beyond_doubles(format!("the distance from points[{i}] to the next"), OTHER_UNIT));
    }
    Ok(all)
}

/// The equations: chords of the spans and, of a closed curve, the sign with which z goes on after a round.
struct Problem<'c> {
    chords: &'c [Complex64],
    close: Option<f64>,
}

impl Problem<'_> {
    /// The square roots of the ordinary cubic spline's derivatives in the middle of the spans, at acute angles to each
    /// other.
    fn roots(&self, closed: bool) -> Vec<Complex64> {
        let n = self.chords.len();
        let slopes = slopes(self.chords, closed);
        let mut z: Vec<Complex64> = Vec::with_capacity(n);
        for i in 0..n {
            let middle = 1.5 * self.chords[i] - 0.25 * (slopes[i] + slopes[(i + 1) % slopes.len()]);
            // Where that spline nearly stops, the chord says more.
            let middle = if middle.norm() < 0.05 * self.chords[i].norm() { self.chords[i] } else { middle };
            let root = middle.sqrt();
            let turned = z.last().is_some_and(|last| (last.conj() * root).re < 0.0);
            z.push(if turned { -root } else { root });
        }
        z
    }

    /// The z for which w, in the middle of each span `(z₋ + 6z + z₊)/8`, is the given root.
    fn smoothed(&self, roots: &[Complex64]) -> Vec<Complex64> {
        let n = roots.len();
        let one = Complex64::new(1.0, 0.0);
        let sign = self.close.unwrap_or(0.0);
        let mut system = Tridiagonal { lower: vec![one; n], diagonal: vec![6.0 * one; n], upper: vec![one; n] };
        (system.lower[0], system.upper[n - 1]) = (one * sign, one * sign);
        if self.close.is_none() {
            (system.diagonal[0], system.diagonal[n - 1]) = (8.0 * one, 8.0 * one);
            (system.upper[0], system.lower[n - 1]) = (ZERO, ZERO);
        }
        system.solve(&roots.iter().map(|z| z * 8.0).collect::<Vec<_>>())
    }

    /// z before and after span i.
    fn around(&self, z: &[Complex64], i: usize) -> [Complex64; 2] {
        let n = z.len();
        let at = |j: usize| z.get(j).copied();
        let (before, after) = (i.checked_sub(1).and_then(at), at(i + 1));
        match self.close {
            Some(sign) => [before.unwrap_or(z[n - 1] * sign), after.unwrap_or(z[0] * sign)],
            // A linear pre-image; of a single span, a constant one.
            None => {
                let mirrored = |z: Complex64, other: Option<Complex64>| other.map_or(z, |other| 2.0 * z - other);
                [before.unwrap_or_else(|| mirrored(z[i], after)), after.unwrap_or_else(|| mirrored(z[i], before))]
            }
        }
    }

    /// By how much equation i is missed, and the sum of its terms by size.
    fn residual(&self, z: &[Complex64], i: usize) -> (Complex64, f64) {
        let ([a, b], z) = (self.around(z, i), z[i]);
        let value = 3.0 * (a * a + b * b) + 27.0 * z * z + a * b + 13.0 * z * (a + b) - 60.0 * self.chords[i];
        (value, 60.0 * self.chords[i].norm() + 27.0 * z.norm_sqr() + 10.0 * (a.norm_sqr() + b.norm_sqr()))
    }

    fn residuals(&self, z: &[Complex64]) -> Vec<Complex64> {
        (0..z.len()).map(|i| self.residual(z, i).0).collect()
    }

    fn jacobian(&self, z: &[Complex64]) -> Tridiagonal {
        let n = z.len();
        let mut system = Tridiagonal { lower: vec![ZERO; n], diagonal: vec![ZERO; n], upper: vec![ZERO; n] };
        for i in 0..n {
            let ([a, b], z) = (self.around(z, i), z[i]);
            let (lower, upper) = (6.0 * a + b + 13.0 * z, 6.0 * b + a + 13.0 * z);
            let diagonal = 54.0 * z + 13.0 * (a + b);
            (system.lower[i], system.diagonal[i], system.upper[i]) = (lower, diagonal, upper);
            let wraps = |edge: bool| edge.then_some(self.close);
            match wraps(i == 0) {
                Some(Some(sign)) => system.lower[i] *= sign,
                // z₋ = 2z - z₊, and where there is no z₊ either, z.
                Some(None) => {
                    system.diagonal[i] += if n > 1 { 2.0 * lower } else { lower };
                    system.upper[i] -= lower;
                    system.lower[i] = ZERO;
                }
                None => {}
            }
            match wraps(i + 1 == n) {
                Some(Some(sign)) => system.upper[i] *= sign,
                Some(None) => {
                    system.diagonal[i] += if n > 1 { 2.0 * upper } else { upper };
                    system.lower[i] = if n > 1 { system.lower[i] - upper } else { ZERO };
                    system.upper[i] = ZERO;
                }
                None => {}
            }
        }
        system
    }

    /// Newton's method, with halved steps where a whole one leads away; the number of steps.
    fn newton(&self, z: &mut Vec<Complex64>) -> Result<usize> {
        let norm = |f: &[Complex64]| f.iter().map(|f| f.norm_sqr()).sum::<f64>();
        let mut f = self.residuals(z);
        for step in 1..=STEPS {
            let change = self.jacobian(z).solve(&f);
            let small = change.iter().zip(&*z).all(|(d, z)| d.norm() <= 1e-10 * z.norm());
            let toward = |share: f64| z.iter().zip(&change).map(|(z, d)| z - d * share).collect::<Vec<_>>();
            if small {
                // The error after this step is about the square of its share.
                *z = toward(1.0);
                return self.verified(z, step);
            }
            let before = norm(&f);
            let better = (0..HALVINGS).map(|k| 0.5f64.powi(k as i32)).find_map(|share| {
                let next = toward(share);
                let residuals = self.residuals(&next);
                (norm(&residuals) < before).then_some((next, residuals))
            });
            match better {
                Some(next) => (*z, f) = next,
                None => return self.failed(z, step),
            }
        }
        self.failed(z, STEPS)
    }

    fn verified(&self, z: &[Complex64], steps: usize) -> Result<usize> {
        let met = |i: usize| {
            let (off, size) = self.residual(z, i);
            off.norm() <= 1e-12 * size
        };
        if (0..z.len()).all(met) { Ok(steps) } else { self.failed(z, steps) }
    }

    fn failed(&self, z: &[Complex64], steps: usize) -> Result<usize> {
        let off = |i: usize| self.residual(z, i).0.norm() / (60.0 * self.chords[i].norm());
        let worst = (0..z.len()).max_by(|i, j| off(*i).total_cmp(&off(*j))).unwrap_or_default();
        Err(Error::invalid(format!(
            "spline: Newton's method did not converge in {steps} steps; the span from points[{worst}] misses its end \
             by {:.1e} of its chord (space the points more evenly, or add some where the path turns)",
            off(worst)
        )))
    }
}

/// Derivatives of the ordinary C² cubic spline with these chords at its points: natural ends, or periodic (one less).
fn slopes(chords: &[Complex64], closed: bool) -> Vec<Complex64> {
    let n = chords.len();
    let one = Complex64::new(1.0, 0.0);
    let size = if closed { n } else { n + 1 };
    let mut system = Tridiagonal { lower: vec![one; size], diagonal: vec![4.0 * one; size], upper: vec![one; size] };
    let chord = |i: usize| chords.get(i).copied().unwrap_or(ZERO);
    let mut right: Vec<Complex64> =
        (0..size).map(|i| 3.0 * (chord(i) + if i > 0 { chord(i - 1) } else { ZERO })).collect();
    if closed {
        right[0] += 3.0 * chords[n - 1];
    } else {
        (system.lower[0], system.upper[n]) = (ZERO, ZERO);
        (system.diagonal[0], system.diagonal[n]) = (2.0 * one, 2.0 * one);
    }
    system.solve(&right)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From hopeless starts there is no curve, and the span is named.
    #[test]
    fn says_when_newton_fails() {
        let chords = [Complex64::new(1.0, 0.0), Complex64::new(0.0, 1.0), Complex64::new(1.0, 0.5)];
        for close in [None, Some(-1.0)] {
            let problem = Problem { chords: &chords, close };
            for start in [0.0, f64::NAN, 1e200] {
                let mut z = vec![Complex64::new(start, 0.0); 3];
                let error = problem.newton(&mut z).expect_err("no start at all").to_string();
                assert!(error.contains("did not converge") && error.contains("points["), "{error}");
            }
            // What it calls a solution is looked at again.
            let mut z = problem.roots(false);
            assert!(problem.newton(&mut z).is_ok() && problem.verified(&z, 1).is_ok());
            z[1] *= 1.0 + 1e-9;
            assert!(problem.verified(&z, 1).is_err());
        }
    }
}
