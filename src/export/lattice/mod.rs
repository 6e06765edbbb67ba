//! Motion primitives for nav2's Smac lattice planner: poses on a grid, with straight lines and turns between them.
//!
//! A node of that planner has a place and a direction, and no curvature. So each primitive starts and ends straight:
//! line, spiral, arc, spiral, line. Then all that is put together of them has a continuous curvature, within the limit.
//!
//! The set is made by the rules of nav2's own generator (after Pivtoraiko & Kelly 2005, *Generating Near Minimal
//! Spanning Control Sets for Constrained Motion Planning in Discrete State Spaces*). Cells are searched by growing
//! squares. A turn is left out when
//!
//! - it ends nearer to another of the same directions than a share of its length ([`LatticeOptions::distinctness`]), or
//! - it passes within half a cell and half a heading of the end of another, from where a line or a turn leads to its
//!   end, too.
//!
//! nav2 has the second rule without its last clause, since its curves may change their curvature at any place.
//!
//! The rest is by symmetry: headings from 0 to 45° are searched, and the others are their images by quarter turns and
//! mirrors, on integers.

mod file;
mod headings;
mod options;
mod primitive;
mod search;
mod turns;

use crate::error::Result;
use search::Search;
use std::collections::BTreeSet;
use turns::{Pose, Turns};

pub use options::LatticeOptions;
pub use primitive::Primitive;

/// A control set: all primitives of all headings.
///
/// # In the file
/// The planner divides the last pose by the resolution in f32 numbers, adds it to where it is, and cuts off what is
/// behind the point. So the last pose is the f32 number whose quotient is the cell's number, or, where there is none,
/// the next above: never one that is cut off to the cell before.
#[derive(Debug, Clone, PartialEq)]
pub struct Lattice {
    /// What it was made for.
    pub options: LatticeOptions,
    /// Directions in radians from 0 on, those from the centre of a square to cells of its border. They are not spaced
    /// evenly.
    pub heading_angles: Vec<f64>,
    /// Ordered by start, then by end, then by cell. With each its images by quarter turns and mirrors are there.
    pub primitives: Vec<Primitive>,
}

/// The smallest set found of primitives that lead from each direction to all directions up to a quarter turn away.
///
/// # Accuracy
/// Each spiral is proved to have monotone curvature, from 0 to that of the arc or the next spiral. So no primitive
/// bends more than one over the turning radius. Pieces meet as those of [`crate::transition::join::join`].
///
/// # Errors
/// [`Domain`](crate::Error::Domain) for options out of range (see [`LatticeOptions`]), for a radius of less than one
/// cell or more than 200, and those of joins.
pub fn lattice(options: &LatticeOptions) -> Result<Lattice> {
    options.check()?;
    let turns = Turns::new(options)?;
    let headings = &turns.headings;
    let octant = headings.count() / 8;
    let mut all = BTreeSet::new();
    for heading in 0..=octant {
        let mut search = Search::new(&turns, heading);
        let mut found = vec![search.straight()];
        found.extend(search.side(1)?);
        // At both ends of the octant right turns are images of left turns.
        if (1..octant).contains(&heading) {
            found.extend(search.side(-1)?);
        }
        for Primitive { start, end, cell, .. } in found {
            all.extend(images(&turns, start, Pose { heading: end, cell }));
        }
    }
    let mut primitives = Vec::with_capacity(all.len());
    for (start, end, cell) in all {
        let to = Pose { heading: end, cell };
        primitives.push(match turns.fit(start, to) {
            Some(fit) => turns.turn(start, to, &fit)?,
            None => turns.straight(start, cell),
        });
    }
    let heading_angles = (0..headings.count()).map(|place| headings.angle(place)).collect();
    Ok(Lattice { options: *options, heading_angles, primitives })
}

/// A path's ends by all quarter turns, and their mirror images: start, end, cell.
fn images(turns: &Turns, start: usize, end: Pose) -> Vec<(usize, usize, [i64; 2])> {
    let (count, quarter) = (turns.headings.count(), turns.headings.quarter());
    let mirrored = |place: usize| (count - place) % count;
    let [x, y] = end.cell;
    let mut all = Vec::with_capacity(8);
    for (from, to, mut cell) in [(start, end.heading, [x, y]), (mirrored(start), mirrored(end.heading), [x, -y])] {
        for turn in 0..4 {
            all.push(((from + turn * quarter) % count, (to + turn * quarter) % count, cell));
            cell = [-cell[1], cell[0]];
        }
    }
    all
}
