//! Lines and circles that centres lie on.

use super::spiral::Pose;
use crate::curve::vector::{Vector, add, angle_of, cross, dot, length, scale, sub, turn, unit};

/// Centres and radii that differ by less, relatively, are the same: a few roundings.
pub(super) const SAME: f64 = 16.0 * f64::EPSILON;

/// Where a centre may be.
#[derive(Debug, Clone, Copy)]
pub(super) enum Locus {
    Line(Pose),
    Circle { centre: Vector, radius: f64 },
}

/// How far a point is from a line.
pub(super) fn beside(locus: &Locus, point: Vector) -> f64 {
    match locus {
        Locus::Line(line) => cross(line.along(), sub(point, line.at)).abs(),
        Locus::Circle { .. } => f64::NAN,
    }
}

/// Where two meet.
pub(super) fn meet(loci: [Locus; 2]) -> [Option<Vector>; 2] {
    match loci {
        [Locus::Line(a), Locus::Line(b)] => {
            let (u, v) = (a.along(), b.along());
            let t = cross(sub(b.at, a.at), v) / cross(u, v);
            [t.is_finite().then(|| add(a.at, scale(u, t))), None]
        }
        [Locus::Line(line), Locus::Circle { centre, radius }]
        | [Locus::Circle { centre, radius }, Locus::Line(line)] => {
            let u = line.along();
            let to = sub(centre, line.at);
            let (along, beside) = (dot(u, to), cross(u, to));
            if beside.is_nan() || beside.abs() > radius {
                return [None, None];
            }
            let half = ((radius - beside) * (radius + beside)).sqrt();
            [along - half, along + half].map(|t| Some(add(line.at, scale(u, t))))
        }
        [Locus::Circle { centre: a, radius: r }, Locus::Circle { centre: b, radius: s }] => {
            let across = sub(b, a);
            let apart = length(across);
            // About one centre: all places are alike.
            if apart <= SAME * r && (r - s).abs() <= SAME * r {
                return [Some(add(a, [r, 0.0])), None];
            }
            if apart == 0.0 || apart.is_nan() || apart > r + s || apart < (r - s).abs() {
                return [None, None];
            }
            let x = 0.5 * (apart + (r - s) * (r + s) / apart);
            let y = ((r - x) * (r + x)).max(0.0).sqrt();
            let along = unit(angle_of(across));
            [[x, y], [x, -y]].map(|v| Some(add(a, turn(along, v))))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn loci_meet() {
        let circle = |x: f64, radius: f64| Locus::Circle { centre: [x, 0.0], radius };
        let [one, two] = meet([circle(0.0, 5.0), circle(6.0, 5.0)]).map(Option::unwrap);
        assert!(length(sub(one, [3.0, 4.0])) < 1e-15 && length(sub(two, [3.0, -4.0])) < 1e-15);
        assert_eq!(meet([circle(0.0, 1.0), circle(0.5, 3.0)]), [None, None]);
        assert_eq!(meet([circle(2.0, 1.0), circle(2.0, 1.0)]), [Some([3.0, 0.0]), None]);
        let line = |y: f64, direction: f64| Locus::Line(Pose { at: [0.0, y], direction });
        assert_eq!(meet([line(3.0, 0.0), circle(0.0, 5.0)]), [Some([-4.0, 3.0]), Some([4.0, 3.0])]);
        assert_eq!(meet([line(5.5, PI), circle(0.0, 5.0)]), [None, None]);
        let [corner, none] = meet([line(1.0, 0.0), line(0.0, 0.25 * PI)]);
        assert!(none.is_none() && length(sub(corner.unwrap(), [1.0, 1.0])) < 1e-15);
    }
}
