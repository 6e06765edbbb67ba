//! The numbers that a curve is made of, proved in sums of two doubles or, where those leave a rounding open, in
//! intervals.

use super::super::Datum;
use super::super::arc::{Arc, Equation};
use super::half::Half;
use crate::error::Result;
use crate::num::{Angle, Interval, Number, Real, TWIN_BITS, Twin, climb, formula};
use std::cmp::Ordering::Less;

/// All numbers that the curve is made of, rounded.
#[derive(Debug, PartialEq)]
pub(super) struct Numbers {
    pub theta: f64,
    pub t0: f64,
    pub rho: f64,
    pub lambda: f64,
    pub halves: [Half; 2],
}

/// What is asked of the arc: -Q, `-(k1 + sin α)` and ω, without its half turns in `rest`.
struct Wanted<N> {
    q: N,
    room: N,
    rest: N,
    half_turns: u32,
}

/// Whether a number is known to so many bits.
fn thin(x: &Interval, bits: usize) -> bool {
    let width = &x.upper() - &x.lower();
    let allowed = &x.size().upper() * &Interval::power_of_two(-(bits as isize), x.bits());
    width.compare(&allowed) == Some(Less)
}

/// Numbers of which doubles are made.
pub(super) trait Rounded: Angle {
    /// Whether it is known well enough to go on.
    fn is_known(&self) -> bool;
    /// The nearest double, proved; `None` where more digits must decide.
    fn nearest(&self) -> Option<f64>;
    /// A double next to it.
    fn rounded(&self) -> Option<f64>;
}

impl Rounded for Twin {
    /// The roundings decide.
    fn is_known(&self) -> bool {
        true
    }
    fn nearest(&self) -> Option<f64> {
        self.to_f64()
    }
    fn rounded(&self) -> Option<f64> {
        self.to_f64()
    }
}

impl Rounded for Interval {
    fn is_known(&self) -> bool {
        thin(self, 80)
    }
    fn nearest(&self) -> Option<f64> {
        self.to_f64()
    }
    /// That of its middle: sums that cancel are known absolutely, not relatively.
    fn rounded(&self) -> Option<f64> {
        Some(self.approx())
    }
}

/// `r e^(ix)`.
pub(super) fn polar<N: Angle>(r: &N, x: &N) -> [N; 2] {
    let (sin, cos) = x.sine_cosine();
    [formula!(r * cos), formula!(r * sin)]
}

impl Wanted<Twin> {
    fn twins(datum: &Datum, half_turns: u32) -> Option<Wanted<Twin>> {
        let number = |x: f64| Twin::of(x, TWIN_BITS);
        Some(Wanted {
            q: datum.q_of_twins()?.times(-1.0),
            room: Twin::sin_cos(datum.alpha).0.plus(datum.k1).times(-1.0),
            rest: formula!(0.5 * (number(datum.alpha) + number(datum.beta))),
            half_turns,
        })
    }
}

impl Wanted<Interval> {
    /// At a precision that leaves three quarters of `wanted` bits.
    fn new(datum: &Datum, half_turns: u32, bits: usize, wanted: usize) -> Option<Wanted<Interval>> {
        let q = -&datum.q(bits);
        let room = -&(&Interval::new(datum.k1, bits) + &Interval::sin_cos(datum.alpha, bits).0);
        let known = [&q, &room].into_iter().all(|x| thin(x, wanted - wanted / 4));
        // The sum of two doubles comes out to all bits, or to 0.
        known.then(|| Wanted {
            q: q.rounded(wanted),
            room: room.rounded(wanted),
            rest: datum.omega(bits).rounded(wanted),
            half_turns,
        })
    }
}

/// The arc and the map (6) that takes it to the chord, whose factor is `m = ρ e^(iλ)`.
pub(super) struct Map<N> {
    pub arc: Arc<N>,
    half_chord: N,
    /// ω with its half turns.
    omega: N,
    /// `ω + θ`.
    ahead: N,
    pub rho: N,
    pub lambda: N,
}

impl<N: Rounded> Map<N> {
    fn new(datum: &Datum, arc: Arc<N>, wanted: &Wanted<N>) -> Option<Map<N>> {
        let (Arc { theta, sin, p, a, t0, t1, .. }, bits) = (&arc, arc.theta.bits());
        let half_chord = formula!(t0 * sin * (t0 * sin) + p * p).sqrt()?;
        // ρ = (k1* + sin α*)/(k1 + sin α), both negative.
        let rho = formula!(t0 * a + p * sin).over(&formula!(half_chord * t1 * wanted.room))?;
        [theta, t1, &rho, &half_chord].into_iter().all(N::is_known).then_some(())?;
        // λ = α - α*, α* = ω + θ; any full turns do.
        let omega = formula!(wanted.rest + N::pi(bits) * { f64::from(wanted.half_turns) });
        let ahead = formula!(omega + theta);
        let lambda = N::of(datum.alpha, bits).sub(&ahead);
        Some(Map { arc, half_chord, omega, ahead, rho, lambda })
    }
}

