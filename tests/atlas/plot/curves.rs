//! Curves and paths with their graphs.

use super::super::crude::curve_figure;
use super::{decode, save};
use spiral_atlas::Result;
use spiral_atlas::plot::*;
use std::f64::consts::PI;

fn curve_png(figure: &CurveFigure, size: (u32, u32)) -> Result<Vec<u8>> {
    draw_curve(figure, size)?.png()
}

fn paths_png(figure: &PathsFigure, size: (u32, u32)) -> Result<Vec<u8>> {
    draw_paths(figure, size)?.png()
}

#[test]
fn curves_of_the_paper() {
    let cases = [
        (0.7, 1.4, (0.4, 4.0), (1.66010274767, 0.76985066613)),
        (0.1, 1.5, (0.035, 100.0), (2.60727801728, 0.62666697883)),
        (0.8, 0.9, (0.6, 0.874), (1.69966006964, 1.49236264052)),
        // Not a spiral: H0 and H5 of the reference values are negative.
        (0.7, 1.4, (0.3, 0.5), (1.3, 2.1)),
    ];
    for (i, (p0, p1, k, f)) in cases.into_iter().enumerate() {
        let figure = curve_figure(p0, p1, k, f);
        let png = curve_png(&figure, (1200, 700)).unwrap();
        save(&format!("curve_{}.png", i + 1), &png);
        let small = || curve_png(&figure, (500, 300)).unwrap();
        assert!(small() == small(), "the same data give the same bytes");
        let red = decode(&png).pixels().filter(|p| p.0 == [210, 32, 32]).count();
        assert_eq!(red > 0, i == 3, "case {i}: red only where the curvature turns back");
    }
}

#[test]
fn bad_curves_are_errors_and_odd_ones_are_drawn() {
    let good = curve_figure(0.7, 1.4, (0.4, 4.0), (1.66010274767, 0.76985066613));
    type Spoil = fn(&mut CurveFigure);
    let bad: [Spoil; 8] = [
        |f| f.curve.clear(),
        |f| f.curve[3][1] = f64::NAN,
        |f| f.control[0][0] = f64::INFINITY,
        |f| f.circles[0].direction = [0.0, 0.0],
        |f| f.circles[1].curvature = f64::NAN,
        |f| f.curvature.points.truncate(1),
        |f| f.derivative.points[0][1] = f64::NEG_INFINITY,
        |f| f.derivative.points.iter_mut().for_each(|p| p[0] = 1.0),
    ];
    for (i, spoil) in bad.into_iter().enumerate() {
        let mut figure = good.clone();
        spoil(&mut figure);
        assert!(curve_png(&figure, (800, 500)).is_err(), "case {i}");
    }
    let odd: [Spoil; 6] = [
        |f| f.control.clear(),
        |f| f.circles[0].curvature = 0.0,
        |f| f.circles[1].curvature = -1e300,
        |f| f.circles.iter_mut().for_each(|c| c.curvature = 1e-300),
        |f| f.curvature.points.iter_mut().for_each(|p| p[1] = 2.0),
        |f| f.curvature.points.iter_mut().for_each(|p| p[1] *= 1e300),
    ];
    for (i, spoil) in odd.into_iter().enumerate() {
        let mut figure = good.clone();
        spoil(&mut figure);
        assert!(curve_png(&figure, (800, 500)).is_ok(), "case {i}");
    }
    for size in [(0, 10), (10, 10), (200, 30)] {
        assert!(curve_png(&good, size).is_err());
    }
    assert!(good.curve.iter().all(|p| p[0].abs() <= PI), "the curve used here is a sensible one");
}

#[test]
fn paths_are_drawn_beside_their_graphs_or_refused() {
    let graph =
        |value: f64| Lines { across: "s".into(), up: "κ".into(), lines: vec![vec![[0.0, value], [1.0, value]]] };
    let straight = |x: f64| vec![[x, 0.0], [x, 2.0]];
    let figure = PathsFigure {
        title: "two".into(),
        note: String::new(),
        paths: vec![straight(1.0), straight(1.5)],
        comb: Vec::new(),
        given: Vec::new(),
        graph: graph(0.0),
        level: None,
        backdrop: None,
    };
    let square = |far: f64| vec![vec![[0.2, 0.2], [far, 0.2], [far, 0.4]]];
    let behind =
        |far: f64| Some(Backdrop { obstacles: square(far), grown: 0.1, polyline: vec![[0.0, 0.0], [1.0, 0.5]] });
    let picture = |figure: &PathsFigure| paths_png(figure, (700, 420));
    let first = picture(&figure).unwrap();
    assert!(first.starts_with(b"\x89PNG") && first == picture(&figure).unwrap());
    // Straight or constant, it is drawn; and a level, another path or another graph changes the picture.
    let others = [
        PathsFigure { level: Some(0.5), ..figure.clone() },
        PathsFigure { paths: vec![straight(1.0)], ..figure.clone() },
        PathsFigure { graph: graph(3.0), ..figure.clone() },
        PathsFigure { comb: vec![0.1, 0.2], ..figure.clone() },
        PathsFigure { backdrop: behind(0.5), ..figure.clone() },
        PathsFigure { given: vec![vec![[1.0, 0.0], [1.2, 0.5]]], ..figure.clone() },
    ];
    assert!(others.iter().all(|other| picture(other).unwrap() != first));
    let wrong = [
        PathsFigure { paths: vec![straight(f64::NAN)], ..figure.clone() },
        PathsFigure { paths: vec![], ..figure.clone() },
        PathsFigure { graph: graph(f64::INFINITY), ..figure.clone() },
        PathsFigure { backdrop: behind(f64::NAN), ..figure.clone() },
        PathsFigure { given: vec![straight(f64::NAN)], ..figure.clone() },
    ];
    for figure in wrong {
        assert!(picture(&figure).unwrap_err().to_string().contains("must have points"));
    }
    assert!(paths_png(&figure, (40, 30)).is_err());
}
