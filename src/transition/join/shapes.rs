//! Joins of lines and circles: the J, U, C and S shapes, circles in circles, and what leads around where those do not
//! fit.

use super::alone::{self, Size};
use super::best::Best;
use super::costs::Costs;
use super::link::{Chain, Link, Node, SHORTEST, root};
use super::locus::{Locus, SAME, beside, meet};
use super::request::{End, Family, Request};
use super::spiral::{Pose, Spiral};
use crate::curve::vector::{Vector, add, cross, dot, length, scale, sub, turn, unit};
use crate::error::Result;

/// Curvatures of arcs between, in units of the limit.
const PEAKS: [f64; 4] = [1.0, 0.5, 0.25, 0.125];
/// How far spirals turn that may be long, radians.
const ANGLES: [f64; 3] = [0.3, 0.6, 1.0];
/// How long spirals are that are short, in least radii.
const SHORT: [f64; 2] = [0.4, 0.8];
/// How far a line goes beyond the least distance: nearly square to it, at 45° and at 30°.
const SLANTS: [f64; 3] = [1.02, 1.4, 2.0];
/// Directions that differ by less, radians, are parallel: well below what joins are exact to.
const PARALLEL: f64 = 1e-13;
/// Lines whose corner is farther away than this, in least radii, are joined nearer, too.
const FAR: f64 = 100.0;

/// Offers joins of two lines and circles, and says why there is none, should there be none.
///
/// # Errors
/// Those of the spirals, where lengths leave the range of doubles.
pub(super) fn shapes(request: &Request, best: &mut Best) -> Result<String> {
    let [from, to] = [near(request.from, &request.to, request), near(request.to, &request.from, request)];
    let request = &Request { from, to: near(to, &from, request), ..*request };
    let origin = request.from.point();
    let nodes = [&request.from, &request.to].map(|end| node(end, origin, request.greatest_curvature));
    let name = |node: &Node| if matches!(node, Node::Line(_)) { "line" } else { "circle" };
    let [from, to] = [name(&nodes[0]), name(&nodes[1])];
    if same(&nodes) {
        return Ok(format!("the two {from}s are one, travelled the same way: there is nothing to join"));
    }
    let Request { family, greatest_curvature: most, .. } = *request;
    let sought = Sought { family, longest: request.longest * most };
    let chains = sought.chains(nodes).into_iter().map(|chain| (chain.costs(), chain));
    // What is too long is not built.
    let fits = |(costs, chain): &(Costs, Chain)| {
        costs.length[0] <= sought.longest.min(f64::MAX) && chain.pieces() <= request.most_pieces
    };
    let chains: Vec<(Costs, Chain)> = chains.filter(fits).collect();
    let mut missing: Vec<Spiral> = Vec::new();
    best.build(&chains, false, |chain| {
        if chain.spirals().any(|spiral| missing.contains(&spiral)) {
            return Ok(None);
        }
        Ok(chain.build(request, origin)?.map_err(|spiral| missing.push(spiral)).ok())
    })?;
    Ok(format!("nothing that was tried leads from the {from} to the {to}; a greater limit of curvature gives room"))
}

/// The same end. A line whose point is far from the other end has its nearest point there: coordinates from a far one
/// would lose the digits of the spirals.
fn near(end: End, other: &End, request: &Request) -> End {
    let End::Line { point, direction } = end else { return end };
    let apart = sub(other.point(), point);
    if length(apart) * request.greatest_curvature <= FAR {
        return end;
    }
    let along = unit(direction);
    End::Line { point: add(point, scale(along, dot(along, apart))), direction }
}

/// In least radii from the origin.
fn node(end: &End, origin: Vector, most: f64) -> Node {
    let place = |point: Vector| scale(sub(point, origin), most);
    match *end {
        End::State(state) => Node::Line(Pose { at: place(state.point), direction: state.direction }),
        End::Line { point, direction } => Node::Line(Pose { at: place(point), direction }),
        End::Circle { centre, radius, turn } => {
            let curvature = (1.0 / (radius * most)).min(1.0);
            Node::Arc {
                centre: place(centre),
                curvature: if turn == super::super::Turn::Left { curvature } else { -curvature },
            }
        }
    }
}

