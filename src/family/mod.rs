//! What a family is: axes, flags, counts, scalars, a fast filter, the exact truth, a shader.
//!
//! ARCHITECTURE.md lists what adding one touches; here it is the list in [`all`].

mod answer;
pub mod any_spiral;
mod batch;
mod blocks;
pub mod cubic;
mod hermite;
mod kernel;
mod last;
mod outer;
mod outer_region;
pub mod ph_path;
pub mod ph_quintic;
pub mod reach;
mod record;
mod region;
mod rows;
pub mod trig_quintic;

pub use answer::{Answer, Value, Values};
pub use batch::{RowError, Solved, solve_batch, verdicts};
pub use kernel::{Kernel, Shader, ShaderInputs};
pub use region::{Facts, MOST_SIDES, Region};

use crate::error::{Error, Result};
use crate::grid::{Axis, Grid, Spacing};
use crate::num::demand_ieee;

/// The stored verdicts of one node: flags in the low byte, packed counts in the high byte.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Code(pub u16);

impl Code {
    /// Marks a node whose verdicts are not proved yet. No family uses all flags and all counts, so it cannot be a
    /// verdict.
    pub const UNDECIDED: Code = Code(u16::MAX);

    /// Packs flags and counts.
    pub const fn new(flags: u8, counts: u8) -> Code {
        Code((counts as u16) << 8 | flags as u16)
    }

    /// Itself, where it is no [`Code::UNDECIDED`].
    pub(crate) fn decided(self) -> Option<Code> {
        (self != Code::UNDECIDED).then_some(self)
    }

    /// The `flags` byte of an atlas.
    pub const fn flags(self) -> u8 {
        self.0 as u8
    }

    /// The `solutions` byte of an atlas.
    pub const fn counts(self) -> u8 {
        (self.0 >> 8) as u8
    }
}

/// One named bit of `flags`; its place in [`About::flags`] is its bit number.
#[derive(Debug, Clone, Copy)]
pub struct Flag {
    /// The bit's name in files and JSON.
    pub name: &'static str,
    /// The condition in one line.
    pub doc: &'static str,
    /// A few words for a picture's legend.
    pub label: &'static str,
}

/// One number packed in `solutions`.
#[derive(Debug, Clone, Copy)]
pub struct Count {
    /// The number's name in files and JSON.
    pub name: &'static str,
    /// What is counted.
    pub doc: &'static str,
    /// Lowest bit.
    pub shift: u32,
    /// Number of bits.
    pub bits: u32,
}

impl Count {
    /// Takes the number out of a `solutions` byte.
    pub fn of(&self, solutions: u8) -> u8 {
        unpack(solutions, self.shift, self.bits)
    }
}

/// The number in the bits `shift .. shift + bits` of a byte, whatever the two are.
pub(crate) fn unpack(byte: u8, shift: u32, bits: u32) -> u8 {
    byte.checked_shr(shift).unwrap_or(0) & (u8::MAX.checked_shr(8u32.saturating_sub(bits)).unwrap_or(0))
}

/// One optional f32 field.
#[derive(Debug, Clone, Copy)]
pub struct Scalar {
    /// The field's name.
    pub name: &'static str,
    /// What it is, with range and unit.
    pub doc: &'static str,
}

/// What a scalar field holds where a node has no value: NaN-free, and below every true value of every scalar.
pub const NO_VALUE: f32 = f32::MIN;

/// A set of axes that a family accepts, in grid order.
#[derive(Debug, Clone, Copy)]
pub struct Chart {
    /// The chart's name, recorded in the atlas.
    pub name: &'static str,
    /// Axis names, slowest first.
    pub axes: &'static [&'static str],
    /// What the axes are, with units and conventions.
    pub doc: &'static str,
}

/// What a family says about itself: the legend of its answers and of its files.
#[derive(Debug, Clone, Copy)]
pub struct About {
    /// Its name in recipes and files.
    pub name: &'static str,
    /// What it answers, in one line.
    pub title: &'static str,
    /// The axes it accepts.
    pub charts: &'static [Chart],
    /// Frame, signs and units.
    pub conventions: &'static str,
    /// The flags, bit 0 first.
    pub flags: &'static [Flag],
    /// The flags that say that what the family looks for exists: its answer to a datum is yes where one of them holds,
    /// else no.
    pub yes: &'static [&'static str],
    /// The flags that a picture shows, largest region first, each inside the one before (in general).
    pub nested: &'static [&'static str],
    /// The packed counts.
    pub counts: &'static [Count],
    /// The optional scalars.
    pub scalars: &'static [Scalar],
    /// How many control points each curve of an answer has, which are its value `control_points`; 0 where it has none.
    pub control_points: usize,
}