impl Map<Interval> {
    /// At a precision, with how often the equation was evaluated; `None` where it does not suffice.
    pub(super) fn by_intervals(datum: &Datum, half_turns: u32, bits: usize) -> Option<(Map<Interval>, usize)> {
        // Differences of the data may take far more bits than the arc does, but sines of two angles only.
        let wanted = |b| if b < bits { None } else { Wanted::new(datum, half_turns, b, bits) };
        let wanted = climb(datum, "Q", wanted).ok()?.0;
        let equation = Equation::new(wanted.q.clone(), wanted.rest.clone(), half_turns);
        Some((Map::new(datum, equation.solve()?, &wanted)?, equation.evaluations()))
    }
}

impl Numbers {
    /// In sums of two doubles, with how often the equation was evaluated; `None` where they leave a rounding open.
    pub(super) fn by_twins(datum: &Datum, half_turns: u32) -> Option<(Numbers, usize)> {
        let wanted = Wanted::twins(datum, half_turns)?;
        let equation = Equation::new(wanted.q, wanted.rest, half_turns);
        let map = Map::new(datum, equation.solve()?, &wanted)?;
        Some((Numbers::new(datum, &map)?, equation.evaluations()))
    }

    /// In intervals, with how often the equation was evaluated and the precision.
    pub(super) fn by_intervals(datum: &Datum, half_turns: u32) -> Result<((Numbers, usize), usize)> {
        climb(datum, "the arc of the involute", |bits| {
            let (map, evaluations) = Map::by_intervals(datum, half_turns, bits)?;
            Some((Numbers::new(datum, &map)?, evaluations))
        })
    }

    fn new<N: Rounded>(datum: &Datum, map: &Map<N>) -> Option<Numbers> {
        let Map { arc: Arc { theta, t0, t1, .. }, half_chord, omega, ahead, rho, lambda } = map;
        let bits = theta.bits();
        let [alpha, beta] = [datum.alpha, datum.beta].map(|x| N::of(x, bits));
        let one = N::of(1.0, bits);
        let inverse = one.over(rho)?;
        // q = (1 - 1/m) e^(iα) at the start, and (1 - m) e^(iβ) at the end, where λ + β = ω - θ up to full turns.
        let factor = |angle: &N, by: &N, other: &N| {
            let ([x, y], [u, v]) = (polar(&one, angle), polar(by, other));
            [formula!(x - u), formula!(y - v)]
        };
        let scale = rho.over(half_chord)?;
        let start = End { side: 1.0, t: t1, scale, q: factor(&alpha, &inverse, ahead) };
        let (last, scale) = (formula!(t0 + theta), inverse.over(half_chord)?);
        let end = End { side: -1.0, t: &last, scale, q: factor(&beta, rho, &formula!(omega - theta)) };
        Some(Numbers {
            theta: theta.nearest()?,
            t0: t0.nearest()?,
            rho: rho.nearest()?.clamp(f64::MIN_POSITIVE, f64::MAX),
            lambda: lambda.nearest()?,
            halves: [start.half(theta, [datum.alpha, datum.k1])?, end.half(theta, [datum.beta, datum.k2])?],
        })
    }
}

/// What a [`Half`] is made of: σ, T, r and q.
struct End<'n, N> {
    side: f64,
    t: &'n N,
    scale: N,
    q: [N; 2],
}

impl<N: Rounded> End<'_, N> {
    fn half(&self, theta: &N, [angle, curvature]: [f64; 2]) -> Option<Half> {
        let End { side, t, scale, q: [x, y] } = self;
        let bits = theta.bits();
        // s, a power of two, from the exponents of r max(1, |q|) and T.
        let exponent = |x: &N| x.magnitude().unwrap_or(isize::MIN / 4);
        let steep = exponent(scale) + exponent(x).max(exponent(y)).max(0);
        let s = (-steep).div_euclid(2).min(-steep - exponent(t)).min(exponent(theta) - 1).min(0);
        let s = N::power_of_two(s as i32, bits);
        let whole = formula!(s + t);
        let unit = formula!(scale * s * whole);
        let reach = theta.over(&s)?;
        let size = formula!(x * x + y * y).sqrt()?;
        Some(Half {
            side: *side,
            t: t.rounded()?,
            theta: theta.rounded()?,
            reach: reach.rounded()?,
            near: t.over(&whole)?.rounded()?,
            far: s.over(&whole)?.rounded()?,
            scale: unit.rounded()?,
            grow: [formula!(unit * x).rounded()?, formula!(unit * y).rounded()?],
            angle,
            bend: formula!(size * theta * reach).rounded()?,
            swing: formula!(x * theta).rounded()?,
            sway: y.rounded()?,
            curvature,
        })
    }
}