/// Whether both are one, to a rounding of their numbers.
fn same(nodes: &[Node; 2]) -> bool {
    match nodes {
        [Node::Line(a), Node::Line(b)] => {
            let turned = a.direction - b.direction;
            let apart = sub(b.at, a.at);
            parallel(turned) && turned.cos() > 0.0 && cross(a.along(), apart).abs() <= SAME * length(apart).max(1.0)
        }
        [Node::Arc { centre: a, curvature: k }, Node::Arc { centre: b, curvature: l }] => {
            (k - l).abs() <= SAME * k.abs() && length(sub(*b, *a)) * k.abs() <= SAME
        }
        _ => false,
    }
}

fn parallel(turned: f64) -> bool {
    turned.sin().abs() <= PARALLEL * turned.abs().max(1.0)
}

/// What chains are made for.
struct Sought {
    family: Family,
    /// Greatest length, in least radii.
    longest: f64,
}

impl Sought {
    fn chains(&self, nodes: [Node; 2]) -> Vec<Chain> {
        let mut all: Vec<Chain> =
            self.direct(&nodes).iter().map(|link| Chain::new(&nodes, &[link.rated(self.family)])).collect();
        if let [Node::Line(a), Node::Line(b)] = nodes {
            let turned = b.direction - a.direction;
            let corner = meet([Locus::Line(a), Locus::Line(b)])[0].filter(|_| !parallel(turned));
            let far = corner.map_or(f64::INFINITY, |corner| length(sub(corner, a.at)).min(length(sub(corner, b.at))));
            if parallel(turned) && turned.cos() < 0.0 {
                self.half_turns(a, b, &mut all);
            }
            if far > FAR {
                self.by_two_arcs(a, b, &mut all);
            }
            let sizes = Size::all(&PEAKS, self.longest);
            let Some(corner) = corner.filter(|_| far <= super::FARTHEST) else {
                if turned.cos() > 0.0 {
                    all.extend(sizes.filter_map(|size| alone::beside(self.family, [a, b], size)));
                }
                return all;
            };
            all.extend(sizes.filter_map(|size| alone::corner(self.family, [a, b], corner, size)));
        }
        for k in PEAKS.into_iter().chain(halfway(&nodes)).flat_map(|k| [k, -k]) {
            for first in self.links(nodes[0].curvature(), k) {
                for last in self.links(k, nodes[1].curvature()) {
                    self.by_arc(&nodes, k, [first, last], &mut all);
                }
            }
        }
        all
    }

    /// What may lead from one curvature to another, not both 0.
    fn links(&self, from: f64, to: f64) -> Vec<Link> {
        let rated = |link: Link| link.rated(self.family);
        let direct = || lengths(from, to).map(|length| rated(Link::direct(self.family, from, to, length)));
        if from == 0.0 || to == 0.0 {
            return direct().collect();
        }
        let over = lengths(from, 0.0).zip(lengths(0.0, to));
        let over = over.map(|(a, b)| rated(Link::over_line(self.family, [from, to], [a, b])));
        if Spiral::between_round(self.family, from, to) { direct().chain(over).collect() } else { over.collect() }
    }