impl About {
    /// The bit number of a flag.
    pub fn bit(&self, flag: &str) -> Option<usize> {
        self.flags.iter().position(|f| f.name == flag)
    }

    /// The mask of all flags.
    pub fn all_flags(&self) -> u8 {
        (0..self.flags.len()).fold(0, |mask, bit| mask | 1 << bit)
    }
}

/// A kind of curve or criterion with its own mathematics.
pub trait Family: Sync {
    /// What it is, and what its verdicts and numbers mean.
    fn about(&self) -> &'static About;
    /// Checks the grid's domain and precomputes what depends on axes alone.
    ///
    /// # Errors
    /// [`crate::Error::Domain`], naming the axis, when the axes are no chart of this family or leave its domain.
    fn table<'g>(&self, grid: &'g Grid) -> Result<Box<dyn Table + 'g>>;
    /// [`Family::answer`] with its numbers as they come, some of which may have left the range of doubles.
    ///
    /// # Errors
    /// [`crate::Error::Domain`], naming the coordinate, outside the family's domain; [`crate::Error::Undecided`] at the
    /// precision cap.
    fn compute(&self, chart: usize, point: &[f64]) -> Result<Answer>;
    /// The exact answer for one datum, with its curves: coordinates as the axes of the chart with this index. Every
    /// number is finite.
    ///
    /// # Errors
    /// [`crate::Error::Domain`], naming the coordinate, outside the family's domain, or the number of the answer that
    /// leaves the range of doubles; [`crate::Error::Undecided`] at the precision cap.
    fn answer(&self, chart: usize, point: &[f64]) -> Result<Answer> {
        let answer = self.compute(chart, point)?;
        match answer.beyond_range() {
            None => Ok(answer),
            Some(what) => {
                let axes = self.about().charts[chart].axes.iter().copied();
                Err(Error::extreme(&what, axes.zip(point.iter().copied())))
            }
        }
    }
    /// The code and the control points of the chosen curve of [`Family::answer`], which is all that a table of many
    /// data has room for.
    ///
    /// # Errors
    /// As there.
    fn chosen(&self, chart: usize, point: &[f64]) -> Result<(Code, Option<Vec<[f64; 2]>>)> {
        let answer = self.answer(chart, point)?;
        Ok((answer.code, answer.control_points().map(<[_]>::to_vec)))
    }
    /// The f64 step for one datum without the work of making a grid, where the family has such a step:
    /// [`Code::UNDECIDED`] where nothing is proved, or outside the domain.
    fn shortcut(&self, _chart: usize, _point: &[f64]) -> Option<Code> {
        None
    }
    /// Proofs over whole boxes of data.
    fn region(&self) -> &dyn Region;
    /// Whether what the family looks for exists, by the flags of a datum.
    fn holds(&self, code: Code) -> bool {
        let set = |(bit, flag): (usize, &Flag)| code.flags() >> bit & 1 == 1 && self.about().yes.contains(&flag.name);
        self.about().flags.iter().enumerate().any(set)
    }
}

impl std::fmt::Debug for dyn Family {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.about().name)
    }
}

/// Which of a family's charts a grid has, as an index into [`About::charts`].
fn chart_of(family: &dyn Family, grid: &Grid) -> Result<usize> {
    let names: Vec<&str> = grid.axes().iter().map(|a| a.name()).collect();
    family.about().charts.iter().position(|c| c.axes == names).ok_or_else(|| {
        let known: Vec<String> = family.about().charts.iter().map(|c| c.axes.join(", ")).collect();
        Error::invalid(format!(
            "axes {} are no chart of `{}`; it has: {}",
            names.join(", "),
            family.about().name,
            known.join(" | ")
        ))
    })
}

/// A datum with as many coordinates as it must have.
fn coordinates<const N: usize>(point: &[f64]) -> Result<&[f64; N]> {
    point.try_into().map_err(|_| wrong_count(point.len(), N))
}

/// That a datum has another number of coordinates than it must have.
pub(crate) fn wrong_count(given: usize, must: usize) -> Error {
    Error::domain("the number of coordinates of the datum", given as f64, must.to_string())
}

