//! Axes, grids and the flat index: defined once, here.

mod lookup;

pub(crate) use lookup::Lookup;

use crate::error::{Error, Result, written};
use crate::num::log_space;
use crate::num::sines::two_sum;
use serde::{Deserialize, Serialize};

/// Most axes a grid may have.
pub const MAX_AXES: usize = 5;
/// Most values one axis may have: indices fit `u32` with room for carries.
pub const MAX_COUNT: usize = 1 << 24;
/// Most nodes of a grid: 32 TiB of flags and counts. Byte offsets of every field fit 53 bits, so that JSON readers keep
/// them.
pub const MAX_NODES: u64 = 1 << 44;

/// How the values of an axis are spaced.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Spacing {
    /// `lo + (hi - lo) i / (count - 1)`, in f64 arithmetic as written in [`Axis::new`].
    Linear {
        /// First value.
        lo: f64,
        /// Last value.
        hi: f64,
        /// Number of values, at least 2.
        count: usize,
    },
    /// `lo (hi / lo)^(i / (count - 1))`, correctly rounded, so that every machine has the same values.
    Log {
        /// First value, positive.
        lo: f64,
        /// Last value.
        hi: f64,
        /// Number of values, at least 2.
        count: usize,
    },
    /// Values given one by one, strictly increasing.
    Values(Vec<f64>),
}

impl Spacing {
    /// How many values there are.
    pub fn count(&self) -> usize {
        match self {
            Spacing::Linear { count, .. } | Spacing::Log { count, .. } => *count,
            Spacing::Values(values) => values.len(),
        }
    }

    /// All that can be checked before there are values.
    pub(crate) fn check(&self, name: &str) -> Result<()> {
        let fail = |what: String| Err(Error::invalid(format!("axis `{name}` {what}")));
        let (lo, hi) = match self {
            Spacing::Linear { lo, hi, .. } | Spacing::Log { lo, hi, .. } => (*lo, *hi),
            Spacing::Values(values) if values.is_empty() || values.len() > MAX_COUNT => {
                return fail(format!("has {} values; it must have 1 to {MAX_COUNT}", values.len()));
            }
            Spacing::Values(_) => return Ok(()),
        };
        // The width too: from -1e308 to 1e308 no step could be computed.
        if !((hi - lo).is_finite() && lo < hi) {
            return fail(format!(
                "runs from {} to {}; both and their difference must be finite, with lo < hi",
                written(lo),
                written(hi)
            ));
        }
        let count = self.count();
        if !(2..=MAX_COUNT).contains(&count) {
            return fail(format!(
                "has count {count}; it must be 2 to {MAX_COUNT} (a single value is written `values = [..]`)"
            ));
        }
        if matches!(self, Spacing::Log { .. }) && lo <= 0.0 {
            return fail(format!("is logarithmic from {}; it must start above 0", written(lo)));
        }
        Ok(())
    }
}

/// A named coordinate with its values: finite f64 numbers, strictly increasing.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    name: String,
    spacing: Spacing,
    values: Vec<f64>,
}

impl Axis {
    /// Builds an axis from its spacing.
    ///
    /// # Errors
    /// [`Error::Domain`] when a bound is not finite, the order is not strictly increasing, the axis is empty or has
    /// more than [`MAX_COUNT`] values, or a logarithmic axis does not start above zero.
    pub fn new(name: &str, spacing: Spacing) -> Result<Axis> {
        let fail = |what: String| Err(Error::invalid(format!("axis `{name}` {what}")));
        spacing.check(name)?;
        let values = match &spacing {
            Spacing::Linear { lo, hi, count } => lin_space(*lo, *hi, *count),
            Spacing::Log { lo, hi, count } => log_space(*lo, *hi, *count),
            Spacing::Values(values) => values.clone(),
        };
        if let Some(bad) = values.iter().find(|v| !v.is_finite()) {
            return fail(format!("has the value {bad}; all must be finite"));
        }
        if let Some(pair) = values.windows(2).find(|w| w[0] >= w[1]) {
            return fail(format!(
                "has {} before {}; values must increase strictly (fewer values, or a wider range)",
                written(pair[0]),
                written(pair[1])
            ));
        }
        Ok(Axis { name: name.to_owned(), spacing, values })
    }

    /// The axis's name, as in the papers: `phi0`, `kappa1`, ...
    pub fn name(&self) -> &str {
        &self.name
    }

    /// How its values were asked for.
    pub fn spacing(&self) -> &Spacing {
        &self.spacing
    }

    /// Its values, strictly increasing.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Index of the value nearest to `x`; of two equally near the lower one. `None` when `x` is NaN.
    ///
    /// Values outside the range give the end values.
    pub fn nearest(&self, x: f64) -> Option<usize> {
        nearest(&self.values, x)
    }
}

/// Index of the value nearest to `x` in a non-empty increasing slice; see [`Axis::nearest`].
///
/// Exact: a rounded difference that is less than another is less in truth. Where both round alike, what they lost
/// tells (Knuth's two-sum); at most one of them can overflow.
pub fn nearest(values: &[f64], x: f64) -> Option<usize> {
    if x.is_nan() {
        return None;
    }
    let above = values.partition_point(|v| *v < x);
    if above == 0 || above == values.len() {
        return Some(above.saturating_sub(usize::from(above > 0)));
    }
    let [(up, up_lost), (down, down_lost)] = [two_sum(values[above], -x), two_sum(x, -values[above - 1])];
    Some(if up < down || up == down && up_lost < down_lost { above } else { above - 1 })
}

