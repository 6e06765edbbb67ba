//! The image of an involute between two ends anywhere in the plane.

use super::none::NoSpiral;
use super::placement::Ends;
use crate::curve::vector::{Vector, add, length, turn};
use crate::error::{Error, Result};
use crate::family::any_spiral::{GREATEST, Image, Involute, InvolutePoint, Spiral, Split, involute};
use crate::plain::count;
use serde::Serialize;
use std::f64::consts::TAU;

/// [`involute`] for ends anywhere in the plane, with what places the result there.
///
/// # Errors
/// Those of [`involute`], and [`crate::Error::Domain`] for coincident ends or lengths outside the range of doubles.
pub fn involute_between(ends: &Ends, turns: [u32; 2]) -> Result<(Spiral, Frame)> {
    let (chord, half_chord) = ends.chord()?;
    for (which, k) in [("start", chord.k1), ("end", chord.k2)] {
        if k.abs() > GREATEST {
            let what = format!("the {which} curvature times half the chord");
            return Err(Error::domain(what, k, format!("at most {GREATEST:?} in magnitude for an involute")));
        }
    }
    Ok((involute(&chord, turns)?, Frame { start: ends.start, end: ends.end, half_chord }))
}

/// How the chord's frame lies in the user's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Frame {
    /// Image of (-1, 0).
    pub start: [f64; 2],
    /// Image of (1, 0).
    pub end: [f64; 2],
    /// Half the chord as a vector.
    pub half_chord: [f64; 2],
}

impl Frame {
    /// Half the chord's length: the user's unit of the chord's frame.
    pub fn unit(&self) -> f64 {
        length(self.half_chord)
    }

    /// A point of the chord's frame in the user's; the ends are met exactly, and others seen from the nearer one.
    pub fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (near, origin): (Vector, f64) = if x <= 0.0 { (self.start, -1.0) } else { (self.end, 1.0) };
        add(near, turn(self.half_chord, [x - origin, y]))
    }
}

/// Why there is no involute with the turns that were asked for, in a sentence; `None` where there is one. In the user's
/// units; within rounding of a boundary, in those of the chord's frame.
pub fn why_no_spiral(ends: &Ends, found: &Spiral) -> Option<String> {
    let asked = found.turns;
    let why = match &found.outcome {
        Ok(Image { curve, split }) => return not_so(asked, curve.turns(), *split),
        Err(why) => why,
    };
    let known = NoSpiral::with_turns(ends, asked[0] + asked[1]).ok().flatten();
    let (why, these) = (known.map_or_else(|| why.to_string(), |why| why.to_string()), "no spiral of any kind joins");
    Some(if asked == [0, 0] {
        format!("{these} these ends: {why}")
    } else {
        format!("{these} these ends with {}: {why}", count(asked[0] as usize + asked[1] as usize, "turn"))
    })
}

/// That a curve turns otherwise than asked.
fn not_so(asked: [u32; 2], has: [u32; 2], split: Split) -> Option<String> {
    let about = |[start, end]: [u32; 2]| {
        format!("{} about its start and {} about its end", count(start as usize, "turn"), count(end as usize, "turn"))
    };
    let why = match split {
        Split::Asked => return None,
        Split::Other => format!("no involute has {}, though another kind of spiral has", about(asked)),
        Split::Impossible { least, most } => {
            let all = if least == most { least.to_string() } else { format!("{least} to {most}") };
            let sum = asked[0] + asked[1];
            format!("no spiral of any kind has {}: of {sum} in all, {all} must be about the start", about(asked))
        }
    };
    Some(format!("{why}; ask for `--turns {},{}`", has[0], has[1]))
}

/// Points of a curve to draw it by, with the lengths up to them, in its own frame. Between neighbours it turns by a
/// degree and a half or less and is no longer than its 400th part, unless it would need more than 100,000 points for
/// that: then turns are seen as rings.
pub fn polyline(curve: &Involute) -> Vec<(InvolutePoint, f64)> {
    const MOST: usize = 100_000;
    let turns: f64 = curve.turns().into_iter().map(f64::from).sum();
    let turn = 0.025f64.max(TAU * (turns + 2.0) / MOST as f64 * 2.0);
    let longest = curve.length() / 400.0;
    let at = |f: f64| (curve.at(f), curve.length_to(f));
    // So many pieces that an inflection lies within few.
    let mut waiting: Vec<_> = (0..32).rev().map(|i| (at(f64::from(i) / 32.0), at(f64::from(i + 1) / 32.0))).collect();
    let mut all = vec![at(0.0)];
    while let Some((from, to)) = waiting.pop() {
        let middle = 0.5 * (from.0.f + to.0.f);
        let near = (to.0.direction - from.0.direction).abs() <= turn && to.1 - from.1 <= longest;
        if near || all.len() + waiting.len() >= MOST || middle <= from.0.f || middle >= to.0.f {
            all.push(to);
        } else {
            let middle = at(middle);
            waiting.extend([(middle, to), (from, middle)]);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From a circle that it turns about many times, and without turns from a tight circle to a nearly straight end.
    #[test]
    fn figures_show_the_curve() {
        let turning = Ends {
            start: [0.0, 0.0],
            end: [200.0, 0.0],
            start_direction: -0.7,
            end_direction: 1.4,
            start_curvature: -0.003,
            end_curvature: 0.06,
        };
        let wide = Ends {
            start: [-1.0, 0.0],
            end: [1.0, 0.0],
            start_direction: -3.111120516395333,
            end_direction: 3.09052202872047,
            start_curvature: 1.4644171020186707,
            end_curvature: 0.0018417801985307334,
        };
        for (ends, turns) in
            [(turning, [0, 0]), (turning, [10, 10]), (turning, [200, 200]), (turning, [1000, 1000]), (wide, [0, 0])]
        {
            let (found, _) = involute_between(&ends, turns).unwrap();
            let points = polyline(found.curve().unwrap());
            assert!(points.len() > 400 && points.len() < 110_000, "{turns:?}: {} points", points.len());
            let most = points.windows(2).map(|w| (w[1].0.direction - w[0].0.direction).abs()).fold(0.0, f64::max);
            assert!(most < 0.3 && points.windows(2).all(|w| w[0].1 < w[1].1), "{turns:?}: {most}");
        }
    }
}