    /// Links that lead from one node to the other: at most one of them is a line.
    fn direct(&self, nodes: &[Node; 2]) -> Vec<Link> {
        let [from, to] = [nodes[0].curvature(), nodes[1].curvature()];
        let spiral = |angle: f64| Link::direct(self.family, from, to, 2.0 * angle / (from.abs() + to.abs()));
        let single = |f: &dyn Fn(&Link) -> f64| {
            let least = 0.5 * SHORTEST * (from.abs() + to.abs());
            root(|angle| f(&spiral(angle)), least, Spiral::most(self.family, from, to)).map(spiral)
        };
        match nodes {
            [Node::Line(_), Node::Line(_)] => Vec::new(),
            [Node::Line(line), Node::Arc { centre, .. }] => {
                let beside = cross(line.along(), sub(*centre, line.at));
                single(&|link| after(link) - beside).into_iter().collect()
            }
            [Node::Arc { centre, .. }, Node::Line(line)] => {
                let beside = cross(line.along(), sub(*centre, line.at));
                single(&|link| before(link) - beside).into_iter().collect()
            }
            [Node::Arc { centre: a, .. }, Node::Arc { centre: b, .. }] => {
                let apart = length(sub(*b, *a));
                let far = |link: &Link| length(link.hop()) - apart;
                let one = (from * to > 0.0 && from != to && apart > 0.0).then(|| single(&far)).flatten();
                let pair =
                    |angle: f64| Link::over_line(self.family, [from, to], [from, to].map(|k| 2.0 * angle / k.abs()));
                let least = 0.5 * SHORTEST * from.abs().max(to.abs());
                let pair = root(|angle| far(&pair(angle)), least, Spiral::most(self.family, from, 0.0)).map(pair);
                let lines = self.links(from, to).into_iter().filter_map(|link| link.reaching(apart));
                lines.chain(one).chain(pair).collect()
            }
        }
    }

    /// Chains over an arc between.
    fn by_arc(&self, nodes: &[Node; 2], k: f64, [first, last]: [Link; 2], all: &mut Vec<Chain>) {
        let mut add_chains = |links: [Link; 2]| {
            let loci = [locus(&nodes[0], &links[0], true), locus(&nodes[1], &links[1], false)];
            let centres = meet(loci);
            let chain = |centre| Chain::new(&[nodes[0], Node::Arc { centre, curvature: k }, nodes[1]], &links);
            all.extend(centres.into_iter().flatten().map(chain));
            centres[0].is_some()
        };
        if add_chains([first, last]) {
            return;
        }
        match nodes {
            // Too far away: a line leads nearer.
            [Node::Line(_), Node::Arc { centre, .. }] => {
                let far = beside(&locus(&nodes[0], &first, true), *centre);
                for slant in SLANTS {
                    last.reaching(far * slant).map(|last| add_chains([first, last]));
                }
            }
            [Node::Arc { centre, .. }, Node::Line(_)] => {
                let far = beside(&locus(&nodes[1], &last, false), *centre);
                for slant in SLANTS {
                    first.reaching(far * slant).map(|first| add_chains([first, last]));
                }
            }
            // One about the other: the second link is made as long as the first.
            [Node::Arc { .. }, Node::Arc { curvature: to, .. }] => {
                let far = length(first.hop());
                let lengths = [Some(last.first), last.second].map(|known| known.map(|known| known.spiral.length));
                let stretched = |factor: f64| match lengths.map(|length| length.map(|x| factor * x)) {
                    [Some(first), Some(second)] => Link::over_line(self.family, [k, *to], [first, second]),
                    [first, _] => Link::direct(self.family, k, *to, first.unwrap_or_default()),
                };
                let (long, short) = lengths
                    .iter()
                    .flatten()
                    .fold((0.0f64, f64::INFINITY), |(long, short), length| (long.max(*length), short.min(*length)));
                let (bend, most) = if last.second.is_none() {
                    (k.abs() + to.abs(), Spiral::most(self.family, k, *to))
                } else {
                    (k.abs().max(to.abs()), Spiral::most(self.family, k, 0.0))
                };
                let most = 2.0 * most / (bend * long);
                let factor = root(|x| length(stretched(x).hop()) - far, SHORTEST / short, most);
                factor.map(|factor| add_chains([first, stretched(factor).rated(self.family)]));
            }
            [Node::Line(_), Node::Line(_)] => {}
        }
    }

