//! From axis values to fractions of a picture: cells around nodes, and ticks with labels.

use super::AxisView;
use crate::error::{Error, Result};

/// A stretch of a linear or logarithmic axis. `lo` and `hi` are in the axis's own coordinate: the value or its
/// logarithm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    lo: f64,
    hi: f64,
    log: bool,
}

/// A labelled place on an axis.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    /// Where, as a fraction of the axis.
    pub at: f64,
    /// The number as text.
    pub label: String,
}

/// Room for labels along an axis, in pixels.
pub(super) struct Room<'a> {
    /// Length of the axis.
    pub length: f64,
    /// How far a label may stick out beyond its ends.
    pub slack: f64,
    /// Least gap between labels.
    pub gap: f64,
    /// How much a label takes.
    pub extent: &'a dyn Fn(&str) -> f64,
}

impl Scale {
    /// A scale from `lo` to `hi`, given as values.
    pub(super) fn new(name: &str, lo: f64, hi: f64, log: bool) -> Result<Scale> {
        let scale = if log { Scale { lo: lo.ln(), hi: hi.ln(), log } } else { Scale { lo, hi, log } };
        scale.checked(name)
    }

    fn checked(self, name: &str) -> Result<Scale> {
        let span = self.hi - self.lo;
        if span.is_finite() && span > 0.0 && self.lo.is_finite() {
            return Ok(self);
        }
        Err(Error::invalid(format!(
            "axis `{name}` of the picture runs from {} to {}; it must be finite and increase{}",
            self.value(0.0),
            self.value(1.0),
            if self.log { ", from above 0 on a logarithmic axis" } else { "" }
        )))
    }

    /// Where a value lies: 0 at the low end, 1 at the high end. Not finite for what a logarithmic axis cannot show.
    pub(super) fn fraction(&self, value: f64) -> f64 {
        let u = if self.log { value.ln() } else { value };
        (u - self.lo) / (self.hi - self.lo)
    }

    fn value(&self, fraction: f64) -> f64 {
        let u = self.lo + (self.hi - self.lo) * fraction;
        if self.log { u.exp() } else { u }
    }

    /// The densest ticks whose labels fit; none when not even two do.
    pub(super) fn ticks(&self, room: &Room) -> Vec<Tick> {
        let mut sets = if self.log { self.log_sets() } else { Vec::new() };
        sets.extend(self.linear_sets());
        sets.iter().map(|set| self.label(set, room)).find(|ticks| fits(ticks, room)).unwrap_or_default()
    }

    /// Fractions of the unlabelled ticks: on a logarithmic axis of few decades, the digits 1 to 9 of each.
    pub(super) fn minor_ticks(&self) -> Vec<f64> {
        let (first, last) = self.decades();
        if !self.log || last - first > 9 {
            return Vec::new();
        }
        let all = self.inside((first..=last).flat_map(|k| (1..=9).map(move |n| Number { n, k })).collect());
        all.iter().map(|number| self.fraction(number.value())).collect()
    }

    fn decades(&self) -> (i32, i32) {
        let ten = std::f64::consts::LN_10;
        ((self.lo / ten).floor() as i32, (self.hi / ten).ceil() as i32)
    }

    /// Ticks at 1, 2, 5, then 1, 3, then 1 of each decade, then of every second, fifth, ... decade.
    fn log_sets(&self) -> Vec<Vec<Number>> {
        let (first, last) = self.decades();
        let set = |digits: &[i64], every: i32| {
            let decades = (first..=last).filter(|k| k.rem_euclid(every) == 0);
            self.inside(decades.flat_map(|k| digits.iter().map(move |&n| Number { n, k })).collect())
        };
        let mut sets = vec![set(&[1, 2, 5], 1), set(&[1, 3], 1)];
        sets.retain(|s| s.len() <= 10);
        sets.extend([1, 2, 5, 10, 20, 50, 100].map(|every| set(&[1], every)));
        sets
    }

    /// Ticks at multiples of 1, 2, 5 times a power of ten, from about ten ticks down to two.
    fn linear_sets(&self) -> Vec<Vec<Number>> {
        let (lo, hi) = (self.value(0.0), self.value(1.0));
        let finest = ((hi - lo) / 10.0).log10().floor() as i32;
        let steps = (finest..=finest + 2).flat_map(|k| [1, 2, 5].map(|m| Number { n: m, k }));
        let multiples = |step: Number| {
            let size = step.value();
            // Rounding may have moved an end off its round number.
            let (first, last) = ((lo / size - 1e-9).ceil(), (hi / size + 1e-9).floor());
            // Steps below the resolution of the values, or not of a finite range, make no ticks.
            if !(first.abs().max(last.abs()) < 1e12 && last - first <= 11.0) {
                return Vec::new();
            }
            self.inside((first as i64..=last as i64).map(|i| Number { n: i * step.n, k: step.k }).collect())
        };
        steps.map(multiples).collect()
    }

