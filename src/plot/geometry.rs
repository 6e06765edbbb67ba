//! Points and rectangles of a sheet, in pixels.

pub(super) type Point = [f64; 2];

/// Pixels from `left` to before `right`, from `top` to before `bottom`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rect {
    pub left: i32,
    pub top: i32,
    pub right: i32,
    pub bottom: i32,
}

impl Rect {
    pub(super) fn width(&self) -> i32 {
        self.right - self.left
    }
    pub(super) fn height(&self) -> i32 {
        self.bottom - self.top
    }
    /// Moved out on all sides; in, for a negative amount.
    pub(super) fn grown(&self, by: i32) -> Rect {
        Rect { left: self.left - by, top: self.top - by, right: self.right + by, bottom: self.bottom + by }
    }
    /// The common part; empty (not positive in width or height) when there is none.
    pub(super) fn meet(&self, other: &Rect) -> Rect {
        Rect {
            left: self.left.max(other.left),
            top: self.top.max(other.top),
            right: self.right.min(other.right),
            bottom: self.bottom.min(other.bottom),
        }
    }
    /// The point at these fractions of width and height, the second upwards.
    pub(super) fn at(&self, x: f64, y: f64) -> Point {
        [f64::from(self.left) + x * f64::from(self.width()), f64::from(self.bottom) - y * f64::from(self.height())]
    }
}

/// The pixels within `by` of the box of the points; saturates for points far away.
pub(super) fn hull(points: &[Point], by: f64) -> Rect {
    let all = |pick: fn(f64, f64) -> f64, i: usize| points.iter().map(|p| p[i]).fold(f64::NAN, pick);
    Rect {
        left: (all(f64::min, 0) - by).floor() as i32,
        top: (all(f64::min, 1) - by).floor() as i32,
        right: (all(f64::max, 0) + by).ceil() as i32,
        bottom: (all(f64::max, 1) + by).ceil() as i32,
    }
}

/// Distance of `p` from the segment from `a` to `b`.
pub(super) fn distance(p: Point, a: Point, b: Point) -> f64 {
    let (along, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length2 = along[0] * along[0] + along[1] * along[1];
    let t = if length2 > 0.0 { ((to[0] * along[0] + to[1] * along[1]) / length2).clamp(0.0, 1.0) } else { 0.0 };
    let off = [to[0] - t * along[0], to[1] - t * along[1]];
    (off[0] * off[0] + off[1] * off[1]).sqrt()
}

/// Whether a closed polygon holds a point (even-odd rule).
pub(super) fn holds(corners: &[Point], p: Point) -> bool {
    let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
    let crossed = pairs
        .filter(|(a, b)| (a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
    crossed.count() % 2 == 1
}
