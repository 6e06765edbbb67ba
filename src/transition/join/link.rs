//! Chains: lines and circles with spirals between them, in units of the least radius.
//!
//! A spiral between two circles fixes how far their centres are from each other, and a spiral from a line to a circle
//! how far the centre is from the line, wherever it starts. So a chain is laid out by its centres, and the directions
//! follow.

use super::super::piece::{Arc, Line, Piece};
use super::costs::{Costs, Known, wrapped};
use super::request::{Family, Request};
use super::spiral::{Pose, Spiral, pinned};
use crate::curve::vector::{Vector, add, angle_of, dot, length as norm, scale, sub, turn, unit};
use crate::error::Result;
use crate::num::roots::find;

/// The shortest spiral whose length is sought, in least radii: its control points show its curvature to 1e-12.
pub(super) const SHORTEST: f64 = 0.06;

/// A line or a circle of a chain.
#[derive(Debug, Clone, Copy)]
pub(super) enum Node {
    Line(Pose),
    Arc { centre: Vector, curvature: f64 },
}

impl Node {
    pub(super) fn curvature(&self) -> f64 {
        match self {
            Node::Line(_) => 0.0,
            Node::Arc { curvature, .. } => *curvature,
        }
    }
}

/// What leads from one to the next: a spiral, or two with a line between, of any length from 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    pub first: Known,
    pub second: Option<Known>,
    pub line: f64,
}

impl Link {
    pub(super) fn direct(family: Family, from: f64, to: f64, length: f64) -> Link {
        Link { first: Known::of(family, from, to, length), second: None, line: 0.0 }
    }

    pub(super) fn over_line(family: Family, [from, to]: [f64; 2], lengths: [f64; 2]) -> Link {
        let second = Some(Known::of(family, 0.0, to, lengths[1]));
        Link { first: Known::of(family, from, 0.0, lengths[0]), second, line: 0.0 }
    }

    /// With the rates of [`Known::rated`].
    pub(super) fn rated(self, family: Family) -> Link {
        Link { first: self.first.rated(family), second: self.second.map(|known| known.rated(family)), ..self }
    }

    fn known(&self) -> impl Iterator<Item = Known> {
        [Some(self.first), self.second].into_iter().flatten()
    }

    pub(super) fn spirals(&self) -> impl Iterator<Item = Spiral> {
        self.known().map(|known| known.spiral)
    }

    /// How far it turns.
    pub(super) fn angle(&self) -> f64 {
        self.spirals().map(|s| s.angle()).sum()
    }

    /// Curvatures at both ends.
    pub(super) fn curvatures(&self) -> [f64; 2] {
        [self.first.spiral.from, self.second.unwrap_or(self.first).spiral.to]
    }

    /// From the centre that it leaves to the centre that it reaches, for a start along (1, 0); where there is no
    /// centre, from or to the end of the line.
    pub(super) fn hop(&self) -> Vector {
        let (mut end, mut along) = (self.first.step, self.first.along);
        if let Some(second) = self.second {
            end = add(end, turn(along, add([self.line, 0.0], second.step)));
            along = turn(along, second.along);
        }
        let centre = |curvature: f64, along: Vector| -> Vector {
            if curvature == 0.0 { [0.0, 0.0] } else { turn(along, [0.0, 1.0 / curvature]) }
        };
        let [from, to] = self.curvatures();
        sub(add(end, centre(to, along)), centre(from, [1.0, 0.0]))
    }

    /// With a line so long that centres are at a distance, if one is.
    pub(super) fn reaching(&self, distance: f64) -> Option<Link> {
        self.second?;
        let link = Link { line: 0.0, ..*self };
        // Seen along the line.
        let [cos, sin] = self.first.along;
        let [x, y] = turn([cos, -sin], link.hop());
        let line = (distance * distance - y * y).sqrt() - x;
        (line > LEAST_LINE).then_some(Link { line, ..link })
    }
}

/// A line shorter than this would not show its direction to 1e-12 by its ends.
pub(super) const LEAST_LINE: f64 = 2e-3;

/// A zero between two arguments, if the signs differ there.
pub(super) fn root(f: impl Fn(f64) -> f64, low: f64, high: f64) -> Option<f64> {
    let differ = low < high && f(low) * f(high) < 0.0;
    differ.then(|| find(f, low, high, 1e-17 * high))
}

/// A chain that is laid out.
#[derive(Debug, Clone)]
pub(super) struct Chain {
    start: Pose,
    end: Vector,
    links: Vec<Link>,
    /// Curvature of the circles between the links, and how far the path goes round them.
    arcs: Vec<(f64, f64)>,
}