    fn inside(&self, numbers: Vec<Number>) -> Vec<Number> {
        // Rounding may put the tick of an end a hair outside.
        let shown = |number: &Number| (-1e-9..=1.0 + 1e-9).contains(&self.fraction(number.value()));
        numbers.into_iter().filter(shown).collect()
    }

    fn label(&self, set: &[Number], room: &Room) -> Vec<Tick> {
        // One style for a whole axis: powers of ten as soon as one plain number would be long.
        let plain = set.iter().all(|number| number.is_short());
        let steps_even = set.windows(2).all(|w| w[0].k == w[1].k);
        let ticks = set.iter().map(|number| Tick {
            at: self.fraction(number.value()).clamp(0.0, 1.0),
            label: if plain { number.plain(steps_even) } else { number.scientific() },
        });
        let sticks_out = |tick: &Tick| {
            let (at, half) = (tick.at * room.length, (room.extent)(&tick.label) / 2.0);
            at - half < -room.slack || at + half > room.length + room.slack
        };
        ticks.filter(|tick| !sticks_out(tick)).collect()
    }
}

fn fits(ticks: &[Tick], room: &Room) -> bool {
    let apart = |pair: &[Tick]| {
        let extents = (room.extent)(&pair[0].label) + (room.extent)(&pair[1].label);
        (pair[1].at - pair[0].at) * room.length >= extents / 2.0 + room.gap
    };
    ticks.len() >= 2 && ticks.windows(2).all(apart)
}

/// The decimal number `n 10^k`: ticks are decimal, so their labels need no rounding.
#[derive(Debug, Clone, Copy)]
struct Number {
    n: i64,
    k: i32,
}

impl Number {
    fn value(self) -> f64 {
        // Parsing rounds correctly, which a product with a power does not.
        format!("{}e{}", self.n, self.k).parse().unwrap_or(f64::NAN)
    }

    fn is_short(self) -> bool {
        self.n == 0 || (self.k >= -4 && self.value().abs() < 1e5)
    }

    /// `0.50`, with all decimals of the step when steps are even; else `0.5`.
    fn plain(self, steps_even: bool) -> String {
        let decimals = (-self.k).max(0) as usize;
        let text = if steps_even { format!("{:.decimals$}", self.value()) } else { self.value().to_string() };
        text.replace('-', "−")
    }

    /// `2×10⁻⁵`.
    fn scientific(self) -> String {
        if self.n == 0 {
            return "0".into();
        }
        let digits = self.n.unsigned_abs().to_string();
        let exponent = self.k + digits.len() as i32 - 1;
        let (first, rest) = digits.split_at(1);
        let rest = rest.trim_end_matches('0');
        let sign = if self.n < 0 { "−" } else { "" };
        let power = format!("10{}", superscript(exponent));
        match (first, rest) {
            ("1", "") => format!("{sign}{power}"),
            (_, "") => format!("{sign}{first}×{power}"),
            _ => format!("{sign}{first}.{rest}×{power}"),
        }
    }
}

fn superscript(number: i32) -> String {
    let raised =
        |c: char| c.to_digit(10).map_or('⁻', |d| ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][d as usize]);
    number.to_string().chars().map(raised).collect()
}

/// The cells of an axis: each node owns what is nearer to it than to its neighbours, in the axis's own spacing.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Cells {
    /// From the low edge of the first cell to the high edge of the last.
    pub scale: Scale,
    /// Edges between cells, as fractions; one fewer than cells.
    inner: Vec<f64>,
}

