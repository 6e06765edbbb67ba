//! Where lines and circles meet.

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