impl Chain {
    /// Lines only at the ends, with one circle at least.
    pub(super) fn new(nodes: &[Node], links: &[Link]) -> Chain {
        let leaves = |i: usize| match (&nodes[i], &nodes[i + 1]) {
            (Node::Line(pose), _) => pose.direction,
            (_, Node::Line(pose)) => pose.direction - links[i].angle(),
            (Node::Arc { centre: a, .. }, Node::Arc { centre: b, .. }) => {
                angle_of(sub(*b, *a)) - angle_of(links[i].hop())
            }
        };
        let directions: Vec<f64> = (0..links.len()).map(leaves).collect();
        let arc = |i: usize| {
            let k = nodes[i].curvature();
            (k, wrapped(k.signum() * (directions[i] - directions[i - 1] - links[i - 1].angle())))
        };
        let arcs = (1..links.len()).map(arc).collect();
        let beside = |centre: Vector, k: f64, direction: f64| sub(centre, turn(unit(direction), [0.0, 1.0 / k]));
        let foot = |pose: &Pose, at: Vector| add(pose.at, scale(pose.along(), dot(pose.along(), sub(at, pose.at))));
        let (from, to) = (directions[0], directions[links.len() - 1] + links[links.len() - 1].angle());
        let start = match (&nodes[0], &nodes[1]) {
            (Node::Arc { centre, curvature }, _) => beside(*centre, *curvature, from),
            (Node::Line(pose), Node::Arc { centre, .. }) => foot(pose, sub(*centre, turn(unit(from), links[0].hop()))),
            (Node::Line(pose), Node::Line(_)) => pose.at,
        };
        let last = links.len() - 1;
        let end = match (&nodes[last], &nodes[last + 1]) {
            (_, Node::Arc { centre, curvature }) => beside(*centre, *curvature, to),
            (Node::Arc { centre, .. }, Node::Line(pose)) => {
                foot(pose, add(*centre, turn(unit(directions[last]), links[last].hop())))
            }
            (Node::Line(_), Node::Line(pose)) => pose.at,
        };
        Chain { start: Pose { at: start, direction: from }, end, links: links.to_vec(), arcs }
    }

    /// Spirals without an arc between, where centres may be too far away to have digits.
    pub(super) fn alone(start: Pose, end: Vector, links: Vec<Link>) -> Chain {
        let reached = |link: &Link| (link.curvatures()[1], 0.0);
        let arcs = links[..links.len() - 1].iter().map(reached).collect();
        Chain { start, end, links, arcs }
    }

    /// Its spirals.
    pub(super) fn spirals(&self) -> impl Iterator<Item = Spiral> {
        self.links.iter().flat_map(Link::spirals)
    }

    /// How many pieces it has.
    pub(super) fn pieces(&self) -> usize {
        let links = self.links.iter().map(|link| link.spirals().count() + usize::from(link.line > 0.0));
        links.sum::<usize>() + self.arcs.iter().filter(|(_, round)| *round > 0.0).count()
    }

    /// What it costs, nearly.
    pub(super) fn costs(&self) -> Costs {
        let spirals = self.links.iter().flat_map(Link::known).map(|known| known.costs);
        let lines = self.links.iter().map(|link| Costs::line(link.line));
        let arcs = self.arcs.iter().filter(|(_, round)| *round > 0.0).map(|(k, round)| Costs::arc(k.abs(), *round));
        spirals.chain(lines).chain(arcs).fold(Costs::default(), Costs::and)
    }

    /// In pieces of the user's frame, in which `origin` is the origin here; or the spiral that is not to be had.
    pub(super) fn build(&self, request: &Request, origin: Vector) -> Result<std::result::Result<Vec<Piece>, Spiral>> {
        let end = add(origin, scale(self.end, 1.0 / request.greatest_curvature));
        let (mut pieces, reached) = match self.laid(request, origin, [0.0, 0.0])? {
            Ok(laid) => laid,
            Err(spiral) => return Ok(Err(spiral)),
        };
        let off = sub(end, reached);
        // Far from the origin a line's end is rounded by more than the spiral after it bears, and the line bears it.
        if pieces.last().is_some_and(|last| norm(off) > OFF * last.length()) && self.line() > 0.0 {
            match self.laid(request, origin, off)? {
                Ok((laid, _)) => pieces = laid,
                Err(spiral) => return Ok(Err(spiral)),
            }
        }
        if let Some(last) = pieces.pop() {
            pieces.push(pinned(last, end)?);
        }
        Ok(Ok(pieces))
    }

    /// Its longest line.
    fn line(&self) -> f64 {
        self.links.iter().map(|link| link.line).fold(0.0, f64::max)
    }

    /// In pieces, with the place that they reach; the end of the longest line is moved by a vector.
    fn laid(&self, request: &Request, origin: Vector, by: Vector) -> Result<Laid> {
        let Request { greatest_curvature: most, family, .. } = *request;
        let place = |v: Vector| add(origin, scale(v, 1.0 / most));
        let (longest, mut by) = (self.line(), Some(by));
        let (mut at, mut pieces) = (Pose { at: place(self.start.at), ..self.start }, Vec::with_capacity(8));
        for (i, link) in self.links.iter().enumerate() {
            for (j, spiral) in link.spirals().enumerate() {
                if j == 1 && link.line > 0.0 {
                    let by = by.take_if(|_| link.line == longest).unwrap_or_default();
                    let end = add(add(at.at, scale(at.along(), link.line / most)), by);
                    pieces.push(Piece::Line(Line { start: at.at, end }));
                    at.at = end;
                }
                let Some((piece, next)) = spiral.piece(family, at, most)? else { return Ok(Err(spiral)) };
                pieces.push(piece);
                at = next;
            }
            if let Some((k, round)) = self.arcs.get(i) {
                at = add_arc(&mut pieces, at, k * most, *round);
            }
        }
        Ok(Ok((pieces, at.at)))
    }
}

/// Pieces and the place that they reach, or the spiral that is not to be had.
type Laid = std::result::Result<(Vec<Piece>, Vector), Spiral>;

/// The last piece may miss its end by this share of its length.
const OFF: f64 = 1e-12;

/// Adds an arc that goes round by an angle, if it does.
pub(super) fn add_arc(pieces: &mut Vec<Piece>, at: Pose, curvature: f64, angle: f64) -> Pose {
    if angle == 0.0 {
        return at;
    }
    let arc =
        Piece::Arc(Arc { start: at.at, start_direction: at.direction, curvature, length: angle / curvature.abs() });
    let end = Pose { at: arc.end(), direction: at.direction + angle.copysign(curvature) };
    pieces.push(arc);
    end
}
