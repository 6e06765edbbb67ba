//! Smooth outlines of regions: where a flag changes between two neighbouring nodes, exact verdicts find the place.

use super::source::Subject;
use crate::error::Result;
use crate::family::Code;
use crate::grid::{Axis, Grid, Spacing};
use crate::plot::AxisView;
use crate::recipe::PicturePlan;
use std::collections::{BTreeMap, HashMap};

/// Halvings of a step between two nodes: to less than a tenth of a pixel where it is 25 pixels long.
const HALVINGS: usize = 8;

/// The closed lines around a region, in values of the axes.
type Rings = Vec<Vec<[f64; 2]>>;

/// A place where a region changes: which region, along which side (0 right, 1 up), on which line, after which node.
type Place = (usize, usize, usize, usize);

/// The outlines of flags on the plane of a plan: from node to node straight, through places where the flag changes.
///
/// # Arguments
/// - `axes`: of the plane, right and up.
/// - `at`: the one node of each other axis.
/// - `regions`: the bit of each flag, and the nodes of the plane that have it, x fastest.
pub(super) fn rings(
    subject: &Subject,
    plan: &PicturePlan,
    axes: [&AxisView; 2],
    at: &[(usize, Vec<usize>)],
    regions: &[(usize, &[bool])],
) -> Vec<Rings> {
    let mut places = HashMap::new();
    for side in [0, 1] {
        for line in 0..axes[1 - side].values.len() {
            let found = crossings(subject, plan, axes, at, regions, [side, line]);
            places.extend(found.into_iter().map(|(region, node, place)| ((region, side, line, node), place)));
        }
    }
    regions
        .iter()
        .enumerate()
        .map(|(k, (_, mask))| Lattice { axes, mask, region: k, places: &places }.rings())
        .collect()
}

/// Where the regions change along a line of nodes: each with the node before.
fn crossings(
    subject: &Subject,
    plan: &PicturePlan,
    axes: [&AxisView; 2],
    at: &[(usize, Vec<usize>)],
    regions: &[(usize, &[bool])],
    [side, line]: [usize; 2],
) -> Vec<(usize, usize, f64)> {
    let (values, columns) = (&axes[side].values, axes[0].values.len());
    let node = |i: usize| if side == 0 { line * columns + i } else { i * columns + line };
    // Region, node before, and the two ends of what the change is known to be in.
    let mut known: Vec<(usize, usize, [f64; 2])> = Vec::new();
    for (k, (_, mask)) in regions.iter().enumerate() {
        let changes = (1..values.len()).filter(|i| mask[node(i - 1)] != mask[node(*i)]);
        known.extend(changes.map(|i| (k, i - 1, [values[i - 1], values[i]])));
    }
    let middle = |[low, high]: [f64; 2]| if axes[side].log { low.sqrt() * high.sqrt() } else { 0.5 * low + 0.5 * high };
    for _ in 0..HALVINGS {
        let mut middles: Vec<f64> = known.iter().map(|(.., ends)| middle(*ends)).collect();
        middles.sort_by(f64::total_cmp);
        middles.dedup();
        // What is not decided stays where it is: the outline is a picture, and the nodes are proved.
        let Ok(codes) = verdicts(subject, plan, at, side, line, &middles) else { break };
        for (k, before, ends) in &mut known {
            let (bit, mask) = regions[*k];
            let place = middle(*ends);
            let Ok(found) = middles.binary_search_by(|x| x.total_cmp(&place)) else { continue };
            let holds = codes[found].flags() >> bit & 1 == 1;
            ends[usize::from(holds != mask[node(*before)])] = place;
        }
    }
    known.into_iter().map(|(k, before, ends)| (k, before, middle(ends))).collect()
}

/// The verdicts at increasing places along a line of nodes.
fn verdicts(
    subject: &Subject,
    plan: &PicturePlan,
    at: &[(usize, Vec<usize>)],
    side: usize,
    line: usize,
    places: &[f64],
) -> Result<Vec<Code>> {
    if places.is_empty() {
        return Ok(Vec::new());
    }
    let (along, across) = if side == 0 { (plan.x, plan.y) } else { (plan.y, plan.x) };
    let all = subject.grid.axes();
    let mut values: Vec<Vec<f64>> = vec![Vec::new(); all.len()];
    for (axis, nodes) in at {
        values[*axis] = nodes.iter().map(|node| all[*axis].values()[*node]).collect();
    }
    (values[along], values[across]) = (places.to_vec(), vec![all[across].values()[line]]);
    let axes = all.iter().zip(values).map(|(axis, values)| Axis::new(axis.name(), Spacing::Values(values)));
    let grid = Grid::new(axes.collect::<Result<_>>()?)?;
    let table = subject.family.table(&grid)?;
    let mut codes = vec![Code::UNDECIDED; places.len()];
    table.filter(0, &mut codes);
    for (code, node) in codes.iter_mut().zip(0..).filter(|(code, _)| **code == Code::UNDECIDED) {
        *code = table.exact(node)?.0;
    }
    Ok(codes)
}

