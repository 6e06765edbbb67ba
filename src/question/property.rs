//! A condition of a family, at points and over boxes.

use crate::error::{Error, Result};
use crate::family::{self, Facts, Family, MOST_SIDES, Region};
use crate::num::Verdict;

/// A flag of a family in one of its charts.
#[derive(Clone, Copy)]
pub struct Property {
    family: &'static dyn Family,
    region: &'static dyn Region,
    chart: usize,
    flag: u8,
}

impl Property {
    /// The flag of this name, of a family in the chart with these axes.
    ///
    /// # Errors
    /// [`Error::Domain`], naming what there is, for an unknown family, chart or flag, and for a family without proofs
    /// over boxes.
    pub fn new(family: &str, axes: &[&str], flag: &str) -> Result<Property> {
        let names = |all: Vec<&str>| all.join(", ");
        let found = family::by_name(family).ok_or_else(|| {
            let all = family::all().iter().map(|f| f.about().name).collect();
            Error::Domain(format!("the family is `{family}`; it must be one of {}", names(all)))
        })?;
        let region = found.region().ok_or_else(|| {
            let all = family::all().iter().filter(|f| f.region().is_some()).map(|f| f.about().name).collect();
            Error::Domain(format!("`{family}` has no proofs over boxes; families that have: {}", names(all)))
        })?;
        let about = found.about();
        let chart = about.charts.iter().position(|c| c.axes == axes && region.covers(c.name)).ok_or_else(|| {
            let all: Vec<String> =
                about.charts.iter().filter(|c| region.covers(c.name)).map(|c| c.axes.join(" ")).collect();
            Error::Domain(format!("the axes are {}; of `{family}` they must be {}", axes.join(" "), all.join(", or ")))
        })?;
        let bit = about.bit(flag).ok_or_else(|| {
            let all = about.flags.iter().map(|f| f.name).collect();
            Error::Domain(format!("the property is `{flag}`; of `{family}` it must be one of {}", names(all)))
        })?;
        Ok(Property { family: found, region, chart, flag: 1 << bit })
    }

    /// The names of its coordinates.
    pub fn axes(&self) -> &'static [&'static str] {
        self.family.about().charts[self.chart].axes
    }

    /// The flag's name.
    pub fn name(&self) -> &'static str {
        self.family.about().flags[self.flag.trailing_zeros() as usize].name
    }

    /// Whether it holds at a point: exact. None outside the family's domain.
    ///
    /// # Errors
    /// [`Error::Undecided`] at the precision cap.
    pub fn at(&self, point: &[f64]) -> Result<Option<bool>> {
        match family::verdict(self.family, self.chart, point) {
            Ok(code) => Ok(Some(code.flags() & self.flag != 0)),
            Err(Error::Domain(_)) => Ok(None),
            Err(other) => Err(other),
        }
    }

    /// Whether it holds all over a box, or nowhere in it.
    pub(super) fn over(&self, cell: &Cell) -> Verdict {
        self.verdict(&self.facts(cell))
    }

    pub(super) fn facts(&self, cell: &Cell) -> Facts {
        let n = self.axes().len();
        self.region.facts(self.chart, &cell.low[..n], &cell.high[..n], self.flag)
    }

    pub(super) fn verdict(&self, facts: &Facts) -> Verdict {
        match (facts.inside & self.flag != 0, facts.outside & self.flag != 0) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    }

    /// Shrinks a box to its part in the family's domain. False where there is none.
    pub(super) fn clip(&self, cell: &mut Cell) -> bool {
        let n = self.axes().len();
        self.region.clip(self.chart, &mut cell.low[..n], &mut cell.high[..n])
    }

    /// Checks a point, and returns it as a box without width.
    ///
    /// # Errors
    /// [`Error::Domain`] for another number of coordinates, or one that is not finite.
    pub(super) fn point(&self, point: &[f64]) -> Result<Cell> {
        let axes = self.axes();
        if point.len() != axes.len() {
            return Err(Error::Domain(format!(
                "the datum has {} coordinates; it must have {}: {}",
                point.len(),
                axes.len(),
                axes.join(", ")
            )));
        }
        let mut cell = Cell::default();
        for (i, (x, axis)) in point.iter().zip(axes).enumerate() {
            if !x.is_finite() {
                return Err(Error::Domain(format!("{axis} is {x}; it must be finite")));
            }
            (cell.low[i], cell.high[i]) = (*x, *x);
        }
        Ok(cell)
    }
}

impl std::fmt::Debug for Property {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} of {}", self.name(), self.family.about().name)
    }
}

/// A closed box; coordinates beyond those of the chart are 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Cell {
    pub low: [f64; MOST_SIDES],
    pub high: [f64; MOST_SIDES],
}

impl Cell {
    /// Where to divide a side: at 0 between opposite signs, at the geometric mean where the ends differ by more than a
    /// factor of 4, else at the arithmetic mean. None where no double lies between the ends.
    pub fn middle(&self, side: usize) -> Option<f64> {
        let (low, high) = (self.low[side], self.high[side]);
        let middle = if low < 0.0 && high > 0.0 {
            0.0
        } else {
            let (small, large) = (low.abs().min(high.abs()), low.abs().max(high.abs()));
            let size = if small == 0.0 {
                // Towards 0 the exponent is doubled, so that a few divisions reach any double.
                if large > 1e-3 { large / 64.0 } else { large * large }
            } else if large > 4.0 * small {
                small.sqrt() * large.sqrt()
            } else {
                small + 0.5 * (large - small)
            };
            if low < 0.0 { -size } else { size }
        };
        (low < middle && middle < high).then_some(middle)
    }

    /// The two parts of the box, divided at `at` along this side.
    pub fn parts(&self, side: usize, at: f64) -> [Cell; 2] {
        let (mut first, mut second) = (*self, *self);
        (first.high[side], second.low[side]) = (at, at);
        [first, second]
    }
}