impl Cells {
    /// The cells of an axis; the first and the last are as wide outwards as inwards.
    pub(super) fn new(axis: &AxisView) -> Result<Cells> {
        let (name, values) = (&axis.name, &axis.values);
        let fail = |what: String| Err(Error::invalid(format!("axis `{name}` of the picture {what}")));
        if values.is_empty() {
            return fail("has no values; it must have at least one".into());
        }
        if let Some(bad) = values.iter().find(|v| !v.is_finite() || (axis.log && **v <= 0.0)) {
            return fail(format!(
                "has the value {bad}; it must be finite{}",
                if axis.log { " and above 0" } else { "" }
            ));
        }
        if let Some(pair) = values.windows(2).find(|w| w[0] >= w[1]) {
            return fail(format!("has {} before {}; values must increase", pair[0], pair[1]));
        }
        let u: Vec<f64> = values.iter().map(|v| if axis.log { v.ln() } else { *v }).collect();
        let last = u.len() - 1;
        // A single node has no neighbour to say how wide it is; any width will do.
        let lone = if axis.log { 1.0 } else { u[0].abs().max(1.0) };
        let (low, high) = if last == 0 { (lone, lone) } else { (u[1] - u[0], u[last] - u[last - 1]) };
        let scale = Scale { lo: u[0] - low / 2.0, hi: u[last] + high / 2.0, log: axis.log }.checked(name)?;
        let span = scale.hi - scale.lo;
        let inner = u.windows(2).map(|w| ((w[0] - scale.lo) / 2.0 + (w[1] - scale.lo) / 2.0) / span).collect();
        Ok(Cells { scale, inner })
    }

    /// From the low end to the high one: where cells begin and end, as fractions.
    pub(super) fn borders(&self) -> Vec<f64> {
        [0.0].into_iter().chain(self.inner.iter().copied()).chain([1.0]).collect()
    }

    /// The cell that each of `count` pixels shows at its centre, from the low end up.
    pub(super) fn of_pixels(&self, count: usize) -> Vec<usize> {
        let centre = |pixel: usize| (pixel as f64 + 0.5) / count as f64;
        (0..count).map(|pixel| self.inner.partition_point(|edge| *edge <= centre(pixel))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view(values: &[f64], log: bool) -> AxisView {
        AxisView { name: "a".into(), label: "a".into(), values: values.to_vec(), log }
    }

    fn labels(lo: f64, hi: f64, log: bool, length: f64) -> Vec<String> {
        let extent = |label: &str| label.chars().count() as f64 * 8.0;
        let room = Room { length, slack: 20.0, gap: 8.0, extent: &extent };
        Scale::new("a", lo, hi, log).unwrap().ticks(&room).into_iter().map(|t| t.label).collect()
    }

    #[test]
    fn ticks_are_round_numbers_and_thin_out() {
        assert_eq!(labels(0.0, 1.0, false, 240.0), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(0.0, 1.0, false, 90.0), ["0.0", "0.5", "1.0"]);
        assert_eq!(labels(-2.5e-7, 2.5e-7, false, 500.0), ["−2×10⁻⁷", "−10⁻⁷", "0", "10⁻⁷", "2×10⁻⁷"]);
        assert_eq!(labels(0.1, 100.0, true, 400.0), ["0.1", "0.2", "0.5", "1", "2", "5", "10", "20", "50", "100"]);
        assert_eq!(labels(0.1, 100.0, true, 150.0), ["0.1", "1", "10", "100"]);
        assert_eq!(labels(1e-6, 1e3, true, 300.0), ["10⁻⁶", "10⁻⁴", "10⁻²", "10⁰", "10²"]);
        assert_eq!(labels(3.0, 4.1, true, 200.0), ["3.0", "3.2", "3.4", "3.6", "3.8", "4.0"]);
        assert_eq!(labels(0.0, 1.0, false, 8.0), [""; 0], "no room");
    }

    #[test]
    fn ticks_survive_extreme_ranges() {
        let ranges = [(-1e300, 1e300), (1e-320, 2e-320), (1.0, 1.0 + 1e-15), (1e15, 1e15 + 0.25), (-8e307, 8e307)];
        for (lo, hi) in ranges {
            assert!(labels(lo, hi, false, 500.0).len() <= 12, "{lo} {hi}");
        }
        assert!(labels(1e-300, 1e300, true, 500.0).len() >= 2);
        assert!(Scale::new("a", -f64::MAX, f64::MAX, false).is_err());
        assert!(Scale::new("a", -1.0, 1.0, true).is_err());
        assert!(Scale::new("a", 1.0, 1.0, false).is_err());
    }

    #[test]
    fn cells_end_half_way_in_the_axis_own_spacing() {
        let linear = Cells::new(&view(&[0.0, 1.0, 5.0], false)).unwrap();
        // Edges -0.5, 0.5, 3, 7.
        assert_eq!((linear.scale.value(0.0), linear.scale.value(1.0)), (-0.5, 7.0));
        assert_eq!(linear.of_pixels(15), [0, 0, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2]);
        let log = Cells::new(&view(&[1.0, 4.0, 256.0], true)).unwrap();
        // In powers of two: edges -1, 1, 5, 11.
        assert_eq!(log.of_pixels(12), [0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2]);
        assert_eq!(Cells::new(&view(&[3.0], false)).unwrap().of_pixels(2), [0, 0]);
    }
}