/// The datum, or its mirror image, where the rules ask for a curve: Q < 0 and ω > 0.
#[cfg(test)]
pub(super) fn asking(datum: Datum, half_turns: u32) -> Option<Datum> {
    let datum = if datum.k1 < datum.k2 { datum } else { datum.mirrored() };
    let omega = datum.omega(128).approx() + std::f64::consts::PI * f64::from(half_turns);
    let asks = datum.k1 != datum.k2 && omega > 1e-320 && datum.q(640).sign() == Some(Less);
    asks.then_some(datum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;
    use std::f64::consts::FRAC_PI_2;
    use std::f64::consts::PI;

    /// Both rungs beside each other: how many data there were, and of how many the first rung gave the numbers.
    #[derive(Debug, Default)]
    struct Compared {
        all: usize,
        by_twins: usize,
        evaluations: usize,
    }

    impl Compared {
        fn case(&mut self, datum: Datum, half_turns: u32) {
            let Some(datum) = asking(datum, half_turns) else { return };
            self.all += 1;
            let Some((twins, evaluations)) = Numbers::by_twins(&datum, half_turns) else { return };
            let ((intervals, _), _) = Numbers::by_intervals(&datum, half_turns).expect("enough bits");
            assert_eq!(twins, intervals, "{datum:?}, {half_turns} half turns");
            self.by_twins += 1;
            self.evaluations = self.evaluations.max(evaluations);
        }
    }

    #[test]
    fn both_rungs_round_alike_on_random_data() {
        let mut noise = Noise(5);
        let mut compared = Compared::default();
        for round in 0..12_000 {
            let wide = 10f64.powf(3.0 * noise.signed());
            let [alpha, beta] = [noise.signed(), noise.signed()].map(|x| if round % 3 == 0 { 0.1 * x } else { PI * x });
            let [k1, k2] = [noise.signed(), noise.signed()].map(|x| wide * x);
            compared.case(Datum { alpha, beta, k1, k2 }, if round % 10 == 0 { 2 } else { 0 });
        }
        println!("{compared:?}");
        assert!(compared.all > 1_500 && compared.by_twins * 100 > compared.all * 99, "{compared:?}");
        assert!(compared.evaluations <= 8, "{compared:?}");
    }

    /// Along and against the chord, half turns, curvatures of 0, equal or nearly, enormous and tiny.
    #[test]
    fn both_rungs_round_alike_where_data_degenerate() {
        const ANGLES: [f64; 9] = [0.0, 1e-300, 1e-16, 1e-8, 1e-3, 0.7, FRAC_PI_2, 3.0, PI];
        const CURVATURES: [f64; 10] = [0.0, 1e-300, 1e-17, 1e-5, 0.3, 0.300000001, 8.0, 1e8, 1e50, 1e100];
        let signed = |all: &[f64]| -> Vec<f64> { all.iter().flat_map(|x| [-x, *x]).collect() };
        let mut compared = Compared::default();
        for alpha in signed(&ANGLES) {
            for beta in signed(&ANGLES).into_iter().flat_map(|x| [x, x - alpha]).filter(|x| x.abs() <= PI) {
                for (i, k1) in signed(&CURVATURES).into_iter().enumerate() {
                    for k2 in signed(&CURVATURES).into_iter().skip(i % 13).step_by(13) {
                        for half_turns in [0, 1, 5] {
                            if half_turns == 0 || i % 5 == 0 {
                                compared.case(Datum { alpha, beta, k1, k2 }, half_turns);
                            }
                        }
                    }
                }
            }
        }
        println!("{compared:?}");
        assert!(compared.all > 2_500 && compared.by_twins * 3 > compared.all, "{compared:?}");
    }

    /// The map is nearly the identity where the ends are those of an arc of the involute itself: λ cancels.
    #[test]
    fn numbers_that_cancel_are_nearest_doubles() {
        let bits = 400;
        let mut small = 0;
        for i in 1..40 {
            let (theta, t0) = (0.03 * f64::from(i), 2.0 + 0.1 * f64::from(i));
            let p = theta.sin() - theta * theta.cos();
            let half = (t0 * theta.sin()).hypot(p);
            let omega = p.atan2(t0 * theta.sin());
            let [k1, k2] = [t0 - theta, t0 + theta].map(|t| -half / t);
            let datum = Datum { alpha: omega + theta, beta: omega - theta, k1, k2 };
            let (numbers, _) = Numbers::by_intervals(&datum, 0).unwrap().0;
            let map = Map::by_intervals(&datum, 0, bits).unwrap().0;
            let truths = [&map.arc.theta, &map.arc.t0, &map.rho, &map.lambda].map(|x| x.to_f64().unwrap());
            assert_eq!([numbers.theta, numbers.t0, numbers.rho, numbers.lambda], truths, "{datum:?}");
            small += usize::from(numbers.lambda.abs() < 1e-14 && numbers.lambda != 0.0);
        }
        assert!(small > 10, "{small}");
    }
}
