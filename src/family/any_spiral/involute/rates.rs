//! dκ/ds against the derivative of the image's curvature as Kurnosenko's map gives it, which knows nothing of Möbius
//! maps' invariants, at any precision.

#[cfg(test)]
mod tests {
    use super::super::super::Datum;
    use super::super::numbers::{Map, Numbers, asking, polar};
    use crate::curve::vector::length;
    use crate::noise::Noise;
    use crate::num::{Interval, climb};
    use std::cmp::Ordering::Less;
    use std::f64::consts::PI;

    type Complex = [Interval; 2];

    fn times(a: &Complex, b: &Complex) -> Complex {
        [&(&a[0] * &b[0]) - &(&a[1] * &b[1]), &(&a[0] * &b[1]) + &(&a[1] * &b[0])]
    }

    fn add(a: &Complex, b: &Complex) -> Complex {
        [0, 1].map(|i| &a[i] + &b[i])
    }

    fn sub(a: &Complex, b: &Complex) -> Complex {
        [0, 1].map(|i| &a[i] - &b[i])
    }

    fn by(a: &Complex, x: &Interval) -> Complex {
        [0, 1].map(|i| &a[i] * x)
    }

    fn over(a: &Complex, b: &Complex) -> Option<Complex> {
        let inverse = Interval::new(1.0, a[0].bits()).over(&square(b))?;
        Some(by(&times(a, &[b[0].clone(), -&b[1]]), &inverse))
    }

    fn square([x, y]: &Complex) -> Interval {
        &x.square() + &y.square()
    }

    /// dκ/ds at u on one of the halves: by t,
    /// `k = (k* - Im(2(m - 1)E/D)) |D|²/(4ρ)`, `D = m(1 + z) + 1 - z`, with `E = e^(iτ*)`, `E' = -iE`, `z' = tE/c`,
    /// `k*' = c/t²`, and `ds = 4ρt/(c|D|²) dt`.
    fn by_the_map(datum: &Datum, half_turns: u32, which: usize, u: f64) -> f64 {
        let attempt = |bits: usize| {
            let (map, _) = Map::by_intervals(datum, half_turns, bits)?;
            let number = |x: f64| Interval::new(x, bits);
            let (theta, first) = (&map.arc.theta, &map.arc.t1);
            let last = &map.arc.t0 + theta;
            let v = &number(u) * theta;
            let t = if which == 0 { first + &v } else { &last - &v };
            let one = [number(1.0), number(0.0)];
            let place = |t: &Interval| times(&[number(1.0), t.clone()], &polar(&number(1.0), &-t));
            let (start, end) = (place(first), place(&last));
            let half = by(&sub(&end, &start), &number(0.5));
            let middle = by(&add(&end, &start), &number(0.5));
            let c = square(&half).sqrt()?;
            let z = over(&sub(&place(&t), &middle), &half)?;
            let e = by(&over(&polar(&number(1.0), &-&t), &half)?, &c);
            let m = polar(&map.rho, &map.lambda);
            let less = sub(&m, &one);
            let d = add(&times(&m, &add(&one, &z)), &sub(&one, &z));
            let d1 = by(&times(&less, &e), &t.over(&c)?);
            let e1 = [e[1].clone(), -&e[0]];
            let two = by(&less, &number(2.0));
            let inside = &-&c.over(&t)? - &over(&times(&two, &e), &d)?[1];
            let turned = times(&two, &sub(&times(&e1, &d), &times(&e, &d1)));
            let inside1 = &c.over(&t.square())? - &over(&turned, &times(&d, &d))?[1];
            let size = square(&d);
            let size1 = (&(&d[0] * &d1[0]) + &(&d[1] * &d1[1])).scale(2.0);
            let k1 = (&(&inside1 * &size) + &(&inside * &size1)).over(&map.rho.scale(4.0))?;
            let speed = (&map.rho.scale(4.0) * &t).over(&(&c * &size))?;
            let rate = k1.over(&speed)?;
            let width = &rate.upper() - &rate.lower();
            let thin = width.compare(&(&rate.size().upper() * &Interval::power_of_two(-60, bits))) == Some(Less);
            thin.then(|| rate.approx())
        };
        climb(datum, "the rate", attempt).unwrap().0
    }

    /// How many rates there were, and the greatest error, relative to the roundings of the speed and 1e-14.
    #[derive(Debug, Default)]
    struct Compared {
        rates: usize,
        worst: f64,
        /// The greatest relative error where the speed has its digits.
        plain: f64,
    }

    impl Compared {
        fn case(&mut self, datum: Datum, half_turns: u32) {
            let Some(datum) = asking(datum, half_turns) else { return };
            let numbers = Numbers::by_intervals(&datum, half_turns).unwrap().0.0;
            for (which, half) in numbers.halves.iter().enumerate() {
                for u in [0.0, 1e-9, 0.01, 0.3, 0.77, 1.0] {
                    let (rate, truth) = (half.rate(u), by_the_map(&datum, half_turns, which, u));
                    if !(1e-250..1e250).contains(&truth) {
                        continue;
                    }
                    let [speed, noise] = half.speed(u, length(half.grow));
                    let wrong = (rate / truth - 1.0).abs();
                    let share = wrong / (1e-14 + 2.0 * noise / speed);
                    if noise < 1e-14 * speed {
                        self.plain = self.plain.max(wrong);
                    }
                    assert!(share < 0.5, "{datum:?}, {half_turns} half turns, {which}, {u}: {rate:e}, not {truth:e}");
                    self.worst = self.worst.max(share);
                    self.rates += 1;
                }
            }
        }
    }

    #[test]
    fn rates_are_derivatives_of_the_curvature() {
        let mut noise = Noise(11);
        let mut compared = Compared::default();
        for round in 0..1500 {
            let wide = 10f64.powf(if round % 5 == 0 { 30.0 } else { 2.0 } * noise.signed());
            let [alpha, beta] = [noise.signed(), noise.signed()].map(|x| if round % 3 == 0 { 0.1 * x } else { PI * x });
            let [k1, k2] = [noise.signed(), noise.signed()].map(|x| wide * x);
            compared.case(Datum { alpha, beta, k1, k2 }, if round % 10 == 0 { 2 } else { 0 });
        }
        println!("{compared:?}");
        assert!(compared.rates > 1_500 && compared.plain < 1e-14, "{compared:?}");
    }

    /// Where t is nearly 0 at the start, next to circles that touch or curvatures that are enormous.
    #[test]
    fn rates_are_derivatives_where_data_degenerate() {
        let mut compared = Compared::default();
        for alpha in [-3.0, -0.7, -1e-8, 0.0, 1e-3, 0.7, PI] {
            for beta in [1e-12 - alpha, 1e-3 - alpha, 0.5 - alpha, 3.0] {
                for k1 in [-1e40, -1e8, -3.0, -0.3, 0.0, 0.2] {
                    for k2 in [0.0, 1e-5, 0.3, 4.0, 1e9, 1e60] {
                        compared.case(Datum { alpha, beta: beta.clamp(-PI, PI), k1, k2 }, 0);
                    }
                }
            }
        }
        println!("{compared:?}");
        assert!(compared.rates > 500 && compared.plain < 1e-14, "{compared:?}");
    }
}
