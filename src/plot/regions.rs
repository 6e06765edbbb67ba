//! The regions of a slice in a rectangle of the sheet.

use super::geometry::{Point, Rect};
use super::hatch::{Hatch, Outline};
use super::palette::{Color, WHITE, edge, region_colors};
use super::scale::Cells;
use std::collections::BTreeMap;

/// Filled regions, each of which covers those before it, and hatched outlines.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Regions {
    pub rect: Rect,
    pub x: Cells,
    pub y: Cells,
    pub fills: Vec<Area>,
    pub outlines: Vec<Area>,
    /// Width of the lines that part fills of too little contrast.
    pub edge: i32,
    pub hatch: Hatch,
}

/// A part of the rectangle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Area {
    /// Its nodes, x fastest.
    pub mask: Vec<bool>,
    /// The closed lines around it, as fractions of the sides, the second upwards. None: the cells of its nodes.
    pub rings: Vec<Vec<Point>>,
}

impl Area {
    /// Whether it is the whole rectangle.
    pub(super) fn whole(&self) -> bool {
        self.mask.iter().all(|inside| *inside)
    }
}

impl Regions {
    /// Whether any area has lines of its own around it.
    pub(super) fn smooth(&self) -> bool {
        self.fills.iter().chain(&self.outlines).any(|area| !area.rings.is_empty())
    }

    /// The colours of the fills, after that of the paper.
    pub(super) fn colors(&self) -> Vec<Color> {
        [vec![WHITE], region_colors(self.fills.len())].concat()
    }

    /// The colour of the line that parts two of these colours, for each pair.
    pub(super) fn edges(&self) -> Vec<Vec<Option<Color>>> {
        let colors = self.colors();
        colors.iter().map(|a| colors.iter().map(|b| edge(*a, *b)).collect()).collect()
    }

    /// Each outline with its style, and for those of the whole rectangle how far inside they are: lines around the
    /// whole plot would hide each other, so each runs inside the one before.
    pub(super) fn styled(&self) -> impl Iterator<Item = (&Area, Outline, Option<i32>)> {
        let mut inset = 0;
        self.outlines.iter().enumerate().map(move |(i, area)| {
            let within = area.whole().then_some(inset);
            inset += if within.is_some() { self.hatch.band + 2 * self.hatch.rim } else { 0 };
            (area, Outline::of(i), within)
        })
    }

    /// The closed lines around an area, on the sheet: what is inside of an odd number of them belongs to it.
    pub(super) fn rings(&self, area: &Area) -> Vec<Vec<Point>> {
        let rings = if area.rings.is_empty() { self.steps(&area.mask) } else { area.rings.clone() };
        rings.iter().map(|ring| ring.iter().map(|p| self.rect.at(p[0], p[1])).collect()).collect()
    }

    /// The lines around the cells of nodes, as fractions.
    fn steps(&self, mask: &[bool]) -> Vec<Vec<Point>> {
        let (x, y) = (self.x.borders(), self.y.borders());
        let (columns, rows) = (x.len() as i64 - 1, y.len() as i64 - 1);
        let inside =
            |i: i64, j: i64| (0..columns).contains(&i) && (0..rows).contains(&j) && mask[(j * columns + i) as usize];
        // Sides of cells at the border, with the inside on the left: where each goes on from.
        let mut sides: BTreeMap<(i64, i64), Vec<(i64, i64)>> = BTreeMap::new();
        for (i, j) in (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))).filter(|(i, j)| inside(*i, *j)) {
            let around = [
                ((i, j - 1), (i, j), (i + 1, j)),
                ((i + 1, j), (i + 1, j), (i + 1, j + 1)),
                ((i, j + 1), (i + 1, j + 1), (i, j + 1)),
                ((i - 1, j), (i, j + 1), (i, j)),
            ];
            for (beyond, from, to) in around {
                if !inside(beyond.0, beyond.1) {
                    sides.entry(from).or_default().push(to);
                }
            }
        }
        let mut rings = Vec::new();
        while let Some(start) = sides.first_key_value().map(|(start, _)| *start) {
            let (mut ring, mut at) = (vec![start], start);
            while let Some(mut next) = sides.remove(&at) {
                let Some(to) = next.pop() else { break };
                if !next.is_empty() {
                    sides.insert(at, next);
                }
                at = to;
                ring.push(at);
            }
            rings.push(corners(&ring).into_iter().map(|(i, j)| [x[i as usize], y[j as usize]]).collect());
        }
        rings
    }
}

/// Those places of a closed walk where it turns. Its last place is its first.
fn corners(walk: &[(i64, i64)]) -> Vec<(i64, i64)> {
    let places = &walk[1..];
    let turns = |k: usize| {
        let (before, here, after) =
            (places[(k + places.len() - 1) % places.len()], places[k], places[(k + 1) % places.len()]);
        (before.0 == here.0) != (here.0 == after.0)
    };
    (0..places.len()).filter(|k| turns(*k)).map(|k| places[k]).collect()
}
