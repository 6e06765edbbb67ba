//! The work for one answer is bounded: pieces of curves are counted near every case where solutions tie, turn back,
//! stand still or lie on a line.
//!
//! A piece is halved down to where its curvature lies on one side of a bound. Two solutions of symmetric data tie.
//! Beside these data two solutions differ by what the last digit of a double makes, and so a few precisions are tried.

use super::datum::Datum;
use super::truth::greatest_of;
use super::{Kind, PhPath};
use crate::error::Error;
use crate::family::Family;
use crate::noise::Noise;
use crate::num::{TWIN_BITS, Twin};
use crate::steps::counted;
use std::f64::consts::PI;

/// Half as many again as the most that any of these data takes.
const MOST: usize = 22_000;

/// The most steps of some data, the datum that takes them, and how many data have no answer.
fn most(kind: Kind, data: impl IntoIterator<Item = Vec<f64>>) -> (usize, Vec<f64>, usize) {
    let mut most = (0, Vec::new(), 0);
    for datum in data {
        let (steps, found) = counted(|| PhPath(kind).answer(0, &datum));
        match found {
            Err(Error::Undecided { .. }) => most.2 += 1,
            found => drop(found.unwrap_or_else(|e| panic!("{e}"))),
        }
        if steps > most.0 {
            (most.0, most.1) = (steps, datum);
        }
    }
    most
}

fn beside(x: f64) -> [f64; 3] {
    [x.next_down(), x, x.next_up()]
}

/// All angles of `angles` with each other and their mirror images.
fn pairs(angles: &[f64]) -> impl Iterator<Item = [f64; 2]> {
    angles.iter().flat_map(move |&a| angles.iter().flat_map(move |&b| [[a, b], [a, -b]]))
}

#[test]
fn few_steps_for_lengths_of_any_size() {
    let lengths = [1.000001, 1.2, 2.0, 50.0, 1e6];
    let angles = [0.0, 1e-9, 1e-5, 0.7, 1.0, PI.next_down(), PI];
    let data = pairs(&angles).flat_map(|[a, b]| lengths.map(|length| vec![a, b, length]));
    let most = most(Kind::EqualLength, data);
    assert!(most.0 < MOST && most.2 == 0, "{most:?}");
}

#[test]
fn few_steps_for_speeds_of_any_size() {
    let sizes = [1e-6f64, 0.8, 1.0, 30.0, 1e6];
    let angles = [0.0, 1e-9, 1e-5, 0.7, 1.0, PI.next_down(), PI];
    let data = pairs(&angles).flat_map(|[a, b]| {
        sizes.into_iter().flat_map(move |l0| [l0, 1.0, 0.25 * l0].map(|l1| vec![a, b, l0, l1.max(1e-6)]))
    });
    let most = most(Kind::Hermite, data);
    assert!(most.0 < MOST && most.2 == 0, "{most:?}");
}

/// Solutions that tie, and their neighbours among the doubles.
#[test]
fn few_steps_beside_symmetric_data() {
    let angles = [0.3, 1.1, 2.5, 3.1];
    let near = |a: f64| [a, -a].into_iter().flat_map(beside);
    let lengths = angles.into_iter().flat_map(|a| near(a).map(move |b| vec![a, b, 1.7]));
    let speeds = angles
        .into_iter()
        .flat_map(|a| near(a).flat_map(move |b| beside(0.9).into_iter().map(move |l1| vec![a, b, 0.9, l1])));
    let found = [most(Kind::EqualLength, lengths), most(Kind::Hermite, speeds)];
    assert!(found.iter().all(|most| most.0 < MOST && most.2 == 0), "{found:?}");
}

/// Sums of two doubles decide nearly all that usual data ask, of solutions with sharp peaks, too. Intervals take a
/// hundred times as long.
#[test]
fn usual_data_seldom_go_to_intervals() {
    let mut noise = Noise(9);
    let (mut all, mut left) = (0, 0);
    for _ in 0..300 {
        let [a, b, c, d] = [(); 4].map(|()| noise.signed());
        let datum = Datum::new(Kind::Hermite, &[3.0 * a, 3.0 * b, 1.5 * (1.6 * c).exp(), 1.5 * (1.6 * d).exp()]);
        let found = greatest_of::<Twin>(&datum, TWIN_BITS, |_| true).unwrap_or_default();
        all += found.len();
        left += found.iter().filter(|(_, most)| most.and_then(|most| most.to_f64()).is_none()).count();
    }
    assert!(all > 1100 && 50 * left < all, "{left} of {all}");
}