/// The grid of one node.
fn single(about: &About, chart: usize, point: &[f64]) -> Result<Grid> {
    let axis = |(name, x): (&&str, &f64)| Axis::new(name, Spacing::Values(vec![*x]));
    Grid::new(about.charts[chart].axes.iter().zip(point).map(axis).collect::<Result<_>>()?)
}

/// The code of one datum, as a grid of one node has it.
///
/// # Errors
/// [`crate::Error::Domain`], naming the coordinate, outside the family's domain; [`crate::Error::Undecided`] at the
/// precision cap.
pub fn verdict(family: &dyn Family, chart: usize, point: &[f64]) -> Result<Code> {
    demand_ieee()?;
    let shortcut = family.shortcut(chart, point);
    if let Some(code) = shortcut.and_then(Code::decided) {
        return Ok(code);
    }
    let grid = single(family.about(), chart, point)?;
    let table = family.table(&grid)?;
    match if shortcut.is_none() { filtered(&*table) } else { None } {
        Some(code) => Ok(code),
        None => Ok(table.exact(0)?.0),
    }
}

/// The code of one datum by the f64 step alone: none where that is not proved, or outside the domain.
pub(crate) fn quick(family: &dyn Family, chart: usize, point: &[f64]) -> Option<Code> {
    match family.shortcut(chart, point) {
        Some(code) => code.decided(),
        None => filtered(&*family.table(&single(family.about(), chart, point).ok()?).ok()?),
    }
}

/// The f64 step for the only node of a grid.
fn filtered(table: &dyn Table) -> Option<Code> {
    let mut code = [Code::UNDECIDED];
    table.filter(0, &mut code);
    code[0].decided()
}

/// A family on one grid.
pub trait Table: Kernel {
    /// The f64 step: proves the codes of the nodes from `start` on, or leaves [`Code::UNDECIDED`].
    fn filter(&self, start: u64, out: &mut [Code]);

    /// The top of the ladder: intervals of growing precision. Returns the code and the bits that were needed.
    ///
    /// # Errors
    /// [`crate::Error::Undecided`] at the precision cap.
    fn exact(&self, node: u64) -> Result<(Code, usize)>;

    /// The scalars `which` (indices into [`About::scalars`]) at a node whose code is known, each rounded to nearest
    /// f32.
    ///
    /// # Errors
    /// [`crate::Error::Undecided`] at the precision cap.
    fn scalars(&self, node: u64, code: Code, which: &[usize], out: &mut [f32]) -> Result<()>;

    /// [`Table::scalars`] by intervals alone: what [`crate::eval`] checks samples with.
    ///
    /// # Errors
    /// As there.
    fn exact_scalars(&self, node: u64, code: Code, which: &[usize], out: &mut [f32]) -> Result<()>;
}

/// Every family, in the order in which they are listed to users.
pub fn all() -> &'static [&'static dyn Family] {
    &[
        &cubic::Cubic,
        &ph_quintic::PhQuintic,
        &any_spiral::AnySpiral,
        &reach::Reach(reach::Kind::Cubic),
        &reach::Reach(reach::Kind::Ph),
        &trig_quintic::TrigQuintic,
        &ph_path::PhPath(ph_path::Kind::EqualLength),
        &ph_path::PhPath(ph_path::Kind::Hermite),
    ]
}

/// The family of a name, in letters of either size.
///
/// # Errors
/// [`Error::Domain`], with the names that there are.
pub fn by_name(name: &str) -> Result<&'static dyn Family> {
    let found = all().iter().copied().find(|f| f.about().name.eq_ignore_ascii_case(name));
    found.ok_or_else(|| {
        let names: Vec<&str> = all().iter().map(|f| f.about().name).collect();
        Error::invalid(format!("no family is named `{name}`; there are: {}", names.join(", ")))
    })
}

/// The proofs of a family over boxes, and its chart with these axes.
///
/// # Errors
/// [`Error::Domain`] where it has none in a chart of these axes.
pub(crate) fn proofs(family: &'static dyn Family, axes: &[&str]) -> Result<(&'static dyn Region, usize)> {
    demand_ieee()?;
    let About { name, charts, .. } = family.about();
    let region = family.region();
    let chart = charts.iter().position(|c| c.axes == axes && region.covers(c.name)).ok_or_else(|| {
        let all: Vec<String> = charts.iter().filter(|c| region.covers(c.name)).map(|c| c.axes.join(", ")).collect();
        let all = all.join(" or ");
        Error::invalid(format!(
            "the axes are {}; for proofs over boxes of `{name}` they must be {all}",
            axes.join(", ")
        ))
    })?;
    Ok((region, chart))
}
