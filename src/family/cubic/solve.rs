//! The exact answer for one datum: all roots, which conditions hold, the margin, the chosen spiral.

use crate::error::Result;

/// G² Hermite data in the normalised frame: end points (-1, 0) and (1, 0).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Datum {
    /// Start tangent angle below the chord, radians, positive.
    pub phi0: f64,
    /// End tangent angle above the chord, radians, positive; `phi0 + phi1 < π`.
    pub phi1: f64,
    /// Start curvature times half the chord.
    pub kappa0: f64,
    /// End curvature times half the chord.
    pub kappa1: f64,
}

/// One root of the two curvature equations and what is proved of its curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    /// `|P'(0)| / d0`, in (0, 3).
    pub f0: f64,
    /// `|P'(1)| / d1`, in (0, 3).
    pub f1: f64,
    /// Whether Theorem 3.1 accepts it.
    pub theorem31: bool,
    /// Whether its curve has monotone curvature: necessary and sufficient.
    pub spiral: bool,
    /// Least value of the spiral polynomial on [0, 1] over its largest Bernstein coefficient: positive inside the
    /// region of spirals, 0 on its boundary, negative outside; in [-1, 1].
    pub margin: f64,
}

/// All that is known of a datum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solutions {
    flags: u8,
    roots: [Root; 3],
    len: usize,
    chosen: Option<usize>,
}

impl Solutions {
    /// The flags, bits as in [`super::SOLVABLE`] and its siblings.
    pub fn flags(&self) -> u8 {
        self.flags
    }

    /// The different roots in (0, 3)², by increasing f0.
    pub fn roots(&self) -> &[Root] {
        &self.roots[..self.len]
    }

    /// The spiral with the largest margin; of equal ones that with the smaller f0.
    pub fn chosen(&self) -> Option<&Root> {
        self.chosen.map(|i| &self.roots[i])
    }
}

/// Solves one datum exactly.
///
/// # Errors
/// [`crate::Error::Domain`] for a datum that is not finite or has angles outside `0 < φ0, 0 < φ1, φ0 + φ1 < π`;
/// [`crate::Error::Undecided`] at the precision cap.
pub fn solve(datum: &Datum) -> Result<Solutions> {
    let _ = datum;
    Err(crate::Error::Domain("not yet".into()))
}
