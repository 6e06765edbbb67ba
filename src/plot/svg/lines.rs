//! Lines as data of SVG paths.

use super::page::number;
use crate::plot::geometry::{Point, Rect};

/// The parts of a line that can be seen in a rectangle: cut off a little outside, since places far away are more than
/// many programs can read. Those with a point that is not finite are left out.
pub(super) fn within(points: &[Point], clip: Rect, width: f64) -> Vec<Vec<Point>> {
    let beyond = clip.grown(width.ceil().clamp(1.0, 1e6) as i32 + 2);
    let mut parts: Vec<Vec<Point>> = Vec::new();
    for pair in points.windows(2).filter(|pair| pair.iter().flatten().all(|v| v.is_finite())) {
        let Some([from, to]) = cut(pair[0], pair[1], beyond) else { continue };
        match parts.last_mut() {
            Some(part) if part.last() == Some(&from) => part.push(to),
            _ => parts.push(vec![from, to]),
        }
    }
    parts
}

/// The part of a segment in a rectangle, cut off side by side; ends that lie in it stay as they are.
fn cut(mut a: Point, mut b: Point, rect: Rect) -> Option<[Point; 2]> {
    let sides = [(0, rect.left, -1.0), (0, rect.right, 1.0), (1, rect.top, -1.0), (1, rect.bottom, 1.0)];
    for (i, limit, sign) in sides {
        let limit = f64::from(limit);
        // From the end that is kept, so that one far away costs no digits; halves, whose differences do not overflow.
        let meet = |kept: Point, far: Point| {
            let slope = (far[1 - i] / 2.0 - kept[1 - i] / 2.0) / (far[i] / 2.0 - kept[i] / 2.0);
            let other = kept[1 - i] + (limit - kept[i]) * slope;
            if i == 0 { [limit, other] } else { [other, limit] }
        };
        match [a, b].map(|p| sign * (p[i] - limit) > 0.0) {
            [true, true] => return None,
            [true, false] => a = meet(b, a),
            [false, true] => b = meet(a, b),
            [false, false] => {}
        }
    }
    Some([a, b])
}

/// Path data of lines, each closed or not.
pub(super) fn path(lines: &[Vec<Point>], closed: bool) -> String {
    let mut data = String::new();
    for line in lines {
        let mut last: Option<[String; 2]> = None;
        for point in line {
            let here = point.map(number);
            match &last {
                None => data += &format!("M{} {}", here[0], here[1]),
                Some(before) if *before == here => {}
                Some([x, _]) if *x == here[0] => data += &format!("V{}", here[1]),
                Some([_, y]) if *y == here[1] => data += &format!("H{}", here[0]),
                Some(_) => data += &format!("L{} {}", here[0], here[1]),
            }
            last = Some(here);
        }
        data += if closed { "Z" } else { "" };
    }
    data
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHEET: Rect = Rect { left: 0, top: 0, right: 100, bottom: 50 };

    #[test]
    fn lines_are_cut_a_little_outside() {
        let inside = vec![[1.0, 2.0], [30.5, 2.0], [99.0, 49.0]];
        assert_eq!(within(&inside, SHEET, 2.0), std::slice::from_ref(&inside));
        assert_eq!(path(&[inside], false), "M1 2H30.5L99 49");
        let far =
            [[-1e300, 25.0], [1e300, 25.0], [1e300, 1e308], [50.0, -10.0], [f64::NAN, 3.0], [4.0, 4.0], [4.0, 5.0]];
        let parts = within(&far, SHEET, 2.0);
        assert_eq!(parts.len(), 3, "{parts:?}");
        assert_eq!([&parts[0], &parts[2]], [&vec![[-4.0, 25.0], [104.0, 25.0]], &vec![[4.0, 4.0], [4.0, 5.0]]]);
        assert!(parts[1].iter().all(|p| (p[0] - 50.0).abs() < 1e-6 && [54.0, -4.0].contains(&p[1])), "{parts:?}");
        let through = within(&[[50.0, -50.0], [50.0, 150.0]], SHEET, 1.0);
        assert_eq!(through, [vec![[50.0, -3.0], [50.0, 53.0]]]);
        assert!(within(&[[-9.0, -9.0], [-9.0, 90.0]], SHEET, 2.0).is_empty());
    }
}
