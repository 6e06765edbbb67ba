//! A condition of a family, at points and over boxes.

use crate::error::{Error, Result, finite};
use crate::family::{self, Facts, Family, MOST_SIDES, Region};
use crate::num::{Verdict, demand_ieee};

/// A flag of a family in one of its charts.
#[derive(Clone, Copy)]
pub struct Property {
    family: &'static dyn Family,
    region: &'static dyn Region,
    chart: usize,
    flag: u8,
}

impl Property {
    /// The flag of this name, of a family in the chart with these axes; without a name the one that says that what the
    /// family looks for exists, where it has one such flag.
    ///
    /// # Errors
    /// [`Error::Domain`], naming what there is, for an unknown family, chart or flag, and for a family without proofs
    /// over boxes.
    pub fn new<'n>(family: &str, axes: &[&str], flag: impl Into<Option<&'n str>>) -> Result<Property> {
        let family = family::by_name(family)?;
        let (region, chart) = family::proofs(family, axes)?;
        let about = family.about();
        let flag = match (flag.into(), about.yes) {
            (Some(flag), _) => flag,
            (None, [only]) => only,
            (None, several) => {
                return Err(Error::invalid(format!("name the property, such as {}", several.join(" or "))));
            }
        };
        let bit = about.flags.iter().position(|f| f.name.eq_ignore_ascii_case(flag)).ok_or_else(|| {
            let all: Vec<&str> = about.flags.iter().map(|f| f.name).collect();
            let all = all.join(", ");
            Error::invalid(format!("the property is `{flag}`; of `{}` it must be one of {all}", about.name))
        })?;
        Ok(Property { family, region, chart, flag: 1 << bit })
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
        demand_ieee()?;
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
        Verdict::proved(facts.inside & self.flag != 0, facts.outside & self.flag != 0)
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
            return Err(family::wrong_count(point.len(), axes.len()).or(axes.join(", ")));
        }
        let mut cell = Cell::default();
        for (i, (x, axis)) in point.iter().zip(axes).enumerate() {
            finite(*axis, *x)?;
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
    pub(super) fn middle(&self, side: usize) -> Option<f64> {
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
    pub(super) fn parts(&self, side: usize, at: f64) -> [Cell; 2] {
        let (mut first, mut second) = (*self, *self);
        (first.high[side], second.low[side]) = (at, at);
        [first, second]
    }
}