/// The nodes of a plane, with two more lines of places on each side: one on the border of the picture, where all is as
/// at the nearest node, and there once more one where nothing is. So each line around a region is closed.
struct Lattice<'a> {
    axes: [&'a AxisView; 2],
    mask: &'a [bool],
    region: usize,
    places: &'a HashMap<Place, f64>,
}

/// An edge of the lattice: its lower end, and along which side it runs.
type Edge = ([usize; 2], usize);

impl Lattice<'_> {
    /// Places along a side.
    fn count(&self, side: usize) -> usize {
        self.axes[side].values.len() + 4
    }

    /// The node of a place, or the nearest one.
    fn node(&self, side: usize, i: usize) -> usize {
        i.saturating_sub(2).min(self.axes[side].values.len() - 1)
    }

    fn coordinate(&self, side: usize, i: usize) -> f64 {
        let axis = self.axes[side];
        match i {
            0 | 1 => axis.border()[0],
            _ if i + 2 >= self.count(side) => axis.border()[1],
            _ => axis.values[i - 2],
        }
    }

    fn holds(&self, [i, j]: [usize; 2]) -> bool {
        let inside = |side: usize, i: usize| i > 0 && i + 1 < self.count(side);
        inside(0, i) && inside(1, j) && self.mask[self.node(1, j) * self.axes[0].values.len() + self.node(0, i)]
    }

    /// Where the region changes on an edge.
    fn place(&self, (at, side): Edge) -> [f64; 2] {
        let mut place = [self.coordinate(0, at[0]), self.coordinate(1, at[1])];
        let key = (self.region, side, self.node(1 - side, at[1 - side]), self.node(side, at[side]));
        let between_nodes = (2..self.count(side) - 3).contains(&at[side]);
        if let Some(found) = self.places.get(&key).filter(|_| between_nodes) {
            place[side] = *found;
        }
        place
    }

    /// Marching squares.
    fn rings(&self) -> Rings {
        let mut beside: BTreeMap<Edge, Vec<Edge>> = BTreeMap::new();
        for (i, j) in (0..self.count(1) - 1).flat_map(|j| (0..self.count(0) - 1).map(move |i| (i, j))) {
            // Corners counter-clockwise; edge k follows corner k.
            let holds = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(|at| self.holds(at));
            let edges: [Edge; 4] = [([i, j], 0), ([i + 1, j], 1), ([i, j + 1], 0), ([i, j], 1)];
            let changed: Vec<Edge> = (0..4).filter(|k| holds[*k] != holds[(k + 1) % 4]).map(|k| edges[k]).collect();
            // Where two opposite corners hold, each is cut off alone.
            let pairs = match changed[..] {
                [a, b] => vec![[a, b]],
                [a, b, c, d] if holds[0] => vec![[d, a], [b, c]],
                [a, b, c, d] => vec![[a, b], [c, d]],
                _ => Vec::new(),
            };
            for [a, b] in pairs {
                beside.entry(a).or_default().push(b);
                beside.entry(b).or_default().push(a);
            }
        }
        let mut rings = Vec::new();
        while let Some((start, mut next)) = beside.pop_first() {
            let mut ring = vec![self.place(start)];
            let mut before = start;
            while let Some(edge) = next.pop().filter(|edge| *edge != start) {
                next = beside.remove(&edge).unwrap_or_default();
                next.retain(|other| *other != before);
                before = edge;
                ring.push(self.place(edge));
            }
            rings.push(bends(&ring));
        }
        rings
    }
}

/// A ring without the points that lie between their neighbours on a line along an axis.
fn bends(ring: &[[f64; 2]]) -> Vec<[f64; 2]> {
    // Places that are one would seem to lie between their neighbours, and corners would be lost.
    let mut apart = ring.to_vec();
    apart.dedup();
    if apart.len() > 1 && apart.first() == apart.last() {
        apart.pop();
    }
    let count = apart.len();
    let straight = |k: usize| {
        let [before, here, after] = [k + count - 1, k, k + 1].map(|k| apart[k % count]);
        (0..2).any(|c| before[c] == here[c] && here[c] == after[c])
    };
    (0..count).filter(|k| !straight(*k)).map(|k| apart[k]).collect()
}