fn lin_space(lo: f64, hi: f64, count: usize) -> Vec<f64> {
    let last = (count - 1) as f64;
    // IEEE + * / give the same bits everywhere; the ends are exact.
    (0..count).map(|i| if i + 1 == count { hi } else { lo + (hi / last - lo / last) * i as f64 }).collect()
}

/// Refuses more nodes than a grid may have, from the numbers of values of its axes.
pub(crate) fn check_nodes(counts: impl Iterator<Item = usize>) -> Result<()> {
    let nodes = counts.fold(1u64, |nodes, count| nodes.saturating_mul(count as u64));
    if nodes <= MAX_NODES {
        return Ok(());
    }
    Err(Error::invalid(format!("the grid has more than {MAX_NODES} nodes; split it")))
}

/// A product of axes, first axis slowest.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    axes: Vec<Axis>,
}

impl Grid {
    /// Builds a grid.
    ///
    /// # Errors
    /// [`Error::Domain`] for no axes, more than [`MAX_AXES`], two of one name, or more than [`MAX_NODES`] nodes.
    pub fn new(axes: Vec<Axis>) -> Result<Grid> {
        check_nodes(axes.iter().map(|axis| axis.values.len()))?;
        if axes.is_empty() || axes.len() > MAX_AXES {
            return Err(Error::invalid(format!("a grid has {} axes; it must have 1 to {MAX_AXES}", axes.len())));
        }
        for (i, axis) in axes.iter().enumerate() {
            if axes[..i].iter().any(|other| other.name == axis.name) {
                return Err(Error::invalid(format!("axis `{}` is given twice", axis.name)));
            }
        }
        Ok(Grid { axes })
    }

    /// The axes, slowest first.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// The counts of the axes.
    pub fn shape(&self) -> Vec<usize> {
        self.axes.iter().map(|a| a.values.len()).collect()
    }

    /// Number of nodes.
    #[expect(clippy::len_without_is_empty, reason = "a grid is never empty")]
    pub fn len(&self) -> u64 {
        self.axes.iter().map(|a| a.values.len() as u64).product()
    }

    /// Flat index of a node; `None` when an index is out of range or their number is wrong.
    pub fn flat(&self, index: &[usize]) -> Option<u64> {
        if index.len() != self.axes.len() {
            return None;
        }
        let mut flat = 0;
        for (i, axis) in index.iter().zip(&self.axes) {
            if *i >= axis.values.len() {
                return None;
            }
            flat = flat * axis.values.len() as u64 + *i as u64;
        }
        Some(flat)
    }

    /// The indices of a flat index, the inverse of [`Grid::flat`]; entries past the last axis are 0.
    pub fn index(&self, mut flat: u64) -> [usize; MAX_AXES] {
        let mut index = [0; MAX_AXES];
        for (slot, axis) in index.iter_mut().zip(&self.axes).rev() {
            let n = axis.values.len() as u64;
            *slot = (flat % n) as usize;
            flat /= n;
        }
        index
    }

    /// The coordinates of a node; entries past the last axis are 0.
    pub fn node(&self, flat: u64) -> [f64; MAX_AXES] {
        let index = self.index(flat);
        let mut node = [0.0; MAX_AXES];
        for ((slot, axis), i) in node.iter_mut().zip(&self.axes).zip(index) {
            *slot = axis.values[i];
        }
        node
    }

    /// The grid of the chosen nodes of each axis. An axis of which all are chosen stays as it is; others keep their
    /// values alone.
    ///
    /// # Errors
    /// [`Error::Domain`] when the number of axes is wrong, an index is out of range, or those of an axis do not
    /// increase.
    pub fn pick(&self, nodes: &[Vec<usize>]) -> Result<Grid> {
        if nodes.len() != self.axes.len() {
            return Err(Error::invalid(format!(
                "nodes of {} axes are chosen; the grid has {}",
                nodes.len(),
                self.axes.len()
            )));
        }
        let pick = |(axis, nodes): (&Axis, &Vec<usize>)| {
            if nodes.iter().copied().eq(0..axis.values.len()) {
                return Ok(axis.clone());
            }
            let value = |node: &usize| {
                let beyond =
                    || Error::invalid(format!("axis `{}` has no node {node}; it has {}", axis.name, axis.values.len()));
                axis.values.get(*node).copied().ok_or_else(beyond)
            };
            Axis::new(&axis.name, Spacing::Values(nodes.iter().map(value).collect::<Result<_>>()?))
        };
        Grid::new(self.axes.iter().zip(nodes).map(pick).collect::<Result<_>>()?)
    }

    /// A node in words: `phi0 = 0.7, phi1 = 1.4, ...`.
    pub fn describe(&self, flat: u64) -> String {
        let node = self.node(flat);
        let parts: Vec<String> = self.axes.iter().zip(node).map(|(a, x)| format!("{} = {x:?}", a.name)).collect();
        parts.join(", ")
    }
}