    /// From a line to one the other way: an arc of the right radius.
    fn half_turns(&self, a: Pose, b: Pose, all: &mut Vec<Chain>) {
        let apart = cross(a.along(), sub(b.at, a.at));
        for angle in ANGLES {
            let k = 2.0 * after(&Link::direct(self.family, 0.0, 1.0, 2.0 * angle)) / apart;
            if k.is_nan() || k.abs() > 1.0 || k == 0.0 {
                continue;
            }
            let length = 2.0 * angle / k.abs();
            let links = [Link::direct(self.family, 0.0, k, length), Link::direct(self.family, k, 0.0, length)];
            let centre = add(a.at, turn(a.along(), links[0].hop()));
            let arc = Node::Arc { centre, curvature: k };
            all.push(Chain::new(&[Node::Line(a), arc, Node::Line(b)], &links));
        }
    }

    /// From a point of a line over two arcs to another line.
    fn by_two_arcs(&self, a: Pose, b: Pose, all: &mut Vec<Chain>) {
        let (from, to) = (Node::Line(a), Node::Line(b));
        for k in PEAKS.into_iter().flat_map(|k| [k, -k]) {
            for ((first, last), (next, other)) in self.pairs(k) {
                let centre = add(a.at, turn(a.along(), first.hop()));
                let arc = Node::Arc { centre, curvature: k };
                let line = locus(&to, &last, false);
                let far = beside(&line, centre);
                let longer = SLANTS.into_iter().filter_map(|slant| next.reaching(far * slant));
                for next in longer.chain([next]) {
                    let radius = length(next.hop());
                    for centre in meet([line, Locus::Circle { centre, radius }]).into_iter().flatten() {
                        let nodes = [from, arc, Node::Arc { centre, curvature: other }, to];
                        all.push(Chain::new(&nodes, &[first, next, last]));
                    }
                }
            }
        }
    }

    /// Spirals to an arc, from another to a line, and what leads from arc to arc, with the curvature of the second.
    fn pairs(&self, k: f64) -> Vec<((Link, Link), (Link, f64))> {
        let mut all = Vec::new();
        for other in [k, -k] {
            let outer = self.links(0.0, k).into_iter().zip(self.links(other, 0.0));
            let inner = self.links(k, other);
            all.extend(
                outer.flat_map(|outer| inner.iter().map(move |next| (outer, (*next, other))).collect::<Vec<_>>()),
            );
        }
        all
    }
}

/// Lengths of spirals between two curvatures, one of them not 0.
fn lengths(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let bend = 0.5 * (from.abs() + to.abs());
    SHORT.into_iter().chain(ANGLES.into_iter().map(move |angle| angle / bend).filter(|length| *length >= SHORT[0]))
}

/// From a line to a circle: how far left of the line its centre is.
fn after(link: &Link) -> f64 {
    link.hop()[1]
}

/// From a circle to a line: the same.
fn before(link: &Link) -> f64 {
    -turn(unit(-link.angle()), link.hop())[1]
}

/// Where the centre of an arc is that a link joins with a node: before the arc, or after it.
fn locus(node: &Node, link: &Link, follows: bool) -> Locus {
    match node {
        Node::Arc { centre, .. } => Locus::Circle { centre: *centre, radius: length(link.hop()) },
        Node::Line(line) => {
            let beside = if follows { after(link) } else { before(link) };
            Locus::Line(Pose { at: add(line.at, turn(line.along(), [0.0, beside])), ..*line })
        }
    }
}

/// Curvatures of arcs that touch one circle and another about it, in units of the limit; a little sharper ones leave
/// room for spirals.
fn halfway(nodes: &[Node; 2]) -> impl Iterator<Item = f64> + use<> {
    let [a, b] = [0, 1].map(|i| 1.0 / nodes[i].curvature().abs());
    let radii = [a + b, (a - b).abs()].into_iter().flat_map(|twice| [0.5 * twice, 0.45 * twice]);
    radii.filter(|radius| radius.is_finite() && *radius >= 1.0).map(|radius| 1.0 / radius)
}
